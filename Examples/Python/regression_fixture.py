# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A baked light field as the baseline of another project's tests: one file replaces pictures of
a pipeline's result from all around. Documentation/RegressionTests.md explains it.

    regression_fixture.py --bake    writes the fixture; do this once
    regression_fixture.py           tests the pipeline against it
"""
import argparse
import os
import sys
import unittest

import cslf
from vtkmodules.vtkFiltersCore import vtkContourFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

FIXTURE = "RegressionFixture.mp4"


def make_renderer(isovalue=150.0):
    """The object of the test: the project's own pipeline and the actors that show it."""
    image = vtkRTAnalyticSource()
    contour = vtkContourFilter()
    contour.SetInputConnection(image.GetOutputPort())
    contour.SetValue(0, isovalue)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(contour.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.9, 0.6, 0.3)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    return renderer


def bake():
    """Writes the fixture from the current pipeline. Returns whether that succeeded."""
    sampler = cslf.vtkCSLFSampler()
    sampler.SetRenderer(make_renderer())
    sampler.SetViewpoints(3)
    sampler.SetResolution(32)
    sampler.SetSamples(64)
    sampler.SetIntegratorToPathTracing()  # like the comparison
    encoder = cslf.vtkCSLFEncoder()
    encoder.SetInputConnection(sampler.GetOutputPort())
    encoder.SetFileName(FIXTURE)
    encoder.GetRateControl().SetCRF(12.0)
    if not encoder.Write():
        return False
    cslf.show(FIXTURE).save("RegressionFixture.png")  # shows the fixture
    return True


def compare(renderer):
    """The fixture's PSNR in dB against the current scene of the renderer, at 2000 texels."""
    decoder = cslf.vtkCSLFDecoder()
    decoder.SetFileName(FIXTURE)
    reference = cslf.vtkCSLFFieldReference()
    reference.SetRenderer(renderer)
    reference.SetInputConnection(1, decoder.GetOutputPort())
    reference.SetTexels(2000)
    reference.SetSamples(64)
    reference.GlobalWarningDisplayOff()  # hides the warning that the scene has changed
    reference.Update()
    reference.GlobalWarningDisplayOn()
    print(f"{reference.GetPSNR():.1f} dB, noise floor {reference.GetNoiseFloor():.1f} dB")
    return reference.GetPSNR()


class TestContour(unittest.TestCase):
    def test_as_it_was(self):
        self.assertGreater(compare(make_renderer()), 30.0)

    def test_changed(self):
        """The fixture detects changes that a single camera might not see."""
        self.assertLess(compare(make_renderer(isovalue=160.0)), 25.0)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bake", action="store_true", help="write the fixture first")
    if parser.parse_args().bake and not bake():
        sys.exit("The fixture was not written.")
    if not os.path.exists(FIXTURE):
        sys.exit(f"There is no {FIXTURE}: run with --bake.")
    unittest.main(argv=sys.argv[:1])
