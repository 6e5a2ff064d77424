// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file or folder that appears whole under its name, by renaming, or not at all.
 */
#ifndef cslfWholeFile_h
#define cslfWholeFile_h

#include "Files/cslfWorkFolder.h"
#include "vtkCSLFModule.h" // for export macro

#include <string>

namespace cslf
{
/// Open, then write what GetTemporaryName names, then Publish. Where Open or Publish returns false,
/// `error` says why in one line. What was written but not published goes away.
class VTKCSLF_EXPORT WholeFile
{
public:
  explicit WholeFile(const std::string& name);
  ~WholeFile();

  /// Keeps other writers of this name out until this object ends.
  bool Open(std::string& error);

  /// The file to write, with the same extension.
  const std::string& GetTemporaryName() const { return this->Temporary; }

  /// Brings the file to the disk and puts it in the place of an earlier one. A warning tells what
  /// could not be cleared away.
  bool Publish(std::string& warning, std::string& error);

private:
  WorkFolder Work;
  std::string Temporary;
};

/// The same for a folder, which Open makes. An earlier folder is replaced only if it holds nothing
/// else than `list` tells.
class VTKCSLF_EXPORT WholeFolder
{
public:
  WholeFolder(const std::string& name, WorkFolder::Lister list);
  ~WholeFolder();

  /// `kind` is what the folder may hold, for messages.
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

/// Whether the disk has room for the bytes that a file or folder still takes, about. They may be
/// guessed: then so many as `least` are enough. Otherwise `error` says how many are missing.
VTKCSLF_EXPORT bool HasRoom(
  const std::string& fileName, double bytes, double least, std::string& error);

/// What to add to a message on a file that was not written: how little the disk has left, if that
/// is the likely reason.
VTKCSLF_EXPORT std::string DescribeShortage(const std::string& fileName);
}

#endif
