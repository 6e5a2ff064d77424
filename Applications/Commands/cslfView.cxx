// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf view: shows a light field in an interactive window.
#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfUnfinishedFields.h"
#include "Options/cslfCameraOptions.h"
#include "Options/cslfNumberChecks.h"
#include "Options/cslfToneOptions.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"
#include "Viewer/cslfViewer.h"
#include "cslfCommands.h"

#include "vtkCSLFDecoder.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <memory>

namespace cslf::tool
{
namespace
{
/// How often the interactive window checks whether there is work to do.
constexpr unsigned long TimerMilliseconds = 20;

struct Options
{
  std::string Field;
  SceneOptions Scene;
  std::string Lookup;
  std::string Keys;
  std::string Screenshot;
  int TruthSamples = 1024;
  double Seconds = 0.0;
  ToneOptions Tone;
  CameraOptions Camera;
};

/// The trackball camera, with the viewer's keys instead of VTK's.
class vtkFieldStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkFieldStyle* New();
  vtkTypeMacro(vtkFieldStyle, vtkInteractorStyleTrackballCamera);

  Viewer* Shown = nullptr;

  void OnChar() override
  {
    const char key = this->Interactor->GetKeyCode();
    if (key == 'q' || key == 'e' || key == 'r')
    {
      this->Superclass::OnChar();
    }
    else if (this->Shown->Press(key))
    {
      this->Shown->Render();
    }
  }
};
vtkStandardNewMacro(vtkFieldStyle);

/// An interactive run, for the timer.
struct Session
{
  Viewer& Shown;
  vtkFieldStyle* Style;
  int TruthSamples;
  double Seconds; ///< until the window closes, unless 0
  UnfinishedField Field;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

void OnTimer(vtkObject* caller, unsigned long, void* client, void*)
{
  auto* session = static_cast<Session*>(client);
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - session->Start;
  if (session->Seconds > 0.0 && age.count() > session->Seconds)
  {
    static_cast<vtkRenderWindowInteractor*>(caller)->TerminateApp();
  }
  else if (session->Style->GetState() == VTKIS_NONE)
  {
    const bool isMissing = !session->Shown.IsComplete() || session->Field.Update();
    if (session->Shown.Refine(session->TruthSamples) || isMissing)
    {
      session->Shown.Render();
    }
  }
}

void Interact(Viewer& viewer, const Options& options, const FieldFile& file)
{
  vtkNew<vtkFieldStyle> style;
  style->Shown = &viewer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(viewer.GetWindow());
  interactor->SetInteractorStyle(style);
  interactor->Initialize();
  Session session{ viewer, style, options.TruthSamples, options.Seconds,
    { options.Field, vtkCSLFDecoder::SafeDownCast(file.Reader) } };
  vtkNew<vtkCallbackCommand> timer;
  timer->SetCallback(OnTimer);
  timer->SetClientData(&session);
  interactor->AddObserver(vtkCommand::TimerEvent, timer);
  interactor->CreateRepeatingTimer(TimerMilliseconds);
  viewer.Render();
  interactor->Start();
  ThrowOnError();
}

void DrawOnce(Viewer& viewer, const Options& options)
{
  viewer.Render();
  while (viewer.Refine(options.TruthSamples))
  {
  }
  viewer.WriteScreenshot(options.Screenshot);
}

std::unique_ptr<RefiningTruth> MakeTruth(SceneOptions options, const Description& field)
{
  if (options.IsEmpty())
  {
    return nullptr;
  }
  options.TakeDefaults(nlohmann::json::parse(field.Sampling, nullptr, false));
  return std::make_unique<RefiningTruth>(options, options.Read());
}

void PressKeys(Viewer& viewer, const std::string& keys)
{
  for (const char key : keys)
  {
    if (!viewer.Press(key))
    {
      throw Failure(std::string("The key ") + key + " is not defined.");
    }
  }
}

Result Run(const Options& options)
{
  if (!options.Screenshot.empty())
  {
    RequirePicture(options.Screenshot);
    options.Scene.RequireOther(options.Screenshot);
  }
  const FieldFile file = OpenField(FieldInput{ options.Field, true });
  const std::string lookup = ChooseLookup(options.Lookup, file);
  const vtkSmartPointer<vtkCamera> camera = options.Camera.MakeCamera(file.Field.Box);
  auto truth = MakeTruth(options.Scene, file.Field);
  RequireDisplay();
  ReadToDraw(file);

  Viewer viewer(
    file, camera, options.Camera.GetWidth(), options.Camera.GetHeight(), std::move(truth));
  viewer.GetWindow()->SetWindowName(("cslf: " + options.Field).c_str());
  viewer.GetWindow()->SetOffScreenRendering(!options.Screenshot.empty());
  viewer.SetLookup(FindLookup(lookup));
  viewer.SetToneMapping(options.Tone.Get());
  PressKeys(viewer, options.Keys);
  Result result;
  if (options.Screenshot.empty())
  {
    viewer.SetStreaming(true);
    Interact(viewer, options, file);
  }
  else
  {
    DrawOnce(viewer, options);
    result.Text = options.Screenshot + "\n";
    result.JSON = { { "output", options.Screenshot },
      { "texture_bytes", viewer.GetTextureBytes() } };
  }
  ThrowOnError();
  result.JSON["frames_per_second"] = viewer.GetFrameRate();
  result.JSON["truth_samples"] = viewer.GetTruthSamples();
  result.JSON["psnr"] = viewer.GetPSNR();
  return result;
}
}

void AddView(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("view", "View a light field in an interactive window");
  command->footer("Keys and mouse:\n" + Viewer::GetHelp() +
    "\n\nSpecify the scene, light and material that the field was sampled with to show the "
    "path-traced scene beside the lookups (key t) and their PSNR against it.\n\nA video that is "
    "still being written is shown as soon as it has its coarsest grid of viewpoints, and is "
    "refined "
    "as more of them are written.");
  const auto options = std::make_shared<Options>();
  command
    ->add_option("field", options->Field,
      std::string("the light field, also while it is being written: ") + FieldFormats)
    ->required();
  options->Scene.AddOptionalTo(*command);
  AddLookup(*command, options->Lookup, "the initial lookup");
  command->add_option("--keys", options->Keys, "keys to press at the start, for example sto");
  command->add_option("--screenshot", options->Screenshot,
    "draw into this .png file without a window; if the path-traced scene is shown, when it is "
    "finished");
  command
    ->add_option(
      "--truth-samples", options->TruthSamples, "samples per pixel of the path-traced scene")
    ->check(CLI::Range(1, 1 << 20))
    ->capture_default_str();
  command
    ->add_option("--close-after", options->Seconds, "close the window after this number of seconds")
    ->check(Positive());
  options->Tone.AddTo(*command);
  options->Camera.AddTo(*command);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
