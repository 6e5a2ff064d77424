// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Composite data of a renderer, with blocks of different appearance; and PBR textures of actors.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkTexture.h>

#include <string>

namespace
{
vtkSmartPointer<vtkPolyData> MakeSquare()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkSmartPointer<vtkPolyData> square = plane->GetOutput();
  return square;
}

vtkPolyData* GetBlock(vtkCSLFSceneImporter* importer, unsigned int index)
{
  importer->Update();
  return vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(index));
}

void TestComposite()
{
  auto inner = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  inner->SetBlock(0, MakeSquare());
  inner->SetBlock(1, MakeSquare());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeSquare());
  blocks->SetBlock(1, inner);
  blocks->SetBlock(2, vtkSmartPointer<vtkImageData>::New()); // empty
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetCompositeDataDisplayAttributes(attributes);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.0, 0.0, 1.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  CSLF_CHECK(GetBlock(importer, 0) && importer->GetOutput()->GetNumberOfBlocks() == 4);

  // A colour of a block applies to all its children; an opacity of one of them.
  const double red[3] = { 1.0, 0.0, 0.0 };
  const vtkMTimeType time = importer->GetMTime();
  attributes->SetBlockColor(inner, red);
  attributes->SetBlockOpacity(inner->GetBlock(1), 0.25);
  attributes->Modified();
  CSLF_CHECK(importer->GetMTime() > time);
  for (unsigned int i = 0; i < 3; ++i)
  {
    double color[3];
    vtkCSLFMaterial::GetBaseColor(GetBlock(importer, i), color);
    CSLF_CHECK(color[0] == (i == 0 ? 0.0 : 1.0) && color[2] == (i == 0 ? 1.0 : 0.0));
    CSLF_CHECK(vtkCSLFMaterial::GetOpacity(GetBlock(importer, i)) == (i == 2 ? 0.25 : 1.0));
  }
  attributes->SetBlockVisibility(inner, false);
  attributes->Modified();
  CSLF_CHECK(GetBlock(importer, 0) && importer->GetOutput()->GetNumberOfBlocks() == 2);
}

/// Blocks without the array may have the colour of NaN.
void TestMissingArrays()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  values->SetNumberOfTuples(4);
  values->FillValue(0.0);
  blocks->SetBlock(0, MakeSquare());
  vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetPointData()->SetScalars(values);
  blocks->SetBlock(1, MakeSquare());
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(1.0, 0.0, 1.0, 1.0);
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Values");
  mapper->SetLookupTable(table);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.0, 1.0, 0.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  for (bool asNaN : { false, true })
  {
    mapper->SetColorMissingArraysWithNanColor(asNaN);
    double color[3];
    vtkCSLFMaterial::GetBaseColor(GetBlock(importer, 1), color);
    CSLF_CHECK_NEAR(color[0], asNaN ? 1.0 : 0.0, 1e-9);
    CSLF_CHECK_NEAR(color[1], asNaN ? 0.0 : 1.0, 1e-9);
    CSLF_CHECK(GetBlock(importer, 0)->GetPointData()->GetScalars());
    CSLF_CHECK(!GetBlock(importer, 1)->GetPointData()->GetScalars());
  }
}

/// Cells with normals, whose points have none, are shaded with the cells' normals.
void TestCellNormals()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(2, 1);
  plane->Update();
  vtkPolyData* data = plane->GetOutput();
  data->GetPointData()->SetNormals(nullptr);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(0.6, 0.0, 0.8);
  normals->InsertNextTuple3(0.0, 0.0, 1.0);
  data->GetCellData()->SetNormals(normals);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->EdgeVisibilityOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  vtkPolyData* block = GetBlock(importer, 0);
  vtkDataArray* shown = block->GetPointData()->GetNormals();
  CSLF_CHECK(block->GetNumberOfPoints() == 8 && block->GetNumberOfPolys() == 2 && shown);
  for (vtkIdType cell = 0; shown && cell < 2; ++cell)
  {
    vtkNew<vtkIdList> corners;
    block->GetCellPoints(cell, corners);
    for (vtkIdType i = 0; i < 4; ++i)
    {
      const double x = shown->GetComponent(corners->GetId(i), 0);
      CSLF_CHECK_NEAR(x, cell == 0 ? 0.6 : 0.0, 1e-6);
      const double place = block->GetPoint(corners->GetId(i))[0];
      CSLF_CHECK(cell == 0 ? place <= 0.0 : place >= 0.0);
    }
  }
  CSLF_CHECK(GetBlock(importer, 1)->GetNumberOfPoints() == 6); // edges, each once
}

void TestPhysicalTextures()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> colors;
  colors->SetInputData(image);
  colors->UseSRGBColorSpaceOn();
  vtkNew<vtkTexture> numbers;
  numbers->SetInputData(image);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeSquare());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPBR();
  property->SetBaseColorTexture(colors);
  property->SetORMTexture(numbers);
  property->SetEmissiveFactor(1.0, 2.0, 3.0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  vtkNew<vtkImageData> read;
  bool repeat = false;
  bool interpolate = false;
  const auto has = [&](int slot)
  { return vtkCSLFMaterial::GetTexture(GetBlock(importer, 0), slot, read, repeat, interpolate); };
  CSLF_CHECK(has(vtkCSLFMaterial::BaseColorTexture));
  CSLF_CHECK(has(vtkCSLFMaterial::MetallicRoughnessTexture));
  CSLF_CHECK(!has(vtkCSLFMaterial::NormalTexture) && !has(vtkCSLFMaterial::EmissionTexture));
  const vtkMTimeType time = importer->GetMTime();
  image->Modified();
  CSLF_CHECK(importer->GetMTime() > time);

  // A transform of the coordinates, as set by the glTF importer: v is reversed.
  vtkDataArray* coordinates = GetBlock(importer, 0)->GetPointData()->GetTCoords();
  CSLF_CHECK(coordinates && coordinates->GetComponent(0, 1) == 0.0);
  double turn[16] = { 1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1 };
  vtkNew<vtkInformation> keys;
  keys->Set(cslf::TextureTransformKey(), turn, 16);
  actor->SetPropertyKeys(keys);
  actor->Modified();
  coordinates = GetBlock(importer, 0)->GetPointData()->GetTCoords();
  CSLF_CHECK(coordinates && coordinates->GetComponent(0, 1) == 1.0);
}

void TestFieldInItsOwnScene()
{
  // A light field in the scene that is being sampled does not sample itself.
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeSquare());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetRenderer(renderer);
  sampler->SetViewpoints(2);
  sampler->SetResolution(4);
  sampler->SetSamples(1);
  vtkNew<vtkCSLFMapper> fieldMapper;
  fieldMapper->SetInputConnection(sampler->GetOutputPort());
  vtkNew<vtkActor> field;
  field->SetMapper(fieldMapper);
  renderer->AddActor(field);
  sampler->Update();
  CSLF_CHECK(sampler->GetOutput()->GetNumberOfPoints() > 0);
  vtkNew<vtkCSLFSceneImporter> importer;
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->SetRenderer(renderer);
  CSLF_CHECK(GetBlock(importer, 0) && importer->GetOutput()->GetNumberOfBlocks() == 2);
  CSLF_CHECK(messages->GetWarningMessage().find("vtkCSLFMapper") != std::string::npos);
}
}

int TestCSLFSceneImporterBlocks(int, char*[])
{
  TestComposite();
  TestMissingArrays();
  TestCellNormals();
  TestPhysicalTextures();
  TestFieldInItsOwnScene();
  return cslf::testing::Result();
}
