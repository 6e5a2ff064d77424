// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf view: shows a light field, or a preview of a scene, in an interactive window.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfFieldColors.h"
#include "Pictures/cslfFrameFiles.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"
#include "Viewer/cslfViewer.h"
#include "cslfCommands.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFSampler.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTrivialProducer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>

namespace cslf::tool
{
namespace
{
/// How often the interactive window checks whether there is work to do.
constexpr unsigned long TimerMilliseconds = 20;

///@{
/// The size of a scene's preview: some seconds of sampling, and about 70 MiB.
constexpr int PreviewViewpoints = 5;
constexpr int PreviewResolution = 128;
///@}

struct Options
{
  std::string Field;
  SceneOptions Scene;
  FieldColorOptions Colors; ///< without those of the scene
  std::string Lookup;
  std::string Keys;
  std::string Screenshot;
  std::string Record;
  int TruthSamples = 1024;
  double Seconds = 0.0;
  ToneOptions Tone;
  CameraOptions Camera;
};

/// The trackball camera, with the viewer's keys instead of VTK's. No exception passes through the
/// event loop: the first one closes the window, and is thrown by Finish.
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
      return;
    }
    this->Handle(
      [this, key]
      {
        if (this->Shown->Press(key))
        {
          this->Shown->Render();
        }
      });
  }

  /// Handles an event, unless an earlier one has failed.
  template <typename Handler>
  void Handle(const Handler& handler)
  {
    if (this->Problem)
    {
      return;
    }
    try
    {
      handler();
    }
    catch (...)
    {
      this->Problem = std::current_exception();
      this->Interactor->TerminateApp();
    }
  }

  /// To be called after the event loop.
  void Finish() const
  {
    if (this->Problem)
    {
      std::rethrow_exception(this->Problem);
    }
  }

private:
  std::exception_ptr Problem;
};
vtkStandardNewMacro(vtkFieldStyle);

/// Records the window as a movie, at this number of pictures per second.
class Recorder
{
public:
  static constexpr double Rate = 25.0;

  /// An empty name records nothing. Throws a Failure.
  Recorder(const std::string& fileName, int width, int height)
    : Size{ width, height, 1 }
  {
    if (!fileName.empty())
    {
      this->Writer = MakeFrameWriter(fileName, width, height, Rate);
    }
  }

  /// Adds the window's picture, for the time since the last one. Throws a Failure.
  void Update(double seconds, vtkRenderWindow* window)
  {
    const int due = static_cast<int>(seconds * Rate) + 1 - this->Frames;
    if (!this->Writer || due <= 0)
    {
      return;
    }
    vtkSmartPointer<vtkImageData> picture = GrabPicture(window);
    if (!std::equal(this->Size, this->Size + 2, picture->GetDimensions()))
    {
      vtkNew<vtkImageResize> resize;
      resize->SetInputData(picture);
      resize->SetOutputDimensions(this->Size);
      resize->Update();
      picture = resize->GetOutput();
    }
    this->Writer->Add(picture, due);
    this->Frames += due;
  }

  void Finish()
  {
    if (this->Writer)
    {
      this->Writer->Finish();
    }
  }

private:
  int Size[3];
  std::unique_ptr<FrameWriter> Writer;
  int Frames = 0; ///< that are written
};

/// An interactive run, for the timer.
struct Session
{
  Viewer& Shown;
  vtkFieldStyle* Style;
  int TruthSamples;
  double Seconds; ///< until the window closes, unless 0
  UnfinishedField Field;
  Recorder Movie;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

void Advance(Session& session)
{
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - session.Start;
  if (session.Seconds > 0.0 && age.count() > session.Seconds)
  {
    session.Style->GetInteractor()->TerminateApp();
  }
  else if (session.Style->GetState() == VTKIS_NONE)
  {
    session.Shown.Play();
    const bool isMissing = !session.Shown.IsComplete() || session.Field.Update();
    if (session.Shown.Refine(session.TruthSamples) || isMissing)
    {
      session.Shown.Render();
    }
  }
  session.Movie.Update(age.count(), session.Shown.GetWindow());
}

void OnTimer(vtkObject*, unsigned long, void* client, void*)
{
  auto* session = static_cast<Session*>(client);
  session->Style->Handle([session] { Advance(*session); });
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
    { options.Field, vtkCSLFDecoder::SafeDownCast(file.Reader) },
    { options.Record, options.Camera.GetWidth(), options.Camera.GetHeight() } };
  vtkNew<vtkCallbackCommand> timer;
  timer->SetCallback(OnTimer);
  timer->SetClientData(&session);
  interactor->AddObserver(vtkCommand::TimerEvent, timer);
  interactor->CreateRepeatingTimer(TimerMilliseconds);
  viewer.Render();
  interactor->Start();
  style->Finish();
  ThrowOnError();
  session.Movie.Finish();
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

/// Whether the first argument is a scene, of which there is no light field yet.
bool IsScene(const std::string& name)
{
  if (!IsSceneName(name) || LowerExtension(name) != ".vti")
  {
    return IsSceneName(name);
  }
  // Image data may be both.
  const SeparateMessages messages;
  try
  {
    OpenField(name);
    return false;
  }
  catch (const Failure&)
  {
    return true;
  }
}

vtkSmartPointer<vtkAlgorithm> Keep(vtkDataObject* data)
{
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(data);
  return producer;
}

/// Samples a small field of a scene in preview quality. Throws a Failure.
FieldFile BakePreview(const SceneOptions& options)
{
  const Scene scene = options.Read();
  vtkNew<vtkCSLFSampler> sampler;
  options.Apply(scene, sampler);
  sampler->SetQualityToPreview();
  sampler->SetViewpoints(PreviewViewpoints);
  sampler->SetResolution(PreviewResolution);
  {
    const ProgressBar bar(sampler, "Sampling");
    sampler->Update();
  }
  ThrowOnError();
  FieldFile file;
  std::string error;
  const auto field = Description::ReadFrom(sampler->GetOutput(), error);
  if (!field)
  {
    throw Failure("The preview of the scene is empty: " + error);
  }
  file.Format = FieldFormat::ImageData;
  file.Field = *field;
  file.Reader = Keep(sampler->GetOutput());
  auto* geometry = vtkPolyData::SafeDownCast(sampler->GetOutputDataObject(1));
  if (geometry && geometry->GetNumberOfPolys() > 0)
  {
    file.GeometryReader = Keep(geometry);
  }
  return file;
}

/// The colours of the field's scalars. A preview of a scene has those of the command line already.
/// A scene beside the field has the same options, and perhaps other arrays. Throws a Failure.
FieldColors ChooseColors(const Options& options, const FieldFile& file, bool isPreview)
{
  FieldColorOptions colors = options.Colors;
  if (isPreview)
  {
    return { colors, file };
  }
  colors.Colors = options.Scene.GetLook().GetColors();
  try
  {
    return { colors, file };
  }
  catch (const Failure&)
  {
    if (options.Scene.IsEmpty())
    {
      throw;
    }
    return { {}, file };
  }
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

Result Run(Options options)
{
  const bool isVisible = options.Screenshot.empty();
  const bool isScene = IsScene(options.Field);
  if (isScene)
  {
    options.Scene.AddFirst(options.Field);
  }
  if (!isVisible)
  {
    RequirePicture(options.Screenshot);
    options.Scene.RequireOther(options.Screenshot);
  }
  if (!options.Record.empty())
  {
    options.Scene.RequireOther(options.Record);
    RequireOther(options.Field, options.Record);
  }
  if (isScene)
  {
    RequireDisplay(isVisible); // before the work
  }
  const FieldFile file = isScene
    ? BakePreview(options.Scene)
    : OpenField(FieldInput{ options.Field, true, options.Scene.GetTime(), true });
  const std::string lookup = ChooseLookup(options.Lookup, file);
  const vtkSmartPointer<vtkCamera> camera = options.Camera.MakeCamera(file.Field.Box);
  const FieldColors colors = ChooseColors(options, file, isScene);
  auto truth = MakeTruth(options.Scene, file.Field);
  RequireDisplay(isVisible);
  ReadToDraw(file);

  Viewer viewer(
    file, camera, options.Camera.GetWidth(), options.Camera.GetHeight(), std::move(truth));
  viewer.GetWindow()->SetWindowName(("cslf: " + options.Field).c_str());
  viewer.GetWindow()->SetOffScreenRendering(!isVisible);
  viewer.SetBackground(options.Camera.GetBackground().data());
  viewer.SetLookup(FindLookup(lookup));
  viewer.SetToneMapping(options.Tone.Get());
  viewer.SetColors(colors, options.Colors.HasBar);
  PressKeys(viewer, options.Keys);
  Result result;
  if (isVisible)
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
  if (const auto time = viewer.GetTime())
  {
    result.JSON["time"] = *time;
  }
  result.JSON["frames_per_second"] = viewer.GetFrameRate();
  result.JSON["truth_samples"] = viewer.GetTruthSamples();
  result.JSON["psnr"] = viewer.GetPSNR();
  return result;
}
}

void AddView(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("view", "View a light field or a scene in an interactive window");
  command->footer(MakeFooter({ "cslf view box.mp4", "cslf view box.mp4 cornell-box --keys st",
                               "cslf view dragon.ply", "cslf view wave.mp4.series" },
    "Keys and mouse:\n" + CLI::detail::find_and_replace("  " + Viewer::GetHelp(), "\n", "\n  ") +
      "\n\nSpecify the scene, light and material that the field was sampled with to show the "
      "path-traced scene beside the lookups (key t) and their PSNR against it.\n\n--color-by, "
      "--color-map and --range also change the colours of the field's scalars, if it has any.\n\nA "
      "video that is still being written is shown as soon as it has its coarsest grid of "
      "viewpoints, and is refined as more of them are written."));
  const auto options = std::make_shared<Options>();
  command
    ->add_option("field", options->Field,
      std::string("the light field, also while it is being written: ") + ReadFormats +
        "; or a scene, of which a preview is sampled")
    ->type_name(ScenePlaceholder)
    ->required();
  options->Scene.AddOptionalTo(*command);
  AddLookup(*command, options->Lookup, "the initial lookup");
  command->add_option("--keys", options->Keys, "keys to press at the start, for example sto")
    ->type_name("KEYS");
  CLI::Option* screenshot = command->add_option("--screenshot", options->Screenshot,
    std::string("draw a picture without a window, in the end if the path-traced scene is shown: ") +
      PictureFormats);
  screenshot->type_name(FilePlaceholder);
  command
    ->add_option("--record", options->Record,
      std::string("record the window until it closes: ") + FrameFormats)
    ->type_name(FilePlaceholder)
    ->excludes(screenshot);
  command
    ->add_option(
      "--truth-samples", options->TruthSamples, "samples per pixel of the path-traced scene")
    ->check(Between(1, 1 << 20))
    ->capture_default_str();
  command
    ->add_option("--close-after", options->Seconds, "close the window after this number of seconds")
    ->check(Positive())
    ->transform(Seconds())
    ->type_name(TimePlaceholder);
  options->Colors.AddBarTo(*command);
  options->Tone.AddTo(*command);
  options->Camera.AddTo(*command);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
