// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds material arrays that do not match the table of vtkCSLFMaterial.
 */
#ifndef cslfMaterialProblems_h
#define cslfMaterialProblems_h

#include <set>
#include <string>

class vtkDataObject;
class vtkDataSet;
class vtkFieldData;

namespace cslf
{
/// The problems of a scene's material arrays, each with what was expected.
class MaterialProblems
{
public:
  /// Collects the arrays of an object's field data, points and cells that are ignored: of a wrong
  /// type, number of components or place.
  void FindUnused(vtkDataObject* data);

  /// Collects values that are out of range, with their replacements.
  void FindOutOfRange(vtkDataObject* data);

  /// The text of a warning; empty if there are no problems.
  std::string ToText() const;

private:
  void FindUnusedParameters(vtkFieldData* fields);
  void FindUnusedTextures(vtkDataObject* data);
  void FindUnusedAttributes(vtkDataSet* data);

  std::set<std::string> Unused;
  std::set<std::string> OutOfRange;
};
}

#endif
