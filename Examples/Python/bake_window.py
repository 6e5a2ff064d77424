# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A window becomes a light field: what a renderer shows (actors with properties, a texture, a
lookup table, lights) is sampled, and drawn again from the field. Arguments: M N samples."""
import cslf
from example import make_actor, make_field_actor, read_sizes, save_picture, set_sizes
from vtkmodules.vtkFiltersCore import vtkElevationFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource, vtkSuperquadricSource
from vtkmodules.vtkImagingSources import vtkImageCanvasSource2D
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTexture)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws the window

renderer = vtkRenderer()
renderer.SetBackground(0.2, 0.22, 0.28)


def show(source):
    """Adds an actor for the output of a source."""
    actor = make_actor(source)
    renderer.AddActor(actor)
    return actor


# A floor with a checkered texture.
checker = vtkImageCanvasSource2D()
checker.SetScalarTypeToUnsignedChar()
checker.SetNumberOfScalarComponents(3)
checker.SetExtent(0, 7, 0, 7, 0, 0)
for row in range(8):
    for column in range(8):
        checker.SetDrawColor(*((230, 220, 200) if (row + column) % 2 else (70, 80, 100)))
        checker.DrawPoint(column, row)
texture = vtkTexture()
texture.SetInputConnection(checker.GetOutputPort())
plane = vtkPlaneSource()
plane.SetOrigin(-2.2, -1.5, 0.0)
plane.SetPoint1(2.2, -1.5, 0.0)
plane.SetPoint2(-2.2, 1.5, 0.0)
show(plane).SetTexture(texture)

# A ball of brushed gold, and one of glass: VTK has no refraction, so the data defines the glass.
ball = vtkSphereSource()
ball.SetRadius(0.5)
ball.SetThetaResolution(96)
ball.SetPhiResolution(48)
gold = show(ball)
gold.SetPosition(-1.3, 0.2, 0.5)
gold.GetProperty().SetInterpolationToPBR()
gold.GetProperty().SetColor(1.0, 0.85, 0.5)
gold.GetProperty().SetMetallic(1.0)
gold.GetProperty().SetRoughness(0.3)

ball.Update()
clear = ball.GetOutput().NewInstance()
clear.DeepCopy(ball.GetOutput())
cslf.vtkCSLFMaterial.SetTransmission(clear, 1.0)
cslf.vtkCSLFMaterial.SetIndexOfRefraction(clear, 1.5)
cslf.vtkCSLFMaterial.SetRoughness(clear, 0.0)
glassMapper = vtkPolyDataMapper()
glassMapper.SetInputData(clear)
glass = vtkActor()
glass.SetMapper(glassMapper)
glass.SetPosition(0.0, -0.5, 0.5)
glass.GetProperty().SetColor(0.9, 1.0, 0.95)
cslf.vtkCSLFMaterial.SetBaseColor(clear, 0.9, 1.0, 0.95)
renderer.AddActor(glass)

# Scalars through a lookup table.
shape = vtkSuperquadricSource()
shape.ToroidalOn()
shape.SetThetaResolution(64)
shape.SetPhiResolution(64)
elevation = vtkElevationFilter()
elevation.SetInputConnection(shape.GetOutputPort())
elevation.SetLowPoint(0.0, 0.0, -0.3)
elevation.SetHighPoint(0.0, 0.0, 0.3)
ring = show(elevation)
ring.RotateX(70.0)
ring.SetPosition(1.2, 0.4, 0.6)
ring.GetMapper().InterpolateScalarsBeforeMappingOn()

# A light in the scene, in addition to the one at the camera.
lamp = vtkLight()
lamp.SetLightTypeToSceneLight()
lamp.PositionalOn()
lamp.SetPosition(-2.0, -3.0, 4.0)
lamp.SetConeAngle(90.0)
lamp.SetIntensity(0.7)
head = vtkLight()
head.SetLightTypeToHeadlight()
head.SetIntensity(0.4)
renderer.AddLight(lamp)
renderer.AddLight(head)

# The light field of this scene.
sampler = cslf.vtkCSLFSampler()
sampler.SetRenderer(renderer)
set_sizes(sampler, read_sizes(__doc__))

# The window on the left, the field on the right.
field = make_field_actor(sampler)
second = vtkRenderer()
second.SetBackground(renderer.GetBackground())
second.AddActor(field)
camera = renderer.GetActiveCamera()
camera.SetViewUp(0.0, 0.0, 1.0)
camera.SetPosition(0.5, -7.0, 4.0)
camera.SetFocalPoint(0.0, 0.0, 0.4)
renderer.ResetCameraClippingRange()
second.SetActiveCamera(camera)
renderer.SetViewport(0.0, 0.0, 0.5, 1.0)
second.SetViewport(0.5, 0.0, 1.0, 1.0)

window = vtkRenderWindow()
window.SetSize(960, 400)
window.AddRenderer(renderer)
window.AddRenderer(second)
save_picture(window, "BakeWindow.png")
