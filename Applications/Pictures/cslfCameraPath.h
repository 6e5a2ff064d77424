// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Camera paths: around the cube, back and forth in front of it, or along a file's key cameras.
 */
#ifndef cslfCameraPath_h
#define cslfCameraPath_h

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkCamera;

namespace CLI
{
class App;
}

namespace cslf::tool
{
constexpr const char* OrbitName = "orbit";
constexpr const char* SwingName = "swing";

/// In degrees. From other directions the Cornell box shows its unlit outside.
constexpr double SwingAngle = 35.0;

/// One full turn around the focal point, about the direction that is up in the picture. Begins at
/// `start` and ends one step before it.
std::vector<vtkSmartPointer<vtkCamera>> MakeOrbit(vtkCamera* start, int frames);

/// Likewise, but back and forth, within SwingAngle of +Z, where the Cornell box opens. Throws a
/// Failure if `start` is not within it.
std::vector<vtkSmartPointer<vtkCamera>> MakeSwing(vtkCamera* start, int frames);

class CameraPathOptions
{
public:
  void AddTo(CLI::App& command);

  bool IsEmpty() const { return this->Path.empty(); }

  const std::string& GetPath() const { return this->Path; }

  /// One camera for each frame: MakeOrbit, MakeSwing, or a spline through a file's cameras, from
  /// the first to the last, with the view angle of `start`. Throws a Failure.
  std::vector<vtkSmartPointer<vtkCamera>> MakeCameras(vtkCamera* start) const;

private:
  std::string Path;
  int Frames = 72;
};
}

#endif
