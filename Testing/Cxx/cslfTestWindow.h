// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares VTK's window with the traced picture of a renderer, in numbers.
 */
#ifndef cslfTestWindow_h
#define cslfTestWindow_h

#include <vector>

class vtkRenderer;

namespace cslf
{
namespace testing
{
/// Two pictures of the same camera, sRGB, rows from the bottom up.
struct WindowAndBake
{
  int Size = 0;
  std::vector<unsigned char> Window; ///< red, green, blue
  std::vector<unsigned char> Bake;

  /// The largest difference of a pixel's components, in levels of 255.
  int GetDifference(int column, int row) const;

  /// The difference of the middle pixel.
  int GetDifferenceInMiddle() const { return GetDifference(this->Size / 2, this->Size / 2); }

  /// The share of the pixels whose traced colour is more than `tolerance` levels outside of the
  /// window's range in the pixel and its neighbours. Pixels are traced over their area, but drawn
  /// at their centre.
  double GetPartOutside(int tolerance) const;
};

/// The settings for tracing a renderer.
struct BakeOptions
{
  bool HeadlightsAllAround = false;
  bool InterpolateDisplayedColors = true;
  int Integrator = 0;   ///< of vtkCSLFPathTracer: by default path tracing
  int MaximumDepth = 1; ///< direct light only, as in the window
  int Samples = 16;
  double PixelSize = 0.001; ///< of the scene importer
  double PointRadius = 0.0; ///< likewise
  double Background = 0.0;  ///< grey, sRGB in [0,1], behind the scene
};

/// Draws the renderer in an off-screen window, without multisampling, over `background` (grey).
/// Returns red, green and blue of `size` x `size` pixels, rows from the bottom up.
std::vector<unsigned char> DrawWindow(vtkRenderer* renderer, int size, double background = 0.0);

/// Traces what the renderer shows, with its camera. Returns pixels like DrawWindow.
std::vector<unsigned char> TraceBake(vtkRenderer* renderer, int size, const BakeOptions& options);

/// Draws the renderer in an off-screen window over black, and traces it with the same camera. The
/// pictures are squares of `size` pixels.
WindowAndBake DrawAndTrace(
  vtkRenderer* renderer, int size, const BakeOptions& options = BakeOptions());
}
}

#endif
