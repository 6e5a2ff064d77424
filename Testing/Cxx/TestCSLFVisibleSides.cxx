// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Surfaces that are visible from only one side: in pictures, in shadows, as lights, as instances,
// and in the radiance cache.
#include "PathTracing/RadianceCache/cslfOpenSides.h"
#include "PathTracing/Rays/cslfRayLanes.h"
#include "cslfIntegratorComparison.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"

#include <vtkCubeSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>

#include <iostream>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;
using cslf::PathSettings;
using cslf::VisibleSides;

const glm::vec3 AlongX(1, 0, 0);
const glm::vec3 AlongY(0, 1, 0);

cslf::SurfaceMaterial MakeSided(VisibleSides sides, float reflectance, float emission = 0.0f)
{
  cslf::SurfaceMaterial material = MakeDiffuse(reflectance, emission);
  material.Sides = sides;
  return material;
}

/// A square at a height, whose front faces up.
cslf::Mesh MakeSheet(float height, const cslf::SurfaceMaterial& material)
{
  return MakeRectangle({ 0, 0, height }, AlongX, AlongY, material);
}

bool IsSeen(const cslf::Scene& scene, bool fromBelow)
{
  const glm::vec3 from(0.1f, 0.2f, fromBelow ? -3.0f : 3.0f);
  return scene.Intersect(LookAt(from, { 0.1f, 0.2f, 0.0f })).IsValid();
}

void TestRays()
{
  for (const VisibleSides sides : { VisibleSides::Both, VisibleSides::Front, VisibleSides::Back })
  {
    const bool above = sides != VisibleSides::Back;
    const bool below = sides != VisibleSides::Front;
    for (const float opacity : { 1.0f, 0.75f })
    {
      cslf::SurfaceMaterial material = MakeSided(sides, 0.5f);
      material.Opacity = opacity;
      const cslf::Scene scene({ MakeSheet(0.0f, material) }, MakeUniformLight(1.0f));
      const auto pass = [&scene](float way)
      {
        cslf::ShadowLanes shadows{};
        shadows.Rays.Active[0] = -1;
        shadows.Rays.Origin.Set(0, { 0.1f, 0.2f, -way });
        shadows.Rays.Direction.Set(0, { 0, 0, way });
        shadows.Distance[0] = 5.0f;
        scene.FindTransmittances(shadows);
        return shadows.Transmittance[0];
      };
      CSLF_CHECK_NEAR(pass(-1.0f), above ? 1.0f - opacity : 1.0f, 1e-6);
      CSLF_CHECK_NEAR(pass(1.0f), below ? 1.0f - opacity : 1.0f, 1e-6);
      if (opacity == 1.0f)
      {
        CSLF_CHECK(IsSeen(scene, false) == above && IsSeen(scene, true) == below);
      }
    }
    // An instance has the sides of its mesh, also where it is a reflection.
    for (const float mirror : { 1.0f, -1.0f })
    {
      cslf::Mesh mesh = MakeSheet(0.0f, MakeSided(sides, 0.5f));
      cslf::MeshInstance instance;
      instance.Linear[0][0] = mirror;
      mesh.Instances.push_back(instance);
      const cslf::Scene scene({ std::move(mesh) }, MakeUniformLight(1.0f));
      CSLF_CHECK(IsSeen(scene, false) == above && IsSeen(scene, true) == below);
    }
  }
  // Spheres and tubes have no sides to hide. Two copies make one surface of two colours.
  const cslf::Scene two({ MakeSheet(0.0f, MakeSided(VisibleSides::Front, 0.25f)),
                          MakeSheet(0.0f, MakeSided(VisibleSides::Back, 0.75f)) },
    MakeUniformLight(1.0f));
  PathSettings settings;
  settings.MaximumDepth = 1;
  CSLF_CHECK_NEAR(Trace(two, LookAt({ 0, 0, 3 }, Dark), settings, 64).Mean, 0.25, 1e-3);
  CSLF_CHECK_NEAR(Trace(two, LookAt({ 0, 0, -3 }, Dark), settings, 64).Mean, 0.75, 1e-3);
}

/// A lamp above a floor, whose front faces up: light of each estimator, and of both.
double LightFloor(VisibleSides sides, bool instanced)
{
  cslf::Mesh lamp =
    MakeRectangle({ 0, 0, 1 }, 0.5f * AlongX, 0.5f * AlongY, MakeSided(sides, 0.0f, 2.0f));
  if (instanced)
  {
    cslf::MeshInstance instance;
    instance.Linear[0][0] = -1.0f;
    lamp.Instances.push_back(instance);
  }
  const cslf::Scene scene(
    { MakeSheet(0.0f, MakeDiffuse(0.5f)), std::move(lamp) }, MakeUniformLight(0.0f));
  PathSettings settings;
  settings.MaximumDepth = 1;
  return CheckEstimators(scene, LookAt({ 3, 0, 0.5f }, { 0.2f, 0.2f, 0 }), settings, 1 << 17)
    .first.Mean;
}

void TestLamps()
{
  for (const bool instanced : { false, true })
  {
    const double both = LightFloor(VisibleSides::Both, instanced);
    CSLF_CHECK(both > 0.05);
    CSLF_CHECK_NEAR(LightFloor(VisibleSides::Back, instanced), both, 0.01 * both);
    CSLF_CHECK(LightFloor(VisibleSides::Front, instanced) == 0.0);
  }
}

vtkPolyData* SetSides(vtkAlgorithm* source, int sides)
{
  source->Update();
  auto* data = vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
  vtkCSLFMaterial::SetVisibleSides(data, sides);
  return data;
}

/// A room seen through its walls, which are visible only from inside. It contains a lamp that
/// shines down, a ball with only its front, and a sheet of two colours.
void TestCache()
{
  vtkNew<vtkCubeSource> room;
  room->SetXLength(2.0);
  room->SetYLength(2.0);
  room->SetZLength(2.0);
  vtkNew<vtkPlaneSource> lamp;
  lamp->SetOrigin(-0.4, 0.9, -0.4);
  lamp->SetPoint1(0.4, 0.9, -0.4);
  lamp->SetPoint2(-0.4, 0.9, 0.4);
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.4, -0.6, 0.2);
  ball->SetRadius(0.4);
  ball->SetThetaResolution(32);
  ball->SetPhiResolution(32);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, SetSides(room, vtkCSLFMaterial::BackSide));
  vtkCSLFMaterial::SetBaseColor(scene->GetBlock(0), 0.8, 0.8, 0.7);
  scene->SetBlock(1, SetSides(lamp, vtkCSLFMaterial::FrontSide));
  vtkCSLFMaterial::SetEmission(scene->GetBlock(1), 4.0, 4.0, 4.0);
  scene->SetBlock(2, SetSides(ball, vtkCSLFMaterial::FrontSide));
  for (const bool back : { false, true })
  {
    vtkNew<vtkPlaneSource> sheet;
    sheet->SetOrigin(-0.8, -1.0, -0.2);
    sheet->SetPoint1(-0.1, -1.0, 0.3);
    sheet->SetPoint2(-0.8, 0.2, -0.2);
    vtkPolyData* data =
      SetSides(sheet, back ? vtkCSLFMaterial::BackSide : vtkCSLFMaterial::FrontSide);
    vtkCSLFMaterial::SetBaseColor(data, back ? 0.9 : 0.2, 0.4, back ? 0.2 : 0.9);
    scene->SetBlock(back ? 4 : 3, data);
  }
  IntegratorComparison pictures(scene, 0.6, 0.5, 4.0);
  for (vtkCSLFViewTracer* tracer : { pictures.Reference.Get(), pictures.Cached.Get() })
  {
    tracer->GetEnvironment()->SetModeToConstant();
    tracer->GetEnvironment()->SetIntensity(1.0);
    tracer->SetMaximumDepth(4);
  }
  pictures.Reference->SetSamples(2048);
  const double quality = pictures.GetPSNR();
  std::cout << "A room seen through its walls, cache against paths: " << quality << " dB\n";
  CSLF_CHECK(quality > 42.0);
}

void TestOpenSides()
{
  for (const VisibleSides sides : { VisibleSides::Both, VisibleSides::Front, VisibleSides::Back })
  {
    const cslf::Scene scene({ MakeSheet(0.0f, MakeSided(sides, 0.5f)) }, MakeUniformLight(1.0f));
    const cslf::PathIntegrator paths(scene, PathSettings());
    const cslf::OpenSides open(scene, paths, 1, 0.1f);
    CSLF_CHECK(open.Has(0, false) == (sides != VisibleSides::Back));
    CSLF_CHECK(open.Has(1, true) == (sides != VisibleSides::Front));
  }
}

void TestFieldData()
{
  vtkNew<vtkPolyData> data;
  CSLF_CHECK(vtkCSLFMaterial::GetVisibleSides(data) == vtkCSLFMaterial::BothSides);
  vtkCSLFMaterial::SetVisibleSides(data, vtkCSLFMaterial::BackSide);
  CSLF_CHECK(vtkCSLFMaterial::GetVisibleSides(data) == vtkCSLFMaterial::BackSide);
  vtkCSLFMaterial::SetVisibleSides(data, 7);
  CSLF_CHECK(vtkCSLFMaterial::GetVisibleSides(data) == vtkCSLFMaterial::BackSide);
}
}

int TestCSLFVisibleSides(int, char*[])
{
  TestFieldData();
  TestRays();
  TestLamps();
  TestOpenSides();
  TestCache();
  return cslf::testing::Result();
}
