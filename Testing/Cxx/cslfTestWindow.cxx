// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestWindow.h"

#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace cslf
{
namespace testing
{
std::vector<unsigned char> DrawWindow(vtkRenderer* renderer, int size, double background)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(size, size);
  window->AddRenderer(renderer);
  renderer->SetBackground(background, background, background);
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, size - 1, size - 1, 0, pixels);
  window->RemoveRenderer(renderer);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

std::vector<unsigned char> TraceBake(vtkRenderer* renderer, int size, const BakeOptions& options)
{
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->SetHeadlightsAllAround(options.HeadlightsAllAround);
  importer->SetPixelSize(options.PixelSize);
  importer->SetPointRadius(options.PointRadius);
  importer->SetInterpolateDisplayedColors(options.InterpolateDisplayedColors);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetIntegrator(options.Integrator);
  tracer->SetInputConnection(importer->GetOutputPort());
  tracer->SetCamera(renderer->GetActiveCamera());
  tracer->SetSize(size, size);
  tracer->SetSamples(options.Samples);
  tracer->SetMaximumDepth(options.MaximumDepth);
  tracer->Update();
  vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
  std::vector<unsigned char> pixels;
  for (vtkIdType i = 0; colors && i < colors->GetNumberOfTuples(); ++i)
  {
    // Colours are associated with alpha.
    const double behind = options.Background * (255.0 - colors->GetComponent(i, 3));
    for (int c = 0; c < 3; ++c)
    {
      pixels.push_back(
        static_cast<unsigned char>(std::min(colors->GetComponent(i, c) + behind + 0.5, 255.0)));
    }
  }
  pixels.resize(3 * static_cast<std::size_t>(size) * size);
  return pixels;
}

int WindowAndBake::GetDifference(int column, int row) const
{
  const std::size_t pixel = 3 * (static_cast<std::size_t>(row) * this->Size + column);
  int largest = 0;
  for (int c = 0; c < 3; ++c)
  {
    largest = std::max(largest, std::abs(this->Window[pixel + c] - this->Bake[pixel + c]));
  }
  return largest;
}

double WindowAndBake::GetPartOutside(int tolerance) const
{
  int outside = 0;
  for (int pixel = 0; pixel < this->Size * this->Size; ++pixel)
  {
    bool isOutside = false;
    for (int c = 0; c < 3; ++c)
    {
      int lowest = 255;
      int highest = 0;
      for (int i = 0; i < 9; ++i)
      {
        const int column = std::clamp(pixel % this->Size + i % 3 - 1, 0, this->Size - 1);
        const int row = std::clamp(pixel / this->Size + i / 3 - 1, 0, this->Size - 1);
        const int value = this->Window[3 * (row * this->Size + column) + c];
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
      const int traced = this->Bake[3 * pixel + c];
      isOutside = isOutside || traced < lowest - tolerance || traced > highest + tolerance;
    }
    outside += isOutside ? 1 : 0;
  }
  return static_cast<double>(outside) / (this->Size * this->Size);
}

WindowAndBake DrawAndTrace(vtkRenderer* renderer, int size, const BakeOptions& options)
{
  WindowAndBake result;
  result.Size = size;
  result.Window = DrawWindow(renderer, size, options.Background);
  result.Bake = TraceBake(renderer, size, options);
  return result;
}
}
}
