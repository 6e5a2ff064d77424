// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An open file that the operating system locks: each system has its own implementation.
 *
 * The lock ends with the process, also if it is killed.
 */
#ifndef cslfLockedFile_h
#define cslfLockedFile_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace cslf
{
class LockedFile
{
public:
  enum class Outcome
  {
    Locked,
    Unsupported, ///< the file is open, but its file system has no locks
    Busy,        ///< another process has locked it
    Removed,     ///< the file or its folder was removed meanwhile: try again
    Failed       ///< the error gives the reason
  };

  LockedFile() = default;

  /// Closes the file, which unlocks it.
  ~LockedFile();

  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  /// Opens the file, or creates it if it is missing, and locks it. It never follows a link.
  Outcome Open(const std::string& fileName, std::string& error);

  bool IsOpen() const { return this->Handle != Closed; }

  /// Whether Open has created the file.
  bool IsCreated() const { return this->Created; }

  /// Whether the file still has its name. Another holder may have removed it before the lock.
  bool IsNamed() const;

  /// Reads up to `capacity` bytes from the file's beginning.
  bool Read(char* bytes, std::size_t capacity, std::size_t& count) const;

  /// Writes the bytes at the file's beginning.
  bool Write(const char* bytes, std::size_t count, std::string& error);

  /// Removes the file. Closes it if the system requires that.
  void Remove();

  void Close();

private:
  static constexpr std::intptr_t Closed = -1;

  std::string FileName;
  std::intptr_t Handle = Closed;
  bool Created = false;
};
}

#endif
