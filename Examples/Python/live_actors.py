# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A light field among live actors: two golden rings come from one field, an ordinary ring is linked
with each, and a translucent plane cuts them all. The live ring turns, and the field is moved,
without being sampled again. Arguments: M N samples."""
import cslf
from example import make_actor, make_field_actor, read_sizes, save_picture, set_sizes
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource, vtkPlaneSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow


def make_ring(radius, thickness):
    """A ring around the z axis."""
    torus = vtkParametricTorus()
    torus.SetRingRadius(radius)
    torus.SetCrossSectionRadius(thickness)
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(torus)
    source.SetScalarModeToNone()
    source.SetUResolution(96)
    source.SetVResolution(48)
    return source


# The field: one ring of rough gold and nothing else.
ring = make_ring(1.0, 0.25)
ring.Update()
gold = ring.GetOutput()
cslf.vtkCSLFMaterial.SetBaseColor(gold, 1.0, 0.8, 0.4)
cslf.vtkCSLFMaterial.SetMetallic(gold, 1.0)
cslf.vtkCSLFMaterial.SetRoughness(gold, 0.5)
sampler = cslf.vtkCSLFSampler()
sampler.SetInputData(gold)
sampler.GetEnvironment().SetModeToGradient()
set_sizes(sampler, read_sizes(__doc__))

# Draw the field twice: it is sampled once and placed like any other actor.
renderer = vtkRenderer()
renderer.SetBackground(0.16, 0.18, 0.22)
left = make_field_actor(sampler)
right = vtkActor()
right.SetMapper(left.GetMapper())
left.SetPosition(-1.2, 0.0, 0.0)
right.SetPosition(1.2, 0.0, 0.0)
right.RotateY(-50.0)
right.SetScale(0.8)
renderer.AddActor(left)
renderer.AddActor(right)

# Live actors: a ring through both, and a plane that intersects both. Depth decides at each pixel.
live = make_actor(make_ring(1.2, 0.12))
live.GetProperty().SetColor(0.2, 0.7, 0.9)
live.GetProperty().SetSpecular(0.4)
live.GetProperty().SetSpecularPower(30.0)
renderer.AddActor(live)
plane = vtkPlaneSource()
plane.SetOrigin(-2.6, -0.35, -1.5)
plane.SetPoint1(2.6, -0.35, -1.5)
plane.SetPoint2(-2.6, -0.35, 1.5)
sheet = make_actor(plane)
sheet.GetProperty().SetColor(0.8, 0.3, 0.3)
sheet.GetProperty().SetOpacity(0.4)
renderer.AddActor(sheet)

renderer.GetActiveCamera().SetPosition(1.0, 2.6, 6.6)
window = vtkRenderWindow()
window.SetSize(960, 640)
window.AddRenderer(renderer)
for angle in (0.0, 30.0, 60.0):  # an animation of three pictures
    live.SetOrientation(70.0, angle / 4.0, 0.0)
    renderer.ResetCameraClippingRange()
    window.Render()
save_picture(window, "LiveActors.png")
print(f"{sampler.GetNumberOfRays()} rays were traced, none of them for the animation")
