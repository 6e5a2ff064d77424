// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPatchedFile.h"

#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cstdio>
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
}
