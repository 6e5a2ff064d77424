// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sums of the samples of texels: of all channels, and those that decide when to stop.
 */
#ifndef cslfTexelSums_h
#define cslfTexelSums_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfColorSum.h"
#include "cslfDepthSum.h"

#include <tuple>
#include <vector>

namespace cslf
{
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

  alignas(64) int Covered[Size] = {}; ///< the number of samples that see something
  alignas(64) int Paths[Size] = {};   ///< of those whose colour counts, those with followed paths
  int Samples = 0;                    ///< of each texel

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
  int TakenCovered[Size];
};
}

#endif
