// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A window with a higher desired update rate than possible gets fewer rays while the view moves,
// and all when it is still.
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cstdlib>
#include <iostream>
#include <vector>

namespace
{
constexpr int Size = 160;
using Pixels = std::vector<unsigned char>;

Pixels Render(vtkRenderWindow* window)
{
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixels);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

/// The number of pixels that differ from the left one of their block.
int CountChanges(const Pixels& pixels, int block)
{
  int changes = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        const int left = x / block * block;
        changes += pixels[3 * (y * Size + x) + c] != pixels[3 * (y * Size + left) + c];
      }
    }
  }
  return changes;
}

/// Replaces each block by one of its pixels.
Pixels Coarsen(const Pixels& pixels, int block)
{
  Pixels coarse;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const int middle = (y / block * block + block / 2) * Size + x / block * block + block / 2;
      coarse.insert(coarse.end(), &pixels[3 * middle], &pixels[3 * middle] + 3);
    }
  }
  return coarse;
}

double CountDifference(const Pixels& a, const Pixels& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(a[i] - b[i]);
  }
  return sum / static_cast<double>(a.size());
}
}

int TestCSLFMapperResolution(int, char*[])
{
  const auto field = cslf::testing::MakeTestField(
    cslf::Layout(3, 32), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputData(field);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Size, Size);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(1.0, 0.5, 5.0);
  renderer->ResetCamera();
  constexpr double turn = 10.0;
  const Pixels whole = Render(window);
  CSLF_CHECK(CountChanges(whole, 2) > 0);
  camera->Azimuth(turn);
  const Pixels turned = Render(window);

  // Far more than any machine can draw: the first picture is coarse by an estimate, with half of
  // the pixels along each side, the next by a measurement, with a quarter. It is interpolated
  // between pixels.
  window->SetDesiredUpdateRate(1.0e9);
  camera->Azimuth(-turn);
  const double byGuess = CountDifference(Render(window), whole);
  camera->Azimuth(turn);
  const Pixels coarse = Render(window);
  const double byMeasure = CountDifference(coarse, turned);
  const double ofHalf = CountDifference(Coarsen(whole, 2), whole);
  const double ofQuarter = CountDifference(Coarsen(turned, 4), turned);
  std::cout << "differences: " << byGuess << " of " << ofHalf << " by guess, " << byMeasure
            << " of " << ofQuarter << " by measure\n";
  CSLF_CHECK(byGuess > 0.25 * ofHalf && byGuess < ofHalf);
  CSLF_CHECK(byMeasure > 0.5 * ofQuarter && byMeasure < ofQuarter);
  CSLF_CHECK(byMeasure > byGuess);
  CSLF_CHECK(CountChanges(coarse, 4) > 0);

  window->SetDesiredUpdateRate(1.0e-4);
  CSLF_CHECK(CountDifference(Render(window), turned) < 0.1);

  mapper->AutoAdjustResolutionOff();
  window->SetDesiredUpdateRate(1.0e9);
  camera->Azimuth(-turn);
  CSLF_CHECK(CountDifference(Render(window), whole) < 0.1);
  return cslf::testing::Result();
}
