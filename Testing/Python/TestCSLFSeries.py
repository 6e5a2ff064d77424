# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that change over time: baked from files and from an algorithm of Python, and shown.

usage: TestCSLFSeries.py"""
import json
import os
import shutil
import sys
import tempfile
import unittest

import cslf
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

TIMES = (0.0, 0.5, 2.0)
SIZE = {"quality": "preview", "viewpoints": 2, "resolution": 16, "progress": False}
VIEW = {"size": (64, 64), "position": (1.5, 1.0, 12.0), "focal_point": (1.0, 0.0, 0.0)}


def make_sphere(time):
    """A sphere that moves along X."""
    sphere = vtkSphereSource()
    sphere.SetCenter(time, 0.0, 0.0)
    sphere.Update()
    return sphere.GetOutput()


class MovingSphere(VTKPythonAlgorithmBase):
    """The sphere as an algorithm that announces its times."""

    def __init__(self):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")

    def RequestInformation(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), TIMES, len(TIMES))
        information.Set(Pipeline.TIME_RANGE(), (TIMES[0], TIMES[-1]), 2)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        key = Pipeline.UPDATE_TIME_STEP()
        time = information.Get(key) if information.Has(key) else TIMES[0]
        output = vtkPolyData.GetData(outputs, 0)
        output.ShallowCopy(make_sphere(time))
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1


@unittest.skipUnless(hasattr(cslf, "vtkCSLFSeriesWriter"), "without the encoder")
class TestSeries(unittest.TestCase):
    """Each in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        os.chdir(self.folder)
        for step, time in enumerate(TIMES):
            writer = vtkXMLPolyDataWriter()
            writer.SetInputData(make_sphere(time))
            writer.SetFileName(f"sphere-{step}.vtp")
            writer.Write()
        entries = [{"name": f"sphere-{step}.vtp", "time": time} for step, time in enumerate(TIMES)]
        with open("sphere.vtp.series", "w", encoding="utf-8") as file:
            json.dump({"file-series-version": "1.0", "files": entries}, file)

    def tearDown(self):
        os.chdir("/")
        shutil.rmtree(self.folder)

    def test_bake(self):
        """A file and an algorithm give the same fields, which are shown at their times."""
        field = cslf.bake("sphere.vtp.series", "a.mp4", time_steps="all", **SIZE)
        self.assertEqual(field.file_name, "a.mp4.series")
        with open("a.mp4.series", encoding="utf-8") as file:
            index = json.load(file)
        self.assertEqual([entry["time"] for entry in index["files"]], list(TIMES))
        cslf.bake(MovingSphere(), "b.mp4", time_steps="all", **SIZE)
        bounds = []
        for step, time in enumerate(TIMES):
            shown = cslf.show("b.mp4.series", time=time, **VIEW).png
            self.assertEqual(shown, cslf.show(f"b_000{step}.mp4", **VIEW).png)
            self.assertEqual(shown, cslf.show(field, time=time + 0.1, **VIEW).png)
            actor = cslf.make_actor("a.mp4.series", time=time)
            actor.GetMapper().GetInputAlgorithm().Update(1)
            bounds.append(actor.GetMapper().GetGeometry().GetBounds()[1])
        self.assertEqual(cslf.show(field, **VIEW).png, cslf.show("a_0000.mp4", **VIEW).png)
        for time, bound in zip(TIMES, bounds):
            self.assertAlmostEqual(bound, time + bounds[0], places=2)
        with self.assertRaisesRegex(ValueError, "series"):
            field.save("copy.mp4")

    def test_steps(self):
        """A range of numbers."""
        cslf.bake("sphere.vtp.series", "a.mp4", time_steps=range(0, 3, 2), **SIZE)
        self.assertEqual(sorted(name for name in os.listdir() if name.startswith("a")),
                         ["a.mp4.series", "a_0000.mp4", "a_0002.mp4"])
        one = cslf.bake("sphere.vtp.series", "one.mp4", **SIZE)
        self.assertEqual(one.file_name, "one.mp4")

    def test_invalid(self):
        """What is wrong is named."""
        for arguments, message in (({"time_steps": 3}, "a range"),
                                   ({"time_steps": range(2, 0, -1)}, "ascending"),
                                   ({"time_steps": range(7, 9)}, "no such time steps")):
            with self.assertRaisesRegex((ValueError, TypeError, cslf.Error), message):
                cslf.bake("sphere.vtp.series", "x.mp4", **arguments, **SIZE)
        with self.assertRaisesRegex(ValueError, "no file name"):
            cslf.bake("sphere.vtp.series", time_steps="all", **SIZE)
        with self.assertRaisesRegex(cslf.Error, "no time steps"):
            cslf.bake(make_sphere(0.0), "x.mp4", time_steps="all", **SIZE)
        with self.assertRaisesRegex(ValueError, "bake it first"):
            cslf.show("sphere.vtp.series")
        one = cslf.bake(make_sphere(0.0), "one.mp4", **SIZE)
        with self.assertRaisesRegex(ValueError, "no times"):
            cslf.show(one, time=1.0)
        with open("bad.vtp.series", "w", encoding="utf-8") as file:
            file.write("{}")
        with self.assertRaisesRegex(cslf.Error, "bad.vtp.series"):
            cslf.bake("bad.vtp.series", "x.mp4", time_steps="all", **SIZE)
        os.remove("sphere-1.vtp")
        with self.assertRaises((FileNotFoundError, cslf.Error)):
            cslf.bake("sphere.vtp.series", "x.mp4", time_steps="all", **SIZE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
