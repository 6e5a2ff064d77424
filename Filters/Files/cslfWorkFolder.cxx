// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfWorkFolder.h"

#include "Files/cslfFileSystem.h"
#include "cslfFileSystem.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>
#include <utility>

namespace cslf
{
namespace
{
/// The contents that mark the file.
constexpr const char MarkText[] = "CSLF: a light field is being written here.\n";

constexpr const char* HolderSuffix = ".held";
}

FileLock::~FileLock()
{
  this->Release();
}

void FileLock::Release()
{
  this->RemoveHolder();
  this->File.Close();
}

void FileLock::RemoveHolder()
{
  if (!this->Holder.empty())
  {
    RemoveFile(this->Holder);
    this->Holder.clear();
  }
}

FileLock::Outcome FileLock::Acquire(const std::string& fileName, std::string& error)
{
  this->FileName = fileName;
  const LockedFile::Outcome opened = this->File.Open(fileName, error);
  Outcome outcome = Outcome::Busy;
  if (opened == LockedFile::Outcome::Removed)
  {
    outcome = Outcome::Removed;
  }
  else if (opened == LockedFile::Outcome::Locked ||
    (opened == LockedFile::Outcome::Unsupported && this->HoldByFile(error)))
  {
    outcome = this->ReadMark();
  }
  if (outcome != Outcome::Locked)
  {
    this->Release();
  }
  return outcome;
}

FileLock::Outcome FileLock::ReadMark()
{
  if (!this->File.IsNamed())
  {
    return Outcome::Removed;
  }
  char text[sizeof(MarkText)] = {};
  std::size_t count = 0;
  const bool isRead = this->File.Read(text, sizeof(text), count);
  this->Marked = count == std::strlen(MarkText) && std::strcmp(text, MarkText) == 0;
  // A process that was killed, or that found the disk full, may have written only the start of the
  // mark.
  const bool isBegun = isRead && std::strncmp(text, MarkText, count) == 0;
  return this->Marked || isBegun ? Outcome::Locked : Outcome::Foreign;
}

bool FileLock::HoldByFile(std::string& error)
{
  const std::string holder = this->FileName + HolderSuffix;
  const std::string text = DescribeProcess();
  if (MakeFile(holder, text.data(), text.size(), error))
  {
    this->Holder = holder;
    return true;
  }
  std::ifstream file(ToPath(holder));
  if (file)
  {
    const std::string other{ std::istreambuf_iterator<char>(file), {} };
    error = "another process is writing it: " + other + " holds " + holder +
      ". This file system does not show whether that process is still running. If it is not, "
      "remove " +
      holder + " and run again";
  }
  return false;
}

bool FileLock::Mark(std::string& error)
{
  this->Marked = this->Marked || this->File.Write(MarkText, std::strlen(MarkText), error);
  return this->Marked;
}

void FileLock::Remove()
{
  if (this->File.IsOpen() && (this->File.IsCreated() || this->Marked))
  {
    this->File.Remove();
  }
  this->RemoveHolder();
}

namespace
{
namespace fs = std::filesystem;

constexpr const char* LockName = "cslf.lock";
constexpr const char* ScratchPrefix = "unfinished-";

/// An earlier folder to be removed, if it could not be exchanged with the new one in one step.
constexpr const char* ReplacedName = "replaced";

/// How often a new run tries again when an ending run removes the folder.
constexpr int LockAttempts = 100;

bool Exists(const std::string& name)
{
  std::error_code ignored;
  return fs::exists(fs::symlink_status(ToPath(name), ignored));
}

bool IsScratch(const std::string& name)
{
  static const std::regex pattern(std::string(ScratchPrefix) + "[A-Za-z0-9]{6}");
  return std::regex_match(name, pattern);
}
}

std::string GetWorkFolder(const std::string& target)
{
  return target + ".partial";
}

std::string GetPreviewName(const std::string& target)
{
  return "preview" + ToName(ToPath(target).extension());
}

bool IsWorkFolder(const std::string& folder)
{
  return IsRealFolder(folder) && Exists(folder + "/" + LockName);
}

std::string ResolveTarget(const std::string& name)
{
  const fs::path path = ToPath(name).lexically_normal();
  const fs::path target = path.has_filename() ? path : path.parent_path();
  std::error_code failure;
  const fs::path linked = fs::is_symlink(target, failure) ? fs::canonical(target, failure) : target;
  return ToName(failure ? target : linked);
}

WorkFolder::WorkFolder(const std::string& target, NameTest isOurs, Lister list)
  : Target(ResolveTarget(target))
  , Folder(GetWorkFolder(this->Target))
  , IsOurs(std::move(isOurs))
  , List(std::move(list))
{
}

WorkFolder::~WorkFolder()
{
  if (this->IsLocked)
  {
    this->ClearScratch(this->Scratch);
    if (this->FindKept().empty())
    {
      this->RemoveAll();
    }
  }
}

bool WorkFolder::Reserve(std::string& error)
{
  if (this->IsReserved())
  {
    return true;
  }
  if (!this->List && !IsReplaceableByFile(this->Target, error))
  {
    return false;
  }
  if (!this->IsLocked && !this->Lock(error))
  {
    return false;
  }
  if (this->Known)
  {
    this->ClearDead();
  }
  std::string scratch;
  if (!MakeUniqueFolder(
        this->GetName(ScratchPrefix), GetFolderAccess(this->Target), scratch, error))
  {
    return false;
  }
  this->Scratch = scratch;
  return true;
}

bool WorkFolder::Lock(std::string& error)
{
  for (int attempt = 0; attempt < LockAttempts; ++attempt)
  {
    const bool isMade = MakeFolder(this->Folder, error, GetFolderAccess(this->Target));
    if (!isMade && error.empty() && !IsRealFolder(this->Folder))
    {
      error = "cannot make the folder " + this->Folder + ": something else has that name";
    }
    if (!error.empty())
    {
      return false;
    }
    const FileLock::Outcome outcome = this->Holder.Acquire(this->GetName(LockName), error);
    if (outcome == FileLock::Outcome::Removed && error.empty())
    {
      continue;
    }
    if (this->Claim(outcome, error))
    {
      return true;
    }
    this->Holder.Remove();
    if (isMade)
    {
      RemoveEmptyFolder(this->Folder);
    }
    return false;
  }
  error = "the folder " + this->Folder + " is repeatedly removed by another process";
  return false;
}

bool WorkFolder::Claim(FileLock::Outcome outcome, std::string& error)
{
  if (!error.empty())
  {
    return false;
  }
  if (outcome == FileLock::Outcome::Busy)
  {
    error = "another process is writing it (it holds " + this->GetName(LockName) + ")";
    return false;
  }
  if (outcome == FileLock::Outcome::Foreign)
  {
    error = this->GetName(LockName) + " was not made by CSLF: move the folder elsewhere";
    return false;
  }
  const bool isKnown = this->Holder.IsMarked();
  const std::vector<std::string> kept = this->FindKept();
  if (!isKnown && !kept.empty())
  {
    error = "the folder " + this->Folder + " was not left by an interrupted run, but contains " +
      kept.front() + ": move it elsewhere";
    return false;
  }
  if (!this->Holder.Mark(error))
  {
    return false;
  }
  this->Known = isKnown;
  this->IsLocked = true;
  return true;
}

bool WorkFolder::Write(
  const std::string& name, const void* bytes, std::size_t count, std::string& error) const
{
  const std::string scratch = this->GetScratchName(name);
  return MakeFile(scratch, bytes, count, error) && Rename(scratch, this->GetName(name), error);
}

std::vector<std::string> WorkFolder::FindKept() const
{
  std::vector<std::string> names = ListFolder(this->Folder);
  names.erase(std::remove_if(names.begin(), names.end(),
                [this](const std::string& name) { return !this->IsOurs(name); }),
    names.end());
  return names;
}

void WorkFolder::Remove(const std::string& name) const
{
  RemoveFile(this->GetName(name));
}

bool WorkFolder::PublishFolder(const std::string& name, std::string& error) const
{
  const std::string made = this->GetScratchName(name);
  const std::string replaced = this->GetScratchName(ReplacedName);
  if (!SyncTree(made, error))
  {
    return false;
  }
  for (const std::string& file : this->List(made))
  {
    CopyAccess(this->Target + "/" + file, made + "/" + file);
  }
  CopyAccess(this->Target, made);
  bool isPublished = Exists(this->Target) && ExchangeFolders(made, this->Target, error);
  if (!isPublished && error.empty())
  {
    isPublished = (!Exists(this->Target) || Rename(this->Target, replaced, error)) &&
      Rename(made, this->Target, error);
    std::string ignored;
    if (!isPublished && Exists(replaced) && !Exists(this->Target))
    {
      Rename(replaced, this->Target, ignored);
    }
  }
  if (!isPublished || !SyncFolder(GetParent(this->Target), error))
  {
    return false;
  }
  this->ClearFolder(made);
  this->ClearFolder(replaced);
  return true;
}

void WorkFolder::ClearDead() const
{
  for (const std::string& name : ListFolder(this->Folder))
  {
    const std::string scratch = this->GetName(name);
    if (!IsScratch(name) || !IsRealFolder(scratch))
    {
      continue;
    }
    // The run was killed between the two steps that replace an earlier folder.
    const std::string replaced = scratch + "/" + ReplacedName;
    std::string ignored;
    if (this->List && IsRealFolder(replaced) && !Exists(this->Target))
    {
      Rename(replaced, this->Target, ignored);
    }
    this->ClearScratch(scratch);
  }
}

void WorkFolder::ClearScratch(const std::string& scratch) const
{
  if (scratch.empty())
  {
    return;
  }
  for (const std::string& name : ListFolder(scratch))
  {
    const std::string file = scratch + "/" + name;
    if (this->List && IsRealFolder(file))
    {
      this->ClearFolder(file);
    }
    else if (this->IsOurs(name) || ToName(ToPath(this->Target).filename()) == name)
    {
      RemoveFile(file);
    }
  }
  RemoveEmptyFolder(scratch);
}

void WorkFolder::ClearFolder(const std::string& folder) const
{
  if (IsRealFolder(folder))
  {
    for (const std::string& name : this->List(folder))
    {
      RemoveFile(folder + "/" + name);
    }
    RemoveEmptyFolder(folder);
  }
}

void WorkFolder::Close(std::string& warning)
{
  this->ClearScratch(this->Scratch);
  for (const std::string& name : this->FindKept())
  {
    this->Remove(name);
  }
  this->RemoveAll();
  const std::vector<std::string> others = ListFolder(this->Folder);
  if (!others.empty())
  {
    warning =
      this->Folder + " was not removed, because it contains other files: " + others.front() + ".";
  }
}

void WorkFolder::RemoveAll()
{
  // The lock is removed last: while its file exists, nobody else touches the folder. An empty
  // folder counts as that of a run that was killed before it marked the folder.
  this->Holder.Remove();
  RemoveEmptyFolder(this->Folder);
  this->IsLocked = false;
  this->Scratch.clear();
}
}
