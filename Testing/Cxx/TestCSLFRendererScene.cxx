// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The lifetime of a renderer whose scene is imported or traced: it and everything that it shows are
// freed, even if it shows what was made of its scene. Without such actors, its scene stays.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageSliceMapper.h>
#include <vtkLODProp3D.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTexture.h>

#include <functional>
#include <iostream>
#include <vector>

namespace
{
/// Counts the deletions of objects.
class Deletions : public vtkCommand
{
public:
  static Deletions* New() { return new Deletions; }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Deleted; }
  void Expect(vtkObject* object)
  {
    object->AddObserver(vtkCommand::DeleteEvent, this);
    ++this->Expected;
  }
  int Expected = 0;
  int Deleted = 0;
};

vtkSmartPointer<vtkActor> MakeSphere()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkRenderer> MakeRenderer()
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->AddActor(MakeSphere());
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(1.0, 2.0, 3.0);
  renderer->AddLight(light);
  return renderer;
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler(vtkRenderer* renderer)
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetRenderer(renderer);
  sampler->SetViewpoints(2);
  sampler->SetResolution(8);
  sampler->SetSamples(1);
  sampler->SetIntegratorToPathTracing();
  return sampler;
}

/// Adds something to a renderer that shows what was made of it.
using Adding = std::function<void(vtkRenderer*, Deletions*)>;

vtkSmartPointer<vtkActor> MakeActor(vtkMapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

vtkSmartPointer<vtkCSLFMapper> MakeField(vtkRenderer* renderer, Deletions* deletions)
{
  const auto sampler = MakeSampler(renderer);
  auto mapper = vtkSmartPointer<vtkCSLFMapper>::New();
  mapper->SetInputConnection(sampler->GetOutputPort());
  deletions->Expect(sampler);
  deletions->Expect(mapper);
  return mapper;
}

const Adding Addings[] = { [](vtkRenderer* renderer, Deletions* deletions)
  { renderer->AddActor(MakeActor(MakeField(renderer, deletions))); },
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    vtkNew<vtkAssembly> inner;
    inner->AddPart(MakeActor(MakeField(renderer, deletions)));
    vtkNew<vtkAssembly> outer;
    outer->AddPart(inner);
    renderer->AddActor(outer);
  },
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    vtkNew<vtkLODProp3D> levels;
    levels->AddLOD(MakeField(renderer, deletions), 0.0);
    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(levels);
    renderer->AddActor(assembly);
  },
  // The geometry of a sampler, and the imported scene itself.
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    const auto sampler = MakeSampler(renderer);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sampler->GetOutputPort(1));
    deletions->Expect(sampler);
    renderer->AddActor(MakeActor(mapper));
  },
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    vtkNew<vtkCSLFSceneImporter> importer;
    importer->SetRenderer(renderer);
    vtkNew<cslf::CompositeMapper> mapper;
    mapper->SetInputConnection(importer->GetOutputPort());
    deletions->Expect(importer);
    renderer->AddActor(MakeActor(mapper));
  },
  // A traced picture as a slice, as a texture of an actor, and as the environment.
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetRenderer(renderer);
    vtkNew<vtkImageActor> image;
    image->GetMapper()->SetInputConnection(tracer->GetOutputPort());
    deletions->Expect(tracer);
    renderer->AddActor(image);
  },
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetRenderer(renderer);
    vtkNew<vtkTexture> texture;
    texture->SetInputConnection(tracer->GetOutputPort());
    deletions->Expect(tracer);
    const auto actor = MakeSphere();
    actor->SetTexture(texture);
    renderer->AddActor(actor);
    renderer->SetEnvironmentTexture(texture);
  },
  // Two samplers, each with an actor.
  [](vtkRenderer* renderer, Deletions* deletions)
  {
    renderer->AddActor(MakeActor(MakeField(renderer, deletions)));
    renderer->AddActor(MakeActor(MakeField(renderer, deletions)));
  } };

// Nothing else holds the renderer, or only the filter outlives it.
void TestCycles()
{
  for (const Adding& add : Addings)
  {
    vtkNew<Deletions> deletions;
    {
      const auto renderer = MakeRenderer();
      deletions->Expect(renderer);
      deletions->Expect(renderer->GetViewProps()->GetLastProp());
      add(renderer, deletions);
      deletions->Expect(renderer->GetViewProps()->GetLastProp());
    }
    std::cout << deletions->Deleted << " of " << deletions->Expected << " objects are freed\n";
    CSLF_CHECK(deletions->Deleted == deletions->Expected);
  }
}

// A sampler that outlives the renderer keeps the scene without the field's own actor.
void TestKeptSampler()
{
  vtkNew<Deletions> deletions;
  vtkSmartPointer<vtkCSLFSampler> sampler;
  {
    const auto renderer = MakeRenderer();
    sampler = MakeSampler(renderer);
    vtkNew<vtkCSLFMapper> mapper;
    mapper->SetInputConnection(sampler->GetOutputPort());
    const auto actor = MakeActor(mapper);
    renderer->AddActor(actor);
    deletions->Expect(renderer);
    deletions->Expect(mapper);
    deletions->Expect(actor);
  }
  CSLF_CHECK(deletions->Deleted == 3);
  vtkRenderer* kept = sampler->GetRenderer();
  CSLF_CHECK(kept && kept->GetViewProps()->GetNumberOfItems() == 1);
  sampler->Update();
  vtkDataArray* colors = sampler->GetOutput()->GetPointData()->GetScalars();
  CSLF_CHECK(colors && colors->GetRange(3)[1] == 255.0);
  deletions->Expect(kept);
  sampler->SetRenderer(nullptr);
  CSLF_CHECK(deletions->Deleted == 4 && !sampler->GetRenderer());
}

// A light that follows the camera stays as it was sampled while the field is in the renderer.
// Otherwise, the next update has the light at the new camera.
void TestMovedCamera()
{
  const auto renderer = MakeRenderer();
  vtkNew<vtkCamera> camera;
  renderer->SetActiveCamera(camera);
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  renderer->AddLight(light);
  const auto sampler = MakeSampler(renderer);
  const auto isMadeAgain = [&]
  {
    sampler->Update();
    const vtkMTimeType before = sampler->GetOutput()->GetUpdateTime();
    camera->Azimuth(30.0);
    sampler->Update();
    return sampler->GetOutput()->GetUpdateTime() > before;
  };
  CSLF_CHECK(isMadeAgain());
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(sampler->GetOutputPort());
  const auto actor = MakeActor(mapper);
  renderer->AddActor(actor);
  CSLF_CHECK(!isMadeAgain());
  renderer->RemoveActor(actor);
  CSLF_CHECK(isMadeAgain());
}

double GetMean(vtkCSLFViewTracer* tracer)
{
  tracer->Update();
  vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
  double sum = 0.0;
  for (vtkIdType i = 0; colors && i < colors->GetNumberOfTuples(); ++i)
  {
    sum += colors->GetComponent(i, 0) + 2.0 * colors->GetComponent(i, 3);
  }
  return sum;
}

// A renderer that nobody else holds: its scene stays, with its lights and camera, nothing is traced
// again because it was deleted, and later changes are found.
void TestTemporary()
{
  vtkNew<vtkCSLFViewTracer> tracer;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.0, 0.0, 3.0);
  tracer->SetCamera(camera);
  tracer->SetSize(16, 16);
  tracer->SetSamples(4);
  vtkSmartPointer<vtkActor> actor;
  double mean = 0.0;
  vtkMTimeType time = 0;
  {
    const auto renderer = MakeRenderer();
    renderer->GetActiveCamera()->SetPosition(3.0, 0.0, 0.0);
    actor = vtkActor::SafeDownCast(renderer->GetViewProps()->GetLastProp());
    tracer->SetRenderer(renderer);
    CSLF_CHECK(tracer->GetRenderer() == renderer);
    mean = GetMean(tracer);
    CSLF_CHECK(mean > 0.0);
    time = tracer->GetMTime();
  }
  CSLF_CHECK(tracer->GetMTime() == time);
  const vtkMTimeType traced = tracer->GetOutput()->GetMTime();
  CSLF_CHECK(GetMean(tracer) == mean);
  CSLF_CHECK(tracer->GetOutput()->GetMTime() == traced);
  CSLF_CHECK(tracer->GetRenderer()->GetLights()->GetNumberOfItems() == 1);
  CSLF_CHECK(tracer->GetRenderer()->GetActiveCamera()->GetPosition()[0] == 3.0);
  actor->SetScale(0.5);
  CSLF_CHECK(GetMean(tracer) < 0.6 * mean);

  // The same picture without an update in between.
  tracer->SetRenderer(MakeRenderer());
  CSLF_CHECK_NEAR(GetMean(tracer), mean, 1e-9);
}

// Importers that are deleted or get another renderer leave nothing behind in the first one.
void TestOthers()
{
  vtkSmartPointer<vtkRenderer> renderer = MakeRenderer();
  {
    vtkNew<vtkCSLFSceneImporter> importer;
    importer->SetRenderer(renderer);
  }
  CSLF_CHECK(!renderer->HasObserver(vtkCommand::DeleteEvent));
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  const auto other = MakeRenderer();
  importer->SetRenderer(other);
  CSLF_CHECK(!renderer->HasObserver(vtkCommand::DeleteEvent));
  renderer = nullptr;
  CSLF_CHECK(importer->GetRenderer() == other);
  CSLF_CHECK(other->GetReferenceCount() == 1);
}
}

int TestCSLFRendererScene(int, char*[])
{
  TestCycles();
  TestKeptSampler();
  TestMovedCamera();
  TestTemporary();
  TestOthers();
  return cslf::testing::Result();
}
