// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pulls a light field through the pipeline a few viewpoints at a time, so that it never has to fit
 * in memory as a whole.
 */
#ifndef cslfSlabs_h
#define cslfSlabs_h

#include "Pipeline/cslfRequests.h"
#include "cslfDescription.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkCSLFDecoder;
class vtkInformation;

namespace cslf
{
/// The largest size, in bytes, of slices that filters ask for at once.
constexpr double PulledBytes = 64.0 * 1024 * 1024;

/// A range of z slices, both ends included.
struct Slab
{
  int First = 0;
  int Last = -1;

  int GetCount() const { return this->Last - this->First + 1; }
};

/// Reads a filter's input connection slab by slab. Every method except the getters returns false on
/// failure; then GetError() gives the reason in one line, or is empty if the upstream filter has
/// reported it already. What had been requested from the upstream filters before Open() is
/// requested from them again afterwards.
class SlabStream
{
public:
  explicit SlabStream(vtkAlgorithmOutput* connection);

  /// Asks upstream for the whole extent. Called once.
  bool Open();

  /// The slices that the upstream filter offers.
  const Slab& GetWhole() const { return this->Whole; }

  /// The number of slices of a slab with moderate memory, but small enough to show progress.
  int GetSlabSize() const { return this->SlabSize; }

  /// The slab that begins at `first`, which must be one of the whole's slices.
  Slab MakeSlab(int first) const;

  /// Whether the upstream filter decodes a video.
  bool IsVideo() const { return this->Decoder != nullptr; }

  /// The wanted slices as slabs, in the order of least work for the upstream filter: that of the
  /// file if it is a video, else ascending.
  std::vector<Slab> PlanSlabs(const std::function<bool(int)>& isWanted) const;

  /// Announces the slabs that will be read, in this order, so that a video is decoded ahead.
  void Announce(const std::vector<Slab>& slabs);

  /// Updates upstream to the slab and checks what it delivers. The first read fixes the
  /// description; a later one that differs from it is an error.
  bool Read(const Slab& slab);

  vtkImageData* GetImage() const { return this->Image; }
  const Description& GetDescription() const { return this->FieldDescription; }
  const std::string& GetError() const { return this->Error; }

  /// The first value of a slice in a channel's array of the current image.
  const unsigned char* GetSlice(const Channel& channel, int slice) const;

private:
  bool Fail(const std::string& error);
  void ReadAhead(const Slab& slab);

  vtkAlgorithm* Producer;
  vtkCSLFDecoder* Decoder; ///< the producer if it is one, else null
  int Port;
  std::optional<KeptRequests> Requests;
  Slab Whole;
  int SlabSize = 1;
  std::vector<Slab> Announced;
  std::size_t Next = 0; ///< of the slabs announced
  bool HasDescription = false;
  Description FieldDescription;
  vtkSmartPointer<vtkImageData> Image; ///< of arrays that pointers can read
  std::string Error;
};

/// Pulls at least the slices from `first` to `last` from the connection of that pipeline
/// information, within a filter's RequestData, as arrays that pointers can read. The filter keeps
/// the requests with KeptRequests. On failure returns null and gives the reason in a sentence.
vtkSmartPointer<vtkImageData> PullSlices(
  vtkInformation* information, int first, int last, std::string& error);

/// Splits the output of that pipeline information into pieces, which are ranges of z slices. They
/// share one slice, like pieces of image data.
void SplitAlongZ(vtkInformation* information);

/// Sets an output's information: a light field of that whole extent, any slices of which can be
/// requested.
void SetFieldInformation(vtkInformation* information, const int wholeExtent[6]);
}

#endif
