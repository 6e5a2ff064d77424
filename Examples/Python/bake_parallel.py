# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
# Bakes the Cornell box into a video with all processes that mpiexec starts:
#   mpiexec -n 4 python3 bake_parallel.py
# Arguments: M N samples.
import sys
from mpi4py import MPI  # import first: it initializes and finalizes MPI
import cslf
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController

controller = vtkMPIController()
controller.Initialize()
vtkMultiProcessController.SetGlobalController(controller)
# Objects made from here on share their work by this controller. Every process builds the same
# pipeline, and makes a part of the field's viewpoints.
box, sampler = cslf.vtkCSLFCornellBoxSource(), cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.SetViewpoints(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
sampler.SetResolution(int(sys.argv[2]) if len(sys.argv) > 2 else 128)
sampler.SetSamples(int(sys.argv[3]) if len(sys.argv) > 3 else 16)
sampler.GetEnvironment().SetModeToNone()  # the box has its own lamp
encoder = cslf.vtkCSLFEncoder()
encoder.SetInputConnection(sampler.GetOutputPort())
encoder.SetFileName("CornellBox.mp4")
written = encoder.Write()
if written and controller.GetLocalProcessId() == 0:
    decoder = cslf.vtkCSLFDecoder()
    decoder.SetFileName("CornellBox.mp4")
    decoder.Update()
    slices = decoder.GetOutput().GetDimensions()[2]
    print(f"{MPI.COMM_WORLD.Get_size()} processes made {slices} viewpoints")
vtkMultiProcessController.SetGlobalController(None)
sys.exit(0 if written else "The light field was not written.")
