// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parameters of a material: names of their arrays, ranges and defaults.
 */
#ifndef cslfMaterialParameters_h
#define cslfMaterialParameters_h

#include "vtkCSLFMaterial.h"

#include <algorithm>

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
inline const Parameter BaseColor = { vtkCSLFMaterial::BaseColorName(), 3, 0.8, 0.0, 1.0 };
inline const Parameter Metallic = { vtkCSLFMaterial::MetallicName(), 1, 0.0, 0.0, 1.0 };
inline const Parameter Roughness = { vtkCSLFMaterial::RoughnessName(), 1, 1.0, 0.0, 1.0 };
inline const Parameter Emission = { vtkCSLFMaterial::EmissionName(), 3, 0.0, 0.0, Unlimited };
inline const Parameter IndexOfRefraction = { vtkCSLFMaterial::IndexOfRefractionName(), 1, 1.0, 1.0,
  Unlimited };
inline const Parameter Transmission = { vtkCSLFMaterial::TransmissionName(), 1, 0.0, 0.0, 1.0 };
inline const Parameter ThinWalled = { vtkCSLFMaterial::ThinWalledName(), 1, 0.0, 0.0, 1.0 };
inline const Parameter Opacity = { vtkCSLFMaterial::OpacityName(), 1, 1.0, 0.0, 1.0 };
inline const Parameter OpacityCutoff = { vtkCSLFMaterial::OpacityCutoffName(), 1, 0.0, 0.0, 1.0 };
inline const Parameter VisibleSides = { vtkCSLFMaterial::VisibleSidesName(), 1,
  vtkCSLFMaterial::BothSides, vtkCSLFMaterial::BothSides, vtkCSLFMaterial::BackSide };
inline const Parameter NormalScale = { vtkCSLFMaterial::NormalScaleName(), 1, 1.0, -Unlimited,
  Unlimited };
inline const Parameter LineRadius = { vtkCSLFMaterial::LineRadiusName(), 1, 0.0, 0.0, Unlimited };
inline const Parameter PointRadius = { vtkCSLFMaterial::PointRadiusName(), 1, 0.0, 0.0, Unlimited };
inline const Parameter DisplayedWhite = { vtkCSLFMaterial::DisplayedWhiteName(), 3, 0.0, 0.0,
  Unlimited };
inline const Parameter Parameters[] = { BaseColor, Metallic, Roughness, Emission, IndexOfRefraction,
  Transmission, ThinWalled, Opacity, OpacityCutoff, VisibleSides, NormalScale, LineRadius,
  PointRadius, DisplayedWhite };

/// The value that is used: clamped to the range, and the default for NaN.
inline double Clamp(const Parameter& parameter, double value)
{
  return value >= parameter.Minimum
    ? std::min(value, parameter.Maximum)
    : (value < parameter.Minimum ? parameter.Minimum : parameter.Default);
}
}
}

#endif
