// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the qualities of vtkCSLFPathTracer select for parameters that are automatic.
 */
#ifndef cslfQualityPresets_h
#define cslfQualityPresets_h

namespace cslf
{
struct QualityPreset
{
  int Samples;           ///< of a texel
  double NoiseTarget;    ///< of a texel
  double CacheTolerance; ///< of vtkCSLFRadianceCacheOptions
  int CacheSamples;      ///< of a point of the cache
  double CacheSpacing;   ///< relative to the one that depends on the size of the picture
  const char* Coding;    ///< the preset of the tool's videos; null for the encoder's default
};

/// In the order of vtkCSLFPathTracer::Qualities.
constexpr QualityPreset QualityPresets[] = {
  { 4, 0.02, 1.0 / 16.0, 32, 4.0, "ultrafast" },
  { 32, 0.004, 1.0 / 64.0, 512, 1.0, nullptr },
  { 256, 0.001, 1.0 / 256.0, 4096, 1.0, nullptr },
};
}

#endif
