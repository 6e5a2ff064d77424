# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A light field is image data, and ordinary VTK filters take it apart, slab by slab: one viewpoint
as a picture, an epipolar-plane image, and how bright the scene is from each face. Only the
viewpoints that are requested are sampled. Arguments: M N samples."""
import cslf
from example import read_sizes, set_sizes
from vtkmodules.vtkImagingCore import (vtkExtractVOI, vtkImageExtractComponents, vtkImageFlip,
                                       vtkImagePermute, vtkImageResize)
from vtkmodules.vtkImagingStatistics import vtkImageAccumulate
from vtkmodules.vtkIOImage import vtkPNGWriter

sizes = read_sizes(__doc__, viewpoints=33, resolution=64)
M, N = sizes.M, sizes.N
sampler = cslf.vtkCSLFSampler()
box = cslf.vtkCSLFCornellBoxSource()
sampler.SetInputConnection(box.GetOutputPort())
sampler.GetEnvironment().SetModeToNone()  # the box has its own lamp
set_sizes(sampler, sizes)
FRONT = 4  # the face +Z, before the box's open side


def get_viewpoint(face, i, j):
    """The z of a viewpoint: i along u, j along v."""
    return (face * M + j) * M + i


def get_tile(entry, exit_face):
    """The first x of the tile that shows an exit face: the entry face has none."""
    return (exit_face - (1 if exit_face > entry else 0)) * N


def extract(x, y, z):
    """Texels of some viewpoints, as red, green and blue; bounds are inclusive."""
    part = vtkExtractVOI()
    part.SetInputConnection(sampler.GetOutputPort())
    part.SetVOI(*x, *y, *z)
    colors = vtkImageExtractComponents()
    colors.SetInputConnection(part.GetOutputPort())
    colors.SetComponents(0, 1, 2)
    return colors


# One viewpoint: the middle of the face +Z, whose five tiles lie side by side.
z = get_viewpoint(FRONT, M // 2, M // 2)
strip = extract((0, 5 * N - 1), (0, N - 1), (z, z))
upright = vtkImageFlip()  # row 0 of a field is the top, that of VTK's images the bottom
upright.SetInputConnection(strip.GetOutputPort())
upright.SetFilteredAxis(1)

# An epipolar-plane image: one row of texels towards the face -Z, of all viewpoints along u. Objects
# near the face move fast from viewpoint to viewpoint: the flatter a line, the nearer the surface.
x = get_tile(FRONT, 5)
y = N * 2 // 3
row = extract((x, x + N - 1), (y, y),
              (get_viewpoint(FRONT, 0, M // 2), get_viewpoint(FRONT, M - 1, M // 2)))
lines = vtkImagePermute()  # viewpoints along y
lines.SetInputConnection(row.GetOutputPort())
lines.SetFilteredAxes(0, 2, 1)
wide = vtkImageResize()
wide.SetInputConnection(lines.GetOutputPort())
wide.SetOutputDimensions(5 * N, 5 * M, 1)
wide.InterpolateOff()

for picture, name in ((upright, "SlabwiseViewpoint.png"), (wide, "SlabwiseEpipolar.png")):
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(name)
    writer.Write()

# Statistics of one viewpoint of each face: the mean of green. Light leaves the box only through its
# open side.
for face in range(6):
    z = get_viewpoint(face, M // 2, M // 2)
    part = vtkExtractVOI()
    part.SetInputConnection(sampler.GetOutputPort())
    part.SetVOI(0, 5 * N - 1, 0, N - 1, z, z)
    green = vtkImageExtractComponents()
    green.SetInputConnection(part.GetOutputPort())
    green.SetComponents(1)
    statistics = vtkImageAccumulate()
    statistics.SetInputConnection(green.GetOutputPort())
    statistics.Update()
    print(f"face {face}: {statistics.GetMean()[0]:.1f} of 255")
