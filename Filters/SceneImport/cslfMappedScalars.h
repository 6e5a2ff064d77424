// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours that a mapper gives to data.
 */
#ifndef cslfMappedScalars_h
#define cslfMappedScalars_h

#include <vtkSmartPointer.h>

#include <array>
#include <optional>

class vtkDataSet;
class vtkFloatArray;
class vtkImageData;
class vtkMapper;
class vtkUnsignedCharArray;

namespace cslf
{
struct ImportedScene;

/// Either colours, of points or cells, or a texture of the lookup table and where the points lie on
/// it; or neither, where the mapper shows no scalars. The texture has a colour a step of the table
/// and is to be shown without interpolation, its edges going on, as VTK draws it: the first pixel
/// is the colour below the range, the last one that above it, the second row that of NaN.
struct MappedScalars
{
  vtkSmartPointer<vtkUnsignedCharArray> Colors;
  bool OfCells = false;
  bool WantsTable = false; ///< whether the mapper would show the texture
  vtkSmartPointer<vtkImageData> Table;
  vtkSmartPointer<vtkFloatArray> Coordinates;
};

/// The colour of NaN, where a mapper of composite data gives it to blocks without its array.
std::optional<std::array<double, 3>> FindColorOfMissing(vtkMapper* mapper, vtkDataSet* data);

/// Maps scalars as the mapper would; neither it, its table nor the data is changed. `useTable`
/// allows for the texture, where the mapper interpolates before it maps. Notes in the scene a table
/// without values, by which nothing is mapped.
MappedScalars MapScalars(vtkMapper* mapper, vtkDataSet* data, bool useTable, ImportedScene& scene);
}

#endif
