// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The viewer's figures: frames per second, and the quality of lookups compared with the reference.
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Measurements/cslfNovelViews.h"
#include "cslfViewer.h"

#include "vtkCSLFImageQuality.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSeriesReader.h"
#include "vtkCSLFToneMapping.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <initializer_list>
#include <numeric>

namespace cslf::tool
{
namespace
{
constexpr std::size_t FramesAveraged = 10;

/// Lookups are measured over black, as by cslf evaluate.
constexpr double Black[3] = { 0.0, 0.0, 0.0 };
}

void Viewer::CountFrame(vtkObject*, unsigned long event, void* client, void*)
{
  auto* viewer = static_cast<Viewer*>(client);
  const auto now = std::chrono::steady_clock::now();
  if (event == vtkCommand::StartEvent)
  {
    viewer->FrameStart = now;
    return;
  }
  viewer->FieldActor->VisibilityOn();
  viewer->FrameSeconds.push_back(std::chrono::duration<double>(now - viewer->FrameStart).count());
  if (viewer->FrameSeconds.size() > FramesAveraged)
  {
    viewer->FrameSeconds.pop_front();
  }
}

void Viewer::ShowState()
{
  const bool isMeasured = this->IsTruthCurrent();
  for (const auto& pane : this->Panes)
  {
    if (pane->Lookup != TruthPane)
    {
      const std::string figure =
        isMeasured && pane->PSNR > 0.0 ? ": " + Format(pane->PSNR, 1) + " dB" : "";
      pane->Label->SetInput((pane->Name + figure).c_str());
    }
  }
  const Layout& grid = this->Field.Grid;
  const std::string m = std::to_string(grid.GetViewpoints());
  const std::string n = std::to_string(grid.GetResolution());
  std::string text = "6 x " + m + " x " + m + " viewpoints of " + n + " x " + n + " texels";
  if (this->Decoder && this->Decoder->IsUnfinished())
  {
    vtkNew<vtkIdTypeArray> unwritten;
    this->Decoder->GetUnwrittenViewpoints(unwritten);
    text += "\n" + std::to_string(grid.GetSlices() - unwritten->GetNumberOfValues()) + " of " +
      std::to_string(grid.GetSlices()) + " viewpoints so far";
  }
  if (const auto time = this->GetTime())
  {
    text += "\ntime " + Format(*time, 4) + ", step " + std::to_string(this->Step) + " of 0 to " +
      std::to_string(this->Decoder->GetNumberOfTimeSteps() - 1);
  }
  if (this->GetTextureBytes() > 0)
  {
    text += "\n" + Format(static_cast<double>(this->GetTextureBytes()) / (1 << 20), 1) +
      " MiB of textures";
  }
  if (this->GetFrameRate() > 0.0)
  {
    text += "\n" + Format(this->GetFrameRate(), 1) + " frames/s";
  }
  vtkCSLFToneMapping* tone = this->Mapper->GetToneMapping();
  if (!tone->IsIdentity())
  {
    text += "\nexposure " + Format(tone->GetExposure(), 2) + ", " + tone->GetCurveAsString();
  }
  this->StateText->SetInput(text.c_str());
  this->StateText->SetVisibility(this->ShowsState);
  this->HelpText->SetInput(this->ShowsHelp ? GetHelp().c_str() : "h: help");
}

// Draws each lookup in the reference's place, so that pixels match, without showing it.
void Viewer::Measure()
{
  const std::vector<Pane*> shown = this->GetShownPanes();
  Pane* place = this->FindPane(TruthPane);
  std::vector<vtkProp*> hidden;
  for (vtkProp* prop :
    std::initializer_list<vtkProp*>{ this->Outline, this->Axes, this->Markers, place->Label })
  {
    if (prop->GetVisibility())
    {
      hidden.push_back(prop);
    }
  }
  const auto setHidden = [&](bool isHidden)
  {
    for (vtkProp* prop : hidden)
    {
      prop->SetVisibility(!isHidden);
    }
    for (Pane* pane : shown)
    {
      pane->Renderer->SetDraw(!isHidden || pane == place);
    }
    this->Overlay->SetDraw(!isHidden);
    this->Window->SetSwapBuffers(!isHidden);
  };
  const std::deque<double> frames = this->FrameSeconds;
  setHidden(true);
  place->Renderer->SetBackground(Black[0], Black[1], Black[2]);
  for (Pane* pane : shown)
  {
    if (pane != place)
    {
      pane->PSNR = this->MeasureLookup(pane->Lookup, place);
    }
  }
  place->Renderer->SetBackground(this->Backdrop->GetBackground());
  setHidden(false);
  this->FrameSeconds = frames;
}

double Viewer::MeasureLookup(int lookup, Pane* place)
{
  int size[2];
  int corner[2];
  place->Renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &corner[0], &corner[1]);
  this->MeasuredLookup = lookup;
  this->Window->Render();
  this->MeasuredLookup = TruthPane;
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetPixelData(
    corner[0], corner[1], corner[0] + size[0] - 1, corner[1] + size[1] - 1, 0, pixels);
  vtkNew<vtkImageData> seen;
  seen->SetDimensions(size[0], size[1], 1);
  seen->GetPointData()->SetScalars(pixels);
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, this->Truth->MakePicture(this->Mapper->GetToneMapping(), Black));
  quality->SetInputData(1, seen);
  quality->SetStencilData(MakeCubeStencil(this->Field.Box, this->Camera, size[0], size[1]));
  quality->Update();
  ThrowOnError();
  return quality->GetPSNR();
}

double Viewer::GetFrameRate() const
{
  const double seconds = std::accumulate(this->FrameSeconds.begin(), this->FrameSeconds.end(), 0.0);
  return seconds > 0.0 ? static_cast<double>(this->FrameSeconds.size()) / seconds : 0.0;
}

std::map<std::string, double> Viewer::GetPSNR() const
{
  std::map<std::string, double> values;
  for (const auto& pane : this->Panes)
  {
    if (pane->PSNR > 0.0)
    {
      values[pane->Name] = pane->PSNR;
    }
  }
  return values;
}
}
