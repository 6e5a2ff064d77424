// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a field shows along rays, as the mapper draws it: by its geometry if there is one, otherwise
 * by depth. Without a window.
 */
#ifndef cslfShownRays_h
#define cslfShownRays_h

#include "vtkCSLFModule.h" // for export macro

#include "Lookup/cslfChannelReader.h"
#include "Lookup/cslfLookup.h"
#include "cslfDescription.h"
#include "cslfGeometryRays.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <vector>

class vtkImageData;

namespace cslf
{
/// The colours of rays, in the encoding of the field's: associated alpha, over black.
class VTKCSLF_EXPORT ShownRays
{
public:
  /// `image` contains the listed slices of the field, in that order. `surfaces` may be null. All
  /// must outlive this object.
  ShownRays(const Description& field, vtkImageData* image, const std::vector<int>& slices,
    const GeometryRays* surfaces);

  /// Uses the samples that the mapper uses for a camera outside the cube that sees these faces, one
  /// bit each. 0, the default, stands for those of the face by which a ray enters.
  void SetSeenFaces(int faces);

  glm::dvec4 LookUp(const RayCoordinates& ray) const;

  /// What the geometry alone shows, which needs no samples. Nothing if it does not know.
  static std::optional<glm::dvec4> LookUpAlone(
    const Description& field, const GeometryRays& surfaces, const RayCoordinates& ray);

private:
  Lookup Views;
  ChannelReader Colors;
  const GeometryRays* Surfaces;
  bool HasAll;
  int SeenFaces = 0;
};

/// The mean of the light of some rays of a pixel or texel of a field.
class VTKCSLF_EXPORT LightMean
{
public:
  explicit LightMean(const Description& field);

  /// Adds a colour of ShownRays, with a weight.
  void Add(const glm::dvec4& color, double weight);

  /// In the encoding of the field's colours.
  glm::dvec4 GetColor() const;

private:
  bool IsLinear;
  glm::dvec4 Sum{ 0.0 };
};
}

#endif
