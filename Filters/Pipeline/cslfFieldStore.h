// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The samples of a field that was opened, viewpoint by viewpoint: of image data in memory or of a
 * file. They stay those of that field, whatever its producer opens later.
 *
 * A filter that has a store lends it to its consumers through the information of its output, so
 * that they need not know its class.
 */
#ifndef cslfFieldStore_h
#define cslfFieldStore_h

#include "cslfDescription.h"
#include "cslfViewpointSamples.h"
#include "vtkCSLFModule.h" // for export macro

#include <functional>
#include <memory>
#include <vector>

class vtkImageData;
class vtkInformation;

namespace cslf
{
class VTKCSLF_EXPORT FieldStore
{
public:
  virtual ~FieldStore();
  FieldStore(const FieldStore&) = delete;
  FieldStore& operator=(const FieldStore&) = delete;

  const Description& GetDescription() const { return this->Field; }

  /// The viewpoints that are known to be missing, ascending.
  const std::vector<int>& GetMissing() const { return this->Missing; }

  /// Reports them as the reader does, if there are any.
  void ReportMissing()
  {
    if (!this->Missing.empty())
    {
      this->Get(this->Missing.front());
    }
  }

  /// Prepares viewpoints in the background, in this order. This replaces an earlier request.
  virtual void Prefetch(const std::vector<int>& slices) = 0;

  /// Waits until all requested viewpoints are ready.
  virtual void Wait() = 0;

  /// Whether Get costs almost nothing.
  virtual bool IsReady(int slice) = 0;

  /// A viewpoint's samples. Waits for them. They are empty if they are missing or damaged, which a
  /// reader then reports.
  virtual ViewpointSamples Get(int slice) = 0;

  /// Sorts slices into the order in which all of them are ready soonest.
  virtual void Sort(std::vector<int>& slices) = 0;

protected:
  FieldStore(const Description& field, std::vector<int> missing);

private:
  Description Field;
  std::vector<int> Missing;
};

/// A whole field in memory.
VTKCSLF_EXPORT std::shared_ptr<FieldStore> MakeStore(const Description& field, vtkImageData* image);

///@{
/// Lends a store through an output's information, in RequestInformation: the function gives the one
/// of the field that is open, or null. It is called while the producer exists.
using StoreLender = std::function<std::shared_ptr<FieldStore>()>;
void LendStore(vtkInformation* output, StoreLender lender);
///@}

/// Whether the producer of an output lends a store.
VTKCSLF_EXPORT bool IsStoreLent(vtkInformation* output);

/// That store. Null if the producer lends none, or has no field open.
VTKCSLF_EXPORT std::shared_ptr<FieldStore> BorrowStore(vtkInformation* output);
}

#endif
