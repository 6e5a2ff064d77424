#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""glTF of a field's surfaces, plain and compressed: places, colours of both sides, colour maps as
texture, cameras; read again by itself and by VTK.

usage: TestCSLFGLTFExport.py UTILITIES FIELD   the folder of scripts, and a field without geometry
"""
import json
import math
import os
import sys

import cslf
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOImage import vtkPNGReader

sys.path.insert(0, sys.argv[1])
from read_geometry import Corners, read_attributes, to_linear  # noqa: E402

KINDS = {5122: "i2", 5123: "u2", 5125: "u4", 5126: "f4"}
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class File:
    """A .glb file: `text` is its JSON."""

    def __init__(self, name):
        with open(name, "rb") as file:
            data = file.read()
        magic, version, size, length, kind = numpy.frombuffer(data[:20], "<u4")
        assert (magic, version, size, kind) == (0x46546C67, 2, len(data), 0x4E4F534A)
        self.text = json.loads(data[20:20 + length])
        rest = data[20 + length:]
        assert numpy.frombuffer(rest[:8], "<u4").tolist() == [len(rest) - 8, 0x004E4942]
        self.bytes = rest[8:]
        assert self.text["buffers"][0]["byteLength"] == len(self.bytes)
        assert len(data) % 4 == 0 and length % 4 == 0

    def get_view(self, number):
        view = self.text["bufferViews"][number]
        coded = view.get("extensions", {}).get("EXT_meshopt_compression")
        if not coded:
            assert view["buffer"] == 0
            return self.bytes[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
        stream = self.bytes[coded["byteOffset"]:coded["byteOffset"] + coded["byteLength"]]
        count, size = coded["count"], coded["byteStride"]
        assert view["byteLength"] == count * size
        if coded["mode"] == "TRIANGLES":
            return numpy.array(Corners(stream, count // 3).corners, "<u4").tobytes()
        return read_attributes(stream, count, size).tobytes()

    def get(self, number):
        """The values of an accessor, of which normalised integers are numbers from -1 to 1."""
        accessor = self.text["accessors"][number]
        kind = numpy.dtype("<" + KINDS[accessor["componentType"]])
        view = self.text["bufferViews"][accessor["bufferView"]]
        size = COMPONENTS[accessor["type"]]
        stride = view.get("byteStride", size * kind.itemsize) // kind.itemsize
        values = numpy.frombuffer(self.get_view(accessor["bufferView"]), kind)
        values = values.reshape(accessor["count"], stride)[:, :size]
        if "min" in accessor:
            assert numpy.all(values.min(0) == numpy.array(accessor["min"]).astype(kind))
            assert numpy.all(values.max(0) == numpy.array(accessor["max"]).astype(kind))
        assert accessor["componentType"] != 5126 or numpy.all(numpy.isfinite(values))
        if accessor.get("normalized"):
            values = values / float(numpy.iinfo(kind).max)
        return values

    def list_primitives(self):
        """World positions, colours, texture coordinates or None, and corners of each."""
        mesh = self.text["nodes"][0]
        matrix = numpy.array(mesh.get("matrix", numpy.identity(4))).reshape(4, 4)  # its transpose
        for primitive in self.text["meshes"][mesh["mesh"]]["primitives"]:
            attributes = {key: self.get(number) for key, number in primitive["attributes"].items()}
            places = attributes["POSITION"] @ matrix[:3, :3] + matrix[3, :3]
            yield (places, attributes["COLOR_0"][:, :3], attributes.get("TEXCOORD_0"),
                   self.get(primitive["indices"]).reshape(-1, 3),
                   self.text["materials"][primitive["material"]])


def encode(linear):
    linear = numpy.clip(linear, 0.0, 1.0)
    return 255.0 * numpy.where(linear <= 0.0031308, 12.92 * linear,
                               1.055 * numpy.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


def expect(kind, call, text):
    try:
        call()
    except kind as error:
        assert text in str(error), error
    else:
        raise AssertionError(f"{text}: nothing is raised")
    assert not [name for name in os.listdir(".") if "none" in name]


def compare_files(plain, compact):
    """The same triangles, at the same places, in the same colours."""
    assert len(compact.bytes) < 0.5 * len(plain.bytes)
    for one, other in zip(plain.list_primitives(), compact.list_primitives()):
        assert numpy.abs(one[0] - other[0]).max() < 1e-4
        assert numpy.abs(encode(one[1]) - encode(other[1])).max() < 0.5
        # An index buffer's triangles may begin with any of their corners.
        turns = [numpy.roll(other[3], turn, 1) for turn in range(3)]
        assert numpy.all(numpy.any([numpy.all(one[3] == turn, 1) for turn in turns], 0))


# The Cornell box, which has colours of its own on both sides.
field = cslf.bake("cornell-box", viewpoints=2, resolution=32, quality="preview")
cslf.export_gltf(field, "box.glb", title="Box", position=(0.5, 0.6, 5.0))
box = File("box.glb")
assert box.text["extensionsUsed"] == ["KHR_materials_unlit"]
assert "extensionsRequired" not in box.text
assert box.text["nodes"][0]["name"] == "Box" and box.text["nodes"][0]["extras"]["leftOut"] == []
assert numpy.allclose(box.text["nodes"][1]["matrix"][12:15], [0.5, 0.6, 5.0])
assert math.isclose(box.text["cameras"][0]["perspective"]["yfov"], math.radians(40.0))
geometry = field.sampler.GetGeometry()
points = vtk_to_numpy(geometry.GetPoints().GetData())
sides = [vtk_to_numpy(geometry.GetPointData().GetArray(name))[:, :3].astype(float)
         for name in ("Color", "BackColor")]
exact = vtk_to_numpy(geometry.GetPointData().GetArray("ExactColor")).astype(float)
triangles = 0
for number, (places, colors, texture, corners, material) in enumerate(box.list_primitives()):
    assert texture is None and not material["doubleSided"]
    assert "KHR_materials_unlit" in material["extensions"]
    triangles += len(corners) if number == 0 else 0
    # A point of the geometry is there, with these colours, on one of the sides.
    brightness = 2.0 ** ((numpy.maximum(exact, 1.0) - 1.0) / 8.0)
    expected = [encode(to_linear(side / 255.0) * brightness[:, k:k + 1]) for k, side in enumerate(sides)]
    for place, color in zip(places, encode(colors)):
        near = numpy.abs(points - place).max(1) < 1e-5
        assert near.any(), place
        errors = [numpy.abs(side[near] - color).max(1).min() for side in expected]
        assert min(errors) < 0.6, (place, color, errors)
assert number == 1 and triangles == geometry.GetNumberOfCells()
cslf.export_gltf(field, "compact.glb", title="Box", compact=True)
assert "EXT_meshopt_compression" in File("compact.glb").text["extensionsRequired"]
compare_files(box, File("compact.glb"))

# VTK reads the plain file.
reader = vtkGLTFReader()
reader.SetFileName("box.glb")
reader.Update()
blocks = reader.GetOutput().NewIterator()
cells = 0
blocks.InitTraversal()
while not blocks.IsDoneWithTraversal():
    cells += blocks.GetCurrentDataObject().GetNumberOfCells()
    blocks.GoToNextItem()
assert cells >= triangles, cells

# A plane with a colour map of few colours, with what is no number, and another array.
plane = vtkPlaneSource()
plane.SetResolution(20, 20)
plane.Update()
data = plane.GetOutput()
x, y = vtk_to_numpy(data.GetPoints().GetData())[:, :2].astype(float).T
for name, values in (("x", numpy.where(y > 0.3, numpy.nan, x)), ("y", 2.0 * y)):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=1)
    array.SetName(name)
    data.GetPointData().AddArray(array)
table = vtkLookupTable()
table.SetNumberOfTableValues(4)
table.SetRange(-0.5, 0.5)
colors = [(0.1, 0.2, 0.8), (0.3, 0.7, 0.2), (0.9, 0.5, 0.1), (0.6, 0.1, 0.3)]
for number, color in enumerate(colors):
    table.SetTableValue(number, *color, 1.0)
table.SetNanColor(1.0, 1.0, 0.0, 1.0)
data.GetPointData().GetArray("x").SetLookupTable(table)
field = cslf.bake(data, color_by="x", arrays=["y"], viewpoints=2, resolution=32, quality="preview")


def list_base_colors(file):
    """Positions, and the texture's colour there, of the first primitive with a texture."""
    for places, _, texture, _, material in file.list_primitives():
        if texture is None:
            continue
        assert "baseColorTexture" in material["pbrMetallicRoughness"]
        image = file.text["images"][0]
        png = file.get_view(image["bufferView"])
        reader = vtkPNGReader()
        reader.SetMemoryBuffer(png)
        reader.SetMemoryBufferLength(len(png))
        reader.Update()
        width, height, _ = reader.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        pixels = pixels.reshape(height, width, -1)[::-1, :, :3]
        columns, rows = numpy.floor(texture * [width, height]).astype(int).T
        return places, pixels[numpy.clip(rows, 0, height - 1), numpy.clip(columns, 0, width - 1)]
    raise AssertionError("no primitive has a texture")


cslf.export_gltf(field, "map.glb")
places, shown = list_base_colors(File("map.glb"))
inner = numpy.abs((4.0 * (places[:, 0] + 0.5)) % 1.0 - 0.5) < 0.4
steps = numpy.clip((4.0 * (places[:, 0] + 0.5)).astype(int), 0, 3)
expected = 255.0 * numpy.where((places[:, 1] > 0.31)[:, None], (1.0, 1.0, 0.0),
                               numpy.array(colors)[steps])
inner &= numpy.abs(places[:, 1] - 0.3) > 0.06
assert inner.sum() > 20
assert numpy.abs(shown - expected)[inner].max() <= 1.0

# Shown in other colours, and by another array.
cslf.export_gltf(field, "other.glb", scalars="y", cmap="gray", clim=(-6.0, 6.0))
other = File("other.glb")
assert "textures" not in other.text, "points alone do not show a smooth map"
places, colors = next(other.list_primitives())[:2]
order = numpy.argsort(places[:, 1])
shown = encode(colors[order, 1])
assert shown[-10:].mean() > shown[:10].mean() + 15.0
cslf.export_gltf(field, "other-compact.glb", scalars="y", cmap="gray", clim=(-6.0, 6.0),
                 compact=True)
compare_files(other, File("other-compact.glb"))

# Fields without colours on surfaces, places that cannot be written, wrong arguments.
expect(cslf.Error, lambda: cslf.export_gltf(sys.argv[2], "none.glb"), "geometry")
expect(cslf.Error, lambda: cslf.export_gltf(field, "absent/none.glb"), "absent")
expect(TypeError, lambda: cslf.export_gltf(field, "none.glb", compact=7), "compact")
