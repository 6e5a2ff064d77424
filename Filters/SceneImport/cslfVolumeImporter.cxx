// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVolumeImporter.h"

#include "vtkCSLFVolume.h"

#include <vtkAbstractMapper.h>
#include <vtkAbstractVolumeMapper.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkResampleToImage.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeMapper.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
namespace
{
/// The points of a resampled grid along its longest edge, at most, and for each cell along an edge.
constexpr int MaximumSide = 256;
constexpr double PointsPerCell = 2.0;

void ForEachInput(vtkAbstractVolumeMapper* mapper, const std::function<void(vtkDataObject*)>& visit)
{
  for (int i = 0; i < mapper->GetNumberOfInputConnections(0); ++i)
  {
    mapper->GetInputAlgorithm(0, i)->Update();
    if (vtkDataObject* data = mapper->GetInputDataObject(0, i))
    {
      visit(data);
    }
  }
}

/// The data sets that a data object consists of.
std::vector<vtkDataSet*> FindLeaves(vtkDataObject* data)
{
  std::vector<vtkDataSet*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      leaves.push_back(vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()));
    }
  }
  else
  {
    leaves.push_back(vtkDataSet::SafeDownCast(data));
  }
  leaves.erase(std::remove(leaves.begin(), leaves.end(), nullptr), leaves.end());
  return leaves;
}

/// The data set with only the scalars that a mapper shows, as active ones. Null if it shows none.
vtkSmartPointer<vtkDataSet> KeepScalars(vtkDataSet* data, vtkAbstractVolumeMapper* mapper)
{
  int association = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(data, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), association);
  if (!scalars || association > 1)
  {
    return nullptr;
  }
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->CopyStructure(data);
  vtkDataSetAttributes* kept = copy->GetAttributes(association);
  kept->SetScalars(scalars);
  for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataSetAttributes* from = data->GetAttributes(type);
    if (vtkDataArray* ghosts = from->GetArray(vtkDataSetAttributes::GhostArrayName()))
    {
      copy->GetAttributes(type)->AddArray(ghosts);
    }
  }
  return copy;
}

/// An image of other grids. Points outside of all cells are hidden.
vtkSmartPointer<vtkDataSet> Resample(vtkDataSet* data)
{
  double bounds[6];
  data->GetBounds(bounds);
  double edges[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    edges[axis] = bounds[2 * axis + 1] - bounds[2 * axis];
  }
  const double longest = std::max({ edges[0], edges[1], edges[2] });
  const double content = edges[0] * edges[1] * edges[2];
  if (!(content > 0.0))
  {
    return nullptr;
  }
  const double cell = std::cbrt(content / static_cast<double>(data->GetNumberOfCells()));
  const double spacing = std::max(cell / PointsPerCell, longest / (MaximumSide - 1));
  int size[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = std::max(2, static_cast<int>(std::lround(edges[axis] / spacing)) + 1);
  }
  const char* name = nullptr;
  for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
  {
    vtkDataArray* scalars = data->GetAttributes(type)->GetScalars();
    name = !name && scalars ? scalars->GetName() : name;
  }
  vtkNew<vtkResampleToImage> resample;
  resample->SetInputDataObject(data);
  resample->SetSamplingDimensions(size);
  resample->Update();
  vtkSmartPointer<vtkImageData> image = resample->GetOutput();
  if (name)
  {
    image->GetPointData()->SetActiveScalars(name);
  }
  return image;
}

/// Records what the tracer shows differently.
void FindLimits(vtkAbstractVolumeMapper* mapper, vtkVolumeProperty* property, ImportedScene& scene)
{
  auto* gpu = vtkGPUVolumeRayCastMapper::SafeDownCast(mapper);
  if ((gpu && gpu->GetMaskInput()) || !property->GetLabelMapLabels().empty())
  {
    scene.Meet(ImportLimit::VolumeMasks);
  }
  auto* regular = vtkVolumeMapper::SafeDownCast(mapper);
  if (regular && regular->GetCropping() && regular->GetCroppingRegionFlags() != VTK_CROP_SUBVOLUME)
  {
    scene.Meet(ImportLimit::VolumeCropping);
  }
}

/// Whether opacities depend on the gradient. Properties have a function, which is 1 by default.
bool HasGradientOpacity(vtkVolumeProperty* property, int component)
{
  if (property->GetDisableGradientOpacity(component))
  {
    return false;
  }
  vtkPiecewiseFunction* function = property->GetGradientOpacity(component);
  return std::string(function->GetType()) != "Constant" || function->GetValue(0.0) != 1.0;
}

void FindLimits(vtkVolumeProperty* property, int component, ImportedScene& scene)
{
  if (HasGradientOpacity(property, component) ||
    property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D)
  {
    scene.Meet(ImportLimit::VolumeGradients);
  }
  if (property->GetShade(component))
  {
    scene.Meet(ImportLimit::VolumeShading);
  }
}

/// Cuts the volume as its mapper does.
void AddPlanes(vtkAbstractVolumeMapper* mapper, vtkMatrix4x4* matrix, vtkDataSet* data)
{
  vtkPlaneCollection* planes = mapper->GetClippingPlanes();
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    vtkPlane* plane = planes->GetItem(i);
    vtkCSLFVolume::AddPlane(data, plane->GetOrigin(), plane->GetNormal());
  }
  auto* regular = vtkVolumeMapper::SafeDownCast(mapper);
  if (!regular || !regular->GetCropping() ||
    regular->GetCroppingRegionFlags() != VTK_CROP_SUBVOLUME)
  {
    return;
  }
  vtkNew<vtkMatrix4x4> toData;
  toData->DeepCopy(matrix);
  toData->Invert();
  toData->Transpose(); // of normals, to the world
  double region[6];
  regular->GetCroppingRegionPlanes(region);
  for (int side = 0; side < 6; ++side)
  {
    double normal[4] = { 0.0, 0.0, 0.0, 0.0 };
    normal[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
    double origin[4] = { 0.0, 0.0, 0.0, 1.0 };
    origin[side / 2] = region[side];
    toData->MultiplyPoint(normal, normal);
    matrix->MultiplyPoint(origin, origin);
    vtkCSLFVolume::AddPlane(data, origin, normal);
  }
}

void AddPlaced(const double bounds[6], vtkMatrix4x4* matrix, vtkBoundingBox& box)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
      bounds[4 + (corner >> 2 & 1)], 1.0 };
    matrix->MultiplyPoint(point, point);
    box.AddPoint(point);
  }
}

/// Adds a volume for each of the components that its mapper shows.
void ImportGrid(vtkDataSet* grid, vtkVolume* volume, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  auto* mapper = volume->GetMapper();
  vtkVolumeProperty* property = volume->GetProperty();
  vtkSmartPointer<vtkDataSet> data = KeepScalars(grid, mapper);
  if (data && !data->IsA("vtkImageData") && !data->IsA("vtkRectilinearGrid"))
  {
    scene.Meet(ImportLimit::ResampledVolumes, data->GetClassName());
    data = Resample(data);
  }
  vtkDataArray* scalars = data ? data->GetPointData()->GetScalars() : nullptr;
  scalars = data && !scalars ? data->GetCellData()->GetScalars() : scalars;
  if (!scalars)
  {
    scene.Omitted.insert("volumes without scalars");
    return;
  }
  const int components = scalars->GetNumberOfComponents();
  if (components > 1 && (!property->GetIndependentComponents() || components > VTK_MAX_VRCOMP))
  {
    scene.Meet(ImportLimit::DependentComponents);
    return;
  }
  if (components > 1)
  {
    scene.Meet(ImportLimit::IndependentComponents);
  }
  for (int component = 0; component < components; ++component)
  {
    auto part = vtk::TakeSmartPointer(data->NewInstance());
    part->ShallowCopy(data);
    if (!vtkCSLFVolume::SetFromProperty(part, property, component))
    {
      scene.Omitted.insert("volumes whose scalars are not finite");
      continue;
    }
    FindLimits(property, component, scene);
    if (!matrix->IsIdentity())
    {
      vtkCSLFVolume::SetMatrix(part, matrix);
    }
    AddPlanes(mapper, matrix, part);
    scene.Volumes.emplace_back(part);
    AddPlaced(part->GetBounds(), matrix, scene.VolumeBounds);
  }
}
}

bool IsImportable(vtkVolume* volume)
{
  return volume->GetMapper() && volume->GetMapper()->GetNumberOfInputConnections(0) > 0 &&
    !volume->IsA("vtkMultiVolume");
}

vtkMTimeType GetImportTime(vtkVolume* volume)
{
  vtkAbstractVolumeMapper* mapper = volume->GetMapper();
  vtkMTimeType time =
    std::max({ volume->GetMTime(), mapper->GetMTime(), volume->GetProperty()->GetMTime() });
  ForEachInput(mapper,
    [&time](vtkDataObject* data)
    {
      time = std::max(time, data->GetMTime());
      for (vtkDataSet* leaf : FindLeaves(data))
      {
        time = std::max(time, leaf->GetMTime());
      }
    });
  vtkPlaneCollection* planes = mapper->GetClippingPlanes();
  for (int i = 0; planes && i < planes->GetNumberOfItems(); ++i)
  {
    time = std::max(time, planes->GetItem(i)->GetMTime());
  }
  return time;
}

void ImportVolume(vtkVolume* volume, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  vtkAbstractVolumeMapper* mapper = volume->GetMapper();
  auto* regular = vtkVolumeMapper::SafeDownCast(mapper);
  if (regular && regular->GetBlendMode() != vtkVolumeMapper::COMPOSITE_BLEND)
  {
    scene.Meet(ImportLimit::VolumeBlending);
    return;
  }
  FindLimits(mapper, volume->GetProperty(), scene);
  vtkNew<vtkMatrix4x4> place;
  if (matrix)
  {
    place->DeepCopy(matrix);
  }
  ForEachInput(mapper,
    [&](vtkDataObject* data)
    {
      for (vtkDataSet* leaf : FindLeaves(data))
      {
        ImportGrid(leaf, volume, place, scene);
      }
    });
}
}
