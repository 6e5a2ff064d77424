// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Mapped points of a geometry are shown in their own map and in any lookup table, as VTK's own
// mapper shows them.
#include "Pipeline/cslfColorMap.h"
#include "cslfTestColorMaps.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>

#include <cmath>
#include <string>

namespace
{
using cslf::ColorMap;
using cslf::testing::AddColors;
using cslf::testing::MakeMapper;
using cslf::testing::MakeRainbow;
using cslf::testing::MakeSphere;
using cslf::testing::MakeSteps;
using cslf::testing::MapComparison;
using cslf::testing::MapLook;
using cslf::testing::Table;

constexpr double Radius = 0.8;

/// Tables, ranges, selected arrays and the plain colour.
void TestTables()
{
  const auto geometry = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  const Table own = MakeRainbow(-Radius, Radius);
  AddColors(geometry, own);
  MapComparison sphere(geometry);
  vtkCSLFMapper* mapper = sphere.Mapper;

  // Before anything is drawn or set, the mapper tells the field's map.
  auto* told = vtkLookupTable::SafeDownCast(mapper->GetLookupTable());
  CSLF_CHECK(told && told->GetNumberOfTableValues() == 256);
  double range[2];
  mapper->GetScalarRange(range);
  CSLF_CHECK_NEAR(range[0], -Radius, 1e-12);
  CSLF_CHECK_NEAR(mapper->GetScalarRange()[1], Radius, 1e-12);
  CSLF_CHECK_NEAR(told->GetTableRange()[1], Radius, 1e-12);
  for (const double value : { -0.7, 0.0, 0.3 })
  {
    double color[3];
    double expected[3];
    told->GetColor(value, color);
    own->GetColor(value, expected);
    CSLF_CHECK_NEAR(color[0], expected[0], 0.005);
    CSLF_CHECK_NEAR(color[2], expected[2], 0.005);
  }
  sphere.Check("own map", own);
  CSLF_CHECK(mapper->GetLookupTable() == told);

  // A table applies over the range of the scalars, until one is set. It is not changed.
  const Table steps = MakeSteps(0.0, 5.0);
  const vtkMTimeType time = steps->GetMTime();
  mapper->SetLookupTable(steps);
  sphere.Check("another table", MakeSteps(-Radius, Radius));
  mapper->SetScalarRange(-0.5, 0.2);
  sphere.Check("another range", MakeSteps(-0.5, 0.2));
  CSLF_CHECK(mapper->GetScalarRange()[0] == -0.5 && mapper->GetScalarRange()[1] == 0.2);
  CSLF_CHECK(steps->GetMTime() == time && steps->GetTableRange()[1] == 5.0);
  steps->SetTableRange(-0.1, 0.6);
  mapper->UseLookupTableScalarRangeOn();
  sphere.Check("the table's range", MakeSteps(-0.1, 0.6));
  steps->SetTableValue(3, 0.0, 0.9, 0.0);
  sphere.Check("a changed table", steps);
  mapper->UseLookupTableScalarRangeOff();

  // The array may be named. Of another, no point is coloured.
  mapper->SelectColorArray("Height");
  mapper->SetLookupTable(MakeRainbow(0.0, 1.0, 5));
  sphere.Check("its array", MakeRainbow(-0.5, 0.2, 5));
  CSLF_CHECK(sphere.TakeWarning().empty());
  mapper->SelectColorArray("Weight");
  sphere.Check("another array", own);
  CSLF_CHECK(sphere.TakeWarning().find("Weight") != std::string::npos);
  mapper->SelectColorArray("Height");

  // Tables that are no maps are refused.
  const Table categories = MakeSteps(0.0, 1.0);
  categories->IndexedLookupOn();
  mapper->SetLookupTable(categories);
  sphere.Check("categories", own);
  CSLF_CHECK(sphere.TakeWarning().find("categories") != std::string::npos);
  mapper->SetLookupTable(steps);
  mapper->SetScalarRange(0.3, 0.3);
  sphere.Check("no range", own);
  CSLF_CHECK(!sphere.TakeWarning().empty());

  // The field's colours over another range.
  mapper->SetLookupTable(nullptr);
  mapper->SetScalarRange(-0.3, 0.9);
  Table stretched = MakeRainbow(-0.3, 0.9);
  sphere.Check("its colours over another range", stretched);
  CSLF_CHECK_NEAR(mapper->GetLookupTable()->GetRange()[1], 0.9, 1e-12);
  CSLF_CHECK(mapper->GetLookupTable() == told);
  // A change of the mapper's table counts as a table that is set.
  for (int i = 0; i < 256; ++i)
  {
    told->SetTableValue(i, 0.2, 0.7, 0.3);
    stretched->SetTableValue(i, 0.2, 0.7, 0.3);
  }
  stretched->UseBelowRangeColorOn();
  told->SetBelowRangeColor(1.0, 0.0, 0.0, 1.0);
  stretched->SetBelowRangeColor(1.0, 0.0, 0.0, 1.0);
  sphere.Check("its table, changed", stretched);

  // A plain colour.
  mapper->ScalarVisibilityOff();
  sphere.Actor->GetProperty()->SetDiffuseColor(0.7, 0.3, 0.5);
  Table plain = MakeRainbow(-1.0, 1.0, 2);
  plain->SetTableValue(0, 0.7, 0.3, 0.5);
  plain->SetTableValue(1, 0.7, 0.3, 0.5);
  sphere.Check("plain", plain);
  CSLF_CHECK(sphere.TakeWarning().empty());

  // A copy has what was set, and not more.
  vtkNew<vtkCSLFMapper> copy;
  const auto original = MakeMapper(geometry);
  copy->ShallowCopy(original);
  original->SetLookupTable(steps);
  copy->SetPixelSamples(1);
  sphere.Actor->SetMapper(copy);
  sphere.Check("a copy", own);
  copy->ShallowCopy(original);
  steps->SetTableRange(-Radius, Radius);
  sphere.Check("a copy with a table", steps);
}

/// Logarithmic scales, and what is no number.
void TestScales()
{
  MapLook look;
  look.Scalar = [](const double* point) { return std::pow(10.0, 2.0 * point[2]); };
  const auto geometry = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  const Table own = MakeRainbow(0.02, 50.0, 6);
  own->SetScaleToLog10();
  AddColors(geometry, own, look);
  MapComparison sphere(geometry);
  sphere.Check("logarithmic", own);
  const Table steps = MakeSteps(0.1, 20.0);
  sphere.Mapper->SetLookupTable(steps);
  sphere.Mapper->SetScalarRange(0.1, 20.0);
  sphere.Check("linear instead", steps);
  steps->SetScaleToLog10();
  sphere.Check("logarithmic again", steps);
  sphere.Mapper->SetScalarRange(-1.0, 20.0);
  sphere.Check("from below 0", own);
  CSLF_CHECK(!sphere.TakeWarning().empty());

  // Transfer functions have ranges of their own.
  vtkNew<vtkColorTransferFunction> function;
  function->AddRGBPoint(0.1, 0.9, 0.1, 0.1);
  function->AddRGBPoint(10.0, 0.1, 0.1, 0.9);
  sphere.Mapper->SetLookupTable(function);
  Table sampled = Table::New();
  sampled->SetNumberOfTableValues(1024);
  sampled->SetTableRange(0.1, 10.0);
  for (int i = 0; i < 1024; ++i)
  {
    double color[3];
    function->GetColor(0.1 + 9.9 * (i + 0.5) / 1024.0, color);
    sampled->SetTableValue(i, color[0], color[1], color[2]);
  }
  sphere.Check("a transfer function", sampled);

  MapLook holes;
  holes.Scalar = [](const double* point) { return point[0] > 0.1 ? vtkMath::Nan() : point[2]; };
  const auto other = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  const Table withNaN = MakeSteps(-0.4, 0.4);
  AddColors(other, withNaN, holes);
  MapComparison partly(other);
  partly.Check("no numbers", withNaN);
  const Table rainbow = MakeRainbow(-0.4, 0.4, 12);
  rainbow->SetNanColor(0.1, 0.8, 0.9, 1.0);
  partly.Mapper->SetLookupTable(rainbow);
  partly.Check("no numbers in another table", rainbow);
}

/// A field's arrays of scalars may have ends that floats round to values beyond.
void TestRounding()
{
  for (const double end : { 0.1, 0.3, 0.7, 1e-3, 12345.678 })
  {
    const ColorMap map = cslf::MakeColorMap(MakeSteps(-end, end));
    for (const double value : { -end, end })
    {
      const float column = map.GetPlace(static_cast<float>(value)).x;
      CSLF_CHECK(column > 1.0f && column < 8.0f);
    }
    CSLF_CHECK(map.GetPlace(1.001 * end).x > 8.0f);
  }
  // A table that was not built has its colours all the same.
  vtkNew<vtkLookupTable> table;
  const ColorMap map = cslf::MakeColorMap(table);
  CSLF_CHECK(map.GetSteps() == 256 && map.Colors[1][0] == 255 && map.Colors[1][1] == 0);
}
}

int TestCSLFMapperColorMaps(int, char*[])
{
  TestRounding();
  TestTables();
  TestScales();
  return cslf::testing::Result();
}
