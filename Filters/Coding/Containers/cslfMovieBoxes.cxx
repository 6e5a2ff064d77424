// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMovieBoxes.h"

#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cslf
{
namespace
{
/// The depth to which FFmpeg reads.
constexpr int MaximumLevels = 10;

/// With a fragment for each frame, there are 7 boxes per frame.
constexpr int MaximumBoxes = 1 << 20;

/// The description of a track's samples contains some parameter sets.
constexpr std::uint64_t MaximumDescription = 1 << 20; // in bytes

/// Smaller files may announce this many samples.
constexpr std::uint64_t FewSamples = 65536;

/// FFmpeg joins up to this many samples of audio to one entry of its index.
constexpr std::uint64_t JoinedSamples = 1024;

struct Box
{
  std::string Type;
  std::uint64_t Begin = 0; ///< offset of its contents, in bytes
  std::uint64_t End = 0;

  std::uint64_t GetSize() const { return this->End - this->Begin; }

  /// Whether it has `count` entries of `entrySize` bytes from an offset on.
  bool Holds(std::uint64_t begin, std::uint64_t count, std::uint64_t entrySize) const
  {
    return begin <= this->GetSize() && count * entrySize <= this->GetSize() - begin;
  }
};

class BoxChecker
{
public:
  explicit BoxChecker(const InputFile& file)
    : File(file)
    , FileSize(file.GetSize())
    , MaximumSamples(std::max(this->FileSize, FewSamples))
  {
  }

  bool Check()
  {
    constexpr std::uint64_t matroska = 0x1a45dfa3;
    if (this->ReadNumber(0, 4) == matroska)
    {
      return true;
    }
    // If there is no movie, FFmpeg looks for one in free boxes.
    return this->CheckBoxes({ "", 0, this->FileSize }, 0) && this->HasMovie &&
      this->Samples <= this->MaximumSamples &&
      this->MaximumChunks * this->MaximumSamplesOfChunk <= this->MaximumSamples * JoinedSamples;
  }

  const std::vector<std::uint64_t>& GetBrokenSizes() const { return this->BrokenSizes; }

private:
  using Checker = bool (BoxChecker::*)(const Box& box, int level);

  /// The checks that apply to all boxes.
  static const std::map<std::string, Checker>& GetCheckers()
  {
    using Self = BoxChecker;
    static const std::map<std::string, Checker> checkers = { { "cmov", &Self::CheckCompressed },
      { "co64", &Self::CheckChunks }, { "ctts", &Self::CheckTable<8> },
      { "dinf", &Self::CheckContainer }, { "edts", &Self::CheckContainer },
      { "hoov", &Self::CheckContainer }, { "ilst", &Self::CheckContainer },
      { "jp2h", &Self::CheckContainer }, { "keys", &Self::CheckTable<8> },
      { "mdia", &Self::CheckContainer }, { "meta", &Self::CheckMetadata },
      { "minf", &Self::CheckContainer }, { "moof", &Self::CheckContainer },
      { "moov", &Self::CheckContainer }, { "mvex", &Self::CheckContainer },
      { "sbgp", &Self::CheckGroups }, { "schi", &Self::CheckContainer },
      { "sgpd", &Self::CheckGroupKinds }, { "sinf", &Self::CheckContainer },
      { "stbl", &Self::CheckContainer }, { "stco", &Self::CheckChunks },
      { "stps", &Self::CheckTable<4> }, { "stsc", &Self::CheckSamplesOfChunks },
      { "stsd", &Self::CheckDescriptions }, { "stss", &Self::CheckTable<4> },
      { "stsz", &Self::CheckSizes }, { "stts", &Self::CheckTable<8> },
      { "stz2", &Self::CheckSmallSizes }, { "traf", &Self::CheckContainer },
      { "trak", &Self::CheckContainer }, { "tref", &Self::CheckContainer },
      { "trun", &Self::CheckRun }, { "udta", &Self::CheckContainer },
      { "wave", &Self::CheckContainer } };
    return checkers;
  }

  /// The boxes within another one.
  bool CheckBoxes(const Box& parent, int level)
  {
    constexpr std::uint64_t headerSize = 8;
    for (std::uint64_t place = parent.Begin; parent.End - place >= headerSize;)
    {
      if (++this->Boxes > MaximumBoxes || level > MaximumLevels)
      {
        return false;
      }
      Box box{ this->ReadText(place + 4, 4), place + headerSize, parent.End };
      std::uint64_t size = this->ReadNumber(place, 4);
      if (size == 1)
      {
        size = this->ReadNumber(box.Begin, 8);
        box.Begin += 8;
      }
      const std::uint64_t rest = parent.End - place;
      if (size != 0 && size < box.Begin - place)
      {
        // Not a box: FFmpeg stops reading here.
        return level == 0;
      }
      // Less of it is in a truncated file.
      if ((size > rest && level > 0) || box.Begin > parent.End)
      {
        return false;
      }
      place += size == 0 ? rest : std::min(size, rest);
      box.End = place;
      const auto checker = GetCheckers().find(box.Type);
      this->HasMovie = this->HasMovie || (level == 0 && box.Type == "moov");
      if (checker != GetCheckers().end() && !(this->*checker->second)(box, level))
      {
        return false;
      }
    }
    return true;
  }

  bool CheckContainer(const Box& box, int level) { return this->CheckBoxes(box, level + 1); }

  /// Only QuickTime has compressed movies.
  bool CheckCompressed(const Box&, int) { return false; }

  /// A version, a number of entries, and the entries.
  template <int EntrySize>
  bool CheckTable(const Box& box, int)
  {
    return box.Holds(8, this->ReadNumber(box.Begin + 4, 4), EntrySize);
  }

  bool CheckChunks(const Box& box, int level)
  {
    this->MaximumChunks = std::max(this->MaximumChunks, this->ReadNumber(box.Begin + 4, 4));
    return box.Type == "stco" ? this->CheckTable<4>(box, level) : this->CheckTable<8>(box, level);
  }

  bool CheckSamplesOfChunks(const Box& box, int level)
  {
    const bool holds = this->CheckTable<12>(box, level);
    const std::string text = holds ? this->ReadText(box.Begin, box.GetSize()) : "";
    for (std::size_t place = 12; place + 8 <= text.size(); place += 12)
    {
      this->MaximumSamplesOfChunk =
        std::max(this->MaximumSamplesOfChunk, Decode(text.substr(place, 4)));
    }
    return holds;
  }

  /// Boxes after one called "hdlr", which may have a version before it.
  bool CheckMetadata(const Box& box, int level)
  {
    std::size_t place = 4;
    {
      const std::string text = this->ReadText(box.Begin, box.GetSize());
      while (place + 4 <= text.size() && text.compare(place, 4, "hdlr") != 0)
      {
        place += 4;
      }
    }
    return place + 4 > box.GetSize() ||
      this->CheckBoxes({ box.Type, box.Begin + place - 4, box.End }, level + 1);
  }

  /// FFmpeg reads boxes after a description, whose length depends on its kind. There are no
  /// tables among them.
  bool CheckDescriptions(const Box& box, int)
  {
    if (box.GetSize() > MaximumDescription || !box.Holds(8, 1, 8))
    {
      return false;
    }
    const std::string text = this->ReadText(box.Begin, box.GetSize());
    const bool isOne =
      Decode(text.substr(4, 4)) == 1 && Decode(text.substr(8, 4)) <= text.size() - 8;
    const auto isWithin = [&text](const auto& checker)
    {
      return checker.second != &BoxChecker::CheckContainer &&
        checker.second != &BoxChecker::CheckMetadata &&
        text.find(checker.first) != std::string::npos;
    };
    return isOne && std::none_of(GetCheckers().begin(), GetCheckers().end(), isWithin);
  }

  /// The size of all samples, or of each one.
  bool CheckSizes(const Box& box, int)
  {
    const std::uint64_t count = this->ReadNumber(box.Begin + 8, 4);
    const bool isOfAll = this->ReadNumber(box.Begin + 4, 4) > 0;
    this->Samples += isOfAll ? count : 0;
    const bool holds = box.Holds(12, count, isOfAll ? 0 : 4);
    const std::string text = holds && !isOfAll ? this->ReadText(box.Begin, box.GetSize()) : "";
    for (std::size_t place = 12; place + 4 <= text.size(); place += 4)
    {
      if (Decode(text.substr(place, 4)) > this->FileSize)
      {
        this->BrokenSizes.push_back(box.Begin + place);
      }
    }
    return holds;
  }

  /// The size of each sample in a few bits.
  bool CheckSmallSizes(const Box& box, int)
  {
    const std::uint64_t bits = this->ReadNumber(box.Begin + 7, 1);
    return box.Holds(12, this->ReadNumber(box.Begin + 8, 4) * bits / 8, 1);
  }

  /// The number of samples of each group.
  bool CheckGroups(const Box& box, int)
  {
    const std::uint64_t countAt = this->ReadNumber(box.Begin, 1) == 1 ? 12 : 8;
    const std::uint64_t count = this->ReadNumber(box.Begin + countAt, 4);
    const bool holds = box.Holds(countAt + 4, count, 8);
    const std::string text = holds ? this->ReadText(box.Begin, box.GetSize()) : "";
    for (std::uint64_t k = 0; holds && k < count; ++k)
    {
      this->Samples += Decode(text.substr(static_cast<std::size_t>(countAt + 4 + 8 * k), 4));
    }
    return holds;
  }

  /// The kinds of groups; FFmpeg knows one of them.
  bool CheckGroupKinds(const Box& box, int)
  {
    const std::uint64_t countAt =
      8 + 4 * std::min<std::uint64_t>(this->ReadNumber(box.Begin, 1), 2);
    return this->ReadText(box.Begin + 4, 4) != "sync" ||
      box.Holds(countAt + 4, this->ReadNumber(box.Begin + countAt, 4), 1);
  }

  /// The samples of a fragment, each with up to four numbers.
  bool CheckRun(const Box& box, int)
  {
    std::uint64_t entrySize = 0;
    for (std::uint64_t flags = this->ReadNumber(box.Begin + 2, 1) & 0xf; flags != 0; flags >>= 1)
    {
      entrySize += 4 * (flags & 1);
    }
    const std::uint64_t count = this->ReadNumber(box.Begin + 4, 4);
    this->Samples += count;
    return box.Holds(8, count, entrySize);
  }

  /// Bytes after the end count as zeros.
  std::string ReadText(std::uint64_t place, std::uint64_t size)
  {
    std::string text(static_cast<std::size_t>(size), '\0');
    this->File.Read(place, text.data(), text.size());
    return text;
  }

  std::uint64_t ReadNumber(std::uint64_t place, std::uint64_t size)
  {
    return Decode(this->ReadText(place, size));
  }

  /// A number of some bytes, in big-endian order.
  static std::uint64_t Decode(const std::string& bytes)
  {
    std::uint64_t number = 0;
    for (const char byte : bytes)
    {
      number = number << 8 | static_cast<unsigned char>(byte);
    }
    return number;
  }

  const InputFile& File;
  const std::uint64_t FileSize;       ///< in bytes
  const std::uint64_t MaximumSamples; ///< one per byte
  std::uint64_t Samples = 0;          ///< announced without an entry for each
  std::uint64_t MaximumChunks = 0;    ///< of any track
  std::uint64_t MaximumSamplesOfChunk = 0;
  std::vector<std::uint64_t> BrokenSizes;
  int Boxes = 0;
  bool HasMovie = false;
};
}

bool CanHoldMovieBoxes(const InputFile& file, std::vector<std::uint64_t>& brokenSizes)
{
  BoxChecker checker(file);
  const bool canHold = checker.Check();
  brokenSizes = checker.GetBrokenSizes();
  return canHold;
}
}
