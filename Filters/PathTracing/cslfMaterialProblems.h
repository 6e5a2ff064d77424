// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Material arrays that are not as vtkCSLFMaterial has them.
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
/// What a scene's material arrays have wrong, each named with what was expected.
class MaterialProblems
{
public:
  /// Notes the arrays of an object's field data, points and cells that are not used: of a wrong
  /// type, number of components or place.
  void FindUnused(vtkDataObject* data);

  /// Notes the values that are out of range, and what counts in their place.
  void FindOutOfRange(vtkDataObject* data);

  /// What the user is told, or nothing.
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
