# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Code shared by the plugin's tests: a small scene, its light field, and pictures as arrays."""
import math

import numpy
import paraview.simple
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = 256

# The name of that colour map in ParaView 6.1, and before.
version = (servermanager.vtkSMProxyManager.GetVersionMajor(),
           servermanager.vtkSMProxyManager.GetVersionMinor())
VIRIDIS = "Viridis" if version >= (6, 1) else "Viridis (matplotlib)"


def make_scene():
    """A sphere coloured by height, above the origin."""
    sphere = Sphere(Center=[0.5, 0.25, 1.0], ThetaResolution=48, PhiResolution=32)
    return Elevation(Input=sphere, LowPoint=[0.5, 0.25, 0.5], HighPoint=[0.5, 0.25, 1.5])


def bake(source, **parameters):
    """A small light field."""
    settings = dict(Viewpoints=5, Resolution=64, Samples=16, Integrator="Path Tracing")
    settings.update(parameters)
    return CSLFSampler(Input=source, **settings)


def make_view():
    """A black render view without decorations."""
    return CreateRenderView(ViewSize=[SIZE, SIZE], OrientationAxesVisibility=0,
                            UseColorPaletteForBackground=0, Background=[0, 0, 0])


def Show(*args, **settings):
    """Shows a source. Light fields are shown without legends, since pictures are compared."""
    display = paraview.simple.Show(*args, **settings)
    if "ShowLegend" in display.ListProperties():
        display.ShowLegend = 0
    return display


def look(view):
    """Looks at the scene."""
    view.CameraFocalPoint = [0.5, 0.25, 1.0]
    view.CameraPosition = [2.0, -1.6, 2.2]
    view.CameraViewUp = [0, 0, 1]
    view.CameraViewAngle = 30


def get_camera(view):
    """The view's camera, as VTK's."""
    return view.GetClientSideObject().GetRenderWindow().GetRenderers().GetFirstRenderer() \
        .GetActiveCamera()


def read_picture(name):
    """The RGB of a PNG, as floats."""
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    values = vtk_to_numpy(image.GetPointData().GetScalars())
    return values.reshape(height, width, -1)[:, :, :3].astype(float)


def take_picture(view, name):
    """Saves a view and returns its picture."""
    SaveScreenshot(name, view, ImageResolution=[SIZE, SIZE])
    return read_picture(name)


def psnr(a, b):
    """In dB, of values up to 255, at most 100."""
    error = numpy.mean((numpy.asarray(a, float) - numpy.asarray(b, float)) ** 2)
    return 100.0 if error < 255.0**2 * 1e-10 else 10 * math.log10(255.0**2 / error)


def fetch_array(source, name):
    """An array of the points of a source's output."""
    source.UpdatePipeline()
    return vtk_to_numpy(servermanager.Fetch(source).GetPointData().GetArray(name))


def check(condition, message):
    """Fails the test."""
    if not condition:
        raise AssertionError(message)


class Errors:
    """Collects messages of one kind instead of printing them, which would fail the test."""

    def __init__(self, event="ErrorEvent"):
        self.event = event

    def __enter__(self):
        self.messages = []
        self.window = vtkOutputWindow.GetInstance()
        self.old = self.window.GetDisplayMode()
        self.window.SetDisplayModeToNever()
        self.tag = self.window.AddObserver(self.event, self._collect)
        return self

    def _collect(self, window, event, text=""):
        self.messages.append(text)

    _collect.CallDataType = "string0"

    def __exit__(self, *_):
        self.window.RemoveObserver(self.tag)
        self.window.SetDisplayMode(self.old)
