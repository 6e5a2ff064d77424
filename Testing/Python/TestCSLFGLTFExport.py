#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""VTK's exporter writes a field's geometry as glTF: triangles with vertex colours, read again."""
import cslf
import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the window's factory
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExport import vtkGLTFExporter
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

box = cslf.vtkCSLFCornellBoxSource()
sampler = cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.SetViewpoints(3)
sampler.SetResolution(32)
sampler.SetSamples(4)
sampler.GetEnvironment().SetModeToNone()

mapper = vtkPolyDataMapper()
mapper.SetInputConnection(sampler.GetOutputPort(1))
actor = vtkActor()
actor.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddActor(actor)
window = vtkRenderWindow()
window.AddRenderer(renderer)
mapper.Update()
exporter = vtkGLTFExporter()
exporter.SetFileName("geometry.gltf")
exporter.InlineDataOn()
exporter.SetRenderWindow(window)
exporter.Write()

reader = vtkGLTFReader()
reader.SetFileName("geometry.gltf")
reader.Update()
blocks = reader.GetOutput().NewIterator()
blocks.InitTraversal()
read = blocks.GetCurrentDataObject()
geometry = sampler.GetGeometry()
assert read.GetNumberOfCells() == geometry.GetNumberOfCells() >= 20
points = [vtk_to_numpy(data.GetPoints().GetData()) for data in (read, geometry)]
assert numpy.abs(points[0] - points[1]).max() < 1e-6
colors = vtk_to_numpy(read.GetPointData().GetArray("COLOR_0"))
expected = vtk_to_numpy(geometry.GetPointData().GetScalars())
assert expected[:, :3].max() > 100, "the geometry is black"
assert numpy.abs(255 * colors - expected).max() < 0.01
