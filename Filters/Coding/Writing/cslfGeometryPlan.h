// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What readers of a file will compute from its geometry, so that it is not coded: depth and
 * coverage. Viewpoints are made to fit before they are coded.
 */
#ifndef cslfGeometryPlan_h
#define cslfGeometryPlan_h

#include "Coding/Geometry/cslfGeometryDepths.h"
#include "Coding/Geometry/cslfGeometryFit.h"
#include "Pipeline/cslfPhase.h"
#include "cslfDescription.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cslf
{
/// What of a field is computed.
struct ComputedChannels
{
  bool HasDepth = false;
  bool HasCoverage = false; ///< only together with depth
};

/// Some viewpoints that show how well a geometry fits: the middle one of each face.
std::vector<int> GetTriedViewpoints(const Layout& grid);

class GeometryPlan
{
public:
  /// The largest loss of viewpoints (GeometryFit::GetLoss) with which a geometry is used.
  static constexpr double MaximumLoss = 0.05;

  /// Nothing is computed.
  GeometryPlan() = default;

  /// `bytes` are those of EncodeGeometry. Without them, nothing is computed.
  GeometryPlan(
    const std::vector<unsigned char>& bytes, const Description& field, ComputedChannels computed);

  /// Tries the geometry on some viewpoints, whose samples it changes, and computes what it tells
  /// well enough. Nothing is computed if `progress` returns false.
  static GeometryPlan Choose(const std::vector<unsigned char>& bytes, const Description& field,
    const std::vector<int>& slices, const std::vector<ViewpointSamples>& samples,
    const Progress& progress);

  const ComputedChannels& GetComputed() const { return this->Computed; }

  /// Of the viewpoints that Choose got, from 0 to 1.
  double GetLoss() const { return this->Loss; }

  /// A number that differs with the geometry, 0 without one.
  std::uint32_t GetChecksum() const { return this->Checksum; }

  /// Makes viewpoints fit to what is computed, in parallel. False if `progress` returns false.
  bool Fit(const std::vector<int>& slices, const std::vector<ViewpointSamples>& samples,
    const Progress& progress, GeometryFit& fit) const;

private:
  std::optional<GeometryDepths> Depths;
  ComputedChannels Computed;
  double Loss = 0.0;
  std::uint32_t Checksum = 0;
};
}

#endif
