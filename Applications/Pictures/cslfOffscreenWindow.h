// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures that VTK draws off screen.
 */
#ifndef cslfOffscreenWindow_h
#define cslfOffscreenWindow_h

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkActor;
class vtkCamera;
class vtkImageData;
class vtkRenderWindow;
class vtkRenderer;

namespace cslf::tool
{
/// The red, green and blue of a window's picture. Throws a Failure.
vtkSmartPointer<vtkImageData> GrabPicture(vtkRenderWindow* window);

/// An off-screen window, by default black.
class OffscreenWindow
{
public:
  OffscreenWindow(int width, int height);
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  void AddActor(vtkActor* actor);
  void SetBackground(const double color[3]);

  /// Like vtkRenderWindow::DesiredUpdateRate, in frames per second.
  void SetDesiredUpdateRate(double rate);

  /// Draws, waits until the picture is finished, and returns the seconds for both. Throws a
  /// Failure.
  double Draw(vtkCamera* camera);

  /// The red, green and blue of the last picture. Throws a Failure.
  vtkSmartPointer<vtkImageData> Grab();

  /// OpenGL's name of the renderer, after something was drawn.
  std::string GetDeviceName();

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};
}

#endif
