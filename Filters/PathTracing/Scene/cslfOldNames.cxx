// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOldNames.h"

#include "cslfJoin.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace cslf
{
namespace
{
constexpr const char* Prefix = "CSLF:";

/// The arrays of version 0.1.
struct OldArray
{
  const char* Name; ///< the current name
  int Type;
  int Components; ///< 0 for any number
  int Tuples;     ///< 0 for any number
};

/// Arrays that version 0.1 wrote together.
struct OldGroup
{
  std::vector<OldArray> Signs;  ///< if all of these exist, the group is ours
  std::vector<OldArray> Others; ///< optional ones
  bool IsAmbiguous = false;     ///< whether to warn if only the others exist
};

const char* GetOldName(const OldArray& array)
{
  return array.Name + std::strlen(Prefix);
}

std::vector<OldGroup> MakeGroups()
{
  using Material = vtkCSLFMaterial;
  using Light = vtkCSLFLight;
  const auto number = [](const char* name) { return OldArray{ name, VTK_DOUBLE, 1, 1 }; };
  const auto vectors = [](const char* name) { return OldArray{ name, VTK_DOUBLE, 3, 0 }; };
  std::vector<OldGroup> groups;
  // No simulation has a base colour.
  groups.push_back({ { { Material::BaseColorName(), VTK_DOUBLE, 3, 1 } },
    { number(Material::MetallicName()), number(Material::RoughnessName()),
      { Material::EmissionName(), VTK_DOUBLE, 3, 1 }, number(Material::IndexOfRefractionName()),
      number(Material::TransmissionName()), number(Material::ThinWalledName()),
      number(Material::OpacityName()), number(Material::OpacityCutoffName()),
      number(Material::NormalScaleName()), number(Material::LineRadiusName()),
      number(Material::PointRadiusName()) },
    true });
  for (int slot = 0; Material::TextureName(slot); ++slot)
  {
    groups.push_back({ { { Material::TextureName(slot), VTK_UNSIGNED_CHAR, 0, 0 },
                         { Material::TextureLayoutName(slot), VTK_INT, 4, 1 } },
      {} });
  }
  groups.push_back(
    { { vectors(Light::DirectionalLightDirection()), vectors(Light::DirectionalLightIrradiance()) },
      {} });
  groups.push_back(
    { { vectors(Light::PointLightPosition()), vectors(Light::PointLightIntensity()) }, {} });
  groups.push_back(
    { { vectors(Light::SpotLightPosition()), vectors(Light::SpotLightIntensity()),
        vectors(Light::SpotLightDirection()), { Light::SpotLightCone(), VTK_DOUBLE, 2, 0 } },
      {} });
  groups.push_back(
    { { vectors(Light::EnvironmentRadiance()), vectors(Light::EnvironmentUp()) }, {} });
  groups.push_back({ { { Light::EnvironmentImage(), 0, 0, 0 },
                       { Light::EnvironmentImageLayout(), VTK_INT, 2, 1 } },
    { vectors(Light::EnvironmentUp()), vectors(Light::EnvironmentRight()) } });
  groups.push_back({ { { vtkCSLFInstances::InstanceMatrix(), VTK_DOUBLE, 16, 0 } },
    { { vtkCSLFInstances::InstanceColor(), VTK_UNSIGNED_CHAR, 0, 0 } } });
  return groups;
}

bool HasNewNames(vtkFieldData* fields)
{
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const char* name = fields->GetArrayName(i);
    if (name && std::strncmp(name, Prefix, std::strlen(Prefix)) == 0)
    {
      return true;
    }
  }
  return false;
}

bool IsThere(vtkFieldData* fields, const OldArray& array)
{
  vtkDataArray* found = fields->GetArray(GetOldName(array));
  return found && (array.Type == 0 || found->GetDataType() == array.Type) &&
    (array.Components == 0 || found->GetNumberOfComponents() == array.Components) &&
    (array.Tuples == 0 || found->GetNumberOfTuples() == array.Tuples);
}

/// Adds a group's arrays to `names` if it is ours. Otherwise adds those that a user may miss.
void Look(
  vtkFieldData* fields, const OldGroup& group, std::set<const char*>& names, OldNames& found)
{
  const auto isThere = [fields](const OldArray& array) { return IsThere(fields, array); };
  const bool isOurs = std::all_of(group.Signs.begin(), group.Signs.end(), isThere);
  const bool isMissed = !isOurs && group.IsAmbiguous && !HasNewNames(fields);
  for (const std::vector<OldArray>& arrays : { group.Signs, group.Others })
  {
    for (const OldArray& array : arrays)
    {
      if (isOurs && isThere(array) && !fields->HasArray(array.Name))
      {
        names.insert(array.Name);
        found.Read.insert(GetOldName(array));
      }
      else if (isMissed && isThere(array))
      {
        found.Ignored.insert(GetOldName(array));
      }
    }
  }
}

/// Adds an array with an old name under the current name. The old array stays.
void AddRenamed(vtkFieldData* fields, const char* name)
{
  vtkDataArray* old = fields->GetArray(name + std::strlen(Prefix));
  auto array = vtk::TakeSmartPointer(old->NewInstance());
  array->ShallowCopy(old);
  array->SetName(name);
  fields->AddArray(array);
}

/// The arrays of the points' own radii, which are used if the material is ours.
std::set<const char*> LookForRadii(vtkDataObject* data, bool isOurs, OldNames& found)
{
  const bool isMissed = !isOurs && !HasNewNames(data->GetFieldData());
  std::set<const char*> names;
  auto* dataSet = vtkDataSet::SafeDownCast(data);
  for (const char* name : { vtkCSLFMaterial::LineRadiusName(), vtkCSLFMaterial::PointRadiusName() })
  {
    const char* old = name + std::strlen(Prefix);
    if (dataSet && dataSet->GetPointData()->GetArray(old) &&
      !dataSet->GetPointData()->HasArray(name))
    {
      if (isOurs)
      {
        names.insert(name);
        found.Read.insert(old);
      }
      else if (isMissed)
      {
        found.Ignored.insert(old);
      }
    }
  }
  return names;
}
}

std::string OldNames::ToText() const
{
  std::string text;
  if (!this->Read.empty())
  {
    text = "Arrays with names of version 0.1 were read: " + Join(this->Read) + ". Rename them to " +
      Join(this->Read, ", ", Prefix) + ": the next version will not read the old names.";
  }
  if (!this->Ignored.empty())
  {
    text += (text.empty() ? "" : " ") + ("The arrays " + Join(this->Ignored)) +
      " were not read as materials. If they are materials, rename them to " +
      Join(this->Ignored, ", ", Prefix) + ".";
  }
  return text;
}

vtkSmartPointer<vtkDataObject> RenameOldArrays(vtkDataObject* data, OldNames& found)
{
  static const std::vector<OldGroup> groups = MakeGroups();
  vtkFieldData* fields = data ? data->GetFieldData() : nullptr;
  if (!fields)
  {
    return data;
  }
  std::set<const char*> names;
  for (const OldGroup& group : groups)
  {
    Look(fields, group, names, found);
  }
  const bool isOurs = IsThere(fields, groups.front().Signs.front());
  const std::set<const char*> radii = LookForRadii(data, isOurs, found);
  if (names.empty() && radii.empty())
  {
    return data;
  }
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  for (const char* name : names)
  {
    AddRenamed(copy->GetFieldData(), name);
  }
  for (const char* name : radii)
  {
    AddRenamed(vtkDataSet::SafeDownCast(copy)->GetPointData(), name);
  }
  return copy;
}
}
