// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The tool's files, which appear complete or not at all, and light fields that are still being
 * written: their previews, see vtkCSLFEncoder. Errors are thrown as a Failure.
 */
#ifndef cslfOutputFiles_h
#define cslfOutputFiles_h

#include "Console/cslfMessages.h"
#include "Files/cslfAtomicFile.h"
#include "Files/cslfFileSystem.h"
#include "Files/cslfWorkFolder.h"

#include <vtkType.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

class vtkCSLFDecoder;

namespace cslf::tool
{
/// The file or folder to read for a name given by the user: for OUT that does not exist, its
/// preview in OUT.partial; for that folder or its preview, OUT as soon as they are gone.
std::string LocateField(const std::string& name);

/// Whether the name is that of an OUT, or its OUT.partial, whose writing has begun but is not
/// finished.
bool IsBeingWritten(const std::string& name);

/// Lets a decoder read an unfinished field anew whenever there is more of it.
class UnfinishedField
{
public:
  /// `name` is the name given by the user, which the decoder reads. Null if it reads no video.
  UnfinishedField(const std::string& name, vtkCSLFDecoder* decoder);

  /// Whether the decoder has changed. Does nothing if the last call was a moment ago.
  bool Update();

private:
  std::string Name;
  vtkCSLFDecoder* Decoder;
  bool IsFinished;
  vtkIdType Unwritten = 0; ///< viewpoints
  std::filesystem::file_time_type Written;
  std::chrono::steady_clock::time_point Next;
};

/// The reason may be empty.
[[noreturn]] inline void FailWriting(const std::string& fileName, const std::string& reason)
{
  const bool isSentence = !reason.empty() && reason.back() == '.';
  throw Failure("Cannot write " + fileName + (reason.empty() ? "" : ": " + reason) +
    DescribeShortage(fileName) + (isSentence ? "" : "."));
}

/// Throws a Failure if writing the output would replace the input, or what it is made of while it
/// is unfinished.
inline void RequireOther(const std::string& input, const std::string& output)
{
  std::error_code failure;
  const std::string folder = GetParent(LocateField(input));
  if (std::filesystem::equivalent(ToPath(input), ToPath(output), failure) ||
    std::filesystem::equivalent(
      ToPath(folder), ToPath(GetWorkFolder(ResolveTarget(output))), failure))
  {
    throw Failure("The input and the output are the same.");
  }
}

/// Gives a finished AtomicFile or AtomicFolder its name, with arguments of their Publish.
template <typename Whole, typename... Arguments>
void PublishWhole(Whole& whole, const std::string& name, Arguments... arguments)
{
  std::string warning;
  std::string error;
  if (!whole.Publish(warning, error, arguments...))
  {
    FailWriting(name, error);
  }
  if (!warning.empty())
  {
    AddWarning(warning);
  }
}

/// One file. Other processes that want to write it fail while this object exists.
class OutputFile
{
public:
  explicit OutputFile(const std::string& fileName)
    : FileName(fileName)
    , Whole(fileName)
  {
    std::string error;
    if (!this->Whole.Open(error))
    {
      FailWriting(fileName, error);
    }
  }

  const std::string& GetName() const { return this->FileName; }

  /// The name of the temporary file.
  const std::string& GetTemporaryName() const { return this->Whole.GetTemporaryName(); }

  /// Unless it `replaces`, it throws a Failure if there is something of that name.
  void Publish(bool replaces = true) { PublishWhole(this->Whole, this->FileName, replaces); }

private:
  std::string FileName;
  AtomicFile Whole;
};

/// An addition to a message if the disk is the reason, by the system's error number.
inline std::string DescribeDisk(int code)
{
  const bool isDisk =
    code == ENOSPC || code == EDQUOT || code == EFBIG || code == EIO || code == EROFS;
  return isDisk ? " " + std::generic_category().message(code) : "";
}

/// Writes the temporary file with one of VTK's writers, which is set up except for its file name.
/// If the writer does not notice all disk errors, `isWhole` checks the file.
template <typename Writer>
void WriteTemporary(
  Writer* writer, OutputFile& file,
  const std::function<bool(const std::string&)>& isWhole = [](const std::string&) { return true; })
{
  writer->SetFileName(file.GetTemporaryName().c_str());
  errno = 0;
  writer->Write();
  const std::string disk = DescribeDisk(errno);
  if (writer->GetErrorCode() != 0 || !GetFirstError().empty() || !isWhole(file.GetTemporaryName()))
  {
    FailWriting(file.GetName(), GetFirstError() + disk);
  }
}

template <typename Writer>
void WriteWhole(Writer* writer, const std::string& fileName)
{
  OutputFile file(fileName);
  WriteTemporary(writer, file);
  file.Publish();
}

/// Writes bytes likewise.
inline void WriteWholeBytes(
  const void* bytes, std::size_t count, const std::string& fileName, bool replaces = true)
{
  OutputFile file(fileName);
  std::string error;
  if (!MakeFile(file.GetTemporaryName(), bytes, count, error))
  {
    FailWriting(fileName, error);
  }
  file.Publish(replaces);
}

inline void WriteWholeText(const std::string& text, const std::string& fileName)
{
  WriteWholeBytes(text.data(), text.size(), fileName);
}
}

#endif
