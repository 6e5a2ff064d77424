// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loaded before all other libraries (LD_PRELOAD), this takes from a program what machines may lack:
//   CSLF_LACKS_DECODER=av1  FFmpeg's decoder of that codec;
//   CSLF_LACKS_MEMORY=n     memory, from the n-th allocation of 4 KiB or more on, counted since the
//                           first file was opened by FFmpeg.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

namespace
{
constexpr std::size_t LargeBytes = 4096;

std::atomic<bool> IsCounting{ false };
std::atomic<long> Left{ 0 };

/// Whether there is memory for so many bytes.
bool IsThere(std::size_t bytes)
{
  if (bytes < LargeBytes || !IsCounting || --Left > 0)
  {
    return true;
  }
  errno = ENOMEM;
  return false;
}

/// The function that this one stands for.
template <typename Function>
Function* FindNext(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
}

extern "C"
{
  void* __libc_malloc(std::size_t bytes);
  void* __libc_calloc(std::size_t count, std::size_t bytes);
  void* __libc_realloc(void* memory, std::size_t bytes);
  void* __libc_memalign(std::size_t alignment, std::size_t bytes);

  void* malloc(std::size_t bytes)
  {
    return IsThere(bytes) ? __libc_malloc(bytes) : nullptr;
  }

  void* calloc(std::size_t count, std::size_t bytes)
  {
    return IsThere(count * bytes) ? __libc_calloc(count, bytes) : nullptr;
  }

  void* realloc(void* memory, std::size_t bytes)
  {
    return IsThere(bytes) ? __libc_realloc(memory, bytes) : nullptr;
  }

  int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes)
  {
    *memory = IsThere(bytes) ? __libc_memalign(alignment, bytes) : nullptr;
    return *memory ? 0 : ENOMEM;
  }

  int avformat_open_input(void* context, const char* url, const void* format, void* options)
  {
    const char* count = std::getenv("CSLF_LACKS_MEMORY");
    if (count && !IsCounting)
    {
      Left = std::atol(count);
      IsCounting = true;
    }
    static auto* const next = FindNext<decltype(avformat_open_input)>("avformat_open_input");
    return next(context, url, format, options);
  }

  const void* avcodec_find_decoder(int codec)
  {
    static auto* const next = FindNext<decltype(avcodec_find_decoder)>("avcodec_find_decoder");
    static auto* const getName = FindNext<const char*(int)>("avcodec_get_name");
    const char* lacking = std::getenv("CSLF_LACKS_DECODER");
    return lacking && std::strcmp(getName(codec), lacking) == 0 ? nullptr : next(codec);
  }
}
