// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The look of data without one: which arrays colour it, how, which light it gets, and what is kept.
#include "Options/cslfOptionTable.h"
#include "cslfOptionChecks.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneLook.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <limits>
#include <string>

namespace
{
using Look = vtkCSLFSceneLook;

/// A sphere with normals and active scalars: from the first value to the last one.
vtkSmartPointer<vtkPolyData> MakeSphere(double first, double last)
{
  vtkNew<vtkSphereSource> source;
  source->Update();
  vtkSmartPointer<vtkPolyData> sphere = source->GetOutput();
  const vtkIdType count = sphere->GetNumberOfPoints();
  vtkNew<vtkFloatArray> heat;
  heat->SetName("heat");
  heat->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    heat->SetValue(i, static_cast<float>(first + (last - first) * share));
  }
  sphere->GetPointData()->SetScalars(heat);
  return sphere;
}

vtkPolyData* GetSurface(Look* look, unsigned int block)
{
  return vtkPolyData::SafeDownCast(look->GetOutput()->GetBlock(block));
}

vtkDataArray* GetScalars(Look* look, unsigned int block = 0)
{
  return GetSurface(look, block)->GetPointData()->GetScalars();
}

std::string GetLegend(Look* look, const char* column, vtkIdType row = 0)
{
  return look->GetLegend()->GetValueByName(row, column).ToString();
}

/// Scalars that vary colour both inputs by one table; the inputs are as before.
void TestVarying()
{
  const auto first = MakeSphere(0.0, 2.0);
  const auto second = MakeSphere(-3.0, 1.0);
  vtkDataArray* before = first->GetPointData()->GetScalars();
  const auto time = first->GetMTime();
  vtkNew<Look> look;
  look->AddInputDataObject(first);
  look->AddInputDataObject(second);
  look->Update();
  CSLF_CHECK(look->GetOutput()->GetNumberOfBlocks() == 2);
  vtkLookupTable* table = GetScalars(look)->GetLookupTable();
  CSLF_CHECK(table && table == GetScalars(look, 1)->GetLookupTable());
  CSLF_CHECK(table->GetTableRange()[0] == -3.0 && table->GetTableRange()[1] == 2.0);
  double color[3];
  table->GetColor(2.0, color);
  CSLF_CHECK_NEAR(color[0], 180.0 / 255.0, 0.01);
  CSLF_CHECK_NEAR(color[2], 38.0 / 255.0, 0.01);
  CSLF_CHECK(GetScalars(look)->GetVoidPointer(0) == before->GetVoidPointer(0));
  CSLF_CHECK(first->GetMTime() == time && first->GetPointData()->GetScalars() == before);
  CSLF_CHECK(!before->GetLookupTable());
  CSLF_CHECK(look->GetLegend()->GetNumberOfRows() == 1);
  CSLF_CHECK(GetLegend(look, "array") == "heat" && GetLegend(look, "component").empty());
  CSLF_CHECK(GetLegend(look, "minimum") == "-3" && GetLegend(look, "map") == "cool-to-warm");
}

/// Scalars of one value colour only if they are named.
void TestConstant()
{
  vtkNew<Look> look;
  look->SetInputDataObject(MakeSphere(5.0, 5.0));
  look->Update();
  CSLF_CHECK(!GetScalars(look) && look->GetLegend()->GetNumberOfRows() == 0);
  look->SetColorArrayName("heat");
  look->Update();
  CSLF_CHECK(GetScalars(look) && GetLegend(look, "minimum") == "4.5");
  look->SetColorArrayName("none");
  look->Update();
  CSLF_CHECK(!GetScalars(look));
}

void TestComponents()
{
  vtkNew<Look> look;
  look->SetInputDataObject(MakeSphere(0.0, 1.0));
  look->SetColorArrayName("Normals");
  look->Update();
  CSLF_CHECK(GetLegend(look, "component") == "magnitude");
  CSLF_CHECK(GetSurface(look, 0)->GetPointData()->GetNormals() == GetScalars(look));
  look->SetColorComponent("y");
  look->SetColorMapToViridis();
  look->Update();
  CSLF_CHECK(GetLegend(look, "component") == "1" && GetLegend(look, "map") == "viridis");
  look->SetColorComponent("");
  look->SetColorArrayName("Normals:2");
  look->Update();
  CSLF_CHECK(GetLegend(look, "component") == "2" && GetLegend(look, "array") == "Normals");
  CSLF_CHECK(GetScalars(look)->GetLookupTable()->GetVectorComponent() == 2);
}

/// Colours that the data has are kept; an array's own table can be replaced.
void TestOwnColors()
{
  const auto mapped = MakeSphere(0.0, 1.0);
  vtkNew<vtkLookupTable> own;
  mapped->GetPointData()->GetScalars()->SetLookupTable(own);
  const auto colored = MakeSphere(0.0, 1.0);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(colored->GetNumberOfPoints());
  colors->Fill(7.0);
  colored->GetPointData()->SetScalars(colors);
  const auto finished = MakeSphere(0.0, 1.0);
  vtkCSLFMaterial::SetFinishedColors(finished, true);
  vtkNew<Look> look;
  for (vtkPolyData* input : { mapped.Get(), colored.Get(), finished.Get() })
  {
    look->AddInputDataObject(input);
  }
  look->Update();
  CSLF_CHECK(GetScalars(look)->GetLookupTable() == own);
  CSLF_CHECK(GetScalars(look, 1) == colors && !colors->GetLookupTable());
  CSLF_CHECK(GetScalars(look, 2) == finished->GetPointData()->GetScalars());
  CSLF_CHECK(look->GetLegend()->GetNumberOfRows() == 0);
  look->AutomaticColorRangeOff();
  look->SetColorRange(-1.0, 4.0);
  look->Update();
  CSLF_CHECK(GetScalars(look)->GetLookupTable() != own && GetLegend(look, "maximum") == "4");
  CSLF_CHECK(mapped->GetPointData()->GetScalars()->GetLookupTable() == own);
}

/// What the root of composite data says goes on to its blocks, lights to a block of their own.
/// Other data sets become surfaces.
void TestComposite()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, image);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeSphere(0.0, 1.0));
  blocks->SetBlock(2, nested);
  vtkCSLFMaterial::SetMetallic(blocks, 0.5);
  const double towards[3] = { 0.0, -1.0, 0.0 };
  const double white[3] = { 1.0, 1.0, 1.0 };
  vtkCSLFLight::AddDirectionalLight(blocks, towards, white);
  vtkNew<vtkPartitionedDataSetCollection> parts;
  parts->SetPartition(0, 0, MakeSphere(0.0, 1.0));
  vtkNew<Look> look;
  look->AddInputDataObject(blocks);
  look->AddInputDataObject(parts);
  look->Update();
  vtkMultiBlockDataSet* output = look->GetOutput();
  CSLF_CHECK(output->GetNumberOfBlocks() == 3);
  const char* direction = vtkCSLFLight::DirectionalLightDirection();
  CSLF_CHECK(output->GetBlock(0)->GetFieldData()->HasArray(direction));
  auto* copy = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(1));
  CSLF_CHECK(copy && copy->GetNumberOfBlocks() == 3 && !copy->GetBlock(1));
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(copy->GetBlock(0)) == 0.5);
  CSLF_CHECK(!copy->GetBlock(0)->GetFieldData()->HasArray(direction));
  auto* inner = vtkMultiBlockDataSet::SafeDownCast(copy->GetBlock(2));
  auto* surface = vtkPolyData::SafeDownCast(inner->GetBlock(0));
  CSLF_CHECK(surface && surface->GetNumberOfPolys() == 24);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(surface) == 0.5);
  CSLF_CHECK(GetLegend(look, "array") == "heat");
  vtkNew<vtkCSLFEnvironment> environment;
  look->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetColor()[0] == 0.5); // dim
}

/// Automatic light is updated with the inputs. All light follows the axis that is up.
void TestLights()
{
  vtkNew<vtkCSLFEnvironment> environment;
  environment->SetModeToImage();
  environment->SetFileName("image.hdr");
  vtkNew<Look> look;
  look->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetMode() == vtkCSLFEnvironment::GradientEnvironment);
  CSLF_CHECK(!environment->GetFileName() && environment->GetColor()[0] == 1.0);
  CSLF_CHECK(environment->GetUp()[0] == -0.55 && environment->GetUp()[1] == 0.75);
  look->SetUpAxisToMinusZ();
  look->SetLightToSky();
  look->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetUp()[1] == 0.0 && environment->GetUp()[2] == -1.0);
  CSLF_CHECK(look->GetOutput()->GetNumberOfBlocks() == 0);
  look->SetLightToSun();
  look->Update();
  CSLF_CHECK(look->GetOutput()->GetNumberOfBlocks() == 1); // even without inputs
  vtkDataArray* sun =
    GetSurface(look, 0)->GetFieldData()->GetArray(vtkCSLFLight::DirectionalLightDirection());
  CSLF_CHECK(sun && sun->GetComponent(0, 2) > 0.0);
  look->SetLightToWhite();
  look->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetMode() == vtkCSLFEnvironment::ConstantEnvironment);
  look->SetLightToNone();
  look->SetUpEnvironment(environment);
  CSLF_CHECK(environment->GetMode() == vtkCSLFEnvironment::NoEnvironment);
  look->SetUpEnvironment(nullptr);
  for (int axis = 0; axis < Look::NUMBER_OF_AXES; ++axis)
  {
    look->SetUpAxis(axis);
    double right[3];
    double up[3];
    double front[3];
    look->GetAxes(right, up, front);
    CSLF_CHECK(up[axis % 3] == (axis < 3 ? 1.0 : -1.0));
    CSLF_CHECK(vtkMath::Dot(right, up) == 0.0 && vtkMath::Dot(front, front) == 1.0);
    CSLF_CHECK(vtkMath::Determinant3x3(right, up, front) == 1.0);
  }
}

void ExpectError(Look* look, const std::string& text)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  look->AddObserver(vtkCommand::ErrorEvent, errors);
  look->Update();
  CSLF_CHECK(errors->GetErrorMessage().find(text) != std::string::npos);
  CSLF_CHECK(look->GetOutput()->GetNumberOfBlocks() == 0);
  CSLF_CHECK(look->GetLegend()->GetNumberOfRows() == 0);
  look->RemoveObservers(vtkCommand::ErrorEvent);
}

void TestErrors()
{
  vtkNew<Look> look;
  look->SetInputDataObject(MakeSphere(0.0, 1.0));
  look->SetColorArrayName("velocity");
  ExpectError(look, "of points: Normals (3 components), heat.");
  look->SetColorArrayName("Normals:w");
  ExpectError(look, "The array Normals has no component w: there are 0 to 2");
  look->SetColorArrayName("");
  look->SetColorComponent("1");
  ExpectError(look, "The array heat has no component 1: it has only one.");
  look->SetColorComponent("");
  look->AutomaticColorRangeOff();
  for (double low : { 1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    look->SetColorRange(low, 1.0);
    ExpectError(look, "The first number of ColorRange must be smaller");
  }
  look->AutomaticColorRangeOn();
  vtkNew<vtkImageData> field;
  vtkNew<vtkStringArray> description;
  description->SetName("CSLF");
  field->GetFieldData()->AddArray(description);
  look->SetInputDataObject(field);
  ExpectError(look, "is a light field, not a scene");
}

/// Tables get the colours of a map, and nothing else.
void TestLookupTable()
{
  vtkNew<vtkLookupTable> table;
  table->SetTableRange(3.0, 4.0);
  for (int map = 0; map < Look::NUMBER_OF_COLOR_MAPS; ++map)
  {
    Look::SetUpLookupTable(map, table);
    CSLF_CHECK(table->GetTableRange()[0] == 3.0 && table->GetTableRange()[1] == 4.0);
    double color[3];
    table->GetColor(3.0, color);
    const bool isBlue = color[2] > color[0] && color[2] > color[1];
    CSLF_CHECK(isBlue == (map != Look::Gray));
  }
  const vtkMTimeType time = table->GetMTime();
  Look::SetUpLookupTable(Look::NUMBER_OF_COLOR_MAPS, table);
  Look::SetUpLookupTable(-1, table);
  Look::SetUpLookupTable(Look::Gray, nullptr);
  CSLF_CHECK(table->GetMTime() == time);
}

void TestNames()
{
  CSLF_CHECK(std::string(Look::GetColorMapName(Look::Rainbow)) == "rainbow");
  CSLF_CHECK(std::string(Look::GetLightName(Look::SunLight)) == "sun");
  CSLF_CHECK(std::string(Look::GetUpAxisName(Look::MinusYAxis)) == "-y");
  CSLF_CHECK(!Look::GetColorMapName(-1) && !Look::GetColorMapName(Look::NUMBER_OF_COLOR_MAPS));
  CSLF_CHECK(!Look::GetLightName(Look::NUMBER_OF_LIGHTS) && !Look::GetUpAxisName(-1));
  vtkNew<Look> look;
  Look* object = look;
  namespace options = cslf::options;
  using cslf::testing::CheckOption;
  CheckOption(options::ColorMap, object, &Look::SetColorMap, &Look::GetColorMap);
  CheckOption(options::Light, object, &Look::SetLight, &Look::GetLight);
  CheckOption(options::UpAxis, object, &Look::SetUpAxis, &Look::GetUpAxis);
}
}

int TestCSLFSceneLook(int, char*[])
{
  TestVarying();
  TestConstant();
  TestComponents();
  TestOwnColors();
  TestComposite();
  TestLights();
  TestErrors();
  TestLookupTable();
  TestNames();
  return cslf::testing::Result();
}
