# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light fields in PyVista: importing this module adds ``plotter.cslf`` to every plotter::

    import pyvista
    import cslf.pyvista

    plotter = pyvista.Plotter()
    plotter.add_mesh(pyvista.ParametricTorus(), color="gold")
    plotter.cslf.bake("torus.mp4")

    viewer = pyvista.Plotter()
    viewer.cslf.add_light_field("torus.mp4")
    viewer.show()
"""

import os

import pyvista
from vtkmodules.vtkCommonCore import vtkCommand

from . import vtkCSLF
from .fields import make_actor


class _Errors:
    """Converts errors that algorithms report to one exception."""

    def __init__(self, *algorithms):
        self._algorithms = algorithms
        self._messages = []

    def __enter__(self):
        def catch(_algorithm, _event, message):
            self._messages.append(message.strip().splitlines()[-1])
        catch.CallDataType = "string0"
        self._tags = [(algorithm, algorithm.AddObserver(vtkCommand.ErrorEvent, catch))
                      for algorithm in self._algorithms]
        return self

    def __exit__(self, _kind, _error, _trace):
        for algorithm, tag in self._tags:
            algorithm.RemoveObserver(tag)

    def require(self, is_done):
        """Raises the first error, if there was one or nothing was done."""
        if self._messages or not is_done:
            raise RuntimeError(self._messages[0] if self._messages else "There is no light field.")


QUALITIES = ("preview", "good", "best")  # of vtkCSLFPathTracer


class PlotterComponent:
    """The object ``plotter.cslf``."""

    def __init__(self, plotter):
        self._plotter = plotter

    def bake(self, file_name=None, *, viewpoints=None, resolution=None, quality=None,
             samples=None, noise_target=None, crf=None, sampler=None):
        """Samples the scene of the active renderer as a light field.

        Returns the field as ``pyvista.ImageData``; with ``file_name`` (``.mp4`` or ``.mkv``) it
        writes the field to that video instead, slab by slab, and returns the name.

        ``viewpoints`` is the number of viewpoints along each edge of a cube face (M),
        ``resolution`` that of texels along each edge of a viewpoint's image (N), ``quality`` is
        ``"preview"`` (also for the video's preset), ``"good"`` or ``"best"``, ``samples`` the rays
        for each texel, ``noise_target`` the noise at which a texel gets no more of them, and ``crf``
        the video's constant rate factor, 0 to 51: less is better and larger. ``sampler``
        is a ``vtkCSLFSampler`` with further settings. What is None keeps the default of
        ``vtkCSLFSampler`` or ``vtkCSLFEncoder``. Raises ``RuntimeError`` if sampling or writing
        fails.
        """
        plotter = self._plotter
        # PyVista sets the camera when it first shows the window. Lights may depend on the camera.
        if not getattr(plotter.renderer, "camera_set", True):
            plotter.view_isometric()
        sampler = vtkCSLF.vtkCSLFSampler() if sampler is None else sampler
        sampler.SetRenderer(plotter.renderer)
        if quality is not None:
            if quality not in QUALITIES:
                raise ValueError(f"quality must be one of {', '.join(QUALITIES)}.")
            sampler.SetQuality(QUALITIES.index(quality))
        for name, value in (("Viewpoints", viewpoints), ("Resolution", resolution),
                            ("Samples", samples), ("NoiseTarget", noise_target)):
            if value is not None:
                getattr(sampler, f"Set{name}")(value)
        if file_name is None:
            if crf is not None:
                raise ValueError("crf is for videos, and there is no file name.")
            with _Errors(sampler) as errors:
                sampler.UpdateWholeExtent()
                errors.require(sampler.GetOutput().GetNumberOfPoints() > 0)
            return pyvista.wrap(sampler.GetOutput())
        if not hasattr(vtkCSLF, "vtkCSLFEncoder"):
            raise RuntimeError("This build of CSLF has no video encoder: leave file_name out, and "
                               "save the image data that bake returns.")
        encoder = vtkCSLF.vtkCSLFEncoder()
        encoder.SetInputConnection(0, sampler.GetOutputPort(0))
        encoder.SetInputConnection(1, sampler.GetOutputPort(1))
        encoder.SetFileName(os.fspath(file_name))
        if quality == "preview":
            encoder.SetPreset("ultrafast")
        if crf is not None:
            encoder.GetRateControl().SetCRF(crf)
        with _Errors(sampler, encoder) as errors:
            errors.require(encoder.Write())
        return file_name

    def add_light_field(self, field, *, lookup="Geometry", **arguments):
        """Adds an actor of a light field to the active renderer, and returns it.

        ``field`` is the name of a video, image data, or an algorithm such as ``vtkCSLFDecoder``.
        ``lookup`` is as in ``cslf.make_actor``. Further arguments (``name``, ``reset_camera``,
        ``pickable``, ``render``) are those of ``Plotter.add_actor``. Raises ``ValueError`` if it is not a light field.
        """
        actor = make_actor(field, lookup)
        self._plotter.add_actor(actor, **arguments)
        return actor


def _register():
    """Uses PyVista's own registry since 0.48, and an attribute of the same name before."""
    if hasattr(pyvista, "register_plotter_component"):
        pyvista.register_plotter_component("cslf")(PlotterComponent)
    else:
        pyvista.BasePlotter.cslf = property(PlotterComponent)


_register()
