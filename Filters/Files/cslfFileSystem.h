// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Operating system functions for files that must survive a crash. The folders POSIX and Windows
 * contain the implementations. All names are UTF-8 on Windows, and the file system's bytes
 * elsewhere. If a function returns false, `error` gives the reason in one line without a full stop.
 */
#ifndef cslfFileSystem_h
#define cslfFileSystem_h

#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <cstdint>
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

/// Who may use a new folder, as POSIX permissions. The system removes those of the process's umask.
/// Windows gives folders the permissions of their parents instead.
constexpr unsigned int ForEveryone = 0777;
constexpr unsigned int ForOwner = 0700;

/// Makes a folder. False without an error if the name exists already.
bool MakeFolder(const std::string& name, std::string& error, unsigned int access = ForEveryone);

/// Makes a folder with a unique name: the prefix and six more characters.
bool MakeUniqueFolder(
  const std::string& prefix, unsigned int access, std::string& name, std::string& error);

/// Who may use a folder in which the new contents of a file or folder are made: those who may read
/// the earlier one, or everyone if there is none.
unsigned int GetFolderAccess(const std::string& name);

/// Gives a new file or folder the permissions, the owner, the access control list and the user's
/// attributes of an earlier one that it is going to replace. What the system does not allow stays
/// as it is, which is no error. Does nothing if there is no earlier one.
void CopyAccess(const std::string& earlier, const std::string& made);

/// Makes a file, which must not exist, with these bytes. Leaves nothing behind on failure.
VTKCSLF_EXPORT bool MakeFile(
  const std::string& name, const void* bytes, std::size_t count, std::string& error);

///@{
/// Removes a file, a link or an empty folder. False on failure.
bool RemoveFile(const std::string& name);
bool RemoveEmptyFolder(const std::string& name);
///@}

/// The names in a folder, sorted. Empty if it cannot be read.
std::vector<std::string> ListFolder(const std::string& name);

/// Whether there is a folder of that name that is not a link.
bool IsRealFolder(const std::string& name);

/// Whether a file can be renamed to that name: it is free or that of a file. A device or a pipe
/// would be lost. If not, gives the reason.
VTKCSLF_EXPORT bool IsReplaceableByFile(const std::string& name, std::string& error);

/// Renames within one file system, and replaces the second name if that is a file.
bool Rename(const std::string& from, const std::string& to, std::string& error);

/// The error if a name was free at first.
constexpr const char* NameIsTaken =
  "a file of that name has appeared meanwhile; move it elsewhere, or overwrite it";

/// Like Rename, but fails if the second name is taken. That is one step, so nothing is replaced
/// that appears meanwhile, except on file systems that have neither such steps nor hard links.
bool RenameToFree(const std::string& from, const std::string& to, std::string& error);

/// A file that is open for reading. It keeps its contents if another file gets its name. Several
/// threads, and forked processes, may read it at once, as it has no position.
class VTKCSLF_EXPORT InputFile
{
public:
  InputFile() = default;
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Call it once. On failure gives the reason in a few words, without the name.
  bool Open(const std::string& name, std::string& reason);

  /// Its size at present, in bytes.
  std::uint64_t GetSize() const { return this->FindState().Size; }

  /// Reads bytes from a place. Returns how many there were: fewer at the end, or after a failure.
  std::size_t Read(std::uint64_t place, void* bytes, std::size_t count) const;

  /// Whether somebody has written to it since it was opened, by its size and the time of its last
  /// change.
  bool HasChanged() const;

private:
  struct State
  {
    std::uint64_t Size = 0;
    std::int64_t Time = 0; ///< of its last change, in the system's units
  };
  State FindState() const;

  std::intptr_t Handle = -1;
  State Opened;
};

/// Exchanges the names of two folders in one step. False without an error if the file system cannot
/// do this.
bool ExchangeFolders(const std::string& one, const std::string& other, std::string& error);

///@{
/// Waits until a file's bytes, a folder's names, or a folder with all files in it are on the disk.
bool SyncFile(const std::string& name, std::string& error);
bool SyncFolder(const std::string& name, std::string& error);
bool SyncTree(const std::string& name, std::string& error);
///@}

/// Flushes a finished file to the disk, gives it the access of the file that it replaces, renames
/// it and flushes its name. After a crash, the old file or the complete new one exists. Unless it
/// `replaces`, it fails if there is something of that name.
bool PublishFile(
  const std::string& from, const std::string& to, std::string& error, bool replaces = true);

/// Whether files can be made in a folder.
VTKCSLF_EXPORT bool IsWritableFolder(const std::string& name, std::string& error);

/// The free space in bytes for a file or folder that exists or will exist. Infinite if unknown.
double GetFreeBytes(const std::string& name);

/// A number of bytes in readable form.
std::string DescribeBytes(double bytes);

/// "this process on this computer", for messages.
std::string DescribeProcess();

/// The folder that contains a name.
VTKCSLF_EXPORT std::string GetParent(const std::string& name);
}

#endif
