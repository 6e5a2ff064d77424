# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of light fields that notebooks display."""

import ctypes
import functools
import os
import pathlib

from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

from .arguments import check_kind, get_color, get_file_name, get_size, get_vector
from .colors import make_scalar_bar
from .fields import make_actor

# From the front, a little to the right and above.
DIRECTION = (0.35, 0.25, 1.0)


class Picture:
    """A PNG picture in memory. A notebook shows it if it is the last expression of a cell, and
    ``numpy.asarray`` gives its pixels: rows from the top, columns, and bytes of red, green, blue.
    """

    def __init__(self, png):
        self.png = png

    def _repr_png_(self):
        return self.png

    def __array__(self, dtype=None, copy=None):
        from vtkmodules.util.numpy_support import vtk_to_numpy  # only this needs numpy
        if copy is False:
            raise ValueError("The picture has to be decoded, which makes a copy.")
        reader = vtkPNGReader()
        reader.SetMemoryBuffer(self.png)
        reader.SetMemoryBufferLength(len(self.png))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        # VTK's rows begin at the bottom.
        pixels = pixels.reshape(height, width, -1)[::-1].copy()
        return pixels if dtype is None else pixels.astype(dtype)

    def save(self, file_name):
        """Writes the PNG file. Raises ValueError for names of other kinds."""
        name = get_file_name(file_name)
        if pathlib.PurePath(name).suffix.lower() != ".png":
            raise ValueError(f"Pictures are saved as .png; the name is {name!r}.")
        pathlib.Path(name).write_bytes(self.png)


@functools.lru_cache(maxsize=None)
def connect_display(_name):
    """Whether an X server answers. The connection is kept: servers such as that of xvfb-run restart
    when their last client leaves, and windows that are opened meanwhile end the process."""
    try:
        library = ctypes.CDLL("libX11.so.6")
    except OSError:
        return True
    library.XOpenDisplay.restype = ctypes.c_void_p
    return library.XOpenDisplay(None) is not None


def find_display_problem(window):
    """Why a window cannot be drawn; None if it can."""
    display = os.environ.get("DISPLAY")
    if window.GetClassName() != "vtkXOpenGLRenderWindow" or display and connect_display(display):
        return None
    problem = f"no server answers at DISPLAY={display}" if display else "DISPLAY is not set"
    return (f"Drawing needs an X server, and {problem}: start the program with xvfb-run -a, or set "
            "DISPLAY.")


def capture(window):
    """Captures a render window as a Picture."""
    check_kind(window, vtkRenderWindow, "window", "a vtkRenderWindow")
    problem = find_display_problem(window)
    if problem:
        raise RuntimeError(problem)
    grabber = vtkWindowToImageFilter()
    grabber.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.WriteToMemoryOn()
    writer.Write()
    return Picture(bytes(memoryview(writer.GetResult())))


def find_view_up(view, up):
    """The given direction, or another one if it is along the view; the same as the tool's."""
    side = [0.0, 0.0, 0.0]
    vtkMath.Cross(view, up, side)
    if vtkMath.Norm(side) > 1e-6 * vtkMath.Norm(view) * vtkMath.Norm(up):
        return up
    return (0.0, 0.0, 1.0) if abs(view[2]) < 0.9 * vtkMath.Norm(view) else (0.0, 1.0, 0.0)


def make_window(field, size, position, focal_point, view_up, background, lookup, scalars, cmap,
                clim, show_scalar_bar=False, time=None):
    """A window with a field, and the field's actor. The arguments are those of ``show``."""
    size = get_size(size)
    background = get_color(background, "background")
    view_up = get_vector(view_up, "view_up")
    position = None if position is None else get_vector(position, "position")
    focal_point = None if focal_point is None else get_vector(focal_point, "focal_point")
    check_kind(show_scalar_bar, bool, "show_scalar_bar", "True or False")
    actor = make_actor(field, lookup, scalars=scalars, cmap=cmap, clim=clim, time=time)
    bounds = actor.GetBounds()
    center = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    renderer = vtkRenderer()
    renderer.SetBackground(*background)
    renderer.AddActor(actor)
    if show_scalar_bar:
        renderer.AddViewProp(make_scalar_bar(actor.GetMapper(), scalars, size, background))
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(40.0)  # the same as the tool's, which VTK narrows to fill the picture
    if position is None:
        camera.SetFocalPoint(*center)
        camera.SetPosition(*(c + d for c, d in zip(center, DIRECTION)))
        camera.SetViewUp(*find_view_up([-d for d in DIRECTION], view_up))
        renderer.ResetCameraScreenSpace(bounds)
        position = camera.GetPosition()
        center = camera.GetFocalPoint()
    focal_point = center if focal_point is None else focal_point
    view = [there - here for here, there in zip(position, focal_point)]
    if vtkMath.Norm(view) == 0.0:
        raise ValueError("The camera's position and its focal point must differ.")
    camera.SetPosition(*position)
    camera.SetFocalPoint(*focal_point)
    camera.SetViewUp(*find_view_up(view, view_up))
    renderer.ResetCameraClippingRange()
    return window, actor


def show(field, size=(400, 400), position=None, focal_point=None, view_up=(0.0, 1.0, 0.0),
         background="#1a1a1f", lookup="Geometry", scalars=None, cmap=None, clim=None,
         show_scalar_bar=False, time=None):
    """Draws a view of a light field and returns it as a Picture.

    ``field`` is as in ``make_actor``: a name, a ``LightField``, an algorithm or image data.
    ``size`` is the width and height in pixels. ``position`` is the position of the camera in world
    coordinates, by default in front, a little to the right and above, where the field fills the
    picture, and ``focal_point`` the point that it looks at, by default the centre of what is drawn.
    ``background`` is the name of a colour in HTML,
    such as ``white``, or red, green and blue in [0,1]; the default is that of the tool ``cslf``.
    ``lookup``, ``scalars``, ``cmap``, ``clim`` and ``time``, and what is raised if there is no such field, are
    as in ``make_actor``. ``show_scalar_bar`` is whether to draw a bar with the colours and values
    of the scalars.

    Raises ``TypeError`` for arguments of a wrong kind, ``ValueError`` for those out of range, and
    ``RuntimeError`` if nothing can be drawn.
    """
    return capture(make_window(field, size, position, focal_point, view_up, background, lookup,
                               scalars, cmap, clim, show_scalar_bar, time)[0])
