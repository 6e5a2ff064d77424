// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The window of `cslf view`: one lookup or all side by side, next to the path-traced reference, and
 * other displays.
 */
#ifndef cslfViewer_h
#define cslfViewer_h

#include "Pictures/cslfFieldColors.h"
#include "Pictures/cslfPictures.h"
#include "cslfDescription.h"
#include "cslfRefiningTruth.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkActor;
class vtkCSLFSeriesReader;
class vtkCSLFMapper;
class vtkCSLFToneMapping;
class vtkCamera;
class vtkObject;
class vtkProp;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;

namespace cslf::tool
{
/// The edges of the cube.
vtkSmartPointer<vtkActor> MakeOutline(const Cube& cube);

/// Axes of world coordinates at the cube's corner with the smallest x and y and the largest z, so
/// that Z points outwards.
vtkSmartPointer<vtkProp> MakeAxes(const Cube& cube);

/// A dot at each of the field's viewpoints.
vtkSmartPointer<vtkActor> MakeViewpointMarkers(const Description& field);

struct FieldFile;

/// Draws everything into one render window, which its owner shows. It acts only on keys.
class Viewer
{
public:
  /// The help for the keys, one line each.
  static std::string GetHelp();

  /// `truth` may be null if there is no reference to show.
  Viewer(const FieldFile& file, vtkCamera* camera, int width, int height,
    std::unique_ptr<RefiningTruth> truth);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  vtkRenderWindow* GetWindow() { return this->Window; }

  /// Red, green and blue from 0 to 1.
  void SetBackground(const double color[3]);

  /// A lookup of vtkCSLFMapper, drawn alone or beside the reference.
  void SetLookup(int lookup);
  void SetToneMapping(vtkCSLFToneMapping* toneMapping);

  /// The colours of scalars, and whether their bar is shown at first.
  void SetColors(const FieldColors& colors, bool hasBar);

  /// Performs the action of a key, without drawing. False if the key has none. Throws a Failure.
  bool Press(char key);

  void Render();

  /// If the field plays, draws its next time when that is due. Throws a Failure.
  void Play();

  /// The time of a series that is shown. Empty for other fields.
  std::optional<double> GetTime() const;

  /// If the reference is shown, refines it by a pass, up to this many samples per pixel, and
  /// measures the shown lookups whenever its samples have doubled. Returns whether there is
  /// something new to draw. Throws a Failure.
  bool Refine(int mostSamples);

  /// Writes the window's picture. Throws a Failure.
  void WriteScreenshot(const std::string& fileName);

  /// Frames per second over the last frames; 0 before there are two.
  double GetFrameRate() const;

  /// The PSNR of the measured lookups in this view, by their names, in dB.
  std::map<std::string, double> GetPSNR() const;

  int GetTruthSamples() const { return this->Truth ? this->Truth->GetSamples() : 0; }
  vtkTypeInt64 GetTextureBytes() const;

  /// Like vtkCSLFMapper::Streaming and IsComplete.
  void SetStreaming(bool streaming);
  bool IsComplete() const;

private:
  struct Pane;

  Pane* AddPane(const std::string& name, int lookup);
  Pane* FindPane(int lookup) const;
  std::vector<Pane*> GetShownPanes() const;
  void AddOverlay();
  void Arrange();
  void ShowState();
  bool HasTimes() const;
  void GoBySteps(int steps);
  void FitScalarBar();
  void ShowTruth();
  void Measure();
  double MeasureLookup(int lookup, Pane* place);
  bool IsTruthCurrent() const;
  void ShowToneMapping();
  static void PreparePane(vtkObject*, unsigned long, void* client, void*);
  static void CountFrame(vtkObject*, unsigned long, void* client, void*);

  Description Field;
  vtkSmartPointer<vtkCSLFSeriesReader> Decoder; ///< null if the field is not a video
  vtkSmartPointer<vtkCamera> Camera;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Backdrop; ///< behind the panes, which may leave a cell empty
  vtkNew<vtkRenderer> Overlay;
  vtkNew<vtkTextActor> HelpText;
  vtkNew<vtkTextActor> StateText;
  std::unique_ptr<ScalarBar> Bar; ///< null if the field has no scalars
  vtkNew<vtkCSLFMapper> Mapper;
  vtkNew<vtkActor> FieldActor;
  vtkSmartPointer<vtkProp> Outline;
  vtkSmartPointer<vtkProp> Axes;
  vtkSmartPointer<vtkProp> Markers;
  std::vector<std::unique_ptr<Pane>> Panes; ///< of the lookups and, last, of the reference
  std::unique_ptr<RefiningTruth> Truth;
  int Lookup = 0;
  int MeasuredSamples = 0; ///< of the reference, when the lookups were last measured
  int MeasuredLookup = -1; ///< drawn in the reference's place, unless -1
  bool ShowsAll = false;
  bool ShowsTruth = false;
  bool ShowsState = true;
  bool ShowsHelp = false;
  bool IsPlaying = false;
  int Step = 0;                                   ///< of a series
  std::chrono::steady_clock::time_point NextStep; ///< when it is due
  std::chrono::steady_clock::time_point FrameStart;
  std::deque<double> FrameSeconds;
};

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
