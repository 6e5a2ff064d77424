// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares the shapes and hues that VTK draws for a renderer with traced ones.
 */
#ifndef cslfTestShapes_h
#define cslfTestShapes_h

#include "cslfTesting.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>

namespace cslf
{
namespace testing
{
/// A black window with one renderer, whose camera looks along -z at [-1,1].
class ShapeComparison
{
public:
  explicit ShapeComparison(int side = 96)
    : Side(side)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0, 0, 10);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(1.0);
    camera->SetClippingRange(1.0, 30.0);
    this->Window->SetSize(side, side);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(this->Renderer);
  }

  void ShowOnly(vtkProp* prop)
  {
    this->Renderer->RemoveAllViewProps();
    this->Renderer->AddViewProp(prop);
  }

  /// Draws and traces.
  void Update()
  {
    this->Drawn->SetInput(this->Window);
    this->Drawn->ReadFrontBufferOff();
    this->Drawn->Modified();
    this->Drawn->Update();
    this->Traced->SetRenderer(this->Renderer);
    this->Traced->SetCamera(this->Renderer->GetActiveCamera());
    this->Traced->SetSize(this->Side, this->Side);
    this->Traced->SetSamples(4);
    this->Traced->SetMaximumDepth(1);
    this->Traced->Update();
  }

  /// The share of the covered pixels where only one of the pictures shows something, or where the
  /// hues differ.
  double Compare()
  {
    this->Update();
    vtkDataArray* drawn = this->Drawn->GetOutput()->GetPointData()->GetScalars();
    vtkDataArray* traced = this->Traced->GetOutput()->GetPointData()->GetScalars();
    int differ = 0;
    this->Covered = 0;
    for (vtkIdType i = 0; i < drawn->GetNumberOfTuples(); ++i)
    {
      const bool a = GetLargest(drawn, i) > 20;
      const bool b = traced->GetComponent(i, 3) >= 128;
      this->Covered += a ? 1 : 0;
      differ += a != b || (a && GetHue(drawn, i) != GetHue(traced, i)) ? 1 : 0;
    }
    return this->Covered > 0 ? static_cast<double>(differ) / this->Covered : 1.0;
  }

  /// The colours at a place in [-1,1], of the drawn picture or the traced one.
  void GetColor(bool traced, double x, double y, double color[3]) const
  {
    vtkImageData* picture = traced ? this->Traced->GetOutput() : this->Drawn->GetOutput();
    const int column = static_cast<int>(0.5 * (x + 1.0) * this->Side);
    const int row = static_cast<int>(0.5 * (y + 1.0) * this->Side);
    for (int c = 0; c < 3; ++c)
    {
      color[c] = picture->GetPointData()->GetScalars()->GetComponent(row * this->Side + column, c);
    }
  }

  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkWindowToImageFilter> Drawn;
  vtkNew<vtkCSLFViewTracer> Traced;
  int Covered = 0; ///< pixels of the drawn picture that are not black

private:
  static double GetLargest(vtkDataArray* colors, vtkIdType pixel)
  {
    return std::max({ colors->GetComponent(pixel, 0), colors->GetComponent(pixel, 1),
      colors->GetComponent(pixel, 2) });
  }

  /// Which components are bright.
  static int GetHue(vtkDataArray* colors, vtkIdType pixel)
  {
    int hue = 0;
    for (int c = 0; c < 3; ++c)
    {
      hue |= colors->GetComponent(pixel, c) > 0.5 * GetLargest(colors, pixel) ? 1 << c : 0;
    }
    return hue;
  }

  int Side;
};
}
}

#endif
