// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Common functions of the programs for libFuzzer.
 */
#ifndef cslfFuzzing_h
#define cslfFuzzing_h

#include <vtkLogger.h>
#include <vtkObject.h>
#include <vtkSMPTools.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace cslf
{
namespace fuzzing
{
/// A folder of this process, in memory if possible, removed at the end.
class Folder
{
public:
  Folder()
    : Path((std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                : std::filesystem::temp_directory_path()) /
        ("cslf-fuzz-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directory(this->Path);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkObject::GlobalWarningDisplayOff();
    vtkSMPTools::Initialize(1);
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string GetName(const std::string& file) const { return (this->Path / file).string(); }
  std::string GetName() const { return this->Path.string(); }

  std::string Write(const std::string& file, const std::uint8_t* data, std::size_t size) const
  {
    std::ofstream stream(this->Path / file, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return this->GetName(file);
  }

  static const Folder& Get()
  {
    static const Folder folder;
    return folder;
  }

private:
  std::filesystem::path Path;
};

/// Ends the process if a condition is false.
inline void Require(bool condition)
{
  if (!condition)
  {
    std::abort();
  }
}
}
}

#endif
