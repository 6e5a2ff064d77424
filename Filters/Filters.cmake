# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes
  ../Filters/vtkCSLFCornellBoxSource
  ../Filters/vtkCSLFDecoder
  ../Filters/vtkCSLFEncoder
  ../Filters/vtkCSLFFieldQuality
  ../Filters/vtkCSLFImageQuality
  ../Filters/vtkCSLFImageReader
  ../Filters/vtkCSLFImageWriter
  ../Filters/vtkCSLFLight
  ../Filters/vtkCSLFMaterial
  ../Filters/vtkCSLFPathTracer
  ../Filters/vtkCSLFResample
  ../Filters/vtkCSLFSampler
  ../Filters/vtkCSLFViewTracer)
list(APPEND private_headers
  ../Filters/cslfVTKCompatibility.h)

# The path tracer behind the sampler and the view tracer.
list(APPEND sources
  ../Filters/PathTracing/cslfAreaLights.cxx
  ../Filters/PathTracing/cslfBSDF.cxx
  ../Filters/PathTracing/cslfDistribution.cxx
  ../Filters/PathTracing/cslfEnvironment.cxx
  ../Filters/PathTracing/cslfFingerprint.cxx
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
  ../Filters/PathTracing/cslfFingerprint.h
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
  ../Filters/PathTracing/cslfTriangles.h)

# The video coding behind the encoder and the decoder.
list(APPEND sources
  ../Filters/Coding/cslfContainerReader.cxx
  ../Filters/Coding/cslfContainerWriter.cxx
  ../Filters/Coding/cslfDepthFill.cxx
  ../Filters/Coding/cslfEncodeSession.cxx
  ../Filters/Coding/cslfFieldReader.cxx
  ../Filters/Coding/cslfFieldWriter.cxx
  ../Filters/Coding/cslfFileHeader.cxx
  ../Filters/Coding/cslfFileLock.cxx
  ../Filters/Coding/cslfFrameConverter.cxx
  ../Filters/Coding/cslfFrameOrder.cxx
  ../Filters/Coding/cslfGroupCodec.cxx
  ../Filters/Coding/cslfHEVC.cxx
  ../Filters/Coding/cslfPart.cxx
  ../Filters/Coding/cslfPartStore.cxx
  ../Filters/Coding/cslfTrack.cxx)
list(APPEND private_headers
  ../Filters/Coding/cslfAV.h
  ../Filters/Coding/cslfContainerReader.h
  ../Filters/Coding/cslfContainerWriter.h
  ../Filters/Coding/cslfDepthFill.h
  ../Filters/Coding/cslfEncodeSession.h
  ../Filters/Coding/cslfFieldReader.h
  ../Filters/Coding/cslfFieldWriter.h
  ../Filters/Coding/cslfFileHeader.h
  ../Filters/Coding/cslfFileLock.h
  ../Filters/Coding/cslfFrameConverter.h
  ../Filters/Coding/cslfFrameOrder.h
  ../Filters/Coding/cslfGroupCodec.h
  ../Filters/Coding/cslfHEVC.h
  ../Filters/Coding/cslfPart.h
  ../Filters/Coding/cslfPartStore.h
  ../Filters/Coding/cslfTrack.h)

# Folders of cube maps.
list(APPEND sources
  ../Filters/CubeMaps/cslfCubeMapFiles.cxx)
list(APPEND private_headers
  ../Filters/CubeMaps/cslfCubeMapFiles.h)

# Measures of quality.
list(APPEND private_headers
  ../Filters/Quality/cslfPSNR.h)

# Several processes at work together.
list(APPEND sources
  ../Filters/Parallel/cslfRanks.cxx
  ../Filters/Parallel/cslfSceneGather.cxx)
list(APPEND private_headers
  ../Filters/Parallel/cslfRanks.h
  ../Filters/Parallel/cslfSceneGather.h)

# Pulling fields slab by slab.
list(APPEND sources
  ../Filters/Pipeline/cslfPipelineWatch.cxx
  ../Filters/Pipeline/cslfSlabs.cxx
  ../Filters/Pipeline/cslfSlicePuller.cxx)
list(APPEND private_headers
  ../Filters/Pipeline/cslfPipelineWatch.h
  ../Filters/Pipeline/cslfSlabs.h
  ../Filters/Pipeline/cslfSlicePuller.h)

# Coarser fields.
list(APPEND sources
  ../Filters/Resampling/cslfNesting.cxx
  ../Filters/Resampling/cslfTexelReducer.cxx)
list(APPEND private_headers
  ../Filters/Resampling/cslfNesting.h
  ../Filters/Resampling/cslfTexelReducer.h)
