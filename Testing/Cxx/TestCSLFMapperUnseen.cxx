// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A slit between a block and a panel shows a stripe on a wall. No viewpoint near the line of sight
// sees it, but viewpoints that look over the block do. A panel in the plane of a row of viewpoints,
// which look past it, is seen by the others.
#include "Lookup/cslfLookup.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <iostream>
#include <string>

namespace
{
void AddBox(
  vtkMultiBlockDataSet* scene, const double (&bounds)[6], double red, double green, double blue)
{
  vtkNew<vtkCubeSource> source;
  source->SetBounds(bounds);
  source->Update();
  vtkPolyData* box = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(box, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(box, red, green, blue);
  scene->SetBlock(scene->GetNumberOfBlocks(), box);
}

void Sample(vtkDataObject* scene, int viewpoints, int resolution, vtkCSLFSampler* sampler)
{
  sampler->SetInputDataObject(scene);
  sampler->AutomaticCubeOff();
  sampler->SetCubeCenter(0.0, 0.0, 0.0);
  sampler->SetCubeEdges(2.0, 2.0, 2.0);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(viewpoints);
  sampler->SetResolution(resolution);
  sampler->SetSamples(1);
  sampler->SetMaximumDepth(0);
  sampler->Update();
}

/// Lines of sight to points of a white square in the plane z = 0, from all around at a low height.
void CheckPanel()
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-0.9, -0.9, 0.0);
  source->SetPoint1(0.9, -0.9, 0.0);
  source->SetPoint2(-0.9, 0.9, 0.0);
  source->Update();
  vtkPolyData* panel = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(panel, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(panel, 1.0, 1.0, 1.0);
  vtkNew<vtkCSLFSampler> sampler;
  Sample(panel, 5, 48, sampler);
  std::string error;
  const auto field = cslf::Description::ReadFrom(sampler->GetOutput(), error);
  CSLF_CHECK(field.has_value());
  if (!field)
  {
    return;
  }
  const cslf::Lookup lookup(*field, sampler->GetOutput());
  const cslf::ChannelReader colors(
    field->Grid, sampler->GetOutput()->GetPointData()->GetArray(cslf::ColorName));
  int rays = 0;
  int white = 0;
  for (double angle = 0.05; angle < 6.28; angle += 0.1)
  {
    for (double x = -0.75; x < 0.8; x += 0.25)
    {
      const glm::dvec3 point(x, 0.3 * x, 0.0);
      const glm::dvec3 toEye(std::cos(angle), std::sin(angle), 0.25);
      const auto ray = cslf::RayToCoordinates(point + 4.0 * toEye, -toEye);
      ++rays;
      white += ray && colors.Blend(lookup.DepthCorrected(*ray)).x > 0.9 ? 1 : 0;
    }
  }
  std::cout << "panel: " << white << " of " << rays << " lines of sight are white\n";
  CSLF_CHECK(white > 0.95 * rays);
}
}

int TestCSLFMapperUnseen(int, char*[])
{
  vtkNew<vtkMultiBlockDataSet> scene;
  AddBox(scene, { -0.95, 0.95, -0.4, -0.2, -0.95, -0.9 }, 1.0, 1.0, 1.0);
  AddBox(scene, { -0.95, 0.95, -0.95, -0.4, -0.95, -0.9 }, 0.0, 1.0, 0.0);
  AddBox(scene, { -0.95, 0.95, -0.2, 0.95, -0.95, -0.9 }, 0.0, 1.0, 0.0);
  AddBox(scene, { -0.95, 0.37, -0.95, 0.0, 0.08, 0.1 }, 1.0, 0.0, 0.0);
  AddBox(scene, { 0.69, 0.95, -0.95, 0.95, 0.85, 0.9 }, 0.0, 0.0, 1.0);
  vtkNew<vtkCSLFSampler> sampler;
  Sample(scene, 9, 96, sampler);

  const glm::dvec3 onWall(0.1, -0.3, -0.9);
  const glm::dvec3 eye = onWall + 4.9 * glm::dvec3(0.295, 0.0, 1.0);
  std::string error;
  const auto field = cslf::Description::ReadFrom(sampler->GetOutput(), error);
  const auto ray = cslf::RayToCoordinates(eye, onWall - eye);
  CSLF_CHECK(field && ray);
  if (field && ray)
  {
    const cslf::LookupResult result =
      cslf::Lookup(*field, sampler->GetOutput()).DepthCorrected(*ray);
    const cslf::ChannelReader colors(
      field->Grid, sampler->GetOutput()->GetPointData()->GetArray(cslf::ColorName));
    CSLF_CHECK_NEAR(glm::distance(colors.Blend(result), glm::dvec4(1.0)), 0.0, 0.02);
    // Along the chord from z = 1 to z = -1.
    CSLF_CHECK_NEAR(result.Fraction, 0.95, 0.01);
  }

  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(sampler->GetOutputPort());
  mapper->SetPixelSamples(1);
  cslf::testing::View view(33);
  view.Add(mapper);
  vtkCamera* camera = view.GetCamera();
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetFocalPoint(onWall.x, onWall.y, onWall.z);
  camera->SetViewAngle(1.0);
  const cslf::testing::Picture picture = view.Render();
  for (int channel = 0; channel < 3; ++channel)
  {
    CSLF_CHECK(picture.Colors[3 * (16 * 33 + 16) + channel] > 250);
  }
  CheckPanel();
  return cslf::testing::Result();
}
