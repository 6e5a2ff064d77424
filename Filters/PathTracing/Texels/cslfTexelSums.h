// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sums of the samples of texels: of all channels, and those that decide when to stop.
 */
#ifndef cslfTexelSums_h
#define cslfTexelSums_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfChannelSum.h"
#include "cslfColor.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace cslf
{
class ColorSum : public ChannelSum
{
public:
  static constexpr KnownChannel Id = KnownChannel::Color;

  void Add(const PacketSamples& samples)
  {
    const TexelGroup& group = samples.First.Group;
    if (samples.HasOthers)
    {
      this->AddBoth(samples);
      return;
    }
    AddTo(this->Own.Red, group, samples.Radiance.Red);
    AddTo(this->Own.Green, group, samples.Radiance.Green);
    AddTo(this->Own.Blue, group, samples.Radiance.Blue);
  }

  void AddPath(int texel, const PathBatch& batch, int path, bool isOwn)
  {
    const glm::vec3& radiance = batch.GetRadiance(path);
    PacketRadiance& sum = isOwn ? this->Own : this->Others;
    sum.Red[texel] += radiance.x;
    sum.Green[texel] += radiance.y;
    sum.Blue[texel] += radiance.z;
    this->OtherCount[texel] += isOwn ? 0 : 1;
  }

  void Take(const int* texels)
  {
    CopySome(this->TakenOwn.Red, this->Own.Red, texels);
    CopySome(this->TakenOwn.Green, this->Own.Green, texels);
    CopySome(this->TakenOwn.Blue, this->Own.Blue, texels);
    CopySome(this->TakenOthers.Red, this->Others.Red, texels);
    CopySome(this->TakenOthers.Green, this->Others.Green, texels);
    CopySome(this->TakenOthers.Blue, this->Others.Blue, texels);
    CopySome(this->TakenOtherCount, this->OtherCount, texels);
  }

  /// Bytes as EncodeColor makes them, or linear radiance times exposure, and alpha.
  void Write(const WrittenTexels& texels, const ViewpointSamples& output) const
  {
    auto* bytes = output.Get<unsigned char>(Id);
    auto* floats = output.Get<float>(Id);
    for (const WrittenTexels::Texel& texel : texels)
    {
      const int i = texel.Number;
      const glm::dvec3 radiance = texels.Exposure * this->GetMean(texel);
      const double alpha = static_cast<double>(texel.Covered) / texel.Samples;
      if (bytes)
      {
        EncodeColor(radiance, alpha, bytes + 4 * texel.Index);
      }
      if (floats)
      {
        float* color = floats + 4 * texel.Index;
        color[0] = static_cast<float>(radiance.x);
        color[1] = static_cast<float>(radiance.y);
        color[2] = static_cast<float>(radiance.z);
        color[3] = static_cast<float>(alpha);
      }
    }
  }

  /// The sums of the samples so far whose colour counts.
  const PacketRadiance& GetOwn() const { return this->Own; }

  /// The number of samples so far that see something whose colour does not count.
  int GetOtherCount(int texel) const { return this->OtherCount[texel]; }

private:
  void AddBoth(const PacketSamples& samples)
  {
    alignas(64) int counts[Size];
    PacketRadiance own;
    PacketRadiance others;
    for (int lane = 0; lane < Size; ++lane)
    {
      const bool isOther = samples.Covered[lane] != 0 && samples.Own[lane] == 0;
      counts[lane] = isOther ? 1 : 0;
      own.Red[lane] = isOther ? 0.0f : samples.Radiance.Red[lane];
      own.Green[lane] = isOther ? 0.0f : samples.Radiance.Green[lane];
      own.Blue[lane] = isOther ? 0.0f : samples.Radiance.Blue[lane];
      others.Red[lane] = isOther ? samples.Radiance.Red[lane] : 0.0f;
      others.Green[lane] = isOther ? samples.Radiance.Green[lane] : 0.0f;
      others.Blue[lane] = isOther ? samples.Radiance.Blue[lane] : 0.0f;
    }
    const TexelGroup& group = samples.First.Group;
    AddTo(this->Own.Red, group, own.Red);
    AddTo(this->Own.Green, group, own.Green);
    AddTo(this->Own.Blue, group, own.Blue);
    AddTo(this->Others.Red, group, others.Red);
    AddTo(this->Others.Green, group, others.Green);
    AddTo(this->Others.Blue, group, others.Blue);
    AddTo(this->OtherCount, group, counts);
  }

  /// The mean radiance times alpha. Samples whose colour does not count still cover the texel, and
  /// give its colour if there are no others.
  glm::dvec3 GetMean(const WrittenTexels::Texel& texel) const
  {
    const int i = texel.Number;
    const double count = static_cast<double>(texel.Covered) - this->TakenOtherCount[i];
    const bool areOthers = count <= 0.0 && texel.Covered > 0.0f;
    const PacketRadiance& sums = areOthers ? this->TakenOthers : this->TakenOwn;
    const glm::dvec3 sum(sums.Red[i], sums.Green[i], sums.Blue[i]);
    if (areOthers || this->TakenOtherCount[i] == 0)
    {
      return sum / static_cast<double>(texel.Samples);
    }
    const double alpha = static_cast<double>(texel.Covered) / texel.Samples;
    return alpha / count * sum;
  }

  PacketRadiance Own{};
  PacketRadiance Others{}; // of samples whose colour does not count
  alignas(64) int OtherCount[Size] = {};
  PacketRadiance TakenOwn;
  PacketRadiance TakenOthers;
  int TakenOtherCount[Size];
};

class DepthSum : public ChannelSum
{
public:
  static constexpr KnownChannel Id = KnownChannel::Depth;
  static constexpr bool NeedsNearest = true;

  DepthSum() { std::fill_n(this->Depth, Size, 1.0f); }

  void KeepNearest(const PacketHits& hits, const int* nearest)
  {
    alignas(64) float depths[Size];
    for (int lane = 0; lane < Size; ++lane)
    {
      depths[lane] = hits.GetDepth(lane);
    }
    CopyNearest(this->Depth, hits.Group, depths, nearest);
  }

  /// [0,1] as [0,65535].
  void Write(const WrittenTexels& texels, const ViewpointSamples& output) const
  {
    auto* depths = output.Get<unsigned short>(Id);
    for (const WrittenTexels::Texel& texel : texels)
    {
      const float depth =
        texel.Covered > 0.0f ? std::clamp(this->Depth[texel.Number], 0.0f, 1.0f) : 1.0f;
      depths[texel.Index] = static_cast<unsigned short>(65535.0f * depth + 0.5f);
    }
  }

private:
  alignas(64) float Depth[Size];
};

/// The samples whose mean is a texel's colour.
struct ColorSamples
{
  int Count = 0;
  glm::vec3 Sum{ 0.0f };
  glm::vec3 Squares{ 0.0f }; ///< the sum of the squares, if added
};

/// For as many texels as a packet has rays.
class VTKCSLF_EXPORT TexelSums
{
public:
  static constexpr int Size = ChannelSum::Size;

  /// All channels that can be sampled.
  using ChannelList = std::tuple<ColorSum, DepthSum>;

  /// Their names in the table of channels, in the order of the list.
  static std::vector<KnownChannel> ListChannels();

  /// Sums for the channels of some arrays, which must outlive them. `Color` must be one of them.
  explicit TexelSums(const ViewpointSamples& output);

  /// Whether a requested channel depends on the hits nearest to the texels' centres.
  bool NeedsNearest() const;

  ///@{
  /// Pass what rays see to all requested channels: see ChannelSum.
  void KeepNearest(const PacketHits& hits);
  void Add(const PacketSamples& samples);
  void AddPath(int texel, const PathBatch& batch, int path, bool isOwn);
  ///@}

  /// Adds the squares of the samples whose colour counts.
  void AddSquares(const PacketSamples& samples);

  /// Takes the means of some texels' samples so far, unless that was done before. Texels are marked
  /// by -1.
  void Take(const int texels[Size]);
  void TakeAll();

  /// Whether the means of all texels are taken.
  bool AreTaken() const { return this->TakenCount == Size; }

  /// Writes the means of texels inside, which are marked by -1, to the arrays.
  void Write(double exposure, const int inside[Size], const std::int64_t indices[Size]) const;

  /// The sums of the radiance of the samples so far whose colour counts.
  const PacketRadiance& GetRadiance() const { return std::get<ColorSum>(this->Channels).GetOwn(); }

  /// The samples so far whose mean is a texel's colour: none if all see other surfaces than the
  /// centre does.
  ColorSamples GetColorSamples(int texel) const;

  /// The number of samples that see something. Those that see volumes over the background count in
  /// part, and Partial is the sum of c (1 - c) of these parts c.
  alignas(64) float Covered[Size] = {};
  alignas(64) float Partial[Size] = {};
  alignas(64) int Paths[Size] = {}; ///< of those whose colour counts, those with followed paths
  int Samples = 0;                  ///< of each texel

private:
  /// Calls a function with the sums of each requested channel.
  template <typename Self, typename Function>
  static void ForEach(Self& self, Function function);

  const ViewpointSamples* Output;
  ChannelList Channels;
  PacketRadiance Squares{}; // sums of the squares of the radiance, if its colour counts
  alignas(64) float NearestOffset[Size]; // squared, from the centre to the nearest hit
  int TakenCount = 0;                    // of texels
  int TakenSamples[Size] = {};           // 0 if the mean is not taken yet
  float TakenCovered[Size];
};
}

#endif
