# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes
  ../Filters/vtkCSLFCornellBoxSource
  ../Filters/vtkCSLFDecoder
  ../Filters/vtkCSLFFieldQuality
  ../Filters/vtkCSLFFieldReference
  ../Filters/vtkCSLFGLTFReader
  ../Filters/vtkCSLFImageQuality
  ../Filters/vtkCSLFImageReader
  ../Filters/vtkCSLFImageWriter
  ../Filters/vtkCSLFInstances
  ../Filters/vtkCSLFLight
  ../Filters/vtkCSLFMaterial
  ../Filters/vtkCSLFPathTracer
  ../Filters/vtkCSLFResample
  ../Filters/vtkCSLFSampler
  ../Filters/vtkCSLFSceneImporter
  ../Filters/vtkCSLFViewTracer)
list(APPEND sources
  ../Filters/cslfSoundPolyData.cxx)
list(APPEND private_headers
  ../Filters/cslfJoin.h
  ../Filters/cslfPrintable.h
  ../Filters/cslfSeconds.h
  ../Filters/cslfSoundPolyData.h
  ../Filters/cslfVTKCompatibility.h)

# The path tracer behind the sampler and the view tracer.
list(APPEND sources
  ../Filters/PathTracing/Lights/cslfDirectLight.cxx
  ../Filters/PathTracing/Lights/cslfEmitter.cxx
  ../Filters/PathTracing/Lights/cslfEnvironment.cxx
  ../Filters/PathTracing/Lights/cslfEnvironmentReader.cxx
  ../Filters/PathTracing/Lights/cslfLightBounds.cxx
  ../Filters/PathTracing/Lights/cslfLightReader.cxx
  ../Filters/PathTracing/Lights/cslfLightTree.cxx
  ../Filters/PathTracing/Lights/cslfLocalLights.cxx
  ../Filters/PathTracing/Materials/cslfBSDF.cxx
  ../Filters/PathTracing/Materials/cslfDisplayedColor.cxx
  ../Filters/PathTracing/Materials/cslfFacetLobe.cxx
  ../Filters/PathTracing/Materials/cslfImageCurve.cxx
  ../Filters/PathTracing/Materials/cslfMaterialProblems.cxx
  ../Filters/PathTracing/Materials/cslfSurfaceColors.cxx
  ../Filters/PathTracing/Materials/cslfSurfaceMaterial.cxx
  ../Filters/PathTracing/Materials/cslfTexture.cxx
  ../Filters/PathTracing/Materials/cslfTextureReader.cxx
  ../Filters/PathTracing/Paths/cslfPathBatch.cxx
  ../Filters/PathTracing/Paths/cslfPathIntegrator.cxx
  ../Filters/PathTracing/Paths/cslfPathStep.cxx
  ../Filters/PathTracing/Paths/cslfSurfaceLanes.cxx
  ../Filters/PathTracing/RandomNumbers/cslfDistribution.cxx
  ../Filters/PathTracing/RandomNumbers/cslfStreamLanes.cxx
  ../Filters/PathTracing/Rays/cslfHitFilter.cxx
  ../Filters/PathTracing/Scene/cslfFingerprint.cxx
  ../Filters/PathTracing/Scene/cslfOldNames.cxx
  ../Filters/PathTracing/Scene/cslfScene.cxx
  ../Filters/PathTracing/Scene/cslfSceneBlock.cxx
  ../Filters/PathTracing/Scene/cslfSceneBuilder.cxx
  ../Filters/PathTracing/Shapes/cslfHitGeometry.cxx
  ../Filters/PathTracing/Shapes/cslfMesh.cxx
  ../Filters/PathTracing/Shapes/cslfMeshJoin.cxx
  ../Filters/PathTracing/Shapes/cslfMeshMaker.cxx
  ../Filters/PathTracing/Shapes/cslfRoundView.cxx
  ../Filters/PathTracing/Shapes/cslfTriangles.cxx
  ../Filters/PathTracing/Shapes/cslfTubeDivision.cxx
  ../Filters/PathTracing/SIMD/cslfArithmetic.cxx
  ../Filters/PathTracing/Texels/cslfFieldRays.cxx
  ../Filters/PathTracing/Texels/cslfRayGrid.cxx
  ../Filters/PathTracing/Texels/cslfSamplePlaces.cxx
  ../Filters/PathTracing/Texels/cslfStoppingRule.cxx
  ../Filters/PathTracing/Texels/cslfTexelRenderer.cxx
  ../Filters/PathTracing/Texels/cslfTexelSums.cxx)
list(APPEND private_headers
  ../Filters/PathTracing/Lights/cslfDirectionalLight.h
  ../Filters/PathTracing/Lights/cslfDirectLight.h
  ../Filters/PathTracing/Lights/cslfEmitter.h
  ../Filters/PathTracing/Lights/cslfEnvironment.h
  ../Filters/PathTracing/Lights/cslfEnvironmentReader.h
  ../Filters/PathTracing/Lights/cslfLightBounds.h
  ../Filters/PathTracing/Lights/cslfLightReader.h
  ../Filters/PathTracing/Lights/cslfLightSample.h
  ../Filters/PathTracing/Lights/cslfLightTree.h
  ../Filters/PathTracing/Lights/cslfLocalLights.h
  ../Filters/PathTracing/Lights/cslfPointLight.h
  ../Filters/PathTracing/Materials/cslfBSDF.h
  ../Filters/PathTracing/Materials/cslfDiffuseLobe.h
  ../Filters/PathTracing/Materials/cslfDisplayedColor.h
  ../Filters/PathTracing/Materials/cslfFacetLobe.h
  ../Filters/PathTracing/Materials/cslfFrame.h
  ../Filters/PathTracing/Materials/cslfFresnel.h
  ../Filters/PathTracing/Materials/cslfGGX.h
  ../Filters/PathTracing/Materials/cslfImageCurve.h
  ../Filters/PathTracing/Materials/cslfLambert.h
  ../Filters/PathTracing/Materials/cslfLobe.h
  ../Filters/PathTracing/Materials/cslfMaterialParameters.h
  ../Filters/PathTracing/Materials/cslfMaterialProblems.h
  ../Filters/PathTracing/Materials/cslfSurfaceColors.h
  ../Filters/PathTracing/Materials/cslfSurfaceMaterial.h
  ../Filters/PathTracing/Materials/cslfTexture.h
  ../Filters/PathTracing/Materials/cslfTextureReader.h
  ../Filters/PathTracing/Paths/cslfPathBatch.h
  ../Filters/PathTracing/Paths/cslfPathIntegrator.h
  ../Filters/PathTracing/Paths/cslfPathPacket.h
  ../Filters/PathTracing/Paths/cslfPathStep.h
  ../Filters/PathTracing/Paths/cslfRoulette.h
  ../Filters/PathTracing/Paths/cslfScatterLanes.h
  ../Filters/PathTracing/Paths/cslfSurfaceLanes.h
  ../Filters/PathTracing/RandomNumbers/cslfDistribution.h
  ../Filters/PathTracing/RandomNumbers/cslfSampleStream.h
  ../Filters/PathTracing/RandomNumbers/cslfSampling.h
  ../Filters/PathTracing/RandomNumbers/cslfStreamLanes.h
  ../Filters/PathTracing/Rays/cslfEmbree.h
  ../Filters/PathTracing/Rays/cslfHitFilter.h
  ../Filters/PathTracing/Rays/cslfRayBin.h
  ../Filters/PathTracing/Rays/cslfRayLanes.h
  ../Filters/PathTracing/Rays/cslfRayPacket.h
  ../Filters/PathTracing/Scene/cslfFingerprint.h
  ../Filters/PathTracing/Scene/cslfOldNames.h
  ../Filters/PathTracing/Scene/cslfScene.h
  ../Filters/PathTracing/Scene/cslfSceneBlock.h
  ../Filters/PathTracing/Scene/cslfSceneBuilder.h
  ../Filters/PathTracing/Shapes/cslfBox.h
  ../Filters/PathTracing/Shapes/cslfHitGeometry.h
  ../Filters/PathTracing/Shapes/cslfMesh.h
  ../Filters/PathTracing/Shapes/cslfMeshJoin.h
  ../Filters/PathTracing/Shapes/cslfMeshMaker.h
  ../Filters/PathTracing/Shapes/cslfRoundView.h
  ../Filters/PathTracing/Shapes/cslfTriangleGeometry.h
  ../Filters/PathTracing/Shapes/cslfTriangles.h
  ../Filters/PathTracing/Shapes/cslfTube.h
  ../Filters/PathTracing/Shapes/cslfTubeDivision.h
  ../Filters/PathTracing/SIMD/cslfArithmetic.h
  ../Filters/PathTracing/SIMD/cslfLanes.h
  ../Filters/PathTracing/SIMD/cslfVectorize.h
  ../Filters/PathTracing/Texels/cslfDisplayCurve.h
  ../Filters/PathTracing/Texels/cslfFieldRays.h
  ../Filters/PathTracing/Texels/cslfRayGrid.h
  ../Filters/PathTracing/Texels/cslfSamplePlaces.h
  ../Filters/PathTracing/Texels/cslfStoppingRule.h
  ../Filters/PathTracing/Texels/cslfTexelRenderer.h
  ../Filters/PathTracing/Texels/cslfTexelSums.h)

# The diffuse light of surfaces, computed once.
list(APPEND sources
  ../Filters/PathTracing/RadianceCache/cslfCacheCheck.cxx
  ../Filters/PathTracing/RadianceCache/cslfCacheFile.cxx
  ../Filters/PathTracing/RadianceCache/cslfChartMaker.cxx
  ../Filters/PathTracing/RadianceCache/cslfDiffuseEstimator.cxx
  ../Filters/PathTracing/RadianceCache/cslfDiffuseLookUp.cxx
  ../Filters/PathTracing/RadianceCache/cslfGatherDirections.cxx
  ../Filters/PathTracing/RadianceCache/cslfIncidentLight.cxx
  ../Filters/PathTracing/RadianceCache/cslfLatticeBuilder.cxx
  ../Filters/PathTracing/RadianceCache/cslfLatticeLayout.cxx
  ../Filters/PathTracing/RadianceCache/cslfLatticeProbe.cxx
  ../Filters/PathTracing/RadianceCache/cslfLatticeRefinement.cxx
  ../Filters/PathTracing/RadianceCache/cslfLatticeSum.cxx
  ../Filters/PathTracing/RadianceCache/cslfOpenSides.cxx
  ../Filters/PathTracing/RadianceCache/cslfRadianceCache.cxx
  ../Filters/PathTracing/RadianceCache/cslfSampleNoise.cxx
  ../Filters/PathTracing/RadianceCache/cslfSurfaceChart.cxx
  ../Filters/PathTracing/RadianceCache/cslfSurfaceLattice.cxx
  ../Filters/vtkCSLFPathTracerCache.cxx)
list(APPEND private_headers
  ../Filters/PathTracing/RadianceCache/cslfCacheCheck.h
  ../Filters/PathTracing/RadianceCache/cslfCacheFile.h
  ../Filters/PathTracing/RadianceCache/cslfCacheShare.h
  ../Filters/PathTracing/RadianceCache/cslfChartMaker.h
  ../Filters/PathTracing/RadianceCache/cslfChartNeighbours.h
  ../Filters/PathTracing/RadianceCache/cslfDiffuseEstimator.h
  ../Filters/PathTracing/RadianceCache/cslfDiffuseLookUp.h
  ../Filters/PathTracing/RadianceCache/cslfGatherDirections.h
  ../Filters/PathTracing/RadianceCache/cslfHalfSamples.h
  ../Filters/PathTracing/RadianceCache/cslfIncidentLight.h
  ../Filters/PathTracing/RadianceCache/cslfLatticeBuilder.h
  ../Filters/PathTracing/RadianceCache/cslfLatticeLayout.h
  ../Filters/PathTracing/RadianceCache/cslfLatticePatch.h
  ../Filters/PathTracing/RadianceCache/cslfLatticeProbe.h
  ../Filters/PathTracing/RadianceCache/cslfLatticeSum.h
  ../Filters/PathTracing/RadianceCache/cslfOpenSides.h
  ../Filters/PathTracing/RadianceCache/cslfRadianceCache.h
  ../Filters/PathTracing/RadianceCache/cslfSampleNoise.h
  ../Filters/PathTracing/RadianceCache/cslfSurfaceChart.h
  ../Filters/PathTracing/RadianceCache/cslfSurfaceEstimate.h
  ../Filters/PathTracing/RadianceCache/cslfSurfaceLattice.h
  ../Filters/vtkCSLFPathTracerInternals.h)

# Conversion of renderers and files to scenes.
list(APPEND sources
  ../Filters/SceneImport/cslfActorImporter.cxx
  ../Filters/SceneImport/cslfActorParts.cxx
  ../Filters/SceneImport/cslfAMRSurface.cxx
  ../Filters/SceneImport/cslfBlockLooks.cxx
  ../Filters/SceneImport/cslfCellNormals.cxx
  ../Filters/SceneImport/cslfClippedBlock.cxx
  ../Filters/SceneImport/cslfFaceSides.cxx
  ../Filters/SceneImport/cslfGlyphImporter.cxx
  ../Filters/SceneImport/cslfGraphParts.cxx
  ../Filters/SceneImport/cslfImportLimits.cxx
  ../Filters/SceneImport/cslfLightImporter.cxx
  ../Filters/SceneImport/cslfMappedScalars.cxx
  ../Filters/SceneImport/cslfMoleculeParts.cxx
  ../Filters/SceneImport/cslfPointParts.cxx
  ../Filters/SceneImport/cslfSurfaceLook.cxx
  ../Filters/SceneImport/cslfTextureImage.cxx
  ../Filters/SceneImport/cslfWindowLights.cxx)
list(APPEND private_headers
  ../Filters/SceneImport/cslfActorImporter.h
  ../Filters/SceneImport/cslfActorParts.h
  ../Filters/SceneImport/cslfAMRSurface.h
  ../Filters/SceneImport/cslfBlockLooks.h
  ../Filters/SceneImport/cslfCellNormals.h
  ../Filters/SceneImport/cslfClippedBlock.h
  ../Filters/SceneImport/cslfFaceSides.h
  ../Filters/SceneImport/cslfGlyphImporter.h
  ../Filters/SceneImport/cslfImportedScene.h
  ../Filters/SceneImport/cslfImportLimits.h
  ../Filters/SceneImport/cslfLightImporter.h
  ../Filters/SceneImport/cslfMappedScalars.h
  ../Filters/SceneImport/cslfSurfaceLook.h
  ../Filters/SceneImport/cslfTextureImage.h
  ../Filters/SceneImport/cslfWindowLights.h)

# The video coding behind the encoder and the decoder.
list(APPEND sources
  ../Filters/Coding/Codecs/cslfAV1.cxx
  ../Filters/Coding/Codecs/cslfCodec.cxx
  ../Filters/Coding/Codecs/cslfH264.cxx
  ../Filters/Coding/Codecs/cslfHEVC.cxx
  ../Filters/Coding/Codecs/cslfNALUnits.cxx
  ../Filters/Coding/Containers/cslfContainerReader.cxx
  ../Filters/Coding/Containers/cslfFileHeader.cxx
  ../Filters/Coding/Containers/cslfFileParts.cxx
  ../Filters/Coding/Containers/cslfHeaderText.cxx
  ../Filters/Coding/Containers/cslfHeaderVersion1.cxx
  ../Filters/Coding/Containers/cslfMovieBoxes.cxx
  ../Filters/Coding/Containers/cslfPatchedFile.cxx
  ../Filters/Coding/Frames/cslfColorFrames.cxx
  ../Filters/Coding/Frames/cslfColorRows.cxx
  ../Filters/Coding/Frames/cslfDepthCurve.cxx
  ../Filters/Coding/Frames/cslfDepthFill.cxx
  ../Filters/Coding/Frames/cslfFrameConverter.cxx
  ../Filters/Coding/Frames/cslfFrameOrder.cxx
  ../Filters/Coding/Frames/cslfPerceptualQuantizer.cxx
  ../Filters/Coding/Frames/cslfRadianceFrames.cxx
  ../Filters/Coding/Frames/cslfTexelRows.cxx
  ../Filters/Coding/Frames/cslfTrack.cxx
  ../Filters/Coding/Groups/cslfGroupDecoder.cxx
  ../Filters/Coding/Groups/cslfTrackDecoder.cxx
  ../Filters/Coding/Reading/cslfBackgroundSteps.cxx
  ../Filters/Coding/Reading/cslfBackgroundThread.cxx
  ../Filters/Coding/Reading/cslfFieldReader.cxx
  ../Filters/Coding/Reading/cslfViewpointCache.cxx
  ../Filters/Coding/Reading/cslfViewpointStore.cxx)
list(APPEND private_headers
  ../Filters/Coding/Codecs/cslfAV.h
  ../Filters/Coding/Codecs/cslfBitstreams.h
  ../Filters/Coding/Codecs/cslfCodec.h
  ../Filters/Coding/Codecs/cslfEncoderContext.h
  ../Filters/Coding/Codecs/cslfNALUnits.h
  ../Filters/Coding/Codecs/cslfVideoEncoders.h
  ../Filters/Coding/Containers/cslfChecksum.h
  ../Filters/Coding/Containers/cslfContainerReader.h
  ../Filters/Coding/Containers/cslfContainerWriter.h
  ../Filters/Coding/Containers/cslfFileHeader.h
  ../Filters/Coding/Containers/cslfFileParts.h
  ../Filters/Coding/Containers/cslfHeaderText.h
  ../Filters/Coding/Containers/cslfHeaderVersion1.h
  ../Filters/Coding/Containers/cslfMovieBoxes.h
  ../Filters/Coding/Containers/cslfPatchedFile.h
  ../Filters/Coding/Frames/cslfColorFrames.h
  ../Filters/Coding/Frames/cslfColorRows.h
  ../Filters/Coding/Frames/cslfDepthCurve.h
  ../Filters/Coding/Frames/cslfDepthFill.h
  ../Filters/Coding/Frames/cslfFrameConverter.h
  ../Filters/Coding/Frames/cslfFrameOrder.h
  ../Filters/Coding/Frames/cslfPerceptualQuantizer.h
  ../Filters/Coding/Frames/cslfRadianceFrames.h
  ../Filters/Coding/Frames/cslfTexelBytes.h
  ../Filters/Coding/Frames/cslfTexelRows.h
  ../Filters/Coding/Frames/cslfTrack.h
  ../Filters/Coding/Groups/cslfCodingTask.h
  ../Filters/Coding/Groups/cslfGroupCodec.h
  ../Filters/Coding/Groups/cslfGroupCoder.h
  ../Filters/Coding/Groups/cslfGroupDecoder.h
  ../Filters/Coding/Groups/cslfGroupError.h
  ../Filters/Coding/Groups/cslfTrackDecoder.h
  ../Filters/Coding/RateControl/cslfEncodeProbe.h
  ../Filters/Coding/RateControl/cslfGroupStages.h
  ../Filters/Coding/RateControl/cslfRateControl.h
  ../Filters/Coding/RateControl/cslfRateModel.h
  ../Filters/Coding/RateControl/cslfTrackFactors.h
  ../Filters/Coding/Reading/cslfBackgroundSteps.h
  ../Filters/Coding/Reading/cslfBackgroundThread.h
  ../Filters/Coding/Reading/cslfFieldReader.h
  ../Filters/Coding/Reading/cslfViewpointCache.h
  ../Filters/Coding/Reading/cslfViewpointStore.h
  ../Filters/Coding/Writing/cslfEncodeCrew.h
  ../Filters/Coding/Writing/cslfEncodeSession.h
  ../Filters/Coding/Writing/cslfEncodeSettings.h
  ../Filters/Coding/Writing/cslfFieldWriter.h
  ../Filters/Coding/Writing/cslfPart.h
  ../Filters/Coding/Writing/cslfPartStore.h)

# Files and folders that appear complete. One folder has the implementation for each system.
if (WIN32)
  set(cslf_system Windows)
  list(APPEND private_headers
    ../Filters/Files/Windows/cslfWindows.h)
else ()
  set(cslf_system POSIX)
endif ()
list(APPEND sources
  "../Filters/Files/${cslf_system}/cslfFileSystem.cxx"
  "../Filters/Files/${cslf_system}/cslfLockedFile.cxx"
  ../Filters/Files/cslfFileLock.cxx
  ../Filters/Files/cslfFileSystem.cxx
  ../Filters/Files/cslfLibraries.cxx
  ../Filters/Files/cslfWholeFile.cxx
  ../Filters/Files/cslfWorkFolder.cxx)
list(APPEND private_headers
  ../Filters/Files/cslfFileLock.h
  ../Filters/Files/cslfFileSystem.h
  ../Filters/Files/cslfLibraries.h
  ../Filters/Files/cslfLockedFile.h
  ../Filters/Files/cslfWholeFile.h
  ../Filters/Files/cslfWorkFolder.h)

# Folders of cube maps.
list(APPEND sources
  ../Filters/CubeMaps/cslfCubeMapFiles.cxx
  ../Filters/CubeMaps/cslfEXRHeader.cxx)
list(APPEND private_headers
  ../Filters/CubeMaps/cslfCubeMapFiles.h
  ../Filters/CubeMaps/cslfEXRHeader.h)

# Looking up rays in a field. Its constants become a header and a shader.
list(APPEND sources
  ../Filters/Lookup/cslfChannelReader.cxx
  ../Filters/Lookup/cslfFaceSpace.cxx
  ../Filters/Lookup/cslfLookup.cxx
  ../Filters/Lookup/cslfSceneGrid.cxx)
list(APPEND private_headers
  ../Filters/Lookup/cslfChannelReader.h
  ../Filters/Lookup/cslfFaceSpace.h
  ../Filters/Lookup/cslfLookup.h
  ../Filters/Lookup/cslfSceneGrid.h
  "${CMAKE_CURRENT_BINARY_DIR}/Lookup/cslfLookupConstants.h")
set(constants "${CSLF_SOURCE_DIR}/Filters/Lookup/cslfLookupConstants.in")
set(REAL "const float")
set(INT "const int")
configure_file("${constants}" Lookup/cslfLookupConstants.glsl @ONLY)
set(REAL "constexpr double")
set(INT "constexpr int")
set(BEGIN "#ifndef cslfLookupConstants_h\n#define cslfLookupConstants_h\nnamespace cslf::lookup\n{")
set(END "}\n#endif")
configure_file("${constants}" Lookup/cslfLookupConstants.h @ONLY)

# Measures of quality.
list(APPEND private_headers
  ../Filters/Quality/cslfHeldOutViews.h
  ../Filters/Quality/cslfPSNR.h
  ../Filters/Quality/cslfRobertsSequence.h
  ../Filters/Quality/cslfTexelChoice.h
  ../Filters/Quality/cslfViewExposures.h)

# Cooperation of several processes.
list(APPEND sources
  ../Filters/Parallel/cslfBroadcast.cxx
  ../Filters/Parallel/cslfCacheKeeper.cxx
  ../Filters/Parallel/cslfRanks.cxx
  ../Filters/Parallel/cslfSceneGather.cxx)
list(APPEND private_headers
  ../Filters/Parallel/cslfBroadcast.h
  ../Filters/Parallel/cslfCacheKeeper.h
  ../Filters/Parallel/cslfRanks.h
  ../Filters/Parallel/cslfSceneGather.h)

# Reading fields slab by slab.
list(APPEND sources
  ../Filters/Pipeline/cslfArrayLayout.cxx
  ../Filters/Pipeline/cslfFieldArrays.cxx
  ../Filters/Pipeline/cslfPipelineWatch.cxx
  ../Filters/Pipeline/cslfScenePipeline.cxx
  ../Filters/Pipeline/cslfSlabs.cxx)
list(APPEND private_headers
  ../Filters/Pipeline/cslfArrayLayout.h
  ../Filters/Pipeline/cslfFieldArrays.h
  ../Filters/Pipeline/cslfGuard.h
  ../Filters/Pipeline/cslfKeptGroups.h
  ../Filters/Pipeline/cslfParallelFor.h
  ../Filters/Pipeline/cslfPipelineWatch.h
  ../Filters/Pipeline/cslfScenePipeline.h
  ../Filters/Pipeline/cslfSlabs.h
  ../Filters/Pipeline/cslfSlicePuller.h)

# Estimates of costs.
list(APPEND private_headers
  ../Filters/Planning/cslfBakeProbe.h
  ../Filters/Planning/cslfFieldDetail.h)

# Reduction of fields.
list(APPEND sources
  ../Filters/Resampling/cslfNesting.cxx
  ../Filters/Resampling/cslfTexelReducer.cxx)
list(APPEND private_headers
  ../Filters/Resampling/cslfKeyViews.h
  ../Filters/Resampling/cslfNesting.h
  ../Filters/Resampling/cslfTexelReducer.h)

# Video encoding, and classes that need it.
if (CSLF_ENABLE_ENCODER)
  list(APPEND classes
    ../Filters/vtkCSLFBakeEstimator
    ../Filters/vtkCSLFEncoder)
  list(APPEND sources
    ../Filters/Coding/Containers/cslfContainerWriter.cxx
    ../Filters/Coding/Writing/cslfEncodeCrew.cxx
    ../Filters/Coding/RateControl/cslfEncodeProbe.cxx
    ../Filters/Coding/Writing/cslfEncodeSession.cxx
    ../Filters/Coding/Writing/cslfEncodeSettings.cxx
    ../Filters/Coding/Codecs/cslfEncoderContext.cxx
    ../Filters/Coding/Writing/cslfFieldWriter.cxx
    ../Filters/Coding/Groups/cslfGroupCodec.cxx
    ../Filters/Coding/Groups/cslfGroupCoder.cxx
    ../Filters/Coding/Groups/cslfGroupError.cxx
    ../Filters/Coding/RateControl/cslfGroupStages.cxx
    ../Filters/Coding/Writing/cslfPart.cxx
    ../Filters/Coding/Writing/cslfPartStore.cxx
    ../Filters/Coding/RateControl/cslfRateControl.cxx
    ../Filters/Coding/RateControl/cslfRateModel.cxx
    ../Filters/Coding/Codecs/cslfVideoEncoders.cxx
    ../Filters/Pipeline/cslfSlicePuller.cxx
    ../Filters/Planning/cslfBakeProbe.cxx
    ../Filters/Planning/cslfFieldDetail.cxx
    ../Filters/Quality/cslfHeldOutViews.cxx
    ../Filters/Resampling/cslfKeyViews.cxx)
endif ()

# The reader of glTF files.
list(APPEND sources
  ../Filters/GLTF/cslfGLTFAccessor.cxx
  ../Filters/GLTF/cslfGLTFBlocks.cxx
  ../Filters/GLTF/cslfGLTFDocument.cxx
  ../Filters/GLTF/cslfGLTFImages.cxx
  ../Filters/GLTF/cslfGLTFMaterials.cxx
  ../Filters/GLTF/cslfGLTFPrimitives.cxx
  ../Filters/GLTF/cslfGLTFValue.cxx)
list(APPEND private_headers
  ../Filters/GLTF/cslfGLTFAccessor.h
  ../Filters/GLTF/cslfGLTFBlocks.h
  ../Filters/GLTF/cslfGLTFDocument.h
  ../Filters/GLTF/cslfGLTFImages.h
  ../Filters/GLTF/cslfGLTFMaterials.h
  ../Filters/GLTF/cslfGLTFPrimitives.h
  ../Filters/GLTF/cslfGLTFProblems.h
  ../Filters/GLTF/cslfGLTFValue.h)
