// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The coded groups of an unfinished file: their bytes, sealed by a checksum, which also are
 * messages between ranks, and the folder beside the file that holds them, one file for each group
 * and track.
 *
 * Each of these files appears complete, by renaming. It contains a checksum and the number of its
 * manifest, a text of all that the groups depend on. If a run ends before the file is complete, the
 * groups stay for the next run.
 */
#ifndef cslfGroupStore_h
#define cslfGroupStore_h

#include "Coding/Groups/cslfGroupEncoder.h"
#include "Files/cslfWorkFolder.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cslf
{
/// Numbers and bytes in sequence.
class ByteBuffer
{
public:
  ByteBuffer() = default;
  explicit ByteBuffer(std::vector<std::uint8_t> bytes)
    : Bytes(std::move(bytes))
  {
  }

  void Put(std::uint32_t number);
  void Put(double number);
  void Put(const std::vector<std::uint8_t>& data);

  ///@{
  /// Reads the next item. False if the bytes end before it does.
  bool Take(std::uint32_t& number);
  bool Take(double& number);
  bool Take(std::vector<std::uint8_t>& data);
  ///@}

  const std::vector<std::uint8_t>& GetBytes() const { return this->Bytes; }

  /// The CRC-32 of the first `size` bytes.
  std::uint32_t GetChecksum(std::size_t size) const;

private:
  template <typename Number>
  void PutNumber(Number number);
  template <typename Number>
  bool TakeNumber(Number& number);

  std::vector<std::uint8_t> Bytes;
  std::size_t Position = 0;
};

/// The number of a manifest, which is its CRC-32. A manifest is a text of all that groups depend
/// on.
std::uint32_t NumberManifest(const std::string& text);

/// A group with the number of the manifest that it was made under.
std::vector<std::uint8_t> PackGroup(const CodedGroup& coded, std::uint32_t manifest);

/// False if the bytes are not a result of PackGroup under that manifest.
bool UnpackGroup(std::vector<std::uint8_t> bytes, std::uint32_t manifest, CodedGroup& coded);

/// Whether bytes begin like those of PackGroup, and the number of their manifest.
bool ReadManifest(const std::vector<std::uint8_t>& bytes, std::uint32_t& manifest);

/// The number of bytes that this takes.
constexpr std::size_t GroupHeadSize = 8;

class GroupStore
{
public:
  /// The groups of the file `fileName`.
  explicit GroupStore(const std::string& fileName);

  /// Keeps data for a restart if the store was opened or an earlier run has left the folder.
  ~GroupStore();

  GroupStore(const GroupStore&) = delete;
  GroupStore& operator=(const GroupStore&) = delete;

  /// Makes the folder or takes over that of a killed run, and locks it. Its contents stay if `keep`
  /// is set. On failure returns false and gives the reason in one line.
  bool Reserve(bool keep, std::string& error);

  /// Reserves the folder, unless that is done. Its groups stay if `keep` is set and they were made
  /// under the same manifest; `discarded` tells whether groups of another manifest were removed
  /// although `keep` is set. On failure returns false and gives the reason in one line.
  bool Open(const std::string& manifest, bool keep, bool& discarded, std::string& error);

  /// Whether a track's group exists, damaged or not.
  bool Has(TrackRole role, int group) const;

  bool Write(TrackRole role, int group, const CodedGroup& coded, std::string& error) const;
  bool Read(TrackRole role, int group, CodedGroup& coded, std::string& error) const;

  ///@{
  /// The results of trials before the groups were made, kept under the same manifest. Empty if
  /// there are none.
  bool WriteTrials(const std::string& text, std::string& error) const;
  std::string ReadTrials() const;
  void DropTrials() const;
  ///@}

  ///@{
  /// A file of the groups so far, for viewers: the path where it is written, and steps that make it
  /// visible, see GetPreviewName, and remove both.
  std::string GetUnfinishedPreview() const;
  bool PublishPreview(std::string& error) const;
  void DropPreview() const;
  ///@}

  /// The path where data for a restart may be kept. It is removed with the folder.
  PersistentFile GetCacheFile() const;

  /// The path where the complete file is assembled before it is renamed.
  std::string GetWholeName() const;

  /// Flushes the complete file to the disk, gives it its name, and only then removes the groups.
  /// Unless it `replaces`, it fails if there is something of that name. A warning says why the
  /// folder stays if it does.
  bool Publish(bool replaces, std::string& warning, std::string& error);

  const std::string& GetFolder() const { return this->Work.GetName(); }

private:
  static std::string GetGroupName(TrackRole role, int group);
  bool DropOthers() const;

  WorkFolder Work;
  std::string Preview; ///< its name
  std::uint32_t Manifest = 0;
  bool Opened = false;
};
}

#endif
