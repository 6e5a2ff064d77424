// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The colour of a texel that sees several surfaces: that of the one at its centre, or the mean.
// Coverage is the same, and surfaces that light passes at random are always averaged.
#include "cslfChannel.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace
{
void AddPanel(vtkMultiBlockDataSet* scene, double left, double right, double z, double red,
  double green, double opacity)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(left, -0.8, z);
  source->SetPoint1(right, -0.8, z);
  source->SetPoint2(left, 0.8, z);
  source->Update();
  vtkPolyData* panel = source->GetOutput();
  vtkCSLFMaterial::SetBaseColor(panel, 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(panel, red, green, 0.0);
  vtkCSLFMaterial::SetOpacity(panel, opacity);
  scene->SetBlock(scene->GetNumberOfBlocks(), panel);
}

vtkSmartPointer<vtkUnsignedCharArray> Sample(
  vtkMultiBlockDataSet* scene, bool surfaceTexels, double noise = 0.0)
{
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputDataObject(scene);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(3);
  sampler->SetResolution(33);
  sampler->SetSamples(32);
  sampler->SetNoiseTarget(noise);
  sampler->SetMaximumDepth(0);
  sampler->SetSurfaceTexels(surfaceTexels);
  sampler->Update();
  return vtkUnsignedCharArray::SafeDownCast(
    sampler->GetOutput()->GetPointData()->GetArray(cslf::ColorName));
}

/// Texels that are fully covered and show some red and some green.
int CountMixed(vtkUnsignedCharArray* colors)
{
  int count = 0;
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    count += colors->GetTypedComponent(i, 3) == 255 && colors->GetTypedComponent(i, 0) > 0 &&
        colors->GetTypedComponent(i, 1) > 0
      ? 1
      : 0;
  }
  return count;
}

int CountDifferent(vtkUnsignedCharArray* a, vtkUnsignedCharArray* b, int component)
{
  int count = 0;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    count += a->GetTypedComponent(i, component) != b->GetTypedComponent(i, component) ? 1 : 0;
  }
  return count;
}
}

int TestCSLFSurfaceTexels(int, char*[])
{
  // A red panel before a green one. Where both are seen, the mean of a texel mixes them.
  vtkNew<vtkMultiBlockDataSet> panels;
  AddPanel(panels, -0.8, 0.8, -0.3, 0.0, 1.0, 1.0);
  AddPanel(panels, -0.33, 0.17, 0.0, 1.0, 0.0, 1.0);
  const auto surfaces = Sample(panels, true);
  const auto means = Sample(panels, false);
  CSLF_CHECK(CountMixed(surfaces) == 0);
  std::cout << CountMixed(means) << " mixed texels of " << means->GetNumberOfTuples() << "\n";
  CSLF_CHECK(CountMixed(means) > 30);
  CSLF_CHECK(CountDifferent(surfaces, means, 3) == 0);
  CSLF_CHECK(CountDifferent(surfaces, means, 0) > 30);
  // Also if few samples are enough.
  CSLF_CHECK(CountMixed(Sample(panels, true, 0.01)) == 0);

  // Light passes the red panel at random, so the green one is seen through it.
  vtkNew<vtkMultiBlockDataSet> veiled;
  AddPanel(veiled, -0.8, 0.8, -0.3, 0.0, 1.0, 1.0);
  AddPanel(veiled, -0.33, 0.17, 0.0, 1.0, 0.0, 0.6);
  const auto veiledSurfaces = Sample(veiled, true);
  const auto veiledMeans = Sample(veiled, false);
  std::cout << CountMixed(veiledSurfaces) << " texels of the veil\n";
  CSLF_CHECK(CountMixed(veiledSurfaces) > 300);
  int different = 0;
  for (vtkIdType i = 0; i < veiledSurfaces->GetNumberOfTuples(); ++i)
  {
    // Texels beside the veil that see it with some samples only.
    const int change =
      std::abs(veiledSurfaces->GetTypedComponent(i, 0) - veiledMeans->GetTypedComponent(i, 0));
    different += change > 0 ? 1 : 0;
  }
  CSLF_CHECK(different < 0.02 * veiledSurfaces->GetNumberOfTuples());

  // A curved surface alone: its texels are the same, but for those at the rim.
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(64);
  source->SetPhiResolution(64);
  source->Update();
  vtkNew<vtkMultiBlockDataSet> ball;
  ball->SetBlock(0, source->GetOutput());
  vtkCSLFMaterial::SetBaseColor(source->GetOutput(), 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(source->GetOutput(), 0.5, 0.25, 0.0);
  const auto ballSurfaces = Sample(ball, true);
  const auto ballMeans = Sample(ball, false);
  for (int component = 0; component < 4; ++component)
  {
    CSLF_CHECK(CountDifferent(ballSurfaces, ballMeans, component) == 0);
  }
  return cslf::testing::Result();
}
