// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDescription.h"

#include <vtkType.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace cslf
{
namespace
{
bool IsName(const std::string& name)
{
  const auto isPrintable = [](unsigned char letter) { return letter >= ' ' && letter != 0x7f; };
  return !name.empty() && name.size() <= MaximumNameLength &&
    std::all_of(name.begin(), name.end(), isPrintable);
}

std::string FindFault(const Channel& channel)
{
  if (!IsName(channel.Name) || !(channel.Encoding.empty() || IsName(channel.Encoding)))
  {
    return "a channel's name or encoding is not 1 to " + std::to_string(MaximumNameLength) +
      " printable characters";
  }
  if (channel.Components < 1 || channel.Components > MaximumComponents)
  {
    return "the channel \"" + channel.Name + "\" does not have 1 to " +
      std::to_string(MaximumComponents) + " components";
  }
  return FindKnownChannel(channel.Name) && !FindForm(channel) ? "the channel \"" + channel.Name +
      "\" has a type, a number of components or an encoding that it cannot have"
                                                              : std::string();
}

std::string FindFault(const std::vector<Channel>& channels)
{
  if (channels.size() > MaximumChannels)
  {
    return "it has more than " + std::to_string(MaximumChannels) + " channels";
  }
  std::set<std::string> names;
  for (const Channel& channel : channels)
  {
    std::string fault = FindFault(channel);
    if (!fault.empty())
    {
      return fault;
    }
    if (!names.insert(channel.Name).second)
    {
      return "it has two channels \"" + channel.Name + "\"";
    }
  }
  return {};
}

std::string FindFault(const Cube& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double center = std::abs(box.Center[axis]);
    const double edge = box.Edges[axis];
    // These comparisons are false for NaN.
    if (!(center <= MaximumCoordinate && edge >= 1.0 / MaximumCoordinate &&
          edge <= MaximumCoordinate))
    {
      return "the cube's centre and edges are not within their limits";
    }
    if (!(edge >= MinimumRelativeEdge * center))
    {
      return "the cube is too small for its distance from the origin";
    }
  }
  return {};
}

std::string FindFault(const Cube& box, const std::array<double, 6>& bounds)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lower = bounds[2 * axis];
    const double upper = bounds[2 * axis + 1];
    if (!(lower <= upper && lower >= -MaximumCoordinate && upper <= MaximumCoordinate))
    {
      return "the scene's bounds are not in order or not within their limits";
    }
    const double half = 0.5 * box.Edges[axis];
    if (!(upper >= box.Center[axis] - half && lower <= box.Center[axis] + half))
    {
      return "the scene's bounds lie outside of the cube";
    }
  }
  return {};
}
}

std::int64_t Description::GetTexelBytes() const
{
  std::int64_t bytes = 0;
  for (const Channel& channel : this->Channels)
  {
    bytes += channel.GetTexelBytes();
  }
  return bytes;
}

std::int64_t Description::GetBytes() const
{
  return this->GetTexelBytes() * this->Grid.GetStripWidth() * this->Grid.GetResolution() *
    this->Grid.GetSlices();
}

std::string Description::FindFault() const
{
  if (!this->Grid.IsValid())
  {
    return "its viewpoint nodes or its resolution are not valid";
  }
  std::string fault = cslf::FindFault(this->Box);
  if (fault.empty() && this->SceneBounds)
  {
    fault = cslf::FindFault(this->Box, *this->SceneBounds);
  }
  fault = fault.empty() ? cslf::FindFault(this->Channels) : fault;
  if (!fault.empty())
  {
    return fault;
  }
  // VTK's ids may have 32 bits.
  const std::int64_t texels =
    std::int64_t(this->Grid.GetStripWidth()) * this->Grid.GetResolution() * this->Grid.GetSlices();
  int components = 1;
  for (const Channel& channel : this->Channels)
  {
    components = std::max(components, channel.Components);
  }
  return texels > VTK_ID_MAX / components || this->GetBytes() > MaximumFieldBytes
    ? "it has too many texels"
    : std::string();
}
}
