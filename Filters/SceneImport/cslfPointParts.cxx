// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorParts.h"

#include "Pipeline/cslfValidPolyData.h"
#include "cslfMappedScalars.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkOpenGLStickMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#if VTK_MODULE_ENABLE_VTK_DomainsChemistry
#include <vtkGlyph3DMapper.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#endif

namespace cslf
{
namespace
{
/// The names of arrays that can be set in these mappers, but that only subclasses can read.
class SphereAccess : public vtkOpenGLSphereMapper
{
public:
  static const char* GetScales(vtkOpenGLSphereMapper* mapper)
  {
    return mapper->*(&SphereAccess::ScaleArray);
  }
};

class StickAccess : public vtkOpenGLStickMapper
{
public:
  static const char* GetScales(vtkOpenGLStickMapper* mapper)
  {
    return mapper->*(&StickAccess::ScaleArray);
  }
  static const char* GetDirections(vtkOpenGLStickMapper* mapper)
  {
    return mapper->*(&StickAccess::OrientationArray);
  }
};

vtkDataArray* FindArray(vtkPolyData* data, const char* name)
{
  return name ? data->GetPointData()->GetArray(name) : nullptr;
}

vtkSmartPointer<vtkDoubleArray> MakeEqual(double value, vtkIdType count)
{
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetNumberOfTuples(count);
  values->Fill(value);
  return values;
}

/// A component, or the magnitude if there is no such component.
double GetValue(vtkDataArray* array, vtkIdType tuple, int component)
{
  const int count = array->GetNumberOfComponents();
  if (count == 1 || (component >= 0 && component < count))
  {
    return array->GetComponent(tuple, count == 1 ? 0 : component);
  }
  double sum = 0.0;
  for (int i = 0; i < count; ++i)
  {
    sum += array->GetComponent(tuple, i) * array->GetComponent(tuple, i);
  }
  return std::sqrt(sum);
}

/// The same, mapped by a function if there is one. The function is constant beyond its range.
double GetValue(vtkDataArray* array, vtkIdType tuple, int component, vtkPiecewiseFunction* function)
{
  const double value = GetValue(array, tuple, component);
  if (!function || function->GetSize() == 0)
  {
    return value;
  }
  const double* range = function->GetRange();
  return function->GetValue(std::clamp(value, range[0], std::max(range[0], range[1])));
}

/// The splats of one data object.
class SplatReader
{
public:
  SplatReader(vtkPointGaussianMapper* mapper, vtkPolyData* data, ImportedScene& scene)
    : Mapper(mapper)
    , Data(data)
    , Sizes(FindArray(data, mapper->GetScaleArray()))
    , Opacities(FindArray(data, mapper->GetOpacityArray()))
    , Colors(MapScalars(mapper, data, false, scene).Colors)
  {
  }

  /// Spheres with the splats' radii; vertices without radii if splats are pixels.
  vtkSmartPointer<vtkPolyData> MakeShapes()
  {
    this->AddPoints();
    vtkSmartPointer<vtkPolyData> shapes =
      MakeSpheres(this->Points, this->Radii, this->Colors ? this->PointColors.Get() : nullptr);
    if (this->Mapper->GetScaleFactor() == 0.0)
    {
      shapes->GetPointData()->RemoveArray(vtkCSLFMaterial::PointRadiusName());
    }
    return shapes;
  }

private:
  /// All points of vertex cells, or all points if there are no such cells.
  void AddPoints()
  {
    this->Points->SetDataType(this->Data->GetPoints()->GetDataType());
    this->PointColors->SetNumberOfComponents(4);
    if (this->Data->GetNumberOfVerts() == 0)
    {
      for (vtkIdType i = 0; i < this->Data->GetNumberOfPoints(); ++i)
      {
        this->Add(i);
      }
      return;
    }
    auto cell = vtk::TakeSmartPointer(this->Data->GetVerts()->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType count;
      const vtkIdType* ids;
      cell->GetCurrentCell(count, ids);
      std::for_each(ids, ids + count, [this](vtkIdType id) { this->Add(id); });
    }
  }

  void Add(vtkIdType point)
  {
    this->Points->InsertNextPoint(this->Data->GetPoint(point));
    const double size = this->Sizes
      ? GetValue(this->Sizes, point, this->Mapper->GetScaleArrayComponent(),
          this->Mapper->GetScaleFunction())
      : 1.0;
    this->Radii->InsertNextValue(this->Mapper->GetScaleFactor() * size);
    if (this->Colors)
    {
      unsigned char color[4] = { 0, 0, 0, 255 };
      const int components = std::min(this->Colors->GetNumberOfComponents(), 4);
      std::copy_n(
        this->Colors->GetPointer(point * this->Colors->GetNumberOfComponents()), components, color);
      if (this->Opacities)
      {
        const double opacity = GetValue(this->Opacities, point,
          this->Mapper->GetOpacityArrayComponent(), this->Mapper->GetScalarOpacityFunction());
        color[3] = static_cast<unsigned char>(std::clamp(255.0 * opacity, 0.0, 255.0));
      }
      this->PointColors->InsertNextTypedTuple(color);
    }
  }

  vtkPointGaussianMapper* Mapper;
  vtkPolyData* Data;
  vtkDataArray* Sizes;
  vtkDataArray* Opacities;
  vtkSmartPointer<vtkUnsignedCharArray> Colors; // of all points of the data
  vtkNew<vtkPoints> Points;
  vtkNew<vtkDoubleArray> Radii;
  vtkNew<vtkUnsignedCharArray> PointColors;
};

/// A part that the clipping planes of the whole cut, too.
ActorPart MakeClippedPart(vtkPolyData* data, vtkActor* whole, vtkMatrix4x4* matrix)
{
  ActorPart part = MakePart(data, whole, matrix);
  part.Actor->GetMapper()->SetClippingPlanes(whole->GetMapper()->GetClippingPlanes());
  return part;
}

/// Calls `visit` for each polygonal data object that has points, without its broken cells and
/// arrays.
template <typename Visit>
void ForEachPolyData(vtkDataObject* input, Visit visit)
{
  const auto visitPoints = [&visit](vtkDataObject* leaf)
  {
    auto* data = vtkPolyData::SafeDownCast(leaf);
    if (data && data->GetNumberOfPoints() > 0)
    {
      visit(MakeSound(data).Data.Get());
    }
  };
  visitPoints(input);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      visitPoints(leaf->GetCurrentDataObject());
    }
  }
}

/// A part for each data object of the actor's mapper, unless `makeShapes` returns none.
template <typename MakeShapes>
ActorParts MakeParts(vtkActor* actor, vtkMatrix4x4* matrix, MakeShapes makeShapes)
{
  ActorParts parts;
  ForEachPolyData(actor->GetMapper()->GetInputDataObject(0, 0),
    [&](vtkPolyData* data)
    {
      if (const vtkSmartPointer<vtkPolyData> shapes = makeShapes(data))
      {
        parts.push_back(MakeClippedPart(shapes, actor, matrix));
      }
    });
  return parts;
}
}

ActorParts TakeSplatsApart(
  vtkActor* actor, vtkPointGaussianMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  ActorParts parts = MakeParts(actor, matrix,
    [&](vtkPolyData* data) { return SplatReader(mapper, data, scene).MakeShapes(); });
  // Splats show their colours, unless a user's shader computes something else.
  const char* shader = mapper->GetSplatShaderCode();
  const bool lit = shader && *shader && mapper->GetScaleFactor() != 0.0;
  for (const ActorPart& part : parts)
  {
    part.Actor->GetProperty()->SetLighting(lit);
  }
  if (!parts.empty() && mapper->GetScaleFactor() != 0.0)
  {
    scene.Meet(ImportLimit::Splats);
  }
  return parts;
}

ActorParts TakeSpheresApart(
  vtkActor* actor, vtkPolyDataMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  auto* spheres = vtkOpenGLSphereMapper::SafeDownCast(mapper);
  return MakeParts(actor, matrix,
    [&](vtkPolyData* data)
    {
      vtkSmartPointer<vtkDataArray> radii = FindArray(data, SphereAccess::GetScales(spheres));
      if (!radii)
      {
        radii = MakeEqual(spheres->GetRadius(), data->GetNumberOfPoints());
      }
      const MappedScalars colors = MapScalars(mapper, data, false, scene);
      return MakeSpheres(data->GetPoints(), radii, colors.Colors);
    });
}

ActorParts TakeSticksApart(
  vtkActor* actor, vtkPolyDataMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  auto* sticks = vtkOpenGLStickMapper::SafeDownCast(mapper);
  return MakeParts(actor, matrix,
    [&](vtkPolyData* data) -> vtkSmartPointer<vtkPolyData>
    {
      vtkDataArray* scales = FindArray(data, StickAccess::GetScales(sticks));
      vtkDataArray* directions = FindArray(data, StickAccess::GetDirections(sticks));
      if (!scales || !directions || scales->GetNumberOfComponents() != 3 ||
        directions->GetNumberOfComponents() != 3)
      {
        return nullptr;
      }
      const MappedScalars colors = MapScalars(mapper, data, false, scene);
      return MakeSticks(data->GetPoints(), scales, directions, colors.Colors);
    });
}
}

#if VTK_MODULE_ENABLE_VTK_DomainsChemistry
namespace cslf
{
namespace
{
/// Members that vtkMoleculeMapper shows only to subclasses: the points of its glyphs, which contain
/// the results of all its modes, and the mappers that colour them.
class MoleculeAccess : public vtkMoleculeMapper
{
public:
  static void UpdateGlyphs(vtkMoleculeMapper* mapper)
  {
    (mapper->*(&MoleculeAccess::UpdateGlyphPolyData))();
  }
  static vtkPolyData* GetAtoms(vtkMoleculeMapper* mapper)
  {
    return (mapper->*(&MoleculeAccess::AtomGlyphPolyData)).Get();
  }
  static vtkMapper* GetAtomMapper(vtkMoleculeMapper* mapper)
  {
    return (mapper->*(&MoleculeAccess::AtomGlyphMapper)).Get();
  }
  static vtkPolyData* GetBonds(vtkMoleculeMapper* mapper)
  {
    return (mapper->*(&MoleculeAccess::BondGlyphPolyData)).Get();
  }
  static vtkMapper* GetBondMapper(vtkMoleculeMapper* mapper)
  {
    return (mapper->*(&MoleculeAccess::BondGlyphMapper)).Get();
  }
  static vtkPolyData* GetLattice(vtkMoleculeMapper* mapper)
  {
    return (mapper->*(&MoleculeAccess::LatticePolyData)).Get();
  }
};

constexpr const char* ScaleName = "Scale Factors";
constexpr const char* DirectionName = "Orientation Vectors";
}

ActorParts TakeMoleculeApart(
  vtkActor* actor, vtkMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  ActorParts parts;
  auto* molecules = vtkMoleculeMapper::SafeDownCast(mapper);
  if (!molecules || !vtkMolecule::SafeDownCast(molecules->GetInputDataObject(0, 0)))
  {
    return parts;
  }
  MoleculeAccess::UpdateGlyphs(molecules);
  vtkPolyData* atoms = MoleculeAccess::GetAtoms(molecules);
  if (molecules->GetRenderAtoms() && atoms->GetNumberOfPoints() > 0)
  {
    const MappedScalars colors =
      MapScalars(MoleculeAccess::GetAtomMapper(molecules), atoms, false, scene);
    const vtkSmartPointer<vtkPolyData> spheres =
      MakeSpheres(atoms->GetPoints(), atoms->GetPointData()->GetArray(ScaleName), colors.Colors);
    parts.push_back(MakePart(spheres, actor, matrix));
  }
  vtkPolyData* bonds = MoleculeAccess::GetBonds(molecules);
  if (molecules->GetRenderBonds() && bonds->GetNumberOfPoints() > 0)
  {
    const MappedScalars colors =
      MapScalars(MoleculeAccess::GetBondMapper(molecules), bonds, false, scene);
    const vtkSmartPointer<vtkPolyData> sticks =
      MakeSticks(bonds->GetPoints(), bonds->GetPointData()->GetArray(ScaleName),
        bonds->GetPointData()->GetArray(DirectionName), colors.Colors);
    parts.push_back(MakePart(sticks, actor, matrix));
  }
  vtkPolyData* lattice = MoleculeAccess::GetLattice(molecules);
  if (molecules->GetRenderLattice() && lattice->GetNumberOfPoints() > 0)
  {
    vtkNew<vtkPolyData> lines;
    lines->ShallowCopy(lattice);
    parts.push_back(MakePart(lines, actor, matrix));
  }
  return parts;
}
}

#else

namespace cslf
{
ActorParts TakeMoleculeApart(vtkActor*, vtkMapper*, vtkMatrix4x4*, ImportedScene&)
{
  return {};
}
}
#endif
