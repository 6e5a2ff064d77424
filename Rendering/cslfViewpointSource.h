// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where the samples that are drawn come from, viewpoint by viewpoint.
 */
#ifndef cslfViewpointSource_h
#define cslfViewpointSource_h

#include "cslfDescription.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

class vtkCSLFDecoder;
class vtkImageData;

namespace cslf
{
/// The samples of one viewpoint. The arrays are shared: nobody may change them.
struct ViewpointSamples
{
  vtkSmartPointer<vtkDataArray> Color;
  vtkSmartPointer<vtkDataArray> Depth; ///< null where the field has none
  vtkIdType First = 0;                 ///< the tuple that the strip begins with
};

class ViewpointSource
{
public:
  virtual ~ViewpointSource();

  const Description& GetDescription() const { return this->Field; }

  /// Has viewpoints made ready in the background, the first ones first. This replaces what an
  /// earlier call asked for.
  virtual void Prefetch(const std::vector<int>& slices) = 0;

  /// Waits until what was asked for is ready.
  virtual void Wait() = 0;

  /// Whether Get costs next to nothing.
  virtual bool IsReady(int slice) = 0;

  /// A viewpoint's samples, waited for; without Color if they are damaged.
  virtual ViewpointSamples Get(int slice) = 0;

  /// Brings slices into the order in which all of them are had soonest.
  virtual void Sort(std::vector<int>& slices) = 0;

protected:
  explicit ViewpointSource(const Description& field);

private:
  Description Field;
};

/// A whole field in memory.
std::shared_ptr<ViewpointSource> MakeSource(const Description& field, vtkImageData* image);

/// A coded field. The decoder's header must have been read.
std::shared_ptr<ViewpointSource> MakeSource(const Description& field, vtkCSLFDecoder* decoder);
}

#endif
