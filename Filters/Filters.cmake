# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes
  ../Filters/vtkCSLFCornellBoxSource
  ../Filters/vtkCSLFLight
  ../Filters/vtkCSLFMaterial
  ../Filters/vtkCSLFPathTracer
  ../Filters/vtkCSLFSampler
  ../Filters/vtkCSLFViewTracer)
list(APPEND sources
  ../Filters/PathTracing/cslfAreaLights.cxx
  ../Filters/PathTracing/cslfBSDF.cxx
  ../Filters/PathTracing/cslfDistribution.cxx
  ../Filters/PathTracing/cslfEnvironment.cxx
  ../Filters/PathTracing/cslfLightReader.cxx
  ../Filters/PathTracing/cslfPathIntegrator.cxx
  ../Filters/PathTracing/cslfScene.cxx
  ../Filters/PathTracing/cslfSceneBuilder.cxx
  ../Filters/PathTracing/cslfSurfaceColors.cxx
  ../Filters/PathTracing/cslfSurfaceMaterial.cxx
  ../Filters/PathTracing/cslfTexelRenderer.cxx
  ../Filters/PathTracing/cslfTriangles.cxx)
list(APPEND private_headers
  ../Filters/PathTracing/cslfAreaLights.h
  ../Filters/PathTracing/cslfBSDF.h
  ../Filters/PathTracing/cslfDirectionalLight.h
  ../Filters/PathTracing/cslfDistribution.h
  ../Filters/PathTracing/cslfEmbree.h
  ../Filters/PathTracing/cslfEnvironment.h
  ../Filters/PathTracing/cslfFrame.h
  ../Filters/PathTracing/cslfFresnel.h
  ../Filters/PathTracing/cslfGGX.h
  ../Filters/PathTracing/cslfLambert.h
  ../Filters/PathTracing/cslfLightReader.h
  ../Filters/PathTracing/cslfLightSample.h
  ../Filters/PathTracing/cslfPathIntegrator.h
  ../Filters/PathTracing/cslfPointLight.h
  ../Filters/PathTracing/cslfSampleStream.h
  ../Filters/PathTracing/cslfSampling.h
  ../Filters/PathTracing/cslfScene.h
  ../Filters/PathTracing/cslfSceneBuilder.h
  ../Filters/PathTracing/cslfSurfaceColors.h
  ../Filters/PathTracing/cslfSurfaceMaterial.h
  ../Filters/PathTracing/cslfTexelRenderer.h
  ../Filters/PathTracing/cslfTriangles.h
  ../Filters/cslfVTKCompatibility.h)
