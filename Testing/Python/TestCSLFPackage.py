# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The package cslf works beside vtkmodules: a sphere is sampled, its samples are read, and it is
drawn."""
import json
import sys
import unittest

import cslf
from cslf import (make_actor, vtkCSLFMapper, vtkCSLFMaterial, vtkCSLFSampler,
                  vtkCSLFSceneSource)
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError:  # without numpy
    vtk_to_numpy = None

CMAKE_LISTS = sys.argv.pop()  # of the project
VIEWPOINTS = 3
RESOLUTION = 32
SLICES = 6 * VIEWPOINTS**2


def make_sampler():
    """A sampler of a black sphere that emits orange light."""
    source = vtkSphereSource()
    source.SetThetaResolution(32)
    source.SetPhiResolution(32)
    source.Update()
    sphere = source.GetOutput()
    vtkCSLFMaterial.SetBaseColor(sphere, 0.0, 0.0, 0.0)
    vtkCSLFMaterial.SetEmission(sphere, 1.0, 0.5, 0.0)
    sampler = vtkCSLFSampler()
    sampler.SetInputData(sphere)
    sampler.SetViewpoints(VIEWPOINTS)
    sampler.SetResolution(RESOLUTION)
    sampler.SetSamples(4)
    sampler.GetEnvironment().SetModeToNone()
    return sampler


class TestCSLFPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sampler = make_sampler()
        cls.sampler.Update()
        cls.field = cls.sampler.GetOutput()

    def test_sampler(self):
        self.assertEqual(self.field.GetDimensions(), (5 * RESOLUTION, RESOLUTION, SLICES))
        color = self.field.GetPointData().GetArray("Color")
        depth = self.field.GetPointData().GetArray("Depth")
        self.assertEqual(color.GetDataType(), VTK_UNSIGNED_CHAR)
        self.assertEqual(color.GetNumberOfComponents(), 4)
        self.assertEqual(depth.GetDataType(), VTK_UNSIGNED_SHORT)
        text = self.field.GetFieldData().GetAbstractArray("CSLF").GetValue(0)
        description = json.loads(text)
        self.assertEqual(description["resolution"], RESOLUTION)
        self.assertEqual(description["nodes"], list(range(VIEWPOINTS)))

    def test_ports(self):
        self.assertGreater(self.sampler.GetGeometry().GetNumberOfPolys(), 0)
        sampler = make_sampler()
        sampler.SetGeometryTriangles(0)
        sampler.Update()
        self.assertEqual(sampler.GetGeometry().GetNumberOfPolys(), 0)

    def test_partial_request(self):
        sampler = make_sampler()
        sampler.UpdateExtent((0, 5 * RESOLUTION - 1, 0, RESOLUTION - 1, 3, 3))
        self.assertEqual(sampler.GetOutput().GetExtent()[4:], (3, 3))
        actor = make_actor(sampler)
        self.assertLess(actor.GetBounds()[0], actor.GetBounds()[1])

    def test_names(self):
        """The version, and what Python's help shows of setters of named values."""
        with open(CMAKE_LISTS, encoding="utf-8") as file:
            self.assertIn(f"project(CSLF VERSION {cslf.__version__} ", file.read())
        names = set(dir(cslf)) - {name for name in dir(cslf) if name.startswith("vtkCSLF")}
        self.assertEqual(names, {"Error", "LightField", "Picture", "__version__", "bake",
                                 "capture", "export_gltf", "export_html", "make_actor", "show"})
        self.assertIn("vtkCSLFSampler", cslf.__all__)
        setters = 0
        for kind in vars(cslf.vtkCSLF).values():
            for name, method in vars(kind).items() if isinstance(kind, type) else ():
                if name.startswith("Set") and "To" in name and f"{name}(self)" in method.__doc__:
                    setters += 1
                    self.assertRegex(method.__doc__, r"C\+\+: .*\n\n\w", f"{kind} {name}")
        self.assertGreater(setters, 20)

    def test_clamp(self):
        """Numbers outside of a parameter's range."""
        for name, value, used in (("Viewpoints", 1, 2), ("Quality", 99, 2), ("Integrator", -1, 0),
                                  ("NoiseTarget", 2.0, 1.0), ("Offset", float("nan"), 0.05)):
            sampler = vtkCSLFSampler()
            messages = []
            sampler.AddObserver("WarningEvent", lambda *_: messages.append(True))
            getattr(sampler, f"Set{name}")(used)
            self.assertEqual(messages, [], name)
            getattr(sampler, f"Set{name}")(value)
            self.assertEqual(messages, [True], name)
            self.assertEqual(getattr(sampler, f"Get{name}")(), used)

    def test_scenes(self):
        names = [vtkCSLFSceneSource.GetSceneName(i)
                 for i in range(vtkCSLFSceneSource.GetNumberOfScenes())]
        self.assertIn("isosurfaces", names)
        source = vtkCSLFSceneSource()
        source.SetSceneName("pipes")
        source.Update()
        self.assertEqual(source.GetOutput().GetNumberOfBlocks(), 9)

    @unittest.skipIf(vtk_to_numpy is None, "numpy is not installed")
    def test_numpy(self):
        color = vtk_to_numpy(self.field.GetPointData().GetArray("Color"))
        depth = vtk_to_numpy(self.field.GetPointData().GetArray("Depth"))
        color = color.reshape(SLICES, RESOLUTION, 5, RESOLUTION, 4)
        depth = depth.reshape(SLICES, RESOLUTION, 5, RESOLUTION)
        # The middle of face +X, z = 4, sees the sphere in the middle of face -X, its first tile.
        middle = (4, RESOLUTION // 2, 0, RESOLUTION // 2)
        self.assertEqual(color[middle].tolist(), [255, 188, 0, 255])
        nearest = 0.5 - 0.5 / 1.1  # radius 0.5 in a cube whose edge is 1.1
        self.assertAlmostEqual(depth[middle] / 65535.0, nearest, delta=0.005)
        # The corner of face +X, z = 0, lies on face +Y, its second tile, and looks along it.
        self.assertFalse(color[0, :, 1].any())

    def test_mapper(self):
        mapper = vtkCSLFMapper()
        mapper.SetInputData(self.field)
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer = vtkRenderer()
        renderer.SetBackground(0.0, 0.0, 1.0)
        renderer.AddActor(actor)
        renderer.GetActiveCamera().SetPosition(0.0, 0.0, 2.5)
        renderer.ResetCameraClippingRange()
        window = vtkRenderWindow()
        window.SetSize(100, 100)
        window.AddRenderer(renderer)
        picture = vtkWindowToImageFilter()
        picture.SetInput(window)
        picture.Update()
        pixel = [picture.GetOutput().GetScalarComponentAsDouble(50, 50, 0, c) for c in range(3)]
        # There are few viewpoints: some see the point at silhouettes.
        for value, expected in zip(pixel, [255.0, 188.0, 0.0]):
            self.assertAlmostEqual(value, expected, delta=10.0)
        corner = [picture.GetOutput().GetScalarComponentAsDouble(0, 0, 0, c) for c in range(3)]
        self.assertEqual(corner, [0.0, 0.0, 255.0])


if __name__ == "__main__":
    unittest.main()
