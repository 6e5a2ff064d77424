# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the mapper's classes, sources and shaders for Module/CMakeLists.txt.
list(APPEND classes
  ../Rendering/Export/vtkCSLFGLTFExporter
  ../Rendering/Export/vtkCSLFPageExporter
  ../Rendering/vtkCSLFMapper
  ../Rendering/vtkCSLFToneMapping)
list(APPEND sources ../Rendering/vtkCSLFCubeMapper.cxx)
list(APPEND private_headers ../Rendering/vtkCSLFCubeMapper.h)
cslf_add(Rendering
  Balls ClosedParts DrawnViews FieldTexture FlatUniforms Focus GeometryMesh LookupPicture LookupTools
  MeshLevels OpenGL Residency ShownMaps TilePool ViewFrustum ViewpointLevels)

# Export of surfaces to files for browsers and other programs.
cslf_add(Rendering/Export ShownField)
include("${CSLF_SOURCE_DIR}/Web/Web.cmake")

set(shaders "${CMAKE_CURRENT_BINARY_DIR}/Lookup/cslfLookupConstants.glsl")
foreach (shader IN ITEMS BallFS BallVS Color Cube Encoding Entry Field GeometryFS GeometryVS Guess Lookup MapperFS MapperVS
    MeanFS Normals PictureFS PictureVS SceneGrid Surface SurfaceFS ToneMapping)
  list(APPEND shaders "${CSLF_SOURCE_DIR}/Rendering/Shaders/cslf${shader}.glsl")
endforeach ()
foreach (shader IN LISTS shaders)
  cmake_path(GET shader STEM name)
  if (NOT name MATCHES "(FS|VS)$")
    string(APPEND name "GLSL")
  endif ()
  vtk_encode_string(
    INPUT "${shader}"
    NAME "${name}"
    HEADER_OUTPUT shader_header
    SOURCE_OUTPUT shader_source)
  list(APPEND sources "${shader_source}")
  list(APPEND private_headers "${shader_header}")
endforeach ()
