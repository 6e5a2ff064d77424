// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSampler.h"

#include "Geometry/cslfGeometryData.h"
#include "Geometry/cslfSideColors.h"
#include "Options/cslfOptionTable.h"
#include "PathTracing/Geometry/cslfGeometryMaker.h"
#include "PathTracing/RadianceCache/cslfCacheCheck.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfSceneBuilder.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfColor.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "cslfJoin.h"
#include "cslfSeconds.h"
#include "vtkCSLFEnvironment.h"

#include <vtkDataArraySelection.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkCSLFSampler);
cslfSetOptionMacro(vtkCSLFSampler, Viewpoints, Viewpoints);
cslfSetOptionMacro(vtkCSLFSampler, Resolution, Resolution);
cslfSetOptionMacro(vtkCSLFSampler, Offset, Offset);
cslfSetOptionMacro(vtkCSLFSampler, GeometryTriangles, GeometryTriangles);

namespace options = cslf::options;

namespace
{
///@{
/// The progress when the field is there, if its geometry is made too; and the progress of the
/// geometry when it is made, and when the first side has its colours.
constexpr double FieldProgress = 0.8;
constexpr double MadeProgress = 0.7;
constexpr double FirstSideProgress = 0.85;
///@}

}

vtkCSLFSampler::vtkCSLFSampler()
  : Viewpoints(options::Viewpoints.Default)
  , Resolution(options::Resolution.Default)
  , AutomaticCube(options::AutomaticCube.Default)
  , Offset(options::Offset.Default)
  , GeometryTriangles(options::GeometryTriangles.Default)
  , SurfaceTexels(options::SurfaceTexels.Default)
{
  this->SetNumberOfOutputPorts(2);
  this->SetIntegrator(options::Integrator.Default);
  for (const cslf::KnownChannel id : cslf::TexelSums::ListChannels())
  {
    if (id != cslf::KnownChannel::Color)
    {
      this->ChannelSelection->AddArray(cslf::NameOf(id), false);
    }
  }
  this->SetGenerateDepth(options::GenerateDepth.Default);
}

// Here, because subclasses need not know the type of the selection.
vtkCSLFSampler::~vtkCSLFSampler() = default;

vtkDataArraySelection* vtkCSLFSampler::GetChannelSelection()
{
  return this->ChannelSelection;
}

vtkDataArraySelection* vtkCSLFSampler::GetSurfaceArraySelection()
{
  return this->SurfaceArraySelection;
}

vtkDataArraySelection* vtkCSLFSampler::FindKeptArrays()
{
  return this->SurfaceArraySelection;
}

void vtkCSLFSampler::SetGenerateDepth(bool generate)
{
  this->ChannelSelection->SetArraySetting(cslf::DepthName, generate);
}

bool vtkCSLFSampler::GetGenerateDepth()
{
  return this->ChannelSelection->ArrayIsEnabled(cslf::DepthName) != 0;
}

vtkMTimeType vtkCSLFSampler::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->ChannelSelection->GetMTime(),
    this->SurfaceArraySelection->GetMTime() });
}

bool vtkCSLFSampler::CheckParameters()
{
  if (this->ColorType != VTK_UNSIGNED_CHAR && this->ColorType != VTK_FLOAT)
  {
    vtkErrorMacro("ColorType must be VTK_UNSIGNED_CHAR or VTK_FLOAT.");
    return false;
  }
  const bool proper = std::all_of(this->CubeEdges, this->CubeEdges + 3,
                        [](double edge) { return edge > 0.0 && std::isfinite(edge); }) &&
    std::all_of(this->CubeCenter, this->CubeCenter + 3, [](double x) { return std::isfinite(x); });
  if (!this->AutomaticCube && !proper)
  {
    vtkErrorMacro("CubeCenter and CubeEdges must be finite, and the edges above 0.");
    return false;
  }
  return true;
}

int vtkCSLFSampler::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->CheckParameters())
  {
    return 0;
  }
  int extent[6];
  cslf::Layout(this->Viewpoints, this->Resolution).GetWholeExtent(extent);
  vtkInformation* info = outputVector->GetInformationObject(0);
  cslf::SetFieldInformation(info, extent);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->ColorType, 4);
  return 1;
}

int vtkCSLFSampler::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

vtkPolyData* vtkCSLFSampler::GetGeometry()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTypeBool vtkCSLFSampler::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    cslf::ChoosePorts(
      request, outputVector, cslf::IsWholeRequested(outputVector->GetInformationObject(0)));
    for (int port = 0; this->IsSceneAlone && port < this->GetNumberOfOutputPorts(); ++port)
    {
      cslf::SetNotMade(outputVector, port);
    }
    return 1;
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_TIME()))
  {
    cslf::ShareTime(request, outputVector);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

int vtkCSLFSampler::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const cslf::BuiltScene* scene = this->UpdateScene(inputVector);
  cslf::Description description;
  if (!scene || !this->Describe(*scene, description))
  {
    return cslf::IsAborted(this) ? 1 : 0;
  }
  this->DropOthers(*scene, outputVector);
  this->Record = this->MakeRecord(*scene, description);
  if (this->IsSceneAlone)
  {
    return 1;
  }
  const int side = this->Resolution;
  const cslf::CheckedPicture whole{ side, side, cslf::TileCount, description.Grid.GetSlices(),
    [&](int slice, int tile)
    { return cslf::MakeFieldRays(description.Grid, description.Box, scene->Frame, slice, tile); } };
  const bool isDone = !cslf::IsPortWanted(outputVector, 0) ||
    this->SampleField(whole, description, outputVector->GetInformationObject(0),
      this->GeometryTriangles > 0 && cslf::IsPortWanted(outputVector, 1));
  if (isDone && cslf::IsPortWanted(outputVector, 1))
  {
    this->UpdateGeometry(*scene, description, whole);
  }
  if (isDone && this->Geometry && cslf::IsPortWanted(outputVector, 1))
  {
    vtkPolyData::GetData(outputVector, 1)->ShallowCopy(this->Geometry);
  }
  return 1;
}

// An output that is not made stays as it is, unless it is of another scene: that of another time is
// not known to be older.
void vtkCSLFSampler::DropOthers(const cslf::BuiltScene& scene, vtkInformationVector* outputVector)
{
  const std::string hash = scene.Fingerprint + scene.ArraysFingerprint;
  for (int port = 0; port < 2 && hash != this->OutputScene; ++port)
  {
    if (!cslf::IsPortWanted(outputVector, port))
    {
      vtkDataObject::GetData(outputVector, port)->Initialize();
    }
  }
  this->OutputScene = hash;
}

// What the samples and the geometry depend on. The results of the cache are not known before.
std::string vtkCSLFSampler::MakeRecord(
  const cslf::BuiltScene& scene, const cslf::Description& description)
{
  nlohmann::json sampling = nlohmann::json::parse(this->DescribeSampling());
  const auto cache = sampling.find("cache");
  if (cache != sampling.end())
  {
    cache->erase("used_spacing");
    cache->erase("check");
  }
  std::vector<std::string> arrays;
  for (int i = 0; i < this->SurfaceArraySelection->GetNumberOfArrays(); ++i)
  {
    if (this->SurfaceArraySelection->GetArraySetting(i))
    {
      arrays.emplace_back(this->SurfaceArraySelection->GetArrayName(i));
    }
  }
  const nlohmann::json record = { { "description", description.ToJSON() }, { "sampling", sampling },
    { options::SurfaceTexels.Key, this->SurfaceTexels },
    { "geometry_triangles", this->GeometryTriangles }, { "arrays", arrays },
    { "array_contents", scene.ArraysFingerprint } };
  return record.dump();
}

std::string vtkCSLFSampler::UpdateRecord()
{
  this->Record.clear();
  this->IsSceneAlone = true;
  this->Modified();
  this->Update(0);
  this->IsSceneAlone = false;
  return this->Record;
}

// The field that is to be sampled. Reports an error and returns false if there is none.
bool vtkCSLFSampler::Describe(const cslf::BuiltScene& scene, cslf::Description& description)
{
  description.Grid = cslf::Layout(this->Viewpoints, this->Resolution);
  description.Box = cslf::Cube::FromBounds(scene.Bounds, this->Offset);
  if (!this->AutomaticCube)
  {
    description.Box = { { this->CubeCenter[0], this->CubeCenter[1], this->CubeCenter[2] },
      { this->CubeEdges[0], this->CubeEdges[1], this->CubeEdges[2] } };
  }
  std::copy_n(scene.Bounds, 6, this->SceneBounds);
  if (!description.Box.Contains(scene.Bounds))
  {
    vtkErrorMacro("The cube must strictly contain the scene.");
    return false;
  }
  if (!this->GetEnvironment()->GetShow())
  {
    description.SceneBounds.emplace();
    std::copy_n(scene.Bounds, 6, description.SceneBounds->begin());
  }
  for (const cslf::KnownChannel id : cslf::TexelSums::ListChannels())
  {
    if (id == cslf::KnownChannel::Color)
    {
      description.Channels.push_back(cslf::MakeChannel(id, this->ColorType));
    }
    else if (this->ChannelSelection->ArrayIsEnabled(cslf::NameOf(id)))
    {
      description.Channels.push_back(cslf::MakeChannel(id));
    }
  }
  const std::string fault = description.FindError();
  if (!fault.empty())
  {
    vtkErrorMacro("The light field cannot be sampled: " << fault << ".");
    return false;
  }
  return true;
}

// Samples the requested slices. Returns false if this was aborted.
bool vtkCSLFSampler::SampleField(const cslf::CheckedPicture& whole, cslf::Description& description,
  vtkInformation* info, bool hasGeometry)
{
  vtkImageData* output = vtkImageData::GetData(info);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  cslf::AllocateSlices(description, extent[4], extent[5], output);
  const cslf::Phase phase(this, "", hasGeometry ? FieldProgress : 1.0);
  if (!this->Render(whole, extent[4], extent[5] - extent[4] + 1, cslf::ViewpointSamples(output),
        this->SurfaceTexels, "Sampling viewpoints"))
  {
    return false;
  }
  nlohmann::json sampling = nlohmann::json::parse(this->DescribeSampling());
  sampling[options::SurfaceTexels.Key] = this->SurfaceTexels;
  description.Sampling = sampling.dump();
  description.WriteTo(output->GetFieldData());
  return true;
}

// Makes the geometry, unless it is there.
void vtkCSLFSampler::UpdateGeometry(const cslf::BuiltScene& scene,
  const cslf::Description& description, const cslf::CheckedPicture& whole)
{
  if (this->GeometryTriangles == 0)
  {
    this->Geometry = nullptr;
    this->GeometryKey.clear();
    return;
  }
  std::ostringstream key;
  key << this->GetMTime() << ' ' << scene.Fingerprint << ' ' << scene.ArraysFingerprint;
  if (this->GeometryKey == key.str())
  {
    return;
  }
  const std::string fault = cslf::FindGeometryError(*scene.World);
  if (!fault.empty())
  {
    vtkWarningMacro(
      "The scene gets no geometry, because " << fault << ": it is looked up by depth.");
    this->Geometry = vtkSmartPointer<vtkPolyData>::New();
    this->GeometryKey = key.str();
    return;
  }
  const cslf::ShapeCounts shapes = cslf::CountShapes(*scene.World);
  if (shapes.Omitted > 0)
  {
    vtkWarningMacro("The geometry is without " << shapes.Omitted << " of "
                                               << shapes.Omitted + shapes.Opaque
                                               << " polygons, spheres and tubes, because they are "
                                                  "translucent, or visible from one side only: "
                                                  "these are looked up by depth.");
  }
  const auto start = std::chrono::steady_clock::now();
  const cslf::Phase phase(this, "");
  this->Geometry = nullptr;
  this->GeometryKey.clear();
  const std::optional<cslf::Geometry> made = this->MakeSurface(scene, description, whole);
  cslf::SideColors colors;
  if (made && this->RenderSides(whole, *made, colors))
  {
    this->Geometry =
      cslf::MakeGeometryData(made->Surface, scene.Frame.Center, glm::dvec3(scene.Frame.Radius),
        { scene.Frame.Radius * made->Error.RootMeanSquare, made->Error.Loss, scene.Fingerprint,
          shapes.Omitted > 0, made->Groups });
    if (shapes.Omitted > 0 || this->ColorType == VTK_FLOAT)
    {
      // Rays may pass veils before the surfaces, which only the viewpoints show. And the colours
      // were fitted to be interpolated as sRGB, but floats are interpolated as they are.
      colors.Exact = {};
      colors.DropMaps();
    }
    cslf::AddSideColors(made->Surface, std::move(colors), this->ColorType, this->Geometry);
    this->WarnOfArrays(scene);
    const std::string loss = cslf::DescribeGeometryLoss(this->Geometry, this->GeometryTriangles);
    if (!loss.empty())
    {
      vtkWarningMacro(<< loss);
    }
    this->GeometryKey = key.str();
  }
  this->GeometrySeconds = cslf::SecondsSince(start);
}

// Names the arrays that were asked for, or kept by the scene, and are not there.
void vtkCSLFSampler::WarnOfArrays(const cslf::BuiltScene& scene)
{
  std::set<std::string> missing;
  for (int i = 0; i < this->SurfaceArraySelection->GetNumberOfArrays(); ++i)
  {
    const char* name = this->SurfaceArraySelection->GetArrayName(i);
    if (this->SurfaceArraySelection->ArrayIsEnabled(name))
    {
      missing.insert(cslf::NameScalars(name));
    }
  }
  for (const cslf::Mesh& mesh : scene.World->GetMeshes())
  {
    for (std::size_t i = 0; i < mesh.GetNumberOfArrays(); ++i)
    {
      missing.insert(mesh.GetArray(i).Name);
    }
  }
  const cslf::MappedPoints points = cslf::FindMappedPoints(this->Geometry);
  for (const cslf::ColorMap& map : points.Maps)
  {
    missing.erase(cslf::NameScalars(map.Array));
  }
  for (const cslf::SurfaceArray& array : points.Arrays)
  {
    missing.erase(array.Name);
  }
  if (!missing.empty())
  {
    vtkWarningMacro("The geometry is without these arrays: "
      << cslf::Join(missing)
      << ". Only data of opaque surfaces that look the same from all directions is kept, and "
         "only beside one colour or a colour map.");
  }
}

// The geometry without colours; nothing if aborted.
std::optional<cslf::Geometry> vtkCSLFSampler::MakeSurface(const cslf::BuiltScene& scene,
  const cslf::Description& description, const cslf::CheckedPicture& whole)
{
  const bool isFloat = this->ColorType == VTK_FLOAT;
  cslf::RenderSettings rendering;
  if (!this->PrepareRendering(whole, isFloat, true, rendering))
  {
    return std::nullopt;
  }
  cslf::GeometrySettings settings;
  settings.Grid = description.Grid;
  settings.Box = description.Box;
  settings.Frame = scene.Frame;
  settings.MaximumTriangles = static_cast<std::size_t>(this->GeometryTriangles);
  settings.Light = rendering.Cache;
  settings.Exposure = rendering.Exposure;
  settings.ClampsColors = !isFloat;
  // A root mean square is about half of the largest error. Exact colours are within half a level.
  settings.Tolerance =
    this->GetColors() == Exact ? 0.5 / 255.0 : 0.5 * this->GetUsedCacheTolerance();
  cslf::Phase phase(this, "Making the geometry", MadeProgress);
  return cslf::MakeGeometry(
    *scene.World, settings, [&phase](double share) { return phase.Report(share); });
}

// The colours of both sides of the geometry's points.
bool vtkCSLFSampler::RenderSides(
  const cslf::CheckedPicture& whole, const cslf::Geometry& geometry, cslf::SideColors& colors)
{
  colors.Exact = geometry.Colors.Exact;
  colors.Mapped = geometry.Colors.Mapped;
  for (std::size_t side = 0; side < colors.Sides.size(); ++side)
  {
    const auto& [points, rays] = geometry.Sides[side];
    for (const glm::vec4& color : geometry.Colors.Sides[side])
    {
      colors.Sides[side].push_back(this->ColorType == VTK_FLOAT
          ? glm::vec4(cslf::SRGBToLinear(glm::dvec3(color)), color.w)
          : color);
    }
    colors.Sides[side].resize(geometry.Surface.Points.size(), glm::vec4(0.0f));
    if (points.empty())
    {
      continue;
    }
    const cslf::Channel channel = cslf::MakeChannel(cslf::KnownChannel::Color, this->ColorType);
    const auto array = cslf::MakeArray(channel, static_cast<vtkIdType>(points.size()));
    cslf::ViewpointSamples samples;
    samples.SetArray(cslf::KnownChannel::Color, array);
    const cslf::Phase phase(this, "", side == 0 ? FirstSideProgress : 1.0);
    if (!this->RenderRays(whole, rays, samples, "Colouring the geometry"))
    {
      return false;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      colors.Sides[side][points[i]] =
        colors.ToLight(points[i], cslf::GetColor(array, static_cast<vtkIdType>(i)));
    }
  }
  return true;
}

void vtkCSLFSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Viewpoints: " << this->Viewpoints << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "AutomaticCube: " << this->AutomaticCube << "\n";
  os << indent << "Offset: " << this->Offset << "\n";
  os << indent << "CubeCenter: " << this->CubeCenter[0] << " " << this->CubeCenter[1] << " "
     << this->CubeCenter[2] << "\n";
  os << indent << "CubeEdges: " << this->CubeEdges[0] << " " << this->CubeEdges[1] << " "
     << this->CubeEdges[2] << "\n";
  os << indent << "SurfaceTexels: " << this->SurfaceTexels << "\n";
  os << indent << "GeometryTriangles: " << this->GeometryTriangles << "\n";
  os << indent << "GeometrySeconds: " << this->GeometrySeconds << "\n";
  os << indent << "ColorType: " << this->ColorType << "\n";
  os << indent << "GenerateDepth: " << this->GetGenerateDepth() << "\n";
  os << indent << "ChannelSelection:\n";
  this->ChannelSelection->PrintSelf(os, indent.GetNextIndent());
  os << indent << "SurfaceArraySelection:\n";
  this->SurfaceArraySelection->PrintSelf(os, indent.GetNextIndent());
}
