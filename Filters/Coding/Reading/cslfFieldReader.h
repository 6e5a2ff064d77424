// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes any range of slices of a coded light field, or single ones.
 */
#ifndef cslfFieldReader_h
#define cslfFieldReader_h

#include "Pipeline/cslfFieldStore.h"
#include "cslfViewpointStore.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cslf
{
/// Methods that read throw std::bad_alloc if there is not enough memory.
class FieldReader
{
public:
  /// Gets numbers from 0 to 1 and returns false to stop.
  using Progress = std::function<bool(double)>;

  /// Reads the header only. Returns null on failure.
  static std::unique_ptr<FieldReader> Open(const std::string& fileName, OpenError& failure);

  /// See GroupDecoder.
  FieldReader(std::unique_ptr<ContainerReader> container, std::unique_ptr<GeometryTexels> texels);

  const FileHeader& GetHeader() const { return this->Decoder.GetHeader(); }

  /// The size of all packets of each track, in bytes. Reads the whole file.
  std::vector<std::int64_t> CountBytes() { return this->Decoder.CountBytes(); }

  /// Decodes the slices `first` to `last` into arrays of just these. Groups without any of them
  /// are not read, and slices that are kept are not decoded. The other slices of these groups are
  /// kept if they fit. Slices of damaged groups are cleared and their numbers returned in ascending
  /// order.
  std::vector<int> Read(
    int first, int last, const ViewpointSamples& target, const Progress& progress);

  /// The slices of damaged groups, all or those from `first` to `last`, in ascending order. Nothing
  /// is decoded: groups are damaged if their checksums are wrong or if decoding failed before.
  /// Groups known to be damaged are not read again.
  std::vector<int> FindMissing(const Progress& progress);
  std::vector<int> FindMissing(int first, int last, const Progress& progress);

  /// Whether somebody has written to the file since it was opened.
  bool HasFileChanged() const { return this->Decoder.HasFileChanged(); }

  /// Single viewpoints, which are kept for later.
  ViewpointStore& GetViewpoints() { return this->Store; }

private:
  class Range;

  GroupDecoder Decoder;
  ViewpointStore Store; ///< stops the decoder before it is destroyed
};

/// The viewpoints of a reader's file. `guard` does work that may throw, and returns false if it
/// has. `onMissing` is called when a viewpoint is found missing.
std::shared_ptr<FieldStore> MakeStore(std::shared_ptr<FieldReader> reader,
  std::function<bool(const std::function<bool()>& work)> guard, std::function<void()> onMissing);
}

#endif
