// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures that VTK draws where nobody sees them.
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

namespace cslf
{
namespace tool
{
/// The red, green and blue of what a window shows. Throws a Failure.
vtkSmartPointer<vtkImageData> GrabPicture(vtkRenderWindow* window);

/// A black window off the screen.
class OffscreenWindow
{
public:
  OffscreenWindow(int width, int height);
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  void AddActor(vtkActor* actor);

  /// As vtkRenderWindow::DesiredUpdateRate: pictures a second.
  void SetDesiredUpdateRate(double rate);

  /// Draws, waits until the picture is done, and returns the seconds that both took. Throws a
  /// Failure.
  double Draw(vtkCamera* camera);

  /// The red, green and blue of what was drawn last. Throws a Failure.
  vtkSmartPointer<vtkImageData> Grab();

  /// OpenGL's name of what draws, once something was drawn.
  std::string GetDeviceName();

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};
}
}

#endif
