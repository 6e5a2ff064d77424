// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfImageFiles.h"

#ifndef CSLF_HAS_IMAGES
#include <vtksys/DynamicLoader.hxx>
#include <vtksys/SystemTools.hxx>
#ifdef _WIN32
#include <vtkResourceFileLocator.h>
#else
#include <dlfcn.h>
#endif
#endif

namespace cslf
{
#ifdef CSLF_HAS_IMAGES
const ImageLibrary* MakeImageLibrary();

namespace
{
const ImageLibrary* Load(std::string&)
{
  return MakeImageLibrary();
}
}
#else
namespace
{
using Loader = vtksys::DynamicLoader;

/// The file of the library that contains this function.
std::string FindOwnFile()
{
#ifdef _WIN32
  return vtkGetLibraryPathForSymbol(GetImageLibrary);
#else
  Dl_info own;
  return dladdr(reinterpret_cast<const void*>(&GetImageLibrary), &own) != 0 ? own.dli_fname : "";
#endif
}

/// Loads the library from the folder of CSLF's own. It is never unloaded.
const ImageLibrary* Load(std::string& error)
{
  const std::string file =
    vtksys::SystemTools::GetFilenamePath(FindOwnFile()) + "/" + CSLF_IMAGES_FILE;
  const Loader::LibraryHandle library = Loader::OpenLibrary(file);
  if (!library)
  {
    const char* reason = Loader::LastError();
    error = "The library for images cannot be loaded: " + std::string(reason ? reason : file);
    return nullptr;
  }
  using Maker = const ImageLibrary* (*)();
  const auto make = reinterpret_cast<Maker>(Loader::GetSymbolAddress(library, CSLF_IMAGES_SYMBOL));
  if (!make)
  {
    error = "The library for images, " + file + ", is not that of this version.";
    return nullptr;
  }
  return make();
}
}
#endif

const ImageLibrary* GetImageLibrary(std::string& error)
{
  static std::string reason;
  static const ImageLibrary* const library = Load(reason);
  error = reason;
  return library;
}

std::unique_ptr<ImageReader> OpenImage(const ImageSource& source, std::string& error)
{
  const ImageLibrary* library = GetImageLibrary(error);
  return library ? library->Open(source, error) : nullptr;
}
}
