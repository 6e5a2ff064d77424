// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares VTK's window with the traced picture for surfaces that face their light, with one
// reflection and no shadows: shading models, lights, intensities.
#include "cslfTestWindow.h"
#include "cslfTesting.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
// The level of 255 from which on the two differ.
constexpr int Tolerance = 2;
constexpr int Size = 33;

struct Case
{
  std::string Name;
  std::function<void(vtkProperty*)> SetProperty;
  std::function<void(vtkRenderer*)> AddLights;
  bool HeadlightsAllAround = false;
  std::function<void(vtkActor*)> SetActor = {}; ///< may be null
};

/// A unit square around the origin that faces the camera.
int Compare(const Case& scene, int tolerance = Tolerance)
{
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.SetProperty(actor->GetProperty());
  if (scene.SetActor)
  {
    scene.SetActor(actor);
  }
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.01);
  camera->SetPosition(0.0, 0.0, 2.0);
  scene.AddLights(renderer);
  cslf::testing::BakeOptions options;
  options.HeadlightsAllAround = scene.HeadlightsAllAround;
  const auto pictures = cslf::testing::DrawAndTrace(renderer, Size, options);
  const int middle = 3 * (Size * (Size / 2) + Size / 2);
  const auto print = [](const std::vector<unsigned char>& colors)
  {
    return std::to_string(colors[middle]) + " " + std::to_string(colors[middle + 1]) + " " +
      std::to_string(colors[middle + 2]);
  };
  const int difference = pictures.GetDifferenceInMiddle();
  std::cout << scene.Name << ": window " << print(pictures.Window) << ", bake "
            << print(pictures.Bake) << "\n";
  CSLF_CHECK(difference < tolerance);
  return difference;
}

using SetProperty = std::function<void(vtkProperty*)>;
using AddLights = std::function<void(vtkRenderer*)>;

AddLights Headlight(double intensity)
{
  return [intensity](vtkRenderer* renderer)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
}

void AddKit(vtkRenderer* renderer)
{
  vtkNew<vtkLightKit> kit;
  kit->AddLightsToRenderer(renderer);
}

/// A light at 2 above the square.
AddLights Scene(double intensity, const std::function<void(vtkLight*)>& set)
{
  return [intensity, set](vtkRenderer* renderer)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(0.0, 0.0, 2.0);
    light->SetIntensity(intensity);
    set(light);
    renderer->AddLight(light);
  };
}

std::vector<std::pair<std::string, AddLights>> MakeLights(double intensity)
{
  std::vector<std::pair<std::string, AddLights>> lights;
  lights.emplace_back("headlight", Headlight(intensity));
  lights.emplace_back("directional", Scene(intensity, [](vtkLight*) {}));
  lights.emplace_back(
    "coloured", Scene(intensity, [](vtkLight* light) { light->SetDiffuseColor(1.0, 0.7, 0.4); }));
  lights.emplace_back("positional",
    Scene(intensity,
      [](vtkLight* light)
      {
        light->PositionalOn();
        light->SetConeAngle(90.0);
      }));
  lights.emplace_back("attenuated",
    Scene(intensity,
      [](vtkLight* light)
      {
        light->PositionalOn();
        light->SetConeAngle(90.0);
        light->SetAttenuationValues(0.5, 0.25, 0.1);
      }));
  lights.emplace_back("spot",
    Scene(intensity,
      [](vtkLight* light)
      {
        light->PositionalOn();
        light->SetConeAngle(30.0);
        light->SetExponent(5.0);
      }));
  return lights;
}

SetProperty Phong(double red, double green, double blue)
{
  return [=](vtkProperty* property) { property->SetColor(red, green, blue); };
}

SetProperty Physical(double red, double green, double blue, double metallic, double roughness)
{
  return [=](vtkProperty* property)
  {
    property->SetInterpolationToPBR();
    property->SetColor(red, green, blue);
    property->SetMetallic(metallic);
    property->SetRoughness(roughness);
  };
}

void TestLightsAndModels()
{
  const std::vector<std::pair<std::string, SetProperty>> surfaces = { { "Phong",
                                                                        Phong(0.8, 0.5, 0.2) },
    { "dark Phong", Phong(0.2, 0.1, 0.05) }, { "PBR", Physical(0.8, 0.5, 0.2, 0.0, 0.5) },
    { "dark PBR", Physical(0.1, 0.05, 0.02, 0.0, 1.0) },
    { "metal", Physical(0.8, 0.5, 0.2, 1.0, 0.6) } };
  for (const auto& [name, surface] : surfaces)
  {
    for (const double intensity : { 0.25, 0.5, 0.75, 1.0 })
    {
      for (const auto& [kind, lights] : MakeLights(intensity))
      {
        Compare({ name + ", " + kind + " " + std::to_string(intensity), surface, lights });
      }
    }
    Compare({ name + ", light kit", surface, AddKit });
  }
}

/// Gives the square scalars: a direct colour, or a number with a table, at points or cells, in
/// steps or after interpolation.
std::function<void(vtkActor*)> Scalars(bool ofCells, bool ofColors, bool before)
{
  return [=](vtkActor* actor)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->Update();
    vtkNew<vtkPolyData> data;
    data->ShallowCopy(plane->GetOutput());
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    vtkNew<vtkDoubleArray> numbers;
    for (int i = 0; i < (ofCells ? 1 : 4); ++i)
    {
      colors->InsertNextTuple3(200.0, 120.0, 40.0);
      numbers->InsertNextValue(0.3);
    }
    vtkDataArray* scalars = numbers;
    if (ofColors)
    {
      scalars = colors;
    }
    vtkDataSetAttributes* attributes = data->GetPointData();
    if (ofCells)
    {
      attributes = data->GetCellData();
    }
    attributes->SetScalars(scalars);
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    mapper->SetInputData(data);
    mapper->SetInterpolateScalarsBeforeMapping(before);
  };
}

/// A texture of one colour.
void AddTexture(vtkActor* actor)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int i = 0; i < 4; ++i)
  {
    image->GetPointData()->GetScalars()->SetTuple3(i, 230.0, 140.0, 60.0);
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  actor->SetTexture(texture);
}

/// The same for the base colour of physically based shading, in sRGB.
void AddAlbedo(vtkActor* actor)
{
  AddTexture(actor);
  vtkSmartPointer<vtkTexture> texture = actor->GetTexture();
  actor->SetTexture(nullptr);
  texture->UseSRGBColorSpaceOn();
  actor->GetProperty()->SetBaseColorTexture(texture);
}

SetProperty Terms(double ambient, double diffuse, bool lighting)
{
  return [=](vtkProperty* property)
  {
    property->SetColor(0.8, 0.5, 0.2);
    property->SetAmbient(ambient);
    property->SetDiffuse(diffuse);
    property->SetLighting(lighting);
  };
}

void TestEmission()
{
  const std::vector<std::pair<std::string, std::function<void(vtkActor*)>>> looks = {
    { "colour", nullptr }, { "colours of points", Scalars(false, true, false) },
    { "colours of cells", Scalars(true, true, false) },
    { "numbers of points", Scalars(false, false, false) },
    { "numbers of cells", Scalars(true, false, false) }, { "table", Scalars(false, false, true) },
    { "texture", AddTexture }
  };
  const std::vector<std::pair<std::string, SetProperty>> properties = {
    { "full ambient", Terms(1.0, 0.0, true) }, { "half ambient", Terms(0.5, 0.5, true) },
    { "some ambient", Terms(0.2, 0.8, true) }, { "no lighting", Terms(0.0, 1.0, false) },
    { "no lighting, half of each", Terms(0.5, 0.5, false) }, { "dim", Terms(0.0, 0.6, true) },
    { "PBR", Physical(0.8, 0.5, 0.2, 0.0, 1.0) }
  };
  for (const auto& [name, set] : looks)
  {
    for (const auto& [kind, property] : properties)
    {
      for (const double intensity : { 0.5, 1.0 })
      {
        const std::string text = kind + ", " + name + " " + std::to_string(intensity);
        Compare({ text, property, Headlight(intensity), false, set });
      }
      if (kind != "PBR")
      {
        Compare({ kind + ", " + name + " all around", property, Headlight(0.75), true, set });
      }
    }
  }
  Compare({ "texture of base colour", Physical(0.8, 0.5, 0.2, 0.0, 1.0), Headlight(1.0), false,
    AddAlbedo });
}

void TestAllAround()
{
  for (const double intensity : { 0.25, 0.5, 0.75, 1.0, 1.5 })
  {
    Compare({ "Phong, all around " + std::to_string(intensity), Phong(0.8, 0.5, 0.2),
      Headlight(intensity), true });
  }
  Compare({ "Phong, light kit with its headlight all around", Phong(0.8, 0.5, 0.2), AddKit, true });
  Compare({ "no light", Phong(0.8, 0.5, 0.2),
    [](vtkRenderer* renderer) { renderer->AutomaticLightCreationOff(); } });
  // A renderer creates a light if none is on.
  Compare({ "light off", Phong(0.8, 0.5, 0.2),
    [](vtkRenderer* renderer)
    {
      vtkNew<vtkLight> light;
      light->SwitchOff();
      renderer->AddLight(light);
    } });
}

void TestPartMetals()
{
  // In the window, the diffuse base of a partly metallic surface is darker and of another hue than
  // the metal.
  const auto aside = [](vtkLight* light) { light->SetPosition(2.0, 0.0, 2.0); };
  for (const double metallic : { 0.25, 0.5, 0.75 })
  {
    for (const double roughness : { 0.3, 0.6, 1.0 })
    {
      const std::string text =
        "metal " + std::to_string(metallic) + ", roughness " + std::to_string(roughness);
      const SetProperty surface = Physical(0.8, 0.5, 0.2, metallic, roughness);
      // White highlights are clipped in the window.
      Compare({ text + ", headlight", surface, Headlight(1.0) }, roughness < 0.5 ? 9 : 6);
      Compare({ text + ", light from aside", surface, Scene(1.0, aside) }, 6);
    }
  }
}

void TestHighlights()
{
  // A light that is mirrored to the camera, so highlights have their full height.
  for (const double power : { 1.0, 5.0, 20.0, 100.0 })
  {
    for (const double white : { 0.0, 1.0 })
    {
      const auto property = [=](vtkProperty* target)
      {
        target->SetColor(0.6, 0.4, 0.2);
        target->SetSpecular(0.3);
        target->SetSpecularPower(power);
        if (white > 0.0)
        {
          target->SetSpecularColor(1.0, 1.0, 1.0);
        }
      };
      const std::string text =
        "power " + std::to_string(power) + (white > 0.0 ? ", white" : ", coloured");
      // White boundaries add the same to all channels, which displayed colours do not.
      Compare({ text, property, Headlight(1.0) }, white > 0.0 ? 24 : 6);
    }
  }
  // On colours that vary, a highlight is the same for all of them.
  const auto shiny = [](vtkProperty* target)
  {
    target->SetSpecular(0.3);
    target->SetSpecularPower(30.0);
  };
  const auto colors = [](vtkActor* actor)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->Update();
    vtkNew<vtkPolyData> data;
    data->ShallowCopy(plane->GetOutput());
    vtkNew<vtkUnsignedCharArray> saturated;
    saturated->SetNumberOfComponents(3);
    saturated->InsertNextTuple3(0.0, 128.0, 255.0);
    data->GetCellData()->SetScalars(saturated);
    vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(data);
  };
  Compare({ "highlight of scalars", shiny, Headlight(1.0), false, colors }, 45);
}
}

int TestCSLFSceneImporterLooks(int, char*[])
{
  TestLightsAndModels();
  TestEmission();
  TestAllAround();
  TestPartMetals();
  TestHighlights();
  return cslf::testing::Result();
}
