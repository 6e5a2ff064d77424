// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/cslfSceneGather.h"

#include "vtkCSLFLight.h"

#include <vtkCharArray.h>
#include <vtkCommunicator.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <utility>

namespace cslf
{
namespace
{
/// What stands before the bytes of each object.
struct Header
{
  std::int64_t Connection;
  std::int64_t Size;
};

/// One rank's objects, one after the other.
bool Pack(const std::vector<vtkDataObject*>& inputs, vtkCharArray* bytes)
{
  for (std::size_t connection = 0; connection < inputs.size(); ++connection)
  {
    vtkNew<vtkCharArray> object;
    if (!vtkCommunicator::MarshalDataObject(inputs[connection], object))
    {
      return false;
    }
    const Header header{ static_cast<std::int64_t>(connection), object->GetNumberOfValues() };
    const vtkIdType begin = bytes->GetNumberOfValues();
    constexpr vtkIdType headerSize = sizeof(header);
    char* target = bytes->WritePointer(begin, headerSize + header.Size);
    std::memcpy(target, &header, headerSize);
    std::copy_n(object->GetPointer(0), header.Size, target + headerSize);
  }
  return true;
}

bool HasLights(vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  return fields &&
    (fields->HasArray(vtkCSLFLight::DirectionalLightDirection()) ||
      fields->HasArray(vtkCSLFLight::PointLightPosition()));
}

/// The places where lights have been seen: a connection, and the index in a composite object.
using Places = std::set<std::pair<std::int64_t, unsigned int>>;

/// Removes the lights of places that lower ranks have lights at.
void RemoveRepeatedLights(vtkDataObject* object, std::int64_t connection, Places& places)
{
  const auto visit = [&](vtkDataObject* data, unsigned int index)
  {
    if (HasLights(data) && !places.insert({ connection, index }).second)
    {
      vtkCSLFLight::RemoveLights(data);
    }
  };
  visit(object, 0);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      visit(leaf->GetCurrentDataObject(), leaf->GetCurrentFlatIndex());
    }
  }
}
}

bool GatherScene(vtkMultiProcessController* controller, const std::vector<vtkDataObject*>& inputs,
  std::vector<vtkSmartPointer<vtkDataObject>>& scene, std::string& error)
{
  vtkNew<vtkCharArray> mine;
  vtkNew<vtkCharArray> all;
  const int packed = Pack(inputs, mine) ? 1 : 0;
  int allPacked = 0;
  controller->AllReduce(&packed, &allPacked, 1, vtkCommunicator::MIN_OP);
  if (!allPacked || !controller->AllGatherV(mine, all))
  {
    error = "The pieces of the scene could not be sent to all ranks.";
    return false;
  }
  Places places;
  constexpr vtkIdType headerSize = sizeof(Header);
  for (vtkIdType position = 0; position + headerSize <= all->GetNumberOfValues();)
  {
    Header header;
    std::memcpy(&header, all->GetPointer(position), headerSize);
    position += headerSize;
    vtkNew<vtkCharArray> bytes;
    bytes->SetArray(all->GetPointer(position), header.Size, 1);
    position += header.Size;
    const auto object = vtkCommunicator::UnMarshalDataObject(bytes);
    if (!object)
    {
      error = "A piece of the scene that another rank sent could not be read.";
      return false;
    }
    RemoveRepeatedLights(object, header.Connection, places);
    scene.push_back(object);
  }
  return true;
}
}
