// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfContainerReader.h"

#include "Files/cslfFileSystem.h"
#include "cslfFileParts.h"
#include "cslfMovieBoxes.h"

#include <vtkErrorCode.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace cslf
{
namespace
{
constexpr int BufferSize = 32768; // in bytes
constexpr std::uint64_t NumberSize = 4;
}

PatchedFile::PatchedFile(const InputFile& file, std::vector<std::uint64_t> places)
  : File(file)
  , Places(std::move(places))
{
  auto* buffer = static_cast<unsigned char*>(RequireMemory(av_malloc(BufferSize)));
  constexpr int isWritten = 0;
  this->Context = avio_alloc_context(
    buffer, BufferSize, isWritten, this, &PatchedFile::Read, nullptr, &PatchedFile::Seek);
  if (!this->Context)
  {
    av_free(buffer);
    throw std::bad_alloc();
  }
}

PatchedFile::~PatchedFile()
{
  // FFmpeg may have replaced the buffer.
  av_freep(&this->Context->buffer);
  avio_context_free(&this->Context);
}

int PatchedFile::Read(void* self, std::uint8_t* bytes, int count)
{
  auto* file = static_cast<PatchedFile*>(self);
  const std::size_t found =
    file->File.Read(file->Position, bytes, static_cast<std::size_t>(std::max(count, 0)));
  if (found == 0)
  {
    return AVERROR_EOF;
  }
  file->Patch(file->Position, bytes, found);
  file->Position += found;
  return static_cast<int>(found);
}

void PatchedFile::Patch(std::uint64_t begin, std::uint8_t* bytes, std::uint64_t count) const
{
  const std::uint64_t first = begin < NumberSize ? 0 : begin - NumberSize + 1;
  for (auto place = std::lower_bound(this->Places.begin(), this->Places.end(), first);
       place != this->Places.end() && *place < begin + count; ++place)
  {
    const std::uint64_t from = std::max(*place, begin) - begin;
    const std::uint64_t to = std::min(*place + NumberSize, begin + count) - begin;
    std::fill(bytes + from, bytes + to, std::uint8_t(0));
  }
}

std::int64_t PatchedFile::Seek(void* self, std::int64_t offset, int whence)
{
  auto* file = static_cast<PatchedFile*>(self);
  const auto size = static_cast<std::int64_t>(file->File.GetSize());
  if (whence == AVSEEK_SIZE)
  {
    return size;
  }
  const std::int64_t begin = whence == SEEK_END ? size
    : whence == SEEK_CUR                        ? static_cast<std::int64_t>(file->Position)
                                                : 0;
  if (offset < -begin)
  {
    return AVERROR(EINVAL);
  }
  file->Position = static_cast<std::uint64_t>(begin + offset);
  return begin + offset;
}

namespace
{

/// The most packets read for each track in search of its first one.
constexpr int FirstPacketSearch = 4 * MaximumGroupLength;

/// The most packets of each stream read in search of a group: frames of 10 seconds, the range
/// within which FFmpeg's muxers interleave tracks. Without a limit, each group of a track that ends
/// early would be searched for in the rest of the file.
constexpr int GroupSearch = 16 * MaximumGroupLength;

/// Whether the times of a group's packets agree with the display order stored in their pictures.
/// Times have no checksum, and a wrong one would exchange viewpoints.
bool AreInOrder(const AVCodecParameters* parameters, const std::vector<AVHandle<AVPacket>>& packets)
{
  const AVHandle<AVCodecParserContext> parser(RequireMemory(av_parser_init(parameters->codec_id)));
  const AVHandle<AVCodecContext> context(RequireMemory(avcodec_alloc_context3(nullptr)));
  if (RequireMemory(avcodec_parameters_to_context(context.get(), parameters)) < 0)
  {
    return false;
  }
  parser->flags |= PARSER_FLAG_COMPLETE_FRAMES;
  // Pictures in display order have no numbers.
  const AVCodecDescriptor* codec = avcodec_descriptor_get(parameters->codec_id);
  const bool isReordered = codec && (codec->props & AV_CODEC_PROP_REORDER) != 0;
  std::vector<std::pair<std::int64_t, int>> order;
  for (const AVHandle<AVPacket>& packet : packets)
  {
    std::uint8_t* data = nullptr;
    int size = 0;
    av_parser_parse2(parser.get(), context.get(), &data, &size, packet->data, packet->size,
      packet->pts, AV_NOPTS_VALUE, -1);
    order.emplace_back(
      packet->pts, isReordered ? parser->output_picture_number : static_cast<int>(order.size()));
  }
  std::sort(order.begin(), order.end());
  return std::is_sorted(
    order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
}

/// Whether the index of a file gives a packet a negative size, which is how FFmpeg reads sizes from
/// 512 MiB on. FFmpeg then reports a lack of memory.
bool HasNegativeSize(AVFormatContext* input)
{
  for (unsigned int k = 0; k < input->nb_streams; ++k)
  {
    AVStream* stream = input->streams[k];
    for (int i = 0; i < avformat_index_get_entries_count(stream); ++i)
    {
      if (avformat_index_get_entry(stream, i)->size < 0)
      {
        return true;
      }
    }
  }
  return false;
}

/// Whether a packet's time is in a range that is safe for arithmetic. In a damaged file it may be
/// anything.
bool HasTime(const AVPacket* packet)
{
  constexpr std::int64_t limit = std::int64_t(1) << 60;
  return packet->pts != AV_NOPTS_VALUE && packet->pts > -limit && packet->pts < limit;
}

bool Refuse(OpenError& failure, unsigned long code, const std::string& text)
{
  failure = { code, text };
  return false;
}
}

std::unique_ptr<ContainerReader> ContainerReader::Open(
  const std::string& fileName, OpenError& failure)
{
  auto reader = std::make_unique<ContainerReader>();
  reader->FileName = fileName;
  if (!reader->OpenContainer(failure) || !reader->ReadHeader(failure) ||
    !reader->FindTracks(failure))
  {
    return nullptr;
  }
  reader->ReadParts();
  return reader;
}

bool ContainerReader::OpenContainer(OpenError& failure)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(ToPath(this->FileName), ignored))
  {
    return Refuse(failure, vtkErrorCode::FileNotFoundError, "there is no such file");
  }
  constexpr char unknown[] = "it is not an MP4 or Matroska file, or it is damaged or truncated";
  std::string reason;
  if (!this->File.Open(this->FileName, reason))
  {
    return Refuse(failure, vtkErrorCode::CannotOpenFileError, reason);
  }
  std::vector<std::uint64_t> broken;
  if (!CanHoldMovieBoxes(this->File, broken))
  {
    return Refuse(failure, vtkErrorCode::UnrecognizedFileTypeError, unknown);
  }
  AVDictionary* options = nullptr;
  av_dict_set(&options, "format_whitelist", "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm", 0);
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  // Times are relative to each track's first one, so edit lists can be ignored.
  av_dict_set(&options, "ignore_editlist", "1", 0);
  this->Patched = std::make_unique<PatchedFile>(this->File, std::move(broken));
  AVFormatContext* context = RequireMemory(avformat_alloc_context());
  context->pb = this->Patched->GetContext();
  const std::string url = "file:" + this->FileName;
  const int code = avformat_open_input(&context, url.c_str(), nullptr, &options);
  av_dict_free(&options);
  RequireMemory(code);
  if (code < 0)
  {
    return Refuse(failure, vtkErrorCode::UnrecognizedFileTypeError, unknown);
  }
  this->Input.reset(context);
  this->HasBrokenIndex = HasNegativeSize(context);
  return true;
}

bool ContainerReader::ReadHeader(OpenError& failure)
{
  HeaderTags tags;
  for (const char* name : { HeaderTagNames[0], HeaderTagNames[1], PartsTagName })
  {
    if (const AVDictionaryEntry* tag = av_dict_get(this->Input->metadata, name, nullptr, 0))
    {
      tags[name] = tag->value;
    }
  }
  bool isOurs = false;
  std::string error;
  auto header = FileHeader::FromTags(tags, isOurs, error);
  if (!header)
  {
    return Refuse(failure,
      isOurs ? vtkErrorCode::FileFormatError : vtkErrorCode::UnrecognizedFileTypeError, error);
  }
  this->Header = std::move(*header);
  this->GroupStarts = this->Header.GetGroupStarts();
  return true;
}

bool ContainerReader::FindTracks(OpenError& failure)
{
  const int resolution = this->Header.Field.Grid.GetResolution();
  const std::size_t tracks = this->Header.Tracks.size();
  std::size_t place = 0; // among the streams listed in the header
  for (unsigned int stream = 0; stream < this->Input->nb_streams; ++stream)
  {
    const AVCodecParameters* parameters = this->Input->streams[stream]->codecpar;
    if (place == this->Header.Streams.size() ||
      parameters->codec_id != IDOfCodec(this->Header.Streams[place].Coding))
    {
      continue;
    }
    const int track = this->Header.Streams[place++].Track;
    if (track < 0)
    {
      continue;
    }
    const auto size = static_cast<std::size_t>(std::max(parameters->extradata_size, 0));
    Framing framing;
    if (!GetBitstream(this->Header.Tracks[track].Kind.Coding)
           .ReadConfiguration(parameters->extradata, size, framing) ||
      !IsExpected(framing.ParameterSetsCRC, this->Header.Tracks[track].ParameterSetsCRC) ||
      parameters->height != resolution || parameters->width != TileCount * resolution)
    {
      return Refuse(failure, vtkErrorCode::FileFormatError,
        std::string("its track \"") + NameOfRole(this->Header.Tracks[track].Kind.Role) +
          "\" is damaged");
    }
    // Copied, because other threads read them while packets are read.
    AVHandle<AVCodecParameters> copy(RequireMemory(avcodec_parameters_alloc()));
    RequireMemory(avcodec_parameters_copy(copy.get(), parameters));
    this->Parameters.push_back(std::move(copy));
    this->Streams.push_back(static_cast<int>(stream));
    this->Framings.push_back(framing);
  }
  return this->Streams.size() == tracks ||
    Refuse(failure, vtkErrorCode::FileFormatError,
      "it has " + std::to_string(this->Streams.size()) + " of its " + std::to_string(tracks) +
        " tracks");
}

// The parts in the first picture, one after the other.
void ContainerReader::ReadParts()
{
  std::vector<unsigned char> bytes;
  const Bitstream& bitstream = GetBitstream(this->Header.Tracks.front().Kind.Coding);
  if (!this->Header.InPicture.empty())
  {
    const GroupPackets packets = this->Read(0);
    for (const AVHandle<AVPacket>& packet : packets.Tracks.front())
    {
      if (packet->pts == 0)
      {
        bytes = bitstream.Unload(packet->data, static_cast<std::size_t>(std::max(packet->size, 0)),
          this->Framings.front());
      }
    }
    this->CarriedBytes = static_cast<std::int64_t>(bitstream.Load({}, bytes).size());
  }
  std::size_t begin = 0;
  for (ListedPart& listed : this->Header.InPicture)
  {
    const std::size_t end = begin + std::min(listed.Count, bytes.size() - begin);
    listed.Part.Bytes.assign(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
      bytes.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
    if (listed.Matches(listed.Part.Bytes))
    {
      this->Header.Parts.push_back(std::move(listed.Part));
    }
    else
    {
      this->Header.Warnings.push_back(DescribeDamage(listed.Part));
    }
  }
  this->Header.InPicture.clear();
}

int ContainerReader::FindTrack(const AVPacket* packet) const
{
  const auto found = std::find(this->Streams.begin(), this->Streams.end(), packet->stream_index);
  return found == this->Streams.end() ? -1 : static_cast<int>(found - this->Streams.begin());
}

void ContainerReader::FindFirstTimes()
{
  const std::size_t tracks = this->Streams.size();
  this->FirstTimes.assign(tracks, AV_NOPTS_VALUE);
  const AVHandle<AVPacket> packet(RequireMemory(av_packet_alloc()));
  std::size_t missing = tracks;
  for (std::size_t k = 0;
       missing > 0 && k < FirstPacketSearch * tracks && this->ReadPacket(packet.get()); ++k)
  {
    const int track = this->FindTrack(packet.get());
    if (track >= 0 && this->FirstTimes[track] == AV_NOPTS_VALUE && HasTime(packet.get()))
    {
      this->FirstTimes[track] = packet->pts;
      --missing;
    }
    av_packet_unref(packet.get());
  }
  // If the beginning of a track is lost, it starts where the colour does.
  const AVRational colorTime = this->Input->streams[this->Streams.front()]->time_base;
  for (std::size_t track = 0; track < tracks; ++track)
  {
    if (this->FirstTimes[track] == AV_NOPTS_VALUE)
    {
      const std::int64_t color =
        this->FirstTimes.front() == AV_NOPTS_VALUE ? 0 : this->FirstTimes.front();
      this->FirstTimes[track] =
        av_rescale_q(color, colorTime, this->Input->streams[this->Streams[track]]->time_base);
    }
  }
}

bool ContainerReader::ReadPacket(AVPacket* packet)
{
  // If one group's places in the file are wrong, its packets cannot be read, but later ones can.
  const std::size_t most = MaximumGroupLength * this->Streams.size();
  for (std::size_t failures = 0; failures <= most; ++failures)
  {
    const int code = av_read_frame(this->Input.get(), packet);
    if ((this->HasBrokenIndex ? code : RequireMemory(code)) >= 0)
    {
      return true;
    }
    this->HasFailed = true;
  }
  return false;
}

bool ContainerReader::SeekTo(int frame, Start start)
{
  if (this->FirstTimes.empty())
  {
    this->FindFirstTimes();
  }
  // Seeking uses decoding times in MP4 and presentation times in Matroska. Remuxing may change the
  // difference between them, but only within a group.
  const int stream = this->Streams.front();
  AVStream* track = this->Input->streams[stream];
  const AVIndexEntry* first = avformat_index_get_entry(track, 0);
  const bool isExact = start == Start::AtGroup && first;
  const std::int64_t time = (isExact ? first->timestamp : this->FirstTimes.front()) +
    av_rescale_q(frame - (isExact ? 0 : MaximumGroupLength), FrameTime, track->time_base);
  // To any frame: if a track's key frame flags are damaged, seeking would not move.
  const int flags = AVSEEK_FLAG_BACKWARD | AVSEEK_FLAG_ANY;
  return av_seek_frame(this->Input.get(), stream, time, flags) >= 0;
}

long long ContainerReader::FindFrame(std::size_t track, const AVPacket* packet) const
{
  return HasTime(packet) ? av_rescale_q(packet->pts - this->FirstTimes[track],
                             this->Input->streams[packet->stream_index]->time_base, FrameTime)
                         : -1;
}

GroupPackets ContainerReader::Read(int group)
{
  this->HasFailed = false;
  GroupPackets packets = this->ReadFrom(Start::BeforeGroup, group);
  // After unreadable packets of an earlier group, FFmpeg gives wrong times.
  return this->HasFailed ? this->ReadFrom(Start::AtGroup, group) : std::move(packets);
}

GroupPackets ContainerReader::ReadFrom(Start start, int group)
{
  const std::size_t tracks = this->Streams.size();
  GroupPackets packets;
  packets.Tracks.resize(tracks);
  const int begin = this->GroupStarts[group];
  const int end = this->GroupStarts[group + 1];
  if (!this->SeekTo(begin, start))
  {
    return packets;
  }
  std::size_t wanted = static_cast<std::size_t>(end - begin) * tracks;
  std::vector<bool> passed(tracks, false);
  AVHandle<AVPacket> packet(RequireMemory(av_packet_alloc()));
  for (std::size_t left = std::size_t(GroupSearch) * this->Input->nb_streams;
       wanted > 0 && left > 0 && this->ReadPacket(packet.get()); --left)
  {
    const int track = this->FindTrack(packet.get());
    const long long frame = track < 0 ? -1 : this->FindFrame(track, packet.get());
    if (frame >= begin && frame < end)
    {
      packet->pts = frame - begin;
      packet->dts = AV_NOPTS_VALUE;
      // It may contain other parameter sets, which no checksum covers.
      av_packet_free_side_data(packet.get());
      packets.Tracks[track].push_back(std::move(packet));
      packet.reset(RequireMemory(av_packet_alloc()));
      --wanted;
      continue;
    }
    if (frame >= end)
    {
      passed[track] = true;
      if (std::all_of(passed.begin(), passed.end(), [](bool isPassed) { return isPassed; }))
      {
        break;
      }
    }
    av_packet_unref(packet.get());
  }
  return packets;
}

std::vector<std::int64_t> ContainerReader::CountBytes()
{
  std::vector<std::int64_t> bytes(this->Streams.size(), 0);
  const AVHandle<AVPacket> packet(RequireMemory(av_packet_alloc()));
  for (const bool isThere = this->SeekTo(0, Start::BeforeGroup);
       isThere && this->ReadPacket(packet.get());)
  {
    const int track = this->FindTrack(packet.get());
    if (track >= 0)
    {
      bytes[track] += packet->size;
    }
    av_packet_unref(packet.get());
  }
  bytes.front() = std::max<std::int64_t>(0, bytes.front() - this->CarriedBytes);
  return bytes;
}

bool ContainerReader::IsTrackWhole(int group, std::size_t track, const GroupPackets& packets) const
{
  const int length = this->Header.Groups[group];
  const Bitstream& bitstream = GetBitstream(this->Header.Tracks[track].Kind.Coding);
  std::vector<bool> seen(length, false);
  std::uint32_t crc = 0;
  for (const AVHandle<AVPacket>& packet : packets.Tracks[track])
  {
    if (seen[packet->pts] ||
      !bitstream.AddToCRC(packet->data, static_cast<std::size_t>(std::max(packet->size, 0)),
        this->Framings[track], crc))
    {
      return false;
    }
    seen[packet->pts] = true;
  }
  return static_cast<int>(packets.Tracks[track].size()) == length &&
    IsExpected(crc, this->Header.Tracks[track].GroupCRCs[group]) &&
    AreInOrder(this->GetParameters(track), packets.Tracks[track]);
}

bool ContainerReader::IsWhole(int group, const GroupPackets& packets) const
{
  for (std::size_t track = 0; track < packets.Tracks.size(); ++track)
  {
    if (!this->IsTrackWhole(group, track, packets))
    {
      return false;
    }
  }
  return true;
}
}
