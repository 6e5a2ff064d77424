// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The samples of a field that was opened, viewpoint by viewpoint: of image data in memory or of a
 * file. They stay those of that field, whatever its producer opens later.
 */
#ifndef cslfViewpointSource_h
#define cslfViewpointSource_h

#include "cslfDescription.h"
#include "cslfViewpointSamples.h"
#include "vtkCSLFModule.h" // for export macro

#include <memory>
#include <vector>

class vtkImageData;

namespace cslf
{
class VTKCSLF_EXPORT ViewpointSource
{
public:
  virtual ~ViewpointSource();
  ViewpointSource(const ViewpointSource&) = delete;
  ViewpointSource& operator=(const ViewpointSource&) = delete;

  const Description& GetDescription() const { return this->Field; }

  /// The viewpoints that are known to be missing, ascending. The reader has reported them.
  const std::vector<int>& GetMissing() const { return this->Missing; }

  /// Prepares viewpoints in the background, in this order. This replaces an earlier request.
  virtual void Prefetch(const std::vector<int>& slices) = 0;

  /// Waits until all requested viewpoints are ready.
  virtual void Wait() = 0;

  /// Whether Get costs almost nothing.
  virtual bool IsReady(int slice) = 0;

  /// A viewpoint's samples. Waits for them. They are empty if they are damaged.
  virtual ViewpointSamples Get(int slice) = 0;

  /// Sorts slices into the order in which all of them are ready soonest.
  virtual void Sort(std::vector<int>& slices) = 0;

protected:
  ViewpointSource(const Description& field, std::vector<int> missing);

private:
  Description Field;
  std::vector<int> Missing;
};

/// A whole field in memory.
VTKCSLF_EXPORT std::shared_ptr<ViewpointSource> MakeSource(
  const Description& field, vtkImageData* image);
}

#endif
