// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pulls a light field through the pipeline a few viewpoints at a time, so that it never has to fit
 * in memory as a whole.
 */
#ifndef cslfFieldStream_h
#define cslfFieldStream_h

#include "Pipeline/cslfFieldStore.h"
#include "Pipeline/cslfRequests.h"
#include "cslfDescription.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
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

/// Reads a filter's input connection slab by slab. Methods return false on failure; then GetError()
/// gives the reason in a sentence. It is empty if the information cannot be updated, which the
/// upstream filter has reported.
class FieldStream
{
public:
  explicit FieldStream(vtkAlgorithmOutput* connection);

  ///@{
  /// Called once, before the first slab is read: Open updates the connection's information,
  /// OpenUpdated relies on it, within a filter's RequestData. What had been requested from the
  /// upstream filters before is requested from them again when the stream is destroyed.
  bool Open();
  bool OpenUpdated();
  ///@}

  /// The slices that the upstream filter offers.
  const Slab& GetWhole() const { return this->Whole; }

  /// Whether some orders of slices are faster than others, as in a video.
  bool IsOrdered() const { return this->Store != nullptr; }

  /// The wanted slices as slabs, which take moderate memory, but are small enough to show progress.
  /// They are in the order of least work for the upstream filter: that of the file if it reads a
  /// video, else ascending.
  std::vector<Slab> PlanSlabs(const std::function<bool(int)>& isWanted) const;

  /// Announces the slabs that will be read, in this order, so that a video is decoded ahead.
  void Announce(const std::vector<Slab>& slabs);

  /// Updates upstream to the slab at one of the field's times and checks what it delivers. The
  /// first read fixes the description; a later one that differs from it is an error. Only bounds
  /// and the record of sampling may be others at another time.
  bool Read(const Slab& slab, int time = 0);

  /// At least the slab read last, as arrays that pointers can read.
  vtkImageData* GetImage() const { return this->Image; }
  const Description& GetDescription() const { return this->Field; }
  const std::string& GetError() const { return this->Error; }

  /// The first value of a slice in a channel's array of the current image.
  const unsigned char* GetSlice(const Channel& channel, int slice) const;

private:
  bool Fail(const std::string& error);
  void ReadAhead(const Slab& slab);

  vtkSmartPointer<vtkAlgorithm> Producer;
  int Port;
  vtkInformation* Information = nullptr; ///< of the producer's output
  std::shared_ptr<FieldStore> Store;     ///< if the producer lends one, else null
  std::optional<KeptRequests> Requests;
  Slab Whole;
  int SlabSize = 1;
  std::vector<Slab> Announced;
  std::size_t Next = 0; ///< of the slabs announced
  Description Field;
  std::string Text; ///< the field's, after the first read
  int Time = 0;     ///< that was read last
  vtkSmartPointer<vtkImageData> Image;
  std::string Error;
};

/// Sets an output's information: a light field of that whole extent, any slices of which can be
/// requested. Pieces of it are ranges of slices, which share one, like pieces of image data.
void SetFieldInformation(vtkInformation* information, const int wholeExtent[6]);
}

#endif
