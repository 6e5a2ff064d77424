// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGlyphImporter.h"

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfCellKinds.h"
#include "cslfMappedScalars.h"
#include "vtkCSLFInstances.h"

#include <vtkActor.h>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkGlyph3DMapper.h>
#include <vtkInformation.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// The array of points that the mapper reads for a purpose, or null.
vtkDataArray* FindArray(
  vtkGlyph3DMapper* mapper, int purpose, vtkDataSet* data, ImportedScene& scene)
{
  vtkInformation* info = mapper->GetInputArrayInformation(purpose);
  vtkDataArray* array = nullptr;
  if (const char* name = info->Get(vtkDataObject::FIELD_NAME()))
  {
    array = data->GetPointData()->GetArray(name);
  }
  else if (info->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    array = data->GetPointData()->GetAttribute(info->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
  }
  if (array && array->GetNumberOfTuples() < data->GetNumberOfPoints())
  {
    ValidPolyData sound;
    sound.RemovedArrays.insert(array->GetName() ? array->GetName() : "(without a name)");
    sound.AddRemoved(scene.Omitted);
    return nullptr;
  }
  return array;
}

/// The length of an array's tuple.
double GetNorm(vtkDataArray* array, vtkIdType tuple)
{
  double sum = 0.0;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    sum += array->GetComponent(tuple, i) * array->GetComponent(tuple, i);
  }
  return std::sqrt(sum);
}

/// Rotates the x axis to a direction, by half a turn around the middle between the two, like the
/// mapper.
void TurnToDirection(const double direction[3], vtkTransform* transform)
{
  const double length = vtkMath::Norm(direction);
  if (length == 0.0)
  {
    return;
  }
  if (direction[1] == 0.0 && direction[2] == 0.0)
  {
    transform->RotateY(direction[0] < 0.0 ? 180.0 : 0.0);
    return;
  }
  transform->RotateWXYZ(
    180.0, 0.5 * (direction[0] + length), 0.5 * direction[1], 0.5 * direction[2]);
}

/// A quaternion w, x, y, z as a rotation.
void TurnByQuaternion(const double quaternion[4], vtkTransform* transform)
{
  const double sine = vtkMath::Norm(quaternion + 1);
  if (sine != 0.0)
  {
    const double angle = vtkMath::DegreesFromRadians(2.0 * std::atan2(sine, quaternion[0]));
    transform->RotateWXYZ(angle, quaternion[1], quaternion[2], quaternion[3]);
  }
}

/// The mapper's transform of the glyph of each point of a data set.
class GlyphPlacer
{
public:
  GlyphPlacer(vtkGlyph3DMapper* mapper, vtkDataSet* data, ImportedScene& scene)
    : Mapper(mapper)
    , Data(data)
    , Scales(mapper->GetScaleMode() == vtkGlyph3DMapper::NO_DATA_SCALING
          ? nullptr
          : FindArray(mapper, vtkGlyph3DMapper::SCALE, data, scene))
    , Orientations(mapper->GetOrient()
          ? FindArray(mapper, vtkGlyph3DMapper::ORIENTATION, data, scene)
          : nullptr)
    , Masks(vtkArrayDownCast<vtkBitArray>(
        mapper->GetMasking() ? FindArray(mapper, vtkGlyph3DMapper::MASK, data, scene) : nullptr))
    , Sources(mapper->GetSourceIndexing()
          ? FindArray(mapper, vtkGlyph3DMapper::SOURCE_INDEX, data, scene)
          : nullptr)
  {
  }

  bool IsShown(vtkIdType point) const { return !this->Masks || this->Masks->GetValue(point) != 0; }

  /// The source that a point shows; -1 if its index is NaN.
  int GetSource(vtkIdType point, int count) const
  {
    const double index = this->Sources ? GetNorm(this->Sources, point) : 0.0;
    return std::isnan(index)
      ? -1
      : static_cast<int>(std::clamp(index, 0.0, static_cast<double>(count - 1)));
  }

  /// The instance after the actor's matrix. Returns whether it is finite.
  bool Place(vtkIdType point, vtkTransform* transform) const
  {
    double position[3];
    this->Data->GetPoint(point, position);
    transform->Translate(position);
    this->Orient(point, transform);
    if (this->Mapper->GetScaling())
    {
      double scale[3];
      this->GetScale(point, scale);
      transform->Scale(scale);
    }
    const double* matrix = transform->GetMatrix()->GetData();
    return std::all_of(matrix, matrix + 16, [](double value) { return std::isfinite(value); });
  }

private:
  void Orient(vtkIdType point, vtkTransform* transform) const
  {
    const int mode = this->Mapper->GetOrientationMode();
    const int components = mode == vtkGlyph3DMapper::QUATERNION ? 4 : 3;
    if (!this->Orientations || this->Orientations->GetNumberOfComponents() != components)
    {
      return;
    }
    double orientation[4];
    this->Orientations->GetTuple(point, orientation);
    switch (mode)
    {
      case vtkGlyph3DMapper::ROTATION:
        transform->RotateZ(orientation[2]);
        transform->RotateX(orientation[0]);
        transform->RotateY(orientation[1]);
        break;
      case vtkGlyph3DMapper::QUATERNION:
        TurnByQuaternion(orientation, transform);
        break;
      default:
        TurnToDirection(orientation, transform);
    }
  }

  void GetScale(vtkIdType point, double scale[3]) const
  {
    std::fill_n(scale, 3, 1.0);
    if (this->Scales)
    {
      const bool each = this->Mapper->GetScaleMode() == vtkGlyph3DMapper::SCALE_BY_COMPONENTS &&
        this->Scales->GetNumberOfComponents() == 3;
      for (int i = 0; i < 3; ++i)
      {
        scale[i] = this->ClampScale(
          each ? this->Scales->GetComponent(point, i) : GetNorm(this->Scales, point));
      }
    }
    vtkMath::MultiplyScalar(scale, this->Mapper->GetScaleFactor());
  }

  double ClampScale(double value) const
  {
    if (!this->Mapper->GetClamping())
    {
      return value;
    }
    const double* range = this->Mapper->GetRange();
    const double width = range[1] - range[0];
    return (std::clamp(value, range[0], std::max(range[0], range[1])) - range[0]) /
      (width == 0.0 ? 1.0 : width);
  }

  vtkGlyph3DMapper* Mapper;
  vtkDataSet* Data;
  vtkDataArray* Scales;
  vtkDataArray* Orientations;
  vtkBitArray* Masks; // the mapper supports no others
  vtkDataArray* Sources;
};

/// The source's geometry, without its scalars, which the mapper does not show.
vtkSmartPointer<vtkPolyData> CopySource(vtkPolyData* source, ImportedScene& scene)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  if (source)
  {
    const ValidPolyData sound = MakeSound(source);
    sound.AddRemoved(scene.Omitted);
    copy->CopyStructure(sound.Data);
    copy->GetPointData()->SetNormals(sound.Data->GetPointData()->GetNormals());
    copy->GetCellData()->SetNormals(sound.Data->GetCellData()->GetNormals());
    copy->GetPointData()->SetTCoords(sound.Data->GetPointData()->GetTCoords());
    CopyEdgeFlags(sound.Data, copy);
  }
  return copy;
}

/// Adds the scalar of an instance, and the map that all have.
void AddScalar(double scalar, const ColorMap& map, vtkPolyData* source)
{
  vtkFieldData* fields = source->GetFieldData();
  auto* scalars =
    vtkDoubleArray::SafeDownCast(fields->GetArray(vtkCSLFInstances::InstanceScalar()));
  if (!scalars)
  {
    vtkNew<vtkDoubleArray> made;
    made->SetName(vtkCSLFInstances::InstanceScalar());
    fields->AddArray(made);
    AddColorMaps({ map }, source);
    scalars = made;
  }
  scalars->InsertNextValue(scalar);
}

void AddPoints(vtkDataSet* data, vtkGlyph3DMapper* mapper, vtkMatrix4x4* matrix,
  std::vector<vtkSmartPointer<vtkPolyData>>& sources, ImportedScene& scene)
{
  const GlyphPlacer placer(mapper, data, scene);
  const MappedScalars mapped = MapScalars(mapper, data, false, scene);
  vtkUnsignedCharArray* colors = mapped.OfCells ? nullptr : mapped.Colors.Get();
  vtkNew<vtkTransform> transform;
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    if (!placer.IsShown(point))
    {
      continue;
    }
    transform->SetMatrix(matrix);
    const int index = placer.GetSource(point, static_cast<int>(sources.size()));
    if (!placer.Place(point, transform) || index < 0)
    {
      ++scene.BrokenGlyphs;
      continue;
    }
    vtkPolyData* source = sources[index];
    if (!colors)
    {
      vtkCSLFInstances::AddInstance(source, transform->GetMatrix());
      continue;
    }
    double color[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int i = 0; i < std::min(colors->GetNumberOfComponents(), 4); ++i)
    {
      color[i] = colors->GetTypedComponent(point, i) / 255.0;
    }
    vtkCSLFInstances::AddInstance(source, transform->GetMatrix(), color);
    if (mapped.Scalars)
    {
      AddScalar(mapped.Scalars->GetValue(point), mapped.ColorsOfScalars, source);
    }
  }
}
}

std::vector<vtkSmartPointer<vtkPolyData>> ImportGlyphs(
  vtkActor* actor, vtkGlyph3DMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  std::vector<vtkSmartPointer<vtkPolyData>> sources;
  if (mapper->GetUseSourceTableTree())
  {
    scene.Meet(ImportLimit::SourceTableTrees);
    return sources;
  }
  const int count = mapper->GetNumberOfInputConnections(1);
  for (int i = 0; i < count; ++i)
  {
    sources.push_back(CopySource(mapper->GetSource(i), scene));
  }
  if (sources.empty())
  {
    return sources;
  }
  vtkNew<vtkMatrix4x4> place;
  place->DeepCopy(matrix ? matrix : actor->GetMatrix());
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* data = vtkDataSet::SafeDownCast(input))
  {
    AddPoints(data, mapper, place, sources, scene);
  }
  else if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (auto* part = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()))
      {
        AddPoints(part, mapper, place, sources, scene);
      }
    }
  }
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [](vtkPolyData* source) {
                    return !source->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
                  }),
    sources.end());
  return sources;
}
}
