// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Key views (paper, section 3.3): the viewpoints of a light field that are kept where lookups make
 * up for the others.
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
  /// Of `viewpoints` along each side of a face, about every `step`-th is kept: the ends, and in
  /// between as few as leave no gap larger than `step`, evenly spread and symmetric. Where `step`
  /// divides `viewpoints` - 1, every `step`-th exactly. From 1, which keeps all, to `viewpoints`
  /// - 1, which keeps the ends.
  KeyViews(int viewpoints, int step);

  /// What keeps a step from being used, in a sentence; empty where nothing does.
  static std::string FindFault(int viewpoints, int step);

  /// The indices of the kept viewpoints along a side, ascending.
  const std::vector<int>& GetIndices() const { return this->Indices; }

  /// The whole field's slice that a slice of the key views is.
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
