# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Sets up ParaView's window for a picture. screenshot_paraview.sh runs this inside ParaView."""
import os
from pathlib import Path
from paraview.simple import *

view = GetActiveViewOrCreate("RenderView")
view.CameraPosition, view.CameraFocalPoint = [28.0, -44.0, 24.0], [0, 0, 0]
view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 40


def make_contour():
    wavelet = Wavelet()
    Show(wavelet, view, "OutlineRepresentation")
    contour = Contour(Input=wavelet, ContourBy=["POINTS", "RTData"],
                      Isosurfaces=[110.0, 150.0, 190.0])
    return wavelet, contour


def sampler():
    """The filter before it is applied, with the box that sets its cube."""
    contour = make_contour()[1]
    Show(contour, view)
    CSLFSampler(Input=contour, AutomaticCube=0, CubePosition=[-11, -11, -11],
                CubeLengths=[22, 22, 22])


def field():
    """The light field between the outline and a slice of the data, and its file."""
    wavelet, contour = make_contour()
    slice = Slice(Input=wavelet)
    slice.SliceType.Origin, slice.SliceType.Normal = [0, 0, -9.9], [0, 0, 1]
    slice.UpdatePipeline()
    ColorBy(Show(slice, view), ("POINTS", "RTData"))
    field = CSLFSampler(Input=contour, Viewpoints=9, Resolution=128, Samples=16,
                        Integrator="Path Tracing")
    Show(field, view)
    SaveData("contour.mp4", proxy=field, CRF=16, Preset="ultrafast")
    SetActiveSource(field)


def reader():
    """The file, opened."""
    Show(OpenDataFile("contour.mp4"), view)


pictures = {"sampler": sampler, "field": field, "save": reader,
            "open": lambda: None, "reader": reader}
pictures[os.environ["CSLF_PICTURE"]]()
Render()
Path(os.environ["CSLF_READY"]).touch()
