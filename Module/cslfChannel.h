// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The channels of a light field, and the one table of what is known of each: its encodings, and how
 * their samples are stored, filled, reduced and interpolated.
 */
#ifndef cslfChannel_h
#define cslfChannel_h

#include "vtkCSLFModule.h" // for export macro

#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

namespace cslf
{
/// One point-data array of the field.
struct VTKCSLF_EXPORT Channel
{
  std::string Name; ///< the array's name
  int Type = 0;     ///< VTK's scalar type, such as VTK_UNSIGNED_CHAR
  int Components = 1;
  std::string Encoding; ///< what the numbers mean, one of the names below

  /// The size of a texel, in bytes.
  int GetTexelBytes() const;
};

/// The channels whose meaning is known, in the order of their tracks in a file. Another one is
/// added here and in the table of cslfChannel.cxx.
enum class KnownChannel
{
  Color,
  Depth
};
constexpr KnownChannel KnownChannels[] = { KnownChannel::Color, KnownChannel::Depth };
constexpr std::size_t KnownChannelCount = std::size(KnownChannels);

/// The largest number of layers into which a field is split along its rays.
constexpr int MaximumLayers = 1;

/// A known channel of a layer: what identifies samples in memory, in files and in textures. A
/// channel alone is that of the first layer.
struct ChannelId
{
  KnownChannel Known = KnownChannel::Color;
  int Layer = 0;

  constexpr ChannelId() = default;
  constexpr ChannelId(KnownChannel known, int layer = 0)
    : Known(known)
    , Layer(layer)
  {
  }

  /// Its place in ChannelIds.
  constexpr std::size_t GetPlace() const
  {
    return static_cast<std::size_t>(this->Layer) * KnownChannelCount +
      static_cast<std::size_t>(this->Known);
  }

  constexpr bool operator==(ChannelId other) const { return this->GetPlace() == other.GetPlace(); }
  constexpr bool operator!=(ChannelId other) const { return !(*this == other); }
  constexpr bool operator<(ChannelId other) const { return this->GetPlace() < other.GetPlace(); }
};

constexpr std::size_t ChannelIdCount = MaximumLayers * KnownChannelCount;

constexpr std::array<ChannelId, ChannelIdCount> ListChannelIds()
{
  std::array<ChannelId, ChannelIdCount> ids{};
  for (std::size_t place = 0; place < ids.size(); ++place)
  {
    ids[place] = { KnownChannels[place % KnownChannelCount],
      static_cast<int>(place / KnownChannelCount) };
  }
  return ids;
}

/// The known channels of all layers, layer by layer, in the order of their tracks in a file.
constexpr std::array<ChannelId, ChannelIdCount> ChannelIds = ListChannelIds();

/// The names of the first layer's arrays. Those of another layer end with its number: `Color2`.
constexpr const char* ColorName = "Color";
constexpr const char* DepthName = "Depth";

/// `Color` as bytes: sRGB-encoded mean of the samples that hit, times alpha.
constexpr const char* SRGBEncoding = "srgb-associated-alpha";
/// `Color` as floats: linear radiance times exposure, associated alpha.
constexpr const char* LinearEncoding = "linear-associated-alpha";
/// `Depth`: the first hit as a fraction of the chord from viewpoint to texel centre.
constexpr const char* DepthEncoding = "chord-fraction";

/// The layout of a texel's samples.
enum class SampleKind
{
  ByteColor,  ///< 4 bytes: red, green, blue, alpha
  FloatColor, ///< 4 floats: the same, linear
  Number16,   ///< 1 unsigned short: a number from 0 to 1
  FloatNumber ///< 1 float
};

/// How a square of texels becomes one texel.
enum class Reduction
{
  CoveredMean, ///< the mean of the covered texels, or of all where none is
  Mean,        ///< the mean of all: with associated alpha, empty texels count as dark
  LightMean,   ///< the mean of what the samples that hit saw: linear, weighted by coverage
  Minimum      ///< the smallest of the covered texels, or the fill value where none is
};

/// How textures are read between texels.
enum class Interpolation
{
  Linear,
  Nearest
};

/// A known channel in one of its possible forms: a row of the table.
struct ChannelForm
{
  KnownChannel Id;
  const char* Name;
  const char* Encoding;
  int Type;
  int Components;
  SampleKind Kind;
  double Fill; ///< the number where nothing is covered
  Reduction Reduce;
  Interpolation Interpolate;
  /// Whether it tells how far away a surface is. Files store distances by a curve whose steps grow
  /// with them, and move the rims of what is covered away.
  bool IsDistance;
};

/// The form of a channel, or null if the channel is not known or cannot have its type, number of
/// components or encoding.
const ChannelForm* FindForm(const Channel& channel);

/// The channel with samples of a VTK type, which must be one that it can have.
VTKCSLF_EXPORT Channel MakeChannel(ChannelId id, int type);

/// The channel in the first of its forms in the table.
VTKCSLF_EXPORT Channel MakeChannel(ChannelId id);

/// The name of a known channel's array, and back.
VTKCSLF_EXPORT const char* NameOf(ChannelId id);
std::optional<ChannelId> FindKnownChannel(const std::string& name);

/// How any channel is reduced, which follows from its encoding.
Reduction FindReduction(const Channel& channel);

/// The number where nothing is covered, in any channel.
double FindFill(const Channel& channel);

/// Fills texels of a channel with that number.
void FillEmpty(const Channel& channel, void* texels, std::size_t count);

/// A number from 0 to 1 as it is stored; integers have all their codes.
template <typename Value>
Value ToStored(double number)
{
  constexpr Value largest = std::is_integral<Value>::value ? std::numeric_limits<Value>::max() : 1;
  return number >= 1.0 ? largest : static_cast<Value>(number * static_cast<double>(largest));
}
}

#endif
