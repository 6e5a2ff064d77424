# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A field is drawn with its geometry: as sampled, from a file, resampled, and of a captured view.
Points picked on it are those of the surfaces."""
import os

import cslf
from cslfparaview import *
from vtkmodules.vtkRenderingCore import vtkWorldPointPicker


def make_slats():
    """A sphere, most of it behind slats."""
    slats = [Box(XLength=1.4, YLength=0.08, ZLength=0.04, Center=[0.5, 0.15 * k - 0.3, 1.6])
             for k in range(8)]
    return AppendGeometry(Input=[make_scene().Input] + slats)


def look_through(view):
    view.CameraFocalPoint, view.CameraPosition = [0.5, 0.25, 1.0], [0.9, 0.45, 5.0]
    view.CameraViewUp, view.CameraViewAngle = [0, 1, 0], 25


def count_triangles(source):
    """Those of the geometry that has been made or read."""
    return source.GetClientSideObject().GetOutputDataObject(1).GetNumberOfCells()


def draw(source, name):
    """A picture of only this field in a view of its own."""
    view = make_view()
    check(Show(source, view).LookupMode == "Geometry", "geometry is not the default")
    look_through(view)
    picture = take_picture(view, name + ".png")
    Delete(view)
    return picture


scene = make_slats()
field = bake(scene, Viewpoints=5, Resolution=96, ScalarVisibility=0)
view = make_view()
display = Show(field, view)
look_through(view)

# The geometry lookup is nearer to the truth than the depth lookup.
display.LookupMode = "Depth"
depth = take_picture(view, "depth.png")
display.LookupMode = "Geometry"
geometry = take_picture(view, "geometry.png")
check(count_triangles(field) > 100, "no geometry was made")
tracer = cslf.vtkCSLFViewTracer()
tracer.SetInputData(servermanager.Fetch(scene))
tracer.SetCamera(get_camera(view))
tracer.SetSize(SIZE, SIZE)
tracer.SetSamples(64)
tracer.Update()
values = vtk_to_numpy(tracer.GetOutput().GetPointData().GetScalars())
truth = values.reshape(SIZE, SIZE, 4)[:, :, :3]
gain = psnr(geometry, truth) - psnr(depth, truth)
print(f"depth {psnr(depth, truth):.2f} dB, geometry {psnr(geometry, truth):.2f} dB")
check(gain > 3, f"the geometry gains {gain} dB")

# The depth of a pixel is that of the surface, on a slat and on the sphere.
Render(view)
renderer = view.GetClientSideObject().GetRenderer()
picker = vtkWorldPointPicker()
for place in ((0.5, 0.3, 1.62), (0.5, 0.375, 1.4841)):
    renderer.SetWorldPoint(*place, 1.0)
    renderer.WorldToDisplay()
    picker.Pick(*renderer.GetDisplayPoint()[:2], 0.0, renderer)
    error = max(abs(a - b) for a, b in zip(picker.GetPickPosition(), place))
    print(f"{place}: off by {error:.5f}")
    check(error < 0.01, f"picked {picker.GetPickPosition()} for {place}")  # a pixel is 0.007 wide

# Files have it, also when they are opened again and resampled.
SaveData("slats.mp4", proxy=field, Lossless=1, Preset="ultrafast")
reader = OpenDataFile(os.path.abspath("slats.mp4"))
check(psnr(draw(reader, "reader"), geometry) > 40, "the file's geometry is not drawn")
check(count_triangles(reader) == count_triangles(field), "the file has another geometry")
coarse = CSLFResample(Input=reader, ResolutionDivisor=1, ViewpointStride=2)
quality = psnr(draw(coarse, "coarse"), truth)
check(quality > psnr(depth, truth), f"resampled: {quality} dB")

# As a page and as glTF, without what is beside it in other views.
alone = make_view()
Show(field, alone)
look_through(alone)
Render(alone)
for name, start in (("page.html", b"<!DOCTYPE html>"), ("surfaces.glb", b"glTF")):
    ExportView(name, view=alone, Title="Slats")
    with open(name, "rb") as file:
        data = file.read()
    check(data.startswith(start) and b"Slats" in data, f"{name} was not exported")
    check(b"other object" not in data, f"{name} lacks other objects")
Delete(alone)

# What a view shows.
shown = make_view()
Show(scene, shown)
look_through(shown)
Render(shown)
captured = bake(CSLFViewScene(View=shown), Viewpoints=5, Resolution=96,
                ScalarVisibility=0)
draw(captured, "captured")
check(count_triangles(captured) == count_triangles(field), "the view's scene has other geometry")

# Without geometry, it is drawn by depth, and files have none.
field.GeometryTriangles = 0
check(psnr(draw(field, "none"), depth) > 60, "without geometry, it is not drawn by depth")
SaveData("none.mp4", proxy=field, Lossless=1, Preset="ultrafast")
plain = OpenDataFile(os.path.abspath("none.mp4"))
check(psnr(draw(plain, "plain"), depth) > 60, "a file without geometry is not drawn")
check(count_triangles(plain) == 0, "a file has geometry from nowhere")
