// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file or folder that appears complete under its name, by renaming, or not at all.
 */
#ifndef cslfAtomicFile_h
#define cslfAtomicFile_h

#include "Files/cslfWorkFolder.h"
#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
/// Call Open, write to GetTemporaryName, and call Publish. If Open or Publish returns false,
/// `error` gives the reason in one line. What was not published is removed.
class VTKCSLF_EXPORT AtomicFile
{
public:
  explicit AtomicFile(const std::string& name);
  ~AtomicFile();

  /// Locks this name against other writers until this object is destroyed.
  bool Open(std::string& error);

  /// The file to write, with the same extension.
  const std::string& GetTemporaryName() const { return this->Temporary; }

  /// Flushes the file to the disk and replaces an earlier one, whose permissions it gets, or fails
  /// if there is one and `replaces` is not set. A warning says what could not be removed.
  bool Publish(std::string& warning, std::string& error, bool replaces = true);

private:
  WorkFolder Work;
  std::string Temporary;
};

/// The same for a folder, which Open makes. An earlier folder is replaced only if it contains
/// nothing but the files that `list` returns.
class VTKCSLF_EXPORT AtomicFolder
{
public:
  AtomicFolder(const std::string& name, WorkFolder::Lister list);
  ~AtomicFolder();

  /// `kind` describes the folder's contents in messages.
  bool Open(const std::string& kind, std::string& error);
  const std::string& GetTemporaryName() const { return this->Temporary; }
  bool Publish(std::string& warning, std::string& error);

private:
  bool IsReplaceable(std::string& error) const;

  WorkFolder::Lister List;
  WorkFolder Work;
  std::string Kind;
  std::string Temporary;
};

/// Whether the disk has enough space for the bytes that a file or folder still needs. If this is an
/// estimate, `least` bytes are enough. If not, `error` says how many are missing.
VTKCSLF_EXPORT bool HasRoom(
  const std::string& fileName, double bytes, double least, std::string& error);

/// An addition to the message on a file that could not be written: the free space, if a full disk
/// is the likely reason.
VTKCSLF_EXPORT std::string DescribeShortage(const std::string& fileName);
}

#endif
