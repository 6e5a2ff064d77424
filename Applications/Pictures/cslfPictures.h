// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures: from files, to files, and drawn from a light field.
 */
#ifndef cslfPictures_h
#define cslfPictures_h

#include "Fields/cslfFieldFiles.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkActor;
class vtkAlgorithmOutput;
class vtkCSLFMapper;
class vtkCSLFToneMapping;
class vtkCamera;
class vtkExporter;
class vtkImageData;
class vtkUnsignedCharArray;

namespace CLI
{
class App;
}

class vtkRenderWindow;
class vtkRenderer;

namespace cslf::tool
{
class FieldColors;
class ScalarBar;

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

  /// Shows a bar in a way that fits the window's size and background.
  void AddScalarBar(ScalarBar& bar);

  /// Like vtkRenderWindow::DesiredUpdateRate, in frames per second.
  void SetDesiredUpdateRate(double rate);

  /// Draws, waits until the picture is finished, and returns the seconds for both. Throws a
  /// Failure.
  double Draw(vtkCamera* camera);

  /// Lets an exporter write what it shows. Throws a Failure.
  void Export(vtkCamera* camera, vtkExporter* exporter);

  /// The red, green and blue of the last picture. Throws a Failure.
  vtkSmartPointer<vtkImageData> Grab();

  /// OpenGL's name of the renderer, after something was drawn.
  std::string GetDeviceName();

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// The formats of single pictures, for help and errors.
constexpr const char* PictureFormats = ".png, .jpg, .webp or .gif";

/// Whether the name's extension is that of a picture.
bool IsPictureName(const std::string& fileName);

/// Reads a PNG, JPEG or WebP file, with 8 bits. Throws a Failure.
vtkSmartPointer<vtkImageData> ReadPicture(const std::string& fileName);

/// Throws a Failure if a name is not that of a picture, or a file cannot be written there.
void RequirePicture(const std::string& fileName);

/// Writes a picture, which appears complete or not at all. Throws a Failure.
void WritePicture(const std::string& fileName, vtkImageData* picture);

/// The bytes of a PNG. Throws a Failure.
vtkSmartPointer<vtkUnsignedCharArray> EncodePNG(vtkImageData* picture);

/// The red, green and blue of a picture of associated alpha over a background.
vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* picture, const double background[3]);

/// Makes sure that VTK can open a window. If that must not be visible, a server is started where
/// there is no display. Throws a Failure.
void RequireDisplay(bool isVisible = false);

/// The name of a lookup of vtkCSLFMapper on the command line and in tables.
struct LookupName
{
  int Lookup;
  const char* Name;
};

/// All lookups, in the order of the keys from 1 on.
const std::vector<LookupName>& GetLookups();

/// The lookups for which a field has all that they need: depth, geometry.
std::vector<LookupName> GetLookups(const FieldFile& file);

/// The names of all lookups.
std::vector<std::string> GetLookupNames();

/// The lookups with these names or, if there are none, all those of the field. Throws a Failure if
/// the field lacks what one of them needs.
std::vector<LookupName> ChooseLookups(const std::vector<std::string>& names, const FieldFile& file);

/// Adds --pixel-samples, like vtkCSLFMapper::PixelSamples.
void AddPixelSamples(CLI::App& command, int& samples);

/// Adds --lookups, for a list of names.
void AddLookups(CLI::App& command, std::vector<std::string>& names);

/// The lookup of a name, which must be one of them.
int FindLookup(const std::string& name);

/// Adds --lookup, for a name, which is empty by default.
void AddLookup(CLI::App& command, std::string& name, const std::string& help);

/// The lookup of that name or, if it is empty, geometry or, without geometry, depth. Throws a
/// Failure if geometry is named and the field has none that is used. If a field has no depth, focal
/// replaces depth, with a warning.
std::string ChooseLookup(const std::string& name, const FieldFile& file);

/// Draws a light field off screen, by default over black.
class FieldRenderer
{
public:
  FieldRenderer(vtkAlgorithmOutput* field, int width, int height);

  /// With its geometry, if it has one.
  FieldRenderer(const FieldFile& file, int width, int height);
  ~FieldRenderer();

  /// The colours of scalars, without their bar.
  void SetColors(const FieldColors& colors);

  /// Shows their bar. Colours and background must be set before.
  void AddScalarBar(const std::string& title);

  /// The tone mapping of views. By default, colours are shown unchanged.
  void SetToneMapping(vtkCSLFToneMapping* toneMapping);

  void SetBackground(const double color[3]) { this->Window.SetBackground(color); }

  /// Like vtkCSLFMapper::PixelSamples.
  int GetPixelSamples() const;
  void SetPixelSamples(int samples);

  /// Like vtkRenderWindow::DesiredUpdateRate: above 1 the view counts as moving.
  void SetDesiredUpdateRate(double rate) { this->Window.SetDesiredUpdateRate(rate); }

  /// Draws the view and returns the seconds for this. Throws a Failure.
  double Draw(vtkCamera* camera, int lookup);

  /// The red, green and blue of the last picture. Throws a Failure.
  vtkSmartPointer<vtkImageData> Grab() { return this->Window.Grab(); }

  /// The red, green and blue of the view. Throws a Failure.
  vtkSmartPointer<vtkImageData> Render(vtkCamera* camera, int lookup);

  /// Writes the view with an exporter. Throws a Failure.
  void Export(vtkCamera* camera, vtkExporter* exporter);

  /// How many times per second the view can be drawn, without the first drawing.
  double MeasureFrameRate(vtkCamera* camera, int lookup);

  /// Like vtkCSLFMapper::Streaming and IsComplete.
  void SetStreaming(bool streaming);
  bool IsComplete();

  /// The graphics memory of the field's samples, after something was drawn.
  std::int64_t GetTextureBytes();

  /// The name of the renderer, like in OffscreenWindow.
  std::string GetDeviceName() { return this->Window.GetDeviceName(); }

private:
  vtkNew<vtkCSLFMapper> Mapper;
  vtkNew<vtkActor> Actor;
  OffscreenWindow Window;
};
}

#endif
