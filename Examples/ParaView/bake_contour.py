# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A contour becomes a light field: baked, saved as a video, reopened and drawn beside the geometry.
Run by pvbatch with the plugin on PV_PLUGIN_PATH. Arguments: M N samples."""
import sys
from paraview.simple import *
from vtkmodules.vtkIOImage import vtkPNGReader
import cslf  # the library's Python package

M, N, samples = (int(a) for a in sys.argv[1:4]) if len(sys.argv) > 3 else (17, 256, 16)
contour = Contour(Input=Wavelet(), ContourBy="RTData", Isosurfaces=[120.0, 160.0, 200.0])
field = CSLFSampler(Input=contour, Viewpoints=M, Resolution=N, Samples=samples,
                    EnvironmentMode="Gradient", EnvironmentUp=[0, 0, 1])
SaveData("contour.mp4", proxy=field, CRF=16)
reopened = OpenDataFile("contour.mp4")

# The geometry on the left, its light field on the right.
def make_view(source):
    view = CreateView("RenderView", ViewSize=[512, 512], OrientationAxesVisibility=0,
                      UseColorPaletteForBackground=0, Background=[0, 0, 0])
    Show(source, view)
    view.CameraPosition, view.CameraFocalPoint = [28.0, -44.0, 24.0], [0, 0, 0]
    view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 40
    return view

layout = CreateLayout()
left, right = make_view(contour), make_view(reopened)
layout.SplitHorizontal(0, 0.5)
AssignViewToLayout(left, layout, 1)
AssignViewToLayout(right, layout, 2)
SaveScreenshot("contour.png", layout, ImageResolution=[1024, 512])
SaveScreenshot("field.png", right, ImageResolution=[512, 512])

# How close it is to the same view, path-traced.
truth = cslf.vtkCSLFViewTracer()
truth.SetInputData(servermanager.Fetch(contour))
truth.SetLookupTable(field.LookupTable.GetClientSideObject())
truth.SetEnvironmentModeToGradient()
truth.SetEnvironmentUp(0, 0, 1)
truth.SetCamera(right.GetActiveCamera())
picture = vtkPNGReader()
picture.SetFileName("field.png")
quality = cslf.vtkCSLFImageQuality()
quality.SetInputConnection(0, picture.GetOutputPort())
quality.SetInputConnection(1, truth.GetOutputPort())
quality.Update()
print(f"PSNR {quality.GetPSNR():.2f} dB")
