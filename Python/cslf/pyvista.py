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

import pyvista

from .baking import bake
from .exports import write_gltf, write_page
from .fields import make_actor
from .scenes import find_renderer


class PlotterComponent:
    """The object ``plotter.cslf``."""

    def __init__(self, plotter):
        self._plotter = plotter

    def bake(self, file_name=None, **arguments):
        """Samples the scene of the active renderer as a light field.

        Returns the field as ``pyvista.ImageData``; with ``file_name`` (``.mp4`` or ``.mkv``) it
        writes the field to that video instead, slab by slab, and returns the name. Arguments and
        exceptions are those of ``cslf.bake``.
        """
        field = bake(self._plotter, file_name, **arguments)
        return pyvista.wrap(field.image) if file_name is None else file_name

    def add_light_field(self, field, *, lookup="Geometry", scalars=None, cmap=None, clim=None,
                        **arguments):
        """Adds an actor of a light field to the active renderer, and returns it.

        ``field``, ``lookup``, ``scalars``, ``cmap`` and ``clim`` are as in ``cslf.make_actor``. Further arguments (``name``,
        ``reset_camera``, ``pickable``, ``render``) are those of ``Plotter.add_actor``. Raises
        ``FileNotFoundError`` if there is no such file, and ``ValueError`` if it is not a light
        field.
        """
        actor = make_actor(field, lookup, scalars=scalars, cmap=cmap, clim=clim)
        self._plotter.add_actor(actor, **arguments)
        return actor

    def export_html(self, file_name, *, title=None):
        """Writes the light field of the active renderer as one HTML page that shows it in browsers,
        with the plotter's camera and background, and returns the page's name. What it leaves out,
        such as other actors, is named in a warning. Exceptions are those of ``cslf.export_html``;
        ``ValueError`` if there is no light field.
        """
        renderer = find_renderer(self._plotter)
        return write_page(self._plotter.render_window, renderer, file_name, title)

    def export_gltf(self, file_name, *, title=None, compact=False):
        """Writes the surfaces of the light field of the active renderer, with their light, as
        binary glTF, and returns the file's name. Arguments and exceptions are those of
        ``cslf.export_gltf``; ``ValueError`` if there is no light field.
        """
        renderer = find_renderer(self._plotter)
        return write_gltf(self._plotter.render_window, renderer, file_name, title, compact)


def _register():
    """Uses PyVista's own registry since 0.48, and an attribute of the same name before."""
    if hasattr(pyvista, "register_plotter_component"):
        pyvista.register_plotter_component("cslf")(PlotterComponent)
    else:
        pyvista.BasePlotter.cslf = property(PlotterComponent)


_register()
