// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A light field among live actors: two golden rings come from one field, an ordinary ring is linked
// with each, and a translucent plane cuts them all. The live ring turns, and the field is moved,
// without being sampled again.
// LiveActors [viewpoints per side] [texels per side] [samples]
#include "Example.h"

#include <vtkCSLFEnvironment.h>
#include <vtkCSLFMaterial.h>

#include <vtkCamera.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricTorus.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <iostream>

namespace
{
/// A ring around the z axis.
vtkSmartPointer<vtkParametricFunctionSource> MakeRing(double radius, double thickness)
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(radius);
  torus->SetCrossSectionRadius(thickness);
  auto source = vtkSmartPointer<vtkParametricFunctionSource>::New();
  source->SetParametricFunction(torus);
  source->SetScalarModeToNone();
  source->SetUResolution(96);
  source->SetVResolution(48);
  return source;
}
}

int main(int argc, char* argv[])
{
  // The field: one ring of rough gold and nothing else.
  const auto ring = MakeRing(1.0, 0.25);
  ring->Update();
  vtkPolyData* gold = ring->GetOutput();
  vtkCSLFMaterial::SetBaseColor(gold, 1.0, 0.8, 0.4);
  vtkCSLFMaterial::SetMetallic(gold, 1.0);
  vtkCSLFMaterial::SetRoughness(gold, 0.5);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(gold);
  sampler->GetEnvironment()->SetModeToGradient();
  example::SetSizes(sampler, argc, argv);

  // Draw the field twice: it is sampled once and placed like any other actor.
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.16, 0.18, 0.22);
  const auto left = example::MakeFieldActor(sampler);
  vtkNew<vtkActor> right;
  right->SetMapper(left->GetMapper());
  left->SetPosition(-1.2, 0.0, 0.0);
  right->SetPosition(1.2, 0.0, 0.0);
  right->RotateY(-50.0);
  right->SetScale(0.8);
  renderer->AddActor(left);
  renderer->AddActor(right);

  // Live actors: a ring through both, and a plane that intersects both. Depth decides at each
  // pixel.
  const auto live = example::MakeActor(MakeRing(1.2, 0.12));
  live->GetProperty()->SetColor(0.2, 0.7, 0.9);
  live->GetProperty()->SetSpecular(0.4);
  live->GetProperty()->SetSpecularPower(30.0);
  renderer->AddActor(live);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2.6, -0.35, -1.5);
  plane->SetPoint1(2.6, -0.35, -1.5);
  plane->SetPoint2(-2.6, -0.35, 1.5);
  const auto sheet = example::MakeActor(plane);
  sheet->GetProperty()->SetColor(0.8, 0.3, 0.3);
  sheet->GetProperty()->SetOpacity(0.4);
  renderer->AddActor(sheet);

  renderer->GetActiveCamera()->SetPosition(1.0, 2.6, 6.6);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(960, 640);
  window->AddRenderer(renderer);
  for (const double angle : { 0.0, 30.0, 60.0 }) // an animation of three pictures
  {
    live->SetOrientation(70.0, 0.25 * angle, 0.0);
    renderer->ResetCameraClippingRange();
    window->Render();
  }
  std::cout << sampler->GetNumberOfRays() << " rays were traced, none of them for the animation\n";
  return example::SavePicture(window, "LiveActors.png");
}
