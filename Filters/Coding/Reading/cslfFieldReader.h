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
/// A file that was opened, with its viewpoints at all times.
class FieldReader
{
public:
  /// Reads the header only. Returns null on failure.
  static std::unique_ptr<FieldReader> Open(const std::string& fileName, OpenError& failure);

  /// See GroupDecoder.
  FieldReader(std::unique_ptr<ContainerReader> container, std::unique_ptr<GeometryTexels> texels);

  const FileHeader& GetHeader() const { return this->Decoder.GetHeader(); }

  /// The size of all packets of each track, in bytes. Reads the whole file.
  std::vector<std::int64_t> CountBytes() { return this->Decoder.CountBytes(); }

  /// Whether somebody has written to the file since it was opened.
  bool HasFileChanged() const { return this->Decoder.HasFileChanged(); }

  GroupDecoder& GetDecoder() { return this->Decoder; }

  /// Single viewpoints, which are kept for later.
  ViewpointStore& GetViewpoints() { return this->Store; }

private:
  GroupDecoder Decoder;
  ViewpointStore Store; ///< stops the decoder before it is destroyed
};

/// A file at one of its times, by slices. Methods that read throw std::bad_alloc if there is not
/// enough memory.
class FieldView
{
public:
  /// Gets numbers from 0 to 1 and returns false to stop.
  using Progress = std::function<bool(double)>;

  FieldView(std::shared_ptr<FieldReader> file, int time);

  FieldReader& GetFile() const { return *this->File; }
  const FileHeader& GetHeader() const { return this->File->GetHeader(); }

  /// Decodes the slices `first` to `last` into arrays of just these. Groups without any of them
  /// are not read, and slices that are kept are not decoded. The other frames of these groups are
  /// kept if they fit. Slices of damaged groups are cleared and their numbers returned in ascending
  /// order.
  std::vector<int> Read(
    int first, int last, const ViewpointSamples& target, const Progress& progress) const;

  /// The slices of damaged groups, all or those from `first` to `last`, in ascending order. Nothing
  /// is decoded: groups are damaged if their checksums are wrong or if decoding failed before.
  /// Groups known to be damaged are not read again.
  std::vector<int> FindMissing(const Progress& progress) const;
  std::vector<int> FindMissing(int first, int last, const Progress& progress) const;

  /// What is missing in words, and in what state the file is therefore; none if all is missing.
  struct MissingText
  {
    std::string State; ///< "damaged", ...
    std::string Text;
  };
  MissingText DescribeMissing(const std::vector<int>& missing, bool areLeftEmpty) const;

  /// The slices that the file does not contain yet, ascending.
  const std::vector<int>& GetUnwritten() const { return this->Unwritten; }

  /// All slices in the order of the file.
  const std::vector<int>& GetOrder() const { return this->Order; }

  ///@{
  /// Single viewpoints: see ViewpointStore.
  bool Has(int slice) const { return this->File->GetViewpoints().Has(this->GetFrame(slice)); }
  ViewpointSamples Get(int slice) const
  {
    return this->File->GetViewpoints().Get(this->GetFrame(slice));
  }
  void Prefetch(const std::vector<int>& slices) const;
  ///@}

private:
  class Range;

  FrameId GetFrame(int slice) const { return { slice, this->Time }; }

  std::shared_ptr<FieldReader> File;
  int Time;
  std::vector<int> Unwritten;
  std::vector<int> Order;
};

/// The viewpoints of a view. `guard` does work that may throw, and returns false if it has.
/// `onMissing` is called when a viewpoint is found missing.
std::shared_ptr<FieldStore> MakeStore(const FieldView& view,
  std::function<bool(const std::function<bool()>& work)> guard, std::function<void()> onMissing);
}

#endif
