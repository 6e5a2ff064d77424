// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMapper.h"

#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfFieldStore.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfRequests.h"
#include "cslfDescription.h"
#include "cslfFocus.h"
#include "cslfGeometryMesh.h"
#include "cslfShownMaps.h"
#include "vtkCSLFCubeMapper.h"
#include "vtkCSLFToneMapping.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace
{
constexpr const char* ReadingError = "The light field cannot be read";
constexpr const char* DrawingError = "The light field cannot be drawn";
}

class vtkCSLFMapper::vtkInternals
{
public:
  std::map<vtkWindow*, vtkSmartPointer<vtkCSLFCubeMapper>> CubeMappers;
  std::shared_ptr<cslf::FieldStore> Store; ///< null without a valid field
  std::optional<std::array<glm::dvec3, cslf::FaceCount>> AutomaticFocalPoints;
  vtkObject* CheckedInput = nullptr; ///< only compared
  vtkMTimeType CheckedTime = 0;
  std::shared_ptr<const cslf::GeometryMesh> Geometry; ///< null if there is none
  vtkObject* CheckedGeometry = nullptr;               ///< only compared
  vtkMTimeType CheckedGeometryTime = 0;
  cslf::MapChooser Chooser;
  cslf::MapTable OwnTable;
  bool HasWarnedOfMaps = false;
  bool HasWarnedOfInside = false;
  bool HasReportedDamage = false;

  const cslf::Cube& GetCube() const { return this->Store->GetDescription().Box; }
  std::array<glm::dvec3, cslf::FaceCount> GetFocalPointsCC(const vtkCSLFMapper* mapper);
  void FindFocalPoints();
  void FindBounds(bool usesGeometry, double bounds[6]) const;
  std::vector<glm::dvec4> GetClippingPlanesCC(vtkMapper* mapper, vtkActor* actor) const;
};

//------------------------------------------------------------------------------
std::array<glm::dvec3, cslf::FaceCount> vtkCSLFMapper::vtkInternals::GetFocalPointsCC(
  const vtkCSLFMapper* mapper)
{
  if (mapper->AutomaticFocalPoint)
  {
    if (mapper->Lookup == FOCAL && !this->AutomaticFocalPoints)
    {
      this->FindFocalPoints();
    }
    return this->AutomaticFocalPoints.value_or(std::array<glm::dvec3, cslf::FaceCount>{});
  }
  const double* point = mapper->FocalPoint;
  std::array<glm::dvec3, cslf::FaceCount> points;
  points.fill(this->GetCube().PointToCube({ point[0], point[1], point[2] }));
  return points;
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::vtkInternals::FindFocalPoints()
{
  const cslf::Description& field = this->Store->GetDescription();
  std::vector<int> slices;
  slices.reserve(cslf::FaceCount);
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    slices.push_back(cslf::FindFocalSlice(field, face));
  }
  this->Store->Prefetch(slices);
  this->Store->Wait();
  this->AutomaticFocalPoints.emplace();
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    (*this->AutomaticFocalPoints)[face] =
      cslf::FindFocalPoint(field, face, this->Store->Get(slices[face]));
  }
}

//------------------------------------------------------------------------------
// The environment is drawn on the far side of the cube.
void vtkCSLFMapper::vtkInternals::FindBounds(bool usesGeometry, double bounds[6]) const
{
  if (usesGeometry && this->Geometry && this->Geometry->IsComplete &&
    !this->Store->GetDescription().MayShowEnvironment())
  {
    const glm::dvec3 low = this->GetCube().PointToWorld(this->Geometry->MinimumCC);
    const glm::dvec3 high = this->GetCube().PointToWorld(this->Geometry->MaximumCC);
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = low[axis];
      bounds[2 * axis + 1] = high[axis];
    }
    return;
  }
  this->GetCube().GetBounds(bounds);
}

//------------------------------------------------------------------------------
std::vector<glm::dvec4> vtkCSLFMapper::vtkInternals::GetClippingPlanesCC(
  vtkMapper* mapper, vtkActor* actor) const
{
  const cslf::Cube& box = this->GetCube();
  std::vector<glm::dvec4> planes;
  for (int i = 0; i < mapper->GetNumberOfClippingPlanes(); ++i)
  {
    double plane[4];
    mapper->GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    const glm::dvec3 normal(plane[0], plane[1], plane[2]);
    planes.emplace_back(0.5 * normal * box.Edges, plane[3] + glm::dot(normal, box.Center));
  }
  return planes;
}

vtkStandardNewMacro(vtkCSLFMapper);
cslfSetOptionMacro(vtkCSLFMapper, Lookup, Lookup);
cslfSetOptionMacro(vtkCSLFMapper, PixelSamples, PixelSamples);
cslfSetClampMacro(vtkCSLFMapper, TextureMemoryLimit, 0, VTK_TYPE_INT64_MAX);

namespace options = cslf::options;

//------------------------------------------------------------------------------
vtkCSLFMapper::vtkCSLFMapper()
  : Lookup(options::Lookup.Default)
  , AutomaticFocalPoint(options::AutomaticFocalPoint.Default)
  , AutoAdjustResolution(options::AutoAdjustResolution.Default)
  , PixelSamples(options::PixelSamples.Default)
  , ToneMapping(vtkSmartPointer<vtkCSLFToneMapping>::New())
  , TextureMemoryLimit(vtkTypeInt64(options::TextureMemory.Default) << 20)
  , Internals(new vtkInternals)
{
  std::copy_n(options::FocalPoint.Default.begin(), 3, this->FocalPoint);
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkCSLFMapper::~vtkCSLFMapper() = default;

//------------------------------------------------------------------------------
int vtkCSLFMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkPolyData* vtkCSLFMapper::GetGeometry()
{
  return this->GetNumberOfInputConnections(1) < 1
    ? nullptr
    : vtkPolyData::SafeDownCast(this->GetExecutive()->GetInputData(1, 0));
}

//------------------------------------------------------------------------------
vtkImageData* vtkCSLFMapper::GetInput()
{
  return this->GetNumberOfInputConnections(0) < 1
    ? nullptr
    : vtkImageData::SafeDownCast(this->GetExecutive()->GetInputData(0, 0));
}

//------------------------------------------------------------------------------
const char* vtkCSLFMapper::GetLookupAsString()
{
  return vtkCSLFMapper::GetLookupName(this->Lookup);
}

//------------------------------------------------------------------------------
const char* vtkCSLFMapper::GetLookupName(int lookup)
{
  constexpr auto& names = options::Lookup.Names;
  static_assert(names.size() == NUMBER_OF_LOOKUPS, "each lookup needs a name");
  return lookup >= 0 && lookup < NUMBER_OF_LOOKUPS ? names[lookup] : nullptr;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkCSLFMapper::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ToneMapping->GetMTime());
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::SetToneMapping(vtkCSLFToneMapping* toneMapping)
{
  cslf::SetOptions(this, this->ToneMapping, toneMapping);
}

//------------------------------------------------------------------------------
vtkCSLFToneMapping* vtkCSLFMapper::GetToneMapping()
{
  return this->ToneMapping;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkCSLFMapper::GetTextureBytes()
{
  vtkTypeInt64 bytes = 0;
  for (const auto& windowAndMapper : this->Internals->CubeMappers)
  {
    bytes += windowAndMapper.second->GetTextureBytes();
  }
  return bytes;
}

//------------------------------------------------------------------------------
// Reads the input's description, once per change of the input.
bool vtkCSLFMapper::UpdateField()
{
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    return false;
  }
  vtkInternals& internals = *this->Internals;
  vtkAlgorithm* producer = this->GetInputAlgorithm();
  vtkInformation* output = this->GetInputInformation();
  const bool isKnown = this->Static || cslf::UpdateInformation(this->GetInputConnection(0, 0));
  // A producer that lends a store, such as a decoder, is not updated: viewpoints come from its
  // store as they are needed.
  const bool isLent = cslf::IsStoreLent(output);
  if (!isLent && isKnown && !this->Static)
  {
    cslf::UpdateWhole(this->GetInputConnection(0, 0));
  }
  vtkObject* input = isLent ? static_cast<vtkObject*>(producer) : this->GetInput();
  // With Static, the producer may not have been updated yet.
  if (!input || (!isLent && this->Static && this->GetInput()->GetNumberOfPoints() == 0))
  {
    return false;
  }
  if (isLent)
  {
    // What the producer has open, whatever file it is going to open. It has reported why if there
    // is nothing.
    const auto store = cslf::BorrowStore(output);
    if (internals.CheckedInput == input && internals.Store == store)
    {
      return store != nullptr;
    }
    internals.Store = store;
    if (store)
    {
      store->ReportMissing();
    }
  }
  else
  {
    if (internals.CheckedInput == input && internals.CheckedTime == input->GetMTime())
    {
      return internals.Store != nullptr;
    }
    // Opening may fail by an exception.
    internals.Store = nullptr;
    internals.CheckedInput = input;
    internals.CheckedTime = input->GetMTime();
    internals.Store = this->OpenImage(this->GetInput());
  }
  internals.CheckedInput = input;
  internals.CheckedTime = input->GetMTime();
  internals.CheckedGeometry = nullptr;
  if (!internals.Store)
  {
    return false;
  }
  internals.AutomaticFocalPoints.reset();
  internals.HasWarnedOfInside = false;
  internals.HasReportedDamage = false;
  for (const auto& windowAndMapper : internals.CubeMappers)
  {
    windowAndMapper.second->SetStore(internals.Store);
  }
  return true;
}

//------------------------------------------------------------------------------
// Reads the geometry, once per change of it or of the field.
void vtkCSLFMapper::UpdateGeometry()
{
  vtkInternals& internals = *this->Internals;
  if (this->GetNumberOfInputConnections(1) > 0 && !this->Static)
  {
    cslf::UpdateWhole(this->GetInputConnection(1, 0));
  }
  vtkPolyData* geometry = this->GetGeometry();
  const vtkMTimeType time =
    geometry ? std::max(geometry->GetMTime(), internals.CheckedTime) : vtkMTimeType(0);
  if (internals.CheckedGeometry == geometry && internals.CheckedGeometryTime == time)
  {
    return;
  }
  internals.CheckedGeometry = geometry;
  internals.CheckedGeometryTime = time;
  std::string fault;
  internals.Geometry =
    geometry ? cslf::MakeGeometryMesh(geometry, internals.Store->GetDescription(), fault) : nullptr;
  if (!fault.empty())
  {
    vtkWarningMacro("The geometry is not used: " << fault << ".");
  }
  internals.HasWarnedOfMaps = false;
}

//------------------------------------------------------------------------------
// Reads what tells of bounds and scalars before anything is drawn. False without a field.
bool vtkCSLFMapper::ReadGeometry()
{
  const bool isRead = cslf::GuardMethod(this, ReadingError, [this] { return this->UpdateField(); });
  if (isRead && this->Lookup == GEOMETRY)
  {
    this->UpdateGeometry();
  }
  return isRead;
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::SetScalarRange(double lowest, double highest)
{
  if (!this->HasScalarRange)
  {
    this->HasScalarRange = true;
    this->Modified();
  }
  this->Superclass::SetScalarRange(lowest, highest);
}

//------------------------------------------------------------------------------
double* vtkCSLFMapper::GetScalarRange()
{
  if (!this->HasScalarRange)
  {
    this->TellScalars();
  }
  return this->ScalarRange;
}

//------------------------------------------------------------------------------
// Reads the geometry for its scalars.
void vtkCSLFMapper::TellScalars()
{
  const bool isTold = cslf::GuardMethod(this, DrawingError,
    [this]
    {
      if (this->ReadGeometry())
      {
        this->UpdateScalarRange();
      }
      return true;
    });
  if (!isTold)
  {
    this->Internals->Store = nullptr; // reported once
  }
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::CreateDefaultLookupTable()
{
  this->TellScalars();
  this->SetLookupTable(this->Internals->OwnTable.Get());
}

//------------------------------------------------------------------------------
// The name of the array that is selected, by its name or its number. Empty for all.
std::string vtkCSLFMapper::GetSelectedArray()
{
  const char* name = this->ArrayAccessMode == VTK_GET_ARRAY_BY_NAME ? this->ArrayName : nullptr;
  vtkPolyData* geometry = this->GetGeometry();
  if (this->ArrayAccessMode == VTK_GET_ARRAY_BY_ID && this->ArrayId >= 0 && geometry)
  {
    name = geometry->GetPointData()->GetArrayName(this->ArrayId);
  }
  return name ? name : "";
}

//------------------------------------------------------------------------------
// The array that is selected, and its component: that of ColorByArrayComponent, or else of the
// table, as in other mappers.
cslf::MapChoice vtkCSLFMapper::GetMapSelection()
{
  cslf::MapChoice choice;
  choice.Array = this->GetSelectedArray();
  choice.Component = std::max(this->ArrayComponent, 0);
  vtkScalarsToColors* table = this->GetUserTable();
  if (table && this->ArrayComponent < 0)
  {
    choice.Component = cslf::GetTableComponent(table);
  }
  return choice;
}

//------------------------------------------------------------------------------
// The table that was set. Null if there is none but the one of the mapper's own.
vtkScalarsToColors* vtkCSLFMapper::GetUserTable() const
{
  const cslf::MapTable& own = this->Internals->OwnTable;
  const bool isOwn = this->LookupTable == own.Get() && !own.IsChanged();
  return isOwn ? nullptr : this->LookupTable;
}

//------------------------------------------------------------------------------
// What the mapper tells, if nothing else was set: table and range of the first map that is
// selected.
void vtkCSLFMapper::UpdateScalarRange()
{
  vtkInternals& internals = *this->Internals;
  if (!internals.Geometry || internals.Geometry->Mapped.IsEmpty())
  {
    return;
  }
  const cslf::ColorMap& map =
    internals.Chooser.FindMap(internals.Geometry, this->GetMapSelection());
  if (!this->HasScalarRange)
  {
    std::copy_n(map.Range, 2, this->ScalarRange);
  }
  internals.OwnTable.Update(map, this->ScalarRange);
}

//------------------------------------------------------------------------------
std::shared_ptr<const cslf::ShownMaps> vtkCSLFMapper::ChooseMaps(vtkActor* actor)
{
  this->UpdateScalarRange();
  cslf::MapChoice choice = this->GetMapSelection();
  if (this->ScalarVisibility)
  {
    choice.Table = this->GetUserTable();
    choice.TableTime = choice.Table ? choice.Table->GetMTime() : 0;
    choice.UsesTableRange = this->UseLookupTableScalarRange != 0;
  }
  else
  {
    const double* color = actor->GetProperty()->GetDiffuseColor();
    choice.Plain = glm::dvec3(color[0], color[1], color[2]);
  }
  if (this->HasScalarRange)
  {
    choice.Range = { this->ScalarRange[0], this->ScalarRange[1] };
  }
  std::string problem;
  auto maps = this->Internals->Chooser.Choose(this->Internals->Geometry, choice, problem);
  this->WarnOfMaps(choice, problem);
  return maps;
}

//------------------------------------------------------------------------------
bool vtkCSLFMapper::FindShownGeometry(vtkActor* actor, cslf::ShownGeometry& shown)
{
  return cslf::GuardMethod(this, ReadingError,
    [&]
    {
      if (!this->UpdateField())
      {
        return false;
      }
      this->UpdateGeometry();
      const vtkInternals& internals = *this->Internals;
      shown.Mesh = internals.Geometry;
      if (shown.Mesh)
      {
        shown.Field = internals.Store->GetDescription();
        shown.Geometry = this->GetGeometry();
        shown.Maps = this->ChooseMaps(actor);
      }
      return shown.Mesh != nullptr;
    });
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::WarnOfMaps(const cslf::MapChoice& choice, const std::string& problem)
{
  if (!problem.empty())
  {
    vtkWarningMacro("Scalars keep the colours of the field: " << problem << ".");
  }
  vtkInternals& internals = *this->Internals;
  const bool isAsked = (choice.Table || choice.Range) && !choice.Plain;
  if (!isAsked || internals.HasWarnedOfMaps)
  {
    return;
  }
  const bool isShown =
    this->Lookup == GEOMETRY && internals.Geometry && !internals.Geometry->Mapped.IsEmpty();
  if (!isShown)
  {
    internals.HasWarnedOfMaps = true;
    vtkWarningMacro("The light field keeps its colours, because no geometry with scalars is drawn: "
                    "neither a lookup table nor a range of scalars changes them.");
  }
  else if (!internals.Geometry->IsAlone)
  {
    internals.HasWarnedOfMaps = true;
    vtkWarningMacro("Only surfaces that the geometry alone shows have the colours of the lookup "
                    "table. What viewpoints show keeps those of the light field.");
  }
}

//------------------------------------------------------------------------------
std::shared_ptr<cslf::FieldStore> vtkCSLFMapper::OpenImage(vtkImageData* image)
{
  std::string error;
  const auto field = cslf::Description::ReadFrom(image, error);
  if (field)
  {
    const int* extent = image->GetExtent();
    if (!field->FindChannel(cslf::KnownChannel::Color))
    {
      error = "The light field has no colour.";
    }
    else if (extent[4] != 0 || extent[5] != field->Grid.GetSlices() - 1)
    {
      error = "The image data holds only a part of its light field's viewpoints.";
    }
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return nullptr;
  }
  return cslf::MakeStore(*field, image);
}

//------------------------------------------------------------------------------
double* vtkCSLFMapper::GetBounds()
{
  vtkMath::UninitializeBounds(this->Bounds);
  const bool isFound = cslf::GuardMethod(this, DrawingError,
    [this]
    {
      if (this->ReadGeometry())
      {
        this->Internals->FindBounds(this->Lookup == GEOMETRY, this->Bounds);
      }
      return true;
    });
  if (!isFound)
  {
    this->Internals->Store = nullptr; // reported once
  }
  return this->Bounds;
}

//------------------------------------------------------------------------------
// The one that draws in a window, made when it is first needed.
vtkCSLFCubeMapper* vtkCSLFMapper::GetCubeMapper(vtkWindow* window)
{
  vtkInternals& internals = *this->Internals;
  auto& cubeMappers = internals.CubeMappers;
  // Windows free what belongs to them when they are destroyed, also if no actor of theirs has this
  // mapper any more.
  for (auto entry = cubeMappers.begin(); entry != cubeMappers.end();)
  {
    entry = entry->second->HasWindow() ? std::next(entry) : cubeMappers.erase(entry);
  }
  vtkSmartPointer<vtkCSLFCubeMapper>& cubeMapper = cubeMappers[window];
  if (!cubeMapper)
  {
    cubeMapper = vtkSmartPointer<vtkCSLFCubeMapper>::New();
    cubeMapper->SetStore(internals.Store);
  }
  return cubeMapper;
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!cslf::GuardMethod(this, ReadingError, [this] { return this->UpdateField(); }))
  {
    return;
  }
  const bool isDrawn = cslf::GuardMethod(this, DrawingError,
    [&]
    {
      this->Draw(renderer, actor);
      return true;
    });
  if (!isDrawn)
  {
    // Reported once, not for every picture.
    this->Internals->Store = nullptr;
  }
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::Draw(vtkRenderer* renderer, vtkActor* actor)
{
  vtkInternals& internals = *this->Internals;
  if (this->Lookup == GEOMETRY)
  {
    this->UpdateGeometry();
  }
  vtkCSLFCubeMapper* cubeMapper = this->GetCubeMapper(renderer->GetRenderWindow());
  cubeMapper->SetLookup(this->Lookup);
  cubeMapper->SetGeometry(internals.Geometry, this->ChooseMaps(actor));
  cubeMapper->SetPixelSamples(this->PixelSamples);
  cubeMapper->SetDrawSeconds(
    this->AutoAdjustResolution ? actor->GetAllocatedRenderTime() : VTK_DOUBLE_MAX);
  cubeMapper->SetFocalPointsCC(internals.GetFocalPointsCC(this));
  cubeMapper->SetClippingPlanesCC(internals.GetClippingPlanesCC(this, actor));
  cubeMapper->SetToneMapping(this->ToneMapping);
  cubeMapper->SetStreaming(this->Streaming, this->TextureMemoryLimit);
  cubeMapper->Render(renderer, actor);
  this->HasTranslucentPart = !cubeMapper->IsDrawnAtOnce();
  this->TimeToDraw = cubeMapper->GetTimeToDraw();
  if (cubeMapper->LacksAll() || cubeMapper->GetNumberOfDamagedViewpoints() > 0)
  {
    this->ReportDamage(
      cubeMapper->GetNumberOfDamagedViewpoints(), cubeMapper->GetNumberOfViewpoints());
  }
  if (cubeMapper->GetFrustum().IsInside() && !internals.HasWarnedOfInside)
  {
    internals.HasWarnedOfInside = true;
    vtkWarningMacro("The eye is inside the light field's cube: only surfaces that are also visible "
                    "from outside, along the same lines of sight, are drawn.");
  }
  if (!cubeMapper->IsComplete())
  {
    this->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ReportDamage(int damaged, int undamaged)
{
  if (this->Internals->HasReportedDamage)
  {
    return;
  }
  this->Internals->HasReportedDamage = true;
  if (undamaged > 0)
  {
    vtkWarningMacro(<< "The light field is damaged: required viewpoints are missing (" << damaged
                    << " so far), and others are used instead.");
  }
  else
  {
    vtkErrorMacro(
      "The light field is damaged or unfinished: none of the required viewpoints can be "
      "read.");
  }
}

//------------------------------------------------------------------------------
bool vtkCSLFMapper::IsComplete()
{
  const auto& cubeMappers = this->Internals->CubeMappers;
  return std::all_of(cubeMappers.begin(), cubeMappers.end(),
    [](const auto& windowAndMapper) { return windowAndMapper.second->IsComplete(); });
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  const auto found = this->Internals->CubeMappers.find(window);
  if (found != this->Internals->CubeMappers.end())
  {
    found->second->ReleaseGraphicsResources(window);
    this->Internals->CubeMappers.erase(found);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkCSLFMapper::SafeDownCast(mapper))
  {
    this->SetInputConnection(other->GetInputConnection(0, 0));
    this->SetInputConnection(1, other->GetInputConnection(1, 0));
    this->SetLookup(other->GetLookup());
    this->SetAutomaticFocalPoint(other->GetAutomaticFocalPoint());
    this->SetAutoAdjustResolution(other->GetAutoAdjustResolution());
    this->SetFocalPoint(other->GetFocalPoint());
    this->SetPixelSamples(other->GetPixelSamples());
    this->SetToneMapping(other->GetToneMapping());
    this->SetStreaming(other->GetStreaming());
    this->SetTextureMemoryLimit(other->GetTextureMemoryLimit());
  }
  this->Superclass::ShallowCopy(mapper);
  if (auto* other = vtkCSLFMapper::SafeDownCast(mapper))
  {
    // The superclass copies what getters return, also if nothing was set.
    this->SetLookupTable(other->GetUserTable());
    this->HasScalarRange = other->HasScalarRange;
  }
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lookup: " << this->GetLookupAsString() << "\n";
  os << indent << "AutomaticFocalPoint: " << (this->AutomaticFocalPoint ? "on" : "off") << "\n";
  os << indent << "AutoAdjustResolution: " << (this->AutoAdjustResolution ? "on" : "off") << "\n";
  os << indent << "FocalPoint: (" << this->FocalPoint[0] << ", " << this->FocalPoint[1] << ", "
     << this->FocalPoint[2] << ")\n";
  os << indent << "HasScalarRange: " << (this->HasScalarRange ? "yes" : "no") << "\n";
  os << indent << "PixelSamples: " << this->PixelSamples << "\n";
  os << indent << "ToneMapping:\n";
  this->ToneMapping->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Streaming: " << (this->Streaming ? "on" : "off") << "\n";
  os << indent << "TextureMemoryLimit: " << this->TextureMemoryLimit << "\n";
}
