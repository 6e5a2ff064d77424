// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays that gave a geometry no colours are shown as VTK's own mapper shows them: scalars, and
// components and magnitudes of vectors, also on surfaces of one colour.
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfTestColorMaps.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace
{
using cslf::testing::CountDifferent;
using cslf::testing::MakeRainbow;
using cslf::testing::MakeSphere;
using cslf::testing::MakeSteps;
using cslf::testing::MapComparison;
using cslf::testing::MapLook;
using cslf::testing::MapSize;
using cslf::testing::Table;
using cslf::testing::View;

constexpr double Radius = 0.8;

/// The share of pixels at the edges of bands, where both may round to either side.
constexpr double MaximumShare = 0.002;

/// A sphere in white light with scalars `Height`, and the arrays `Side`, which has what is not a
/// number, and `Flow` of three components. With `isPlain`, it has one colour instead of scalars.
vtkSmartPointer<vtkPolyData> MakeGeometry(bool isPlain)
{
  const auto geometry = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 60);
  MapLook look;
  look.Front = 1.0;
  look.Back = 1.0;
  AddColors(geometry, MakeRainbow(-Radius, Radius), look);
  cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  if (isPlain)
  {
    points.Maps = { cslf::MakeOneColor({ 200, 100, 50, 255 }) };
    geometry->GetPointData()->RemoveArray("Height");
  }
  points.Arrays.resize(2);
  points.Arrays[0].Name = "Side";
  points.Arrays[0].Components.resize(1);
  points.Arrays[1].Name = "Flow";
  points.Arrays[1].Components = { { "X", {} }, { "Y", {} }, { "Z", {} } };
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const double* place = geometry->GetPoint(i);
    points.Arrays[0].Components[0].Values.push_back(
      place[1] > 0.5 ? vtkMath::Nan() : 10.0 + place[0]);
    points.Arrays[1].Components[0].Values.push_back(place[2]);
    points.Arrays[1].Components[1].Values.push_back(2.0 * place[1]);
    points.Arrays[1].Components[2].Values.push_back(place[0] - 1.0);
  }
  AddMappedPoints(points, geometry);
  return geometry;
}

/// Compares pictures with those of VTK.
class ArrayComparison
{
public:
  explicit ArrayComparison(vtkPolyData* geometry)
    : Pair(geometry)
  {
  }

  vtkCSLFMapper* Get() { return this->Pair.Mapper; }

  /// Sets up both mappers alike, and draws them.
  void Check(const std::string& name, const std::function<void(vtkMapper*)>& setUp)
  {
    vtkNew<vtkPolyData> surface;
    surface->DeepCopy(this->Pair.Geometry);
    if (vtkDataArray* height = surface->GetPointData()->GetArray("Height"))
    {
      height->SetLookupTable(nullptr);
    }
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(surface);
    mapper->SetScalarModeToUsePointFieldData();
    mapper->InterpolateScalarsBeforeMappingOn();
    this->Get()->ColorByArrayComponent("Side", -1); // the default
    setUp(mapper);
    setUp(this->Get());
    View view(MapSize);
    view.GetCamera()->DeepCopy(this->Pair.Field.GetCamera());
    view.Add(mapper)->GetProperty()->LightingOff();
    const double share = CountDifferent(this->Pair.Field.Render(), view.Render());
    std::cout << name << ": " << 100.0 * share << " % of the pixels differ.\n";
    CSLF_CHECK(share <= MaximumShare);
    const std::string warning = this->Pair.TakeWarning();
    std::cout << warning;
    CSLF_CHECK(warning.empty());
  }

  MapComparison Pair;
};

void Select(vtkMapper* mapper, const char* array, vtkLookupTable* table)
{
  mapper->SelectColorArray(array);
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
}

void TestArrays(bool isPlain)
{
  ArrayComparison pair(MakeGeometry(isPlain));
  pair.Check("an array",
    [](vtkMapper* mapper)
    {
      const Table table = MakeRainbow(9.2, 10.6);
      table->SetNanColor(0.2, 0.9, 0.4, 1.0);
      Select(mapper, "Side", table);
    });
  pair.Check("the mapper's range",
    [](vtkMapper* mapper)
    {
      Select(mapper, "Side", MakeSteps(0.0, 1.0));
      mapper->UseLookupTableScalarRangeOff();
      mapper->SetScalarRange(9.5, 10.5);
    });
  for (const int component : { 0, 1, 2 })
  {
    pair.Check("the table's component " + std::to_string(component),
      [component](vtkMapper* mapper)
      {
        const Table table = MakeSteps(-0.5, 0.7);
        table->SetVectorModeToComponent();
        table->SetVectorComponent(component);
        Select(mapper, "Flow", table);
      });
  }
  pair.Check("magnitude",
    [](vtkMapper* mapper)
    {
      const Table table = MakeRainbow(0.5, 2.0, 16);
      table->SetVectorModeToMagnitude();
      Select(mapper, "Flow", table);
    });
  pair.Check("the mapper's component",
    [](vtkMapper* mapper)
    {
      const Table table = MakeRainbow(-1.0, 1.0, 32);
      Select(mapper, "Flow", table);
      // VTK's mapper follows its own component only if it maps before it interpolates.
      if (vtkCSLFMapper::SafeDownCast(mapper))
      {
        mapper->ColorByArrayComponent("Flow", 2);
      }
      else
      {
        table->SetVectorComponent(2);
      }
    });
  pair.Check("a logarithm",
    [](vtkMapper* mapper)
    {
      const Table table = MakeRainbow(8.0, 11.0, 20);
      table->SetScaleToLog10();
      Select(mapper, "Side", table);
    });
}

/// Names with components, ranges that the mapper tells, and what is not there.
void TestNames()
{
  ArrayComparison pair(MakeGeometry(true));
  vtkCSLFMapper* mapper = pair.Get();
  const auto own = pair.Pair.Field.Render();
  mapper->SelectColorArray("Flow Y");
  CSLF_CHECK_NEAR(mapper->GetScalarRange()[1], 2.0 * Radius, 0.01);
  CSLF_CHECK_NEAR(mapper->GetLookupTable()->GetRange()[1], 2.0 * Radius, 0.01);
  CSLF_CHECK(CountDifferent(pair.Pair.Field.Render(), own) > 0.5);
  mapper->SelectColorArray("Flow Magnitude");
  // The most of z^2 + 4 y^2 + (x - 1)^2 on the sphere is at x = -1/3, z = 0.
  CSLF_CHECK_NEAR(mapper->GetScalarRange()[1], std::sqrt(4.0 * Radius * Radius + 4.0 / 3.0), 0.01);
  mapper->SelectColorArray("Side");
  CSLF_CHECK_NEAR(mapper->GetScalarRange()[0], 10.0 - Radius, 0.01);
  // Surfaces of one colour keep it without scalars.
  mapper->ScalarVisibilityOff();
  CSLF_CHECK(CountDifferent(pair.Pair.Field.Render(), own) == 0.0);
  mapper->ScalarVisibilityOn();
  CSLF_CHECK(pair.Pair.TakeWarning().empty());
  mapper->SelectColorArray("Depth");
  CSLF_CHECK(CountDifferent(pair.Pair.Field.Render(), own) == 0.0);
  CSLF_CHECK(pair.Pair.TakeWarning().find("Depth") != std::string::npos);
}
}

int TestCSLFMapperArrays(int, char*[])
{
  TestArrays(false);
  TestArrays(true);
  TestNames();
  return cslf::testing::Result();
}
