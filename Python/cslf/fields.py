# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Actors of light fields from files, algorithms or image data."""

import os
import pathlib

from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkCommonExecutionModel import (vtkAlgorithm, vtkAlgorithmOutput,
                                                vtkStreamingDemandDrivenPipeline)
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import vtkActor

from . import vtkCSLF
from .arguments import check_kind, find_name, get_file_name
from .colors import color_scalars
from .messages import Messages
from .scenes import READERS, is_scene_name, is_series, missing_file

LOOKUPS = tuple(vtkCSLF.vtkCSLFMapper.GetLookupName(lookup).capitalize()
                for lookup in range(vtkCSLF.vtkCSLFMapper.NUMBER_OF_LOOKUPS))

BAKE_FIRST = "{} is a scene, not a light field: bake it first."


def has_geometry(field):
    """Whether the second output of an algorithm is polygonal data: the field's geometry."""
    if field.GetNumberOfOutputPorts() < 2:
        return False
    information = field.GetOutputPortInformation(1)
    return information.Get(vtkDataObject.DATA_TYPE_NAME()) == "vtkPolyData"


def open_field(name):
    """The reader of a light field: a video, a series of videos, image data (``.vti``) or a folder of
    images."""
    is_image = name.lower().endswith(".vti")
    if not os.path.exists(name):
        raise ValueError(BAKE_FIRST.format(name)) if is_scene_name(name) else missing_file(name)
    if (pathlib.PurePath(name).suffix.lower() in READERS and not is_image) or is_series(name):
        raise ValueError(BAKE_FIRST.format(name))
    if os.path.isdir(name) and hasattr(vtkCSLF, "vtkCSLFImageReader"):
        reader = vtkCSLF.vtkCSLFImageReader()
    else:
        reader = vtkXMLImageDataReader() if is_image else vtkCSLF.vtkCSLFSeriesReader()
    reader.SetFileName(name)
    with Messages(reader) as messages:
        reader.UpdateInformation()
    if messages.errors:
        text = messages.errors[0]
        raise ValueError(f"Cannot read {name}: {text}" if is_image else text)
    return reader


def connect_field(field, mapper):
    """Makes a light field the input of a mapper, with its geometry if it has one."""
    from .baking import LightField  # which imports this module
    if isinstance(field, LightField):
        field = field.file_name or field.sampler
    if isinstance(field, (str, bytes, os.PathLike)):
        field = open_field(get_file_name(field))
    # A port does not keep its algorithm, which therefore stays in `field`.
    port = field.GetOutputPort() if isinstance(field, vtkAlgorithm) else field
    if isinstance(port, vtkAlgorithmOutput):
        mapper.SetInputConnection(0, port)
        if port.GetIndex() == 0 and has_geometry(port.GetProducer()):
            mapper.SetInputConnection(1, port.GetProducer().GetOutputPort(1))
    elif isinstance(field, vtkImageData):
        mapper.SetInputData(field)
    else:
        raise TypeError("A field is the name of a file, a LightField, an algorithm, its output "
                        f"port or image data, not a {type(field).__name__}: bake scenes first.")


def request_time(mapper, time):
    """Has a mapper show its field at a time."""
    check_kind(time, (int, float), "time", "a number")
    information = mapper.GetInputAlgorithm().GetOutputInformation(0)
    mapper.GetInputAlgorithm().UpdateInformation()
    if not information.Has(vtkStreamingDemandDrivenPipeline.TIME_STEPS()):
        raise ValueError("The field has no times.")
    information.Set(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), float(time))


def make_actor(field, lookup="Geometry", *, scalars=None, cmap=None, clim=None, time=None):
    """Returns a ``vtkActor`` that draws a light field.

    ``field`` is the name of a video, of a series of videos (``.mp4.series``), of image data
    (``.vti``) or of a folder of images, a ``LightField``, an algorithm that makes a field, such as ``vtkCSLFSampler``, or its output port,
    or image data. ``lookup`` is ``Nearest``, ``Linear``, ``Bilinear``, ``Focal``, ``Depth`` or
    ``Geometry``, which is ``Depth`` for fields without geometry.

    Fields of scenes with a colour map have scalars, which the lookup ``Geometry`` shows in other
    colours, too. ``scalars`` is the array that is meant, such as ``"speed"`` or ``"velocity:x"``;
    by default all. ``cmap`` is ``"cool-to-warm"``, ``"viridis"``, ``"plasma"``, ``"inferno"``,
    ``"gray"``, ``"rainbow"``, another name that matplotlib knows, if it is installed, or a
    ``vtkScalarsToColors``. ``clim`` is the pair of values at its ends. What is None remains as it
    was sampled.

    ``time`` is for fields of several times: the last one that is not later is shown, by default the
    first. Another one is requested of the reader, ``actor.GetMapper().GetInputAlgorithm()``, by its
    ``SetTime``.

    Raises ``FileNotFoundError`` if there is no such file, ``TypeError`` if an argument is of
    another kind, and ``ValueError`` if ``field`` is not a light field, a name is unknown, or the
    field has no scalars to colour.
    """
    lookup = find_name(lookup, LOOKUPS, "lookup")
    mapper = vtkCSLF.vtkCSLFMapper()
    connect_field(field, mapper)
    mapper.SetLookup(lookup)
    if time is not None:
        request_time(mapper, time)
    actor = vtkActor()
    actor.SetMapper(mapper)
    with Messages(mapper) as messages:
        bounds = actor.GetBounds()
    if messages.errors or bounds is None or bounds[0] > bounds[1]:
        raise ValueError(messages.errors[0] if messages.errors
                         else "The field is not a light field: bake scenes first.")
    color_scalars(mapper, scalars, cmap, clim)
    return actor
