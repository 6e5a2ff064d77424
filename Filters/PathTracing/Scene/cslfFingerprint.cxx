// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFingerprint.h"

#include "PathTracing/Volumes/cslfVolume.h"
#include "cslfScene.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <vtksys/MD5.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// MD5 takes its input in parts, whose size is an int.
constexpr std::size_t MaximumPiece = std::size_t(1) << 30;

constexpr int DigitCount = 32;

/// Arrays of at least this many bytes are hashed once.
constexpr std::size_t LargeArray = std::size_t(1) << 16;

std::size_t CountBytes(vtkDataArray* array)
{
  return static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
}
}

const std::string& ArrayHashes::Find(vtkDataArray* array)
{
  const void* memory = array->GetVoidPointer(0);
  const std::size_t bytes = CountBytes(array);
  Entry& entry = this->Known[{ memory, bytes }];
  if (!entry.Holder)
  {
    Fingerprint content;
    content.AddBytes(memory, bytes);
    entry = { array, content.Finish() };
  }
  return entry.Hash;
}

struct Fingerprint::State
{
  vtksysMD5* MD5 = vtksysMD5_New();
  ~State() { vtksysMD5_Delete(this->MD5); }
};

Fingerprint::Fingerprint()
  : Hash(std::make_unique<State>())
{
  vtksysMD5_Initialize(this->Hash->MD5);
}

Fingerprint::~Fingerprint() = default;

void Fingerprint::AddBytes(const void* bytes, std::size_t count)
{
  const auto* begin = static_cast<const unsigned char*>(bytes);
  for (std::size_t done = 0; done < count; done += MaximumPiece)
  {
    vtksysMD5_Append(
      this->Hash->MD5, begin + done, static_cast<int>(std::min(MaximumPiece, count - done)));
  }
}

void Fingerprint::AddArray(vtkAbstractArray* array, ArrayHashes& hashes)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  this->Add(std::vector<char>(name.begin(), name.end()));
  this->Add(std::vector<vtkIdType>{
    array->GetDataType(), array->GetNumberOfComponents(), array->GetNumberOfTuples() });
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    const std::size_t bytes = CountBytes(numbers);
    if (bytes >= LargeArray)
    {
      const std::string& hash = hashes.Find(numbers);
      this->Add(std::vector<char>(hash.begin(), hash.end()));
    }
    else
    {
      this->AddBytes(numbers->GetVoidPointer(0), bytes);
    }
  }
  else if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
    {
      const std::string text = texts->GetValue(i);
      this->Add(std::vector<char>(text.begin(), text.end()));
    }
  }
}

void Fingerprint::Add(vtkFieldData* fields, ArrayHashes& hashes)
{
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    this->AddArray(fields->GetAbstractArray(i), hashes);
  }
}

void Fingerprint::Add(const Mesh& mesh)
{
  this->Add(mesh.Vertices);
  this->Add(mesh.Triangles);
  this->Add(mesh.Normals);
  this->Add(mesh.TexCoords);
  this->Add(mesh.MapPlaces);
  this->Add(mesh.Colors);
  this->Add(mesh.Opacities);
  this->Add(mesh.Emissions);
  this->Add(mesh.Radii);
  this->Add(mesh.Joints);
  this->Add(mesh.Instances);
  this->Add(std::vector<char>(mesh.Appearance.begin(), mesh.Appearance.end()));
  this->Add(std::vector<int>{ static_cast<int>(mesh.Coloring), static_cast<int>(mesh.Shape),
    static_cast<int>(mesh.EmissionsOf) });
}

void Fingerprint::Add(const std::vector<SurfaceArray>& arrays)
{
  for (const SurfaceArray& array : arrays)
  {
    this->Add(std::vector<char>(array.Name.begin(), array.Name.end()));
    this->Add(std::vector<int>{ array.IsInteger ? 1 : 0 });
    for (const SurfaceArray::Component& component : array.Components)
    {
      this->Add(std::vector<char>(component.Name.begin(), component.Name.end()));
      this->Add(component.Values);
    }
  }
}

void Fingerprint::Add(const LightSet& lights)
{
  this->Add(lights.Directional);
  this->Add(lights.Points);
  const Environment& surroundings = lights.Surroundings;
  this->Add(std::vector<SkyGradient>{ surroundings.GetGradient() });
  this->Add(std::vector<EnvironmentAxes>{ surroundings.GetAxes() });
  const EnvironmentImage& image = surroundings.GetImage();
  this->Add(std::vector<int>{ image.Width, image.Height });
  this->Add(image.Pixels);
}

void Fingerprint::Add(const VolumeData& volume)
{
  this->Add(std::vector<int>(volume.Size, volume.Size + 3));
  const std::size_t nodes =
    static_cast<std::size_t>(volume.Size[0]) * volume.Size[1] * volume.Size[2];
  this->AddBytes(volume.Values, nodes * sizeof(float));
  for (const std::vector<float>& axis : volume.Axes)
  {
    this->Add(axis);
  }
  this->Add(std::vector<glm::dvec3>{ volume.Low, volume.High });
  this->Add(std::vector<glm::dmat4>{ volume.ToData, volume.Placement });
  this->Add(volume.Planes);
  this->Add(volume.Table);
  this->Add(std::vector<double>{ volume.UnitDistance, volume.Range[0], volume.Range[1],
    volume.Anisotropy, volume.IsNearest ? 1.0 : 0.0, volume.IsLit ? 1.0 : 0.0 });
}

std::string Fingerprint::Finish()
{
  char digits[DigitCount];
  vtksysMD5_FinalizeHex(this->Hash->MD5, digits);
  return std::string(digits, DigitCount);
}
}
