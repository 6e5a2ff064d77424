# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A contour becomes a light field: baked, saved as a video, reopened and drawn beside the geometry.
For pvbatch with the plugin on PV_PLUGIN_PATH. Arguments: M N samples."""
import sys
from paraview.simple import *
from vtkmodules.vtkIOImage import vtkPNGReader
import cslf  # the library's Python package

M, N, samples = (int(a) for a in sys.argv[1:4]) if len(sys.argv) > 3 else (9, 128, 16)
contour = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])
field = CSLFSampler(Input=contour, Viewpoints=M, Resolution=N, Samples=samples)
SaveData("contour.mp4", proxy=field, CRF=16)
reopened = OpenDataFile("contour.mp4")

# The geometry on the left, its light field on the right.
layout = CreateLayout()
layout.SplitHorizontal(0, 0.5)
for cell, source in ((1, contour), (2, reopened)):
    view = CreateRenderView(ViewSize=[512, 512], OrientationAxesVisibility=0,
                            UseColorPaletteForBackground=0, Background=[0, 0, 0])
    AssignViewToLayout(view, layout, cell)
    Show(source, view)
    view.CameraPosition, view.CameraFocalPoint = [28.0, -44.0, 24.0], [0, 0, 0]
    view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 40
SaveScreenshot("contour.png", layout, ImageResolution=[1024, 512])
SaveScreenshot("field.png", view, ImageResolution=[512, 512])

# The PSNR of the field against the same view, path-traced.
truth = cslf.vtkCSLFViewTracer()
truth.SetInputData(servermanager.Fetch(contour))
truth.SetLookupTable(field.LookupTable.GetClientSideObject())
truth.SetCamera(view.GetClientSideObject().GetActiveCamera())
picture = vtkPNGReader()
picture.SetFileName("field.png")
quality = cslf.vtkCSLFImageQuality()
quality.SetInputConnection(0, picture.GetOutputPort())
quality.SetInputConnection(1, truth.GetOutputPort())
quality.Update()
print(f"PSNR {quality.GetPSNR():.2f} dB")
