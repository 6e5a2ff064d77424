// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNamedColorMaps.h"

#include "Options/cslfOptionTable.h"

#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace cslf
{
namespace
{
constexpr int CoolToWarm = 1; // the map of those who choose none

// Enough for any map to be continuous in 8 bits.
constexpr int TableSize = 1024;

// The colour of values that are not numbers.
constexpr double NanGray = 0.6;

using Levels = std::array<int, 3>; // of red, green and blue, from 0 to 255

/// The colours of a map in equal distances. Perceptually uniform maps are sampled where they bend.
const std::vector<Levels>& GetColors(const std::string& name)
{
  static const std::map<std::string, std::vector<Levels>> maps = {
    { "cool-to-warm", { { 59, 76, 192 }, { 221, 221, 221 }, { 180, 4, 38 } } },
    { "viridis",
      { { 68, 1, 84 }, { 71, 44, 122 }, { 59, 81, 139 }, { 44, 113, 142 }, { 33, 144, 141 },
        { 39, 173, 129 }, { 92, 200, 99 }, { 170, 220, 50 }, { 253, 231, 37 } } },
    { "plasma",
      { { 13, 8, 135 }, { 84, 2, 163 }, { 139, 10, 165 }, { 185, 50, 137 }, { 219, 92, 104 },
        { 244, 136, 73 }, { 254, 188, 43 }, { 240, 249, 33 } } },
    { "inferno",
      { { 0, 0, 4 }, { 31, 12, 72 }, { 85, 15, 109 }, { 136, 34, 106 }, { 186, 54, 85 },
        { 227, 89, 51 }, { 249, 140, 10 }, { 249, 201, 50 }, { 252, 255, 164 } } },
    { "gray", { { 0, 0, 0 }, { 255, 255, 255 } } },
    // VTK makes it itself.
    { "rainbow", {} },
  };
  return maps.at(name);
}

void Interpolate(const std::vector<Levels>& points, vtkLookupTable* table)
{
  vtkNew<vtkColorTransferFunction> colors;
  points.size() == 2     ? colors->SetColorSpaceToRGB()
    : points.size() == 3 ? colors->SetColorSpaceToDiverging()
                         : colors->SetColorSpaceToLab();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    colors->AddRGBPoint(static_cast<double>(i) / static_cast<double>(points.size() - 1),
      points[i][0] / 255.0, points[i][1] / 255.0, points[i][2] / 255.0);
  }
  for (int i = 0; i < TableSize; ++i)
  {
    double color[3];
    colors->GetColor(i / (TableSize - 1.0), color);
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
}
}

const char* SetUpLookupTable(int map, vtkLookupTable* table)
{
  const char* name = options::ColorMap.Names[std::max(map, CoolToWarm)];
  const std::vector<Levels>& points = GetColors(name);
  table->SetNumberOfTableValues(TableSize);
  if (points.empty())
  {
    table->SetHueRange(0.667, 0.0);
    table->SetSaturationRange(1.0, 1.0);
    table->SetValueRange(1.0, 1.0);
    table->SetAlphaRange(1.0, 1.0);
    table->ForceBuild();
  }
  else
  {
    Interpolate(points, table);
  }
  table->SetNanColor(NanGray, NanGray, NanGray, 1.0);
  return name;
}
}
