# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light fields as pages for browsers."""

import warnings

from .arguments import check_kind, get_file_name
from .messages import Messages, find_caller
from .notebook import find_display_problem, make_window
from .vtkCSLF import vtkCSLFMapper, vtkCSLFPageExporter


def find_mapper(renderer):
    """The mapper of the first visible light field of a renderer; None without any."""
    actors = renderer.GetActors()
    actors.InitTraversal()
    for _ in range(actors.GetNumberOfItems()):
        actor = actors.GetNextActor()
        if actor.GetVisibility() and isinstance(actor.GetMapper(), vtkCSLFMapper):
            return actor.GetMapper()
    return None


def write_page(window, renderer, file_name, title):
    """Writes the page of the light field in a renderer of a window, and returns its name."""
    name = get_file_name(file_name)
    check_kind(title, (str, type(None)), "title", "text or None")
    mapper = find_mapper(renderer)
    if mapper is None:
        raise ValueError("There is no light field in the picture.")
    exporter = vtkCSLFPageExporter()
    exporter.SetRenderWindow(window)
    exporter.SetActiveRenderer(renderer)
    exporter.SetFileName(name)
    exporter.SetTitle(title)
    problem = find_display_problem(window)
    if problem:
        warnings.warn(f"The page has no first picture. {problem}", stacklevel=find_caller())
        exporter.PosterOff()
    with Messages(mapper, exporter) as messages:
        exporter.Write()
        messages.require(True, "")
    return name


def export_html(field, file_name, *, title=None, size=(512, 512), position=None, focal_point=None,
                view_up=(0.0, 1.0, 0.0), background="#1a1a1f", scalars=None, cmap=None, clim=None):
    """Writes a light field as one HTML page that shows it in browsers, without a server, and
    returns the page's name.

    ``title`` is the page's title, by default its name without the extension. The other arguments,
    and what is raised for them, are as in ``show``: the camera is that of the page's first view,
    and ``size`` that of the picture which is seen until the surfaces are drawn.

    The page has the surfaces of the field with their light, which users turn, move and recolour.
    What it leaves out is named in a warning: see ``vtkCSLFPageExporter``. Raises ``Error`` if the
    field has no geometry with colours, or if the page cannot be written.
    """
    window, _ = make_window(field, size, position, focal_point, view_up, background, "Geometry",
                            scalars, cmap, clim)
    return write_page(window, window.GetRenderers().GetFirstRenderer(), file_name, title)
