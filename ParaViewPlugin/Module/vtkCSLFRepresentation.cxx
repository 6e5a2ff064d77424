// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFRepresentation.h"

#include "Pipeline/cslfGuard.h"
#include "cslfGatherField.h"
#include "cslfGeometryPort.h"
#include "cslfLegend.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFToneMapping.h"
#include "vtkCSLFViewScene.h"

#include <vtkActor.h>
#include <vtkAlgorithmOutput.h>
#include <vtkBoundingBox.h>
#include <vtkCommunicator.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkOutlineSource.h>
#include <vtkPVRenderView.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{
// The ports of the representation's input, and of what it delivers to the rank that draws.
constexpr int FieldPort = 0;
constexpr int GeometryPort = 1;

// The places of scalar bars, as fractions of the view: one beside the other, from the left edge.
constexpr double LegendLeft = 0.02;
constexpr double LegendBottom = 0.25; // above the view's axes
constexpr double LegendWidth = 0.08;
constexpr double LegendHeight = 0.4;
constexpr double LegendStep = 0.13;
constexpr int TitleSeparation = 16; // pixels: half of the uppermost label is above the bar

// More would cover the view.
constexpr std::size_t MaximumLegends = 3;

/// What a field was made of and has changed in the view since, of all filters before one.
std::string FindChange(vtkAlgorithm* filter)
{
  std::vector<vtkAlgorithm*> found{ filter };
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (auto* scene = vtkCSLFViewScene::SafeDownCast(found[i]))
    {
      const std::string change = scene->FindChange();
      if (!change.empty())
      {
        return change;
      }
    }
    for (int port = 0; port < found[i]->GetNumberOfInputPorts(); ++port)
    {
      for (int input = 0; input < found[i]->GetNumberOfInputConnections(port); ++input)
      {
        vtkAlgorithm* producer = found[i]->GetInputAlgorithm(port, input);
        if (producer && std::find(found.begin(), found.end(), producer) == found.end())
        {
          found.push_back(producer);
        }
      }
    }
  }
  return "";
}

vtkSmartPointer<vtkScalarBarActor> MakeLegendActor(const cslf::Legend& legend, int index)
{
  auto actor = vtkSmartPointer<vtkScalarBarActor>::New();
  actor->SetLookupTable(legend.Table);
  actor->SetTitle((legend.Title + "\n(baked)").c_str());
  actor->SetNumberOfLabels(4);
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(LegendLeft + LegendStep * index, LegendBottom);
  actor->SetWidth(LegendWidth);
  actor->SetHeight(LegendHeight);
  actor->SetLabelFormat("%.3g");
  actor->SetVerticalTitleSeparation(TitleSeparation);
  for (vtkTextProperty* text : { actor->GetTitleTextProperty(), actor->GetLabelTextProperty() })
  {
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
  actor->PickableOff();
  return actor;
}
}

vtkStandardNewMacro(vtkCSLFRepresentation);
cslfGuardedRequestMacro(vtkCSLFRepresentation);

//------------------------------------------------------------------------------
vtkCSLFRepresentation::vtkCSLFRepresentation()
{
  this->SetNumberOfInputPorts(2);
  this->Geometry = vtkSmartPointer<vtkPolyData>::New();
  this->Actor->SetMapper(this->Mapper);
  this->Note->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Note->SetPosition(LegendLeft, 0.02);
  this->Note->GetTextProperty()->SetFontSize(14);
  this->Note->GetTextProperty()->SetColor(1.0, 0.6, 0.0);
  this->Note->GetTextProperty()->BoldOn();
  this->Note->PickableOff();
  this->Note->VisibilityOff();
}

//------------------------------------------------------------------------------
vtkCSLFRepresentation::~vtkCSLFRepresentation() = default;

//------------------------------------------------------------------------------
int vtkCSLFRepresentation::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == FieldPort ? "vtkImageData" : "vtkPolyData");
  // A client or a render server may have none.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// Connects the geometry of the field's producer, if it has any.
void vtkCSLFRepresentation::ConnectGeometry()
{
  vtkAlgorithmOutput* geometry = this->GetNumberOfInputConnections(FieldPort) == 1
    ? cslf::FindGeometryPort(this->GetInputConnection(FieldPort, 0))
    : nullptr;
  vtkAlgorithmOutput* connected = this->GetNumberOfInputConnections(GeometryPort) == 1
    ? this->GetInputConnection(GeometryPort, 0)
    : nullptr;
  if (geometry != connected)
  {
    this->SetInputConnection(GeometryPort, geometry);
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
int vtkCSLFRepresentation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  // The superclass requests pieces of the field. Geometry is not divided.
  if (vtkInformation* geometry = inputVector[GeometryPort]->GetInformationObject(0))
  {
    geometry->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
    geometry->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    geometry->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return result;
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::Update()
{
  if (this->GetNeedsUpdate())
  {
    // RequestData changes this, unless the input fails.
    this->State = PartState::Failed;
    this->Part = nullptr;
    this->PartGeometry = nullptr;
  }
  this->Superclass::Update();
}

//------------------------------------------------------------------------------
// Only keeps the part of this rank: where the input of a rank has failed, it is not called there,
// so the ranks must not exchange anything here.
int vtkCSLFRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->State = PartState::Changed;
  this->Part = nullptr;
  this->PartGeometry = nullptr;
  if (inputVector[FieldPort]->GetNumberOfInformationObjects() == 1)
  {
    // The executive's output must not be kept: it is the same object when it changes.
    this->Part = vtkSmartPointer<vtkImageData>::New();
    this->Part->ShallowCopy(vtkImageData::GetData(inputVector[FieldPort], 0));
  }
  if (auto* geometry = vtkPolyData::GetData(inputVector[GeometryPort], 0))
  {
    this->PartGeometry = vtkSmartPointer<vtkPolyData>::New();
    this->PartGeometry->ShallowCopy(geometry);
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
// Joins the parts of all ranks, if any has changed or failed. All ranks call this for every update.
void vtkCSLFRepresentation::UpdateField()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const bool isShared = controller && controller->GetNumberOfProcesses() > 1;
  const int own = static_cast<int>(this->State);
  int all = own;
  if (isShared)
  {
    controller->AllReduce(&own, &all, 1, vtkCommunicator::MAX_OP);
  }
  if (all == static_cast<int>(PartState::Unchanged))
  {
    return;
  }
  // What was delivered before is outdated, until REQUEST_RENDER.
  this->Mapper->RemoveAllInputs();
  std::string fault = this->State == PartState::Failed ? "Its input has failed." : "";
  this->Field = cslf::GatherField(this->Part, controller, fault);
  // A single process has reported the fault of its input.
  if (isShared && !fault.empty())
  {
    vtkErrorMacro("The light field is not shown. " << fault);
  }
  if (this->Field && this->Field->GetNumberOfPoints() == 0)
  {
    this->Field = nullptr;
  }
  this->Geometry = vtkSmartPointer<vtkPolyData>::New();
  if (this->Field && this->PartGeometry)
  {
    this->Geometry->ShallowCopy(this->PartGeometry);
  }
  this->UpdateOutline();
  this->State = PartState::Unchanged;
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::UpdateOutline()
{
  double bounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  if (this->Field)
  {
    this->BoundsMapper->SetInputData(this->Field);
    this->BoundsMapper->SetGeometryData(this->Geometry);
    this->BoundsMapper->GetBounds(bounds);
  }
  else
  {
    this->BoundsMapper->RemoveAllInputs();
  }
  // Input that is not a light field has been reported.
  if (!vtkMath::AreBoundsInitialized(bounds))
  {
    this->Field = nullptr;
  }
  this->Outline->SetBounds(bounds);
}

//------------------------------------------------------------------------------
vtkDataObject* vtkCSLFRepresentation::GetRenderedDataObject(int vtkNotUsed(port))
{
  if (!this->Field)
  {
    return nullptr;
  }
  this->Outline->Update();
  return this->Outline->GetOutput();
}

//------------------------------------------------------------------------------
// The outline at the actor's position.
void vtkCSLFRepresentation::GetDrawnBounds(double bounds[6])
{
  vtkMath::UninitializeBounds(bounds);
  if (!this->Field)
  {
    return;
  }
  double cube[6];
  this->Outline->GetBounds(cube);
  vtkNew<vtkMatrix4x4> matrix;
  this->Actor->GetMatrix(matrix);
  vtkBoundingBox box;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double point[4] = { cube[corner & 1], cube[2 + (corner >> 1 & 1)],
      cube[4 + (corner >> 2)], 1.0 };
    double placed[4];
    matrix->MultiplyPoint(point, placed);
    box.AddPoint(placed);
  }
  box.GetBounds(bounds);
}

//------------------------------------------------------------------------------
int vtkCSLFRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->ConnectGeometry();
  }
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  return cslf::GuardMethod(this, "The light field cannot be shown",
    [&]
    {
      this->ShowPieces(request, inInfo, outInfo);
      return 1;
    });
}

//------------------------------------------------------------------------------
// Announces this process's pieces, or receives those that were delivered to it.
void vtkCSLFRepresentation::ShowPieces(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->UpdateField();
    // A rank that receives a piece must announce one, too.
    vtkPVView::SetPiece(
      inInfo, this, this->Field ? this->Field.Get() : this->NoField.Get(), 0, FieldPort);
    vtkPVView::SetPiece(inInfo, this, this->Geometry, 0, GeometryPort);
    double bounds[6];
    this->GetDrawnBounds(bounds);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds);
    vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
    if (controller && controller->GetNumberOfProcesses() > 1)
    {
      // Partly covered pixels must be composited in order.
      outInfo->Set(vtkPVRenderView::NEED_ORDERED_COMPOSITING(), 1);
      vtkPVRenderView::SetOrderedCompositingConfiguration(
        inInfo, this, vtkPVRenderView::USE_BOUNDS_FOR_REDISTRIBUTION, bounds);
    }
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->ReceivePieces(inInfo);
  }
}

//------------------------------------------------------------------------------
// Connects the mapper to what has been delivered to this process.
void vtkCSLFRepresentation::ReceivePieces(vtkInformation* info)
{
  auto* field = vtkImageData::SafeDownCast(vtkPVView::GetDeliveredPiece(info, this, FieldPort));
  auto* geometry =
    vtkPolyData::SafeDownCast(vtkPVView::GetDeliveredPiece(info, this, GeometryPort));
  const bool hasField = field && field->GetNumberOfPoints() > 0;
  const bool hasGeometry = hasField && geometry && geometry->GetNumberOfCells() > 0;
  this->Mapper->SetInputConnection(
    FieldPort, hasField ? vtkPVRenderView::GetPieceProducer(info, this, FieldPort) : nullptr);
  this->Mapper->SetInputConnection(GeometryPort,
    hasGeometry ? vtkPVRenderView::GetPieceProducer(info, this, GeometryPort) : nullptr);
  this->Actor->SetVisibility(hasField && this->GetVisibility());
  this->ShowLegends(hasField && this->GetVisibility() && this->ShowLegend ? field : nullptr);
}

//------------------------------------------------------------------------------
// Shows the legends of a field, or none, and whether it is out of date.
void vtkCSLFRepresentation::ShowLegends(vtkImageData* field)
{
  if (!this->LegendRenderer)
  {
    return;
  }
  if (field != this->LegendField)
  {
    for (vtkScalarBarActor* actor : this->Legends)
    {
      this->LegendRenderer->RemoveActor2D(actor);
    }
    this->Legends.clear();
    this->LegendField = field;
    const std::vector<cslf::Legend> legends =
      field ? cslf::GetLegends(field->GetFieldData()) : std::vector<cslf::Legend>();
    for (std::size_t i = 0; i < std::min(legends.size(), MaximumLegends); ++i)
    {
      this->Legends.push_back(MakeLegendActor(legends[i], static_cast<int>(i)));
      this->LegendRenderer->AddActor2D(this->Legends.back());
    }
  }
  vtkAlgorithm* producer = field && this->GetNumberOfInputConnections(FieldPort) == 1
    ? this->GetInputAlgorithm(FieldPort, 0)
    : nullptr;
  const std::string change = producer ? FindChange(producer) : "";
  this->Note->SetVisibility(!change.empty());
  this->Note->SetInput(
    ("Out of date: the colors of " + change + "\nhave changed since the bake.").c_str());
}

//------------------------------------------------------------------------------
bool vtkCSLFRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->AddActor(this->Actor);
  this->LegendRenderer = renderView->GetNonCompositedRenderer();
  this->LegendRenderer->AddActor2D(this->Note);
  renderView->RegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkCSLFRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->UnRegisterPropForHardwareSelection(this, this->Actor);
  renderView->GetRenderer()->RemoveActor(this->Actor);
  this->ShowLegends(nullptr);
  if (this->LegendRenderer)
  {
    this->LegendRenderer->RemoveActor2D(this->Note);
  }
  this->LegendRenderer = nullptr;
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Actor->SetVisibility(visible);
  if (!visible)
  {
    this->ShowLegends(nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetShowLegend(bool show)
{
  this->ShowLegend = show;
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetLookup(int lookup)
{
  this->Mapper->SetLookup(lookup);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetAutomaticFocalPoint(bool automatic)
{
  this->Mapper->SetAutomaticFocalPoint(automatic);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetFocalPoint(double x, double y, double z)
{
  this->Mapper->SetFocalPoint(x, y, z);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetPixelSamples(int samples)
{
  this->Mapper->SetPixelSamples(samples);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetExposure(double exposure)
{
  this->Mapper->GetToneMapping()->SetExposure(exposure);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetToneMapping(int curve)
{
  this->Mapper->GetToneMapping()->SetCurve(curve);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetAutoAdjustResolution(bool adjust)
{
  this->Mapper->SetAutoAdjustResolution(adjust);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetTextureMemory(int mebibytes)
{
  this->Mapper->SetTextureMemoryLimit(vtkTypeInt64(mebibytes) << 20);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetOpacity(double opacity)
{
  this->Actor->GetProperty()->SetOpacity(opacity);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetPosition(double x, double y, double z)
{
  this->Actor->SetPosition(x, y, z);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
void vtkCSLFRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Field: " << this->Field.Get() << "\n";
  os << indent << "Geometry: " << this->Geometry.Get() << "\n";
  os << indent << "ShowLegend: " << this->ShowLegend << "\n";
  os << indent << "Mapper:\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
