// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays that version 0.1 wrote. Its names of materials, lights and instances had no prefix, so a
 * simulation's arrays can have the same names. They are read only if other arrays show that version
 * 0.1 wrote them. The next version reads none of them: remove this file then.
 */
#ifndef cslfOldNames_h
#define cslfOldNames_h

#include <vtkSmartPointer.h>

#include <set>
#include <string>

class vtkDataObject;

namespace cslf
{
/// The old names in a scene's data.
struct OldNames
{
  std::set<std::string> Read;    ///< of arrays that are ours
  std::set<std::string> Ignored; ///< of arrays that may be others'

  /// The text of a warning; empty if there are no old names.
  std::string ToText() const;
};

/// Gives the current names to the arrays of an object that version 0.1 wrote. Does not visit the
/// leaves of composite data. Returns the object itself if there are no such arrays, else a shallow
/// copy.
vtkSmartPointer<vtkDataObject> RenameOldArrays(vtkDataObject* data, OldNames& found);
}

#endif
