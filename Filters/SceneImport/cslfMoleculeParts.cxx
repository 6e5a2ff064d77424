// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorParts.h"

#if VTK_MODULE_ENABLE_VTK_DomainsChemistry

#include "cslfMappedScalars.h"

#include <vtkGlyph3DMapper.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkUnsignedCharArray.h>

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
