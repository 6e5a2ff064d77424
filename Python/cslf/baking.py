# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Baking a scene in one call."""

import contextlib
import errno
import os
import pathlib
import shutil
import tempfile

from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

from . import vtkCSLF
from .arguments import check_kind, find_name, get_file_name, get_numbers, set_parameters
from .fields import make_actor
from .messages import Error, Messages, Progress
from .notebook import show
from .scenes import VIDEOS, connect, missing_file

QUALITIES = ("preview", "good", "best")  # of vtkCSLFPathTracer
COLORS = ("lit", "exact")  # likewise
INTERREFLECTIONS = ("colored", "neutral")  # likewise
ALL_ARRAYS = "all"  # instead of names
ALL_STEPS = "all"  # instead of a range
USER_ERROR = 40000  # of vtkErrorCode, which VTK does not wrap


class LightField:
    """A light field that ``bake`` has made. A notebook shows it if it is the last expression of a
    cell.

    ``file_name`` is the name of its file, or None if it is only in memory; then ``image`` is its
    ``vtkImageData``. ``sampler`` is the ``vtkCSLFSampler`` that made it.
    """

    def __init__(self, file_name, sampler):
        self.file_name = file_name
        self.sampler = sampler
        self._actor = None

    def __repr__(self):
        return f"<cslf.LightField {self.file_name or 'in memory'}>"

    def _repr_png_(self):
        return self.show().png

    @property
    def image(self):
        """The samples as image data if the field is in memory, else None."""
        return None if self.file_name else self.sampler.GetOutput()

    @property
    def actor(self):
        """A ``vtkActor`` that draws the field."""
        if self._actor is None:
            self._actor = make_actor(self)
        return self._actor

    def show(self, **arguments):
        """Draws a view of the field and returns it as a Picture; arguments are as in ``show``."""
        return show(self, **arguments)

    def save(self, file_name):
        """Writes the field to another file, which replaces one of that name: a video if the field
        is one, and otherwise a video (``.mp4`` or ``.mkv``) or image data (``.vti``)."""
        name = get_file_name(file_name)
        kind = pathlib.PurePath(name).suffix.lower()
        if self.file_name and self.file_name.lower().endswith(".series"):
            raise ValueError("The field is a series: copy its files and their index instead.")
        if self.file_name:
            if kind != pathlib.PurePath(self.file_name).suffix.lower():
                raise ValueError(f"The field is in {self.file_name}: its copy must have the same "
                                 "extension.")
            with whole_file(name) as part:
                shutil.copyfile(self.file_name, part)
        elif kind in VIDEOS:
            write(self.sampler, name, None, None)
        elif kind == ".vti":
            writer = vtkXMLImageDataWriter()
            writer.SetInputConnection(self.sampler.GetOutputPort())
            with whole_file(name) as part, Messages(writer) as messages:
                writer.SetFileName(part)
                messages.require(writer.Write() and not writer.GetErrorCode(),
                                 f"{name} was not written.")
        else:
            raise ValueError(f"The file must be one of {', '.join((*VIDEOS, '.vti'))}; it is "
                             f"{name!r}.")


@contextlib.contextmanager
def whole_file(name):
    """Gives the name of a file to write, which gets its own name when it is whole. A symbolic link
    stays, and its target is replaced."""
    check_folder(name)
    name = os.path.realpath(name)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(name)) as folder:
        part = os.path.join(folder, os.path.basename(name))
        yield part
        os.replace(part, name)


def check_folder(name):
    """Raises FileNotFoundError if the folder of a new file does not exist, and IsADirectoryError if
    its name is that of a folder."""
    if os.path.isdir(name):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name)
    folder = os.path.dirname(name) or "."
    if not os.path.isdir(folder):
        raise missing_file(folder)


def list_names(get_name):
    """The names that a static function of a class gives to numbers from 0."""
    names = []
    while get_name(len(names)) is not None:
        names.append(get_name(len(names)))
    return names


def make_look(color_by, color_map, color_range, light, up):
    """The filter that chooses colours and light for data; None is its default."""
    look = vtkCSLF.vtkCSLFSceneLook()
    if color_by is not None:
        check_kind(color_by, str, "color_by", "the name of an array")
        look.SetColorArrayName(color_by)
    if color_range is not None:
        look.SetColorRange(get_numbers(color_range, 2, float, "color_range", "two numbers"))
        look.AutomaticColorRangeOff()
    for parameter, value, get_name, set_value in (
            ("color_map", color_map, look.GetColorMapName, look.SetColorMap),
            ("light", light, look.GetLightName, look.SetLight),
            ("up", up, look.GetUpAxisName, look.SetUpAxis)):
        if value is not None:
            set_value(find_name(value, list_names(get_name), parameter))
    return look


def select_arrays(sampler, arrays):
    """Lets the geometry of a sampler keep arrays: names, or the word for all."""
    selection = sampler.GetSurfaceArraySelection()
    if arrays == ALL_ARRAYS:
        selection.SetUnknownArraySetting(1)
        return
    check_kind(arrays, (list, tuple, set, type(None)), "arrays", f"a list of names or {ALL_ARRAYS!r}")
    for name in arrays or ():
        check_kind(name, str, "arrays", "a list of names of arrays")
        selection.EnableArray(name)


def write(sampler, name, crf, progress, look=None, steps=None):
    """Writes what a sampler makes to a video, or these time steps of it to a series of videos, with
    the ranges of a look. Returns the name of the file or of the index."""
    if not hasattr(vtkCSLF, "vtkCSLFEncoder"):
        raise Error("This build of CSLF has no video encoder: bake without a file name, and save "
                    "the field as .vti.")
    if pathlib.PurePath(name).suffix.lower() not in VIDEOS:
        raise ValueError(f"The file must be one of {', '.join(VIDEOS)}; it is {name!r}.")
    check_folder(name)
    encoder = vtkCSLF.vtkCSLFEncoder()
    encoder.SetInputConnection(0, sampler.GetOutputPort(0))
    encoder.SetInputConnection(1, sampler.GetOutputPort(1))
    encoder.SetFileName(name)
    set_parameters(encoder.GetRateControl(), {"CRF": crf})
    writer = encoder if steps is None else make_series_writer(encoder, sampler, look, steps)
    with Messages(encoder, *([] if writer is encoder else [writer])) as messages:
        with Progress(encoder, progress, "Writing"):
            is_written = writer.Write()
        problem = getattr(getattr(look, "source", None), "problem", None)
        if problem:
            raise problem
        # Settings that cannot be coded.
        kind = ValueError if encoder.GetErrorCode() == USER_ERROR else Error
        messages.require(is_written, f"{name} was not written.", kind)
    return name if writer is encoder else writer.GetIndexName()


def make_series_writer(encoder, sampler, look, steps):
    """A writer of these time steps: a range of their numbers, or the word for all."""
    writer = vtkCSLF.vtkCSLFSeriesWriter()
    writer.SetEncoder(encoder)
    writer.SetSampler(sampler)
    writer.SetLook(look)
    if steps != ALL_STEPS:
        check_kind(steps, range, "time_steps", f"a range or {ALL_STEPS!r}")
        if len(steps) == 0 or steps[0] < 0 or steps.step < 1:
            raise ValueError(f"time_steps must be a range of ascending numbers; it is {steps!r}.")
        writer.SetTimeStepRange(steps[0], steps[-1])
        writer.SetTimeStepInterval(steps.step)
    return writer


def bake(scene, file_name=None, *, quality=None, colors=None, viewpoints=None, resolution=None,
         samples=None, noise_target=None, crf=None, sampler=None, progress=None, color_by=None,
         color_map=None, color_range=None, light=None, up=None, arrays=None,
         interreflection=None, time_steps=None):
    """Bakes a scene as a light field and returns it as a ``LightField``.

    ``scene`` is a ``vtkRenderer``, a ``vtkRenderWindow``, a plotter of PyVista, a data set of VTK,
    composite data, an algorithm or its output port, the name of a file (``.vtp``, ``.vtu``,
    ``.vti``, ``.vtm`` and VTK's other data sets, ``.pvd``, ``.vtk``, ``.ply``, ``.stl``, ``.obj``,
    ``.gltf``, ``.glb``), or the name of a scene that needs no file. Data sets that are not
    polygonal are baked as their surfaces. With ``file_name`` (``.mp4`` or ``.mkv``) the field is
    written to that video slab by slab; without, it is kept in memory.

    ``quality`` is ``"preview"``, ``"good"`` (default) or ``"best"``; ``colors`` is ``"lit"``
    (default) or ``"exact"``: unlit, as a legend tells them. ``viewpoints`` is the number of
    viewpoints along each edge of a cube face (M), ``resolution`` that of texels along each edge of
    a viewpoint's image (N), ``samples`` the rays for each texel, ``noise_target`` the noise at
    which a texel gets no more of them, and ``crf`` the video's constant rate factor, 0 to 51: less
    is better and larger. What is None keeps the default of ``vtkCSLFSampler`` or
    ``vtkCSLFEncoder``. ``sampler`` is a ``vtkCSLFSampler`` with further settings.

    Data, algorithms and files get colours and light from a ``vtkCSLFSceneLook``; windows and scenes
    by name have their own. ``color_by`` is the array that colours the surfaces, such as
    ``"pressure"`` or ``"velocity:x"`` (also ``0``, a component's name or ``magnitude``), or
    ``"none"``; by default, the active scalars if they vary. ``color_map`` is ``"cool-to-warm"``,
    ``"viridis"``, ``"plasma"``, ``"inferno"``, ``"gray"`` or ``"rainbow"``; by default, the array's
    own lookup table, or else ``"cool-to-warm"``. ``color_range`` is the pair of values at the map's
    ends; by default, the range of the array. ``light`` is ``"studio"``, ``"sun"``, ``"sky"``,
    ``"white"`` or ``"none"``; by default ``"studio"``, and a dim sky for data with lights of its
    own. ``up`` is the axis that points up, which the light follows: ``"x"``, ``"y"`` (default),
    ``"z"``, ``"-x"``, ``"-y"`` or ``"-z"``. The environment of a ``sampler`` is kept unless
    ``light`` or ``up`` is given.

    ``arrays`` are names of arrays of points or cells, or ``"all"``, that the field's surfaces
    keep besides the one that colours them, so that ``cslf.show`` can colour by them later.

    ``interreflection`` is ``"colored"`` (default) or ``"neutral"``: whether surfaces with a colour
    map light each other in their colours, or as a grey of their mean albedo would, which fits all
    maps that are chosen later.

    ``time_steps`` bakes a scene that changes over time, a ``.pvd`` or ``.vtp.series`` file or an
    algorithm that announces its times, for each of these steps: ``"all"``, or a range of their
    numbers such as ``range(0, 20, 2)``. With ``file_name`` ``"wave.mp4"``, they are written to
    ``wave_0000.mp4`` and so on, and their times to the index ``wave.mp4.series``, which is the file
    of the result; see ``vtkCSLFSeriesWriter``. By default, one time is baked: of files the first.

    ``progress`` is whether to draw a progress bar, by default in terminals and notebooks, or a
    function that gets the phase and the share that is done, from 0 to 1. Ctrl-C raises
    ``KeyboardInterrupt`` and leaves what an interrupted run leaves: the same call resumes.

    Raises ``FileNotFoundError`` if the scene's file or the video's folder does not exist,
    ``ValueError`` for values out of range, unknown names and what a video cannot hold,
    ``TypeError`` if ``scene`` or another argument is of a wrong kind, ``MemoryError`` if memory
    does not suffice, and ``cslf.Error``, a ``RuntimeError``, for all other reasons.
    """
    if not hasattr(vtkCSLF, "vtkCSLFSampler"):
        raise Error("This build of CSLF has no sampler.")
    look_parameters = {"color_by": color_by, "color_map": color_map, "color_range": color_range,
                       "light": light, "up": up}
    look = make_look(**look_parameters)
    sets_light = sampler is None or light is not None or up is not None
    sampler = vtkCSLF.vtkCSLFSampler() if sampler is None else sampler
    check_kind(sampler, vtkCSLF.vtkCSLFSampler, "sampler", "a vtkCSLFSampler")
    if not callable(progress):
        check_kind(progress, (bool, type(None)), "progress", "True, False or a function")
    quality = None if quality is None else find_name(quality, QUALITIES, "quality")
    colors = None if colors is None else find_name(colors, COLORS, "colors")
    select_arrays(sampler, arrays)
    if interreflection is not None:
        interreflection = find_name(interreflection, INTERREFLECTIONS, "interreflection")
    set_parameters(sampler, {"Quality": quality, "Colors": colors, "Viewpoints": viewpoints,
                             "Resolution": resolution, "Samples": samples,
                             "NoiseTarget": noise_target, "Interreflection": interreflection})
    if file_name is None and crf is not None:
        raise ValueError("crf is for videos, and there is no file name.")
    if file_name is None and time_steps is not None:
        raise ValueError("time_steps are written to videos, and there is no file name.")
    given = [name for name, value in look_parameters.items() if value is not None]
    has_look = connect(scene, sampler, look, time_steps is not None)
    if has_look:
        if sets_light:
            look.SetUpEnvironment(sampler.GetEnvironment())
    elif given:
        raise ValueError(f"{given[0]} is for data, algorithms and files: windows and scenes by name "
                         "have their own colours and light.")
    if file_name is not None:
        name = write(sampler, get_file_name(file_name), crf, progress, look if has_look else None,
                     time_steps)
        return LightField(name, sampler)
    with Messages(sampler) as messages:
        with Progress(sampler, progress, "Sampling"):
            sampler.UpdateWholeExtent()
        messages.require(sampler.GetOutput().GetNumberOfPoints() > 0, "There is no light field.")
    return LightField(None, sampler)
