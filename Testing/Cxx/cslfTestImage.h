// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Comparing a window with its baseline by numbers, the same in every VTK version.
 */
#ifndef cslfTestImage_h
#define cslfTestImage_h

class vtkRenderWindow;

namespace cslf
{
namespace testing
{
/// Whether the window's picture equals the baseline named by the test's -V argument: at least
/// `leastPSNR` dB, and no more than `mostDifferent` of the pixels off by more than 16 levels. The
/// picture is left in the folder of the -T argument where it does not. With -I the test is
/// interactive.
bool MatchesBaseline(int argc, char* argv[], vtkRenderWindow* window, double leastPSNR = 40.0,
  double mostDifferent = 0.002);
}
}

#endif
