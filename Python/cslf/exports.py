# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light fields as pages for browsers and as glTF."""

import warnings

from .arguments import check_kind, get_file_name
from .messages import Messages, find_caller
from .notebook import find_display_problem, make_window
from .vtkCSLF import vtkCSLFGLTFExporter, vtkCSLFMapper, vtkCSLFPageExporter


def find_mapper(renderer):
    """The mapper of the first visible light field of a renderer; None without any."""
    actors = renderer.GetActors()
    actors.InitTraversal()
    for _ in range(actors.GetNumberOfItems()):
        actor = actors.GetNextActor()
        if actor.GetVisibility() and isinstance(actor.GetMapper(), vtkCSLFMapper):
            return actor.GetMapper()
    return None


def write_field(exporter, window, renderer, file_name, title):
    """Has an exporter write the light field in a renderer of a window, and returns the file's
    name."""
    name = get_file_name(file_name)
    check_kind(title, (str, type(None)), "title", "text or None")
    mapper = find_mapper(renderer)
    if mapper is None:
        raise ValueError("There is no light field in the picture.")
    exporter.SetRenderWindow(window)
    exporter.SetActiveRenderer(renderer)
    exporter.SetFileName(name)
    exporter.SetTitle(title)
    with Messages(mapper, exporter) as messages:
        exporter.Write()
        messages.require(True, "")
    return name


def write_page(window, renderer, file_name, title):
    """Writes a page, without a picture if none can be drawn."""
    exporter = vtkCSLFPageExporter()
    problem = find_display_problem(window)
    if problem:
        warnings.warn(f"The page has no first picture. {problem}", stacklevel=find_caller())
        exporter.PosterOff()
    return write_field(exporter, window, renderer, file_name, title)


def write_gltf(window, renderer, file_name, title, compact):
    """Writes glTF."""
    check_kind(compact, bool, "compact", "True or False")
    exporter = vtkCSLFGLTFExporter()
    exporter.SetCompact(compact)
    return write_field(exporter, window, renderer, file_name, title)


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


def export_gltf(field, file_name, *, title=None, compact=False, position=None, focal_point=None,
                view_up=(0.0, 1.0, 0.0), scalars=None, cmap=None, clim=None):
    """Writes the surfaces of a light field, with their light, as binary glTF (.glb), and returns
    the file's name.

    ``title`` is the name of the root node, by default the file's name without the extension.
    ``compact`` compresses the file, for viewers that know EXT_meshopt_compression. The other
    arguments, and what is raised for them, are as in ``show``: the camera is in the file, too.
    What it leaves out is named in a warning: see ``vtkCSLFGLTFExporter``. Raises ``Error`` if the
    field has no geometry with colours, or if the file cannot be written.
    """
    window, _ = make_window(field, (512, 512), position, focal_point, view_up, "black", "Geometry",
                            scalars, cmap, clim)
    return write_gltf(window, window.GetRenderers().GetFirstRenderer(), file_name, title, compact)
