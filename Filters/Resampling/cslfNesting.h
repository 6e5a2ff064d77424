// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which slices of a light field a nested, coarser one has.
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
  /// For an input of that extent, of which every `stride`-th viewpoint along each side is kept, and
  /// squares of `divisor` texels a side become one.
  Nesting(const int extent[6], int divisor, int stride);

  /// What keeps it from being made, in a sentence; empty where nothing does.
  std::string FindFault() const;

  /// The whole extent of the output, in VTK's order.
  void GetWholeExtent(int extent[6]) const;

  /// The input's slice that becomes a slice of the output.
  int ToInput(int slice) const;

  /// The last of the output's slices from `first` to `last` whose input slices are pulled together
  /// with the first one's: as many as fit into `limit` slices of the
  /// input without a row that is left out.
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
