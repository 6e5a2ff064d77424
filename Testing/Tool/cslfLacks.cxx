// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Loaded before all other libraries (LD_PRELOAD), this takes from a program what machines may lack:
//   CSLF_LACKS_DECODER=av1  FFmpeg's decoder of that codec;
//   CSLF_LACKS_MEMORY=n     memory, from the n-th allocation of 4 KiB or more on, counted since the
//                           first file was opened by FFmpeg, but not while libraries are loaded:
//                           what those of others do then cannot be guarded;
//   CSLF_LACKS_NAME=x       the free name x: a file gets it just before another would, if that is
//                           not to replace anything;
//   CSLF_LACKS_FLAGS=1      a file system whose files can be renamed without replacing others;
//   CSLF_LACKS_LINKS=1      one with hard links.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

namespace
{
constexpr std::size_t LargeBytes = 4096;

std::atomic<bool> IsCounting{ false };
std::atomic<long> Left{ 0 };
thread_local bool IsLoading = false;

/// Whether there is memory for so many bytes.
bool IsThere(std::size_t bytes)
{
  if (bytes < LargeBytes || !IsCounting || IsLoading || --Left > 0)
  {
    return true;
  }
  errno = ENOMEM;
  return false;
}

/// Makes the file that is in the way if that is the name.
void TakeName(const char* name)
{
  constexpr char text[] = "mine";
  const char* taken = std::getenv("CSLF_LACKS_NAME");
  const char* slash = std::strrchr(name, '/');
  if (taken && std::strcmp(slash ? slash + 1 : name, taken) == 0)
  {
    const int file = open(name, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (file >= 0)
    {
      (void)!write(file, text, sizeof(text) - 1);
      close(file);
    }
  }
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

  void* dlopen(const char* file, int mode)
  {
    static auto* const next = FindNext<void*(const char*, int)>("dlopen");
    IsLoading = true;
    void* library = next(file, mode);
    IsLoading = false;
    return library;
  }

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

  int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned int flags)
  {
    TakeName(to);
    if (std::getenv("CSLF_LACKS_FLAGS"))
    {
      errno = EINVAL;
      return -1;
    }
    using Rename = int(int, const char*, int, const char*, unsigned int);
    static auto* const next = FindNext<Rename>("renameat2");
    return next(fromFolder, from, toFolder, to, flags);
  }

  int link(const char* from, const char* to)
  {
    if (std::getenv("CSLF_LACKS_LINKS"))
    {
      errno = EPERM;
      return -1;
    }
    static auto* const next = FindNext<int(const char*, const char*)>("link");
    return next(from, to);
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
