// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours that a mapper gives to data.
 */
#ifndef cslfMappedScalars_h
#define cslfMappedScalars_h

#include "Pipeline/cslfColorMap.h"

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <string>

class vtkDataSet;
class vtkDoubleArray;
class vtkFloatArray;
class vtkImageData;
class vtkMapper;
class vtkUnsignedCharArray;

namespace cslf
{
struct ImportedScene;

/// Either colours, of points or cells, or a texture of the lookup table and the points' coordinates
/// on it; or neither if the mapper shows no scalars. The texture has one colour per step of the
/// table. Like VTK's, it is shown without interpolation and with extended edges: the first pixel is
/// the colour below the range, the last one that above it, and the second row that of NaN.
struct MappedScalars
{
  vtkSmartPointer<vtkUnsignedCharArray> Colors;
  bool OfCells = false;
  bool WantsTable = false; ///< whether the mapper would show the texture
  vtkSmartPointer<vtkImageData> Table;
  vtkSmartPointer<vtkFloatArray> Coordinates;
  std::string Map; ///< says what the table maps: see DescribeColorMap

  /// The scalars that a map gave the colours, if it is one that interpolated scalars
  /// may be shown in.
  vtkSmartPointer<vtkDoubleArray> Scalars;
  ColorMap ColorsOfScalars;
};

/// The colour of NaN, if a mapper of composite data uses it for blocks without its array.
std::optional<std::array<double, 3>> FindColorOfMissing(vtkMapper* mapper, vtkDataSet* data);

/// Maps scalars like the mapper, without changing the mapper, its table or the data. `useTable`
/// allows the texture, if the mapper interpolates before it maps. Records a table without values,
/// which maps nothing, in the scene.
MappedScalars MapScalars(vtkMapper* mapper, vtkDataSet* data, bool useTable, ImportedScene& scene);
}

#endif
