// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What samples see, and what the sums of all channels have in common. Each channel that is sampled
 * has a class derived from ChannelSum, and TexelSums has the list of these classes.
 */
#ifndef cslfChannelSum_h
#define cslfChannelSum_h

#include "PathTracing/Paths/cslfPathBatch.h"
#include "PathTracing/RadianceCache/cslfDiffuseLookUp.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Rays/cslfRayPacket.h"
#include "PathTracing/Scene/cslfScene.h"
#include "SIMD/cslfVectorize.h"
#include "cslfSamplePlaces.h"
#include "cslfViewpointSamples.h"

#include <cstdint>

namespace cslf
{
/// The rays of a packet through a group of texels, and their first hits.
struct PacketHits
{
  const Scene& World;
  const TexelGroup& Group;
  const SamplePlaces& Places;
  const RayPacket& Rays;
  const PacketScale& Scale;

  /// The ray's parameter at the hit: 1 on the exit face, any number if nothing is hit.
  float GetDepth(int lane) const
  {
    return this->Scale.Start[lane] + this->Rays.Query.ray.tfar[lane] / this->Scale.Length[lane];
  }
};

/// What a packet of samples sees.
struct PacketSamples
{
  const PacketHits& First;
  const PacketRadiance& Radiance; ///< 0 if a sample sees nothing, or if its path is still to follow
  const int* Covered; ///< -1 if a sample sees a surface or environment of that radiance, else 0
  const int* Own;     ///< -1 if its colour counts: see CenterSurfaces, else 0
  bool HasOthers;     ///< whether there are samples whose colour does not count
};

/// The texels of a block that are written.
struct WrittenTexels
{
  struct Texel
  {
    int Number;         ///< in the block
    std::int64_t Index; ///< in the arrays
    int Samples;        ///< the number of samples whose mean it is, above 0
    float Covered;      ///< the number of these that see something
  };

  double Exposure = 1.0;
  int Count = 0;
  Texel Texels[RayPacket::Size];

  const Texel* begin() const { return this->Texels; }
  const Texel* end() const { return this->Texels + this->Count; }
};

/**
 * The sums of a channel for as many texels as a packet has rays. A derived class has a
 * `static constexpr KnownChannel Id`, hides the functions that it needs, and defines Write. The
 * functions of channels that are not requested are not called.
 */
class ChannelSum
{
public:
  static constexpr int Size = RayPacket::Size;

  /// Whether the channel depends on the hit nearest to the centre of each texel, so that
  /// KeepNearest is called.
  static constexpr bool NeedsNearest = false;

  /// Receives the rays to the texels' centres, before all samples, and, if one of them misses, also
  /// the samples. `nearest` is -1 for a hit that is nearer to its texel's centre than all before,
  /// which include those of lower lanes, else 0.
  void KeepNearest(const PacketHits&, const int* /*nearest*/) {}

  /// Receives each sample.
  void Add(const PacketSamples&) {}

  /// Receives the missing radiance of an earlier sample of a texel: a path of the batch, whose
  /// first hit the batch knows, and whether its colour counts.
  void AddPath(int /*texel*/, const PathBatch&, int /*path*/, bool /*isOwn*/) {}

  /// Keeps the means of some texels, marked by -1: later samples do not change them.
  void Take(const int* /*texels*/) {}

  /// Adds the values of a packet's samples to those of their texels.
  template <typename Value>
  static void AddTo(Value* sums, const TexelGroup& group, const Value* values)
  {
    switch (group.Size)
    {
      case Size:
        AddSamples<Size>(sums, values);
        break;
      case 4:
        AddSamples<4>(sums + group.First, values);
        break;
      default:
        AddSamples<1>(sums + group.First, values);
        break;
    }
  }

  /// Copies the values of the nearest hits to those of their texels.
  template <typename Value>
  static void CopyNearest(
    Value* texels, const TexelGroup& group, const Value* values, const int* nearest)
  {
    for (int first = 0; first < Size; first += group.Size)
    {
      CSLF_LANE_LOOP
      for (int i = 0; i < group.Size; ++i)
      {
        Value& texel = texels[group.First + i];
        texel = nearest[first + i] ? values[first + i] : texel;
      }
    }
  }

  /// Copies the values of some texels, marked by -1.
  template <typename Value>
  static void CopySome(Value* __restrict target, const Value* __restrict values, const int* texels)
  {
    for (int texel = 0; texel < Size; ++texel)
    {
      const Value old = target[texel];
      const Value value = values[texel];
      target[texel] = texels[texel] ? value : old;
    }
  }

private:
  template <int Texels, typename Value>
  static void AddSamples(Value* __restrict sums, const Value* __restrict values)
  {
    for (int sample = 0; sample < Size / Texels; ++sample)
    {
      for (int texel = 0; texel < Texels; ++texel)
      {
        sums[texel] += values[sample * Texels + texel];
      }
    }
  }
};
}

#endif
