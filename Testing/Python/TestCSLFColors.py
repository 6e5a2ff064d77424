# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Scalars of a field in other colours than those of the bake."""
import sys
import unittest
from unittest import mock

import cslf
from cslf.colors import Scalars, color_scalars
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkLookupTable
from vtkmodules.vtkFiltersSources import vtkPlaneSource

try:
    import numpy
except ImportError:
    numpy = None
try:
    import matplotlib
except ImportError:
    matplotlib = None

PLAIN = sys.argv.pop()
MAPPED = sys.argv.pop()
VIEW = {"size": (90, 60)}


def make_table(*color):
    """A lookup table of one colour."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(1)
    table.SetTableValue(0, *color)
    return table


def make_plane():
    """A square from 0 to 1 with a speed that grows from 0 to 4 along x."""
    source = vtkPlaneSource()
    source.SetOrigin(0.0, 0.0, 0.0)
    source.SetPoint1(1.0, 0.0, 0.0)
    source.SetPoint2(0.0, 1.0, 0.0)
    source.Update()
    plane = source.GetOutput()
    speed = vtkDoubleArray()
    speed.SetName("speed")
    for i in range(plane.GetNumberOfPoints()):
        speed.InsertNextValue(4.0 * plane.GetPoint(i)[0])
    plane.GetPointData().AddArray(speed)
    return plane


class TestCSLFColors(unittest.TestCase):
    def test_file(self):
        own = cslf.show(MAPPED, **VIEW).png
        red = make_table(1.0, 0.0, 0.0)
        time = red.GetMTime()
        for change in ({"cmap": red}, {"clim": (0.0, 10.0)}, {"show_scalar_bar": True}):
            with self.subTest(change=change):
                self.assertNotEqual(cslf.show(MAPPED, **VIEW, **change).png, own)
        self.assertEqual(red.GetMTime(), time)
        # One array, or the only one.
        self.assertEqual(cslf.show(MAPPED, **VIEW, cmap=red).png,
                         cslf.show(MAPPED, **VIEW, cmap=red, scalars="Value").png)
        self.assertEqual(cslf.show(MAPPED, **VIEW, scalars="Value").png, own)
        # An actor, for windows.
        mapper = cslf.make_actor(MAPPED, cmap=red, clim=(1.0, 2.0)).GetMapper()
        self.assertIs(mapper.GetLookupTable(), red)
        self.assertEqual(mapper.GetScalarRange(), (1.0, 2.0))

    @unittest.skipUnless(matplotlib, "matplotlib is not installed")
    def test_matplotlib(self):
        table = cslf.make_actor(MAPPED, cmap="turbo").GetMapper().GetLookupTable()
        self.assertEqual(table.GetTableRange(), (5.0, 90.0))
        for wanted, value in zip(matplotlib.colormaps["turbo"](1.0), table.GetTableValue(255)):
            self.assertAlmostEqual(wanted, value, delta=0.002)

    @unittest.skipUnless(hasattr(cslf, "vtkCSLFSampler"), "without the sampler")
    def test_maps(self):
        look = cslf.vtkCSLFSceneLook
        pictures = {cslf.show(MAPPED, **VIEW, cmap=look.GetColorMapName(i)).png
                    for i in range(1, look.NUMBER_OF_COLOR_MAPS)}
        self.assertEqual(len(pictures), look.NUMBER_OF_COLOR_MAPS - 1)
        table = vtkLookupTable()
        table.SetTableRange(3.0, 4.0)
        look.SetUpLookupTable(look.Gray, table)
        self.assertEqual(table.GetTableRange(), (3.0, 4.0))
        self.assertEqual(table.GetTableValue(0)[:3], (0.0, 0.0, 0.0))
        self.assertEqual(table.GetTableValue(1023)[:3], (1.0, 1.0, 1.0))
        time = table.GetMTime()
        look.SetUpLookupTable(99, table)
        look.SetUpLookupTable(look.Gray, None)
        self.assertEqual(table.GetMTime(), time)

    @unittest.skipUnless(numpy and hasattr(cslf, "vtkCSLFSampler"), "without sampler or numpy")
    def test_pixels(self):
        field = cslf.bake(make_plane(), viewpoints=2, resolution=16, samples=1, colors="exact",
                          color_by="speed", color_map="viridis", progress=False)
        view = {"size": (100, 100), "position": (0.5, 0.5, 3.0), "focal_point": (0.5, 0.5, 0.0)}

        def find_middle(**colors):
            return numpy.asarray(field.show(**view, **colors))[50, 50].astype(int)

        for clim, level in (((0.0, 4.0), 0.5), ((3.0, 4.0), 0.0), ((-4.0, 4.0), 0.75)):
            with self.subTest(clim=clim):
                pixel = find_middle(scalars="speed", cmap="gray", clim=clim)
                self.assertLess(numpy.abs(pixel - 255.0 * level).max(), 5.0)
        pixel = find_middle(cmap=make_table(0.0, 0.5, 1.0))
        self.assertLess(numpy.abs(pixel - (0.0, 127.5, 255.0)).max(), 2.0)
        # The bar does not reach the middle.
        self.assertEqual(find_middle(show_scalar_bar=True).tolist(), find_middle().tolist())

    def test_names(self):
        vector = Scalars('{"array": "v:w", "component": "Magnitude", "range": [0, 1], "steps": 2}')
        self.assertEqual(vector.label, "v:w:magnitude")
        for text, name in (("v:w", "v:w"), ("v:w:magnitude", "v:w Magnitude"), ("v:w:x", None),
                           ("v", None)):
            self.assertEqual(vector.find_name(text), name)
        first = Scalars('{"array": "v", "component": "0", "range": [0, 1], "steps": 2}')
        for text, name in (("v", "v"), ("v:x", "v 0"), ("v:0", "v 0"), ("v:y", None), ("w", None)):
            self.assertEqual(first.find_name(text), name)
        self.assertEqual(Scalars('{"array": "", "range": [0, 1], "steps": 2}').label, "Scalars")

    def test_invalid(self):
        for arguments, kind, text in (
                ({"scalars": "speed"}, ValueError, "scalars must be one of .* Value; it is 'speed'"),
                ({"scalars": 3}, TypeError, "scalars must be the name of an array; it is 3"),
                ({"cmap": "jot"}, ValueError, "cmap must be one of .*matplotlib.*; it is 'jot'"),
                ({"cmap": 3}, TypeError, "cmap must be the name of .*; it is 3"),
                ({"clim": (2.0, 1.0)}, ValueError, "clim must be two numbers"),
                ({"clim": 5.0}, TypeError, "clim must be two numbers"),
                ({"show_scalar_bar": 1}, TypeError, "show_scalar_bar must be True or False"),
                ({"clim": (0.0, 1.0), "lookup": "Depth"}, ValueError, "the lookup Geometry")):
            with self.subTest(arguments=arguments):
                with self.assertRaisesRegex(kind, text):
                    cslf.show(MAPPED, **arguments)
        for arguments in ({"scalars": "Value"}, {"cmap": "gray"}, {"show_scalar_bar": True}):
            with self.assertRaisesRegex(ValueError, "a field with scalars"):
                cslf.show(PLAIN, **arguments)
        with mock.patch.dict(sys.modules, {"matplotlib": None}):
            with self.assertRaisesRegex(ValueError, "it is 'turbo'"):
                cslf.show(MAPPED, cmap="turbo")
        mapper = cslf.make_actor(MAPPED).GetMapper()
        with mock.patch("cslf.colors.list_scalars") as known:
            known.return_value = [Scalars('{"array": "p", "range": [1, 2], "logarithmic": true}')]
            with self.assertRaisesRegex(ValueError, "clim must be above 0"):
                color_scalars(mapper, clim=(-1.0, 2.0))


if __name__ == "__main__":
    unittest.main()
