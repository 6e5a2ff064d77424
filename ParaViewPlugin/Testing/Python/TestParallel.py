# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A field of distributed input has the same bytes, and picture, for any number of ranks. Argument:
the name of the field; then that of another one, to compare with."""
import sys

import mpi4py.MPI  # noqa: F401  before VTK's
from cslfparaview import *
from paraview.modules.vtkRemotingCore import vtkProcessModule

name = sys.argv[1]
contour = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])
field = bake(contour, Viewpoints=3, Resolution=32, Samples=4)
SaveData(name + ".mp4", proxy=field, Lossless=1)
view = make_view()
Show(field, view)
view.CameraPosition, view.CameraFocalPoint = [40.0, -60.0, 30.0], [0, 0, 0]
view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 30
SaveScreenshot(name + ".png", view, ImageResolution=[SIZE, SIZE])
if vtkProcessModule.GetProcessModule().GetPartitionId() == 0 and len(sys.argv) > 2:
    with open(name + ".mp4", "rb") as a, open(sys.argv[2] + ".mp4", "rb") as b:
        check(a.read() == b.read(), "the fields differ")
    quality = psnr(read_picture(name + ".png"), read_picture(sys.argv[2] + ".png"))
    check(read_picture(name + ".png").max() > 50, "the picture is empty")
    check(quality > 60, f"the pictures differ: {quality} dB")
