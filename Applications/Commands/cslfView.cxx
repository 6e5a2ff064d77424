// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf view: a light field in an interactive window.
#include "cslfCameraOptions.h"
#include "cslfCommands.h"
#include "cslfFieldFiles.h"
#include "cslfMessages.h"
#include "cslfPictures.h"
#include "cslfTable.h"

#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCornerAnnotation.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace cslf
{
namespace tool
{
namespace
{
constexpr const char* Help = "1 nearest  2 linear  3 bilinear  4 focal  5 depth\n"
                             "left button: rotate, middle: pan, right or wheel: zoom\n"
                             "r: reset the camera, h: hide this help, q: quit";

struct Options
{
  std::string Field;
  std::string Lookup = "depth";
  double Seconds = 0.0;
  CameraOptions Camera;
};

/// The trackball camera, with keys for the lookups.
class vtkFieldStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkFieldStyle* New();
  vtkTypeMacro(vtkFieldStyle, vtkInteractorStyleTrackballCamera);

  vtkCSLFMapper* Mapper = nullptr;
  vtkCornerAnnotation* Text = nullptr;
  bool HasDepth = false;

  void OnChar() override
  {
    const char key = this->Interactor->GetKeyCode();
    const auto& lookups = GetLookups();
    if (key >= '1' && key < static_cast<char>('1' + lookups.size()))
    {
      const LookupName& lookup = lookups[key - '1'];
      if (lookup.Lookup != vtkCSLFMapper::DEPTH || this->HasDepth)
      {
        this->Mapper->SetLookup(lookup.Lookup);
        this->Interactor->Render();
      }
    }
    else if (key == 'h')
    {
      this->IsHelpShown = !this->IsHelpShown;
      this->Text->SetText(vtkCornerAnnotation::LowerLeft, this->IsHelpShown ? Help : "h: help");
      this->Interactor->Render();
    }
    else
    {
      this->Superclass::OnChar();
    }
  }

private:
  bool IsHelpShown = true;
};
vtkStandardNewMacro(vtkFieldStyle);

/// Shows the lookup and the frame rate of the last frame in the next.
void ShowState(vtkObject* caller, unsigned long, void* client, void*)
{
  auto* renderer = static_cast<vtkRenderer*>(caller);
  auto* style = static_cast<vtkFieldStyle*>(client);
  const double seconds = renderer->GetLastRenderTimeInSeconds();
  std::string text = style->Mapper->GetLookupAsString();
  if (seconds > 0.0)
  {
    text += "\n" + Format(1.0 / seconds, 1) + " frames/s";
  }
  style->Text->SetText(vtkCornerAnnotation::UpperLeft, text.c_str());
}

void Close(vtkObject* caller, unsigned long, void*, void*)
{
  static_cast<vtkRenderWindowInteractor*>(caller)->TerminateApp();
}

template <typename Callback>
vtkSmartPointer<vtkCallbackCommand> MakeObserver(Callback callback, void* client)
{
  auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetCallback(callback);
  command->SetClientData(client);
  return command;
}

Result Run(const Options& options)
{
  const FieldFile file = OpenField(options.Field);
  const vtkSmartPointer<vtkCamera> camera = options.Camera.MakeCamera(file.Field.Box);
  RequireDisplay();
  {
    const ProgressBar bar(file.Reader, "Reading");
    file.Reader->UpdateWholeExtent();
  }
  ThrowOnError();

  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(file.Reader->GetOutputPort());
  mapper->SetLookup(FindLookup(ChooseLookup(options.Lookup, file.Field)));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkCornerAnnotation> text;
  text->SetMaximumFontSize(16);
  text->SetText(vtkCornerAnnotation::LowerLeft, Help);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.1, 0.1, 0.12);
  renderer->SetActiveCamera(camera);
  renderer->AddActor(actor);
  renderer->AddViewProp(text);
  renderer->ResetCameraClippingRange();

  vtkNew<vtkRenderWindow> window;
  window->SetSize(options.Camera.GetWidth(), options.Camera.GetHeight());
  window->SetWindowName(("cslf: " + options.Field).c_str());
  window->AddRenderer(renderer);
  vtkNew<vtkFieldStyle> style;
  style->Mapper = mapper;
  style->Text = text;
  style->HasDepth = file.Field.FindChannel(DepthName) != nullptr;
  renderer->AddObserver(vtkCommand::StartEvent, MakeObserver(ShowState, style));
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(style);
  interactor->Initialize();
  if (options.Seconds > 0.0)
  {
    interactor->AddObserver(vtkCommand::TimerEvent, MakeObserver(Close, nullptr));
    interactor->CreateOneShotTimer(static_cast<unsigned long>(1000.0 * options.Seconds));
  }
  window->Render();
  interactor->Start();
  ThrowOnError();

  const double seconds = renderer->GetLastRenderTimeInSeconds();
  Result result;
  result.JSON = { { "frames_per_second", seconds > 0.0 ? 1.0 / seconds : 0.0 } };
  return result;
}
}

void AddView(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("view", "Look at a light field in an interactive window");
  command->footer(std::string("Keys and mouse:\n") + Help);
  const auto options = std::make_shared<Options>();
  command->add_option("field", options->Field, std::string("the light field: ") + FieldFormats)
    ->required();
  command->add_option("--lookup", options->Lookup, "the lookup at first")
    ->check(CLI::IsMember(GetLookupNames()))
    ->capture_default_str();
  command->add_option("--close-after", options->Seconds, "close the window after so many seconds")
    ->check(CLI::PositiveNumber);
  options->Camera.AddTo(*command);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
}
