# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause

# Headers that most sources include are compiled once for a target. Each source still includes what
# it uses: the preset "dev" compiles without this.
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
