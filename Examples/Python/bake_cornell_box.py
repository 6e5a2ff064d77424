# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
# Bakes the Cornell box into a video and saves a view of it. Arguments: M N samples.
import sys
import cslf
from vtkmodules import vtkIOImage, vtkRenderingCore
box, sampler = cslf.vtkCSLFCornellBoxSource(), cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.SetViewpoints(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
sampler.SetResolution(int(sys.argv[2]) if len(sys.argv) > 2 else 64)
sampler.SetSamples(int(sys.argv[3]) if len(sys.argv) > 3 else 16)
sampler.SetEnvironmentModeToNone()  # the box has a lamp
encoder, decoder = cslf.vtkCSLFEncoder(), cslf.vtkCSLFDecoder()
encoder.SetInputConnection(sampler.GetOutputPort())
encoder.SetFileName("CornellBox.mp4")
encoder.Write() or sys.exit("The light field was not written.")
decoder.SetFileName("CornellBox.mp4")
mapper, actor = cslf.vtkCSLFMapper(), vtkRenderingCore.vtkActor()
mapper.SetInputConnection(decoder.GetOutputPort())
actor.SetMapper(mapper)
renderer, window = vtkRenderingCore.vtkRenderer(), vtkRenderingCore.vtkRenderWindow()
renderer.AddActor(actor)
renderer.GetActiveCamera().SetPosition(0.7, 0.5, 6.0)
window.SetSize(320, 320)
window.AddRenderer(renderer)
picture, writer = vtkRenderingCore.vtkWindowToImageFilter(), vtkIOImage.vtkPNGWriter()
picture.SetInput(window)
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName("CornellBox.png")
writer.Write()
