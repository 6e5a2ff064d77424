// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which arrays colour surfaces, and how: see vtkCSLFSceneLook.
 */
#ifndef cslfSurfaceColoring_h
#define cslfSurfaceColoring_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

class vtkTable;

namespace cslf
{
/// Why data and properties do not fit together.
struct LookError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Removes all rows of a legend, and gives it its columns.
void ClearLegend(vtkTable* legend);

/// Chooses the arrays that colour surfaces, and maps them to colours. The surfaces are changed, but
/// not their arrays.
class SurfaceColoring
{
public:
  std::vector<vtkSmartPointer<vtkPolyData>> Surfaces;
  std::string ArrayName;
  std::string ComponentName;
  int ColorMap = 0;              ///< a value of the option
  const double* Range = nullptr; ///< null if it is automatic

  /// The automatic ranges by the names of arrays, which those of these surfaces widen. Null if they
  /// have their own.
  std::map<std::string, std::array<double, 2>>* GrowingRanges = nullptr;

  /// Adds what is shown to a legend. Throws a LookError.
  void Apply(vtkTable* legend);

private:
  void ChooseArrays();
  bool HasArray(const std::string& name) const;
  [[noreturn]] void FailForArray() const;
  std::string ListArrays(bool ofCells, const std::string& title) const;
  void MapArrays(
    const std::string& name, const std::vector<vtkPolyData*>& surfaces, vtkTable* legend) const;

  int Component = 0; // if one is chosen
};
}

#endif
