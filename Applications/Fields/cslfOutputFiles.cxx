// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOutputFiles.h"

#include "Files/cslfFileSystem.h"
#include "Files/cslfWorkFolder.h"
#include "vtkCSLFDecoder.h"

#include <vtkIdTypeArray.h>
#include <vtkNew.h>

#include <cstring>
#include <system_error>

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
constexpr std::chrono::seconds UpdateInterval{ 2 };

/// Showing more takes a moment, in which only the coarsest grid is shown. So one in this many
/// viewpoints must be new.
constexpr vtkIdType MinimumShare = 12;

bool IsFile(const std::string& name)
{
  std::error_code ignored;
  return fs::is_regular_file(ToPath(name), ignored);
}

bool Exists(const std::string& name)
{
  std::error_code ignored;
  return fs::exists(ToPath(name), ignored);
}

/// OUT, if that is the name of its OUT.partial.
std::string FindTarget(const std::string& folder)
{
  const std::string target = ToName(ToPath(folder).replace_extension());
  return GetWorkFolder(target) == folder ? target : std::string();
}

std::string GetPreview(const std::string& target)
{
  return GetWorkFolder(target) + "/" + GetPreviewName(target);
}

fs::file_time_type GetTime(const std::string& fileName)
{
  std::error_code ignored;
  return fs::last_write_time(ToPath(fileName), ignored);
}

vtkIdType CountUnwritten(vtkCSLFDecoder* decoder)
{
  vtkNew<vtkIdTypeArray> unwritten;
  decoder->GetUnwrittenViewpoints(unwritten);
  return unwritten->GetNumberOfValues();
}
}

std::string LocateField(const std::string& name)
{
  if (name.empty() || IsFile(name))
  {
    return name;
  }
  const std::string clean = ResolveTarget(name);
  if (!Exists(clean) && IsFile(GetPreview(clean)))
  {
    return GetPreview(clean);
  }
  const std::string target = FindTarget(clean);
  if (!target.empty() && (IsWorkFolder(clean) || !Exists(clean)))
  {
    const std::string preview = GetPreview(target);
    return IsFile(preview) ? preview : IsFile(target) ? target : name;
  }
  const std::string ofPreview = FindTarget(GetParent(clean));
  const bool isGone = !Exists(clean) && !ofPreview.empty() && GetPreview(ofPreview) == clean;
  return isGone && IsFile(ofPreview) ? ofPreview : name;
}

bool IsBeingWritten(const std::string& name)
{
  const std::string clean = ResolveTarget(name);
  return IsWorkFolder(clean) || IsWorkFolder(GetWorkFolder(clean));
}

UnfinishedField::UnfinishedField(const std::string& name, vtkCSLFDecoder* decoder)
  : Name(name)
  , Decoder(decoder)
  , IsFinished(!decoder || !decoder->IsUnfinished())
{
  if (!this->IsFinished)
  {
    this->Unwritten = CountUnwritten(decoder);
    this->Written = GetTime(decoder->GetFileName());
  }
}

bool UnfinishedField::Update()
{
  const auto now = std::chrono::steady_clock::now();
  if (this->IsFinished || now < this->Next)
  {
    return false;
  }
  this->Next = now + UpdateInterval;
  const std::string fileName = LocateField(this->Name);
  const fs::file_time_type written = GetTime(fileName);
  vtkNew<vtkCSLFDecoder> next;
  // While the finished file is being joined, there may be none.
  if (!IsFile(fileName) || written == this->Written || !next->CanReadFile(fileName.c_str()))
  {
    return false;
  }
  next->SetFileName(fileName.c_str());
  next->UpdateInformation();
  const vtkIdType unwritten = CountUnwritten(next);
  vtkNew<vtkIdTypeArray> all;
  next->GetViewpointsInFileOrder(all);
  const bool isSame = std::strcmp(next->GetDescription(), this->Decoder->GetDescription()) == 0;
  if (isSame && unwritten > 0 &&
    MinimumShare * (this->Unwritten - unwritten) < all->GetNumberOfValues())
  {
    return false;
  }
  // Another run may have written another field.
  this->IsFinished = !isSame || unwritten == 0;
  if (isSame)
  {
    this->Unwritten = unwritten;
    this->Written = written;
    this->Decoder->SetFileName(fileName.c_str());
    this->Decoder->Modified();
  }
  return isSame;
}
}
