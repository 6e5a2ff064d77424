// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours of points or cells, from arrays of colours or through lookup tables.
 */
#ifndef cslfSurfaceColors_h
#define cslfSurfaceColors_h

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <mutex>
#include <vector>

class vtkDataArray;
class vtkLookupTable;
class vtkScalarsToColors;
class vtkUnsignedCharArray;

namespace cslf
{
struct MappedColors
{
  std::vector<glm::vec3> Colors; ///< linear
  std::vector<float> Opacities;  ///< empty if all are 1
};

/// Whether an array contains colours: unsigned chars of 3 or 4 components. False for null.
bool HoldsColors(vtkDataArray* array);

/// Whether a table contains any colours. VTK reads past the end of tables without colours.
bool HasColors(vtkScalarsToColors* table);

/// Maps the arrays of all blocks of a scene in the same way.
class SurfaceColors
{
public:
  /// `lookupTable` may be null.
  explicit SurfaceColors(vtkScalarsToColors* lookupTable);

  /// Announces an array: arrays without a lookup table share a default one over all their values.
  void AddToRange(vtkDataArray* array);

  /// Whether an array or its lookup table contains colours.
  bool CanMap(vtkDataArray* array) const;

  /// A colour for each tuple of an array that can be mapped. Unsigned chars of 3 or 4 components
  /// are sRGB colours themselves; all other arrays are mapped. Threads may call it at once.
  MappedColors Map(vtkDataArray* array);

private:
  /// Null for the default one.
  vtkScalarsToColors* FindTable(vtkDataArray* array) const;

  vtkSmartPointer<vtkUnsignedCharArray> MapThroughTable(vtkDataArray* array);

  vtkScalarsToColors* LookupTable;
  vtkSmartPointer<vtkLookupTable> DefaultTable;
  double Range[2];
  std::mutex Mapping; ///< tables do not allow several threads
};
}

#endif
