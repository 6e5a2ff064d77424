// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What readers of a file will compute from its geometry, so that it is not coded: depth, coverage
 * and the colours that the geometry has. Viewpoints are made to fit before they are coded.
 */
#ifndef cslfGeometryPlan_h
#define cslfGeometryPlan_h

#include "Coding/Containers/cslfFileHeader.h"
#include "Coding/Geometry/cslfGeometryFit.h"
#include "Coding/Geometry/cslfGeometryTexels.h"
#include "Pipeline/cslfPhase.h"
#include "cslfDescription.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstdint>
#include <optional>
#include <vector>

namespace cslf
{
/// Some viewpoints that show how well a geometry fits: the middle one of each face.
VTKCSLF_EXPORT std::vector<FrameId> GetTriedViewpoints(const Layout& grid);

class GeometryPlan
{
public:
  /// The largest loss of viewpoints (GeometryFit::GetLoss) with which a geometry is used, unless it
  /// tells all: then it is that of any geometry, MaximumUsefulLoss.
  static constexpr double MaximumLoss = 0.05;

  /// The largest error of colours (GeometryFit::GetColorError) with which they are the geometry's.
  static constexpr double MaximumColorError = 24.0 / 255.0;

  /// The same where all points are exact: a texel's colour is a mean over several cells' colours.
  static constexpr double MaximumExactColorError = 64.0 / 255.0;

  /// Nothing is computed.
  GeometryPlan() = default;

  /// `bytes` are those of EncodeGeometry. Without them, nothing is computed.
  GeometryPlan(
    const std::vector<unsigned char>& bytes, const Description& field, ComputedChannels computed);

  /// Tries the geometry on some viewpoints, whose samples it changes, and computes what it tells
  /// well enough. Nothing is computed if `progress` returns false.
  static GeometryPlan Choose(const std::vector<unsigned char>& bytes, const Description& field,
    const std::vector<FrameId>& frames, const std::vector<ViewpointSamples>& samples,
    const Progress& progress);

  const ComputedChannels& GetComputed() const { return this->Computed; }

  /// Whether readers compute all texels, so that no viewpoint is needed for coding.
  bool TellsAll() const { return this->Computed.IsAll; }

  /// Whether the geometry has all surfaces, and the colours of all its points are exact: readers
  /// compute all texels if these colours also are those of the texels.
  bool MayTellAll() const { return this->Computed.HasCoverage && this->Texels->AreAllExact(); }

  /// Of the viewpoints that Choose got.
  const GeometryFit& GetFit() const { return this->Tried; }

  /// A number that differs with the geometry, 0 without one.
  std::uint32_t GetChecksum() const { return this->Checksum; }

  /// Makes viewpoints fit to what is computed, in parallel. False if `progress` returns false.
  bool Fit(const std::vector<FrameId>& frames, const std::vector<ViewpointSamples>& samples,
    const Progress& progress, GeometryFit& fit) const;

private:
  std::optional<GeometryTexels> Texels;
  ComputedChannels Computed;
  GeometryFit Tried;
  std::uint32_t Checksum = 0;
};
}

#endif
