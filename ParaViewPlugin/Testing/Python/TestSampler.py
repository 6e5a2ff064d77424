# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The sampler: size, colours of the lookup table that ParaView shows, materials, the box, cancel."""
from cslfparaview import *

scene = make_scene()
field = bake(scene)
color = fetch_array(field, "Color")
check(color.shape == (5 * 64 * 64 * 6 * 25, 4), f"size {color.shape}")
check(field.LookupTable == GetColorTransferFunction("Elevation"), "not ParaView's lookup table")
information = field.GetDataInformation().GetFieldDataInformation()
check(information.GetArrayInformation("CSLF") is not None, "no description")

# Another lookup table gives other colours.
table = GetColorTransferFunction("Elevation")
table.RGBPoints = [0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]
red = fetch_array(field, "Color").astype(float)
hit = red[:, 3] == 255
check(hit.any() and red[hit][:, 0].mean() > 20 * red[hit][:, 1].mean() + 1, "not red")

# Without scalars, the material's colour.
material = CSLFMaterial(Input=scene, BaseColor=[0.0, 0.0, 1.0])
blue = fetch_array(bake(material, ScalarVisibility=0), "Color").astype(float)
hit = blue[:, 3] == 255
check(hit.any() and blue[hit][:, 2].mean() > 20 * blue[hit][:, 0].mean() + 1, "not blue")
check(scene.GetDataInformation().GetFieldDataInformation().GetNumberOfArrays() == 0,
      "the material's input was changed")

# A cube that is set in both ways, and one that does not contain the scene. Without geometry, the
# cube's are the bounds.
view = make_view()
Show(field, view)
Render(view)
bounds = GetRepresentation(field, view).GetRepresentedDataInformation().GetBounds()
sphere = scene.GetDataInformation().GetBounds()
check(max(abs(a - b) for a, b in zip(bounds, sphere)) < 0.01, f"bounds of the geometry {bounds}")
field.AutomaticCube, field.GeometryTriangles = 0, 0


def check_cube(expected, margin):
    Show(field, view)
    Render(view)
    bounds = GetRepresentation(field, view).GetRepresentedDataInformation().GetBounds()
    wider = [value + (margin if i % 2 else -margin) for i, value in enumerate(expected)]
    check(max(abs(a - b) for a, b in zip(bounds, wider)) < 1e-6, f"bounds {bounds}")


field.CubePosition, field.CubeLengths = [-0.5, -0.75, 0.0], [2.0, 2.0, 2.0]
check_cube((-0.5, 1.5, -0.75, 1.25, 0.0, 2.0), 0.002)
field.UseReferenceBounds, field.ReferenceBounds = 1, [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0]
field.CubePosition, field.CubeLengths = [0.5, 0.25, 0.5], [1.0, 1.5, 1.5]
check_cube((-0.5, 1.5, -1.25, 1.75, -1.0, 2.0), 0.003)
field.UseReferenceBounds = 0
with Errors() as errors:
    field.CubeLengths = [0.1, 0.1, 0.1]
    field.UpdatePipeline()
check(any("cube" in message.lower() for message in errors.messages), "a cube too small is taken")

# Cancel: a stopped filter leaves nothing, and works again later.
field = bake(scene, Seed=1)
algorithm = field.GetClientSideObject()
steps = []


def cancel(caller, event):
    steps.append(caller.GetProgress())
    if caller.GetProgress() > 0.1:
        caller.SetAbortExecute(1)


tag = algorithm.AddObserver("ProgressEvent", cancel)
field.UpdatePipeline()
algorithm.RemoveObserver(tag)
# ParaView then asks for the geometry, whose progress begins anew.
steps = steps[:steps.index(1.0) + 1]
check(len(steps) > 2 and steps == sorted(steps), f"progress {steps}")
check(field.GetDataInformation().GetNumberOfPoints() == 0, "what was cancelled has points")
algorithm.SetAbortExecute(0)
field.Seed = 2
field.UpdatePipeline()
check(field.GetDataInformation().GetNumberOfPoints() == color.shape[0], "no new start")

# Coarser fields.
coarse = CSLFResample(Input=bake(scene), ResolutionDivisor=2, ViewpointStride=2)
check(fetch_array(coarse, "Color").shape[0] == 5 * 32 * 32 * 6 * 9, "resampled size")
