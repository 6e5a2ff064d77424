// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfUnfinishedFields.h"

#include "Files/cslfFileSystem.h"

#include "vtkCSLFDecoder.h"

#include <system_error>

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
constexpr const char* PartialExtension = ".partial";
constexpr const char* PreviewStem = "preview";

constexpr std::chrono::seconds UpdateInterval{ 2 };

bool Exists(const fs::path& path)
{
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// OUT for OUT.partial and files in it, or an empty path.
fs::path FindTarget(const fs::path& path)
{
  const fs::path folder = path.has_filename() ? path : path.parent_path();
  for (const fs::path& candidate : { folder, folder.parent_path() })
  {
    if (candidate.extension() == PartialExtension)
    {
      return candidate.parent_path() / candidate.stem();
    }
  }
  return {};
}

fs::path GetPreview(fs::path target)
{
  const fs::path extension = target.extension();
  target += PartialExtension;
  return (target / PreviewStem).replace_extension(extension);
}

fs::file_time_type GetTime(const std::string& fileName)
{
  std::error_code ignored;
  return fs::last_write_time(ToPath(fileName), ignored);
}
}

std::string LocateField(const std::string& name)
{
  const fs::path path = ToPath(name);
  const fs::path target = FindTarget(path);
  const fs::path preview = GetPreview(target.empty() ? path : target);
  if (target.empty())
  {
    return !Exists(path) && Exists(preview) ? ToName(preview) : name;
  }
  const bool isGone = !Exists(preview) && Exists(target);
  return isGone ? ToName(target) : Exists(preview) ? ToName(preview) : name;
}

bool IsBeingWritten(const std::string& name)
{
  fs::path partial = ToPath(name);
  partial += PartialExtension;
  return Exists(partial);
}

UnfinishedField::UnfinishedField(const std::string& name, vtkCSLFDecoder* decoder)
  : Name(name)
  , Decoder(decoder)
  , Written(decoder ? GetTime(decoder->GetFileName()) : fs::file_time_type())
{
}

bool UnfinishedField::Update()
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->Decoder || !this->Decoder->IsUnfinished() || now < this->Next)
  {
    return false;
  }
  this->Next = now + UpdateInterval;
  const std::string fileName = LocateField(this->Name);
  const fs::file_time_type written = GetTime(fileName);
  if (!Exists(ToPath(fileName)) || written == this->Written)
  {
    return false;
  }
  this->Written = written;
  this->Decoder->SetFileName(fileName.c_str());
  this->Decoder->Modified();
  return true;
}
}
