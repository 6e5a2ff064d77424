// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Textures with scalars of any type, with their tables and transforms, compared with what VTK
// draws.
#include "cslfTestShapes.h"
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <iostream>
#include <string>

namespace
{
using cslf::testing::ShapeComparison;

constexpr int Width = 4;
constexpr int Height = 2;

/// A square with a texture.
struct Scene
{
  explicit Scene(ShapeComparison& window)
    : Window(window)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-0.8, -0.8, 0.0);
    plane->SetPoint1(0.8, -0.8, 0.0);
    plane->SetPoint2(-0.8, 0.8, 0.0);
    plane->Update();
    this->Coordinates->DeepCopy(plane->GetOutput());
    this->Mapper->SetInputConnection(plane->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Actor->SetTexture(this->Texture);
    this->Texture->SetInputData(this->Image);
    window.ShowOnly(this->Actor);
  }

  void SetScalars(vtkDataArray* scalars, bool ofCells = false)
  {
    this->Image->Initialize();
    this->Image->SetDimensions(Width + (ofCells ? 1 : 0), Height + (ofCells ? 1 : 0), 1);
    if (ofCells)
    {
      this->Image->GetCellData()->SetScalars(scalars);
    }
    else
    {
      this->Image->GetPointData()->SetScalars(scalars);
    }
    this->Texture->Modified();
  }

  void Check(const char* name)
  {
    const double share = this->Window.Compare();
    std::cout << name << ": " << 100.0 * share << " % of " << this->Window.Covered
              << " pixels differ\n";
    CSLF_CHECK(this->Window.Covered > 1000 && share < 0.1); // pixels on edges between hues
  }

  ShapeComparison& Window;
  vtkNew<vtkPolyData> Coordinates; ///< the square, to be changed
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkTexture> Texture;
  vtkNew<vtkImageData> Image;
};

template <typename Array>
vtkSmartPointer<Array> MakeNumbers(double step)
{
  auto numbers = vtkSmartPointer<Array>::New();
  for (int i = 0; i < Width * Height; ++i)
  {
    numbers->InsertNextTuple1(step * (i * 3 % (Width * Height)));
  }
  return numbers;
}

/// Red, green, blue and yellow pixels of a type whose white is `unit`.
template <typename Array>
vtkSmartPointer<Array> MakeColors(double unit)
{
  auto colors = vtkSmartPointer<Array>::New();
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < Width * Height; ++i)
  {
    const int hue = (i + i / Width) % 4;
    colors->InsertNextTuple3(
      hue == 0 || hue == 3 ? unit : 0.0, hue == 1 || hue == 3 ? unit : 0.0, hue == 2 ? unit : 0.0);
  }
  return colors;
}

void TestTypes(ShapeComparison& window)
{
  Scene scene(window);
  scene.SetScalars(MakeColors<vtkUnsignedCharArray>(255.0));
  scene.Check("Bytes");
  scene.SetScalars(MakeColors<vtkUnsignedCharArray>(255.0), true);
  scene.Check("Bytes of cells");

  scene.SetScalars(MakeNumbers<vtkDoubleArray>(0.125));
  scene.Check("Doubles without a table");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(4);
  table->SetRange(0.0, 7.0);
  table->SetTableValue(0, 1.0, 0.0, 0.0);
  table->SetTableValue(1, 0.0, 1.0, 0.0);
  table->SetTableValue(2, 0.0, 0.0, 1.0);
  table->SetTableValue(3, 1.0, 1.0, 0.0);
  scene.Texture->SetLookupTable(table);
  scene.SetScalars(MakeNumbers<vtkFloatArray>(1.0));
  scene.Check("Floats by a table");
  scene.SetScalars(MakeNumbers<vtkUnsignedShortArray>(1.0));
  scene.Check("Numbers of 16 bits by a table");
  scene.SetScalars(MakeNumbers<vtkUnsignedCharArray>(1.0));
  scene.Texture->SetColorModeToMapScalars();
  scene.Check("Bytes by a table");

  // A change of the table is detected.
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(window.Renderer);
  const vtkMTimeType time = importer->GetMTime();
  table->SetTableValue(0, 0.0, 1.0, 1.0);
  CSLF_CHECK(importer->GetMTime() > time);
  scene.Check("Another table");

  scene.Texture->SetColorModeToDirectScalars();
  scene.SetScalars(MakeColors<vtkFloatArray>(1.0));
  scene.Check("Floats as colours");
  scene.SetScalars(MakeColors<vtkUnsignedShortArray>(65535.0));
  scene.Check("16 bits as colours");
}

/// Images in any plane, of one row or one column, as a texture. The first axis with more than one
/// pixel is that of the columns.
void TestPlanes(ShapeComparison& window)
{
  Scene scene(window);
  struct Case
  {
    const char* Name;
    int Dimensions[3];
    int Size[2];
  };
  const Case cases[] = { { "XY", { 4, 2, 1 }, { 4, 2 } }, { "XZ", { 4, 1, 2 }, { 4, 2 } },
    { "YZ", { 1, 4, 2 }, { 4, 2 } }, { "X", { 8, 1, 1 }, { 8, 1 } }, { "Y", { 1, 8, 1 }, { 8, 1 } },
    { "Z", { 1, 1, 8 }, { 1, 8 } } };
  for (const Case& image : cases)
  {
    for (const bool ofCells : { false, true })
    {
      int extent[6];
      for (int axis = 0; axis < 3; ++axis)
      {
        const int pixels = image.Dimensions[axis];
        extent[2 * axis] = 5 - axis; // not from 0
        extent[2 * axis + 1] = 5 - axis + pixels - (ofCells && pixels > 1 ? 0 : 1);
      }
      scene.Image->Initialize();
      scene.Image->SetExtent(extent);
      const auto colors = MakeColors<vtkUnsignedCharArray>(255.0);
      vtkDataSetAttributes* attributes = scene.Image->GetPointData();
      if (ofCells)
      {
        attributes = scene.Image->GetCellData();
      }
      attributes->SetScalars(colors);
      scene.Texture->Modified();
      const std::string name = std::string(image.Name) + (ofCells ? ", of cells" : "");
      scene.Check(name.c_str());
      vtkNew<vtkPolyData> data;
      vtkNew<vtkImageData> read;
      bool repeat = false;
      bool smooth = false;
      CSLF_CHECK(vtkCSLFMaterial::SetTextureFrom(data, 0, scene.Texture));
      CSLF_CHECK(vtkCSLFMaterial::GetTexture(data, 0, read, repeat, smooth));
      CSLF_CHECK_NEAR(read->GetDimensions()[0], image.Size[0], 0);
      CSLF_CHECK_NEAR(read->GetDimensions()[1], image.Size[1], 0);
    }
  }

  // Another array than the scalars.
  const auto colors = MakeColors<vtkUnsignedCharArray>(255.0);
  colors->SetName("Colors");
  scene.SetScalars(MakeNumbers<vtkDoubleArray>(1.0));
  scene.Image->GetPointData()->AddArray(colors);
  scene.Texture->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Colors");
  scene.Check("Array by name");
}

/// A texture of three dimensions is left out with a warning.
void TestVolume()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  image->GetPointData()->SetScalars(MakeColors<vtkUnsignedCharArray>(255.0));
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkOutputWindow::GetInstance()->AddObserver(vtkCommand::WarningEvent, messages);
  vtkNew<vtkPolyData> data;
  CSLF_CHECK(!vtkCSLFMaterial::SetTextureFrom(data, vtkCSLFMaterial::BaseColorTexture, texture));
  vtkOutputWindow::GetInstance()->RemoveObservers(vtkCommand::WarningEvent);
  CSLF_CHECK(messages->GetWarningMessage().find("three-dimensional") != std::string::npos);
}

/// A texture whose table is empty is left out.
void TestEmptyTable()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(Width, Height, 1);
  image->GetPointData()->SetScalars(MakeNumbers<vtkFloatArray>(1.0));
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(0);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetLookupTable(table);
  vtkNew<vtkPolyData> data;
  vtkCSLFMaterial::SetTextureFrom(data, vtkCSLFMaterial::BaseColorTexture, texture);
  vtkNew<vtkImageData> found;
  bool repeat = false;
  bool smooth = false;
  CSLF_CHECK(
    !vtkCSLFMaterial::GetTexture(data, vtkCSLFMaterial::BaseColorTexture, found, repeat, smooth));
}

void TestTransform(ShapeComparison& window)
{
  Scene scene(window);
  scene.SetScalars(MakeColors<vtkUnsignedCharArray>(255.0));
  vtkNew<vtkTransform> transform;
  transform->Translate(0.3, 0.1, 0.0);
  transform->RotateZ(30.0);
  transform->Scale(1.0, 0.7, 1.0);
  scene.Texture->SetTransform(transform);
  scene.Check("Transformed");
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(window.Renderer);
  const vtkMTimeType time = importer->GetMTime();
  transform->RotateZ(-10.0);
  CSLF_CHECK(importer->GetMTime() > time);
  scene.Texture->RepeatOff();
  scene.Check("Transformed, with edges");
}

/// Textures of the property, which VTK also draws if the surface is not PBR.
void TestOfProperty(ShapeComparison& window)
{
  Scene scene(window);
  scene.SetScalars(MakeColors<vtkUnsignedCharArray>(255.0));
  scene.Actor->SetTexture(nullptr);
  vtkProperty* property = scene.Actor->GetProperty();
  property->SetTexture("anything", scene.Texture);
  scene.Check("Of the property");
  property->SetTexture("normalTex", scene.Texture); // drawn by PBR only
  scene.Check("Of the property, beside one of PBR");

  vtkNew<vtkCSLFSceneImporter> importer;
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->SetRenderer(window.Renderer);
  importer->Update();
  CSLF_CHECK(!messages->GetWarning());
  scene.Actor->SetTexture(scene.Texture);
  importer->Update();
  CSLF_CHECK(messages->GetWarningMessage().find("several textures") != std::string::npos);
}

/// Pixels of that many components that differ little, so that it does not matter whether they
/// become linear before interpolation.
vtkSmartPointer<vtkUnsignedCharArray> MakePixels(int components)
{
  auto pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  pixels->SetNumberOfComponents(components);
  pixels->SetNumberOfTuples(Width * Height);
  for (int i = 0; i < Width * Height; ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const bool isAlpha = components % 2 == 0 && c == components - 1;
      pixels->SetTypedComponent(
        i, c, isAlpha ? 255 : static_cast<unsigned char>(170 + 80 * (5 * i + 3 * c) % 81));
    }
  }
  return pixels;
}

/// The continuation beyond the image, for each wrap, with and without interpolation, on classic and
/// on physically based surfaces.
void TestWraps(ShapeComparison& window)
{
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  camera->SetParallelScale(0.75); // the square alone, without its silhouette
  const char* const names[] = { "edge", "repeat", "mirrored repeat", "border" };
  for (int wrap = vtkTexture::ClampToEdge; wrap <= vtkTexture::ClampToBorder; ++wrap)
  {
    for (int kind = 0; kind < 10; ++kind)
    {
      const bool interpolate = kind % 2 != 0;
      const bool isPhysical = kind >= 8;
      const int components = isPhysical ? 3 : kind / 2 + 1;
      Scene scene(window);
      scene.SetScalars(MakePixels(components));
      scene.Texture->SetInterpolate(interpolate);
      scene.Texture->SetWrap(wrap);
      scene.Texture->SetBorderColor(0.7f, 0.8f, 0.9f, 1.0f);
      // The image is in the middle, one of three by three.
      vtkDataArray* coordinates = scene.Coordinates->GetPointData()->GetTCoords();
      for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
      {
        coordinates->SetTuple2(i, 3.4 * coordinates->GetComponent(i, 0) - 1.2,
          3.2 * coordinates->GetComponent(i, 1) - 1.1);
      }
      scene.Mapper->SetInputData(scene.Coordinates);
      if (isPhysical)
      {
        scene.Actor->GetProperty()->SetInterpolationToPBR();
        scene.Texture->UseSRGBColorSpaceOn();
        scene.Actor->GetProperty()->SetBaseColorTexture(scene.Texture);
        scene.Actor->SetTexture(nullptr);
      }
      cslf::testing::BakeOptions options;
      options.Samples = 4;
      const auto pictures = cslf::testing::DrawAndTrace(window.Renderer, 97, options);
      // Physically based surfaces differ by 5 levels if they do not quite face the light.
      const int tolerance = isPhysical ? 6 : 4;
      const double part = pictures.GetPartOutside(tolerance);
      std::cout << names[wrap] << (interpolate ? ", interpolated, " : ", nearest, ") << components
                << (isPhysical ? " components, PBR: " : " components: ") << 100.0 * part
                << " % of the pixels differ by more than " << tolerance << "\n";
      CSLF_CHECK(part < 0.001);
    }
  }
  camera->SetParallelScale(1.0);

  // A change of the border is detected.
  vtkNew<vtkCSLFSceneImporter> importer;
  Scene scene(window);
  scene.SetScalars(MakePixels(3));
  importer->SetRenderer(window.Renderer);
  const vtkMTimeType time = importer->GetMTime();
  scene.Texture->SetBorderColor(0.1f, 0.0f, 0.0f, 1.0f);
  CSLF_CHECK(importer->GetMTime() > time);
}
}

int TestCSLFSceneImporterTextures(int, char*[])
{
  ShapeComparison window;
  TestTypes(window);
  TestPlanes(window);
  TestVolume();
  TestEmptyTable();
  TestTransform(window);
  TestOfProperty(window);
  TestWraps(window);
  return cslf::testing::Result();
}
