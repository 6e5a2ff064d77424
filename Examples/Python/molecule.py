# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A molecule of balls and sticks becomes a light field: buckminsterfullerene, C60, as glyphs of a
vtkGlyph3DMapper, of which one ball and one stick are kept, however many there are. Arguments: M N
samples."""
import itertools
import math

import cslf
from example import make_field_actor, read_sizes, save_picture, set_sizes
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkGlyph3DMapper, vtkRenderer, vtkRenderWindow)

# The atoms of C60 are the corners of a truncated icosahedron of edge 2.
GOLDEN = (1.0 + math.sqrt(5.0)) / 2.0
FORMS = [(0.0, 1.0, 3.0 * GOLDEN), (1.0, 2.0 + GOLDEN, 2.0 * GOLDEN),
         (GOLDEN, 2.0, 2.0 * GOLDEN + 1.0)]
atoms = sorted({tuple(s * v for s, v in zip(signs, form[k:] + form[:k]))
                for form in FORMS for k in range(3)
                for signs in itertools.product((-1.0, 1.0), repeat=3)
                if all(s > 0 or v != 0.0 for s, v in zip(signs, form[k:] + form[:k]))})
bonds = [(a, b) for a, b in itertools.combinations(atoms, 2) if math.dist(a, b) < 2.01]
print(f"{len(atoms)} atoms, {len(bonds)} bonds")


def make_points(places, name, values):
    """Points at given positions, each with a tuple of values."""
    points = vtkPoints()
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(len(values[0]))
    for place, value in zip(places, values):
        points.InsertNextPoint(place)
        array.InsertNextTuple(value)
    data = vtkPolyData()
    data.SetPoints(points)
    data.GetPointData().AddArray(array)
    return data


def add_glyphs(renderer, data, source):
    """Shows a source at each point; returns the actor's mapper."""
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(source.GetOutputPort())
    mapper.ScalingOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.55, 0.55, 0.55)
    renderer.AddActor(actor)
    return mapper


# Balls, coloured by their height.
renderer = vtkRenderer()
ball = vtkSphereSource()
ball.SetRadius(0.62)
ball.SetThetaResolution(24)
ball.SetPhiResolution(16)
colors = vtkLookupTable()
colors.SetHueRange(0.6, 0.05)
colors.SetSaturationRange(0.75, 0.75)
balls = add_glyphs(renderer, make_points(atoms, "height", [(z,) for _, _, z in atoms]), ball)
balls.SetLookupTable(colors)
balls.SetScalarModeToUsePointFieldData()
balls.SelectColorArray("height")
balls.SetScalarRange(-5.0, 5.0)

# Sticks, rotated along the bonds: glyphs point along x.
cylinder = vtkCylinderSource()
cylinder.SetRadius(0.22)
cylinder.SetHeight(2.0)
cylinder.SetResolution(16)
turn = vtkTransform()
turn.RotateZ(-90.0)
stick = vtkTransformPolyDataFilter()
stick.SetInputConnection(cylinder.GetOutputPort())
stick.SetTransform(turn)
middles = [[0.5 * (p + q) for p, q in zip(a, b)] for a, b in bonds]
directions = [[q - p for p, q in zip(a, b)] for a, b in bonds]
sticks = add_glyphs(renderer, make_points(middles, "direction", directions), stick)
sticks.SetOrientationArray("direction")
sticks.SetOrientationModeToDirection()
sticks.ScalarVisibilityOff()

# The scene of the renderer as a light field; its headlight becomes light from all around.
sampler = cslf.vtkCSLFSampler()
sampler.SetRenderer(renderer)
set_sizes(sampler, read_sizes(__doc__))

view = vtkRenderer()
view.SetBackground(0.12, 0.13, 0.16)
view.AddActor(make_field_actor(sampler))
view.GetActiveCamera().SetPosition(9.0, 7.0, 24.0)
view.ResetCameraClippingRange()
window = vtkRenderWindow()
window.SetSize(640, 640)
window.AddRenderer(view)
save_picture(window, "Molecule.png")
