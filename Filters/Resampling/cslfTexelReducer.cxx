// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Resampling/cslfTexelReducer.h"

#include "cslfColor.h"
#include "cslfSameSurface.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

namespace cslf
{
namespace
{
/// The input's texels for each texel of an output slice.
struct Squares
{
  int Width; ///< of the input's strip
  int Height;
  int Divisor;

  std::int64_t GetInputCount() const { return std::int64_t(this->Width) * this->Height; }

  /// Calls `visit(output texel, input texels)` for each square of the slice.
  template <typename Visit>
  void ForEach(Visit visit) const
  {
    std::vector<std::int64_t> texels(std::size_t(this->Divisor) * this->Divisor);
    std::int64_t output = 0;
    for (int y = 0; y < this->Height; y += this->Divisor)
    {
      for (int x = 0; x < this->Width; x += this->Divisor, ++output)
      {
        for (std::size_t i = 0; i < texels.size(); ++i)
        {
          const auto column = static_cast<int>(i % this->Divisor);
          const auto row = static_cast<int>(i / this->Divisor);
          texels[i] = std::int64_t(y + row) * this->Width + x + column;
        }
        visit(output, texels);
      }
    }
  }
};

/// A byte that is not multiplied by alpha, converted to linear.
double ByteToLinear(unsigned char value)
{
  static const std::array<double, 256> table = []
  {
    std::array<double, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = SRGBToLinear(static_cast<double>(i) / 255.0);
    }
    return values;
  }();
  return table[value];
}

/// The linear mean of the samples that hit, from a byte and its alpha above 0.
double ByteToLinear(unsigned char value, unsigned char alpha)
{
  return alpha == 255 ? ByteToLinear(value) : SRGBToLinear(std::min(1.0, 1.0 * value / alpha));
}

/// Whether each texel of a slice has coverage.
using CoveredTexels = std::vector<bool>;

template <typename Value>
CoveredTexels FindCovered(const Value* color, std::int64_t count)
{
  CoveredTexels covered(static_cast<std::size_t>(count));
  for (std::int64_t texel = 0; texel < count; ++texel)
  {
    covered[texel] = color[4 * texel + 3] > 0;
  }
  return covered;
}

/// Of a layer. Without colours, all texels count.
CoveredTexels FindCovered(
  const Description& field, int layer, vtkImageData* image, std::int64_t first, std::int64_t count)
{
  const Channel* color = field.FindChannel({ KnownChannel::Color, layer });
  if (!color || color->Components != 4)
  {
    return CoveredTexels(static_cast<std::size_t>(count), true);
  }
  vtkDataArray* array = image->GetPointData()->GetArray(color->Name.c_str());
  switch (color->Type)
  {
    vtkTemplateMacro(
      return FindCovered(static_cast<VTK_TT*>(array->GetVoidPointer(4 * first)), count));
    default:
      return {};
  }
}

/// The texels of a slice that give the colours of their squares, and where depth comes from.
struct Surfaces
{
  std::vector<bool> Own;           ///< of the input's texels
  std::vector<std::int64_t> Place; ///< of the output's texels: the input's texel at the centre
};

/// A texel's distance from the centre of its square, squared, in half texels.
int GetDistance(int divisor, std::size_t place)
{
  const int x = 2 * static_cast<int>(place % divisor) - divisor + 1;
  const int y = 2 * static_cast<int>(place / divisor) - divisor + 1;
  return x * x + y * y;
}

/// Squares show the surface of the covered texel that is nearest to their centres, of several the
/// one with the smallest depth. Where that shows the environment, all texels count.
template <typename Value>
Surfaces FindSurfaces(const Squares& squares, const CoveredTexels& covered, const Value* depths)
{
  const Value most = ToStored<Value>(1.0);
  Surfaces surfaces{ covered, {} };
  squares.ForEach(
    [&](std::int64_t, const std::vector<std::int64_t>& from)
    {
      std::size_t center = 0;
      const auto rank = [&](std::size_t place)
      {
        return std::make_tuple(
          covered[from[place]] ? 0 : 1, GetDistance(squares.Divisor, place), depths[from[place]]);
      };
      for (std::size_t place = 1; place < from.size(); ++place)
      {
        center = rank(place) < rank(center) ? place : center;
      }
      const Value depth = depths[from[center]];
      surfaces.Place.push_back(from[center]);
      for (std::size_t place = 0; place < from.size(); ++place)
      {
        const double distance = 0.5 * std::sqrt(GetDistance(squares.Divisor, place));
        const bool isOwn = depth >= most ||
          AreOnOneSurface(static_cast<double>(depths[from[place]]) / static_cast<double>(most),
            static_cast<double>(depth) / static_cast<double>(most), distance);
        surfaces.Own[from[place]] = covered[from[place]] && isOwn;
      }
    });
  return surfaces;
}

///@{
/// Linear colour without association, and back with it.
glm::dvec3 ToColor(const unsigned char* texel)
{
  return { ByteToLinear(texel[0], texel[3]), ByteToLinear(texel[1], texel[3]),
    ByteToLinear(texel[2], texel[3]) };
}
template <typename Value>
glm::dvec3 ToColor(const Value* texel)
{
  return glm::dvec3(texel[0], texel[1], texel[2]) / static_cast<double>(texel[3]);
}
void FromColor(const glm::dvec3& color, double alpha, unsigned char* texel)
{
  EncodeColor(alpha * color, alpha, texel);
}
template <typename Value>
void FromColor(const glm::dvec3& color, double alpha, Value* texel)
{
  for (int k = 0; k < 3; ++k)
  {
    texel[k] = static_cast<Value>(alpha * color[k]);
  }
  texel[3] = static_cast<Value>(alpha);
}
///@}

/// The linear mean of what the samples of some texels saw, with the mean alpha of all.
template <typename Value>
void ReduceColor(
  const Squares& squares, const std::vector<bool>& counts, const Value* input, Value* output)
{
  const double full = std::is_integral<Value>::value ? 255.0 : 1.0;
  squares.ForEach(
    [&](std::int64_t to, const std::vector<std::int64_t>& from)
    {
      glm::dvec3 sum(0.0);
      double weights = 0.0;
      double alpha = 0.0;
      for (std::int64_t texel : from)
      {
        const double weight = input[4 * texel + 3] / full;
        alpha += weight;
        if (weight > 0.0 && counts[texel])
        {
          weights += weight;
          sum += weight * ToColor(input + 4 * texel);
        }
      }
      FromColor(weights > 0.0 ? sum / weights : sum, alpha / static_cast<double>(from.size()),
        output + 4 * to);
    });
}

template <typename Value>
Value FromDouble(double value)
{
  return std::is_integral<Value>::value ? static_cast<Value>(std::llround(value))
                                        : static_cast<Value>(value);
}

/// The mean of the covered texels, or of all if none is covered.
template <typename Value>
void ReduceMean(const Squares& squares, int components, const CoveredTexels& covered,
  const Value* input, Value* output)
{
  squares.ForEach(
    [&](std::int64_t to, const std::vector<std::int64_t>& from)
    {
      const bool all = std::none_of(
        from.begin(), from.end(), [&](std::int64_t texel) -> bool { return covered[texel]; });
      for (int component = 0; component < components; ++component)
      {
        double sum = 0.0;
        int count = 0;
        for (std::int64_t texel : from)
        {
          if (all || covered[texel])
          {
            sum += static_cast<double>(input[components * texel + component]);
            ++count;
          }
        }
        output[components * to + component] = FromDouble<Value>(sum / count);
      }
    });
}

/// The smallest of the covered texels, or the fill value if none is covered.
template <typename Value>
void ReduceMinimum(const Squares& squares, Value fill, const CoveredTexels& covered,
  const Value* input, Value* output)
{
  squares.ForEach(
    [&](std::int64_t to, const std::vector<std::int64_t>& from)
    {
      Value least = fill;
      for (std::int64_t texel : from)
      {
        least = covered[texel] ? std::min(least, input[texel]) : least;
      }
      output[to] = least;
    });
}

/// A layer of a slice, and what is known about its texels.
struct Slice
{
  Squares Texels;
  CoveredTexels Covered;
  std::optional<Surfaces> Seen; ///< of a field whose texels show one surface each
};

std::optional<KnownChannel> FindKnown(const Channel& channel)
{
  const auto id = FindKnownChannel(channel.Name);
  return id ? std::make_optional(id->Known) : std::nullopt;
}

/// The layer of a channel; that of others is the first.
int FindLayer(const Channel& channel)
{
  const auto id = FindKnownChannel(channel.Name);
  return id ? id->Layer : 0;
}

template <typename Value>
void ReduceChannel(const Slice& slice, const Channel& channel, const Value* input, Value* output)
{
  const Squares& squares = slice.Texels;
  const CoveredTexels all(slice.Covered.size(), true);
  switch (FindReduction(channel))
  {
    case Reduction::Minimum:
      if (slice.Seen && FindKnown(channel) == KnownChannel::Depth)
      {
        const auto fill = ToStored<Value>(FindFill(channel));
        std::transform(slice.Seen->Place.begin(), slice.Seen->Place.end(), output,
          [&](std::int64_t texel) { return slice.Covered[texel] ? input[texel] : fill; });
        return;
      }
      ReduceMinimum(squares, ToStored<Value>(FindFill(channel)), slice.Covered, input, output);
      return;
    case Reduction::Mean:
      if (slice.Seen && FindKnown(channel) == KnownChannel::Color)
      {
        ReduceColor(squares, slice.Seen->Own, input, output);
        return;
      }
      ReduceMean(squares, channel.Components, all, input, output);
      return;
    case Reduction::CoveredMean:
      ReduceMean(squares, channel.Components, slice.Covered, input, output);
      return;
    case Reduction::LightMean:
      ReduceColor(squares, slice.Seen ? slice.Seen->Own : all,
        reinterpret_cast<const unsigned char*>(input), reinterpret_cast<unsigned char*>(output));
      return;
  }
}

/// Nothing unless the field has surface texels.
std::optional<Surfaces> FindSurfaces(const Description& field, int layer, vtkImageData* image,
  std::int64_t first, const Squares& squares, const CoveredTexels& covered)
{
  const Channel* depth = field.FindChannel({ KnownChannel::Depth, layer });
  if (!field.HasSurfaceTexels() || !depth || !field.FindChannel({ KnownChannel::Color, layer }))
  {
    return std::nullopt;
  }
  vtkDataArray* array = image->GetPointData()->GetArray(depth->Name.c_str());
  switch (depth->Type)
  {
    vtkTemplateMacro(return FindSurfaces(
      squares, covered, static_cast<const VTK_TT*>(array->GetVoidPointer(first))));
    default:
      return std::nullopt;
  }
}
}

TexelReducer::TexelReducer(const Description& input, int divisor)
  : Input(input)
  , Divisor(divisor)
{
}

void TexelReducer::Reduce(
  vtkImageData* input, int inputSlice, vtkImageData* output, int outputSlice) const
{
  const Squares squares{ this->Input.Grid.GetStripWidth(), this->Input.Grid.GetResolution(),
    this->Divisor };
  const std::int64_t count = squares.GetInputCount();
  const std::int64_t from = (inputSlice - input->GetExtent()[4]) * count;
  const std::int64_t to =
    (outputSlice - output->GetExtent()[4]) * count / (std::int64_t(this->Divisor) * this->Divisor);
  std::vector<Slice> layers;
  for (int layer = 0; layer < MaximumLayers; ++layer)
  {
    layers.push_back({ squares, FindCovered(this->Input, layer, input, from, count), {} });
    Slice& slice = layers.back();
    slice.Seen = FindSurfaces(this->Input, layer, input, from, squares, slice.Covered);
  }
  for (const Channel& channel : this->Input.Channels)
  {
    const Slice& slice = layers[FindLayer(channel)];
    const char* name = channel.Name.c_str();
    const void* source =
      input->GetPointData()->GetArray(name)->GetVoidPointer(channel.Components * from);
    void* target = output->GetPointData()->GetArray(name)->GetVoidPointer(channel.Components * to);
    switch (channel.Type)
    {
      vtkTemplateMacro(ReduceChannel(
        slice, channel, static_cast<const VTK_TT*>(source), static_cast<VTK_TT*>(target)));
      default:
        break;
    }
  }
}
}
