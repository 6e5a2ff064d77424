# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Actors of light fields from files, algorithms or image data."""

import os

from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkRenderingCore import vtkActor

from .vtkCSLF import vtkCSLFDecoder, vtkCSLFMapper

LOOKUPS = tuple(vtkCSLFMapper.GetLookupName(lookup).capitalize()
                for lookup in range(vtkCSLFMapper.NUMBER_OF_LOOKUPS))


def has_geometry(field):
    """Whether the second output of an algorithm is polygonal data: the field's geometry."""
    if field.GetNumberOfOutputPorts() < 2:
        return False
    information = field.GetOutputPortInformation(1)
    return information.Get(vtkDataObject.DATA_TYPE_NAME()) == "vtkPolyData"


def make_actor(field, lookup="Geometry"):
    """Returns a ``vtkActor`` that draws a light field.

    ``field`` is the name of a video, an algorithm that makes a field, such as
    ``vtkCSLFSampler``, or image data. ``lookup`` is ``Nearest``, ``Linear``, ``Bilinear``,
    ``Focal``, ``Depth`` or ``Geometry``, which is ``Depth`` for fields without geometry.
    Raises ``ValueError`` if the field is not a light field or the lookup is unknown.
    """
    if lookup not in LOOKUPS:
        raise ValueError(f"The lookup must be one of {', '.join(LOOKUPS)}; it is {lookup!r}.")
    mapper = vtkCSLFMapper()
    if isinstance(field, (str, os.PathLike)):
        decoder = vtkCSLFDecoder()
        decoder.SetFileName(os.fspath(field))
        mapper.SetInputConnection(0, decoder.GetOutputPort(0))
        mapper.SetInputConnection(1, decoder.GetOutputPort(1))
    elif hasattr(field, "GetOutputPort"):
        mapper.SetInputConnection(0, field.GetOutputPort())
        if has_geometry(field):
            mapper.SetInputConnection(1, field.GetOutputPort(1))
    else:
        mapper.SetInputData(field)
    mapper.SetLookup(LOOKUPS.index(lookup))
    actor = vtkActor()
    actor.SetMapper(mapper)
    bounds = actor.GetBounds()
    if bounds is None or bounds[0] > bounds[1]:
        raise ValueError("The field is not a light field.")
    return actor
