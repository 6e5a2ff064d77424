// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Texts of VTK's files that VTK's writers write but its readers cannot read, in a form that they
 * can.
 */
#ifndef cslfGridText_h
#define cslfGridText_h

#include <string>

class vtkDataObject;

namespace cslf::tool
{
/// The text of a legacy file with stand-ins for NaN and infinite values, which VTK's reader takes
/// for keywords. Empty if the file is binary or has none.
std::string ReplaceNotFinite(const std::string& fileName);

/// Puts NaN and infinite values for their stand-ins.
void RestoreNotFinite(vtkDataObject* data);

/// Whether an XML file has only pieces without points, for which VTK's writers leave out arrays
/// that its readers require.
bool IsEmptyGrid(const std::string& fileName);

/// The text of a parallel XML file without its empty pieces. Empty if there are none.
std::string LeaveOutEmptyPieces(const std::string& fileName);
}

#endif
