// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays that surfaces have beside the scalars that gave them their colours, so that mappers can
 * show these as well.
 */
#ifndef cslfSurfaceArray_h
#define cslfSurfaceArray_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkType.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace cslf
{
/// Arrays with more components are not kept.
constexpr int MaximumArrayComponents = 64;

/// An array of the points of a surface. What is missing at a point is not a number.
struct VTKCSLF_EXPORT SurfaceArray
{
  struct Component
  {
    std::string Name; ///< empty if the array has one component, which has no name
    std::vector<double> Values;
  };

  std::string Name;
  std::vector<Component> Components;
  bool IsInteger = false; ///< whether integers must be kept

  /// A component's value at a point, or the magnitude if the component is negative.
  double GetValue(std::size_t point, int component) const;

  /// The finite values of a component, or of the magnitude if it is negative. Nothing without any.
  std::optional<std::array<double, 2>> GetRange(int component) const;

  /// The component that a text means: "Velocity" the first, "Velocity X", "Velocity 0" or
  /// "Velocity Magnitude" that one. Nothing if it means another array.
  std::optional<int> FindComponent(const std::string& text) const;

  /// Array and component, as FindComponent takes them.
  std::string GetScalarName(int component) const;
};

/// An array of VTK at some of its tuples. Numbers are integers if the array's type is. What is
/// infinite is no number unless it is kept.
SurfaceArray VTKCSLF_EXPORT MakeSurfaceArray(vtkDataArray* array, const std::string& name,
  const std::vector<vtkIdType>& tuples, bool keepsInfinite = false);

///@{
/// Gives a geometry arrays of point data, whose names are in its field data, and reads them. None
/// that do not fit.
void VTKCSLF_EXPORT AddSurfaceArrays(
  const std::vector<SurfaceArray>& arrays, vtkPolyData* geometry);
std::vector<SurfaceArray> VTKCSLF_EXPORT FindSurfaceArrays(vtkPolyData* geometry);
///@}
}

#endif
