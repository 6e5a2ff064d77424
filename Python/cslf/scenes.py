# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What can be baked: windows and their renderers, data, algorithms and files."""

import errno
import os
import pathlib
from xml.etree import ElementTree

from vtkmodules.vtkCommonDataModel import (vtkCompositeDataSet, vtkDataObject, vtkDataSet,
                                           vtkMultiBlockDataSet)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from . import vtkCSLF
from .messages import Error, Messages, raise_error

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


def read_collection(name):
    """The files of a collection's first time step, as blocks."""
    sets = list(ElementTree.parse(name).iter("DataSet"))
    first = min((float(entry.get("timestep", 0)) for entry in sets), default=0.0)
    blocks = vtkMultiBlockDataSet()
    for entry in sets:
        if float(entry.get("timestep", 0)) == first:
            file = entry.get("file", "")
            if file.lower().endswith(".pvd"):
                raise ValueError(f"its part {file} is a collection, too")
            part = read(os.path.join(os.path.dirname(name), file))
            blocks.SetBlock(blocks.GetNumberOfBlocks(), part)
    return blocks


def read(name):
    """Reads a scene's file. Raises FileNotFoundError, ValueError for other kinds of files, and
    cslf.Error if it cannot be read."""
    if not os.path.exists(name):
        raise missing_file(name)
    kind = pathlib.PurePath(name).suffix.lower()
    if kind == ".pvd":
        try:
            return read_collection(name)
        except (ElementTree.ParseError, ValueError) as error:
            raise Error(f"Cannot read {name}: {error}.") from error
    reader = READERS.get(kind)
    if kind in VIDEOS:
        raise ValueError(f"{name} is a light field, not a scene.")
    if reader is None:
        raise ValueError(f"{name} is not a scene: supported are "
                         f"{', '.join(sorted([*READERS, '.pvd']))}.")
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


def connect(scene, sampler, look):
    """Makes a scene the input of a sampler, through a ``vtkCSLFSceneLook`` if its colours and light
    are not its own. Returns whether that is so."""
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
        scene = read(name)
    if isinstance(scene, vtkAlgorithm):
        scene = scene.GetOutputPort()
    if isinstance(scene, vtkAlgorithmOutput):
        producer = scene.GetProducer()
        with Messages(producer) as messages:
            producer.Update(scene.GetIndex())
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
