# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Actors of light fields from files, algorithms or image data."""

import errno
import os

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import vtkActor

from . import vtkCSLF
from .messages import Messages

LOOKUPS = tuple(vtkCSLF.vtkCSLFMapper.GetLookupName(lookup).capitalize()
                for lookup in range(vtkCSLF.vtkCSLFMapper.NUMBER_OF_LOOKUPS))


def has_geometry(field):
    """Whether the second output of an algorithm is polygonal data: the field's geometry."""
    if field.GetNumberOfOutputPorts() < 2:
        return False
    information = field.GetOutputPortInformation(1)
    return information.Get(vtkDataObject.DATA_TYPE_NAME()) == "vtkPolyData"


def open_field(name):
    """The reader of a light field: a video, image data (``.vti``) or a folder of images."""
    if not os.path.exists(name):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name)
    if os.path.isdir(name) and hasattr(vtkCSLF, "vtkCSLFImageReader"):
        reader = vtkCSLF.vtkCSLFImageReader()
    else:
        is_image = name.lower().endswith(".vti")
        reader = vtkXMLImageDataReader() if is_image else vtkCSLF.vtkCSLFDecoder()
    reader.SetFileName(name)
    with Messages(reader) as messages:
        reader.UpdateInformation()
    if messages.errors:
        raise ValueError(messages.errors[0])
    return reader


def make_actor(field, lookup="Geometry"):
    """Returns a ``vtkActor`` that draws a light field.

    ``field`` is the name of a video, of image data (``.vti``) or of a folder of images, an
    algorithm that makes a field, such as ``vtkCSLFSampler``, or image data. ``lookup`` is
    ``Nearest``, ``Linear``, ``Bilinear``, ``Focal``, ``Depth`` or ``Geometry``, which is ``Depth``
    for fields without geometry. Raises ``FileNotFoundError`` if there is no such file, and
    ``ValueError`` if the field is not a light field or the lookup is unknown.
    """
    if lookup not in LOOKUPS:
        raise ValueError(f"The lookup must be one of {', '.join(LOOKUPS)}; it is {lookup!r}.")
    mapper = vtkCSLF.vtkCSLFMapper()
    if isinstance(field, (str, os.PathLike)):
        field = open_field(os.fspath(field))
    if hasattr(field, "GetOutputPort"):
        mapper.SetInputConnection(0, field.GetOutputPort())
        if has_geometry(field):
            mapper.SetInputConnection(1, field.GetOutputPort(1))
    else:
        mapper.SetInputData(field)
    mapper.SetLookup(LOOKUPS.index(lookup))
    actor = vtkActor()
    actor.SetMapper(mapper)
    with Messages(mapper) as messages:
        bounds = actor.GetBounds()
    if messages.errors or bounds is None or bounds[0] > bounds[1]:
        raise ValueError(messages.errors[0] if messages.errors
                         else "The field is not a light field.")
    return actor
