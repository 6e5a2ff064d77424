// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewer.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"

#include "vtkCSLFMapper.h"
#include "vtkCSLFSeriesReader.h"
#include "vtkCSLFToneMapping.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkAxesActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#include <algorithm>
#include <filesystem>

namespace cslf::tool
{
namespace
{
/// The length of the axes, relative to the cube's longest edge.
constexpr double AxisLength = 0.3;

vtkSmartPointer<vtkActor> MakeUnlitActor(vtkMapper* mapper, double r, double g, double b)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(r, g, b);
  return actor;
}
}

vtkSmartPointer<vtkActor> MakeOutline(const Cube& cube)
{
  double bounds[6];
  cube.GetBounds(bounds);
  vtkNew<vtkOutlineSource> source;
  source->SetBounds(bounds);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  return MakeUnlitActor(mapper, 0.7, 0.7, 0.75);
}

vtkSmartPointer<vtkProp> MakeAxes(const Cube& cube)
{
  double bounds[6];
  cube.GetBounds(bounds);
  const double length = AxisLength * std::max({ cube.Edges.x, cube.Edges.y, cube.Edges.z });
  vtkNew<vtkTransform> corner;
  corner->Translate(bounds[0], bounds[2], bounds[5]);
  auto axes = vtkSmartPointer<vtkAxesActor>::New();
  axes->SetUserTransform(corner);
  axes->SetTotalLength(length, length, length);
  for (vtkCaptionActor2D* caption : { axes->GetXAxisCaptionActor2D(),
         axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D() })
  {
    caption->GetTextActor()->SetTextScaleModeToNone();
    caption->GetCaptionTextProperty()->SetFontSize(14);
    caption->GetCaptionTextProperty()->ShadowOff();
    caption->GetCaptionTextProperty()->ItalicOff();
  }
  return axes;
}

vtkSmartPointer<vtkActor> MakeViewpointMarkers(const Description& field)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dots;
  for (int slice = 0; slice < field.Grid.GetSlices(); ++slice)
  {
    const glm::dvec3 position =
      field.Box.PointToWorld(field.Grid.ViewpointPosition(field.Grid.ViewpointOf(slice)));
    const vtkIdType point = points->InsertNextPoint(position.x, position.y, position.z);
    dots->InsertNextCell(1, &point);
  }
  vtkNew<vtkPolyData> markers;
  markers->SetPoints(points);
  markers->SetVerts(dots);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(markers);
  auto actor = MakeUnlitActor(mapper, 1.0, 0.75, 0.2);
  actor->GetProperty()->SetPointSize(3.0);
  return actor;
}

namespace
{
constexpr double ExposureStep = 1.25;

/// The least time between two steps of a series that plays.
constexpr std::chrono::milliseconds StepInterval{ 100 };

///@{
/// Of the viewer's texts, in pixels; and the most lines of figures.
constexpr int FontSize = 15;
constexpr int LineHeight = 18;
constexpr int StateLines = 5;
///@}

void Place(vtkTextActor* text, double x, double y)
{
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(x, y);
  text->GetTextProperty()->SetFontSize(FontSize);
  text->GetTextProperty()->SetVerticalJustification(y > 0.5 ? VTK_TEXT_TOP : VTK_TEXT_BOTTOM);
  text->GetTextProperty()->SetJustification(x > 0.5 ? VTK_TEXT_RIGHT : VTK_TEXT_LEFT);
  text->GetTextProperty()->SetBackgroundColor(0.0, 0.0, 0.0);
  text->GetTextProperty()->SetBackgroundOpacity(0.5);
}

void Observe(vtkObject* object, unsigned long event,
  void (*callback)(vtkObject*, unsigned long, void*, void*), void* client)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(callback);
  command->SetClientData(client);
  object->AddObserver(event, command);
}

void Toggle(vtkProp* prop)
{
  prop->SetVisibility(!prop->GetVisibility());
}

/// The first unused name of a screenshot.
std::string MakeScreenshotName()
{
  for (int number = 1;; ++number)
  {
    std::string name = "cslf-view-" + std::to_string(number) + ".png";
    if (!std::filesystem::exists(ToPath(name)))
    {
      return name;
    }
  }
}
}

std::string Viewer::GetHelp()
{
  std::string lookups;
  for (const std::string& name : GetLookupNames())
  {
    lookups += (lookups.empty() ? ": " : ", ") + name;
  }
  return "1 to " + std::to_string(GetLookups().size()) + lookups +
    "\ns: all lookups side by side, or one\nt: path-traced scene (with --scene)\no: outline of "
    "the cube   a: axes   v: viewpoints\nb: scalar bar (of fields with scalars)\n[ and ]: exposure "
    "  m: tone mapping\nspace: play   , and .: time steps   <: first time\ni: figures   p: "
    "write a picture   h: this help\nleft button: rotate, middle: pan, right or wheel: zoom\nr: "
    "reset the camera   q: quit";
}

Viewer::Viewer(const FieldFile& file, vtkCamera* camera, int width, int height,
  std::unique_ptr<RefiningTruth> truth)
  : Field(file.Field)
  , Decoder(vtkCSLFSeriesReader::SafeDownCast(file.Reader))
  , Camera(camera)
  , Outline(MakeOutline(file.Field.Box))
  , Axes(MakeAxes(file.Field.Box))
  , Markers(MakeViewpointMarkers(file.Field))
  , Truth(std::move(truth))
  , Step(this->Decoder ? this->Decoder->GetOpenStep() : 0)
{
  this->Mapper->SetInputConnection(file.Reader->GetOutputPort());
  if (file.GeometryReader)
  {
    this->Mapper->SetInputConnection(1, file.GetGeometry());
  }
  this->FieldActor->SetMapper(this->Mapper);
  for (const auto& prop : { this->Outline, this->Axes, this->Markers })
  {
    prop->VisibilityOff();
    prop->PickableOff();
  }
  this->Window->SetSize(width, height);
  this->Window->SetMultiSamples(0);
  this->Window->SetNumberOfLayers(2);
  this->Backdrop->InteractiveOff();
  this->Window->AddRenderer(this->Backdrop);
  for (const LookupName& lookup : GetLookups(file))
  {
    this->Lookup = this->AddPane(lookup.Name, lookup.Lookup)->Lookup;
  }
  if (this->Truth)
  {
    this->AddPane("path-traced", TruthPane);
  }
  this->AddOverlay();
  Observe(this->Window, vtkCommand::StartEvent, CountFrame, this);
  Observe(this->Window, vtkCommand::EndEvent, CountFrame, this);
  this->Panes.front()->Renderer->ResetCameraClippingRange();
  this->Arrange();
}

Viewer::~Viewer()
{
  this->Window->RemoveAllObservers();
}

Viewer::Pane* Viewer::AddPane(const std::string& name, int lookup)
{
  this->Panes.push_back(std::make_unique<Pane>());
  Pane* pane = this->Panes.back().get();
  pane->Owner = this;
  pane->Name = name;
  pane->Lookup = lookup;
  pane->Renderer->SetActiveCamera(this->Camera);
  pane->Renderer->AddActor(this->FieldActor);
  for (const auto& prop : { this->Outline, this->Axes, this->Markers })
  {
    pane->Renderer->AddViewProp(prop);
  }
  Place(pane->Label, 0.02, 0.98);
  pane->Renderer->AddViewProp(pane->Label);
  Observe(pane->Renderer, vtkCommand::StartEvent, PreparePane, pane);
  this->Window->AddRenderer(pane->Renderer);
  return pane;
}

Viewer::Pane* Viewer::FindPane(int lookup) const
{
  const auto found = std::find_if(this->Panes.begin(), this->Panes.end(),
    [lookup](const std::unique_ptr<Pane>& pane) { return pane->Lookup == lookup; });
  return found == this->Panes.end() ? nullptr : found->get();
}

std::vector<Viewer::Pane*> Viewer::GetShownPanes() const
{
  std::vector<Pane*> shown;
  for (const auto& pane : this->Panes)
  {
    const bool isShown =
      pane->Lookup == TruthPane ? this->ShowsTruth : this->ShowsAll || pane->Lookup == this->Lookup;
    if (isShown)
    {
      shown.push_back(pane.get());
    }
  }
  return shown;
}

void Viewer::AddOverlay()
{
  this->Overlay->SetLayer(1);
  this->Overlay->InteractiveOff();
  Place(this->HelpText, 0.01, 0.01);
  Place(this->StateText, 0.99, 0.01);
  this->Overlay->AddViewProp(this->HelpText);
  this->Overlay->AddViewProp(this->StateText);
  this->Window->AddRenderer(this->Overlay);
}

// Divides the window among the panes: in one row up to three, then in two rows.
void Viewer::Arrange()
{
  const std::vector<Pane*> shown = this->GetShownPanes();
  const int count = static_cast<int>(shown.size());
  const int rows = count <= 3 ? 1 : 2;
  const int columns = (count + rows - 1) / rows;
  for (const auto& pane : this->Panes)
  {
    const auto place = std::find(shown.begin(), shown.end(), pane.get());
    const bool isShown = place != shown.end();
    pane->Renderer->SetDraw(isShown);
    pane->Renderer->SetInteractive(isShown);
    if (isShown)
    {
      const int k = static_cast<int>(place - shown.begin());
      const double column = k % columns;
      const double row = rows - 1 - k / columns;
      pane->Renderer->SetViewport(
        column / columns, row / rows, (column + 1.0) / columns, (row + 1.0) / rows);
    }
    pane->PSNR = 0.0;
  }
  this->MeasuredSamples = 0;
}

void Viewer::SetBackground(const double color[3])
{
  this->Backdrop->SetBackground(color[0], color[1], color[2]);
  for (const auto& pane : this->Panes)
  {
    pane->Renderer->SetBackground(color[0], color[1], color[2]);
  }
}

void Viewer::SetLookup(int lookup)
{
  if (this->FindPane(lookup))
  {
    this->Lookup = lookup;
    this->ShowsAll = false;
    this->Arrange();
  }
}

void Viewer::SetToneMapping(vtkCSLFToneMapping* toneMapping)
{
  this->Mapper->SetToneMapping(toneMapping);
  this->ShowToneMapping();
}

void Viewer::ShowToneMapping()
{
  for (const auto& pane : this->Panes)
  {
    pane->PSNR = 0.0;
  }
  this->MeasuredSamples = 0;
  this->ShowTruth();
}

void Viewer::SetColors(const FieldColors& colors, bool hasBar)
{
  colors.Apply(this->Mapper);
  if (!colors.GetTitle().empty())
  {
    this->Bar = std::make_unique<ScalarBar>(this->Mapper, colors.GetTitle());
    this->Bar->GetProp()->SetVisibility(hasBar);
    this->Overlay->AddViewProp(this->Bar->GetProp());
  }
}

// The bar is as large as the window and the figures below allow, which users may change.
void Viewer::FitScalarBar()
{
  if (this->Bar)
  {
    const int* size = this->Window->GetSize();
    const int lowest = this->ShowsState ? StateLines * LineHeight : 0;
    this->Bar->Fit(size[0], size[1], this->Backdrop->GetBackground(), lowest);
  }
}

bool Viewer::Press(char key)
{
  vtkCSLFToneMapping* tone = this->Mapper->GetToneMapping();
  switch (key)
  {
    case 's':
      this->ShowsAll = !this->ShowsAll;
      this->Arrange();
      return true;
    case 't':
      this->ShowsTruth = this->Truth && !this->ShowsTruth;
      this->Arrange();
      return true;
    case 'o':
      Toggle(this->Outline);
      return true;
    case 'a':
      Toggle(this->Axes);
      return true;
    case 'v':
      Toggle(this->Markers);
      return true;
    case 'b':
      if (this->Bar)
      {
        Toggle(this->Bar->GetProp());
      }
      return true;
    case '[':
      tone->SetExposure(tone->GetExposure() / ExposureStep);
      this->ShowToneMapping();
      return true;
    case ']':
      tone->SetExposure(tone->GetExposure() * ExposureStep);
      this->ShowToneMapping();
      return true;
    case 'm':
      tone->SetCurve((tone->GetCurve() + 1) % (vtkCSLFToneMapping::ACES + 1));
      this->ShowToneMapping();
      return true;
    case ' ':
      this->IsPlaying = !this->IsPlaying && this->HasTimes();
      return true;
    case ',':
    case '.':
      this->IsPlaying = false;
      this->GoBySteps(key == '.' ? 1 : -1);
      return true;
    case '<':
      this->GoBySteps(-this->Step);
      return true;
    case 'i':
      this->ShowsState = !this->ShowsState;
      return true;
    case 'h':
      this->ShowsHelp = !this->ShowsHelp;
      return true;
    case 'p':
      this->WriteScreenshot(MakeScreenshotName());
      return true;
    default:
      if (key < '1' || key >= static_cast<char>('1' + GetLookups().size()))
      {
        return false;
      }
      this->SetLookup(GetLookups()[key - '1'].Lookup);
      return true;
  }
}

/// Whether other times can be shown. A path-traced scene has one time.
bool Viewer::HasTimes() const
{
  return this->Decoder && !this->Truth && this->Decoder->GetNumberOfTimeSteps() > 1;
}

std::optional<double> Viewer::GetTime() const
{
  return this->Decoder && this->Decoder->GetNumberOfTimeSteps() > 0
    ? std::make_optional(this->Decoder->GetTimeStep(this->Step))
    : std::nullopt;
}

/// After the last step comes the first.
void Viewer::GoBySteps(int steps)
{
  if (this->HasTimes())
  {
    const int count = this->Decoder->GetNumberOfTimeSteps();
    this->Step = (this->Step + steps + count) % count;
    this->Decoder->SetTime(this->Decoder->GetTimeStep(this->Step));
  }
}

void Viewer::Play()
{
  const auto now = std::chrono::steady_clock::now();
  if (this->IsPlaying && now >= this->NextStep)
  {
    this->NextStep = now + StepInterval;
    this->GoBySteps(1);
    this->Render();
  }
}

void Viewer::Render()
{
  this->ShowState();
  this->FitScalarBar();
  this->Window->Render();
}

// Called before a pane is drawn: all share the mapper, and the reference may show another view.
void Viewer::PreparePane(vtkObject*, unsigned long, void* client, void*)
{
  auto* pane = static_cast<Pane*>(client);
  Viewer* viewer = pane->Owner;
  const int lookup = pane->Lookup == TruthPane ? viewer->MeasuredLookup : pane->Lookup;
  viewer->FieldActor->SetVisibility(lookup != TruthPane);
  if (lookup != TruthPane)
  {
    viewer->Mapper->SetLookup(lookup);
    pane->Renderer->TexturedBackgroundOff();
    return;
  }
  pane->Renderer->SetTexturedBackground(viewer->IsTruthCurrent());
  if (!viewer->IsTruthCurrent())
  {
    pane->Label->SetInput(pane->Name.c_str());
  }
}

bool Viewer::IsTruthCurrent() const
{
  return this->ShowsTruth &&
    this->Truth->Shows(this->Camera, GetSize(this->FindPane(TruthPane)->Renderer).data());
}

bool Viewer::Refine(int mostSamples)
{
  if (!this->ShowsTruth)
  {
    return false;
  }
  if (!this->IsTruthCurrent())
  {
    this->MeasuredSamples = 0;
  }
  else if (this->GetTruthSamples() >= mostSamples)
  {
    return false;
  }
  const auto size = GetSize(this->FindPane(TruthPane)->Renderer);
  this->Truth->Refine(this->Camera, size.data(), mostSamples);
  this->ShowTruth();
  const int samples = this->GetTruthSamples();
  if (samples >= 2 * this->MeasuredSamples || samples >= mostSamples)
  {
    this->MeasuredSamples = samples;
    this->Measure();
  }
  return true;
}

void Viewer::ShowTruth()
{
  if (this->GetTruthSamples() == 0)
  {
    return;
  }
  Pane* pane = this->FindPane(TruthPane);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(
    this->Truth->MakePicture(this->Mapper->GetToneMapping(), this->Backdrop->GetBackground()));
  pane->Renderer->SetBackgroundTexture(texture);
  pane->Label->SetInput(
    (pane->Name + ": " + std::to_string(this->GetTruthSamples()) + " samples a pixel").c_str());
}

void Viewer::WriteScreenshot(const std::string& fileName)
{
  this->Render();
  WritePicture(fileName, GrabPicture(this->Window));
}

void Viewer::SetStreaming(bool streaming)
{
  this->Mapper->SetStreaming(streaming);
}

bool Viewer::IsComplete() const
{
  return this->Mapper->IsComplete();
}

vtkTypeInt64 Viewer::GetTextureBytes() const
{
  return this->Mapper->GetTextureBytes();
}
}
