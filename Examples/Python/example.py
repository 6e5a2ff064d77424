# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Code shared by the examples: sizes from the command line, actors, and saving a picture."""
import argparse

import cslf
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkWindowToImageFilter


def read_sizes(description, viewpoints=9, resolution=128, samples=16):
    """M, N and samples from the command line."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("M", type=int, nargs="?", default=viewpoints, help="viewpoints a side")
    parser.add_argument("N", type=int, nargs="?", default=resolution, help="texels a side")
    parser.add_argument("samples", type=int, nargs="?", default=samples, help="rays for each texel")
    return parser.parse_args()


def set_sizes(sampler, sizes):
    """Applies the result of read_sizes to a sampler."""
    sampler.SetViewpoints(sizes.M)
    sampler.SetResolution(sizes.N)
    sampler.SetSamples(sizes.samples)


def make_field_actor(algorithm):
    """An actor of the light field from a filter, source or reader."""
    mapper = cslf.vtkCSLFMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def make_actor(algorithm):
    """An ordinary actor of polygonal data."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def save_picture(window, file_name):
    """Draws a window and saves it as PNG."""
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(file_name)
    writer.Write()
