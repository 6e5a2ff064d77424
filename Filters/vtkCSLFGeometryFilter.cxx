// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFGeometryFilter.h"

#include "Geometry/cslfDepthMesher.h"
#include "Geometry/cslfDepthViews.h"
#include "Geometry/cslfGeometryData.h"
#include "Geometry/cslfPointColors.h"
#include "Geometry/cslfReduction.h"
#include "Geometry/cslfSideColors.h"
#include "Geometry/cslfViewpointChoice.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfDescription.h"
#include "cslfJSON.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkCSLFGeometryFilter);
cslfSetOptionMacro(vtkCSLFGeometryFilter, GeometryTriangles, GeometryTriangles);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// The most viewpoints along a side of a face, if they are nested.
constexpr int ViewpointLimit = 9;

/// The most texels along a side of a tile, and of all viewpoints.
constexpr int ResolutionLimit = 256;
constexpr double MaximumStoredTexels = 256.0 * 1024 * 1024;

/// The number of places where the error is measured.
constexpr std::size_t MeasuredPoints = 20000;

///@{
/// The progress when depths are read and when the mesh is made; and the share of the latter before
/// the mesh is reduced.
constexpr double ReadProgress = 0.15;
constexpr double MeshProgress = 0.85;
constexpr double MeshedShare = 0.7;
///@}

/// The share of choosing viewpoints in colouring.
constexpr double ChosenShare = 0.5;

/// The number of texels along a side of a tile at which depths are kept.
int ChooseResolution(const cslf::Layout& grid, std::size_t views)
{
  const double fitting =
    std::sqrt(MaximumStoredTexels / (cslf::TileCount * std::max(1.0, double(views))));
  return std::max(
    1, std::min({ grid.GetResolution(), ResolutionLimit, static_cast<int>(fitting) }));
}

/// The hash of a field's scene, if the sampler has recorded it.
std::string GetScene(const cslf::Description& field)
{
  const nlohmann::json sampling = nlohmann::json::parse(field.Sampling, nullptr, false);
  const auto scene = sampling.is_object() ? sampling.find("scene") : sampling.end();
  return scene != sampling.end() && scene->is_string() ? scene->get<std::string>() : "";
}
}

/// Makes a geometry.
class vtkCSLFGeometryFilter::Pass
{
public:
  explicit Pass(vtkCSLFGeometryFilter* self)
    : Self(self)
    , Input(self->GetInputConnection(0, 0))
  {
  }

  /// Null after an error, which it reports, and if the filter was asked to stop.
  vtkSmartPointer<vtkPolyData> Run()
  try
  {
    if (!this->ReadDepths())
    {
      return nullptr;
    }
    cslf::SurfaceMesh mesh;
    const cslf::SurfaceError error = this->MakeMesh(mesh);
    const glm::dvec3& edges = this->Field.Box.Edges;
    const double half = 0.5 * std::max({ edges.x, edges.y, edges.z });
    vtkSmartPointer<vtkPolyData> geometry = cslf::MakeGeometryData(mesh, this->Field.Box.Center,
      glm::dvec3(half), { half * error.RootMeanSquare, error.Loss, GetScene(this->Field) });
    const cslf::Channel* color = this->Field.FindChannel(cslf::KnownChannel::Color);
    if (color && !this->ReadColors(mesh, color->Type, geometry))
    {
      return nullptr;
    }
    const std::string loss = cslf::DescribeGeometryLoss(geometry, this->Self->GeometryTriangles);
    if (!loss.empty())
    {
      vtkWarningWithObjectMacro(this->Self, << loss);
    }
    return geometry;
  }
  catch (const cslf::Aborted&)
  {
    return nullptr;
  }

private:
  cslf::SurfaceError MakeMesh(cslf::SurfaceMesh& mesh) const
  {
    cslf::Phase phase(this->Self, "Making the geometry", MeshProgress);
    const auto report = [&phase](double share) { return phase.Report(share); };
    mesh = cslf::MeshDepths(*this->Views, cslf::Within(report, 0.0, MeshedShare));
    const cslf::SurfaceError error =
      cslf::ReduceWell(mesh, static_cast<std::size_t>(this->Self->GeometryTriangles),
        cslf::SpreadPoints(*this->Views, MeasuredPoints), this->Views->GetTexel(),
        cslf::Within(report, MeshedShare, 1.0));
    // Stretched parts may reach beyond the cube.
    const glm::vec3 most(this->Views->GetScale());
    for (glm::vec3& point : mesh.Points)
    {
      point = glm::clamp(point, -most, most);
    }
    cslf::ChangeApart(mesh, cslf::Within(report, 1.0, 1.0), cslf::SortForDrawing);
    return error;
  }

  /// Visits viewpoints slab by slab. False after an error and if the filter was asked to stop.
  bool Visit(const std::vector<int>& slices, cslf::Phase& phase,
    const std::function<void(int slice, const cslf::ViewpointSamples&, bool isMissing)>& visit)
  {
    const double before = phase.GetShare();
    double done = 0.0;
    double next = 0.0;
    const cslf::PipelineWatch watch(this->Self->GetInputConnection(0, 0),
      [&](vtkAlgorithm* producer)
      {
        const double share = done + (next - done) * producer->GetProgress();
        return phase.ReportFor(producer, share);
      });
    const auto bytes =
      static_cast<double>(this->Field.GetTexelBytes() * this->Field.Grid.GetStripTexels());
    const auto most = static_cast<std::size_t>(std::max(1.0, cslf::PulledBytes / bytes));
    for (std::size_t begin = 0; begin < slices.size();)
    {
      std::size_t end = begin + 1;
      while (end < slices.size() && end - begin < most && slices[end] == slices[end - 1] + 1)
      {
        ++end;
      }
      const double each = (1.0 - before) / static_cast<double>(slices.size());
      done = before + each * static_cast<double>(begin);
      next = before + each * static_cast<double>(end);
      if (!this->Read({ slices[begin], slices[end - 1] }))
      {
        return false;
      }
      vtkImageData* image = this->Input.GetImage();
      const std::vector<int> missing = cslf::GetMissing(image, this->Field.Grid.GetSlices());
      const cslf::ViewpointSamples samples(image);
      for (; begin < end; ++begin)
      {
        const int slice = slices[begin];
        const auto start = static_cast<vtkIdType>(this->Field.Grid.GetStripTexels()) *
          (slice - image->GetExtent()[4]);
        visit(slice, samples.At(start), std::binary_search(missing.begin(), missing.end(), slice));
      }
      if (!phase.Report(next))
      {
        return false;
      }
    }
    return true;
  }

  /// False after an error, which it reports, and if the filter was asked to stop.
  bool Read(const cslf::Slab& slab)
  {
    const bool isRead = this->Input.Read(slab);
    if (cslf::IsAborted(this->Self))
    {
      return false;
    }
    this->Field = this->Input.GetDescription();
    const bool hasDepth = isRead && this->Field.FindChannel(cslf::KnownChannel::Depth);
    if (!hasDepth)
    {
      vtkErrorWithObjectMacro(
        this->Self, << (isRead ? "The light field has no depth, which the geometry is made from."
                               : this->Input.GetError()));
    }
    return hasDepth;
  }

  bool ReadDepths()
  {
    if (!this->Input.OpenUpdated())
    {
      vtkErrorWithObjectMacro(this->Self, << this->Input.GetError());
      return false;
    }
    const cslf::Slab& whole = this->Input.GetWhole();
    if (!this->Read({ whole.First, whole.First }))
    {
      return false;
    }
    std::vector<int> slices = cslf::ChooseSlices(this->Field.Grid, ViewpointLimit);
    slices.erase(std::remove_if(slices.begin(), slices.end(),
                   [&whole](int slice) { return slice < whole.First || slice > whole.Last; }),
      slices.end());
    const cslf::Layout& grid = this->Field.Grid;
    this->Views.emplace(
      cslf::Layout(grid.GetBaseNodes(), grid.GetNodes(), ChooseResolution(grid, slices.size())),
      this->Field.Box);
    cslf::Phase phase(this->Self, "Reading depths", ReadProgress);
    return this->Visit(slices, phase,
      [&](int slice, const cslf::ViewpointSamples& samples, bool isMissing)
      {
        if (!isMissing)
        {
          this->Views->Add(slice, grid.GetResolution(), samples);
        }
      });
  }

  bool ReadColors(const cslf::SurfaceMesh& mesh, int type, vtkPolyData* geometry)
  {
    cslf::Phase phase(this->Self, "Colouring the geometry");
    const auto report = [&phase](double share) { return phase.Report(ChosenShare * share); };
    cslf::PointColors colors(*this->Views, mesh, report);
    std::vector<int> slices;
    std::vector<int> views;
    for (int view = 0; view < this->Views->GetCount(); ++view)
    {
      if (colors.IsNeeded(view))
      {
        slices.push_back(this->Views->GetSlice(view));
        views.push_back(view);
      }
    }
    const bool isDone = this->Visit(slices, phase,
      [&](int slice, const cslf::ViewpointSamples& samples, bool)
      {
        const auto place = std::lower_bound(slices.begin(), slices.end(), slice) - slices.begin();
        colors.Read(views[place], this->Field.Grid.GetResolution(), samples);
      });
    if (isDone)
    {
      cslf::AddSideColors(mesh, colors.Get(), type, geometry);
    }
    return isDone;
  }

  vtkCSLFGeometryFilter* Self;
  cslf::FieldStream Input;
  cslf::Description Field;
  std::optional<cslf::DepthViews> Views;
};

vtkCSLFGeometryFilter::vtkCSLFGeometryFilter()
  : GeometryTriangles(cslf::options::GeometryTriangles.Default)
{
  this->SetNumberOfOutputPorts(2);
}

// Here, because users of the header need not know polygonal data.
vtkCSLFGeometryFilter::~vtkCSLFGeometryFilter() = default;

vtkPolyData* vtkCSLFGeometryFilter::GetGeometry()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkCSLFGeometryFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

vtkTypeBool vtkCSLFGeometryFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    // The input may deliver more than was requested.
    vtkInformation* input = inputVector[0]->GetInformationObject(0);
    vtkImageData* image = vtkImageData::GetData(input);
    const int* whole = input->Get(Pipeline::WHOLE_EXTENT());
    cslf::ChoosePorts(
      request, outputVector, image && whole && std::equal(whole, whole + 6, image->GetExtent()));
    return 1;
  }
  return cslf::GuardRequest(this, request, outputVector,
    [&] { return this->Superclass::ProcessRequest(request, inputVector, outputVector); });
}

int vtkCSLFGeometryFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  inputVector[0]->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT(), extent);
  cslf::SetFieldInformation(outputVector->GetInformationObject(0), extent);
  return 1;
}

int vtkCSLFGeometryFilter::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  int extent[6];
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  input->Get(Pipeline::WHOLE_EXTENT(), extent);
  if (request->Get(vtkExecutive::FROM_OUTPUT_PORT()) == 1)
  {
    // The geometry requests its slices itself, after the first one.
    extent[5] = extent[4];
    cslf::RequestFirstPart(input, extent);
    return 1;
  }
  outputVector->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT(), extent);
  input->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  return 1;
}

int vtkCSLFGeometryFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const cslf::KeptRequests requests(this->GetInputConnection(0, 0));
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  if (cslf::IsPortWanted(outputVector, 0))
  {
    vtkImageData::GetData(outputVector, 0)->ShallowCopy(vtkImageData::GetData(input));
  }
  if (!cslf::IsPortWanted(outputVector, 1))
  {
    return 1;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 1);
  output->Initialize();
  if (this->GeometryTriangles == 0)
  {
    return 1;
  }
  const vtkMTimeType time =
    vtkDemandDrivenPipeline::SafeDownCast(this->GetExecutive())->GetPipelineMTime();
  if (!this->Geometry || this->GeometryTime != time)
  {
    std::string problem;
    this->Geometry = nullptr;
    cslf::Guard(
      [&]
      {
        this->Geometry = Pass(this).Run();
        return true;
      },
      problem);
    if (!problem.empty())
    {
      vtkErrorMacro("Cannot make a geometry: " << problem << ".");
    }
    this->GeometryTime = time;
  }
  if (!this->Geometry)
  {
    cslf::SetNotMade(outputVector, 1);
    // The field can be used without it.
    return cslf::IsAborted(this) || cslf::IsPortWanted(outputVector, 0) ? 1 : 0;
  }
  output->ShallowCopy(this->Geometry);
  return 1;
}

void vtkCSLFGeometryFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GeometryTriangles: " << this->GeometryTriangles << "\n";
}
