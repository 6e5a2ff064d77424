// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reduces squares of texels to one texel.
 */
#ifndef cslfTexelReducer_h
#define cslfTexelReducer_h

#include "cslfDescription.h"

class vtkImageData;

namespace cslf
{
/**
 * A texel stands for the area of `divisor` x `divisor` texels of the input.
 *
 * - Colour bytes: the mean of what the samples that hit saw, which is linear and weighted by
 *   coverage; alpha is the mean coverage.
 * - Linear colours: the mean of all components.
 * - Depth (`chord-fraction`): the smallest of the covered texels; 1 where none is.
 * - Other channels: the mean of the covered texels, or of all where none is.
 */
class TexelReducer
{
public:
  /// The divisor divides the input's resolution.
  TexelReducer(const Description& input, int divisor);

  /// Fills a slice of `output`, whose arrays are allocated, from a slice of `input`.
  void Reduce(vtkImageData* input, int inputSlice, vtkImageData* output, int outputSlice) const;

private:
  const Description& Input;
  int Divisor;
};
}

#endif
