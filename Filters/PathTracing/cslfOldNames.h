// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Arrays that version 0.1 wrote. Its names of materials, lights and instances had no prefix, so
 * that they can be those of a simulation's arrays. They count only where other arrays show that
 * they are ours. The version after this one reads none of them: this file goes then.
 */
#ifndef cslfOldNames_h
#define cslfOldNames_h

#include <vtkSmartPointer.h>

#include <set>
#include <string>

class vtkDataObject;

namespace cslf
{
/// The old names that a scene's data has.
struct OldNames
{
  std::set<std::string> Read;    ///< of arrays that are ours
  std::set<std::string> Ignored; ///< of arrays that may be anybody's

  /// What the user is told, or nothing.
  std::string ToText() const;
};

/// Gives today's names to the arrays of an object that are ours by an old name. Leaves are left
/// alone. Returns the object itself if there are none, else a shallow copy.
vtkSmartPointer<vtkDataObject> RenameOldArrays(vtkDataObject* data, OldNames& found);
}

#endif
