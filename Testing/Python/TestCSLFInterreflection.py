#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light between surfaces with a colour map: with neutral interreflection it has no colour, and is as
bright as grey surfaces of the same mean albedo make it."""
import json
import warnings

import cslf
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource

RED = (0.9, 0.1, 0.1)  # sRGB-encoded
LUMINANCE = (0.2126, 0.7152, 0.0722)


def to_linear(code):
    return code / 12.92 if code <= 0.04045 else ((code + 0.055) / 1.055) ** 2.4


def make_corner():
    """Two squares at a right angle, open to the light, with scalars."""
    append = vtkAppendPolyData()
    sources = []
    for point1, point2 in (((1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1))):
        plane = vtkPlaneSource()
        plane.SetOrigin(0, 0, 0)
        plane.SetPoint1(point1)
        plane.SetPoint2(point2)
        plane.SetResolution(8, 8)
        sources.append(plane)
        append.AddInputConnection(plane.GetOutputPort())
    append.Update()
    data = append.GetOutput()
    array = numpy_to_vtk(vtk_to_numpy(data.GetPoints().GetData())[:, 2].astype(float), deep=1)
    array.SetName("z")
    data.GetPointData().AddArray(array)
    return data


def make_table(color):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(2)
    table.SetTableRange(0.0, 1.0)
    for index in range(2):
        table.SetTableValue(index, *color, 1.0)
    return table


def bake(color, **arguments):
    """The mean light on the points, and what the field says of its sampling."""
    data = make_corner()
    data.GetPointData().GetArray("z").SetLookupTable(make_table(color))
    field = cslf.bake(data, color_by="z", light="white", viewpoints=2, resolution=32,
                      quality="preview", **arguments)
    light = vtk_to_numpy(field.sampler.GetGeometry().GetPointData().GetArray("CSLF:Light"))
    description = json.loads(field.image.GetFieldData().GetAbstractArray("CSLF").GetValue(0))
    return light.astype(float), description["sampling"]


def find_tint(light):
    return numpy.abs(light - light.mean(1, keepdims=True)).max() / light.mean()


colored, sampling = bake(RED)
assert "interreflection" not in sampling
assert find_tint(colored) > 0.05, "red surfaces reflect white light"
neutral, sampling = bake(RED, interreflection="neutral")
assert sampling["interreflection"] == "neutral"
assert find_tint(neutral) < 1e-3, find_tint(neutral)
albedo = numpy.dot(LUMINANCE, [to_linear(code) for code in RED])
gray = 1.055 * albedo ** (1 / 2.4) - 0.055
same = bake((gray, gray, gray))[0]
print(f"tint {find_tint(colored):.3f}, neutral {find_tint(neutral):.5f}, "
      f"means {neutral.mean():.4f}, gray {same.mean():.4f}")
assert abs(neutral.mean() - same.mean()) < 0.005 * same.mean()

# Path tracing cannot, and says so; unknown names are refused.
sampler = cslf.vtkCSLFSampler()
sampler.SetIntegratorToPathTracing()
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    bake_arguments = {"sampler": sampler, "interreflection": "neutral", "samples": 1}
    cslf.bake(make_corner(), viewpoints=2, resolution=16, **bake_arguments)
assert any("only with radiance caching" in str(each.message) for each in caught), caught
try:
    cslf.bake("cornell-box", interreflection="grey")
except ValueError as error:
    assert "neutral" in str(error)
else:
    raise AssertionError("an unknown name is accepted")
