// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The scalars that a field's geometry has beside its light, which mappers show in other colours.
 */
#ifndef cslfFieldScalars_h
#define cslfFieldScalars_h

#include "cslfJSON.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cslf::tool
{
struct FieldFile;

/// The points of a geometry that have scalars of one array with one colour map, or a component of
/// an array that gave no colours.
struct FieldScalars
{
  std::string Array;
  std::string Component;  ///< a number, a name or magnitude; empty if the array has only one
  std::string ScalarName; ///< of the geometry's array, which a mapper selects
  std::int64_t Points = 0;
  std::optional<std::array<double, 2>> Range; ///< of finite values, if there are any
  bool HasMap = true;                         ///< with which the field was sampled
  std::array<double, 2> MapRange{};           ///< of that, or else of the values
  bool IsLogarithmic = false;                 ///< the map

  /// As it is written on the command line: ARRAY[:COMPONENT].
  std::string GetLabel() const;

  /// Whether that text means it. An array without component means each of its components.
  bool IsMeantBy(const std::string& text) const;
};

/// Reads the geometry. None if there are no scalars.
std::vector<FieldScalars> ListScalars(const FieldFile& file);

/// The share of a geometry's area whose colours a map tells, so that they can be changed, from 0 to
/// 1.
double MeasureRecolorable(vtkPolyData* geometry);

/// The labels, each once.
std::string ListLabels(const std::vector<FieldScalars>& scalars);

///@{
/// Scalars for `info`: "array", "component", "points", "range", "map_range", which is null without
/// a map, and "logarithmic"; and this in words.
nlohmann::json Summarize(const FieldScalars& scalars);
std::string Describe(const FieldScalars& scalars);
///@}
}

#endif
