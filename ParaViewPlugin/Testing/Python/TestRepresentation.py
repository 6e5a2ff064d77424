# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The representation: default, picture, bounds, opacity, lookups, animation, other geometry."""
import sys

import cslf
from cslfparaview import *

scene = make_scene()
# The baseline's colours; ParaView 6 has others by default.
GetColorTransferFunction("Elevation").ApplyPreset("Cool to Warm", True)
field = bake(scene, Viewpoints=9, Resolution=128)
view = make_view()
display = Show(field, view)
check(display.Representation == "Light Field", f"shown as {display.Representation}")

# The window shows the field only, when it is applied: its geometry has other colours.
controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
other_view = make_view()
check(controller.ShowInPreferredView(field.SMProxy, 1, other_view.SMProxy) is None
      and not other_view.Representations, "the geometry is shown, too")

# The camera's reset sees what was baked, not the cube or the image data of the samples.
alone = make_view()
Show(scene, alone)
for reset in (alone, view):
    ResetCamera(reset)
distance = max(abs(a - b) for a, b in zip(view.CameraPosition, alone.CameraPosition))
check(distance < 0.05, f"the camera at {view.CameraPosition}, not {alone.CameraPosition}")

look(view)
picture = take_picture(view, "field.png")

# A click on the sphere picks the field; one beside it picks nothing.
picked = view.SMProxy.Pick(SIZE // 2, SIZE // 2)
check(picked is not None and picked == display.SMProxy, f"picked {picked}")
check(view.SMProxy.Pick(3, 3) is None, "the empty corner was picked")

# The picture is that of the reference.
truth = cslf.vtkCSLFViewTracer()
truth.SetInputData(servermanager.Fetch(scene))
truth.SetLookupTable(GetColorTransferFunction("Elevation").GetClientSideObject())
truth.SetCamera(get_camera(view))
truth.SetSize(SIZE, SIZE)
truth.SetSamples(64)
truth.Update()
values = vtk_to_numpy(truth.GetOutput().GetPointData().GetScalars())
quality = psnr(picture, values.reshape(SIZE, SIZE, 4)[:, :, :3])
print(f"{quality:.2f} dB")
check(quality > 38, f"{quality} dB against the truth")
baseline = psnr(picture, read_picture(sys.argv[1]))
check(baseline > 40, f"{baseline} dB against the baseline")

# Lookups differ, worse ones most.
display.LookupMode = "Nearest"
nearest = psnr(take_picture(view, "nearest.png"), picture)
display.LookupMode = "Focal"
focal = psnr(take_picture(view, "focal.png"), picture)
check(nearest < focal < 60, f"nearest {nearest} dB, focal {focal} dB")
display.LookupMode = "Geometry"

# Opacity and exposure dim it.
display.Opacity = 0.5
check(abs(take_picture(view, "opacity.png").sum() / picture.sum() - 0.5) < 0.02, "opacity")
display.Opacity = 1.0
display.Exposure = 0.25
dim = take_picture(view, "exposure.png").sum() / picture.sum()
check(0.4 < dim < 0.65, f"exposure {dim}")
display.Exposure = 1.0

# Moved, bounds move, too.
move = "Translation" if "Translation" in display.ListProperties() else "Position"
setattr(display, move, [10.0, 0.0, 0.0])
ResetCamera(view)
check(abs(view.CameraFocalPoint[0] - 10.5) < 0.01, f"moved to {view.CameraFocalPoint}")
setattr(display, move, [0.0, 0.0, 0.0])

# A plane through the sphere hides its lower half and is hidden by the upper one.
plane = Plane(Origin=[-1.0, -1.25, 1.0], Point1=[2.0, -1.25, 1.0], Point2=[-1.0, 1.75, 1.0])
flat = Show(plane, view)
flat.AmbientColor = flat.DiffuseColor = [0.0, 1.0, 0.0]
flat.Ambient, flat.Diffuse = 1.0, 0.0
look(view)
mixed = take_picture(view, "mixed.png")
green = (mixed[:, :, 1] > 250) & (mixed[:, :, 0] < 5)
sphere = picture.sum(axis=2) > 0
check(green[~sphere].mean() > 0.3, "the plane is not seen beside the sphere")
hidden = (green & sphere).sum() / sphere.sum()
check(0.2 < hidden < 0.6, f"the plane hides {hidden} of the sphere")
Hide(plane, view)

# Hidden, it is gone.
Hide(field, view)
check(take_picture(view, "hidden.png").max() == 0, "hidden, it is still there")
Show(field, view)

# An animation of the camera.
scene = GetAnimationScene()
scene.PlayMode, scene.NumberOfFrames = "Sequence", 2
SaveAnimation("frame.png", view, ImageResolution=[SIZE, SIZE], FrameWindow=[0, 1])
for frame in range(2):
    check(psnr(read_picture(f"frame.{frame:04d}.png"), picture) > 50, f"frame {frame}")

# Image data that is not a field draws nothing and gives an error.
with Errors() as errors:
    other = Show(Wavelet(), view, "UniformGridRepresentation")
    other.SetRepresentationType("Light Field")
    Render(view)
check(errors.messages, "image data that is no light field gives no error")
