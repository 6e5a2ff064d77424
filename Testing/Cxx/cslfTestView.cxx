// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestView.h"

#include "cslfTestField.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace testing
{
namespace
{
// An X server that loses its last client restarts, and breaks connections that are made at that
// moment, so a window is kept until the end.
void KeepDisplay()
{
  static vtkNew<vtkRenderWindow> kept;
  if (kept->GetNeverRendered())
  {
    kept->SetOffScreenRendering(1);
    kept->SetSize(16, 16);
    kept->Render();
  }
}
}

double Picture::GetMean() const
{
  double sum = 0.0;
  for (const unsigned char value : this->Colors)
  {
    sum += value;
  }
  return sum / static_cast<double>(this->Colors.size());
}

int Picture::CountDrawn() const
{
  return static_cast<int>(std::count_if(
    this->Depths.begin(), this->Depths.end(), [](double depth) { return depth < 1.0; }));
}

double ComparePictures(const Picture& a, const Picture& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.Colors.size(); ++i)
  {
    const double difference = static_cast<double>(a.Colors[i]) - b.Colors[i];
    sum += difference * difference;
  }
  const double mean = sum / static_cast<double>(a.Colors.size());
  return mean > 0.0 ? std::min(99.0, 10.0 * std::log10(255.0 * 255.0 / mean)) : 99.0;
}

double CompareDepths(const Picture& a, const Picture& b, vtkCamera* camera, double tolerance)
{
  double range[2];
  camera->GetClippingRange(range);
  const auto distance = [&](double depth)
  {
    return camera->GetParallelProjection()
      ? range[0] + depth * (range[1] - range[0])
      : range[0] * range[1] / (range[1] - depth * (range[1] - range[0]));
  };
  int drawn = 0;
  int same = 0;
  for (std::size_t i = 0; i < a.Depths.size(); ++i)
  {
    if (a.Depths[i] < 1.0)
    {
      ++drawn;
      same += std::abs(distance(a.Depths[i]) - distance(b.Depths[i])) <= tolerance;
    }
  }
  return drawn > 0 ? static_cast<double>(same) / drawn : 0.0;
}

View::View(int size)
{
  KeepDisplay();
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(size, size);
  this->Window->AddRenderer(this->Renderer);
  vtkCamera* camera = this->GetCamera();
  camera->SetPosition(1.2, 0.9, 5.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetClippingRange(1.0, 12.0);
}

vtkSmartPointer<vtkActor> View::Add(vtkMapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
  return actor;
}

Picture View::Render()
{
  this->Window->Render();
  Picture picture;
  const int* size = this->Window->GetSize();
  picture.Width = size[0];
  vtkNew<vtkUnsignedCharArray> colors;
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, colors);
  picture.Colors.assign(colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues());
  vtkNew<vtkFloatArray> depths;
  this->Window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depths);
  picture.Depths.assign(depths->GetPointer(0), depths->GetPointer(0) + depths->GetNumberOfValues());
  return picture;
}

vtkSmartPointer<vtkCSLFMapper> MakeTestMapper()
{
  static const auto field =
    MakeTestField(Layout(9, 64), Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  auto mapper = vtkSmartPointer<vtkCSLFMapper>::New();
  mapper->SetInputData(field);
  return mapper;
}

vtkSmartPointer<vtkMapper> MakeSurfaceMapper()
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(MakeTestSurfaces(Cube()));
  return mapper;
}
}
}
