# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Baking everything that a view shows: colours, materials, lights, and nothing else."""
import re

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk

from cslfparaview import *

view = make_view()
scene = make_scene()
ColorBy(Show(scene, view), ("POINTS", "Elevation"))
plane = Plane(Origin=[-0.5, -0.75, 0.4], Point1=[1.5, -0.75, 0.4], Point2=[-0.5, 1.25, 0.4])
floor = Show(plane, view)
floor.AmbientColor = floor.DiffuseColor = [0.1, 0.2, 0.9]
hidden = Sphere(Center=[0.5, 0.25, 3.0])
Show(hidden, view)
Hide(hidden, view)
Show(Wavelet(), view).SetRepresentationType("Outline")
Hide(GetActiveSource(), view)
look(view)
rendered = take_picture(view, "rendered.png")

captured = CSLFViewScene(View=view)
captured.UpdatePipeline()
bounds = captured.GetDataInformation().GetBounds()
check(abs(bounds[5] - 1.5) < 0.01, f"captured {bounds}")
field = CSLFSampler(Input=captured, Viewpoints=9, Resolution=128, Samples=64)
other = make_view()
Show(field, other)
look(other)
baked = take_picture(other, "baked.png")
both = (rendered.sum(axis=2) > 0) == (baked.sum(axis=2) > 0)
check(both.mean() > 0.97, f"shapes agree in {both.mean()}")
for channel in range(3):
    ratio = baked[:, :, channel].sum() / rendered[:, :, channel].sum()
    print(f"channel {channel}: {ratio:.2f}")
    check(0.5 < ratio < 1.6, f"channel {channel} of the baked view is {ratio} times the rendered")

# It does not change until it is captured again. None means the active view.
Show(hidden, view)
Render(view)
captured.UpdatePipeline()
check(captured.GetDataInformation().GetBounds() == bounds, "it followed the view")
captured.InvokeCommand("Capture")
captured.UpdatePipeline()
check(captured.GetDataInformation().GetBounds()[5] > 3.4, "it was not captured again")
SetActiveView(view)
active = CSLFViewScene(CaptureLights=0)
active.UpdatePipeline()
check(active.GetDataInformation().GetBounds()[5] > 3.4, "the active view was not captured")

# Arrays without names get names in the captured scene, which are not those of others. The arrays of
# the data that is shown stay as they are.
sphere = Sphere()
sphere.UpdatePipeline()
data = servermanager.Fetch(sphere)
count = data.GetNumberOfPoints()
points = data.GetPointData()
points.GetNormals().SetName(None)
named = numpy_to_vtk(numpy.zeros(count), deep=1)
named.SetName("Array0")
points.AddArray(named)
points.AddArray(numpy_to_vtk(numpy.arange(count, dtype=float), deep=1))
before = [points.GetAbstractArray(i).GetName() for i in range(points.GetNumberOfArrays())]
producer = TrivialProducer()
producer.GetClientSideObject().SetOutput(data)
own = make_view()
Show(producer, own)
Render(own)
unnamed = CSLFViewScene(View=own)
unnamed.UpdatePipeline()
after = [points.GetAbstractArray(i).GetName() for i in range(points.GetNumberOfArrays())]
check(before.count(None) == 2 and after == before, f"{before} became {after}")
captured_points = unnamed.GetClientSideObject().GetOutput().GetBlock(0).GetPointData()
names = [captured_points.GetAbstractArray(i).GetName()
         for i in range(captured_points.GetNumberOfArrays())]
check(None not in names and len(set(names)) == len(names), f"captured {names}")

# The field has a legend of what was baked. When the colour map of the view changes, the field and
# its legend stay, and a note in orange says that they are out of date, until it changes back.
table = GetColorTransferFunction("Elevation")
table.ApplyPreset(VIRIDIS, True)
Hide(hidden, view)
Render(view)
captured.InvokeCommand("Capture")
small = bake(captured, Viewpoints=3, Resolution=32, Samples=4)
baked_view = make_view()
shown = Show(small, baked_view)
look(baked_view)
baked_view.Background = [0.0, 0.0, 0.01]  # to find it again


def count_note(picture):
    lower = picture[:SIZE // 6]
    return ((lower[:, :, 0] > 200) & (abs(lower[:, :, 1] - 153) < 40) & (lower[:, :, 2] < 60)).sum()


plain = take_picture(baked_view, "no_legend.png")
shown.ShowLegend = 1
legend = take_picture(baked_view, "legend.png")
bar = abs(legend - plain).sum(axis=2) > 30
check(bar.sum() > 300 and bar[:, SIZE // 3:].sum() == 0, f"a legend of {bar.sum()} pixels")
yellow = (legend[:, :, 0] > 230) & (legend[:, :, 1] > 200) & (legend[:, :, 2] < 90) & bar
check(yellow.sum() > 10, "the legend is not Viridis")
check(count_note(legend) == 0, "the field is out of date at once")
for source in GetSources().values():
    Hide(source, view)  # as ParaView does when the field is shown
Render(view)
check(count_note(take_picture(baked_view, "hidden.png")) == 0, "hiding sources outdates the field")
table.ApplyPreset("Cool to Warm", True)
Render(view)
changed = take_picture(baked_view, "changed.png")
check(count_note(changed) > 40, "no note says that the field is out of date")
top = SIZE // 6
check(psnr(changed[top:], legend[top:]) > 60, "the field or its legend follows the colour map")
table.ApplyPreset(VIRIDIS, True)
check(psnr(take_picture(baked_view, "back.png"), legend) > 60, "the note stays")

for unused in (field, active, unnamed):
    Delete(unused)
for unused in (other, own):
    Delete(unused)

# A state has what was captured, although the view shows nothing of it any more. Without that, one
# sentence says what is missing.
SaveState("scene.pvsm")
ResetSession()
LoadState("scene.pvsm")
again = next(view for view in GetViews() if view.Background[2] == 0.01)
quality = psnr(take_picture(again, "reloaded.png"), legend)
check(quality > 60, f"the field of the state differs: {quality} dB")
ResetSession()
with open("scene.pvsm") as file:
    state = re.sub(r'(name="CapturedScene"[^>]*>\s*<Element index="0" value=")[^"]*', r"\1", file.read())
with open("without.pvsm", "w") as file:
    file.write(state)
with Errors() as errors:
    LoadState("without.pvsm")
    for view in GetViews():
        Render(view)
check("shows no surface to capture" in errors.messages[0], f"errors {errors.messages}")
for message in errors.messages:
    check("vtkInformation" not in message and message.count("\n") < 5, message)
