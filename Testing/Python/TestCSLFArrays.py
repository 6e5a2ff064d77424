# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Arrays that gave a field no colours: kept by the bake, read by the reader in Utilities, which has
nothing of CSLF's, and shown as if they had been baked.

usage: TestCSLFArrays.py"""
import math
import os
import shutil
import sys
import tempfile
import unittest

import cslf
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray
from vtkmodules.vtkFiltersSources import vtkPlaneSource

try:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError:
    numpy = None

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "Utilities"))
VIEW = {"size": (200, 200), "position": (1.5, -2.0, 4.0), "focal_point": (0.0, 0.0, 0.3)}
ANEW = 40.0  # dB


def make_valley():
    """A bowl from -1 to 1, with its heights, waves, a vector and the number of its quadrant."""
    source = vtkPlaneSource()
    source.SetOrigin(-1.0, -1.0, 0.0)
    source.SetPoint1(1.0, -1.0, 0.0)
    source.SetPoint2(-1.0, 1.0, 0.0)
    source.SetResolution(64, 64)
    source.Update()
    valley = source.GetOutput()
    arrays = {name: vtkDoubleArray() for name in ("height", "wave", "flow")}
    arrays["flow"].SetNumberOfComponents(3)
    arrays["quadrant"] = vtkIntArray()
    for i in range(valley.GetNumberOfPoints()):
        x, y, _ = valley.GetPoint(i)
        height = 0.6 * (x * x + y * y)
        valley.GetPoints().SetPoint(i, x, y, height)
        arrays["height"].InsertNextValue(height)
        arrays["wave"].InsertNextValue(50.0 + 5.0 * math.sin(3.0 * x) * math.cos(2.0 * y))
        arrays["flow"].InsertNextTuple3(-y, x, 0.5)
        arrays["quadrant"].InsertNextValue(90000 + 1000 * (x > 0.0) + (y > 0.0))
    valley.GetPointData().Initialize()
    for name, array in arrays.items():
        array.SetName(name)
        valley.GetPointData().AddArray(array)
    return valley


def bake(valley, file_name=None, **arguments):
    """A field with one reflection."""
    sampler = cslf.vtkCSLFSampler()
    sampler.SetMaximumDepth(1)
    return cslf.bake(valley, file_name, sampler=sampler, viewpoints=2, resolution=64,
                     quality="preview", light="studio", progress=False, **arguments)


def get_psnr(one, other):
    difference = numpy.asarray(one).astype(float) - numpy.asarray(other)
    return 10.0 * math.log10(255.0**2 / max((difference**2).mean(), 1e-9))


@unittest.skipUnless(numpy, "numpy is not installed")
class TestCSLFArrays(unittest.TestCase):
    def setUp(self):
        self.valley = make_valley()

    def check_anew(self, field, name, limits):
        """Compares with a field that was baked in these colours."""
        new = bake(self.valley, color_by=name, color_map="plasma", color_range=limits)
        shown = field.show(**VIEW, scalars=name, cmap="plasma", clim=limits)
        psnr = get_psnr(shown, new.show(**VIEW))
        print(f"{name}: {psnr:.1f} dB from a field that was baked so, and "
              f"{get_psnr(field.show(**VIEW), new.show(**VIEW)):.1f} dB in its own colours.")
        self.assertGreater(psnr, ANEW)

    def test_colors(self):
        field = bake(self.valley, color_by="height", color_map="viridis", arrays="all")
        self.check_anew(field, "wave", (45.0, 55.0))
        self.check_anew(field, "flow:x", (-1.0, 1.0))
        self.check_anew(field, "flow:magnitude", (0.5, 1.5))

    def test_one_color(self):
        field = bake(self.valley, color_by="none", arrays=["wave"])
        self.check_anew(field, "wave", (45.0, 55.0))
        with self.assertRaisesRegex(ValueError, "one of the field's arrays, wave;"):
            field.show(**VIEW, scalars="flow")

    def test_invalid(self):
        for arrays, text in ((3, "arrays must be a list of names"),
                             ([3], "arrays must be a list of names"), ("wave", "arrays must be")):
            with self.subTest(arrays=arrays), self.assertRaisesRegex(TypeError, text):
                bake(self.valley, arrays=arrays)

    @unittest.skipUnless(hasattr(cslf, "vtkCSLFEncoder") and shutil.which("ffmpeg"),
                         "without encoder or FFmpeg")
    def test_file(self):
        from read_geometry import read_geometry
        from read_light_field import read_light_field

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "valley.mp4")
            plain = os.path.join(folder, "plain.mp4")
            field = bake(self.valley, path, color_by="height", arrays=["quadrant", "flow"])
            bake(self.valley, plain, color_by="height")
            field = cslf.vtkCSLFDecoder()
            field.SetFileName(path)
            field.Update()
            geometry = field.GetOutputDataObject(1)
            points = geometry.GetPointData()
            values = {}
            for name in (path, plain):
                parts = read_light_field(name)[1]
                data = next(data for _, part, data in parts if part == "geometry")
                values[name] = read_geometry(data)[4]["values"]
                print(f"{os.path.basename(name)}: {os.path.getsize(name)} bytes")
            self.assertEqual(values[plain], {})
            self.assertEqual(set(values[path]), {"quadrant", "flow"})
            for name, found in values[path].items():
                own = vtk_to_numpy(points.GetArray(name)).reshape(found.shape)
                self.assertLessEqual(numpy.abs(own - found).max(), 1e-9 * numpy.abs(own).max())
            x, y, _ = vtk_to_numpy(geometry.GetPoints().GetData()).T
            inside = (abs(x) > 0.05) & (abs(y) > 0.05)
            numbers = 90000 + 1000 * (x > 0.0) + (y > 0.0)
            self.assertGreater(inside.sum(), 500)
            self.assertTrue((values[path]["quadrant"][inside, 0] == numbers[inside]).all())

    @unittest.skipIf(numpy is None, "needs numpy")
    def test_golden(self):
        """A file of this version, whose array `Place` is where points are, and `Part` says of what
        they are: see Testing/Data/Golden/README.md."""
        decoder = cslf.vtkCSLFDecoder()
        decoder.SetFileName(os.path.join(ROOT, "Testing/Data/Golden/v2-hevc-geometry-arrays.mp4"))
        decoder.Update(1)
        geometry = decoder.GetGeometry()
        points = geometry.GetPointData()
        places = vtk_to_numpy(geometry.GetPoints().GetData())
        array = vtk_to_numpy(points.GetArray("Place"))
        parts = vtk_to_numpy(points.GetArray("Part"))
        is_ball = parts > -6.5
        self.assertGreater(is_ball.sum(), 1000)
        # Where balls meet, numbers lie between theirs.
        self.assertTrue(parts.min() == -7.0 and parts.max() == 2.0)
        self.assertGreater(numpy.isin(parts[is_ball], (0, 1, 2)).mean(), 0.7)
        # Balls have the values of their centres.
        self.assertLess(numpy.abs(array - places)[~is_ball].max(), 0.01)
        distances = numpy.linalg.norm(array - places, axis=1)[is_ball]
        self.assertTrue(0.1 < distances.min() and distances.max() < 0.21)


if __name__ == "__main__":
    unittest.main()
