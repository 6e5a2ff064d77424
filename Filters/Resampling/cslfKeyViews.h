// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Coarser fields in a light field: its key views (paper, section 3.3), which are kept while lookups
 * replace the others, and nested fields with fewer texels, too.
 */
#ifndef cslfKeyViews_h
#define cslfKeyViews_h

#include "cslfDescription.h"

#include <string>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT KeyViews
{
public:
  /// Keeps about every `step`-th of `viewpoints` along each side of a face: the ends, and between
  /// them as few as possible without a gap larger than `step`, evenly spread and symmetric. If
  /// `step` divides `viewpoints` - 1, it is exactly every `step`-th. A step of 1 keeps all, and a
  /// step of `viewpoints` - 1 keeps only the ends.
  KeyViews(int viewpoints, int step);

  /// Why a step cannot be used, in a sentence. Empty if it can.
  static std::string FindError(int viewpoints, int step);

  /// The indices of the kept viewpoints along a side, ascending.
  const std::vector<int>& GetIndices() const { return this->Indices; }

  /// The whole field's slice for a slice of the key views.
  int ToWhole(int slice) const;

  /// Whether a slice of the whole field is one of the key views.
  bool IsKey(int wholeSlice) const;

  /// The description of a field of the key views only.
  Description Apply(const Description& whole) const;

private:
  int Viewpoints;
  int Step;
  std::vector<int> Indices;
};

class Nesting
{
public:
  /// For an input of that extent: keeps every `stride`-th viewpoint along each side, and reduces
  /// squares of `divisor` x `divisor` texels to one.
  Nesting(const int extent[6], int divisor, int stride);

  /// Why it cannot be made, in a sentence. Empty if it can.
  std::string FindError() const;

  /// The whole extent of the output, in VTK's order.
  void GetWholeExtent(int extent[6]) const;

  /// The input's slice for a slice of the output.
  int ToInput(int slice) const;

  /// The last of the output's slices from `first` to `last` whose input slices are pulled together
  /// with those of the first. They fit into `limit` slices of the input and skip no row.
  int FindEnd(int first, int last, int limit) const;

  /// The description of the output.
  Description Apply(const Description& input) const;

private:
  int GetKept() const { return (this->Viewpoints - 1) / this->Stride + 1; }

  int Extent[6];
  int Viewpoints; ///< along each side of the input's faces
  int Divisor;
  int Stride;
};
}

#endif
