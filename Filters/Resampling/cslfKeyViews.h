// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Key views (paper, section 3.3): the viewpoints of a light field that are kept, while lookups
 * replace the others.
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
}

#endif
