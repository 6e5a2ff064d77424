// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How well viewpoints that are left out of a field are looked up from its key views, and how few
 * key views do (paper, section 3.3).
 *
 * A sample of the viewpoints that are left out, always the same, is compared at some texels each
 * with what the lookup corrected by depth finds there; without depth, the focal one about the
 * cube's centre. Only those viewpoints and the four key views around each are pulled.
 */
#ifndef cslfHeldOutViews_h
#define cslfHeldOutViews_h

#include "Pipeline/cslfSlicePuller.h"

#include <functional>
#include <string>

namespace cslf
{
/// The PSNR, in dB and at most 100, of the viewpoints that a step of key views leaves out, before
/// coding: red, green and blue of 8 bits over black, one mean square error over all texels
/// compared. Of colours of floats, the lowest of the PSNRs at the exposures of GetViewExposures.
/// `puller` has begun and pulls all viewpoints. On failure returns false and says why, in one line.
bool MeasureHeldOutViews(SlicePuller& puller, int step, const std::function<bool()>& proceed,
  double& psnr, std::string& error);

/// A choice of key views.
struct KeyViewChoice
{
  int Step = 1;
  double PSNR = 0.0;
};

/// Finds the largest step of key views whose PSNR, as above, is at least `goal`, taking it that
/// larger steps have smaller ones. `proceed` is called now and then, and returns false to stop. On
/// failure, as where no step above 1 is good enough, returns false and says why, in one line.
bool ChooseKeyViews(SlicePuller& puller, double goal, const std::function<bool()>& proceed,
  KeyViewChoice& choice, std::string& error);
}

#endif
