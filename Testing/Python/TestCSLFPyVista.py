# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""plotter.cslf bakes what a plotter shows and adds light fields. Where PyVista is not installed,
a stand-in has the few names that cslf.pyvista uses of it."""
import importlib
import os
import sys
import types
import unittest

import cslf
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

try:
    import pyvista
except ImportError:
    pyvista = None


class StandInPlotter:
    """Like a plotter of PyVista before it was shown."""

    def __init__(self):
        self.renderer = vtkRenderer()
        self.renderer.camera_set = False
        self.render_window = vtkRenderWindow()
        self.render_window.OffScreenRenderingOn()
        self.render_window.AddRenderer(self.renderer)
        self.arguments = []

    def view_isometric(self):
        self.renderer.camera_set = True
        self.renderer.GetActiveCamera().SetPosition(1.0, 1.0, 1.0)
        self.renderer.ResetCamera()

    def add_actor(self, actor, **arguments):
        self.arguments.append(arguments)
        self.renderer.AddActor(actor)


def make_stand_in():
    module = types.ModuleType("pyvista")
    module.BasePlotter = type("BasePlotter", (StandInPlotter,), {})
    module.Plotter = type("Plotter", (module.BasePlotter,), {})
    module.wrap = lambda data: data
    return module


class TestCSLFPyVista(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.module = pyvista or make_stand_in()
        sys.modules["pyvista"] = cls.module
        importlib.import_module("cslf.pyvista")

    def make_plotter(self):
        """A plotter that shows a sphere."""
        source = vtkSphereSource()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        plotter = self.module.Plotter()
        plotter.add_actor(actor)
        return plotter

    def test_image(self):
        plotter = self.make_plotter()
        field = plotter.cslf.bake(viewpoints=3, resolution=16, samples=2, noise_target=0.1)
        self.assertTrue(plotter.renderer.camera_set)
        self.assertIsInstance(field, vtkImageData)
        self.assertEqual(field.GetDimensions(), (5 * 16, 16, 6 * 9))
        viewer = self.module.Plotter()
        actor = viewer.cslf.add_light_field(field, lookup="Nearest", name="field")
        self.assertTrue(viewer.renderer.HasViewProp(actor))
        self.assertEqual(actor.GetMapper().GetLookup(), cslf.vtkCSLFMapper.NEAREST)
        if not pyvista:
            self.assertEqual(viewer.arguments, [{"name": "field"}])

    @unittest.skipUnless(hasattr(cslf, "vtkCSLFEncoder"), "without the encoder")
    def test_video(self):
        name = "TestCSLFPyVista.mp4"
        sampler = cslf.vtkCSLFSampler()
        sampler.SetSamples(2)
        plotter = self.make_plotter()
        self.assertEqual(
            plotter.cslf.bake(name, viewpoints=3, resolution=16, crf=30.0, sampler=sampler), name)
        viewer = self.module.Plotter()
        self.assertEqual(viewer.cslf.add_light_field(name).GetClassName()[-5:], "Actor")
        for export in (viewer.cslf.export_html, viewer.cslf.export_gltf):
            self.assertEqual(export("exported", title="A sphere"), "exported")
            with open("exported", "rb") as file:
                self.assertIn(b"A sphere", file.read())
            os.remove("exported")
        if not pyvista:
            self.assertTrue(viewer.renderer.camera_set)
        with self.assertRaisesRegex(ValueError, "no light field"):
            plotter.cslf.export_html("exported")
        os.remove(name)

    def test_invalid(self):
        plotter = self.make_plotter()
        with self.assertRaises(ValueError):
            plotter.cslf.bake(crf=20.0)
        with self.assertRaisesRegex(FileNotFoundError, "nowhere"):
            plotter.cslf.bake("nowhere/field.mp4", viewpoints=2, resolution=8, samples=1)
        vtkImageData().GlobalWarningDisplayOff()
        try:
            with self.assertRaisesRegex(ValueError, "at least 16"):
                plotter.cslf.bake("small.mp4", viewpoints=2, resolution=8, samples=1)
            with self.assertRaises(ValueError):
                plotter.cslf.add_light_field(vtkImageData())
            with self.assertRaises(ValueError):
                plotter.cslf.add_light_field("missing.mp4", lookup="Best")
            with self.assertRaises(RuntimeError):
                self.module.Plotter().cslf.bake(viewpoints=2, resolution=8, samples=1)
        finally:
            vtkImageData().GlobalWarningDisplayOn()

    @unittest.skipIf(pyvista, "needs the stand-in")
    def test_registry(self):
        """Since 0.48 PyVista has its own registry."""
        names = {}
        self.module.register_plotter_component = lambda name: lambda kind: names.update({name: kind})
        try:
            importlib.reload(sys.modules["cslf.pyvista"])
        finally:
            del self.module.register_plotter_component
        self.assertEqual(list(names), ["cslf"])


if __name__ == "__main__":
    unittest.main()
