// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A part of the viewer's window, for the viewer's own files.
 */
#ifndef cslfViewerPane_h
#define cslfViewerPane_h

#include "cslfViewer.h"

#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <array>
#include <string>

namespace cslf::tool
{
constexpr int TruthPane = -1; ///< stands for the reference instead of a lookup

struct Viewer::Pane
{
  Viewer* Owner;
  std::string Name;
  int Lookup;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkTextActor> Label;
  double PSNR = 0.0; ///< of the lookup in this view; 0 if it was not measured
};

/// In pixels.
inline std::array<int, 2> GetSize(vtkRenderer* renderer)
{
  int corner[2];
  std::array<int, 2> size;
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &corner[0], &corner[1]);
  return size;
}
}

#endif
