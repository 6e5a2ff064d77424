// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFSceneLook.h"

#include "PathTracing/Volumes/cslfVolumeReader.h"
#include "Pipeline/cslfGuard.h"

#include "Options/cslfOption.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfRequests.h"
#include "SceneImport/cslfAMRSurface.h"
#include "SceneLook/cslfNamedColorMaps.h"
#include "SceneLook/cslfSurfaceColoring.h"
#include "cslfDescription.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"

#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkUniformGridAMR.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstring>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkCSLFSceneLook);
cslfGuardedRequestMacro(vtkCSLFSceneLook);

namespace options = cslf::options;

namespace
{
/// Of the arrays in field data that path tracers read.
constexpr const char* Prefix = "CSLF:";

bool IsOurs(vtkAbstractArray* array)
{
  return array->GetName() && std::strncmp(array->GetName(), Prefix, std::strlen(Prefix)) == 0;
}

/// Whether the field data contains lights.
bool ContainsLights(vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  return fields->HasArray(vtkCSLFLight::DirectionalLightDirection()) ||
    fields->HasArray(vtkCSLFLight::PointLightPosition()) ||
    fields->HasArray(vtkCSLFLight::SpotLightPosition());
}

/// Copies inputs to blocks, of which the path tracers read the leaves only.
class InputCopier
{
public:
  std::vector<vtkSmartPointer<vtkPolyData>> Colorable; ///< the surfaces without finished colours
  bool HasLights = false;

  explicit InputCopier(vtkMultiBlockDataSet* output)
    : Output(output)
  {
  }

  void Copy(vtkDataObject* input)
  {
    auto* tree = vtkDataObjectTree::SafeDownCast(input);
    if (!tree)
    {
      this->Append(this->CopyLeaf(input));
      return;
    }
    // What the field data of the root says goes to the leaves, but lights must not go to several.
    vtkNew<vtkPolyData> root;
    root->GetFieldData()->ShallowCopy(tree->GetFieldData());
    vtkCSLFInstances::RemoveInstances(root);
    if (root->GetFieldData()->GetNumberOfArrays() > 0)
    {
      this->Append(this->CopyLeaf(root));
      vtkCSLFLight::RemoveLights(root);
    }
    auto copy = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    copy->CopyStructure(tree);
    auto leaf = vtk::TakeSmartPointer(tree->NewTreeIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      copy->SetDataSet(leaf, this->CopyLeaf(leaf->GetCurrentDataObject(), root->GetFieldData()));
    }
    this->Append(copy);
  }

private:
  void Append(vtkDataObject* block)
  {
    this->Output->SetBlock(this->Output->GetNumberOfBlocks(), block);
  }

  /// A shallow copy of polygonal data, or the surface of other data sets. Of what has no surface,
  /// the path tracers warn.
  vtkSmartPointer<vtkDataObject> CopyLeaf(vtkDataObject* data, vtkFieldData* inherited = nullptr)
  {
    if (data->GetFieldData()->GetAbstractArray(cslf::Description::FieldDataName))
    {
      throw cslf::LookError("The data is a light field, not a scene.");
    }
    if (cslf::IsVolume(data))
    {
      return data;
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    if (vtkPolyData::SafeDownCast(data))
    {
      surface->ShallowCopy(data);
    }
    else if (auto* grids = vtkUniformGridAMR::SafeDownCast(data))
    {
      surface = cslf::ExtractAMRSurface(grids);
    }
    else if (vtkDataSet::SafeDownCast(data))
    {
      vtkNew<vtkDataSetSurfaceFilter> filter;
      filter->SetInputDataObject(data);
      filter->Update();
      surface->ShallowCopy(filter->GetOutput());
      surface->GetFieldData()->ShallowCopy(data->GetFieldData());
    }
    else
    {
      return data;
    }
    for (int i = 0; inherited && i < inherited->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = inherited->GetAbstractArray(i);
      if (IsOurs(array) && !surface->GetFieldData()->HasArray(array->GetName()))
      {
        surface->GetFieldData()->AddArray(array);
      }
    }
    this->HasLights = this->HasLights || ContainsLights(surface);
    if (!vtkCSLFMaterial::GetFinishedColors(surface))
    {
      this->Colorable.push_back(surface);
    }
    return surface;
  }

  vtkMultiBlockDataSet* Output;
};

template <typename Row>
const char* FindName(const Row& row, int number)
{
  return number >= 0 && number <= row.Maximum ? row.Names[number] : nullptr;
}

/// The directions of a scene for someone who stands in front of it.
struct SceneAxes
{
  glm::dvec3 Right;
  glm::dvec3 Up;
  glm::dvec3 Front; // towards the viewer

  explicit SceneAxes(int upAxis)
    : Up(0.0)
  {
    const int axis = upAxis % 3;
    this->Up[axis] = upAxis < vtkCSLFSceneLook::MinusXAxis ? 1.0 : -1.0;
    this->Right = axis == 0 ? glm::dvec3(0.0, -this->Up.x, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    this->Front = glm::cross(this->Right, this->Up);
  }

  glm::dvec3 Get(const glm::dvec3& parts) const
  {
    return parts.x * this->Right + parts.y * this->Up + parts.z * this->Front;
  }
};

vtkSmartPointer<vtkPolyData> MakeSun(const SceneAxes& axes)
{
  const glm::dvec3 direction = -axes.Get({ -0.5, 0.75, 0.6 });
  const double towards[3] = { direction.x, direction.y, direction.z };
  const double irradiance = 0.75 * vtkMath::Pi();
  const double white[3] = { irradiance, irradiance, irradiance };
  auto sun = vtkSmartPointer<vtkPolyData>::New();
  vtkCSLFLight::AddDirectionalLight(sun, towards, white);
  return sun;
}
}

vtkCSLFSceneLook::vtkCSLFSceneLook()
  : ColorMap(options::ColorMap.Default)
  , Light(options::Light.Default)
  , UpAxis(options::UpAxis.Default)
{
  static_assert(options::ColorMap.Names.size() == NUMBER_OF_COLOR_MAPS);
  static_assert(options::Light.Names.size() == NUMBER_OF_LIGHTS);
  static_assert(options::UpAxis.Names.size() == NUMBER_OF_AXES);
  cslf::ClearLegend(this->Legend);
}

vtkCSLFSceneLook::~vtkCSLFSceneLook() = default;

cslfSetOptionMacro(vtkCSLFSceneLook, ColorMap, ColorMap);
cslfSetOptionMacro(vtkCSLFSceneLook, Light, Light);
cslfSetOptionMacro(vtkCSLFSceneLook, UpAxis, UpAxis);

void vtkCSLFSceneLook::SetGrowColorRange(bool grow)
{
  if (this->GrowColorRange != grow)
  {
    this->GrowColorRange = grow;
    this->GrownRanges.clear();
    this->Modified();
  }
}

const char* vtkCSLFSceneLook::GetColorMapName(int map)
{
  return FindName(options::ColorMap, map);
}

void vtkCSLFSceneLook::SetUpLookupTable(int map, vtkLookupTable* table)
{
  if (table && GetColorMapName(map))
  {
    cslf::SetUpLookupTable(map, table);
  }
}

const char* vtkCSLFSceneLook::GetLightName(int light)
{
  return FindName(options::Light, light);
}

const char* vtkCSLFSceneLook::GetUpAxisName(int axis)
{
  return FindName(options::UpAxis, axis);
}

void vtkCSLFSceneLook::GetAxes(double right[3], double up[3], double front[3])
{
  const SceneAxes axes(this->UpAxis);
  for (int i = 0; i < 3; ++i)
  {
    right[i] = axes.Right[i];
    up[i] = axes.Up[i];
    front[i] = axes.Front[i];
  }
}

void vtkCSLFSceneLook::SetUpEnvironment(vtkCSLFEnvironment* environment)
{
  if (!environment)
  {
    return;
  }
  bool isFill = false;
  if (this->Light == AutomaticLight)
  {
    cslf::UpdateWhole(this->GetOutputPort());
    isFill = this->HasLights;
  }
  const SceneAxes axes(this->UpAxis);
  glm::dvec3 up = axes.Up;
  double top = 1.0;
  double bottom = 0.2;
  if (isFill)
  {
    top = 0.5;
    bottom = 0.3;
  }
  else if (this->Light == AutomaticLight || this->Light == StudioLight)
  {
    // The bright side is above, on the left and a little in front, so that the three sides of a box
    // that a view shows differ.
    up = axes.Get({ -0.55, 0.75, 0.4 });
    bottom = 0.15;
  }
  else if (this->Light == SunLight)
  {
    top = 0.65;
    bottom = 0.35;
  }
  environment->SetMode(this->Light == NoLight ? vtkCSLFEnvironment::NoEnvironment
      : this->Light == WhiteLight             ? vtkCSLFEnvironment::ConstantEnvironment
                                              : vtkCSLFEnvironment::GradientEnvironment);
  environment->SetFileName(nullptr);
  environment->SetColor(top, top, top);
  environment->SetBottomColor(bottom, bottom, bottom);
  environment->SetUp(up.x, up.y, up.z);
}

vtkTable* vtkCSLFSceneLook::GetLegend()
{
  return this->Legend;
}

int vtkCSLFSceneLook::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* type : { "vtkDataSet", "vtkDataObjectTree", "vtkUniformGridAMR" })
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  }
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkCSLFSceneLook::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  cslf::ClearLegend(this->Legend);
  this->HasLights = false;
  // The executive has passed the field data of the first input, which is not to hold for the
  // others.
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  for (int i = output->GetFieldData()->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (IsOurs(output->GetFieldData()->GetAbstractArray(i)))
    {
      output->GetFieldData()->RemoveArray(i);
    }
  }
  try
  {
    InputCopier copier(output);
    for (int i = 0; i < inputVector[0]->GetNumberOfInformationObjects(); ++i)
    {
      copier.Copy(vtkDataObject::GetData(inputVector[0], i));
    }
    cslf::SurfaceColoring coloring;
    coloring.Surfaces = std::move(copier.Colorable);
    coloring.ArrayName = this->ColorArrayName;
    coloring.ComponentName = this->ColorComponent;
    coloring.ColorMap = this->ColorMap;
    coloring.Range = this->AutomaticColorRange ? nullptr : this->ColorRange;
    coloring.GrowingRanges = this->GrowColorRange ? &this->GrownRanges : nullptr;
    coloring.Apply(this->Legend);
    this->HasLights = copier.HasLights;
  }
  catch (const cslf::LookError& problem)
  {
    vtkErrorMacro(<< problem.what());
    output->Initialize();
    return 0;
  }
  if (this->Light == SunLight)
  {
    const unsigned int last = output->GetNumberOfBlocks();
    output->SetBlock(last, MakeSun(SceneAxes(this->UpAxis)));
    output->GetMetaData(last)->Set(vtkCompositeDataSet::NAME(), "Lights");
  }
  return 1;
}

void vtkCSLFSceneLook::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColorArrayName: " << this->ColorArrayName << "\n";
  os << indent << "ColorComponent: " << this->ColorComponent << "\n";
  os << indent << "ColorMap: " << GetColorMapName(this->ColorMap) << "\n";
  os << indent << "AutomaticColorRange: " << this->AutomaticColorRange << "\n";
  os << indent << "GrowColorRange: " << this->GrowColorRange << "\n";
  os << indent << "ColorRange: " << this->ColorRange[0] << ", " << this->ColorRange[1] << "\n";
  os << indent << "Light: " << GetLightName(this->Light) << "\n";
  os << indent << "UpAxis: " << GetUpAxisName(this->UpAxis) << "\n";
  os << indent << "HasLights: " << this->HasLights << "\n";
  os << indent << "Legend: " << this->Legend->GetNumberOfRows() << " rows\n";
}
