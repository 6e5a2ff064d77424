# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The shortest complete program: the Cornell box is sampled into a video
file, and a view of it is drawn from that file. Arguments: M N samples."""
import sys

import cslf
from vtkmodules import vtkIOImage, vtkRenderingCore

# Sample the scene: viewpoints and texels along each side, rays for each texel.
box = cslf.vtkCSLFCornellBoxSource()
sampler = cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.SetViewpoints(int(sys.argv[1]) if len(sys.argv) > 1 else 9)
sampler.SetResolution(int(sys.argv[2]) if len(sys.argv) > 2 else 128)
sampler.SetSamples(int(sys.argv[3]) if len(sys.argv) > 3 else 16)
sampler.GetEnvironment().SetModeToNone()  # the box has its own lamp

# Write the field; the encoder requests a few viewpoints at a time from the sampler.
encoder = cslf.vtkCSLFEncoder()
encoder.SetInputConnection(0, sampler.GetOutputPort(0))
encoder.SetInputConnection(1, sampler.GetOutputPort(1))  # where surfaces are
encoder.SetFileName("HelloLightField.mp4")
if not encoder.Write():
    sys.exit("The light field was not written.")

# Draw the field in the file.
decoder = cslf.vtkCSLFDecoder()
decoder.SetFileName("HelloLightField.mp4")
mapper = cslf.vtkCSLFMapper()
mapper.SetInputConnection(0, decoder.GetOutputPort(0))
mapper.SetInputConnection(1, decoder.GetOutputPort(1))
actor = vtkRenderingCore.vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderingCore.vtkRenderer()
renderer.AddActor(actor)
renderer.GetActiveCamera().SetPosition(0.7, 0.5, 4.6)
renderer.ResetCameraClippingRange()
window = vtkRenderingCore.vtkRenderWindow()
window.SetSize(640, 640)
window.AddRenderer(renderer)

# Save the picture.
picture = vtkRenderingCore.vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtkIOImage.vtkPNGWriter()
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName("HelloLightField.png")
writer.Write()
