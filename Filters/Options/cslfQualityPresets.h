// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the qualities of vtkCSLFPathTracer select for parameters that are automatic.
 */
#ifndef cslfQualityPresets_h
#define cslfQualityPresets_h

#include <string>

namespace cslf
{
struct QualityPreset
{
  int Samples;           ///< of a texel
  double NoiseTarget;    ///< of a texel
  double CacheTolerance; ///< of vtkCSLFRadianceCacheOptions
  int CacheSamples;      ///< of a point of the cache
  double CacheSpacing;   ///< relative to the one that depends on the size of the picture
  const char* Coding;    ///< the preset of vtkCSLFEncoder
};

/// In the order of vtkCSLFPathTracer::Qualities.
constexpr QualityPreset QualityPresets[] = {
  { 4, 0.02, 1.0 / 16.0, 32, 4.0, "ultrafast" },
  { 32, 0.004, 1.0 / 64.0, 512, 1.0, "slow" },
  { 256, 0.001, 1.0 / 256.0, 4096, 1.0, "slow" },
};

/// The preset of an encoder: the one that is set or, if that is "auto", that of the quality of what
/// it codes. Null is an empty name.
inline std::string ChoosePreset(const char* preset, int quality)
{
  const std::string name = preset ? preset : "";
  return name == "auto" ? QualityPresets[quality].Coding : name;
}
}

#endif
