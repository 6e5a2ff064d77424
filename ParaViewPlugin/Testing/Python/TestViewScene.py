# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Baking everything that a view shows: colours, materials, lights, and nothing else."""
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
