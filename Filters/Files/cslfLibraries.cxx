// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfLibraries.h"

#if defined(__ELF__) && __has_include(<link.h>)
#define CSLF_HAS_BUILD_IDS
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <link.h>
#endif

namespace cslf
{
#ifdef CSLF_HAS_BUILD_IDS
namespace
{
struct Search
{
  const std::vector<std::string>& Names;
  std::map<std::string, std::string> Found;
};

bool Contains(const dl_phdr_info& library, const void* address)
{
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  const auto holds = [&](const ElfW(Phdr) & segment)
  {
    const std::uintptr_t begin = library.dlpi_addr + segment.p_vaddr;
    return segment.p_type == PT_LOAD && place >= begin && place < begin + segment.p_memsz;
  };
  return std::any_of(library.dlpi_phdr, library.dlpi_phdr + library.dlpi_phnum, holds);
}

/// The build ID in a segment of notes: each has three numbers, a name and its data, padded to whole
/// words.
std::string ReadBuildID(const char* notes, std::size_t size)
{
  const auto pad = [](std::size_t count) { return (count + 3) / 4 * 4; };
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;)
  {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes + at, sizeof(note));
    const std::size_t name = at + sizeof(note);
    const std::size_t data = name + pad(note.n_namesz);
    if (data + note.n_descsz > size)
    {
      break;
    }
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
      std::memcmp(notes + name, "GNU", 4) == 0)
    {
      std::string text;
      for (std::size_t k = 0; k < note.n_descsz; ++k)
      {
        const auto byte = static_cast<unsigned char>(notes[data + k]);
        text += "0123456789abcdef"[byte / 16];
        text += "0123456789abcdef"[byte % 16];
      }
      return text;
    }
    at = data + pad(note.n_descsz);
  }
  return {};
}

std::string FindBuildID(const dl_phdr_info& library)
{
  for (int k = 0; k < library.dlpi_phnum; ++k)
  {
    const ElfW(Phdr)& segment = library.dlpi_phdr[k];
    // The loader's addresses are integers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* notes = reinterpret_cast<const char*>(library.dlpi_addr + segment.p_vaddr);
    std::string found =
      segment.p_type == PT_NOTE ? ReadBuildID(notes, segment.p_memsz) : std::string();
    if (!found.empty())
    {
      return found;
    }
  }
  return {};
}

int Visit(dl_phdr_info* library, std::size_t, void* data)
{
  auto* search = static_cast<Search*>(data);
  // The program itself has an empty name.
  std::error_code ignored;
  const std::filesystem::path path(library->dlpi_name);
  const std::string file = std::filesystem::canonical(path, ignored).filename().string();
  const auto begins = [&](const std::string& name)
  { return path.filename().string().rfind(name + ".", 0) == 0; };
  if (Contains(*library, reinterpret_cast<const void*>(&FindLibraries)))
  {
    search->Found["cslf"] = FindBuildID(*library);
  }
  else if (std::any_of(search->Names.begin(), search->Names.end(), begins))
  {
    search->Found[file] = FindBuildID(*library);
  }
  return 0;
}
}

std::map<std::string, std::string> FindLibraries(const std::vector<std::string>& names)
{
  Search search{ names, {} };
  ::dl_iterate_phdr(Visit, &search);
  return search.Found;
}
#else
std::map<std::string, std::string> FindLibraries(const std::vector<std::string>&)
{
  return {};
}
#endif
}
