// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFaceSides.h"

#include "cslfActorParts.h"
#include "cslfCellKinds.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

namespace cslf
{
namespace
{
/// Blocks with the same geometry, divided into reflected and other instances.
struct PlacedBlock
{
  vtkSmartPointer<vtkPolyData> Block;
  bool IsReflected;
};

const char* const InstanceNames[] = { vtkCSLFInstances::InstanceMatrix(),
  vtkCSLFInstances::InstanceColor(), vtkCSLFInstances::InstanceEmission(),
  vtkCSLFInstances::InstanceScalar() };

vtkSmartPointer<vtkPolyData> CopyWithOwnFields(vtkPolyData* block)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(block);
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(block->GetFieldData());
  copy->SetFieldData(fields);
  return copy;
}

bool IsReflection(vtkDataArray* matrices, vtkIdType index)
{
  double elements[16];
  matrices->GetTuple(index, elements);
  return vtkMatrix4x4::Determinant(elements) < 0.0;
}

/// The instances of a block that are reflected, or those that are not.
PlacedBlock SelectInstances(vtkPolyData* block, bool reflected)
{
  const vtkSmartPointer<vtkPolyData> selected = CopyWithOwnFields(block);
  vtkDataArray* matrices = block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  for (const char* name : InstanceNames)
  {
    vtkDataArray* all = block->GetFieldData()->GetArray(name);
    if (!all)
    {
      continue;
    }
    vtkSmartPointer<vtkDataArray> some;
    some.TakeReference(all->NewInstance());
    some->SetName(name);
    some->SetNumberOfComponents(all->GetNumberOfComponents());
    for (vtkIdType i = 0; i < all->GetNumberOfTuples(); ++i)
    {
      if (IsReflection(matrices, i) == reflected)
      {
        some->InsertNextTuple(i, all);
      }
    }
    selected->GetFieldData()->AddArray(some);
  }
  return { selected, reflected };
}

std::vector<PlacedBlock> DivideByReflection(vtkPolyData* block, bool isReflected)
{
  vtkDataArray* matrices = block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  if (!matrices)
  {
    return { { block, isReflected } };
  }
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < matrices->GetNumberOfTuples(); ++i)
  {
    count += IsReflection(matrices, i) ? 1 : 0;
  }
  if (count == 0 || count == matrices->GetNumberOfTuples())
  {
    return { { block, count > 0 } };
  }
  return { SelectInstances(block, false), SelectInstances(block, true) };
}

/// VTK's properties of back faces: coefficients, colours and opacity are their own, everything else
/// is the front's.
vtkSmartPointer<vtkProperty> MakeBackProperty(vtkProperty* front, vtkProperty* back)
{
  vtkSmartPointer<vtkProperty> property = CopyProperty(front);
  property->SetAmbient(back->GetAmbient());
  property->SetDiffuse(back->GetDiffuse());
  property->SetSpecular(back->GetSpecular());
  property->SetSpecularPower(back->GetSpecularPower());
  property->SetAmbientColor(back->GetAmbientColor());
  property->SetDiffuseColor(back->GetDiffuseColor());
  property->SetSpecularColor(back->GetSpecularColor());
  property->SetOpacity(back->GetOpacity());
  return property;
}

/// The side of the data that is the front, or the back, in the window.
int FindSide(bool back, bool isReflected)
{
  return back != isReflected ? vtkCSLFMaterial::BackSide : vtkCSLFMaterial::FrontSide;
}

/// VTK culls back faces if both kinds are to be culled.
bool IsCulled(vtkProperty* property, bool back)
{
  return back ? property->GetBackfaceCulling() != 0
              : property->GetFrontfaceCulling() != 0 && property->GetBackfaceCulling() == 0;
}
}

bool HasDifferentSides(vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  return actor->GetBackfaceProperty() != nullptr || property->GetBackfaceCulling() ||
    property->GetFrontfaceCulling();
}

std::vector<FaceSide> DivideBySides(
  vtkActor* actor, vtkPolyData* block, bool isReflected, bool isColored)
{
  vtkProperty* property = actor->GetProperty();
  vtkProperty* ofBacks = isColored ? nullptr : actor->GetBackfaceProperty();
  if (!HasDifferentSides(actor))
  {
    return { { block, property } };
  }
  const bool isSetByData =
    block->GetFieldData()->HasArray(vtkCSLFMaterial::VisibleSidesName()) != 0;
  const int ofData = vtkCSLFMaterial::GetVisibleSides(block);
  const bool cullsAny = IsCulled(property, false) || IsCulled(property, true);
  std::vector<FaceSide> sides;
  for (const PlacedBlock& placed : DivideByReflection(block, isReflected))
  {
    if (!ofBacks && (isSetByData || !cullsAny))
    {
      sides.push_back({ placed.Block, property });
      continue;
    }
    for (const bool back : { false, true })
    {
      const int side = FindSide(back, placed.IsReflected);
      const bool isHidden = isSetByData ? ofData != vtkCSLFMaterial::BothSides && ofData != side
                                        : IsCulled(property, back);
      if (isHidden)
      {
        continue;
      }
      FaceSide seen;
      seen.Block =
        ofBacks ? SelectCells(placed.Block, { CellKind::Faces }) : CopyWithOwnFields(placed.Block);
      seen.Property = property;
      seen.IsBack = back && ofBacks;
      vtkCSLFMaterial::SetVisibleSides(seen.Block, side);
      if (seen.IsBack)
      {
        seen.Property = MakeBackProperty(property, ofBacks);
      }
      sides.push_back(seen);
    }
    if (ofBacks)
    {
      sides.push_back(
        { SelectCells(placed.Block, { CellKind::Vertices, CellKind::Lines }), property });
    }
  }
  return sides;
}
}
