// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDrawnViews.h"

#include <vtkRenderWindow.h>
#include <vtkRendererCollection.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// Frames for which a view is kept that is not drawn: enough for cameras that take turns.
constexpr std::int64_t KeptFrames = 32;

/// The most places of one actor. Only frames that are not those of a window have so many.
constexpr int MaximumPlaces = 256;

/// Bytes for the pictures of a window: twelve pictures of 1920 x 1080 pixels.
constexpr std::int64_t MaximumPictureBytes = std::int64_t(256) << 20;

/// Whether the frame is drawn to find what lies under pixels.
bool IsSelecting(vtkRenderWindow* window)
{
  vtkCollectionSimpleIterator cookie;
  vtkRendererCollection* renderers = window->GetRenderers();
  renderers->InitTraversal(cookie);
  while (vtkRenderer* renderer = renderers->GetNextRenderer(cookie))
  {
    if (renderer->GetSelector())
    {
      return true;
    }
  }
  return false;
}

/// Whether a view of the previous frame may be drawn again, as far as its renderer tells.
bool MayBeDrawn(const DrawnView& view, vtkRenderWindow* window)
{
  return view.Actor->GetVisibility() && view.Renderer->GetDraw() &&
    view.Renderer->GetRenderWindow() == window &&
    (!view.IsByActiveCamera || view.Camera == view.Renderer->GetActiveCamera());
}
}

bool DrawnViews::IsGone(const DrawnView& view) const
{
  return !view.Renderer || !view.Camera || !view.Actor || view.Frame + KeptFrames < this->Frame;
}

void DrawnViews::BeginFrame(vtkRenderWindow* window)
{
  if (IsSelecting(window))
  {
    return;
  }
  ++this->Frame;
  const auto gone = std::stable_partition(this->Views.begin(), this->Views.end(),
    [this](const auto& view) { return !this->IsGone(*view); });
  if (gone != this->Views.end())
  {
    window->MakeCurrent();
    std::for_each(gone, this->Views.end(), [&](auto& view) { view->Picture.Release(window); });
    this->Views.erase(gone, this->Views.end());
  }
  for (const auto& view : this->Views)
  {
    view->IsExpected = view->Frame + 1 == this->Frame && MayBeDrawn(*view, window);
  }
}

void DrawnViews::EndFrame(vtkRenderWindow* window)
{
  if (IsSelecting(window) || window->GetAbortRender())
  {
    return;
  }
  this->IsAnyShown = false;
  for (const auto& view : this->Views)
  {
    if (view->Frame == this->Frame && view->Renderer)
    {
      this->IsAnyShown = true;
      view->IsByActiveCamera = view->Camera == view->Renderer->GetActiveCamera();
    }
  }
}

DrawnView& DrawnViews::Find(vtkRenderer* renderer, vtkActor* actor, const glm::dmat4& ccwc)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  DrawnView* moved = nullptr; // the one drawn longest ago that is not at its place
  int places = 0;
  for (const auto& view : this->Views)
  {
    if (view->Renderer != renderer || view->Camera != camera || view->Actor != actor ||
      view->Eye != camera->GetLeftEye())
    {
      continue;
    }
    if (view->CCWC == ccwc)
    {
      return *view;
    }
    ++places;
    moved = !moved || view->Frame < moved->Frame ? view.get() : moved;
  }
  // An actor that was drawn in this frame is now at another place, otherwise it has moved.
  if (!moved || (moved->Frame == this->Frame && places < MaximumPlaces))
  {
    this->Views.push_back(std::make_unique<DrawnView>());
    moved = this->Views.back().get();
    moved->Renderer = renderer;
    moved->Camera = camera;
    moved->Actor = actor;
    moved->Eye = camera->GetLeftEye();
    moved->Frame = -1;
  }
  moved->CCWC = ccwc;
  return *moved;
}

bool DrawnViews::SetDrawn(DrawnView& view)
{
  const bool isDrawn = view.Frame == this->Frame;
  view.Frame = this->Frame;
  view.IsExpected = true;
  this->IsAnyShown = true;
  return isDrawn;
}

std::vector<ViewFrustum> DrawnViews::GetExpectedFrustums() const
{
  std::vector<ViewFrustum> frustums;
  for (const auto& view : this->Views)
  {
    if (view->IsExpected)
    {
      frustums.push_back(view->Frustum);
    }
  }
  return frustums;
}

std::vector<ViewFrustum> DrawnViews::GetFrustums() const
{
  std::vector<ViewFrustum> frustums;
  for (const auto& view : this->Views)
  {
    frustums.push_back(view->Frustum);
  }
  return frustums;
}

bool DrawnViews::AreRefined() const
{
  return std::all_of(this->Views.begin(), this->Views.end(),
    [this](const auto& view) { return view->Frame != this->Frame || view->Picture.IsRefined(); });
}

void DrawnViews::LimitPictures(vtkRenderWindow* window, DrawnView& view)
{
  std::vector<DrawnView*> others;
  std::int64_t bytes = view.Picture.GetBytes();
  for (const auto& other : this->Views)
  {
    bytes += other.get() == &view ? 0 : other->Picture.GetBytes();
    if (other.get() != &view && other->Picture.GetBytes() > 0)
    {
      others.push_back(other.get());
    }
  }
  std::stable_sort(others.begin(), others.end(),
    [](const DrawnView* a, const DrawnView* b) { return a->Frame < b->Frame; });
  for (DrawnView* other : others)
  {
    if (bytes <= MaximumPictureBytes)
    {
      break;
    }
    bytes -= other->Picture.GetBytes();
    other->Picture.Release(window);
    // Those of one frame would free each other in the next one, too, and never be refined.
    if (other->Frame == this->Frame)
    {
      other->IsCrowded = true;
      view.IsCrowded = true;
    }
  }
}

void DrawnViews::Release(vtkWindow* window)
{
  for (const auto& view : this->Views)
  {
    view->Picture.Release(window);
  }
  this->Views.clear();
  this->IsAnyShown = false;
}
}
