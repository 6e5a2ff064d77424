# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures for notebooks: of files, of pipelines and of image data; and what is no field."""
import os
import struct
import sys
import unittest
from unittest import mock

import cslf
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer

try:
    import numpy
except ImportError:
    numpy = None

FIELD = sys.argv.pop()


class TestCSLFNotebook(unittest.TestCase):
    def check(self, picture, width, height):
        png = picture._repr_png_()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (width, height))
        return png

    def test_sources(self):
        """The same picture, whatever the field comes from."""
        file = self.check(cslf.show(FIELD, size=(80, 60)), 80, 60)
        decoder = cslf.vtkCSLFDecoder()
        decoder.SetFileName(FIELD)
        decoder.Update()
        self.assertEqual(self.check(cslf.show(decoder, size=(80, 60)), 80, 60), file)
        self.assertEqual(self.check(cslf.show(decoder.GetOutput(), size=(80, 60)), 80, 60), file)

    def test_parameters(self):
        front = self.check(cslf.show(FIELD, size=(60, 60)), 60, 60)
        for other in ({"position": (-3.0, 2.0, 4.0)}, {"lookup": "Nearest"},
                      {"background": (1.0, 0.0, 0.0)}, {"focal_point": (0.5, 0.0, 0.0)},
                      {"view_up": (1.0, 0.0, 0.0)}):
            self.assertNotEqual(self.check(cslf.show(FIELD, size=(60, 60), **other), 60, 60), front)
        # Names, and a view along the up direction, as the tool draws it.
        red = cslf.show(FIELD, size=(60, 60), background=(1.0, 0.0, 0.0)).png
        for name in ("red", "#ff0000"):
            self.assertEqual(cslf.show(FIELD, size=(60, 60), background=name).png, red)
        self.assertEqual(cslf.show(FIELD, size=(60, 60), lookup="nearest").png,
                         cslf.show(FIELD, size=(60, 60), lookup="Nearest").png)
        above = {"size": (60, 60), "position": (0.0, 5.0, 0.0)}
        self.assertEqual(cslf.show(FIELD, **above).png,
                         cslf.show(FIELD, view_up=(0.0, 0.0, 1.0), **above).png)

    @unittest.skipIf(numpy is None, "numpy is not installed")
    def test_array(self):
        view = {"size": (80, 60), "background": (0.0, 0.0, 1.0), "position": (1.0, 1.0, 4.0),
                "focal_point": (0.0, 0.0, 0.0)}
        picture = cslf.show(FIELD, **view)
        pixels = numpy.asarray(picture)
        self.assertEqual((pixels.shape, pixels.dtype), ((60, 80, 3), numpy.uint8))
        self.assertEqual(pixels[0, 0].tolist(), [0, 0, 255])
        # Rows begin at the top.
        other = cslf.show(FIELD, view_up=(0.0, -1.0, 0.0), **view)
        turned = numpy.asarray(other)[::-1, ::-1]
        self.assertLess(numpy.abs(pixels.astype(int) - turned).mean(), 1.0)
        self.assertGreater(numpy.abs(pixels.astype(int) - numpy.asarray(other)).mean(), 1.0)

    def test_save(self):
        picture = cslf.show(FIELD, size=(40, 40))
        picture.save("TestCSLFNotebook.png")
        with open("TestCSLFNotebook.png", "rb") as file:
            self.assertEqual(file.read(), picture._repr_png_())

    def test_invalid(self):
        image = vtkImageData()
        image.SetDimensions(2, 2, 2)
        image.GlobalWarningDisplayOff()
        try:
            with self.assertRaises(ValueError):
                cslf.show(image)
            with self.assertRaisesRegex(FileNotFoundError, "missing.mp4"):
                cslf.show("missing.mp4")
            with self.assertRaisesRegex(ValueError, "not an MP4 or Matroska file"):
                cslf.show(__file__)
            with self.assertRaisesRegex(ValueError, "ball.vtp is a scene, .*: bake it first"):
                with open("ball.vtp", "w", encoding="utf-8"):
                    cslf.show("ball.vtp")
            with self.assertRaisesRegex(ValueError, "not a light field: bake scenes first"):
                cslf.show(vtkSphereSource())
            for other in (vtkRenderer(), 3):
                with self.assertRaisesRegex(TypeError, "A field is the name of a file, .* not a "):
                    cslf.show(other)
            if hasattr(cslf, "vtkCSLFSceneSource"):
                with self.assertRaisesRegex(ValueError, "cornell-box is a scene"):
                    cslf.show("cornell-box")
            with self.assertRaisesRegex(ValueError, "saved as .png"):
                cslf.show(FIELD, size=(8, 9)).save("view.jpg")
            with self.assertRaisesRegex(TypeError, "a vtkRenderWindow; it is 3"):
                cslf.capture(3)
        finally:
            image.GlobalWarningDisplayOn()

    def test_invalid_parameters(self):
        for name, value, kind, text in (
                ("size", 300, TypeError, "width and height in pixels, such as (400, 400)"),
                ("size", (3, 3, 3), ValueError, "width and height"),
                ("size", (0, 9), ValueError, "it is 0 x 9"),
                ("size", (10**6, 10**6), ValueError, "at most 16384 x 16384"),
                ("size", "9x9", TypeError, "width and height"),
                ("position", "front", TypeError, "three numbers"),
                ("position", (1.0, 2.0), ValueError, "three numbers"),
                ("position", (0.0, float("nan"), 0.0), ValueError, "three numbers"),
                ("focal_point", 3, TypeError, "three numbers"),
                ("view_up", None, TypeError, "three numbers"),
                ("background", "wite", ValueError, "such as white"),
                ("background", (255, 0, 0), ValueError, "from 0 to 1"),
                ("background", 0.5, TypeError, "such as white"),
                ("lookup", "foo", ValueError, "Nearest, Linear,"),
                ("lookup", 3, ValueError, "Nearest, Linear,")):
            with self.subTest(name=name, value=value):
                with self.assertRaisesRegex(kind, name) as caught:
                    cslf.show(FIELD, **{name: value})
                self.assertIn(text, str(caught.exception))
        with self.assertRaisesRegex(ValueError, "must differ"):
            cslf.show(FIELD, position=(1.0, 0.0, 0.0), focal_point=(1.0, 0.0, 0.0))

    def test_without_display(self):
        needs_server = vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() < 904
        for display in ("", ":987"):
            with self.subTest(display=display), mock.patch.dict(os.environ, {"DISPLAY": display}):
                if needs_server:
                    with self.assertRaisesRegex(RuntimeError, display):
                        cslf.show(FIELD)
                else:  # VTK draws with EGL or OSMesa.
                    self.check(cslf.show(FIELD, size=(80, 60)), 80, 60)


if __name__ == "__main__":
    unittest.main()
