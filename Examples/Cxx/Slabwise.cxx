// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A light field is image data, and ordinary VTK filters take it apart, slab by slab: one viewpoint
// as a picture, an epipolar-plane image, and how bright the scene is from each face. Only the
// viewpoints that are requested are sampled.
// Slabwise [viewpoints per side] [texels per side] [samples]
#include "Example.h"

#include <vtkCSLFCornellBoxSource.h>
#include <vtkCSLFEnvironment.h>

#include <vtkExtractVOI.h>
#include <vtkImageAccumulate.h>
#include <vtkImageExtractComponents.h>
#include <vtkImageFlip.h>
#include <vtkImagePermute.h>
#include <vtkImageResize.h>

#include <iostream>

namespace
{
constexpr int Front = 4; // the face +Z, before the box's open side
constexpr int Back = 5;  // the face -Z

/// The z of a viewpoint: i along u, j along v.
int GetViewpoint(vtkCSLFSampler* sampler, int face, int i, int j)
{
  const int m = sampler->GetViewpoints();
  return (face * m + j) * m + i;
}

/// The first x of the tile that shows an exit face: the entry face has none.
int GetTile(vtkCSLFSampler* sampler, int entry, int exit)
{
  return (exit > entry ? exit - 1 : exit) * sampler->GetResolution();
}

/// The middle viewpoint of a face, whose five tiles lie side by side.
vtkSmartPointer<vtkAlgorithm> ExtractMiddle(vtkCSLFSampler* sampler, int face)
{
  const int n = sampler->GetResolution();
  const int middle = sampler->GetViewpoints() / 2;
  const int z = GetViewpoint(sampler, face, middle, middle);
  auto part = vtkSmartPointer<vtkExtractVOI>::New();
  part->SetInputConnection(sampler->GetOutputPort());
  part->SetVOI(0, 5 * n - 1, 0, n - 1, z, z);
  return part;
}

/// One viewpoint as a picture: the middle of the face +Z.
vtkSmartPointer<vtkAlgorithm> ExtractViewpoint(vtkCSLFSampler* sampler)
{
  const auto part = ExtractMiddle(sampler, Front);
  vtkNew<vtkImageExtractComponents> colors;
  colors->SetInputConnection(part->GetOutputPort());
  colors->SetComponents(0, 1, 2);
  // Row 0 of a field is the top, that of VTK's images the bottom.
  auto upright = vtkSmartPointer<vtkImageFlip>::New();
  upright->SetInputConnection(colors->GetOutputPort());
  upright->SetFilteredAxis(1);
  return upright;
}

/// An epipolar-plane image: one row of texels towards the face -Z, of all viewpoints along u.
/// Objects near the face move fast from viewpoint to viewpoint: the flatter a line, the nearer the
/// surface.
vtkSmartPointer<vtkAlgorithm> ExtractEpipolarPlane(vtkCSLFSampler* sampler)
{
  const int n = sampler->GetResolution();
  const int m = sampler->GetViewpoints();
  const int x = GetTile(sampler, Front, Back);
  const int y = n * 2 / 3;
  vtkNew<vtkExtractVOI> part;
  part->SetInputConnection(sampler->GetOutputPort());
  part->SetVOI(x, x + n - 1, y, y, GetViewpoint(sampler, Front, 0, m / 2),
    GetViewpoint(sampler, Front, m - 1, m / 2));
  vtkNew<vtkImageExtractComponents> colors;
  colors->SetInputConnection(part->GetOutputPort());
  colors->SetComponents(0, 1, 2);
  vtkNew<vtkImagePermute> lines; // viewpoints along y
  lines->SetInputConnection(colors->GetOutputPort());
  lines->SetFilteredAxes(0, 2, 1);
  auto wide = vtkSmartPointer<vtkImageResize>::New();
  wide->SetInputConnection(lines->GetOutputPort());
  wide->SetOutputDimensions(5 * n, 5 * m, 1);
  wide->InterpolateOff();
  return wide;
}

bool WritePicture(vtkAlgorithm* picture, const char* fileName)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
  return writer->GetErrorCode() == 0;
}

/// The mean of green of a face's middle viewpoint. Light leaves the box only through its open side.
double GetBrightness(vtkCSLFSampler* sampler, int face)
{
  const auto part = ExtractMiddle(sampler, face);
  vtkNew<vtkImageExtractComponents> green;
  green->SetInputConnection(part->GetOutputPort());
  green->SetComponents(1);
  vtkNew<vtkImageAccumulate> statistics;
  statistics->SetInputConnection(green->GetOutputPort());
  statistics->Update();
  return statistics->GetMean()[0];
}
}

int main(int argc, char* argv[])
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone(); // the box has a lamp
  example::SetSizes(sampler, argc, argv, 33, 64);

  const bool written = WritePicture(ExtractViewpoint(sampler), "SlabwiseViewpoint.png") &&
    WritePicture(ExtractEpipolarPlane(sampler), "SlabwiseEpipolar.png");
  for (int face = 0; face < 6; ++face)
  {
    std::cout << "face " << face << ": " << GetBrightness(sampler, face) << " of 255\n";
  }
  return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
