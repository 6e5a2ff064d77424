// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A slit between a block and a panel shows a stripe on a wall. No viewpoint near the line of sight
// sees it, but viewpoints that look over the block do.
#include "Lookup/cslfLookup.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

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
  sampler->SetInputDataObject(scene);
  sampler->AutomaticCubeOff();
  sampler->SetCubeCenter(0.0, 0.0, 0.0);
  sampler->SetCubeEdges(2.0, 2.0, 2.0);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(9);
  sampler->SetResolution(96);
  sampler->SetSamples(1);
  sampler->SetMaximumDepth(0);
  sampler->Update();

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
  return cslf::testing::Result();
}
