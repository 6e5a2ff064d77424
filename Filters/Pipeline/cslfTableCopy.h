// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Copies of lookup tables.
 */
#ifndef cslfTableCopy_h
#define cslfTableCopy_h

#include <vtkSmartPointer.h>

class vtkScalarsToColors;

namespace cslf
{
/// A copy of a table that maps identically. A mapper sets the range and alpha of its table, but the
/// user's table must not change.
vtkSmartPointer<vtkScalarsToColors> CopyTable(vtkScalarsToColors* table);
}

#endif
