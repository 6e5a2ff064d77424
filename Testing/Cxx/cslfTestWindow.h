// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What VTK's window shows of a renderer beside what is traced of it, in numbers.
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

  /// That of the pixel in the middle.
  int GetDifferenceInMiddle() const { return GetDifference(this->Size / 2, this->Size / 2); }

  /// The part of the pixels whose traced colour lies by more than `tolerance` levels outside of
  /// what the window shows in the pixel and its neighbours: pixels are traced over their area, and
  /// drawn at their centre.
  double GetPartOutside(int tolerance) const;
};

/// How a renderer is traced.
struct BakeOptions
{
  bool HeadlightsAllAround = false;
  bool InterpolateDisplayedColors = true;
  int Integrator = 0;   ///< of vtkCSLFPathTracer: by default path tracing
  int MaximumDepth = 1; ///< direct light only, as in the window
  int Samples = 16;
  double PixelSize = 0.001; ///< of the scene importer
  double Background = 0.0;  ///< grey, sRGB in [0,1], behind the scene
};

/// Draws the renderer in a window off the screen, without multisampling, over `background` (grey).
/// Returns red, green and blue of `size` x `size` pixels, rows from the bottom up.
std::vector<unsigned char> DrawWindow(vtkRenderer* renderer, int size, double background = 0.0);

/// Traces what the renderer shows, with its camera. Returns pixels as DrawWindow does.
std::vector<unsigned char> TraceBake(vtkRenderer* renderer, int size, const BakeOptions& options);

/// Draws the renderer in a window off the screen, black behind it, and traces it with the same
/// camera. The pictures are squares of `size` pixels.
WindowAndBake DrawAndTrace(
  vtkRenderer* renderer, int size, const BakeOptions& options = BakeOptions());
}
}

#endif
