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
  ../Filters/PathTracing/cslfArithmetic.cxx
  ../Filters/PathTracing/cslfBSDF.cxx
  ../Filters/PathTracing/cslfDirectLight.cxx
  ../Filters/PathTracing/cslfDisplayedColor.cxx
  ../Filters/PathTracing/cslfDistribution.cxx
  ../Filters/PathTracing/cslfEmitter.cxx
  ../Filters/PathTracing/cslfEnvironment.cxx
  ../Filters/PathTracing/cslfEnvironmentReader.cxx
  ../Filters/PathTracing/cslfFacetLobe.cxx
  ../Filters/PathTracing/cslfFieldRays.cxx
  ../Filters/PathTracing/cslfFingerprint.cxx
  ../Filters/PathTracing/cslfHitFilter.cxx
  ../Filters/PathTracing/cslfHitGeometry.cxx
  ../Filters/PathTracing/cslfImageCurve.cxx
  ../Filters/PathTracing/cslfLightBounds.cxx
  ../Filters/PathTracing/cslfLightReader.cxx
  ../Filters/PathTracing/cslfLightTree.cxx
  ../Filters/PathTracing/cslfLocalLights.cxx
  ../Filters/PathTracing/cslfMaterialProblems.cxx
  ../Filters/PathTracing/cslfMesh.cxx
  ../Filters/PathTracing/cslfMeshJoin.cxx
  ../Filters/PathTracing/cslfMeshMaker.cxx
  ../Filters/PathTracing/cslfOldNames.cxx
  ../Filters/PathTracing/cslfPathBatch.cxx
  ../Filters/PathTracing/cslfPathIntegrator.cxx
  ../Filters/PathTracing/cslfPathStep.cxx
  ../Filters/PathTracing/cslfRayGrid.cxx
  ../Filters/PathTracing/cslfRoundView.cxx
  ../Filters/PathTracing/cslfSamplePlaces.cxx
  ../Filters/PathTracing/cslfScene.cxx
  ../Filters/PathTracing/cslfSceneBlock.cxx
  ../Filters/PathTracing/cslfSceneBuilder.cxx
  ../Filters/PathTracing/cslfStoppingRule.cxx
  ../Filters/PathTracing/cslfStreamLanes.cxx
  ../Filters/PathTracing/cslfSurfaceColors.cxx
  ../Filters/PathTracing/cslfSurfaceLanes.cxx
  ../Filters/PathTracing/cslfSurfaceMaterial.cxx
  ../Filters/PathTracing/cslfTexelRenderer.cxx
  ../Filters/PathTracing/cslfTexelSums.cxx
  ../Filters/PathTracing/cslfTexture.cxx
  ../Filters/PathTracing/cslfTextureReader.cxx
  ../Filters/PathTracing/cslfTriangles.cxx
  ../Filters/PathTracing/cslfTubeDivision.cxx)
list(APPEND private_headers
  ../Filters/PathTracing/cslfArithmetic.h
  ../Filters/PathTracing/cslfBox.h
  ../Filters/PathTracing/cslfBSDF.h
  ../Filters/PathTracing/cslfDirectLight.h
  ../Filters/PathTracing/cslfDirectionalLight.h
  ../Filters/PathTracing/cslfDistribution.h
  ../Filters/PathTracing/cslfEmbree.h
  ../Filters/PathTracing/cslfEmitter.h
  ../Filters/PathTracing/cslfEnvironment.h
  ../Filters/PathTracing/cslfEnvironmentReader.h
  ../Filters/PathTracing/cslfDiffuseLobe.h
  ../Filters/PathTracing/cslfFacetLobe.h
  ../Filters/PathTracing/cslfLobe.h
  ../Filters/PathTracing/cslfFieldRays.h
  ../Filters/PathTracing/cslfFingerprint.h
  ../Filters/PathTracing/cslfDisplayCurve.h
  ../Filters/PathTracing/cslfDisplayedColor.h
  ../Filters/PathTracing/cslfFrame.h
  ../Filters/PathTracing/cslfFresnel.h
  ../Filters/PathTracing/cslfGGX.h
  ../Filters/PathTracing/cslfHitFilter.h
  ../Filters/PathTracing/cslfHitGeometry.h
  ../Filters/PathTracing/cslfImageCurve.h
  ../Filters/PathTracing/cslfLanes.h
  ../Filters/PathTracing/cslfLambert.h
  ../Filters/PathTracing/cslfLightBounds.h
  ../Filters/PathTracing/cslfLightReader.h
  ../Filters/PathTracing/cslfLightSample.h
  ../Filters/PathTracing/cslfLightTree.h
  ../Filters/PathTracing/cslfLocalLights.h
  ../Filters/PathTracing/cslfMaterialParameters.h
  ../Filters/PathTracing/cslfMaterialProblems.h
  ../Filters/PathTracing/cslfMesh.h
  ../Filters/PathTracing/cslfMeshJoin.h
  ../Filters/PathTracing/cslfMeshMaker.h
  ../Filters/PathTracing/cslfOldNames.h
  ../Filters/PathTracing/cslfPathBatch.h
  ../Filters/PathTracing/cslfPathIntegrator.h
  ../Filters/PathTracing/cslfPathPacket.h
  ../Filters/PathTracing/cslfPathStep.h
  ../Filters/PathTracing/cslfPointLight.h
  ../Filters/PathTracing/cslfRayGrid.h
  ../Filters/PathTracing/cslfRayPacket.h
  ../Filters/PathTracing/cslfRayBin.h
  ../Filters/PathTracing/cslfRayLanes.h
  ../Filters/PathTracing/cslfRoulette.h
  ../Filters/PathTracing/cslfRoundView.h
  ../Filters/PathTracing/cslfSamplePlaces.h
  ../Filters/PathTracing/cslfSampleStream.h
  ../Filters/PathTracing/cslfSampling.h
  ../Filters/PathTracing/cslfScatterLanes.h
  ../Filters/PathTracing/cslfScene.h
  ../Filters/PathTracing/cslfSceneBlock.h
  ../Filters/PathTracing/cslfSceneBuilder.h
  ../Filters/PathTracing/cslfStoppingRule.h
  ../Filters/PathTracing/cslfStreamLanes.h
  ../Filters/PathTracing/cslfSurfaceColors.h
  ../Filters/PathTracing/cslfSurfaceLanes.h
  ../Filters/PathTracing/cslfSurfaceMaterial.h
  ../Filters/PathTracing/cslfTexelRenderer.h
  ../Filters/PathTracing/cslfTexelSums.h
  ../Filters/PathTracing/cslfTexture.h
  ../Filters/PathTracing/cslfTextureReader.h
  ../Filters/PathTracing/cslfTriangleGeometry.h
  ../Filters/PathTracing/cslfTube.h
  ../Filters/PathTracing/cslfTubeDivision.h
  ../Filters/PathTracing/cslfTriangles.h
  ../Filters/PathTracing/cslfVectorize.h)

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
  ../Filters/SceneImport/cslfAMRSurface.cxx
  ../Filters/SceneImport/cslfActorImporter.cxx
  ../Filters/SceneImport/cslfActorParts.cxx
  ../Filters/SceneImport/cslfClippedBlock.cxx
  ../Filters/SceneImport/cslfBlockLooks.cxx
  ../Filters/SceneImport/cslfCellNormals.cxx
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
  ../Filters/SceneImport/cslfAMRSurface.h
  ../Filters/SceneImport/cslfActorImporter.h
  ../Filters/SceneImport/cslfActorParts.h
  ../Filters/SceneImport/cslfClippedBlock.h
  ../Filters/SceneImport/cslfBlockLooks.h
  ../Filters/SceneImport/cslfCellNormals.h
  ../Filters/SceneImport/cslfFaceSides.h
  ../Filters/SceneImport/cslfGlyphImporter.h
  ../Filters/SceneImport/cslfImportLimits.h
  ../Filters/SceneImport/cslfImportedScene.h
  ../Filters/SceneImport/cslfLightImporter.h
  ../Filters/SceneImport/cslfMappedScalars.h
  ../Filters/SceneImport/cslfSurfaceLook.h
  ../Filters/SceneImport/cslfTextureImage.h
  ../Filters/SceneImport/cslfWindowLights.h)

# The video coding behind the encoder and the decoder.
list(APPEND sources
  ../Filters/Coding/cslfAV1.cxx
  ../Filters/Coding/cslfBackgroundSteps.cxx
  ../Filters/Coding/cslfBackgroundThread.cxx
  ../Filters/Coding/cslfCodec.cxx
  ../Filters/Coding/cslfColorFrames.cxx
  ../Filters/Coding/cslfColorRows.cxx
  ../Filters/Coding/cslfContainerReader.cxx
  ../Filters/Coding/cslfDepthCurve.cxx
  ../Filters/Coding/cslfDepthFill.cxx
  ../Filters/Coding/cslfFieldReader.cxx
  ../Filters/Coding/cslfFileHeader.cxx
  ../Filters/Coding/cslfFileParts.cxx
  ../Filters/Coding/cslfFrameConverter.cxx
  ../Filters/Coding/cslfFrameOrder.cxx
  ../Filters/Coding/cslfGroupDecoder.cxx
  ../Filters/Coding/cslfH264.cxx
  ../Filters/Coding/cslfHEVC.cxx
  ../Filters/Coding/cslfHeaderText.cxx
  ../Filters/Coding/cslfHeaderVersion1.cxx
  ../Filters/Coding/cslfMovieBoxes.cxx
  ../Filters/Coding/cslfNALUnits.cxx
  ../Filters/Coding/cslfPatchedFile.cxx
  ../Filters/Coding/cslfPerceptualQuantizer.cxx
  ../Filters/Coding/cslfRadianceFrames.cxx
  ../Filters/Coding/cslfTexelRows.cxx
  ../Filters/Coding/cslfTrack.cxx
  ../Filters/Coding/cslfTrackDecoder.cxx
  ../Filters/Coding/cslfViewpointCache.cxx
  ../Filters/Coding/cslfViewpointStore.cxx)
list(APPEND private_headers
  ../Filters/Coding/cslfAV.h
  ../Filters/Coding/cslfBackgroundSteps.h
  ../Filters/Coding/cslfBackgroundThread.h
  ../Filters/Coding/cslfBitstreams.h
  ../Filters/Coding/cslfChecksum.h
  ../Filters/Coding/cslfCodec.h
  ../Filters/Coding/cslfCodingTask.h
  ../Filters/Coding/cslfColorFrames.h
  ../Filters/Coding/cslfColorRows.h
  ../Filters/Coding/cslfContainerReader.h
  ../Filters/Coding/cslfContainerWriter.h
  ../Filters/Coding/cslfDepthCurve.h
  ../Filters/Coding/cslfDepthFill.h
  ../Filters/Coding/cslfEncodeCrew.h
  ../Filters/Coding/cslfEncodeProbe.h
  ../Filters/Coding/cslfEncodeSession.h
  ../Filters/Coding/cslfEncodeSettings.h
  ../Filters/Coding/cslfEncoderContext.h
  ../Filters/Coding/cslfFieldReader.h
  ../Filters/Coding/cslfFieldWriter.h
  ../Filters/Coding/cslfFileHeader.h
  ../Filters/Coding/cslfFileParts.h
  ../Filters/Coding/cslfFrameConverter.h
  ../Filters/Coding/cslfFrameOrder.h
  ../Filters/Coding/cslfGroupCodec.h
  ../Filters/Coding/cslfGroupCoder.h
  ../Filters/Coding/cslfGroupDecoder.h
  ../Filters/Coding/cslfGroupError.h
  ../Filters/Coding/cslfGroupStages.h
  ../Filters/Coding/cslfHeaderText.h
  ../Filters/Coding/cslfHeaderVersion1.h
  ../Filters/Coding/cslfMovieBoxes.h
  ../Filters/Coding/cslfNALUnits.h
  ../Filters/Coding/cslfPart.h
  ../Filters/Coding/cslfPartStore.h
  ../Filters/Coding/cslfPatchedFile.h
  ../Filters/Coding/cslfPerceptualQuantizer.h
  ../Filters/Coding/cslfRadianceFrames.h
  ../Filters/Coding/cslfRateControl.h
  ../Filters/Coding/cslfRateModel.h
  ../Filters/Coding/cslfTexelBytes.h
  ../Filters/Coding/cslfTexelRows.h
  ../Filters/Coding/cslfTrack.h
  ../Filters/Coding/cslfTrackDecoder.h
  ../Filters/Coding/cslfTrackFactors.h
  ../Filters/Coding/cslfVideoEncoders.h
  ../Filters/Coding/cslfViewpointCache.h
  ../Filters/Coding/cslfViewpointStore.h)

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
  ../Filters/Quality/cslfViewExposures.h
  ../Filters/Quality/cslfRobertsSequence.h
  ../Filters/Quality/cslfTexelChoice.h)

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
    ../Filters/Coding/cslfContainerWriter.cxx
    ../Filters/Coding/cslfEncodeCrew.cxx
    ../Filters/Coding/cslfEncodeProbe.cxx
    ../Filters/Coding/cslfEncodeSession.cxx
    ../Filters/Coding/cslfEncodeSettings.cxx
    ../Filters/Coding/cslfEncoderContext.cxx
    ../Filters/Coding/cslfFieldWriter.cxx
    ../Filters/Coding/cslfGroupCodec.cxx
    ../Filters/Coding/cslfGroupCoder.cxx
    ../Filters/Coding/cslfGroupError.cxx
    ../Filters/Coding/cslfGroupStages.cxx
    ../Filters/Coding/cslfPart.cxx
    ../Filters/Coding/cslfPartStore.cxx
    ../Filters/Coding/cslfRateControl.cxx
    ../Filters/Coding/cslfRateModel.cxx
    ../Filters/Coding/cslfVideoEncoders.cxx
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
