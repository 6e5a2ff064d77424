// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTrack.h"

#include <algorithm>

namespace cslf
{
namespace
{
struct RoleRow
{
  TrackRole Role;
  const char* Name;
  std::vector<AVPixelFormat> Formats;
};

const std::vector<RoleRow>& GetRoles()
{
  static const std::vector<RoleRow> roles = {
    { TrackRole::Color, "color",
      { AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV420P,
        AV_PIX_FMT_YUV420P10, AV_PIX_FMT_GBRP, AV_PIX_FMT_YUV444P12 } },
    { TrackRole::Coverage, "coverage", { AV_PIX_FMT_GRAY8, AV_PIX_FMT_YUV420P } },
    { TrackRole::Depth, "depth", { AV_PIX_FMT_GRAY12, AV_PIX_FMT_GRAY10, AV_PIX_FMT_YUV420P10 } },
    { TrackRole::DepthHigh, "depth-high", { AV_PIX_FMT_GRAY8 } },
    { TrackRole::DepthLow, "depth-low", { AV_PIX_FMT_GRAY8 } },
  };
  return roles;
}

const RoleRow& GetRow(TrackRole role)
{
  return *std::find_if(
    GetRoles().begin(), GetRoles().end(), [role](const RoleRow& row) { return row.Role == role; });
}
}

const char* NameOfRole(TrackRole role)
{
  return GetRow(role).Name;
}

std::optional<TrackRole> RoleOfName(const std::string& name)
{
  for (const RoleRow& row : GetRoles())
  {
    if (name == row.Name)
    {
      return row.Role;
    }
  }
  return std::nullopt;
}

std::optional<AVPixelFormat> FindPixelFormat(TrackRole role, const std::string& name)
{
  for (const AVPixelFormat format : GetRow(role).Formats)
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
  std::string list;
  for (const AVPixelFormat format : GetRow(TrackRole::Color).Formats)
  {
    list += (list.empty() ? "" : ", ") + NameOfFormat(format);
  }
  return list;
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
  return track.Role == TrackRole::Color && av_pix_fmt_desc_get(track.Format)->log2_chroma_w > 0;
}

bool NeedsEvenSize(AVPixelFormat format)
{
  return av_pix_fmt_desc_get(format)->log2_chroma_w > 0;
}
}
