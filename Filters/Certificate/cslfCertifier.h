// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Measures how well a field shows its scene.
 */
#ifndef cslfCertifier_h
#define cslfCertifier_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfPhase.h"
#include "cslfCertificate.h"
#include "cslfPixelBeams.h"

#include <glm/vec4.hpp>

#include <functional>
#include <string>
#include <vector>

class vtkAlgorithmOutput;
class vtkPolyData;

namespace cslf
{
/// A pixel of the scene, traced in parts that have random numbers of their own. Each is the mean of
/// an equal number of paths all over the pixel: linear radiance times exposure, associated alpha.
struct TracedPixel
{
  static constexpr int Parts = 4;

  /// A part has one path, or an equal number, in each cell: so many along a side of the pixel.
  static constexpr int CellsPerSide = 4;

  /// The smallest number of paths of a pixel, of which the number is a multiple.
  static constexpr int PathStep = Parts * CellsPerSide * CellsPerSide;

  glm::dvec4 Means[Parts] = {};
};

struct CertificateSettings
{
  int Rays = 4096;
  int Samples = 256; ///< paths of a ray, rounded up to a multiple of PathStep
  int Seed = 0;
};

/// Traces all paths of some pixels of the scene: a number of paths for each, and a seed. Returns
/// false if the progress does.
using PixelTracer = std::function<bool(const std::vector<PixelBeam>& beams, int samples, int seed,
  const Progress& progress, std::vector<TracedPixel>& pixels)>;

/// A scene that a filter traces.
struct TracedScene
{
  std::function<std::string()> GetHash;
  PixelTracer Trace;
};

/// Compares a field with a scene. The result does not depend on threads. `geometry` is the field's,
/// or null. On failure returns false and gives the reason; it is empty if the progress ended it.
///
/// The paths of a ray are divided into two halves A and B. With what the field shows, F, the mean
/// square is the mean of (F - A) (F - B), which their noise does not bias. Encoding a noisy half
/// biases it, by about the inverse of the number of paths. So a half's colour is extrapolated from
/// that of its paths and the mean of those of its two parts, which have twice that bias (the
/// jackknife).
VTKCSLF_EXPORT bool MeasureCertificate(vtkAlgorithmOutput* field, vtkPolyData* geometry,
  const PixelTracer& trace, const CertificateSettings& settings, const Progress& progress,
  Certificate& certificate, std::string& error);
}

#endif
