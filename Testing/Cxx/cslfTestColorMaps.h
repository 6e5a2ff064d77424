// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Fields whose geometry has mapped points, and what VTK's own mapper shows of the same scalars.
 */
#ifndef cslfTestColorMaps_h
#define cslfTestColorMaps_h

#include "cslfTestView.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkType.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
namespace testing
{
using Table = vtkSmartPointer<vtkLookupTable>;

/// The width and height of pictures.
constexpr int MapSize = 160;

/// Of all points, unless a look says otherwise: the share of white, linear.
constexpr double MapLight = 0.8;

/// From blue to red in so many steps over a range.
Table MakeRainbow(double first, double last, int steps = 256);

/// From yellow to blue, with other colours of what is outside of the range.
Table MakeSteps(double first, double last);

/// An encoded colour in some light.
double Darken(double encoded, double light);

/// A sphere without point data.
vtkSmartPointer<vtkPolyData> MakeSphere(
  const std::array<double, 3>& center, double radius, int resolution = 40);

/// Tells that the spheres of a geometry are balls, each with a centre and a radius.
void AddBallGroup(
  vtkPolyData* geometry, const std::vector<std::array<double, 4>>& balls, int resolution);

/// What the mapped points of a geometry are made of.
struct MapLook
{
  std::function<double(const double*)> Scalar = [](const double* point) { return point[2]; };
  double Front = MapLight;
  double Back = MapLight;
  double Loss = 0.0;
  int ColorType = VTK_UNSIGNED_CHAR;
};

/// Makes all points mapped by a table, with exact colours and scalars of the name `Height`.
void AddColors(vtkPolyData* geometry, vtkLookupTable* table, const MapLook& look = MapLook());

/// A mapper of the test field with another geometry, and one ray for each pixel.
vtkSmartPointer<vtkCSLFMapper> MakeMapper(vtkPolyData* geometry, int type = VTK_UNSIGNED_CHAR);

/// What VTK shows of the scalars in a table over its range, in some light.
Picture DrawByVTK(vtkPolyData* geometry, vtkLookupTable* table, double light, vtkCamera* camera);

/// The share of the pixels, away from the silhouettes of `b`, whose colours differ by more than 2
/// of 255.
double CountDifferent(const Picture& a, const Picture& b);

/// A field with a geometry, and what VTK shows of it.
class MapComparison
{
public:
  explicit MapComparison(vtkPolyData* geometry, int type = VTK_UNSIGNED_CHAR);

  /// Draws both, which must be the same, apart from where bands of colours meet.
  void Check(const std::string& name, vtkLookupTable* shown, double light = MapLight);

  /// The warnings since the last call.
  std::string TakeWarning();

  vtkPolyData* Geometry;
  vtkSmartPointer<vtkCSLFMapper> Mapper;
  View Field{ MapSize };
  vtkSmartPointer<vtkActor> Actor;
  vtkNew<vtkTest::ErrorObserver> Warnings;
};
}
}

#endif
