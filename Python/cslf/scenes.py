# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What can be baked: windows and their renderers, data, algorithms and files."""

import errno
import json
import math
import os
import pathlib
import warnings
from xml.etree import ElementTree

from vtkmodules.vtkCommonDataModel import (vtkCompositeDataSet, vtkDataObject, vtkDataSet,
                                           vtkMultiBlockDataSet)
from vtkmodules.vtkCommonExecutionModel import (vtkAlgorithm, vtkAlgorithmOutput,
                                                vtkStreamingDemandDrivenPipeline)
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

from . import vtkCSLF
from .messages import Error, Messages, find_caller, raise_error

READERS = {".obj": vtkOBJReader, ".ply": vtkPLYReader, ".stl": vtkSTLReader,
           ".vtk": vtkGenericDataObjectReader}
READERS.update({f".{parallel}{kind}": vtkXMLGenericDataObjectReader
                for kind in ("vtp", "vtu", "vti", "vtr", "vts") for parallel in ("", "p")})
READERS.update({kind: vtkXMLGenericDataObjectReader for kind in (".vtm", ".vtpd", ".vtpc")})
READERS.update({kind: getattr(vtkCSLF, "vtkCSLFGLTFReader", None) for kind in (".gltf", ".glb")})
VIDEOS = (".mp4", ".mkv")  # of light fields
LEGACY_KINDS = ("Scalars", "Vectors", "Normals", "Tensors", "ColorScalars", "TCoords", "Fields")


def missing_file(name):
    """The exception that says that there is no such file or folder."""
    return FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), name)


def is_scene_name(name):
    """Whether a scene that needs no file has this name."""
    source = getattr(vtkCSLF, "vtkCSLFSceneSource", None)
    return source is not None and source.HasScene(name)


def find_renderer(scene):
    """The renderer of a scene that is a renderer, a window or a plotter of PyVista, or None."""
    if isinstance(scene, vtkRenderer):
        return scene
    if isinstance(scene, vtkRenderWindow):
        renderers = scene.GetRenderers()
        found = [renderers.GetItemAsObject(i) for i in range(renderers.GetNumberOfItems())]
        found = [renderer for renderer in found if renderer.VisibleActorCount() > 0]
        if len(found) != 1:
            raise ValueError(f"The window has {len(found)} renderers that show something: bake one "
                             "of its renderers.")
        return found[0]
    renderer = getattr(scene, "renderer", None)
    if isinstance(renderer, vtkRenderer):
        # PyVista sets the camera when it first shows the window. Lights may depend on the camera.
        if not getattr(renderer, "camera_set", True):
            scene.view_isometric()
        return renderer
    return None


def is_series(name):
    """Whether the name is that of an index of files of scenes, such as ``wave.vtp.series``."""
    path = pathlib.PurePath(name)
    return path.suffix.lower() == ".series" and pathlib.PurePath(path.stem).suffix.lower() in READERS


def find_steps(name):
    """The files at each time of a collection or a series: pairs of the time and their names, in the
    order of the times. Empty for other files."""
    steps = {}

    def add(time, file):
        if not math.isfinite(float(time)):
            raise ValueError("a time that is not finite")
        steps.setdefault(float(time), []).append(file)

    try:
        if pathlib.PurePath(name).suffix.lower() == ".pvd":
            for entry in ElementTree.parse(name).iter("DataSet"):
                add(entry.get("timestep", 0), entry.get("file", ""))
        elif is_series(name):
            with open(name, encoding="utf-8") as file:
                for number, entry in enumerate(json.load(file)["files"]):
                    add(entry.get("time", number), entry["name"])
    except (ElementTree.ParseError, ValueError, KeyError, TypeError, AttributeError,
            RecursionError) as error:
        raise Error(f"Cannot read {name}: it is not an index of files.") from error
    folder = os.path.dirname(name)
    return [(time, [os.path.join(folder, file) for file in steps[time]]) for time in sorted(steps)]


def read_step(name, steps, time):
    """The files of the last of these steps that is not later than a time, or of the first one, as
    blocks."""
    _, files = next((step for step in reversed(steps) if step[0] <= time), steps[0])
    blocks = vtkMultiBlockDataSet()
    for file in files:
        if pathlib.PurePath(file).suffix.lower() in (".pvd", ".series"):
            raise Error(f"Cannot read {name}: its part {file} is a collection, too.")
        blocks.SetBlock(blocks.GetNumberOfBlocks(), read(file))
    return blocks


class StepSource(VTKPythonAlgorithmBase):
    """The files of a collection or a series, at their times."""

    def __init__(self, name):
        super().__init__(nInputPorts=0, outputType="vtkMultiBlockDataSet")
        self.name = name
        self.steps = find_steps(name)
        if not self.steps:
            raise Error(f"Cannot read {name}: it names no files.")
        self.problem = None

    def RequestInformation(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        times = [step[0] for step in self.steps]
        pipeline = vtkStreamingDemandDrivenPipeline
        information.Set(pipeline.TIME_STEPS(), times, len(times))
        information.Set(pipeline.TIME_RANGE(), (times[0], times[-1]), 2)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        time = information.Get(key) if information.Has(key) else self.steps[0][0]
        output = vtkMultiBlockDataSet.GetData(outputs, 0)
        try:
            output.ShallowCopy(read_step(self.name, self.steps, time))
        except (Error, ValueError, OSError) as problem:
            self.problem = problem
            return 0
        output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
        return 1


def read(name):
    """Reads a scene's file, of several times the first. Raises FileNotFoundError, ValueError for
    other kinds of files, and cslf.Error if it cannot be read."""
    if not os.path.exists(name):
        raise missing_file(name)
    kind = pathlib.PurePath(name).suffix.lower()
    if kind == ".pvd" or is_series(name):
        return read_step(name, StepSource(name).steps, -math.inf)
    reader = READERS.get(kind)
    if kind in VIDEOS:
        raise ValueError(f"{name} is a light field, not a scene.")
    if reader is None:
        raise ValueError(f"{name} is not a scene: supported are "
                         f"{', '.join(sorted([*READERS, '.pvd']))}, and series such as .vtp.series.")
    reader = reader()
    reader.SetFileName(name)
    # Legacy files may have several arrays of a kind, of which their reader takes one.
    for kind in LEGACY_KINDS if isinstance(reader, vtkGenericDataObjectReader) else ():
        getattr(reader, f"ReadAll{kind}On")()
    with Messages(reader) as messages:
        reader.Update()
    if messages.errors:
        raise_error(f"Cannot read {name}: {messages.errors[0]}")
    data = reader.GetOutputDataObject(0)
    if data is None or data.GetNumberOfElements(vtkDataObject.CELL) == 0:
        raise Error(f"Cannot read {name}: it has no cells.")
    return data


def check_data(data):
    """Raises TypeError for data that no surface is made of."""
    if not isinstance(data, (vtkDataSet, vtkCompositeDataSet)):
        raise TypeError(f"A {data.GetClassName()} is not a scene.")


def connect(scene, sampler, look, has_steps=False):
    """Makes a scene the input of a sampler, through a ``vtkCSLFSceneLook`` if its colours and light
    are not its own. Returns whether that is so. ``has_steps`` is whether all its times are baked."""
    renderer = find_renderer(scene)
    if renderer is not None:
        sampler.SetRenderer(renderer)
        return False
    if isinstance(scene, (str, os.PathLike)):
        name = os.fspath(scene)
        if vtkCSLF.vtkCSLFSceneSource.HasScene(name):
            source = vtkCSLF.vtkCSLFSceneSource()
            source.SetSceneName(name)
            source.SetUpEnvironment(sampler.GetEnvironment())
            sampler.SetInputConnection(source.GetOutputPort())
            return False
        is_index = os.path.exists(name) and (name.lower().endswith(".pvd") or is_series(name))
        times = len(find_steps(name)) if is_index and not has_steps else 0
        if times > 1:
            warnings.warn(f"{name} has {times} times, of which the first one is "
                          "baked: time_steps bakes others.", stacklevel=find_caller())
        scene = StepSource(name) if has_steps and is_index else read(name)
    if isinstance(scene, vtkAlgorithm):
        look.source = scene  # which its port does not keep
        scene = scene.GetOutputPort()
    if isinstance(scene, vtkAlgorithmOutput):
        producer = scene.GetProducer()
        with Messages(producer) as messages:
            producer.Update(scene.GetIndex())
            if getattr(producer, "problem", None):
                raise producer.problem
            messages.require(True, "")
        check_data(producer.GetOutputDataObject(scene.GetIndex()))
        look.SetInputConnection(scene)
    elif isinstance(scene, vtkDataObject):
        check_data(scene)
        look.SetInputDataObject(scene)
    else:
        raise TypeError("A scene is a renderer, a window, a plotter, data, an algorithm or the "
                        f"name of a file, not a {type(scene).__name__}.")
    with Messages(look) as messages:
        look.Update()
    if messages.errors:
        raise_error(messages.errors[0], ValueError)
    sampler.SetInputConnection(look.GetOutputPort())
    return True
