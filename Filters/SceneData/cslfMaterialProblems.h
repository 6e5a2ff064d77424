// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parameters of a material: names of their arrays, ranges and defaults. Finds arrays that do
 * not match this table, which is that of vtkCSLFMaterial.
 */
#ifndef cslfMaterialProblems_h
#define cslfMaterialProblems_h

#include "Options/cslfOptionTable.h"
#include "vtkCSLFMaterial.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

namespace cslf
{
namespace material
{
/// A row of the table in vtkCSLFMaterial's documentation.
struct Parameter
{
  const char* Name;
  int Components;
  double Default;
  double Minimum;
  double Maximum;
};

// The tracer computes in floats.
inline constexpr double Unlimited = 1e30;

/// Each parameter's row in the table.
enum ParameterIndex
{
  BaseColor,
  Metallic,
  Roughness,
  Emission,
  IndexOfRefraction,
  Transmission,
  ThinWalled,
  Opacity,
  OpacityCutoff,
  VisibleSides,
  NormalScale,
  LineRadius,
  PointRadius,
  DisplayedWhite,
  FinishedColors,
  NumberOfParameters
};

inline Parameter MakeParameter(const char* name, const NumberOption<double>& row)
{
  return { name, 1, row.Default, row.Minimum, row.Maximum };
}

inline const Parameter Parameters[] = {
  { vtkCSLFMaterial::BaseColorName(), 3, options::BaseColor.Default[0], 0.0, 1.0 },
  MakeParameter(vtkCSLFMaterial::MetallicName(), options::Metallic),
  MakeParameter(vtkCSLFMaterial::RoughnessName(), options::Roughness),
  { vtkCSLFMaterial::EmissionName(), 3, options::Emission.Default[0], 0.0, Unlimited },
  MakeParameter(vtkCSLFMaterial::IndexOfRefractionName(), options::IndexOfRefraction),
  MakeParameter(vtkCSLFMaterial::TransmissionName(), options::Transmission),
  { vtkCSLFMaterial::ThinWalledName(), 1, options::ThinWalled.Default ? 1.0 : 0.0, 0.0, 1.0 },
  MakeParameter(vtkCSLFMaterial::OpacityName(), options::Opacity),
  { vtkCSLFMaterial::OpacityCutoffName(), 1, 0.0, 0.0, 1.0 },
  { vtkCSLFMaterial::VisibleSidesName(), 1, vtkCSLFMaterial::BothSides, vtkCSLFMaterial::BothSides,
    vtkCSLFMaterial::BackSide },
  { vtkCSLFMaterial::NormalScaleName(), 1, 1.0, -Unlimited, Unlimited },
  { vtkCSLFMaterial::LineRadiusName(), 1, 0.0, 0.0, Unlimited },
  { vtkCSLFMaterial::PointRadiusName(), 1, 0.0, 0.0, Unlimited },
  { vtkCSLFMaterial::DisplayedWhiteName(), 3, 0.0, 0.0, Unlimited },
  { vtkCSLFMaterial::FinishedColorsName(), 1, 0.0, 0.0, 1.0 },
};
static_assert(std::size(Parameters) == NumberOfParameters, "each parameter needs a row");

/// The value that is used: clamped to the range, and the default for NaN.
inline double Clamp(const Parameter& parameter, double value)
{
  return value >= parameter.Minimum
    ? std::min(value, parameter.Maximum)
    : (value < parameter.Minimum ? parameter.Minimum : parameter.Default);
}
}
}

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
