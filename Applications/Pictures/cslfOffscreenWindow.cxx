// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOffscreenWindow.h"

#include "Console/cslfMessages.h"
#include "cslfSeconds.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <chrono>
#include <regex>

namespace cslf::tool
{
vtkSmartPointer<vtkImageData> GrabPicture(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->SetInputBufferTypeToRGB();
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  grabber->Update();
  ThrowOnError();
  return grabber->GetOutput();
}

OffscreenWindow::OffscreenWindow(int width, int height)
{
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
}

OffscreenWindow::~OffscreenWindow() = default;

void OffscreenWindow::AddActor(vtkActor* actor)
{
  this->Renderer->AddActor(actor);
}

void OffscreenWindow::SetBackground(const double color[3])
{
  this->Renderer->SetBackground(color[0], color[1], color[2]);
}

void OffscreenWindow::SetDesiredUpdateRate(double rate)
{
  this->Window->SetDesiredUpdateRate(rate);
}

double OffscreenWindow::Draw(vtkCamera* camera)
{
  this->Renderer->SetActiveCamera(camera);
  const auto start = std::chrono::steady_clock::now();
  this->Renderer->ResetCameraClippingRange();
  this->Window->Render();
  this->Window->WaitForCompletion();
  const double seconds = SecondsSince(start);
  ThrowOnError();
  return seconds;
}

vtkSmartPointer<vtkImageData> OffscreenWindow::Grab()
{
  return GrabPicture(this->Window);
}

std::string OffscreenWindow::GetDeviceName()
{
  static const std::regex line("OpenGL renderer string: *([^\n]*)");
  const std::string capabilities = this->Window->ReportCapabilities();
  std::smatch match;
  return std::regex_search(capabilities, match, line) ? match[1].str() : "unknown";
}
}
