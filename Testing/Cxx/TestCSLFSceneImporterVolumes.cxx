// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of a renderer, compared with VTK's mapper.
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFVolume.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPointDataToCellData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRectilinearGrid.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{
constexpr int Size = 192;

/// A volume that VTK's mapper draws in fine steps.
struct Scene
{
  vtkNew<vtkRTAnalyticSource> Source;
  vtkNew<vtkGPUVolumeRayCastMapper> Mapper;
  vtkNew<vtkColorTransferFunction> Colors;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;

  Scene()
  {
    this->Source->SetWholeExtent(-32, 31, -32, 31, -32, 31);
    this->Source->Update();
    this->Mapper->SetInputConnection(this->Source->GetOutputPort());
    this->Mapper->AutoAdjustSampleDistancesOff();
    this->Mapper->SetSampleDistance(0.1f);
    double range[2];
    this->Source->GetOutput()->GetScalarRange(range);
    const auto at = [&range](double share) { return range[0] + share * (range[1] - range[0]); };
    this->Colors->AddRGBPoint(at(0.0), 0.1, 0.2, 1.0);
    this->Colors->AddRGBPoint(at(0.5), 0.2, 0.9, 0.3);
    this->Colors->AddRGBPoint(at(1.0), 1.0, 0.3, 0.0);
    this->Opacity->AddPoint(at(0.2), 0.0);
    this->Opacity->AddPoint(at(0.6), 0.05);
    this->Opacity->AddPoint(at(0.7), 0.01);
    this->Opacity->AddPoint(at(1.0), 0.3);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->GetProperty()->SetColor(this->Colors);
    this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
    this->Volume->GetProperty()->SetInterpolationTypeToLinear();
    this->Renderer->AddViewProp(this->Volume);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(90.0, 60.0, 110.0);
    camera->SetViewAngle(35.0);
  }

  /// The PSNR of the traced picture beside the window, or a given picture of it, in dB.
  double Compare(
    const char* name, double background = 0.0, const std::vector<unsigned char>* given = nullptr)
  {
    this->Renderer->ResetCameraClippingRange();
    cslf::testing::BakeOptions options;
    options.Background = background;
    const auto window =
      given ? *given : cslf::testing::DrawWindow(this->Renderer, Size, background);
    const auto bake = cslf::testing::TraceBake(this->Renderer, Size, options);
    double squares = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < window.size(); ++i)
    {
      squares += (window[i] - bake[i]) * (window[i] - bake[i]);
      sum += window[i];
    }
    const double psnr = 10.0 * std::log10(255.0 * 255.0 * window.size() / (squares + 1e-9));
    std::cout << name << ": " << psnr << " dB, mean " << sum / window.size() << "\n";
    CSLF_CHECK(sum / window.size() > 5.0);
    return psnr;
  }
};

/// The scene of a renderer as data, and the warning.
struct Import
{
  explicit Import(vtkRenderer* renderer)
  {
    vtkNew<vtkTest::ErrorObserver> messages;
    this->Filter->AddObserver(vtkCommand::WarningEvent, messages);
    this->Filter->SetRenderer(renderer);
    this->Filter->Update();
    this->Warning = messages->GetWarningMessage();
  }

  unsigned int GetCount() const { return this->Filter->GetOutput()->GetNumberOfBlocks() - 1; }
  vtkDataSet* Get(unsigned int block) const
  {
    return vtkDataSet::SafeDownCast(this->Filter->GetOutput()->GetBlock(block));
  }
  bool Warns(const char* of) const { return this->Warning.find(of) != std::string::npos; }

  vtkNew<vtkCSLFSceneImporter> Filter;
  std::string Warning;
};

void TestPictures()
{
  Scene scene;
  CSLF_CHECK(Import(scene.Renderer).Warning.empty());
  CSLF_CHECK(scene.Compare("A volume") > 50.0);
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(4.0);
  scene.Renderer->GetActiveCamera()->SetPosition(-30.0, 140.0, 20.0);
  CSLF_CHECK(scene.Compare("Another unit distance and view, over grey", 0.6) > 50.0);

  // Another place, with shear by scaling after rotation.
  scene.Volume->SetScale(1.0, 0.6, 1.2);
  scene.Volume->SetOrientation(20.0, 30.0, 0.0);
  scene.Volume->SetPosition(5.0, -10.0, 3.0);
  CSLF_CHECK(scene.Compare("A matrix") > 48.0);

  // Planes and a cropped box.
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.5, 0.0);
  scene.Mapper->AddClippingPlane(plane);
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(-32.0, 20.0, -20.0, 31.0, -32.0, 10.0);
  CSLF_CHECK(Import(scene.Renderer).Warning.empty());
  CSLF_CHECK(scene.Compare("Cut by a plane and a box") > 42.0);
}

void TestGrids()
{
  Scene scene;
  const auto import = [&scene] { return Import(scene.Renderer); };

  // Scalars of cells.
  vtkNew<vtkPointDataToCellData> cells;
  cells->SetInputConnection(scene.Source->GetOutputPort());
  scene.Mapper->SetInputConnection(cells->GetOutputPort());
  scene.Mapper->SetScalarModeToUseCellData();
  CSLF_CHECK(import().GetCount() == 1 && import().Warning.empty());
  CSLF_CHECK(scene.Compare("Cells") > 42.0);

  // A rectilinear grid: the same as the image where its coordinates are even.
  vtkImageData* image = scene.Source->GetOutput();
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(image->GetDimensions());
  vtkNew<vtkDoubleArray> coordinates[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = -32; i <= 31; ++i)
    {
      coordinates[axis]->InsertNextValue(i);
    }
  }
  grid->SetXCoordinates(coordinates[0]);
  grid->SetYCoordinates(coordinates[1]);
  grid->SetZCoordinates(coordinates[2]);
  grid->GetPointData()->SetScalars(image->GetPointData()->GetScalars());
  scene.Mapper->SetScalarModeToDefault();
  scene.Mapper->SetInputConnection(scene.Source->GetOutputPort());
  const auto window = cslf::testing::DrawWindow(scene.Renderer, Size);
  scene.Mapper->SetInputDataObject(grid);
  CSLF_CHECK(import().Get(0)->IsA("vtkRectilinearGrid"));
  CSLF_CHECK(scene.Compare("A rectilinear grid", 0.0, &window) > 48.0);

  // Cells of other kinds are resampled, and what is outside of them stays empty.
  vtkNew<vtkRTAnalyticSource> coarse;
  coarse->SetWholeExtent(-8, 8, -8, 8, -8, 8);
  vtkNew<vtkDataSetTriangleFilter> tetrahedra;
  tetrahedra->SetInputConnection(coarse->GetOutputPort());
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> unstructured;
  unstructured->SetInputConnection(tetrahedra->GetOutputPort());
  scene.Volume->SetMapper(unstructured);
  const Import resampled(scene.Renderer);
  CSLF_CHECK(resampled.GetCount() == 1 && resampled.Get(0)->IsA("vtkImageData"));
  CSLF_CHECK(resampled.Warns("neither an image nor a rectilinear grid: vtkUnstructuredGrid"));
  double bounds[6];
  resampled.Get(0)->GetBounds(bounds);
  CSLF_CHECK_NEAR(bounds[1] - bounds[0], 16.0, 1e-3);
}

void TestProperties()
{
  Scene scene;
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  const auto warns = [&scene](const char* of) { return Import(scene.Renderer).Warns(of); };
  const auto getNumber = [&scene](const char* name)
  { return Import(scene.Renderer).Get(0)->GetFieldData()->GetArray(name)->GetTuple1(0); };

  CSLF_CHECK(getNumber(vtkCSLFVolume::InterpolationName()) == 1.0);
  CSLF_CHECK(getNumber(vtkCSLFVolume::ShadeName()) == 0.0);
  property->SetInterpolationTypeToNearest();
  property->SetScalarOpacityUnitDistance(3.0);
  CSLF_CHECK(getNumber(vtkCSLFVolume::InterpolationName()) == 0.0);
  CSLF_CHECK(getNumber(vtkCSLFVolume::UnitDistanceName()) == 3.0);
  property->ShadeOn();
  CSLF_CHECK(getNumber(vtkCSLFVolume::ShadeName()) == 1.0);
  CSLF_CHECK(warns("shading of volumes"));
  property->ShadeOff();

  // What is not represented is named.
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0.0, 0.0);
  gradients->AddPoint(10.0, 1.0);
  property->SetGradientOpacity(gradients);
  CSLF_CHECK(warns("gradient opacity"));
  property->DisableGradientOpacityOn();
  CSLF_CHECK(!warns("gradient opacity"));
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionFlagsToCross();
  CSLF_CHECK(warns("cropping regions"));
  scene.Mapper->CroppingOff();
  vtkNew<vtkImageData> mask;
  scene.Mapper->SetMaskInput(mask);
  CSLF_CHECK(warns("masks and label maps"));
  scene.Mapper->SetMaskInput(nullptr);
  scene.Mapper->SetBlendModeToMaximumIntensity();
  CSLF_CHECK(warns("blend modes") && Import(scene.Renderer).GetCount() == 0);
  scene.Mapper->SetBlendModeToComposite();

  // Components: a volume for each that is independent.
  vtkNew<vtkImageData> pair;
  pair->SetDimensions(3, 3, 3);
  pair->AllocateScalars(VTK_UNSIGNED_CHAR, 2);
  for (vtkIdType i = 0; i < 2 * 27; ++i)
  {
    pair->GetPointData()->GetScalars()->SetComponent(i / 2, i % 2, static_cast<double>(i));
  }
  scene.Mapper->SetInputData(pair);
  const Import components(scene.Renderer);
  CSLF_CHECK(components.GetCount() == 2 && components.Warns("independent components"));
  CSLF_CHECK(
    components.Get(1)->GetFieldData()->GetArray(vtkCSLFVolume::ComponentName())->GetTuple1(0) ==
    1.0);
  property->IndependentComponentsOff();
  CSLF_CHECK(warns("depend on each other") && Import(scene.Renderer).GetCount() == 0);
}

/// A sampler finds changes, gives no geometry, and stores where the middle of what is seen lies.
void TestSampling()
{
  Scene scene;
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(10.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.Renderer->AddActor(actor);
  vtkNew<vtkCSLFSampler> sampler;
  vtkNew<vtkTest::ErrorObserver> messages;
  sampler->AddObserver(vtkCommand::WarningEvent, messages);
  sampler->SetRenderer(scene.Renderer);
  sampler->SetViewpoints(2);
  sampler->SetResolution(16);
  sampler->SetSamples(4);
  sampler->Update();
  CSLF_CHECK(messages->GetWarningMessage().find("it contains volumes") != std::string::npos);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfCells() == 0);
  vtkNew<vtkImageData> first;
  first->DeepCopy(sampler->GetOutput());
  vtkDataArray* colors = first->GetPointData()->GetArray("Color");
  vtkDataArray* depths = first->GetPointData()->GetArray("Depth");
  int partial = 0;
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    const double alpha = colors->GetComponent(i, 3);
    partial += alpha > 0.0 && alpha < 255.0 ? 1 : 0;
    CSLF_CHECK(alpha < 3.0 || (depths->GetTuple1(i) > 0.0 && depths->GetTuple1(i) < 65535.0));
  }
  CSLF_CHECK(partial > colors->GetNumberOfTuples() / 10);

  // Again, with the same result; then with another opacity.
  sampler->Modified();
  sampler->Update();
  const auto differ = [&]
  {
    vtkDataArray* now = sampler->GetOutput()->GetPointData()->GetArray("Color");
    for (vtkIdType i = 0; i < now->GetNumberOfValues(); ++i)
    {
      if (now->GetVariantValue(i) != colors->GetVariantValue(i))
      {
        return true;
      }
    }
    return false;
  };
  CSLF_CHECK(!differ());
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(0.0, 0.5);
  sampler->Update();
  CSLF_CHECK(differ());
}
}

int TestCSLFSceneImporterVolumes(int, char*[])
{
  TestPictures();
  TestGrids();
  TestProperties();
  TestSampling();
  return cslf::testing::Result();
}
