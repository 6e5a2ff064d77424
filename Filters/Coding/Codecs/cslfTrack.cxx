// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTrack.h"

#include "cslfJoin.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>

namespace cslf
{
namespace
{
/// A plane: the end of its tracks' names, and the pixel formats that these may have.
struct PlaneRow
{
  const char* Suffix;
  std::vector<AVPixelFormat> Formats;
};

/// In the order of Plane.
const std::vector<PlaneRow>& GetPlaneRows()
{
  static const std::vector<PlaneRow> rows = {
    { "",
      { AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV420P,
        AV_PIX_FMT_YUV420P10, AV_PIX_FMT_GBRP, AV_PIX_FMT_YUV444P12 } },
    { "coverage", { AV_PIX_FMT_GRAY8, AV_PIX_FMT_YUV420P } },
    { "", { AV_PIX_FMT_GRAY12, AV_PIX_FMT_GRAY10, AV_PIX_FMT_YUV420P10 } },
    { "-high", { AV_PIX_FMT_GRAY8 } },
    { "-low", { AV_PIX_FMT_GRAY8 } },
  };
  return rows;
}

const PlaneRow& GetRow(Plane plane)
{
  return GetPlaneRows()[static_cast<std::size_t>(plane)];
}

std::string MakeName(const TrackRole& role)
{
  if (role.Samples == Plane::Coverage)
  {
    const int layer = role.Source.Layer;
    return GetRow(role.Samples).Suffix + (layer > 0 ? std::to_string(layer + 1) : std::string());
  }
  std::string name = NameOf(role.Source);
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return name + GetRow(role.Samples).Suffix;
}

/// The roles of all known channels, by name.
const std::map<std::string, TrackRole>& GetRoles()
{
  static const std::map<std::string, TrackRole> roles = []
  {
    std::map<std::string, TrackRole> all;
    for (const ChannelId id : ChannelIds)
    {
      for (const bool isLossless : { false, true })
      {
        for (const Plane plane : GetPlanes(KindOf(id), isLossless))
        {
          all[MakeName({ id, plane })] = { id, plane };
        }
      }
    }
    return all;
  }();
  return roles;
}
}

SampleKind KindOf(ChannelId id)
{
  return FindForm(MakeChannel(id))->Kind;
}

std::vector<Plane> GetPlanes(SampleKind kind, bool isLossless)
{
  switch (kind)
  {
    case SampleKind::ByteColor:
    case SampleKind::FloatColor:
      return { Plane::Colors, Plane::Coverage };
    case SampleKind::Number16:
    case SampleKind::FloatNumber:
      break;
  }
  return isLossless ? std::vector<Plane>{ Plane::HighByte, Plane::LowByte }
                    : std::vector<Plane>{ Plane::Numbers };
}

const char* NameOfRole(TrackRole role)
{
  return GetRoles().find(MakeName(role))->first.c_str();
}

std::optional<TrackRole> RoleOfName(const std::string& name)
{
  const auto found = GetRoles().find(name);
  return found == GetRoles().end() ? std::nullopt : std::make_optional(found->second);
}

std::optional<AVPixelFormat> FindPixelFormat(Plane plane, const std::string& name)
{
  for (const AVPixelFormat format : GetRow(plane).Formats)
  {
    if (name == NameOfFormat(format))
    {
      return format;
    }
  }
  return std::nullopt;
}

std::string ListColorFormats()
{
  return JoinAs(GetRow(Plane::Colors).Formats, NameOfFormat);
}

std::string NameOfFormat(AVPixelFormat format)
{
  const AVPixFmtDescriptor* descriptor = av_pix_fmt_desc_get(format);
  const bool isHighFirst = descriptor && (descriptor->flags & AV_PIX_FMT_FLAG_BE) != 0;
  const char* name = av_get_pix_fmt_name(isHighFirst ? av_pix_fmt_swap_endianness(format) : format);
  return name ? name : "unknown";
}

bool CanHoldRadiance(AVPixelFormat format)
{
  return format == AV_PIX_FMT_YUV444P10 || format == AV_PIX_FMT_YUV444P12;
}

int BitsOfFormat(AVPixelFormat format)
{
  return av_pix_fmt_desc_get(format)->comp[0].depth;
}

bool HasChroma(AVPixelFormat format)
{
  return av_pix_fmt_desc_get(format)->nb_components >= 3;
}

bool HasSparseChroma(const Track& track)
{
  return track.Role.Samples == Plane::Colors &&
    av_pix_fmt_desc_get(track.Format)->log2_chroma_w > 0;
}

bool NeedsEvenSize(AVPixelFormat format)
{
  return av_pix_fmt_desc_get(format)->log2_chroma_w > 0;
}
}
