// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Resampling/cslfTexelReducer.h"

#include "cslfColor.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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

void ReduceColorBytes(const Squares& squares, const unsigned char* input, unsigned char* output)
{
  squares.ForEach(
    [=](std::int64_t to, const std::vector<std::int64_t>& from)
    {
      glm::dvec3 radiance(0.0);
      double alpha = 0.0;
      for (std::int64_t texel : from)
      {
        const unsigned char* color = input + 4 * texel;
        if (color[3] > 0)
        {
          const double weight = color[3] / 255.0;
          alpha += weight;
          radiance += weight *
            glm::dvec3(ByteToLinear(color[0], color[3]), ByteToLinear(color[1], color[3]),
              ByteToLinear(color[2], color[3]));
        }
      }
      const auto count = static_cast<double>(from.size());
      EncodeColor(radiance / count, alpha / count, output + 4 * to);
    });
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

/// Without colours, all texels count.
CoveredTexels FindCovered(
  const Description& field, vtkImageData* image, std::int64_t first, std::int64_t count)
{
  const Channel* color = field.FindChannel(KnownChannel::Color);
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

template <typename Value>
void ReduceChannel(const Squares& squares, const Channel& channel, const CoveredTexels& covered,
  const Value* input, Value* output)
{
  switch (FindReduction(channel))
  {
    case Reduction::Minimum:
      ReduceMinimum(squares, ToStored<Value>(FindFill(channel)), covered, input, output);
      return;
    case Reduction::Mean:
      ReduceMean(squares, channel.Components, CoveredTexels(covered.size(), true), input, output);
      return;
    case Reduction::CoveredMean:
      ReduceMean(squares, channel.Components, covered, input, output);
      return;
    case Reduction::LightMean:
      ReduceColorBytes(squares, reinterpret_cast<const unsigned char*>(input),
        reinterpret_cast<unsigned char*>(output));
      return;
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
  const CoveredTexels covered = FindCovered(this->Input, input, from, count);
  for (const Channel& channel : this->Input.Channels)
  {
    const char* name = channel.Name.c_str();
    const void* source =
      input->GetPointData()->GetArray(name)->GetVoidPointer(channel.Components * from);
    void* target = output->GetPointData()->GetArray(name)->GetVoidPointer(channel.Components * to);
    switch (channel.Type)
    {
      vtkTemplateMacro(ReduceChannel(squares, channel, covered, static_cast<const VTK_TT*>(source),
        static_cast<VTK_TT*>(target)));
      default:
        break;
    }
  }
}
}
