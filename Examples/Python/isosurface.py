# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A light field in a VTK pipeline and scene: a contour of image data, coloured by how steeply the
data changes there, becomes a light field, which is shown with an outline, axes and a scalar bar.
Arguments: M N samples."""
import cslf
from example import make_actor, make_field_actor, read_sizes, save_picture, set_sizes
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkPolyDataNormals, vtkProbeFilter
from vtkmodules.vtkFiltersModeling import vtkOutlineFilter
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkImagingGeneral import vtkImageGradientMagnitude
from vtkmodules.vtkRenderingAnnotation import vtkCubeAxesActor, vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws the text

# The data: an isosurface, coloured by the magnitude of the gradient.
image = vtkRTAnalyticSource()
image.SetWholeExtent(-20, 20, -20, 20, -20, 20)
image.SetStandardDeviation(0.35)
image.SetXFreq(18.0)
image.SetYFreq(12.0)
image.SetZFreq(15.0)
image.SetXMag(15.0)
image.SetYMag(15.0)
image.SetZMag(15.0)
contour = vtkContourFilter()
contour.SetInputConnection(image.GetOutputPort())
contour.SetValue(0, 120.0)
steepness = vtkImageGradientMagnitude()
steepness.SetInputConnection(image.GetOutputPort())
steepness.SetDimensionality(3)
probe = vtkProbeFilter()
probe.SetInputConnection(contour.GetOutputPort())
probe.SetSourceConnection(steepness.GetOutputPort())
surface = vtkPolyDataNormals()
surface.SetInputConnection(probe.GetOutputPort())
surface.SplittingOff()
surface.Update()

low, high = surface.GetOutput().GetPointData().GetScalars().GetRange()
colors = vtkColorTransferFunction()
colors.AddRGBPoint(low, 0.25, 0.1, 0.45)
colors.AddRGBPoint(0.5 * (low + high), 0.1, 0.6, 0.6)
colors.AddRGBPoint(high, 1.0, 0.9, 0.25)

# Its light field, under a sky that is brighter at the top.
sampler = cslf.vtkCSLFSampler()
sampler.SetInputConnection(surface.GetOutputPort())
sampler.SetLookupTable(colors)
sampler.GetCacheOptions().SetSamples(256)  # few are enough for smooth light
set_sizes(sampler, read_sizes(__doc__))
sampler.GetEnvironment().SetModeToGradient()
sampler.GetEnvironment().SetUp(0.0, 0.0, 1.0)

# The scene.
field = make_field_actor(sampler)
outlineFilter = vtkOutlineFilter()
outlineFilter.SetInputConnection(image.GetOutputPort())
outline = make_actor(outlineFilter)
outline.GetProperty().SetLineWidth(2.0)

bar = vtkScalarBarActor()
bar.SetLookupTable(colors)
bar.SetTitle("Slope")
bar.SetNumberOfLabels(4)
bar.SetLabelFormat("%.0f")
bar.SetUnconstrainedFontSize(True)
bar.SetPosition(0.85, 0.2)
bar.SetWidth(0.12)
bar.SetHeight(0.6)

renderer = vtkRenderer()
renderer.SetBackground(0.15, 0.16, 0.2)
axes = vtkCubeAxesActor()
outlineFilter.Update()
axes.SetBounds(outlineFilter.GetOutput().GetBounds())
axes.SetCamera(renderer.GetActiveCamera())
axes.SetFlyModeToOuterEdges()
axes.XAxisMinorTickVisibilityOff()
axes.YAxisMinorTickVisibilityOff()
axes.ZAxisMinorTickVisibilityOff()
for axis in range(3):
    for text in (axes.GetTitleTextProperty(axis), axes.GetLabelTextProperty(axis)):
        text.SetFontSize(12)
for prop in (field, outline, axes, bar):
    renderer.AddViewProp(prop)
camera = renderer.GetActiveCamera()
camera.SetViewUp(0.0, 0.0, 1.0)
camera.SetPosition(62.0, -114.0, 66.0)
camera.SetWindowCenter(0.1, 0.0)
renderer.ResetCameraClippingRange()

window = vtkRenderWindow()
window.SetSize(640, 480)
window.AddRenderer(renderer)
save_picture(window, "Isosurface.png")
