// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A glTF file becomes a light field, lit by an image of the surroundings. The file is written here
// by VTK's own exporter; any other .gltf or .glb file can be used.
// GLTFScene [viewpoints per side] [texels per side] [samples]
#include "Example.h"

#include <vtkCSLFGLTFReader.h>
#include <vtkCSLFLight.h>
#include <vtkCSLFRadianceCacheOptions.h>

#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkGLTFExporter.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkSuperquadricSource.h>

#include <cmath>

namespace
{
/// Shows the output of a source with a physically based material.
vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkAlgorithm* source,
  const double color[3], double metallic, double roughness)
{
  auto actor = example::MakeActor(source);
  actor->GetMapper()->ScalarVisibilityOff();
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPBR();
  property->SetColor(color[0], color[1], color[2]);
  property->SetMetallic(metallic);
  property->SetRoughness(roughness);
  renderer->AddActor(actor);
  return actor;
}

/// Exports a plate with a ball and a ring on it.
void WriteScene(const char* fileName)
{
  vtkNew<vtkRenderer> scene;
  const double brown[] = { 0.5, 0.42, 0.36 };
  const double gold[] = { 1.0, 0.78, 0.35 };
  const double blue[] = { 0.1, 0.35, 0.6 };
  vtkNew<vtkCubeSource> plate;
  plate->SetXLength(4.0);
  plate->SetYLength(0.2);
  plate->SetZLength(2.6);
  AddActor(scene, plate, brown, 0.0, 0.8)->SetPosition(0.0, -0.1, 0.0);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.7);
  ball->SetThetaResolution(48);
  ball->SetPhiResolution(24);
  AddActor(scene, ball, gold, 1.0, 0.25)->SetPosition(-1.0, 0.7, 0.1);
  vtkNew<vtkSuperquadricSource> ring;
  ring->ToroidalOn();
  ring->SetThetaResolution(32);
  ring->SetPhiResolution(32);
  ring->SetThickness(0.5);
  ring->SetSize(0.8);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(ring->GetOutputPort());
  const auto ringActor = AddActor(scene, normals, blue, 0.0, 0.5);
  ringActor->SetPosition(1.0, 0.28, -0.1);
  ringActor->RotateX(90.0);

  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->AddRenderer(scene);
  window->Render();
  vtkNew<vtkGLTFExporter> exporter;
  exporter->SetRenderWindow(window);
  exporter->InlineDataOn();
  exporter->SetFileName(fileName);
  exporter->Write();
}

/// A sky with a bright window, as linear radiance: columns are longitudes, rows latitudes.
vtkSmartPointer<vtkImageData> MakeSurroundings()
{
  constexpr int width = 64;
  constexpr int height = 32;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  for (int y = 0; y < height; ++y)
  {
    const double up = std::sin((y + 0.5 - 0.5 * height) / height * vtkMath::Pi());
    for (int x = 0; x < width; ++x)
    {
      const bool window = up > 0.3 && up < 0.8 && x >= 40 && x < 48;
      const double sky[] = { 0.35 + 0.25 * up, 0.4 + 0.3 * up, 0.5 + 0.4 * up };
      const double ground[] = { 0.12, 0.1, 0.09 };
      const double bright[] = { 6.0, 5.3, 4.3 };
      const double* color = window ? bright : up < 0.0 ? ground : sky;
      for (int component = 0; component < 3; ++component)
      {
        image->SetScalarComponentFromDouble(x, y, 0, component, color[component]);
      }
    }
  }
  return image;
}
}

int main(int argc, char* argv[])
{
  WriteScene("GLTFScene.gltf");
  vtkNew<vtkCSLFGLTFReader> reader;
  reader->SetFileName("GLTFScene.gltf");
  reader->Update();
  vtkMultiBlockDataSet* scene = reader->GetOutput();

  // Light travels with the data. The image's middle column is in the direction +X, its top in +Y.
  const double up[] = { 0.0, 1.0, 0.0 };
  const double right[] = { 1.0, 0.0, 0.0 };
  vtkCSLFLight::SetEnvironmentImage(scene, MakeSurroundings(), up, right);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(scene);
  sampler->GetCacheOptions()->SetSamples(128); // few are enough for smooth light
  example::SetSizes(sampler, argc, argv);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.45, 0.5, 0.58);
  renderer->AddActor(example::MakeFieldActor(sampler));
  renderer->GetActiveCamera()->SetPosition(1.5, 3.2, 7.5);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.35, 0.0);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(960, 640);
  window->AddRenderer(renderer);
  return example::SavePicture(window, "GLTFScene.png");
}
