// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTube.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>

namespace cslf
{
namespace
{
constexpr double LongestPiece = 32.0; // in radii
constexpr double MaximumNewPieces = 1 << 20;

/// The logarithm of the ratio of a tube's end radii.
double GetGrowth(const Mesh& mesh, std::uint32_t tube)
{
  const std::size_t first = 2 * std::size_t(tube);
  return std::log(double(mesh.Radii[first + 1]) / mesh.Radii[first]);
}

/// The length of a tube in its radii: the integral of the inverse radius along it; 0 if one end
/// contains the other, or a radius is too small for a float.
double MeasureTube(const Mesh& mesh, std::uint32_t tube)
{
  const std::size_t first = 2 * std::size_t(tube);
  const double length =
    glm::distance(glm::dvec3(mesh.Vertices[first]), glm::dvec3(mesh.Vertices[first + 1]));
  const double growth = GetGrowth(mesh, tube);
  const double start = mesh.Radii[first];
  const double measure = length / start * (growth == 0.0 ? 1.0 : growth / std::expm1(growth));
  const bool isSphere = length <= std::abs(mesh.Radii[first + 1] - start);
  return isSphere || !std::isfinite(measure) ? 0.0 : measure;
}

/// Makes the pieces of the tubes of a mesh.
class TubeDivider
{
public:
  TubeDivider(const Mesh& whole, double longest)
    : Whole(whole)
  {
    const std::uint32_t count = whole.GetNumberOfShapes();
    for (std::uint32_t tube = 0; tube < count; ++tube)
    {
      const int pieces =
        std::max(1, static_cast<int>(std::ceil(MeasureTube(whole, tube) / longest)));
      for (int piece = 0; piece < pieces; ++piece)
      {
        this->AddVertex(tube, piece, pieces);
        this->AddVertex(tube, piece + 1, pieces);
        this->Tubes.push_back(tube);
      }
    }
  }

  void Divide(Mesh& mesh) const
  {
    this->Interpolate(mesh.Vertices);
    this->Interpolate(mesh.Radii);
    this->Interpolate(mesh.Normals);
    this->Interpolate(mesh.TexCoords);
    for (SurfaceArray& array : mesh.ShapeArrays)
    {
      for (SurfaceArray::Component& component : array.Components)
      {
        this->Repeat(component.Values);
      }
    }
    for (SurfaceArray& array : mesh.Arrays)
    {
      for (SurfaceArray::Component& component : array.Components)
      {
        this->Interpolate(component.Values);
      }
    }
    const bool ofTubes = mesh.Coloring == Mesh::ColorsOf::Triangles;
    ofTubes ? this->Repeat(mesh.MapPlaces) : this->Interpolate(mesh.MapPlaces);
    ofTubes ? this->Repeat(mesh.Colors) : this->Interpolate(mesh.Colors);
    ofTubes ? this->Repeat(mesh.Opacities) : this->Interpolate(mesh.Opacities);
    mesh.EmissionsOf == Mesh::ColorsOf::Triangles ? this->Repeat(mesh.Emissions)
                                                  : this->Interpolate(mesh.Emissions);
    mesh.Joints = this->Joints;
  }

private:
  /// Pieces have equal lengths relative to their radii, which change by equal factors.
  void AddVertex(std::uint32_t tube, int piece, int pieces)
  {
    const double growth = GetGrowth(this->Whole, tube);
    const double part = double(piece) / pieces;
    const double along = growth == 0.0 ? part : std::expm1(part * growth) / std::expm1(growth);
    this->Places.push_back({ tube, static_cast<float>(along) });
    this->Joints.push_back(piece > 0 && piece < pieces ? 1 : 0);
  }

  template <typename Value>
  void Interpolate(std::vector<Value>& values) const
  {
    Replace(values, this->Places,
      [this, &values](const TrianglePoint& place)
      { return this->Whole.Interpolate(values, place); });
  }

  template <typename Value>
  void Repeat(std::vector<Value>& values) const
  {
    Replace(values, this->Tubes, [&values](std::uint32_t tube) { return values[tube]; });
  }

  /// Replaces values, if there are any, by one for each of the origins.
  template <typename Value, typename Origin, typename Get>
  static void Replace(
    std::vector<Value>& values, const std::vector<Origin>& origins, const Get& get)
  {
    if (!values.empty())
    {
      std::vector<Value> divided(origins.size());
      std::transform(origins.begin(), origins.end(), divided.begin(), get);
      values = std::move(divided);
    }
  }

  const Mesh& Whole;
  std::vector<TrianglePoint> Places; // of each new vertex, in the original tubes
  std::vector<std::uint32_t> Joints;
  std::vector<std::uint32_t> Tubes; // of each piece, the tube it belongs to
};
}

void DivideLongTubes(Mesh& mesh)
{
  double longest = 0.0;
  double sum = 0.0;
  for (std::uint32_t tube = 0; tube < mesh.GetNumberOfShapes(); ++tube)
  {
    const double length = MeasureTube(mesh, tube);
    longest = std::max(longest, length);
    sum += length;
  }
  if (longest > LongestPiece)
  {
    TubeDivider(mesh, std::max(LongestPiece, sum / MaximumNewPieces)).Divide(mesh);
  }
}

}
