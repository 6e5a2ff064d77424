// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small scenes for one feature of VTK's windows each, which are drawn and traced.
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
/// The expected traced picture of a scene, computed from the window.
enum class Expectation
{
  Cosine, ///< one headlight: the window's colours, except that the cosine multiplies light
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
  double Unexplained = 2.0; ///< between the expectation and the bake, for 99 % of the pixels
  double PointRadius = 0.0; ///< of the scene importer
};

/// All scenes of the sheet.
std::vector<SheetScene> MakeSheetScenes();

/// Those of points, wireframes, lines and unusual polygons, and of images in any plane.
std::vector<SheetScene> MakeRepresentationScenes();
}
}

#endif
