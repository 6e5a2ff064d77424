// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares a window with its baseline by numbers that do not depend on the VTK version.
 */
#ifndef cslfTestImage_h
#define cslfTestImage_h

class vtkRenderWindow;

namespace cslf
{
namespace testing
{
/// Whether the window's picture equals the baseline named by the test's -V argument: at least
/// `leastPSNR` dB, and no more than `mostDifferent` of the pixels off by more than 16 levels. If
/// not, the picture is left in the folder of the -T argument. With -I the test is interactive.
bool MatchesBaseline(int argc, char* argv[], vtkRenderWindow* window, double leastPSNR = 40.0,
  double mostDifferent = 0.002);
}
}

#endif
