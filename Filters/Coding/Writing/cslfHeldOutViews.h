// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Measures how well a field's other viewpoints are looked up from its key views, and how few key
 * views are enough (paper, section 3.3).
 *
 * A fixed sample of the other viewpoints is compared, at some texels each, with the result of the
 * depth lookup or, without depth, of the focal lookup about the cube's centre. Only those
 * viewpoints and the four key views around each are pulled.
 *
 * With geometry, it is the geometry lookup, with the mean of four rays for each texel. Then the 16
 * key views around each are pulled; what they do not see has the geometry's own colour.
 */
#ifndef cslfHeldOutViews_h
#define cslfHeldOutViews_h

#include "cslfViewpointReader.h"

#include <functional>
#include <string>

class vtkPolyData;

namespace cslf
{
/// A choice of key views.
struct KeyViewChoice
{
  int Step = 1;

  /// In dB and at most 100, of the viewpoints that are left out, before coding: red, green and blue
  /// of 8 bits over black, one mean square error over all texels compared of a face. That of the
  /// face where it is lowest, because a viewer may look from there, and for float colours at the
  /// exposure of GetViewExposures where it is lowest.
  double PSNR = 0.0;
};

/// Finds the largest step of key views whose PSNR is at least `goal`. Assumes that larger steps
/// have smaller PSNRs. `input` has begun and pulls all viewpoints. `geometry` may be null.
/// `proceed` is called regularly, and returns false to stop. On failure, for example if no step
/// above 1 is good enough, returns false and gives the reason in one line.
bool ChooseKeyViews(ViewpointReader& input, vtkPolyData* geometry, double goal,
  const std::function<bool()>& proceed, KeyViewChoice& choice, std::string& error);
}

#endif
