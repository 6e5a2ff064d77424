# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""cslf.bake takes scenes of all kinds, reports progress, and raises exceptions with the reason."""
import contextlib
import io
import os
import sys
import tempfile
import unittest

import cslf
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData, vtkTable
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow)

SIZE = {"viewpoints": 2, "resolution": 16, "quality": "preview"}
FIELD = sys.argv.pop()  # a light field
HAS_ENCODER = hasattr(cslf, "vtkCSLFEncoder")


def make_sphere():
    source = vtkSphereSource()
    source.Update()
    return source


def make_renderer():
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(make_sphere().GetOutput())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    return renderer


def make_heat(values, table=None):
    """A sphere with active scalars that a function of the height makes, and a table for them."""
    sphere = vtkPolyData()
    sphere.ShallowCopy(make_sphere().GetOutput())
    heat = vtkFloatArray()
    heat.SetName("heat")
    for i in range(sphere.GetNumberOfPoints()):
        heat.InsertNextValue(values(sphere.GetPoint(i)[1]))
    heat.SetLookupTable(table)
    sphere.GetPointData().SetScalars(heat)
    return sphere


def get_colors(field):
    """The colours of the texels that a surface covers."""
    colors = field.image.GetPointData().GetArray("Color")
    tuples = (colors.GetTuple4(i) for i in range(colors.GetNumberOfTuples()))
    return [color[:3] for color in tuples if color[3] == 255]


def get_mean(colors):
    return [sum(channel) / len(colors) for channel in zip(*colors)]


class TestCSLFBake(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder.name)

    def check(self, scene, edges):
        """Bakes a scene and checks its cube."""
        field = cslf.bake(scene, **SIZE)
        self.assertEqual(field.image.GetDimensions(), (5 * 16, 16, 6 * 4))
        bounds = cslf.make_actor(field, "Depth").GetBounds()
        for axis in range(3):
            self.assertAlmostEqual(bounds[2 * axis + 1] - bounds[2 * axis], edges, places=2)
        return field

    def test_scenes(self):
        source = make_sphere()
        self.check(source, 1.1)
        self.check(source.GetOutputPort(), 1.1)
        self.check(source.GetOutput(), 1.1)
        renderer = make_renderer()
        self.check(renderer, 1.1)
        window = vtkRenderWindow()
        window.AddRenderer(renderer)
        window.AddRenderer(vtkRenderer())  # shows nothing
        self.check(window, 1.1)
        self.check("cornell-box", 2.2)

    def test_colors(self):
        """Exact colours are those of the data, without light."""
        for colors, expected in (("lit", 0), ("exact", 1)):
            field = cslf.bake(make_sphere(), colors=colors, **SIZE)
            self.assertEqual(field.sampler.GetColors(), expected)

    def test_look(self):
        """Data without a look gets that of the tool."""
        field = cslf.bake(make_heat(lambda _: 7.0), **SIZE)  # colours nothing
        colors = get_colors(field)
        self.assertEqual({color for color in colors if max(color) - min(color) > 2}, set())
        brightness = [color[1] for color in colors]
        self.assertGreater(max(brightness) - min(brightness), 60)  # light from one side
        plain = make_heat(lambda _: 7.0)
        plain.GetPointData().SetActiveScalars(None)
        self.assertEqual(get_colors(cslf.bake(plain, **SIZE)), colors)
        white = get_colors(cslf.bake(plain, light="white", **SIZE))
        brightness = [color[1] for color in white]
        self.assertLess(max(brightness) - min(brightness), 10)
        environment = cslf.bake(plain, light="sun", up="z", **SIZE).sampler.GetEnvironment()
        self.assertEqual(environment.GetUp(), (0.0, 0.0, 1.0))

    def test_look_colors(self):
        exact = {"colors": "exact", **SIZE}
        data = make_heat(lambda height: height)
        red, _, blue = zip(*get_colors(cslf.bake(data, **exact)))
        self.assertGreater(min(max(red), max(blue)), 170)  # the ends of cool-to-warm
        self.assertIsNone(data.GetPointData().GetScalars().GetLookupTable())
        for arguments, expected in (
                ({"color_range": (-4.0, 4.0)}, (128, 128, 128)),
                ({"color_range": (-9.0, -8.0)}, (255, 255, 255)),
                ({"color_by": "Normals:magnitude", "color_range": [1, 2]}, (0, 0, 0))):
            with self.subTest(arguments=arguments):
                field = cslf.bake(data, color_map="gray", **arguments, **exact)
                for channel, value in zip(get_mean(get_colors(field)), expected):
                    self.assertAlmostEqual(channel, value, delta=8)
        gray = get_mean(get_colors(cslf.bake(data, color_by="none", **exact)))
        self.assertAlmostEqual(gray[0], gray[2], delta=1)
        table = vtkLookupTable()
        table.SetHueRange(0.3333, 0.3333)
        self.assertLess(max(color[0] for color in get_colors(
            cslf.bake(make_heat(lambda height: height, table), **exact))), 5)

    def test_look_connected(self):
        """The pipeline stays connected, and a sampler's own environment is kept."""
        source = make_sphere()
        runs = []
        source.AddObserver("StartEvent", lambda *_: runs.append(True))
        sampler = cslf.vtkCSLFSampler()
        sampler.GetEnvironment().SetColor(0.5, 0.0, 0.0)
        field = cslf.bake(source, sampler=sampler, **SIZE)
        self.assertEqual(runs, [])  # it was up to date
        self.assertEqual({color[1] for color in get_colors(field)}, {0})
        source.SetRadius(1.0)
        sampler.Update()
        self.assertAlmostEqual(cslf.make_actor(field, "Depth").GetBounds()[1], 1.1, places=2)
        self.assertAlmostEqual(field.actor.GetBounds()[1], 1.0, places=1)  # that of the sphere
        cslf.bake(source, sampler=sampler, light="sky", **SIZE)
        self.assertEqual(sampler.GetEnvironment().GetColor(), (1.0, 1.0, 1.0))
        lit = make_sphere().GetOutput()
        cslf.vtkCSLFLight.AddDirectionalLight(lit, (0.0, -1.0, 0.0), (1.0, 1.0, 1.0))
        environment = cslf.bake(lit, **SIZE).sampler.GetEnvironment()
        self.assertEqual(environment.GetColor(), (0.5, 0.5, 0.5))

    def test_grids(self):
        """Their surfaces are baked."""
        grid = vtkRTAnalyticSource()
        self.check(grid, 22.0)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, grid.GetOutput())
        blocks.SetBlock(1, make_sphere().GetOutput())
        self.check(blocks, 22.0)

    def test_files(self):
        for writer, name in ((vtkXMLPolyDataWriter(), "sphere.vtp"),
                             (vtkSTLWriter(), "sphere.stl")):
            writer.SetInputData(make_sphere().GetOutput())
            writer.SetFileName(name)
            writer.Write()
            self.check(name, 1.1)
        with open("sphere.pvd", "w", encoding="utf-8") as file:
            file.write('<VTKFile type="Collection"><Collection>'
                       '<DataSet timestep="0" file="sphere.vtp"/>'
                       '<DataSet timestep="1" file="later.vtp"/></Collection></VTKFile>')
        self.check("sphere.pvd", 1.1)

    @unittest.skipUnless(HAS_ENCODER, "without the encoder")
    def test_video(self):
        field = cslf.bake(make_sphere(), "sphere.mp4", **SIZE)
        self.assertEqual((field.file_name, field.image), ("sphere.mp4", None))
        field.save("copy.mp4")
        shown = field.show(size=(60, 60)).png
        self.assertEqual(field._repr_png_()[:8], shown[:8])
        self.assertEqual(cslf.show(field, size=(60, 60)).png, shown)
        self.assertEqual(cslf.show("copy.mp4", size=(60, 60)).png, shown)
        memory = cslf.bake(make_sphere(), **SIZE)
        memory.save("memory.mp4")
        with open("sphere.mp4", "rb") as first, open("memory.mp4", "rb") as second:
            self.assertEqual(first.read(), second.read())

    def test_image_data(self):
        field = cslf.bake(make_sphere(), **SIZE)
        field.save("sphere.vti")
        self.assertEqual(cslf.show("sphere.vti", lookup="Depth").png,
                         cslf.show(field.image, lookup="Depth").png)

    @unittest.skipUnless(HAS_ENCODER, "without the encoder")
    def test_used_again(self):
        """What a sampler has made is written, not sampled again, at the quality of the sampler."""
        sampler = cslf.vtkCSLFSampler()
        sampler.SetInputData(make_sphere().GetOutput())
        sampler.SetViewpoints(5)
        sampler.SetResolution(16)
        sampler.SetQualityToPreview()
        sampler.Update()
        runs = []
        sampler.AddObserver("StartEvent", lambda *_: runs.append(True))
        encoder = cslf.vtkCSLFEncoder()
        encoder.SetInputConnection(0, sampler.GetOutputPort(0))
        encoder.SetInputConnection(1, sampler.GetOutputPort(1))
        self.assertEqual(encoder.GetUsedPreset(), "ultrafast")
        encoder.SetFileName("used.mp4")
        self.assertEqual(encoder.Write(), 1)
        self.assertEqual(runs, [])
        sampler.SetSeed(1)  # the samples are out of date
        encoder.SetFileName("new.mp4")
        self.assertEqual(encoder.Write(), 1)
        self.assertGreater(len(runs), 0)
        encoder.SetPreset("fast")
        self.assertEqual(encoder.GetUsedPreset(), "fast")
        sampler.SetQualityToGood()
        encoder.SetPreset("auto")
        self.assertEqual(encoder.GetUsedPreset(), "slow")

    def test_progress(self):
        calls = []
        cslf.bake(make_sphere(), progress=lambda *call: calls.append(call), **SIZE)
        shares = [share for _, share in calls]
        self.assertEqual((shares, shares[-1]), (sorted(shares), 1.0))
        self.assertTrue(all(isinstance(phase, str) and phase for phase, _ in calls))
        # Tests are neither terminals nor notebooks.
        text = io.StringIO()
        with contextlib.redirect_stderr(text):
            cslf.bake(make_sphere(), **SIZE)
            self.assertEqual(text.getvalue(), "")
            cslf.bake(make_sphere(), progress=True, **SIZE)
        self.assertIn("%", text.getvalue())

    def test_progress_fails(self):
        def fail(_phase, _share):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            cslf.bake(make_sphere(), progress=fail, **SIZE)

    def test_invalid(self):
        sphere = make_sphere()
        os.makedirs("folder/a.mkv")
        with open("bad.vtp", "w", encoding="utf-8") as file:
            file.write("no data")
        cases = [
            (FileNotFoundError, "missing.vtp", lambda: cslf.bake("missing.vtp")),
            (cslf.Error, "Cannot read bad.vtp", lambda: cslf.bake("bad.vtp")),
            (ValueError, "is not a scene: supported are .glb", lambda: cslf.bake(__file__)),
            (ValueError, "preview, good, best", lambda: cslf.bake(sphere, quality="fine")),
            (ValueError, "lit, exact", lambda: cslf.bake(sphere, colors="pale")),
            (ValueError, "viewpoints must be from 2 to 1024; it is 1",
             lambda: cslf.bake(sphere, viewpoints=1)),
            (ValueError, "resolution must be from 1 to 8192; it is 1000",
             lambda: cslf.bake(sphere, resolution=10**30)),
            (ValueError, "noise_target must be a number", lambda: cslf.bake(
                sphere, noise_target=float("nan"))),
            (TypeError, "resolution must be a whole number; it is '16'",
             lambda: cslf.bake(sphere, resolution="16")),
            (TypeError, "noise_target must be a number; it is 'low'",
             lambda: cslf.bake(sphere, noise_target="low")),
            (TypeError, "a vtkCSLFSampler; it is 3", lambda: cslf.bake(sphere, sampler=3)),
            (TypeError, "True, False or a function", lambda: cslf.bake(sphere, progress="bar")),
            (TypeError, "file_name must be the name", lambda: cslf.bake(sphere, 3, **SIZE)),
            (ValueError, "field.mp4 is a light field", lambda: cslf.bake(FIELD)),
            (ValueError, "no array heat.*of points: Normals .3 components",
             lambda: cslf.bake(sphere, color_by="heat")),
            (ValueError, "has no component w", lambda: cslf.bake(sphere, color_by="Normals:w")),
            (ValueError, "color_map must be one of automatic, cool-to-warm",
             lambda: cslf.bake(sphere, color_map="jet")),
            (ValueError, "light must be one of", lambda: cslf.bake(sphere, light="disco")),
            (ValueError, "up must be one of x, y, z, -x", lambda: cslf.bake(sphere, up="w")),
            (TypeError, "must be two numbers", lambda: cslf.bake(sphere, color_range=3)),
            (TypeError, "the name of an array", lambda: cslf.bake(sphere, color_by=3)),
            (ValueError, "must be smaller", lambda: cslf.bake(sphere, color_range=(2, 1))),
            (ValueError, "light is for data", lambda: cslf.bake(make_renderer(), light="sun")),
            (ValueError, "up is for data", lambda: cslf.bake("cornell-box", up="z")),
            (ValueError, "crf is for videos", lambda: cslf.bake(sphere, crf=20.0)),
            (ValueError, "0 renderers", lambda: cslf.bake(vtkRenderWindow())),
            (ValueError, "is a light field", lambda: cslf.bake(cslf.bake(sphere, **SIZE).image)),
            (TypeError, "vtkTable", lambda: cslf.bake(vtkTable())),
            (TypeError, "not a int", lambda: cslf.bake(3)),
            (cslf.Error, "no triangles", lambda: cslf.bake(vtkMultiBlockDataSet(), **SIZE)),
        ]
        if HAS_ENCODER:
            cases += [
                (FileNotFoundError, "nowhere", lambda: cslf.bake(sphere, "nowhere/a.mp4", **SIZE)),
                (ValueError, ".mp4, .mkv", lambda: cslf.bake(sphere, "a.avi", **SIZE)),
                (ValueError, "crf must be from 0 to 51",
                 lambda: cslf.bake(sphere, "a.mp4", crf=99.0, **SIZE)),
                (ValueError, "at least 16 texels, the field has 8",
                 lambda: cslf.bake(sphere, "a.mp4", viewpoints=2, resolution=8)),
                (IsADirectoryError, "a.mkv", lambda: cslf.bake(sphere, "folder/a.mkv", **SIZE)),
            ]
        for kind, text, call in cases:
            with self.subTest(text=text), self.assertRaisesRegex(kind, text):
                call()
        self.assertEqual(sorted(os.listdir()), ["bad.vtp", "folder"])

    def test_invalid_names(self):
        field = cslf.bake(make_sphere(), **SIZE)
        os.makedirs("folder.vti")
        for kind, name, text in ((TypeError, 3, "the name of a file"),
                                 (ValueError, "a.png", ".mp4, .mkv, .vti; it is 'a.png'"),
                                 (FileNotFoundError, "nowhere/a.vti", "nowhere"),
                                 (IsADirectoryError, "folder.vti", "folder.vti")):
            with self.subTest(name=name), self.assertRaisesRegex(kind, text):
                field.save(name)
        self.assertEqual(os.listdir(), ["folder.vti"])

    def test_silent(self):
        """Values are checked also for those who have switched VTK's messages off."""
        cslf.vtkCSLFSampler.GlobalWarningDisplayOff()
        try:
            with self.assertRaisesRegex(ValueError, "from 2 to 1024"):
                cslf.bake(make_sphere(), viewpoints=1)
            self.assertEqual(cslf.vtkCSLFSampler.GetGlobalWarningDisplay(), 0)
        finally:
            cslf.vtkCSLFSampler.GlobalWarningDisplayOn()

    def test_warnings(self):
        """What classes warn of is a warning of Python, at the user's line."""
        source = vtkSphereSource()
        source.SetThetaResolution(50)
        source.SetPhiResolution(50)
        sampler = cslf.vtkCSLFSampler()
        sampler.SetGeometryTriangles(4)
        with self.assertWarnsRegex(UserWarning, "increase GeometryTriangles") as caught:
            cslf.bake(source, sampler=sampler, **SIZE)
        self.assertEqual(caught.filename, __file__)


if __name__ == "__main__":
    unittest.main()
