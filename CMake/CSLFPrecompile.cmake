# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# What makes building faster. Each source still includes what it uses: the preset "dev" does without.

# Headers that most sources include are compiled once for a target.
set(cslf_precompiled_headers
  <algorithm> <array> <atomic> <chrono> <cmath> <cstddef> <cstdint> <cstring> <filesystem> <functional>
  <iterator> <limits> <map> <memory> <mutex> <numeric> <optional> <set> <sstream> <string>
  <system_error> <tuple> <utility> <vector>
  <glm/common.hpp> <glm/geometric.hpp> <glm/mat4x4.hpp> <glm/vec2.hpp> <glm/vec3.hpp> <glm/vec4.hpp>
  <glm/vector_relational.hpp>
  <vtkCellArray.h> <vtkCellData.h> <vtkDataArray.h> <vtkDoubleArray.h> <vtkFieldData.h>
  <vtkFloatArray.h> <vtkImageData.h> <vtkInformation.h> <vtkInformationVector.h> <vtkNew.h>
  <vtkObjectFactory.h> <vtkPointData.h> <vtkPoints.h> <vtkPolyData.h> <vtkSmartPointer.h>
  <vtkStreamingDemandDrivenPipeline.h> <vtkUnsignedCharArray.h>)

# Further arguments are headers, too.
function (cslf_precompile target)
  target_precompile_headers("${target}" PRIVATE ${cslf_precompiled_headers} ${ARGN})
endfunction ()

# A compiler that gets all sources of a folder reads their headers once. After a change of one source
# it takes some seconds more.
option(CSLF_UNITY_BUILD "Compile the sources of each folder together" ON)

# Compiles the sources of each of a target's folders together, but not those of VTK classes, and not
# those that have definitions of their own.
function (cslf_unite target)
  get_target_property(sources "${target}" SOURCES)
  foreach (source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(name "${source}" NAME)
    if (folder AND name MATCHES "^cslf" AND NOT IS_ABSOLUTE "${source}")
      string(REPLACE "/" "-" group "${folder}")
      set_property(SOURCE "${source}" PROPERTY UNITY_GROUP "${group}")
    endif ()
  endforeach ()
  set_target_properties("${target}" PROPERTIES
    UNITY_BUILD "${CSLF_UNITY_BUILD}"
    UNITY_BUILD_MODE GROUP)
  if (CSLF_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes the sources for headers, whose types should not have members of unnamed namespaces.
    target_compile_options("${target}" PRIVATE -Wno-subobject-linkage)
  endif ()
endfunction ()
