// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The packets of a coded file, group by group.
 */
#ifndef cslfContainerReader_h
#define cslfContainerReader_h

#include "Coding/Codecs/cslfAV.h"
#include "Files/cslfFileSystem.h"
#include "cslfFileHeader.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
class InputFile;

class PatchedFile
{
public:
  /// The file must outlive this object. The numbers have 32 bits. `places` are their offsets in
  /// bytes, in ascending order.
  PatchedFile(const InputFile& file, std::vector<std::uint64_t> places);
  ~PatchedFile();

  PatchedFile(const PatchedFile&) = delete;
  PatchedFile& operator=(const PatchedFile&) = delete;

  /// FFmpeg's input, valid as long as this object.
  AVIOContext* GetContext() const { return this->Context; }

private:
  static int Read(void* self, std::uint8_t* bytes, int count);
  static std::int64_t Seek(void* self, std::int64_t offset, int whence);
  void Patch(std::uint64_t begin, std::uint8_t* bytes, std::uint64_t count) const;

  const InputFile& File;
  std::uint64_t Position = 0; ///< where FFmpeg reads next
  std::vector<std::uint64_t> Places;
  AVIOContext* Context = nullptr;
};

/// The packets of one group, in decoding order for each track of the header. Their times are the
/// frames' places in the group.
struct GroupPackets
{
  std::vector<std::vector<AVHandle<AVPacket>>> Tracks;
};

/// The reason why a file could not be opened. If there is not enough memory, this and all methods
/// that read throw std::bad_alloc instead.
struct OpenError
{
  unsigned long Code = 0; ///< one of vtkErrorCode's
  std::string Text;       ///< in one line
};

class ContainerReader
{
public:
  /// Reads the header only. Returns null on failure.
  static std::unique_ptr<ContainerReader> Open(const std::string& fileName, OpenError& failure);

  const FileHeader& GetHeader() const { return this->Header; }

  /// The decoder's parameters of a track.
  const AVCodecParameters* GetParameters(std::size_t track) const
  {
    return this->Parameters[track].get();
  }

  /// Whether somebody has written to the file since it was opened. If another file got its name,
  /// this one is still read.
  bool HasChanged() const { return this->File.HasChanged(); }

  /// Reads the packets of a group and whatever lies between them, at most some seconds of frames.
  /// Packets that are not found there are left out.
  GroupPackets Read(int group);

  /// The size of all packets of each track, in bytes, without the parts that they carry. Reads the
  /// whole file.
  std::vector<std::int64_t> CountBytes();

  /// Whether all packets of a group exist, with correct checksums and times in order. Several
  /// threads may call it at once, also while packets are read.
  bool IsWhole(int group, const GroupPackets& packets) const;

private:
  /// Where reading starts: some frames before a group or, if FFmpeg's index is reliable, at the
  /// first decoded frame.
  enum class Start
  {
    BeforeGroup,
    AtGroup
  };

  bool OpenContainer(OpenError& failure);
  bool ReadHeader(OpenError& failure);
  bool FindTracks(OpenError& failure);
  void ReadParts();
  void FindFirstTimes();
  bool ReadPacket(AVPacket* packet);
  bool SeekTo(int frame, Start start);
  GroupPackets ReadFrom(Start start, int group);
  bool IsTrackWhole(int group, std::size_t track, const GroupPackets& packets) const;
  int FindTrack(const AVPacket* packet) const;
  long long FindFrame(std::size_t track, const AVPacket* packet) const;

  std::string FileName;
  InputFile File;                       ///< the only one that is opened: it outlives the next two
  std::unique_ptr<PatchedFile> Patched; ///< without the file's impossible sizes
  AVInput Input;
  bool HasBrokenIndex = false;   ///< reading a packet may report a lack of memory falsely
  bool HasFailed = false;        ///< a packet could not be read
  std::int64_t CarriedBytes = 0; ///< that the first picture has for the parts in it
  FileHeader Header;
  std::vector<int> GroupStarts;
  std::vector<int> Streams; ///< of each track
  std::vector<AVHandle<AVCodecParameters>> Parameters;
  std::vector<Framing> Framings;
  std::vector<std::int64_t> FirstTimes; ///< of each track, empty until needed
};
}

#endif
