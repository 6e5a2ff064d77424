// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Malicious files: their checksums are right, but they claim contents that they do not have.
#include "Coding/Codecs/cslfBitstreams.h"
#include "Coding/Containers/cslfContainerReader.h"
#include "Coding/Containers/cslfMovieBoxes.h"
#include "Coding/Groups/cslfTrackDecoder.h"
#include "Files/cslfFileSystem.h"
#include "cslfCodecTesting.h"
#include "cslfRemux.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace
{
constexpr int FramesOfField = 24;
constexpr int FramesOfGroup = 8;

std::unique_ptr<cslf::ContainerReader> Open(const std::string& fileName)
{
  cslf::OpenError failure;
  auto reader = cslf::ContainerReader::Open(fileName, failure);
  CSLF_CHECK(reader != nullptr);
  return reader;
}

/// The header of a file that is repeated `times` times in each direction, at some resolution.
cslf::FileHeader MakeHeader(const std::string& fileName, int times, int resolution)
{
  const auto reader = Open(fileName);
  cslf::FileHeader header = reader->GetHeader();
  header.Field.Grid = cslf::Layout(2 * times, resolution);
  header.Frames.clear();
  for (int frame = 0; frame < FramesOfField * times * times; ++frame)
  {
    header.Frames.push_back(frame);
  }
  const auto repeat = [times](auto& values)
  {
    const auto once = values;
    for (int k = 1; k < times * times; ++k)
    {
      values.insert(values.end(), once.begin(), once.end());
    }
  };
  repeat(header.Groups);
  for (cslf::CodedTrack& track : header.Tracks)
  {
    repeat(track.GroupCRCs);
  }
  return header;
}

/// The bytes that this process has read from files so far.
double CountRead()
{
  std::ifstream file("/proc/self/io");
  std::string name;
  double bytes = 0.0;
  file >> name >> bytes;
  return bytes;
}

/// A track that ends early is not searched for in the rest of the file for every group.
void TestShortTrack(const std::string& fileName, const std::string& extension)
{
  constexpr int times = 20;
  cslf::testing::RemuxChanges changes;
  changes.SetTags = MakeHeader(fileName, times, 16).ToTags();
  changes.Repeats = times * times;
  const std::string large = fileName + ".large" + extension;
  const std::string cut = fileName + ".short" + extension;
  CSLF_CHECK(cslf::testing::Remux(fileName, large, changes));
  changes.Frames = { FramesOfField * times * times, 5 * FramesOfGroup + 3 };
  CSLF_CHECK(cslf::testing::Remux(fileName, cut, changes));

  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(large.c_str());
  CSLF_CHECK(decoder->FindMissingViewpoints() == 0);
  decoder->SetFileName(cut.c_str());
  const double before = CountRead();
  const vtkIdType whole = 5 * FramesOfGroup;
  CSLF_CHECK(decoder->FindMissingViewpoints() == FramesOfField * times * times - whole);
  CSLF_CHECK(decoder->GetMissingViewpoints()->GetValue(0) == whole);
  const double passes =
    (CountRead() - before) / static_cast<double>(std::filesystem::file_size(cut));
  std::cout << cut << " was read " << passes << " times\n";
  CSLF_CHECK(passes < 200.0);
}

/// Memory is allocated for the contents of a file, not for its claims.
void TestClaims(const std::string& fileName)
{
  constexpr int times = 20;
  constexpr int resolution = 1024;
  cslf::testing::RemuxChanges changes;
  changes.SetTags = MakeHeader(fileName, times, resolution).ToTags();
  changes.Width = cslf::TileCount * resolution;
  changes.Height = resolution;
  for (int frames : { 1, FramesOfField })
  {
    changes.Frames = { frames, frames, frames };
    const std::string name = fileName + ".claims" + std::to_string(frames) + ".mp4";
    CSLF_CHECK(cslf::testing::Remux(fileName, name, changes));
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(name.c_str());
    const cslf::testing::Observed observed(decoder);
    decoder->Update();
    CSLF_CHECK(observed.HasError(frames == 1 ? "none of the 9600" : "only 24 of the 9600"));
    CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
    // Their checksums are right, but their frames are smaller.
    CSLF_CHECK(decoder->IsViewpointDamaged(0));
  }
}

/// Frames that are larger than the header says are not decoded.
void TestLargeFrames(const std::string& fileName, int resolution)
{
  const auto reader = Open(fileName);
  const cslf::AVLogSilence silence;
  CSLF_CHECK(cslf::TrackDecoder::Open(reader->GetParameters(0), resolution) != nullptr);
  CSLF_CHECK(cslf::TrackDecoder::Open(reader->GetParameters(0), 16) == nullptr);
}

/// Writes 32-bit big-endian numbers at a place of a file.
void Put(std::vector<char>& bytes, std::size_t place, const std::vector<std::uint32_t>& words)
{
  CSLF_CHECK(place + 4 * words.size() <= bytes.size());
  for (const std::uint32_t word : words)
  {
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      bytes[place++] = static_cast<char>(word >> shift);
    }
  }
}

/// Wrong entries in an MP4 file's index: a packet that is larger than the file, which FFmpeg may
/// take for a negative size, and a place behind the end. Only the group that they belong to is
/// lost.
void TestBrokenIndex(const std::string& fileName)
{
  const std::string name = fileName + ".index.mp4";
  const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  const auto find = [&bytes](const std::string& type)
  {
    const auto found = std::search(bytes.begin(), bytes.end(), type.begin(), type.end());
    CSLF_CHECK(found != bytes.end());
    return static_cast<std::size_t>(found - bytes.begin());
  };
  const cslf::FileHeader header = Open(fileName)->GetHeader();
  const std::vector<int> starts = header.GetGroupStarts();
  const auto test = [&](std::size_t place, std::uint32_t value, int frame)
  {
    const auto group = std::upper_bound(starts.begin(), starts.end(), frame) - starts.begin() - 1;
    std::vector<char> changed = bytes;
    Put(changed, place, { value });
    cslf::testing::WriteBytes(name, changed);
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(name.c_str());
    const cslf::testing::Observed observed(decoder);
    const vtkIdType missing = decoder->FindMissingViewpoints();
    std::cout << "0x" << std::hex << value << std::dec << " in group " << group << ": " << missing
              << " missing\n";
    CSLF_CHECK(missing == starts[group + 1] - starts[group]);
    for (int k = 0; k < FramesOfField; ++k)
    {
      const bool isLost = k >= starts[group] && k < starts[group + 1];
      CSLF_CHECK(decoder->IsViewpointDamaged(header.Frames[k].Slice) == isLost);
    }
    CSLF_CHECK(!observed.HasError("memory"));
  };
  // After the name: the version, the size of all packets and their number, and the sizes.
  for (const int packet : { 0, 3, 12, 20 })
  {
    for (const std::uint32_t size : { 0x10000000, 0x30000000, 0x7fffffff })
    {
      test(find("stsz") + 16 + 4 * packet, size, packet);
    }
  }
  // The version, the number of chunks, and their offsets, one chunk per group.
  test(find("stco") + 12 + 4, 0x10000000, starts[1]);
}

/// Tables of an MP4 file that announce up to 2 GB, more than the file contains. FFmpeg allocates
/// memory for them before it reads them.
void TestTables(const std::string& fileName)
{
  const std::string name = fileName + ".tables.mp4";
  const std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  struct Change
  {
    std::string Type;
    std::string NewType;
    std::size_t Place; // after the name and the version
    std::vector<std::uint32_t> Words;
  };
  const std::uint32_t sync = 0x73796e63;
  const std::uint32_t rap = 0x72617020;
  for (const Change& change :
    { Change{ "stco", "stco", 0, { 200000000 } }, Change{ "stco", "co64", 0, { 4 } },
      Change{ "stts", "stts", 0, { 2 } }, Change{ "ctts", "ctts", 0, { 200000000 } },
      Change{ "stsc", "stsc", 0, { 100000000 } }, Change{ "stss", "stss", 0, { 400000000 } },
      Change{ "stss", "stps", 0, { 400000000 } }, Change{ "stss", "sgpd", 0, { sync, 2000000000 } },
      Change{ "stss", "sbgp", 0, { rap, 250000000 } },
      Change{ "stsz", "stsz", 0, { 0, FramesOfField + 1 } },
      Change{ "stsz", "stsz", 0, { 1, 65537 } }, Change{ "stsz", "stz2", 0, { 8, 64000000 } },
      Change{ "stsc", "stsc", 4, { 1, 0x7fffffff } }, Change{ "stsd", "stsd", 0, { 2 } },
      Change{ "stts", "cmov", 0, {} }, Change{ "moov", "free", 0, {} } })
  {
    std::vector<char> changed = bytes;
    const auto found =
      std::search(changed.begin(), changed.end(), change.Type.begin(), change.Type.end());
    CSLF_CHECK(found != changed.end());
    std::copy(change.NewType.begin(), change.NewType.end(), found);
    Put(
      changed, static_cast<std::size_t>(found - changed.begin()) + 8 + change.Place, change.Words);
    cslf::testing::WriteBytes(name, changed);
    std::vector<std::uint64_t> broken;
    std::string reason;
    cslf::InputFile file;
    CSLF_CHECK(file.Open(name, reason));
    if (cslf::CanHoldMovieBoxes(file, broken))
    {
      std::cerr << change.Type << " became " << change.NewType << " and was taken\n";
      CSLF_CHECK(false);
    }
    CSLF_CHECK(vtkNew<vtkCSLFDecoder>()->CanReadFile(name.c_str()) == 0);
  }
}

/// A file that disappears while it is open.
void TestVanished(const std::string& fileName)
{
  const std::string name = fileName + ".vanished.mp4";
  std::filesystem::copy_file(fileName, name, std::filesystem::copy_options::overwrite_existing);
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(name.c_str());
  decoder->UpdateInformation();
  std::filesystem::resize_file(name, 0);
  const cslf::testing::Observed observed(decoder);
  for (vtkIdType z = 5 * FramesOfField; z < 10 * FramesOfField; z += FramesOfGroup)
  {
    vtkNew<vtkImageData> image;
    CSLF_CHECK(!decoder->GetViewpoint(z, image));
  }
  decoder->Update();
  CSLF_CHECK(observed.GetErrors() > 0);
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
}

/// A file that another one replaces while it is open, which is how files are written; and one whose
/// bytes are replaced by those of another field. It is larger than FFmpeg's buffer.
void TestReplaced(const std::string& fileName, const std::string& otherName)
{
  const auto expected = cslf::testing::Decode(fileName);
  for (const bool isRenamed : { true, false })
  {
    const std::string name = fileName + ".replaced.mp4";
    const auto always = std::filesystem::copy_options::overwrite_existing;
    std::filesystem::copy_file(fileName, name, always);
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(name.c_str());
    decoder->AllowMissingOff();
    decoder->UpdateInformation();
    const cslf::testing::Observed observed(decoder);
    if (isRenamed)
    {
      std::filesystem::copy_file(otherName, name + ".new", always);
      std::filesystem::rename(name + ".new", name);
    }
    else
    {
      cslf::testing::WriteBytes(name, cslf::testing::ReadBytes(otherName));
    }
    decoder->Update();
    if (isRenamed)
    {
      CSLF_CHECK(observed.GetErrors() == 0 && observed.GetWarnings() == 0);
      CSLF_CHECK(cslf::testing::HasEqualSlices(decoder->GetOutput(), expected));
    }
    else
    {
      CSLF_CHECK(observed.HasError("changed while it was open"));
      CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
    }
    decoder->Modified();
    decoder->Update();
    CSLF_CHECK(
      cslf::testing::HasEqualSlices(decoder->GetOutput(), cslf::testing::Decode(otherName)));
  }
}

/// A unit with `payload` after its header, as stored in a container.
std::vector<std::uint8_t> MakeUnit(
  const std::vector<std::uint8_t>& header, const std::vector<std::uint8_t>& payload)
{
  std::vector<std::uint8_t> unit = header;
  unit.insert(unit.end(), payload.begin(), payload.end());
  const auto size = static_cast<std::uint8_t>(unit.size());
  unit.insert(unit.begin(), { 0, 0, 0, size });
  return unit;
}

/// Whether a packet that begins with `unit` is accepted for the track.
bool IsTaken(const cslf::Bitstream& bitstream, const cslf::Framing& framing,
  std::vector<std::uint8_t> unit, const AVPacket* packet)
{
  unit.insert(unit.end(), packet->data, packet->data + packet->size);
  std::uint32_t crc = 0;
  std::uint32_t expected = 0;
  CSLF_CHECK(bitstream.AddToCRC(packet->data, packet->size, framing, expected));
  return bitstream.AddToCRC(unit.data(), unit.size(), framing, crc) && crc == expected;
}

/// Units within a group that no checksum covers but that decoders act on.
void TestUnits(const std::string& fileName)
{
  const auto reader = Open(fileName);
  const cslf::Codec codec = reader->GetHeader().Tracks[0].Kind.Coding;
  const AVCodecParameters* parameters = reader->GetParameters(0);
  const cslf::Bitstream& bitstream = cslf::GetBitstream(codec);
  cslf::Framing framing;
  CSLF_CHECK(
    bitstream.ReadConfiguration(parameters->extradata, parameters->extradata_size, framing));
  const cslf::GroupPackets packets = reader->Read(0);
  CSLF_CHECK(!packets.Tracks[0].empty());
  const auto isTaken = [&](const std::vector<std::uint8_t>& unit)
  { return IsTaken(bitstream, framing, unit, packets.Tracks[0].front().get()); };
  if (codec == cslf::Codec::AV1)
  {
    // A sequence header follows the four bytes of the record, with its size.
    std::vector<std::uint8_t> header(
      parameters->extradata + 4, parameters->extradata + parameters->extradata_size);
    CSLF_CHECK(isTaken(header));
    header.back() ^= 1;
    CSLF_CHECK(!isTaken(header));
    CSLF_CHECK(isTaken({ 2 << 3 | 2, 0 }));           // a temporal delimiter
    CSLF_CHECK(isTaken({ 15 << 3 | 2, 2, 7, 0x80 })); // padding
    CSLF_CHECK(!isTaken({ 5 << 3 | 2, 1, 0x80 }));    // metadata
    CSLF_CHECK(!isTaken({ 7 << 3 | 2, 1, 0x80 }));    // a repeated frame header
    return;
  }
  // The first picture parameter set of the record begins after its size.
  const bool isHEVC = codec == cslf::Codec::HEVC;
  const std::vector<std::uint8_t> header =
    isHEVC ? std::vector<std::uint8_t>{ 34 << 1, 1 } : std::vector<std::uint8_t>{ 0x68 };
  const std::uint8_t* begin = parameters->extradata;
  const std::uint8_t* end = begin + parameters->extradata_size;
  const std::uint8_t* set = std::search(begin, end, header.begin(), header.end());
  CSLF_CHECK(set != end);
  std::vector<std::uint8_t> payload(set + header.size(), set + set[-1]);
  CSLF_CHECK(isTaken(MakeUnit(header, payload)));
  payload.back() ^= 4;
  CSLF_CHECK(!isTaken(MakeUnit(header, payload)));
  using Header = std::vector<std::uint8_t>;
  const auto make = [&](int type)
  {
    return MakeUnit(isHEVC ? Header{ static_cast<std::uint8_t>(type << 1), 1 }
                           : Header{ static_cast<std::uint8_t>(type) },
      { 0x50 });
  };
  CSLF_CHECK(isTaken(make(isHEVC ? 35 : 9)));   // a delimiter
  CSLF_CHECK(isTaken(make(isHEVC ? 38 : 12)));  // filler data
  CSLF_CHECK(!isTaken(make(isHEVC ? 39 : 6)));  // supplemental information
  CSLF_CHECK(!isTaken(make(isHEVC ? 36 : 10))); // the end of a sequence
}
}

int TestCSLFDecoderHostile(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "DecoderHostile");
  const auto field = cslf::testing::MakeByteField(2, 16);
  const std::string fileName = folder + "/field.mp4";
  for (const char* codec : { "h264", "av1", "hevc" })
  {
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetCodec(codec);
    encoder->SetPreset("ultrafast");
    encoder->SetGroupLength(FramesOfGroup);
    if (vtkCSLFEncoder::CanEncode(codec))
    {
      CSLF_CHECK(cslf::testing::Encode(encoder, field, fileName));
      TestUnits(fileName);
    }
  }
  TestShortTrack(fileName, ".mp4");
  TestShortTrack(fileName, ".mkv");
  TestClaims(fileName);
  TestBrokenIndex(fileName);
  TestTables(fileName);
  TestVanished(fileName + ".large.mp4");

  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  encoder->SetGroupLength(FramesOfGroup);
  const std::string large = folder + "/large.mp4";
  CSLF_CHECK(cslf::testing::Encode(encoder, cslf::testing::MakeByteField(2, 64), large));
  TestLargeFrames(large, 64);
  TestReplaced(large, fileName);
  return cslf::testing::Result();
}
