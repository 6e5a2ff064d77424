// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The views in which a window shows a light field.
 */
#ifndef cslfDrawnViews_h
#define cslfDrawnViews_h

#include "cslfLookupPicture.h"
#include "cslfViewFrustum.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkWeakPointer.h>

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <memory>
#include <vector>

class vtkRenderWindow;
class vtkWindow;

namespace cslf
{
/// A field as an actor shows it to one eye of a camera in a renderer. An actor that is part of
/// several assemblies has a view at each of its places.
struct DrawnView
{
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkWeakPointer<vtkCamera> Camera;
  vtkWeakPointer<vtkActor> Actor;
  int Eye = 0;
  glm::dmat4 CCWC{ 1.0 }; ///< the place
  ViewFrustum Frustum;
  LookupPicture Picture;
  int Samples = 1;               ///< of the picture that is being drawn
  bool IsCrowded = false;        ///< its picture and those drawn beside it do not fit together
  std::int64_t Frame = 0;        ///< in which it was last drawn
  bool IsExpected = true;        ///< in the frame that is being drawn
  bool IsByActiveCamera = false; ///< whether the renderer's own camera saw it, not that of a pass
};

/// All views of a field in one window: several actors may share a mapper, several renderers an
/// actor, and both eyes draw in stereo. Views that are not drawn for a while are removed.
class DrawnViews
{
public:
  /// To be called when the window begins and ends a frame. Frames that are not shown, because they
  /// are drawn for a hardware selection or aborted, change nothing.
  void BeginFrame(vtkRenderWindow* window);
  void EndFrame(vtkRenderWindow* window);

  /// The view that is being drawn, at a place from CC to WC.
  DrawnView& Find(vtkRenderer* renderer, vtkActor* actor, const glm::dmat4& ccwc);

  /// Records that a view is drawn. Returns whether an earlier pass of this frame has drawn it.
  bool SetDrawn(DrawnView& view);

  /// What this frame's views see, as far as it is known: those that were drawn, and those of the
  /// previous frame whose turn may come.
  std::vector<ViewFrustum> GetExpectedFrustums() const;

  /// What all views see.
  std::vector<ViewFrustum> GetFrustums() const;

  /// Whether the last frame shows any view.
  bool AreShown() const { return this->IsAnyShown; }

  /// Whether the pictures of the last frame have all rays that they should have.
  bool AreRefined() const;

  /// Frees the pictures that were drawn longest ago, apart from that of `view`, until the others
  /// fit into the memory for pictures.
  void LimitPictures(vtkRenderWindow* window, DrawnView& view);

  /// Removes all views. The window's context must be current.
  void Release(vtkWindow* window);

private:
  bool IsGone(const DrawnView& view) const;

  std::vector<std::unique_ptr<DrawnView>> Views; ///< in the order in which they were first drawn
  std::int64_t Frame = 0;
  bool IsAnyShown = false;
};
}

#endif
