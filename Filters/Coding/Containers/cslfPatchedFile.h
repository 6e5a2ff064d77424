// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file that FFmpeg reads with some numbers replaced by zeros.
 */
#ifndef cslfPatchedFile_h
#define cslfPatchedFile_h

#include "Coding/Codecs/cslfAV.h"

#include <cstdint>
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
}

#endif
