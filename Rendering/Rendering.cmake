# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Names the mapper's classes, sources and shaders for Module/CMakeLists.txt.
list(APPEND classes
  ../Rendering/vtkCSLFMapper)
list(APPEND sources
  ../Rendering/cslfFaceSpace.cxx
  ../Rendering/cslfFaceUniforms.cxx
  ../Rendering/cslfFieldTexture.cxx
  ../Rendering/cslfFlatUniforms.cxx
  ../Rendering/cslfFocus.cxx
  ../Rendering/cslfLookup.cxx
  ../Rendering/cslfLookupPicture.cxx
  ../Rendering/cslfResidency.cxx
  ../Rendering/cslfSceneGrid.cxx
  ../Rendering/cslfSight.cxx
  ../Rendering/cslfTilePool.cxx
  ../Rendering/cslfToneMapping.cxx
  ../Rendering/cslfViewpointLevels.cxx
  ../Rendering/cslfViewpointSource.cxx
  ../Rendering/vtkCSLFCubeMapper.cxx)
list(APPEND private_headers
  ../Rendering/cslfFaceSpace.h
  ../Rendering/cslfFaceUniforms.h
  ../Rendering/cslfFieldTexture.h
  ../Rendering/cslfFlatUniforms.h
  ../Rendering/cslfFocus.h
  ../Rendering/cslfLookup.h
  ../Rendering/cslfLookupPicture.h
  ../Rendering/cslfOpenGL.h
  ../Rendering/cslfResidency.h
  ../Rendering/cslfSceneGrid.h
  ../Rendering/cslfSight.h
  ../Rendering/cslfSightSeries.h
  ../Rendering/cslfTilePool.h
  ../Rendering/cslfToneMapping.h
  ../Rendering/cslfViewpointLevels.h
  ../Rendering/cslfViewpointSource.h
  ../Rendering/vtkCSLFCubeMapper.h)

foreach (shader IN ITEMS cslfCube cslfField cslfLookup cslfSceneGrid cslfToneMapping cslfMapperFS
    cslfMapperVS cslfPictureFS cslfPictureVS)
  if (shader MATCHES "(FS|VS)$")
    set(name "${shader}")
  else ()
    set(name "${shader}GLSL")
  endif ()
  vtk_encode_string(
    INPUT "${CSLF_SOURCE_DIR}/Rendering/Shaders/${shader}.glsl"
    NAME "${name}"
    HEADER_OUTPUT shader_header
    SOURCE_OUTPUT shader_source)
  list(APPEND sources "${shader_source}")
  list(APPEND private_headers "${shader_header}")
endforeach ()
