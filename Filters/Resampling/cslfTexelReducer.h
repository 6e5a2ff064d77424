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
 * A texel stands for the area of `divisor` x `divisor` texels of the input. How it is computed
 * follows from the channel's encoding: see Reduction.
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
