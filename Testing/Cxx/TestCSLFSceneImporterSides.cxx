// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Culling and properties of back faces: compares VTK's window with the traced picture for both
// sides of a square.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTestErrorObserver.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <iostream>
#include <string>

namespace
{
constexpr int Tolerance = 2; // levels of 255 from which on the two differ
constexpr int Size = 33;

/// A unit square around the origin, red with blue backs, whose front the camera sees or not. VTK
/// lights reflected surfaces with normals incorrectly, so it has none.
struct Square
{
  explicit Square(bool fromBack)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->Update();
    this->Data->ShallowCopy(plane->GetOutput());
    this->Data->GetPointData()->SetNormals(nullptr);
    this->Mapper->SetInputData(this->Data);
    this->Actor->SetMapper(this->Mapper);
    this->Front->SetColor(1.0, 0.3, 0.2);
    this->Back->SetColor(0.2, 0.4, 1.0);
    this->Actor->SetProperty(this->Front);
    this->Renderer->AddActor(this->Actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.4);
    camera->SetPosition(0.0, 0.0, fromBack ? -2.0 : 2.0);
  }

  vtkNew<vtkPolyData> Data;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkProperty> Front;
  vtkNew<vtkProperty> Back;
  vtkNew<vtkRenderer> Renderer;
};

/// Checks both sides of a modified square.
void Compare(const std::string& name, const std::function<void(Square&)>& change)
{
  for (const bool fromBack : { false, true })
  {
    Square square(fromBack);
    change(square);
    const auto pictures = cslf::testing::DrawAndTrace(square.Renderer, Size);
    const int middle = 3 * (Size * (Size / 2) + Size / 2);
    const auto print = [](const std::vector<unsigned char>& colors)
    {
      return std::to_string(colors[middle]) + " " + std::to_string(colors[middle + 1]) + " " +
        std::to_string(colors[middle + 2]);
    };
    std::cout << name << (fromBack ? ", back" : ", front") << ": window " << print(pictures.Window)
              << ", bake " << print(pictures.Bake) << "\n";
    CSLF_CHECK(pictures.GetDifferenceInMiddle() < Tolerance);
    CSLF_CHECK(pictures.GetPartOutside(Tolerance) == 0.0);
  }
}

std::string GetWarning(vtkRenderer* renderer)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->SetRenderer(renderer);
  importer->Update();
  return messages->GetWarningMessage();
}

void SetCulling(Square& square, int culling)
{
  square.Front->SetBackfaceCulling(culling & 1);
  square.Front->SetFrontfaceCulling(culling >> 1);
}

/// One glyph of the square, with a scale along x.
void ShowAsGlyph(Square& square, double scale)
{
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(0.0, 0.0, 0.0);
  vtkNew<vtkDoubleArray> scales;
  scales->SetName("Scales");
  scales->SetNumberOfComponents(3);
  scales->InsertNextTuple3(scale, 1.0, 1.0);
  vtkNew<vtkPolyData> points;
  points->SetPoints(places);
  points->GetPointData()->AddArray(scales);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetSourceData(square.Data);
  mapper->SetScaleArray("Scales");
  mapper->SetScaleModeToScaleByVectorComponents();
  square.Actor->SetMapper(mapper);
}

void TestCulling()
{
  for (int culling = 0; culling < 4; ++culling)
  {
    const std::string name = "Culling " + std::to_string(culling);
    Compare(name, [culling](Square& square) { SetCulling(square, culling); });
    Compare(name + ", reflected",
      [culling](Square& square)
      {
        SetCulling(square, culling);
        square.Actor->SetScale(-1.0, 1.0, 1.0);
      });
    Compare(name + ", reflected twice in assemblies",
      [culling](Square& square)
      {
        SetCulling(square, culling);
        square.Actor->SetScale(-1.0, 1.0, 1.0);
        square.Actor->SetOrientation(0.0, 0.0, 30.0);
        vtkNew<vtkAssembly> inner;
        inner->AddPart(square.Actor);
        inner->SetScale(1.0, 1.0, -1.0);
        vtkNew<vtkAssembly> outer;
        outer->AddPart(inner);
        outer->SetScale(1.0, 2.0, 1.0);
        square.Renderer->RemoveActor(square.Actor);
        square.Renderer->AddActor(outer);
      });
    for (const double scale : { 1.0, -1.0 })
    {
      Compare(name + ", glyph of scale " + std::to_string(scale),
        [culling, scale](Square& square)
        {
          SetCulling(square, culling);
          ShowAsGlyph(square, scale);
        });
    }
  }
}

void SetBytes(Square& square)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < 4; ++i)
  {
    colors->InsertNextTuple3(40.0, 200.0, 40.0);
  }
  square.Data->GetPointData()->SetScalars(colors);
}

void TestBackProperty()
{
  const auto compare = [](const std::string& name, const std::function<void(Square&)>& change)
  {
    Compare("Back property, " + name,
      [&change](Square& square)
      {
        square.Actor->SetBackfaceProperty(square.Back);
        change(square);
      });
  };
  compare("plain", [](Square&) {});
  compare("reflected", [](Square& square) { square.Actor->SetScale(1.0, -1.0, 1.0); });
  compare("coefficients",
    [](Square& square)
    {
      square.Front->SetDiffuse(0.6);
      square.Back->SetDiffuse(0.5);
      square.Back->SetAmbient(0.3);
    });
  compare("without lighting",
    [](Square& square)
    {
      square.Front->LightingOff();
      square.Back->SetAmbient(0.4);
      square.Back->SetDiffuse(0.3);
    });
  compare("lighting and culling of its own, which do not count",
    [](Square& square)
    {
      square.Back->LightingOff();
      square.Back->BackfaceCullingOn();
      square.Back->SetRepresentationToWireframe();
    });
  compare("fronts culled", [](Square& square) { square.Front->FrontfaceCullingOn(); });
  compare("backs culled", [](Square& square) { square.Front->BackfaceCullingOn(); });
  compare("colours of points", [](Square& square) { SetBytes(square); });
  compare("colours of cells, coefficients",
    [](Square& square)
    {
      SetBytes(square);
      square.Data->GetCellData()->SetScalars(square.Data->GetPointData()->GetScalars());
      square.Data->GetPointData()->SetScalars(nullptr);
      square.Data->GetCellData()->GetScalars()->SetNumberOfTuples(1);
      square.Front->SetDiffuse(0.5);
      square.Back->SetAmbient(0.3);
    });
  compare("lookup table",
    [](Square& square)
    {
      vtkNew<vtkFloatArray> values;
      for (int i = 0; i < 4; ++i)
      {
        values->InsertNextValue(0.5f);
      }
      square.Data->GetPointData()->SetScalars(values);
      square.Mapper->InterpolateScalarsBeforeMappingOn();
      square.Mapper->SetScalarRange(0.0, 1.0);
      square.Back->SetDiffuse(0.5);
    });
  compare("texture",
    [](Square& square)
    {
      vtkNew<vtkImageData> image;
      image->SetDimensions(2, 2, 1);
      image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
      auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
      for (int i = 0; i < 12; ++i)
      {
        pixels[i] = i % 3 == 1 ? 255 : 128;
      }
      vtkNew<vtkTexture> texture;
      texture->SetInputData(image);
      square.Actor->SetTexture(texture);
    });
  compare("blocks with colours",
    [](Square& square)
    {
      vtkNew<vtkMultiBlockDataSet> blocks;
      blocks->SetBlock(0, square.Data);
      vtkNew<vtkCompositeDataDisplayAttributes> attributes;
      const double green[3] = { 0.2, 0.7, 0.3 };
      attributes->SetBlockColor(square.Data, green);
      vtkNew<cslf::CompositeMapper> mapper;
      mapper->SetInputDataObject(blocks);
      mapper->SetCompositeDataDisplayAttributes(attributes);
      square.Actor->SetMapper(mapper);
      square.Back->SetDiffuse(0.5);
    });
}

/// A strip and a line through one block: the line stays one line.
void TestMixedCells()
{
  Square square(false);
  square.Actor->SetBackfaceProperty(square.Back);
  vtkNew<vtkCellArray> lines;
  const vtkIdType ends[2] = { 0, 3 };
  lines->InsertNextCell(2, ends);
  square.Data->SetLines(lines);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(square.Renderer);
  importer->Update();
  vtkIdType faces = 0;
  vtkIdType all = 0;
  for (unsigned int i = 0; i < importer->GetOutput()->GetNumberOfBlocks(); ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(i));
    faces += block->GetNumberOfPolys();
    all += block->GetNumberOfCells();
  }
  CSLF_CHECK(faces == 2 && all == 3);
}

/// Copies of a property use its textures, but do not release them for their other users.
void TestTextures()
{
  Square square(false);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->UseSRGBColorSpaceOn();
  square.Front->SetInterpolationToPBR();
  square.Front->SetBaseColorTexture(texture);
  square.Actor->SetBackfaceProperty(square.Back);
  const int count = texture->GetReferenceCount();
  for (int i = 0; i < 3; ++i)
  {
    CSLF_CHECK(!GetWarning(square.Renderer).empty());
    CSLF_CHECK_NEAR(texture->GetReferenceCount(), count, 0);
  }
}

void TestWarnings()
{
  Square square(false);
  square.Actor->SetBackfaceProperty(square.Back);
  square.Front->BackfaceCullingOn();
  CSLF_CHECK(GetWarning(square.Renderer).empty());
  square.Front->EdgeVisibilityOn();
  CSLF_CHECK(GetWarning(square.Renderer).find("edges of culled faces") != std::string::npos);
  square.Front->EdgeVisibilityOff();
  square.Front->SetInterpolationToPBR();
  CSLF_CHECK(
    GetWarning(square.Renderer).find("properties of back faces of PBR") != std::string::npos);
}
}

int TestCSLFSceneImporterSides(int, char*[])
{
  TestCulling();
  TestBackProperty();
  TestMixedCells();
  TestTextures();
  TestWarnings();
  return cslf::testing::Result();
}
