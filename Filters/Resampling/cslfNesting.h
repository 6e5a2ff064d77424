// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The slices of a light field that belong to a nested, coarser one.
 */
#ifndef cslfNesting_h
#define cslfNesting_h

#include "cslfDescription.h"

#include <string>

namespace cslf
{
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
