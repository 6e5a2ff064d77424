# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The colours of a light field are those of the view, whatever is selected for the sampler: surfaces
of many kinds side by side, drawn without lights, captured and baked, and sources baked directly."""
from cslfparaview import *
from vtkmodules.util.numpy_support import numpy_to_vtk

STEP = 10.0  # between surfaces, in the world
COLUMNS, ROWS = 4, 2


def use_viridis(name, minimum, maximum):
    table = GetColorTransferFunction(name)
    table.ApplyPreset(VIRIDIS, True)
    table.RescaleTransferFunction(minimum, maximum)
    return table


def make_height(source):
    return Elevation(Input=source, LowPoint=[-4, -4, 0], HighPoint=[4, 4, 0])


def make_spheres():
    return GroupDatasets(Input=[make_height(Sphere(Center=[x, 0, 0], Radius=1.9, ThetaResolution=24,
                                                   PhiResolution=24)) for x in (-2, 2)])


def make_categories():
    plane = Plane(Origin=[-4, -4, 0], Point1=[4, -4, 0], Point2=[-4, 4, 0], XResolution=3,
                  YResolution=3)
    cells = PointDatatoCellData(Input=make_height(plane))
    table = GetColorTransferFunction("Kind")
    table.InterpretValuesAsCategories = 1
    table.Annotations = ["0", "low", "1", "middle", "2", "high"]
    table.IndexedColors = [1.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 1.0]
    return Calculator(Input=cells, AttributeType="Cell Data", Function="floor(3*Elevation)",
                      ResultArrayName="Kind")


def look_down(view):
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.5 * STEP * COLUMNS
    view.CameraFocalPoint = [0.5 * STEP * (COLUMNS - 1), 0.5 * STEP * (ROWS - 1), 0.0]
    view.CameraPosition = view.CameraFocalPoint[:2] + [60.0]
    view.CameraViewUp = [0, 1, 0]


def get_cell(picture, index):
    """The part of a picture with one surface."""
    size = SIZE // COLUMNS
    column, row = index % COLUMNS, index // COLUMNS
    bottom = (SIZE - ROWS * size) // 2 + row * size
    return picture[bottom:bottom + size, column * size:(column + 1) * size]


def compare(before, after, name, tolerance):
    """Compares colours where neither picture is dark, as edges are."""
    both = (before.sum(axis=2) > 30) & (after.sum(axis=2) > 0.85 * before.sum(axis=2))
    difference = numpy.median(abs(before[both] - after[both]), axis=0)
    print(f"{name}: {both.sum()} pixels, median differences {difference}")
    check(both.sum() > 40 and difference.max() < tolerance, f"{name}: {difference}")


wavelet = Wavelet(WholeExtent=[-4, 4, -4, 4, -4, 4])
flat = Slice(Input=wavelet)
flat.SliceType.Normal = [0, 0, 1]
use_viridis("RTData", 100.0, 270.0)
use_viridis("Elevation", 0.0, 1.0)
tube = Tube(Input=Line(Point1=[-3, -3, 0], Point2=[3, 3, 0], Resolution=20))
tube.Radius = 1.0
height = ("POINTS", "Elevation")
ball = Sphere(Radius=3.5, ThetaResolution=24, PhiResolution=24)
surfaces = {
    "slice": (flat, ("POINTS", "RTData"), {}),
    "contour": (make_height(Contour(Input=wavelet, ContourBy=["POINTS", "RTData"],
                                    Isosurfaces=[200.0])), height, {}),
    "tube": (make_height(tube), height, {}),
    "point": (make_height(PointSource(NumberOfPoints=1, Radius=0.0)), height,
              dict(Representation="Points", PointSize=60)),
    "blocks": (make_spheres(), height, {}),
    "categories": (make_categories(), ("CELLS", "Kind"), {}),
    "opacity": (make_height(ball), height, dict(Opacity=0.5)),
    "color": (ball, None, dict(AmbientColor=[0.9, 0.4, 0.1])),
}
view = make_view()
for index, (source, array, properties) in enumerate(surfaces.values()):
    display = Show(source, view)
    if array:
        ColorBy(display, array)
    display.Ambient, display.Diffuse = 1.0, 0.0
    # The name of the property in ParaView 5.13, and before.
    position = "Translation" if "Translation" in display.ListProperties() else "Position"
    setattr(display, position, [STEP * (index % COLUMNS), STEP * (index // COLUMNS), 0.0])
    for name, value in properties.items():
        setattr(display, name, value)
use_viridis("RTData", 100.0, 270.0)
use_viridis("Elevation", 0.0, 1.0)
look_down(view)
window = take_picture(view, "window.png")

# A camera pass, which every view of ParaView has, is not worth a warning.
with Errors("WarningEvent") as warnings:
    captured = CSLFViewScene(View=view)
    captured.UpdatePipeline()
check(not warnings.messages, f"warnings {warnings.messages}")

quality = dict(Viewpoints=3, Resolution=64, Samples=16)
for label, choice in {"default": {}, "array": dict(ColorArrayName=["POINTS", "TextureCoordinates"]),
                      "off": dict(ScalarVisibility=0)}.items():
    field = bake(captured, **quality, **choice)
    if label == "default":
        check(field.ColorArrayName[1] == "(None)", f"default {field.ColorArrayName}")
        arrays = field.GetProperty("ColorArrayName").GetDomain("array_list")
        check(arrays.GetNumberOfStrings() == 1, "arrays of the captured scene are offered")
    shown = make_view()
    Show(field, shown)
    look_down(shown)
    picture = take_picture(shown, label + ".png")
    for index, name in enumerate(surfaces):
        compare(get_cell(window, index), get_cell(picture, index), f"{label} {name}", 12)

# Sources that are baked directly: the chosen array with ParaView's table for it, also if another one
# was chosen before or the input is another than the active source, and no array by default if none
# is active. ParaView offers normals as an array, too.
SetActiveSource(ball)
direct = bake(flat, **quality)
check(direct.ColorArrayName[1] == "RTData", f"RTData is not the default: {direct.ColorArrayName}")
check(bake(ball).ColorArrayName[1] == "(None)", "a sphere is coloured by its normals")
field = bake(make_height(flat), **quality)
for array, name in (("Elevation", "Elevation"), ("RTData", "RTData")):
    field.ColorArrayName = ["POINTS", array]
    check(field.LookupTable == GetColorTransferFunction(name), f"the table is not that of {name}")
direct_view = make_view()
for source, name in ((direct, "direct"), (field, "chosen")):
    Show(source, direct_view)
    look_down(direct_view)
    picture = take_picture(direct_view, name + ".png")
    Hide(source, direct_view)
    compare(get_cell(window, 0), get_cell(picture, 0), name, 12)

# Exact colours: all of a slice's are in its lookup table, and where that has them.
field = bake(flat, **quality, Colors="Exact")
texels = fetch_array(field, "Color").astype(int)
colors = numpy.unique(texels[texels[:, 3] == 255][:, :3], axis=0)
table = GetColorTransferFunction("RTData").GetClientSideObject()
values = numpy_to_vtk(numpy.linspace(100.0, 270.0, 1024), deep=1)
mapped = vtk_to_numpy(table.MapScalars(values, 1, -1))[:, :3].astype(int)
distance = abs(colors[:, None] - mapped[None]).max(axis=2).min(axis=1)
print(f"exact: {len(colors)} colours, at most {distance.max()} from the lookup table")
check(len(colors) > 20 and distance.max() <= 2, f"{distance.max()} from the lookup table")
look_down(direct_view)
Show(field, direct_view)
compare(get_cell(window, 0), get_cell(take_picture(direct_view, "exact.png"), 0), "exact", 3)

# The same of a view with lights, which does not show them.
for index, (source, array, properties) in enumerate(surfaces.values()):
    display = GetRepresentation(source, view)
    display.Ambient, display.Diffuse, display.Specular = 0.0, 1.0, 0.5
    display.DiffuseColor = properties.get("AmbientColor", [1, 1, 1])
lit = take_picture(view, "lit.png")
check(psnr(lit, window) < 40, "the view is not lit")
captured.Colors = "Exact"
with Errors("WarningEvent") as warnings:
    field = bake(captured, **quality, Colors="Exact")
    shown = make_view()
    Show(field, shown)
    look_down(shown)
    picture = take_picture(shown, "captured_exact.png")
check(not any("exact" in message for message in warnings.messages), f"{warnings.messages}")
for index, name in enumerate(surfaces):
    tolerance = 12 if name == "opacity" else 3  # opacity is sampled
    compare(get_cell(window, index), get_cell(picture, index), f"captured exact {name}", tolerance)
