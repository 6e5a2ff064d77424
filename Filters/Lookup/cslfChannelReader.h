// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a field has at the places that a lookup returns: one of its channels. The functions here and
 * those of cslfColor.glsl, whose names end in "Color", have the same results.
 */
#ifndef cslfChannelReader_h
#define cslfChannelReader_h

#include "cslfLayout.h"

#include <vtkType.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vector>

class vtkDataArray;

namespace cslf
{
struct LookupResult;
struct Sightings;

/// A place in the samples of a viewpoint.
struct Place
{
  int Slice = 0;
  int Tile = 0;
  glm::dvec2 Coordinates{ 0.0 }; ///< (s,t) on the tile's exit face
};

/// A channel of a field, or of some of its viewpoints, in memory. The array must outlive this
/// object.
class VTKCSLF_EXPORT ChannelReader
{
public:
  /// `values` has up to four components and contains the listed slices, in that order, or, if the
  /// list is empty, all. It may be null if nothing is read. Unsigned integers are read as numbers
  /// from 0 to 1.
  ChannelReader(
    const Layout& grid, vtkDataArray* values, const std::vector<int>& slices = std::vector<int>());

  /// The place of a slice in the array, or -1.
  int StripOf(int slice) const { return this->Strips[slice]; }

  /// Position in a place's tile, in texels.
  glm::dvec2 TexelPosition(const Place& place) const;

  /// A texel of a place's tile; outside, the nearest one inside. Of channels with one component,
  /// the number.
  double FetchNumber(const Place& place, int p, int q) const;
  glm::dvec4 Fetch(const Place& place, int p, int q) const;

  glm::dvec4 ReadNearest(const Place& place) const;

  /// Texels interpolated.
  glm::dvec4 Read(const Place& place) const;

  /// The mean of what the views see, over those that see anything. 0 if none does.
  glm::dvec4 Blend(const LookupResult& result) const;

  /// The same over the texels that lie on the surface. Where a texel is covered only in part, it
  /// shows a silhouette, which is the geometry's business: the mean of what is covered.
  glm::dvec4 Blend(const Sightings& found) const;

private:
  vtkIdType TexelIndex(const Place& place, int p, int q) const;

  Layout Grid;
  vtkDataArray* Values;
  double Scale;
  std::vector<int> Strips; ///< of each slice
};
}

#endif
