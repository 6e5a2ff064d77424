// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupError.h"

#include "Pipeline/cslfFieldArrays.h"
#include "cslfColor.h"
#include "cslfLayout.h"
#include "cslfTrackDecoder.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cslf
{
namespace
{
bool MakePackets(const CodedGroup& part, std::vector<AVHandle<AVPacket>>& packets)
{
  for (const CodedFrame& frame : part.Frames)
  {
    AVHandle<AVPacket> packet(av_packet_alloc());
    if (!packet || av_new_packet(packet.get(), static_cast<int>(frame.Data.size())) < 0)
    {
      return false;
    }
    std::copy(frame.Data.begin(), frame.Data.end(), packet->data);
    packet->pts = frame.Index;
    packets.push_back(std::move(packet));
  }
  return true;
}

/// Decodes a track into its part of slices.
bool Decode(const TrackPart& track, int resolution, const std::vector<ViewpointSamples>& slices)
{
  const AVHandle<AVCodecParameters> parameters(avcodec_parameters_alloc());
  std::vector<AVHandle<AVPacket>> packets;
  if (!parameters ||
    !SetParameterSets(IDOfCodec(track.Kind.Coding), track.Part->ParameterSets, parameters.get()) ||
    !MakePackets(*track.Part, packets))
  {
    return false;
  }
  const auto decoder = TrackDecoder::Open(parameters.get(), resolution);
  if (!decoder)
  {
    return false;
  }
  decoder->Begin(packets, std::vector<bool>(slices.size(), true));
  FrameToSlice converter(track.Kind, resolution);
  for (const ViewpointSamples& slice : slices)
  {
    const AVFrame* frame = decoder->Next();
    if (!frame || !converter.Convert(frame, slice))
    {
      return false;
    }
  }
  return true;
}

/// Of all texels, or only of those with coverage in `b`.
double SumSquares(
  const unsigned char* a, const unsigned char* b, std::size_t texels, bool onlyCovered)
{
  double sum = 0.0;
  for (std::size_t texel = 0; texel < texels; ++texel)
  {
    int squares = 0;
    if (onlyCovered && b[ColorBytes * texel + 3] == 0)
    {
      continue;
    }
    for (int component = 0; component < 3; ++component)
    {
      const std::size_t place = ColorBytes * texel + component;
      const int difference = a[place] - b[place];
      squares += difference * difference;
    }
    sum += squares;
  }
  return sum;
}
}

bool MeasureSquaredError(const TrackPart& color, const TrackPart* coverage, int resolution,
  const std::vector<ViewpointSamples>& slices, double& sum, std::string& error)
{
  const std::size_t texels = static_cast<std::size_t>(TileCount) * resolution * resolution;
  ViewpointSamples samples;
  samples.SetArray(KnownChannel::Color,
    MakeArray(MakeChannel(KnownChannel::Color, VTK_UNSIGNED_CHAR),
      static_cast<vtkIdType>(texels * slices.size())));
  std::vector<ViewpointSamples> decoded(slices.size());
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    decoded[k] = samples.At(static_cast<vtkIdType>(texels * k));
  }
  if (!Decode(color, resolution, decoded) || (coverage && !Decode(*coverage, resolution, decoded)))
  {
    error = "what was coded cannot be decoded";
    return false;
  }
  sum = 0.0;
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    JoinChannels(resolution, coverage ? &coverage->Kind : nullptr, decoded[k]);
    sum += SumSquares(decoded[k].Get<unsigned char>(KnownChannel::Color),
      slices[k].Get<unsigned char>(KnownChannel::Color), texels, coverage == nullptr);
  }
  return true;
}
}
