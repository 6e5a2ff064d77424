# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A bake within a given time: it takes as many samples as fit, shows its progress, and can be
aborted, after which none of its files remain. Arguments: M N seconds."""
import argparse
import os
import sys

import cslf
from example import make_field_actor, save_picture
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("M", type=int, nargs="?", default=9, help="viewpoints a side")
parser.add_argument("N", type=int, nargs="?", default=128, help="texels a side")
parser.add_argument("seconds", type=float, nargs="?", default=60.0, help="for the whole bake")
options = parser.parse_args()

box = cslf.vtkCSLFCornellBoxSource()
sampler = cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.SetViewpoints(options.M)
sampler.SetResolution(options.N)
sampler.GetEnvironment().SetModeToNone()  # the box has its own lamp
encoder = cslf.vtkCSLFEncoder()
encoder.SetInputConnection(sampler.GetOutputPort())
encoder.SetFileName("TimedBake.mp4")

# A short probe predicts the cost of the bake, and how many samples fit.
estimator = cslf.vtkCSLFBakeEstimator()
estimator.SetSampler(sampler)
estimator.SetEncoder(encoder)
estimator.SetProbeSeconds(2.0)
if not estimator.ChooseSamples(options.seconds):
    sys.exit("Not even one sample for each texel fits.")
sampler.SetSamples(min(sampler.GetSamples(), 64))  # more make no visible difference in this scene
print(f"{sampler.GetSamples()} samples, in at most {estimator.GetSeconds():.1f} s: "
      f"{estimator.GetBytes() / 1e3:.0f} kB")


class Progress:
    """Prints the progress of a bake, and aborts it at a given progress."""

    def __init__(self, abort_at):
        self.abort_at = abort_at
        self.tenths = 0

    def __call__(self, algorithm, event):
        tenths = int(10.0 * algorithm.GetProgress())
        if tenths > self.tenths:
            self.tenths = tenths
            print(f"{10 * tenths} %")
        if algorithm.GetProgress() >= self.abort_at:
            algorithm.SetAbortExecute(1)


def bake(abort_at):
    """Returns whether the file was written."""
    encoder.SetAbortExecute(0)
    observer = encoder.AddObserver(vtkCommand.ProgressEvent, Progress(abort_at))
    written = bool(encoder.Write())
    encoder.RemoveObserver(observer)
    return written


# Abort the bake, as if a user pressed a button: neither the file nor its parts remain.
if os.path.exists("TimedBake.mp4"):
    os.remove("TimedBake.mp4")
if bake(abort_at=0.3) or os.path.exists("TimedBake.mp4"):
    sys.exit("The bake was not aborted.")
print("aborted")
if not bake(abort_at=2.0):
    sys.exit("The light field was not written.")

decoder = cslf.vtkCSLFDecoder()
decoder.SetFileName("TimedBake.mp4")
renderer = vtkRenderer()
renderer.AddActor(make_field_actor(decoder))
renderer.GetActiveCamera().SetPosition(-0.9, 0.6, 4.2)
renderer.ResetCameraClippingRange()
window = vtkRenderWindow()
window.SetSize(640, 640)
window.AddRenderer(renderer)
save_picture(window, "TimedBake.png")
