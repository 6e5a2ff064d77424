# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A renderer to be sampled."""
import cslf
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

sphere = vtkSphereSource()
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(sphere.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
sampler = cslf.vtkCSLFSampler()
sampler.SetViewpoints(2)
sampler.SetResolution(16)
sampler.SetSamples(1)
@BLOCK_1@
sampler.Update()
assert sampler.GetOutput().GetPointData().GetArray("Color").GetRange(3)[1] == 255.0
