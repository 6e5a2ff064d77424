// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares a radiance cache with path tracing at random texels of the picture it is made for.
 */
#ifndef cslfCacheCheck_h
#define cslfCacheCheck_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "cslfCacheShare.h"

#include <cstdint>
#include <functional>

namespace cslf
{
class RadianceCache;

/// The results of a check. Standard errors include the noise of the paths.
struct CacheCheck
{
  std::int32_t Texels = -1; ///< number compared; -1 if there was no check

  /// The mean of the cache's radiance minus that of the paths, relative to the mean of the paths.
  double Mean = 0.0;
  double MeanError = 0.0; ///< its standard error

  /// The root mean square difference of the displayed colours, as a fraction of white, without the
  /// contribution of the paths' noise.
  double RMS = 0.0;
  double RMSError = 0.0; ///< its standard error

  bool IsMade() const { return this->Texels >= 0; }

  /// The bounds of the two differences: of the mean, and of the root mean square.
  static constexpr double MeanBound = 0.02;
  static double GetRMSBound(double tolerance) { return 3.0 * tolerance; }

  /// Whether a difference exceeds its bound by more than three standard errors.
  bool IsExceeded(double tolerance) const;
};

/// The picture from which texels are chosen.
struct CheckedPicture
{
  int TileWidth = 0;
  int TileHeight = 0;
  int Tiles = 1;
  int Slices = 1;
  std::function<RayGrid(int slice, int tile)> Grids;
};

struct CheckSettings
{
  int Texels = 1024; ///< number to compare
  double Exposure = 1.0;
  std::uint32_t Seed = 0;
  PathSettings Paths;
  CacheShare* Share = nullptr; ///< the ranks that trace the texels together; null for this one
};

/// Compares the radiance through random points of random texels that see a surface. The choice and
/// all random numbers depend on the seed alone. The result is not made if `progress` returns false;
/// several ranks do not ask it.
VTKCSLF_EXPORT CacheCheck CheckCache(const Scene& scene, const RadianceCache& cache,
  const CheckedPicture& picture, const CheckSettings& settings, const Progress& progress);
}

#endif
