// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfChannel.h"

#include <vtkDataArray.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

namespace cslf
{
namespace
{
constexpr ChannelForm Forms[] = {
  { KnownChannel::Color, ColorName, SRGBEncoding, VTK_UNSIGNED_CHAR, 4, SampleKind::ByteColor, 0.0,
    Reduction::LightMean, Interpolation::Linear, false },
  { KnownChannel::Color, ColorName, LinearEncoding, VTK_FLOAT, 4, SampleKind::FloatColor, 0.0,
    Reduction::Mean, Interpolation::Linear, false },
  { KnownChannel::Depth, DepthName, DepthEncoding, VTK_UNSIGNED_SHORT, 1, SampleKind::Number16, 1.0,
    Reduction::Minimum, Interpolation::Nearest, true },
  { KnownChannel::Depth, DepthName, DepthEncoding, VTK_FLOAT, 1, SampleKind::FloatNumber, 1.0,
    Reduction::Minimum, Interpolation::Nearest, true },
};

template <typename Condition>
const ChannelForm* FindFirst(Condition condition)
{
  const auto found = std::find_if(std::begin(Forms), std::end(Forms), condition);
  return found == std::end(Forms) ? nullptr : found;
}

const ChannelForm& FindFirstForm(KnownChannel known)
{
  return *FindFirst([known](const ChannelForm& form) { return form.Id == known; });
}

const ChannelForm* FindEncoding(const Channel& channel)
{
  return FindFirst([&](const ChannelForm& form) { return channel.Encoding == form.Encoding; });
}
}

int Channel::GetTexelBytes() const
{
  return this->Components * vtkDataArray::GetDataTypeSize(this->Type);
}

const ChannelForm* FindForm(const Channel& channel)
{
  const auto id = FindKnownChannel(channel.Name);
  return FindFirst(
    [&](const ChannelForm& form)
    {
      return id && id->Known == form.Id && channel.Type == form.Type &&
        channel.Components == form.Components && channel.Encoding == form.Encoding;
    });
}

Channel MakeChannel(ChannelId id, int type)
{
  const ChannelForm* form =
    FindFirst([=](const ChannelForm& row) { return row.Id == id.Known && row.Type == type; });
  return form ? Channel{ NameOf(id), type, form->Components, form->Encoding }
              : Channel{ NameOf(id), type, 1, {} };
}

Channel MakeChannel(ChannelId id)
{
  return MakeChannel(id, FindFirstForm(id.Known).Type);
}

const char* NameOf(ChannelId id)
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const ChannelId each : ChannelIds)
    {
      all.push_back(FindFirstForm(each.Known).Name +
        (each.Layer > 0 ? std::to_string(each.Layer + 1) : std::string()));
    }
    return all;
  }();
  return names[id.GetPlace()].c_str();
}

std::optional<ChannelId> FindKnownChannel(const std::string& name)
{
  const auto found = std::find_if(
    ChannelIds.begin(), ChannelIds.end(), [&](ChannelId id) { return name == NameOf(id); });
  return found == ChannelIds.end() ? std::nullopt : std::make_optional(*found);
}

Reduction FindReduction(const Channel& channel)
{
  const ChannelForm* form = FindEncoding(channel);
  const Reduction reduction = form ? form->Reduce : Reduction::CoveredMean;
  // Only numbers have a smallest one, and only byte colours have a curve.
  const bool fits = reduction == Reduction::Minimum ? channel.Components == 1
    : reduction == Reduction::LightMean
    ? channel.Type == form->Type && channel.Components == form->Components
    : true;
  return fits ? reduction : Reduction::CoveredMean;
}

double FindFill(const Channel& channel)
{
  const ChannelForm* form = FindEncoding(channel);
  return form ? form->Fill : 0.0;
}

void FillEmpty(const Channel& channel, void* texels, std::size_t count)
{
  const std::size_t values = count * channel.Components;
  const double fill = FindFill(channel);
  switch (channel.Type)
  {
    vtkTemplateMacro(std::fill_n(static_cast<VTK_TT*>(texels), values, ToStored<VTK_TT>(fill)));
    default:
      break;
  }
}
}
