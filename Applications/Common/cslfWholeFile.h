// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files that appear whole or not at all.
 */
#ifndef cslfWholeFile_h
#define cslfWholeFile_h

#include "cslfMessages.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace cslf
{
namespace tool
{
/// Writes with one of VTK's writers beside the file, which is then renamed. Throws a Failure.
template <typename Writer>
void WriteWhole(Writer* writer, const std::string& fileName)
{
  const std::string temporary = fileName + ".partial";
  writer->SetFileName(temporary.c_str());
  writer->Write();
  std::error_code failure;
  if (writer->GetErrorCode() == 0 && GetFirstError().empty())
  {
    std::filesystem::rename(temporary, fileName, failure);
    if (!failure)
    {
      return;
    }
  }
  std::filesystem::remove(temporary, failure);
  throw Failure("Cannot write " + fileName + ".");
}

/// Writes text likewise.
inline void WriteWholeText(const std::string& text, const std::string& fileName)
{
  const std::string temporary = fileName + ".partial";
  std::ofstream stream(temporary, std::ios::binary);
  stream << text;
  stream.close();
  std::error_code failure;
  if (stream)
  {
    std::filesystem::rename(temporary, fileName, failure);
  }
  if (!stream || failure)
  {
    std::filesystem::remove(temporary, failure);
    throw Failure("Cannot write " + fileName + ".");
  }
}
}
}

#endif
