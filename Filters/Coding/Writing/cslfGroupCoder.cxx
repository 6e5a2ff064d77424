// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupCoder.h"
#include "Coding/Groups/cslfGroupEncoder.h"
#include "Coding/Groups/cslfTrackDecoder.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfParallelFor.h"
#include "cslfColor.h"
#include "cslfLayout.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// The error of the colours of a coded group.

/// A coded group, and its track.
struct GroupOfTrack
{
  Track Kind;
  const CodedGroup* Group = nullptr;
};

bool MakePackets(const CodedGroup& group, std::vector<AVHandle<AVPacket>>& packets)
{
  for (const CodedFrame& frame : group.Frames)
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
bool Decode(const GroupOfTrack& track, int resolution, const std::vector<ViewpointSamples>& slices)
{
  const AVHandle<AVCodecParameters> parameters(avcodec_parameters_alloc());
  std::vector<AVHandle<AVPacket>> packets;
  if (!parameters ||
    !SetParameterSets(IDOfCodec(track.Kind.Coding), track.Group->ParameterSets, parameters.get()) ||
    !MakePackets(*track.Group, packets))
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

/// Decodes the colour of a layer like readers do, and adds the squared errors of red, green and
/// blue of all texels, in units of 1/255. Colour has associated alpha, so this is the error over
/// black. Without a track of coverage, colour has no meaning where the slices have no coverage. On
/// failure returns false and gives the reason in one line.
bool AddSquaredError(const GroupOfTrack& color, const GroupOfTrack* coverage, int resolution,
  const std::vector<ViewpointSamples>& slices, double& sum, std::string& error)
{
  const std::size_t texels = static_cast<std::size_t>(TileCount) * resolution * resolution;
  const ChannelId id = color.Kind.Role.Source;
  ViewpointSamples samples;
  samples.SetArray(id,
    MakeArray(MakeChannel(id, VTK_UNSIGNED_CHAR), static_cast<vtkIdType>(texels * slices.size())));
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
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    JoinChannels(
      resolution, [coverage](TrackRole) { return coverage ? &coverage->Kind : nullptr; },
      decoded[k]);
    sum += SumSquares(decoded[k].Get<unsigned char>(id), slices[k].Get<unsigned char>(id), texels,
      coverage == nullptr);
  }
  return true;
}

// Divides the bytes of a file among its tracks.

/// The rate factor of colour up to which coverage and depth keep their own.
constexpr double FixedFactors = 22.0;

/// The rate factor of coverage or depth in a file whose size or quality is controlled: `own` up to
/// a factor of colour of 22, and higher by the excess above that. So small files do not spend most
/// of their bytes on depth, and good ones keep exact depth.
inline double FindTrackFactor(double own, double color)
{
  return std::min(51.0, own + std::max(0.0, color - FixedFactors));
}

/// The share of coding in the progress, before errors are measured.
constexpr double CodingShare = 0.8;

/// Calls `work` with the numbers below `count` in parallel, and with a function that it calls now
/// and then: if that returns false, it ends. The calling thread only reports the progress, because
/// with some backends of vtkSMPTools it would do no work. False if any work set its error, or was
/// stopped; returns the first error.
template <typename Work>
bool DoSideBySide(std::size_t count, const Progress& progress, const Work& work, std::string& error)
{
  std::vector<std::string> errors(count);
  std::atomic<bool> isStopped{ false };
  std::atomic<std::size_t> done{ 0 };
  const auto proceed = [&isStopped] { return !isStopped; };
  const auto report = [&]
  {
    if (!isStopped && !progress(static_cast<double>(done) / static_cast<double>(count)))
    {
      isStopped = true;
    }
  };
  report();
  std::future<void> all = std::async(std::launch::async,
    [&]
    {
      ParallelFor(0, static_cast<vtkIdType>(count), 1,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType k = begin; k < end && proceed(); ++k)
          {
            work(static_cast<std::size_t>(k), proceed, errors[k]);
            ++done;
          }
        });
    });
  try
  {
    WaitFor(all, report);
  }
  catch (...)
  {
    isStopped = true; // the work ends before its variables do
    throw;
  }
  all.get();
  if (isStopped)
  {
    error = Stopped;
    return false;
  }
  const auto failed = std::find_if(
    errors.begin(), errors.end(), [](const std::string& text) { return !text.empty(); });
  error = failed == errors.end() ? std::string() : *failed;
  return error.empty();
}
}

GroupCoder::GroupCoder(const EncodeSettings& settings, const Description& field,
  std::vector<int> groups, std::vector<TrackRole> computed)
  : Settings(settings)
  , Resolution(field.Grid.GetResolution())
  , IsRadiance(HasRadiance(field))
  , Groups(std::move(groups))
  , Computed(std::move(computed))
{
  const EncoderChoice choice = ChooseEncoder(settings, this->IsRadiance, this->Resolution);
  for (const ChannelId id : ChannelIds)
  {
    if (const Channel* channel = field.FindChannel(id))
    {
      this->AddTracks(id, *FindForm(*channel), choice);
    }
  }
}

void GroupCoder::AddTracks(ChannelId id, const ChannelForm& form, const EncoderChoice& choice)
{
  for (const Plane plane : GetPlanes(form.Kind, this->Settings.Lossless))
  {
    Track track;
    track.Role = { id, plane };
    if (std::find(this->Computed.begin(), this->Computed.end(), track.Role) != this->Computed.end())
    {
      continue;
    }
    track.Format =
      plane == Plane::Colors ? choice.Color : choice.Encoder->GetFormat(form.Kind, plane);
    track.Lossless = this->Settings.Lossless;
    track.Coding = choice.Encoder->Coding;
    track.IsRadiance = form.Kind == SampleKind::FloatColor && plane == Plane::Colors;
    track.IsCurved = form.IsDistance && plane == Plane::Numbers;
    this->Encodings.push_back({ track,
      { this->Settings.Preset, this->Settings.GetCRF(plane), this->Settings.GroupLength } });
  }
}

std::vector<Track> GroupCoder::GetTracks() const
{
  std::vector<Track> tracks;
  for (const Encoding& encoding : this->Encodings)
  {
    tracks.push_back(encoding.Kind);
  }
  return tracks;
}

bool GroupCoder::Encode(const std::vector<CodingTask>& tasks,
  const std::vector<ViewpointSamples>& slices, const Progress& progress,
  std::vector<GroupTracks>& coded, std::string& error) const
{
  std::vector<Coding> codings = this->Split(tasks, slices, coded);
  const std::size_t tracks = this->Encodings.size();
  const auto encode = [&](std::size_t job, const std::function<bool()>& proceed, std::string& fault)
  { this->EncodeTrack(job % tracks, codings[job / tracks], proceed, fault); };
  if (!DoSideBySide(tracks * codings.size(), Within(progress, 0.0, CodingShare), encode, error))
  {
    return false;
  }
  codings.erase(std::remove_if(codings.begin(), codings.end(),
                  [](const Coding& coding) { return !coding.IsMeasured; }),
    codings.end());
  const auto measure = [&](std::size_t job, const std::function<bool()>&, std::string& fault)
  { this->MeasureError(codings[job], fault); };
  return DoSideBySide(codings.size(), Within(progress, CodingShare, 1.0), measure, error);
}

std::vector<GroupCoder::Coding> GroupCoder::Split(const std::vector<CodingTask>& tasks,
  const std::vector<ViewpointSamples>& slices, std::vector<GroupTracks>& coded) const
{
  std::vector<Coding> codings;
  auto from = slices.begin();
  for (const CodingTask& task : tasks)
  {
    const auto to = from + this->Groups[task.Group];
    for (double factor : task.Factors)
    {
      codings.push_back({ { from, to }, factor, this->IsMeasured(task), nullptr });
    }
    from = to;
  }
  coded.assign(codings.size(), GroupTracks(this->Encodings.size()));
  for (std::size_t place = 0; place < coded.size(); ++place)
  {
    codings[place].Tracks = &coded[place];
  }
  return codings;
}

EncodeOptions GroupCoder::GetOptions(const Encoding& encoding, double factor) const
{
  EncodeOptions options = encoding.Options;
  const bool isFixed = this->Settings.Target.Kind == RateTarget::Kinds::Factor;
  options.CRF = encoding.Kind.Role.Samples == Plane::Colors ? factor
    : isFixed                                               ? options.CRF
                                                            : FindTrackFactor(options.CRF, factor);
  return options;
}

bool GroupCoder::IsMeasured(const CodingTask& task) const
{
  return !this->Settings.Lossless && !this->IsRadiance &&
    (!task.IsTrial || this->Settings.Target.Kind == RateTarget::Kinds::PSNR);
}

void GroupCoder::EncodeTrack(std::size_t track, const Coding& coding,
  const std::function<bool()>& proceed, std::string& error) const
{
  const Encoding& encoding = this->Encodings[track];
  EncodeGroup(encoding.Kind, this->Resolution, this->GetOptions(encoding, coding.Factor),
    coding.Frames, proceed, (*coding.Tracks)[track], error);
}

void GroupCoder::MeasureError(const Coding& coding, std::string& error) const
{
  GroupTracks& tracks = *coding.Tracks;
  std::map<TrackRole, GroupOfTrack> coded;
  for (std::size_t track = 0; track < this->Encodings.size(); ++track)
  {
    const Track& kind = this->Encodings[track].Kind;
    coded[kind.Role] = { kind, &tracks[track] };
  }
  double sum = 0.0;
  for (const auto& [role, color] : coded)
  {
    const auto coverage = coded.find(CoverageOf(role.Source.Layer));
    if (role.Samples == Plane::Colors &&
      !AddSquaredError(color, coverage == coded.end() ? nullptr : &coverage->second,
        this->Resolution, coding.Frames, sum, error))
    {
      return;
    }
  }
  tracks.front().SquaredError = sum;
}
}
