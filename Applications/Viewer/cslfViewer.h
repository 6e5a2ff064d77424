// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The window of `cslf view`: one lookup or all side by side, the path-traced truth beside them,
 * and what goes with them.
 */
#ifndef cslfViewer_h
#define cslfViewer_h

#include "cslfPictures.h"
#include "cslfRefiningTruth.h"
#include "cslfToneMapping.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkCSLFMapper;
class vtkCamera;
class vtkObject;
class vtkProp;
class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;

namespace cslf
{
namespace tool
{
struct FieldFile;

/// Draws all into one render window, which its owner shows. It does what the keys say, and never by
/// itself.
class Viewer
{
public:
  /// What the keys do, a line for each.
  static const char* const Help;

  /// `truth` may be null; then there is none to show.
  Viewer(const FieldFile& file, vtkCamera* camera, int width, int height,
    std::unique_ptr<RefiningTruth> truth);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  vtkRenderWindow* GetWindow() { return this->Window; }

  /// A lookup of vtkCSLFMapper, drawn alone or beside the truth.
  void SetLookup(int lookup);
  void SetToneMapping(const ToneMapping& toneMapping);

  /// Does what a key stands for, without drawing. False where it stands for nothing. Throws a
  /// Failure.
  bool Press(char key);

  void Render();

  /// Where the truth is shown, takes it further by a pass, up to so many samples a pixel, and
  /// measures the lookups shown whenever its samples have doubled. Returns whether there is
  /// something new to draw. Throws a Failure.
  bool Refine(int mostSamples);

  /// What the window shows, as a PNG. Throws a Failure.
  void WriteScreenshot(const std::string& fileName);

  /// Frames a second over the last frames; 0 before there are two.
  double GetFrameRate() const;

  /// The PSNR of the lookups that were measured in this view, by their names, in dB.
  std::map<std::string, double> GetPSNR() const;

  int GetTruthSamples() const { return this->Truth ? this->Truth->GetSamples() : 0; }
  vtkTypeInt64 GetTextureBytes() const;

  /// As vtkCSLFMapper::Streaming and IsComplete.
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
  void ShowTruth();
  void Measure();
  double MeasureLookup(int lookup, Pane* place);
  bool IsTruthCurrent() const;
  ToneMapping GetToneMapping() const;
  static void PreparePane(vtkObject*, unsigned long, void* client, void*);
  static void CountFrame(vtkObject*, unsigned long, void* client, void*);

  Description Field;
  vtkSmartPointer<vtkCamera> Camera;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Overlay;
  vtkNew<vtkTextActor> HelpText;
  vtkNew<vtkTextActor> StateText;
  vtkNew<vtkCSLFMapper> Mapper;
  vtkNew<vtkActor> FieldActor;
  vtkSmartPointer<vtkProp> Outline;
  vtkSmartPointer<vtkProp> Axes;
  vtkSmartPointer<vtkProp> Markers;
  std::vector<std::unique_ptr<Pane>> Panes; ///< the lookups' and, last, the truth's
  std::unique_ptr<RefiningTruth> Truth;
  int Lookup = 0;
  int MeasuredSamples = 0; ///< of the truth, when the lookups were last measured
  int MeasuredLookup = -1; ///< drawn in the truth's place, unless -1
  bool ShowsAll = false;
  bool ShowsTruth = false;
  bool ShowsState = true;
  bool ShowsHelp = false;
  std::chrono::steady_clock::time_point FrameStart;
  std::deque<double> FrameSeconds;
};
}
}

#endif
