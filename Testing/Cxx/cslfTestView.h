// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An off-screen window with the test field, and its picture as numbers.
 */
#ifndef cslfTestView_h
#define cslfTestView_h

#include "cslfCube.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace cslf
{
namespace testing
{
/// The pixels of a picture, rows from the bottom up.
struct Picture
{
  int Width = 0;
  std::vector<unsigned char> Colors; ///< red, green, blue
  std::vector<double> Depths;        ///< 0 at the near plane, 1 at the far one and behind it

  /// Of red, green and blue, in levels.
  double GetMean() const;
  /// The pixels that were drawn to.
  int CountDrawn() const;
};

/// In dB, capped at 99.
double ComparePictures(const Picture& a, const Picture& b);

/// The share of the pixels drawn in `a` that lie within `tolerance`, in world coordinates, of the
/// pixels of `b`.
double CompareDepths(const Picture& a, const Picture& b, vtkCamera* camera, double tolerance);

class View
{
public:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;

  /// Black, without multisampling. The camera is in front of the cube [-1,1]^3, a little to its
  /// right and above, with clipping range [1, 12].
  explicit View(int size = 128);

  vtkSmartPointer<vtkActor> Add(vtkMapper* mapper);
  vtkCamera* GetCamera() { return this->Renderer->GetActiveCamera(); }

  /// Draws with the current camera.
  Picture Render();
};

/// A mapper of the test field with 9 x 9 viewpoints of 64 x 64 texels, which is made once.
vtkSmartPointer<vtkCSLFMapper> MakeTestMapper();

/// A mapper of the test field's surfaces.
vtkSmartPointer<vtkMapper> MakeSurfaceMapper();
}
}

#endif
