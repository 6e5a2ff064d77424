# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A glTF file becomes a light field, lit by an image of the surroundings. The file is written here
by VTK's own exporter; any other .gltf or .glb file can be used. Arguments: M N samples."""
import math

import cslf
from example import make_actor, make_field_actor, read_sizes, save_picture, set_sizes
from vtkmodules.vtkCommonCore import VTK_FLOAT
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource, vtkSuperquadricSource
from vtkmodules.vtkIOExport import vtkGLTFExporter
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow


def write_scene(file_name):
    """Exports a plate with a ball and a ring on it, made of physically based materials."""
    plate = vtkCubeSource()
    plate.SetXLength(4.0)
    plate.SetYLength(0.2)
    plate.SetZLength(2.6)
    ball = vtkSphereSource()
    ball.SetRadius(0.7)
    ball.SetThetaResolution(48)
    ball.SetPhiResolution(24)
    ring = vtkSuperquadricSource()
    ring.ToroidalOn()
    ring.SetThetaResolution(32)
    ring.SetPhiResolution(32)
    ring.SetThickness(0.5)
    ring.SetSize(0.8)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(ring.GetOutputPort())
    scene = vtkRenderer()
    for source, place, color, metallic, roughness in (
            (plate, (0.0, -0.1, 0.0), (0.5, 0.42, 0.36), 0.0, 0.8),
            (ball, (-1.0, 0.7, 0.1), (1.0, 0.78, 0.35), 1.0, 0.25),
            (normals, (1.0, 0.28, -0.1), (0.1, 0.35, 0.6), 0.0, 0.5)):
        actor = make_actor(source)
        actor.SetPosition(place)
        if source is normals:
            actor.RotateX(90.0)
        actor.GetMapper().ScalarVisibilityOff()
        actor.GetProperty().SetInterpolationToPBR()
        actor.GetProperty().SetColor(color)
        actor.GetProperty().SetMetallic(metallic)
        actor.GetProperty().SetRoughness(roughness)
        scene.AddActor(actor)
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.AddRenderer(scene)
    window.Render()
    exporter = vtkGLTFExporter()
    exporter.SetRenderWindow(window)
    exporter.InlineDataOn()
    exporter.SetFileName(file_name)
    exporter.Write()


def make_surroundings(width=64, height=32):
    """A sky with a bright window, as linear radiance: columns are longitudes, rows latitudes."""
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.AllocateScalars(VTK_FLOAT, 3)
    for y in range(height):
        up = math.sin((y + 0.5 - height / 2) / height * math.pi)
        for x in range(width):
            color = [0.35 + 0.25 * up, 0.4 + 0.3 * up, 0.5 + 0.4 * up]
            if up < 0.0:
                color = [0.12, 0.1, 0.09]
            if 0.3 < up < 0.8 and 40 <= x < 48:
                color = [6.0, 5.3, 4.3]
            for component, value in enumerate(color):
                image.SetScalarComponentFromDouble(x, y, 0, component, value)
    return image


write_scene("GLTFScene.gltf")
reader = cslf.vtkCSLFGLTFReader()
reader.SetFileName("GLTFScene.gltf")
reader.Update()
scene = reader.GetOutput()

# Light travels with the data. The image's middle column is in the direction +X, its top in +Y.
up, right = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
cslf.vtkCSLFLight.SetEnvironmentImage(scene, make_surroundings(), up, right)
sampler = cslf.vtkCSLFSampler()
sampler.SetInputData(scene)
sampler.GetCacheOptions().SetSamples(128)  # few are enough for smooth light
set_sizes(sampler, read_sizes(__doc__))

renderer = vtkRenderer()
renderer.SetBackground(0.45, 0.5, 0.58)
renderer.AddActor(make_field_actor(sampler))
renderer.GetActiveCamera().SetPosition(1.5, 3.2, 7.5)
renderer.GetActiveCamera().SetFocalPoint(0.0, 0.35, 0.0)
renderer.ResetCameraClippingRange()
window = vtkRenderWindow()
window.SetSize(960, 640)
window.AddRenderer(renderer)
save_picture(window, "GLTFScene.png")
