// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneGather.h"

#include <vtkCommunicator.h>
#include <vtkDataObject.h>
#include <vtkMultiProcessController.h>

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>
#include <numeric>
#include <sstream>

namespace cslf
{
namespace
{
/// The memory that a rank needs at most while its scene is built, per byte of the pieces: these,
/// their meshes and Embree's tree. Measured with spheres of triangles.
constexpr double BytesPerByte = 6.0;

/// The header before the bytes of each object.
using Size = std::uint64_t;

/// Appends one object after the other. False if one cannot be sent.
bool Pack(const std::vector<vtkDataObject*>& inputs, vtkCharArray* bytes)
{
  for (vtkDataObject* input : inputs)
  {
    vtkNew<vtkCharArray> object;
    if (!vtkCommunicator::MarshalDataObject(input, object))
    {
      return false;
    }
    const auto size = static_cast<Size>(object->GetNumberOfValues());
    char* target =
      bytes->WritePointer(bytes->GetNumberOfValues(), static_cast<vtkIdType>(sizeof(Size) + size));
    std::memcpy(target, &size, sizeof(Size));
    std::copy_n(object->GetPointer(0), size, target + sizeof(Size));
  }
  return true;
}

std::string ToGiB(std::uint64_t bytes)
{
  std::ostringstream text;
  text.precision(3);
  text << static_cast<double>(bytes) / (1024.0 * 1024.0 * 1024.0) << " GiB";
  return text.str();
}
}

std::string GatherCost::FindWarning() const
{
  if (this->Memory == 0 || this->Node <= this->Memory)
  {
    return {};
  }
  return "The pieces of the scene have " + ToGiB(this->Pieces) +
    " and every rank receives all of them: the ranks on one computer may need " +
    ToGiB(this->Node) + " of its " + ToGiB(this->Memory) +
    " of memory. Run fewer ranks with more threads each.";
}

SceneGather::SceneGather(
  vtkMultiProcessController* controller, const std::string& arithmetic, std::size_t partSize)
  : Controller(controller)
  , Arithmetic(arithmetic)
  , PartSize(std::max<std::size_t>(partSize, 1))
{
}

bool SceneGather::Begin(const std::vector<vtkDataObject*>& inputs, std::string& error)
{
  if (error.empty())
  {
    try
    {
      error = Pack(inputs, this->Mine) ? "" : "The piece of the scene cannot be serialized.";
    }
    catch (const std::bad_alloc&)
    {
      error =
        "There is not enough memory to send the piece of the scene: run fewer ranks per computer.";
    }
  }
  if (ShareError(this->Controller, error) >= 0)
  {
    return false;
  }
  const auto mine = static_cast<unsigned long long>(this->Mine->GetNumberOfValues());
  std::vector<unsigned long long> sizes(this->Controller->GetNumberOfProcesses());
  this->Controller->AllGather(&mine, sizes.data(), 1);
  this->Sizes.assign(sizes.begin(), sizes.end());
  this->FindCost();
  return true;
}

void SceneGather::FindCost()
{
  vtksys::SystemInformation system;
  system.RunOSCheck();
  system.RunMemoryCheck();
  const char* name = system.GetHostname();
  const unsigned long long mine = std::hash<std::string>()(name ? name : "");
  std::vector<unsigned long long> hosts(this->Sizes.size());
  this->Controller->AllGather(&mine, hosts.data(), 1);
  const auto neighbours = std::count(hosts.begin(), hosts.end(), mine);
  const unsigned long long arithmetic = std::hash<std::string>()(this->Arithmetic);
  std::vector<unsigned long long> arithmetics(this->Sizes.size());
  this->Controller->AllGather(&arithmetic, arithmetics.data(), 1);
  this->Alike = std::count(arithmetics.begin(), arithmetics.end(), arithmetic) ==
    static_cast<std::ptrdiff_t>(arithmetics.size());
  this->Cost.Pieces = std::accumulate(this->Sizes.begin(), this->Sizes.end(), Size(0));
  this->Cost.Node = static_cast<std::uint64_t>(
    BytesPerByte * static_cast<double>(neighbours) * static_cast<double>(this->Cost.Pieces));
  this->Cost.Memory = static_cast<std::uint64_t>(system.GetTotalPhysicalMemory()) << 20;
}

bool SceneGather::Finish(std::string& error)
{
  // One rank's bytes at a time: each rank has the objects, and a second copy of the largest piece.
  std::vector<char> bytes;
  try
  {
    bytes.resize(*std::max_element(this->Sizes.begin(), this->Sizes.end()));
  }
  catch (const std::bad_alloc&)
  {
    error = "There is not enough memory for the whole scene: run fewer ranks per computer.";
  }
  if (ShareError(this->Controller, error) >= 0)
  {
    return false;
  }
  const int rank = this->Controller->GetLocalProcessId();
  for (int sender = 0; sender < this->Controller->GetNumberOfProcesses(); ++sender)
  {
    if (sender == rank)
    {
      std::copy_n(this->Mine->GetPointer(0), this->Sizes[sender], bytes.data());
      this->Mine->Initialize();
    }
    BroadcastBytes(this->Controller, bytes.data(), this->Sizes[sender], sender, this->PartSize);
    if (error.empty() && !this->Unpack(bytes.data(), this->Sizes[sender], sender))
    {
      error = "The piece of the scene from rank " + std::to_string(sender) + " cannot be read.";
    }
  }
  return ShareError(this->Controller, error) < 0;
}

bool SceneGather::Unpack(char* bytes, std::uint64_t count, int rank)
{
  try
  {
    for (std::uint64_t position = 0; position < count;)
    {
      Size size = 0;
      std::memcpy(&size, bytes + position, sizeof(Size));
      position += sizeof(Size);
      vtkNew<vtkCharArray> packed;
      packed->SetArray(bytes + position, static_cast<vtkIdType>(size), 1);
      position += size;
      const auto object = vtkCommunicator::UnMarshalDataObject(packed);
      if (!object)
      {
        return false;
      }
      this->Objects.push_back(object);
      this->Ranks.push_back(rank);
    }
  }
  catch (const std::bad_alloc&)
  {
    return false;
  }
  return true;
}
}
