// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small scenes, each of one feature of VTK's windows, that are drawn and traced beside each other.
 */
#ifndef cslfSheetScenes_h
#define cslfSheetScenes_h

#include <functional>
#include <string>
#include <vector>

class vtkRenderer;

namespace cslf
{
namespace testing
{
/// What the traced picture of a scene is expected to be, from what the window shows.
enum class Expectation
{
  Cosine, ///< one headlight: the window's colours, but the cosine to the light multiplies light
  Window, ///< the window's colours
  Bounds, ///< no formula: other lights, highlights, layers of translucent surfaces
};

struct SheetScene
{
  std::string Name;
  /// Adds actors and lights, and places the camera.
  std::function<void(vtkRenderer*)> Build;
  Expectation Expected = Expectation::Cosine;
  // The largest allowed differences, in levels of 255.
  double Median = 30.0;     ///< between window and bake
  double Percentile = 80.0; ///< likewise, of 99 % of the pixels
  double Unexplained = 2.0; ///< between what is expected and the bake, of 99 % of the pixels
};

std::vector<SheetScene> MakeSheetScenes();
}
}

#endif
