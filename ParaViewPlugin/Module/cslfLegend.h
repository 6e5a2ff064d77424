// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Legends of the colours that a captured scene or a light field shows. They are field data, so they
 * stay with what was baked when the colour map of its source changes.
 */
#ifndef cslfLegend_h
#define cslfLegend_h

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkScalarsToColors;

namespace cslf
{
struct Legend
{
  std::string Title; ///< the name of the array
  vtkSmartPointer<vtkLookupTable> Table;
};

/// Everything that a table makes of values: its colours, opacities and range, as text to compare.
std::string DescribeTable(vtkScalarsToColors* table);

/// Adds a legend of a table's current colours. An equal one is added once; a different one with the
/// same title gets a number.
void AddLegend(vtkFieldData* fields, const std::string& title, vtkScalarsToColors* table);

/// Adds the legends of a data object and, if it is composite, of its leaves.
void CopyLegends(vtkDataObject* from, vtkFieldData* fields);

/// The legends in field data, in the order in which they were added.
std::vector<Legend> GetLegends(vtkFieldData* fields);
}

#endif
