# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the filters' classes and sources for Module/CMakeLists.txt.
list(APPEND classes
  ../Filters/vtkCSLFDecoder
  ../Filters/vtkCSLFFieldQuality
  ../Filters/vtkCSLFGeometryFilter
  ../Filters/vtkCSLFImageQuality
  ../Filters/vtkCSLFRateControl
  ../Filters/vtkCSLFResample
  ../Filters/vtkCSLFSeriesReader)

# Files and folders that appear complete. One folder has the implementation for each system.
cslf_add(Filters/Files AtomicFile FileSeries FileSystem JSONFile LockedFile WorkFolder)
if (WIN32)
  cslf_add(Filters/Files/Windows FileSystem LockedFile Windows)
else ()
  cslf_add(Filters/Files/POSIX FileSystem LockedFile)
endif ()

# Values side by side, and random numbers.
cslf_add(Filters/SIMD Lanes Vectorize)
cslf_add(Filters/RandomNumbers Distribution SampleStream Sampling)

# Cooperation of several processes.
cslf_add(Filters/Parallel Ranks)

# Running filters, and reading fields slab by slab.
cslf_add(Filters/Pipeline
  ArrayLayout ColorMap FieldArrays FieldStore FieldStream GeometryArrays Guard Interpreter MapImage ParallelFor SurfaceArray
  Phase PolygonFill Requests ScenePipeline TableCopy TriangleList ValidPolyData
  VTKCompatibility)

# Reduction of fields.
cslf_add(Filters/Resampling KeyViews TexelReducer)

# Triangles that say where surfaces are.
cslf_add(Filters/Geometry
  ColorFit DepthMesher DepthSurfaces DepthTile DepthViews GeometryData PointColors Reduction SideColors
  SurfaceError SurfaceMesh TileFrame TilePatch ViewpointChoice)

# Looking up rays in a field. Its constants become a header and a shader.
cslf_add(Filters/Lookup ChannelReader FaceSpace Lookup SceneGrid SurfaceLookup)
list(APPEND private_headers "${CMAKE_CURRENT_BINARY_DIR}/Lookup/cslfLookupConstants.h")
set(constants "${CSLF_SOURCE_DIR}/Filters/Lookup/cslfLookupConstants.in")
set(REAL "const float")
set(INT "const int")
configure_file("${constants}" Lookup/cslfLookupConstants.glsl @ONLY)
set(REAL "constexpr double")
set(INT "constexpr int")
set(BEGIN "#ifndef cslfLookupConstants_h\n#define cslfLookupConstants_h\nnamespace cslf::lookup\n{")
set(END "}\n#endif")
configure_file("${constants}" Lookup/cslfLookupConstants.h @ONLY)

# The table of options, which becomes a header. The plugin's XML is made of it, too.
include("${CSLF_SOURCE_DIR}/Filters/Options/cslfOptions.cmake")
configure_file("${CSLF_SOURCE_DIR}/Filters/Options/cslfOptionTable.h.in" Options/cslfOptionTable.h
  @ONLY)
cslf_add(Filters/Options Option)
list(APPEND private_headers "${CMAKE_CURRENT_BINARY_DIR}/Options/cslfOptionTable.h")

# Colour maps with names.
cslf_add(Filters/SceneLook NamedColorMaps)

# Measures of quality.
cslf_add(Filters/Quality DisplayCurve TexelChoice)

# Videos: their frames, codecs and containers, and the decoder.
cslf_add(Filters/Coding/Codecs AV AV1Bitstream Bitstreams Codec Track)
cslf_add(Filters/Coding/Geometry
  ArrayCodes BodyGroups GeometryCodec GeometryFit GeometryRays GeometryStreams GeometryTexels MapCodes
  ShownRays)
cslf_add(Filters/Coding/Containers
  ContainerReader FileHeader FileParts MovieBoxes)
cslf_add(Filters/Coding/Frames
  ColorFrames ColorRows FrameConverter FrameOrder PushPull)
cslf_add(Filters/Coding/Groups TrackDecoder)
cslf_add(Filters/Coding/Reading
  BackgroundSteps BackgroundThread FieldReader GroupDecoder ViewpointStore)

# The encoder.
if (CSLF_ENABLE_ENCODER)
  list(APPEND classes ../Filters/vtkCSLFEncoder)
  cslf_add(Filters/Coding/Codecs VideoEncoders)
  cslf_add(Filters/Coding/Containers ContainerWriter)
  cslf_add(Filters/Coding/Groups GroupEncoder)
  cslf_add(Filters/Coding/RateControl RateControl RateModel)
  cslf_add(Filters/Coding/Writing
    EncodeProbe EncodeRanks EncodeSession EncodeSettings FileAssembler GeometryPlan
    GroupCoder GroupStore HeldOutViews ViewpointReader)
endif ()

# The sampler: the path tracer, scenes for it, and folders of cube maps.
if (CSLF_ENABLE_SAMPLER)
  list(APPEND classes
    ../Filters/SceneData/vtkCSLFInstances
    ../Filters/SceneData/vtkCSLFLight
    ../Filters/SceneData/vtkCSLFMaterial
    ../Filters/SceneData/vtkCSLFVolume
    ../Filters/vtkCSLFCornellBoxSource
    ../Filters/vtkCSLFEnvironment
    ../Filters/vtkCSLFFieldCertifier
    ../Filters/vtkCSLFFieldReference
    ../Filters/vtkCSLFGLTFReader
    ../Filters/vtkCSLFImageReader
    ../Filters/vtkCSLFImageWriter
    ../Filters/vtkCSLFPathTracer
    ../Filters/vtkCSLFRadianceCacheOptions
    ../Filters/vtkCSLFSampler
    ../Filters/vtkCSLFSceneImporter
    ../Filters/vtkCSLFSceneLook
    ../Filters/vtkCSLFSceneSource
    ../Filters/vtkCSLFViewTracer)
  list(APPEND sources
    ../Filters/vtkCSLFPathTracerCache.cxx ../Filters/vtkCSLFPathTracerRendering.cxx)
  list(APPEND private_headers ../Filters/vtkCSLFPathTracerInternals.h)
  cslf_add(Filters/Parallel SceneGather)
  cslf_add(Filters/PathTracing/Geometry
    GeometryMaker SceneArrays SceneMaps SeenPlaces ShapeGroups SurfaceLight SurfaceRegions Tessellation)
  cslf_add(Filters/PathTracing/Lights
    Environment LightBounds LightTree LocalLights PointLight)
  cslf_add(Filters/PathTracing/Materials
    BSDF DisplayedColor GGX Lobe SurfaceMaterial Texture)
  cslf_add(Filters/PathTracing/Paths DirectLight PathBatch PathIntegrator SurfaceLanes)
  cslf_add(Filters/PathTracing/RadianceCache
    CacheCheck CacheKeeper CacheShare ChartMaker DiffuseEstimator DiffuseLookUp
    GatherDirections IncidentLight LatticeBuilder LatticeLayout LatticeProbe
    LatticeRefinement LatticeSum LayoutProgress MeshEdges OpenSides RadianceCache
    SampleNoise ShapeLayout ShapeLight ShapePoints SurfaceChart SurfaceEstimate SurfaceLattice)
  cslf_add(Filters/PathTracing/Rays Embree HitFilter HitGeometry RayGrid RayLanes RayPacket)
  cslf_add(Filters/PathTracing/Scene
    Fingerprint LightReader MeshJoin MeshMaker PointSpacing Scene SceneBlock SceneBuilder
    SurfaceColors)
  cslf_add(Filters/PathTracing/Shapes Mesh RoundView TriangleGeometry Triangles Tube)
  cslf_add(Filters/PathTracing/Texels
    Arithmetic CenterSurfaces ChannelSum SamplePlaces StoppingRule TexelRenderer
    TexelSums)
  cslf_add(Filters/PathTracing/Volumes PhaseFunction Volume VolumeReader VolumeSet)
  cslf_add(Filters/CubeMaps CubeMapFiles)
  # How well fields show their scenes.
  cslf_add(Filters/Certificate Certifier PixelBeams ShownPixels)
  # Textures.
  cslf_add(Filters/Files EncodedImage)
  cslf_add(Filters/Images ImageFiles)
  cslf_add(Filters/GLTF GLTFDocument GLTFMaterials GLTFPrimitives)
  cslf_add(Filters/SceneData
    MaterialProblems SurfaceAppearance TextureImage WindowLights)
  cslf_add(Filters/SceneImport
    ActorImporter ActorParts AMRSurface BlockAppearances CellKinds ClippedBlock
    FaceSides GlyphImporter ImportedScene LightImporter MappedScalars PointParts VolumeImporter)
  cslf_add(Filters/SceneLook SurfaceColoring)
  cslf_add(Filters/Scenes Assembly Molecule Pipes ProceduralScene Streamlines Terrain Turbulence)
endif ()

# Estimates of costs, and scenes that change over time.
if (CSLF_ENABLE_ENCODER)
  list(APPEND classes ../Filters/Planning/vtkCSLFBakeEstimator ../Filters/vtkCSLFSeriesWriter)
  cslf_add(Filters/Planning BakeProbe FieldDetail)
endif ()
