// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the operating system does for files that must survive a crash. The folders POSIX and Windows
 * hold what differs between systems. All names are UTF-8 on Windows, and the file system's own
 * bytes elsewhere. Where a function returns false, `error` says why in one line without a full
 * stop.
 */
#ifndef cslfFileSystem_h
#define cslfFileSystem_h

#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace cslf
{
///@{
/// Converts between the names that VTK uses and the standard library's paths.
VTKCSLF_EXPORT std::filesystem::path ToPath(const std::string& name);
VTKCSLF_EXPORT std::string ToName(const std::filesystem::path& path);
///@}

/// Makes a folder. False without an error where the name is taken already.
bool MakeFolder(const std::string& name, std::string& error);

/// Makes a folder whose name is the prefix and six characters more, which nobody else has.
bool MakeUniqueFolder(const std::string& prefix, std::string& name, std::string& error);

/// Makes a file, which must not be there, with these bytes. Leaves nothing of it where that fails.
VTKCSLF_EXPORT bool MakeFile(
  const std::string& name, const void* bytes, std::size_t count, std::string& error);

///@{
/// Removes a name: of a file or link, or of an empty folder. False where that fails.
bool RemoveFile(const std::string& name);
bool RemoveEmptyFolder(const std::string& name);
///@}

/// The names in a folder, sorted; empty where it cannot be read.
std::vector<std::string> ListFolder(const std::string& name);

/// Whether there is a folder of that name that is no link.
bool IsRealFolder(const std::string& name);

/// Whether a file can take the place of what has that name: another file, or nothing. A device or a
/// pipe would be gone. Otherwise says why.
VTKCSLF_EXPORT bool IsReplaceableByFile(const std::string& name, std::string& error);

/// Renames, on one file system, over what has the second name if that is a file.
bool Rename(const std::string& from, const std::string& to, std::string& error);

/// Gives two folders each other's name at once. False without an error where the file system
/// cannot do that.
bool ExchangeFolders(const std::string& one, const std::string& other, std::string& error);

///@{
/// Waits until a file's bytes, a folder's names, or a folder with all files in it are on the disk.
bool SyncFile(const std::string& name, std::string& error);
bool SyncFolder(const std::string& name, std::string& error);
bool SyncTree(const std::string& name, std::string& error);
///@}

/// Brings a finished file to the disk, gives it its name, and brings that to the disk: after a
/// crash there is the old file or the whole new one.
bool PublishFile(const std::string& from, const std::string& to, std::string& error);

/// Whether files can be made in a folder.
VTKCSLF_EXPORT bool IsWritableFolder(const std::string& name, std::string& error);

/// The bytes that may still be written where a file or folder lies, or will lie; infinite where
/// that cannot be told.
double GetFreeBytes(const std::string& name);

/// A number of bytes for people.
std::string DescribeBytes(double bytes);

/// "this process on this computer", to be recognised by people.
std::string DescribeProcess();

/// The folder that a name lies in.
VTKCSLF_EXPORT std::string GetParent(const std::string& name);
}

#endif
