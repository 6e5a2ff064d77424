// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVolumeReader.h"

#include "Pipeline/cslfParallelFor.h"
#include "cslfPhaseFunction.h"
#include "vtkCSLFVolume.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// Nodes are counted by 32 bits.
constexpr std::int64_t MaximumNodes = std::numeric_limits<std::int32_t>::max();

vtkDataArray* FindField(vtkDataObject* data, const char* name, int components)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfComponents() == components && array->GetNumberOfTuples() > 0
    ? array
    : nullptr;
}

double ReadNumber(vtkDataObject* data, const char* name, double standard)
{
  vtkDataArray* array = FindField(data, name, 1);
  const double value = array ? array->GetTuple1(0) : standard;
  return std::isfinite(value) ? value : standard;
}

glm::dmat4 ToMatrix(const double* rows)
{
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i)
  {
    matrix[i % 4][i / 4] = rows[i];
  }
  return matrix;
}

/// The scalars that make the volume, and whether they belong to cells.
vtkDataArray* FindScalars(vtkDataSet* data, bool& ofCells)
{
  vtkDataArray* ofPoints = data->GetPointData()->GetScalars();
  ofCells = !ofPoints;
  return ofPoints ? ofPoints : data->GetCellData()->GetScalars();
}

/// The points or cells that are hidden; null if none is.
vtkUnsignedCharArray* FindHidden(vtkDataSet* data, bool ofCells, unsigned char& bit)
{
  bit = ofCells ? vtkDataSetAttributes::HIDDENCELL : vtkDataSetAttributes::HIDDENPOINT;
  vtkUnsignedCharArray* array = ofCells ? data->GetCellGhostArray() : data->GetPointGhostArray();
  const vtkIdType count = ofCells ? data->GetNumberOfCells() : data->GetNumberOfPoints();
  return array && array->GetNumberOfValues() == count ? array : nullptr;
}

/// Takes floats as they are, and converts others.
void ReadValues(
  vtkDataSet* data, vtkDataArray* scalars, int component, bool ofCells, VolumeData& volume)
{
  unsigned char bit;
  vtkUnsignedCharArray* hidden = FindHidden(data, ofCells, bit);
  auto* floats = vtkFloatArray::SafeDownCast(scalars);
  if (floats && floats->GetNumberOfComponents() == 1 && !hidden)
  {
    volume.Holder = floats;
    volume.Values = floats->GetPointer(0);
    return;
  }
  volume.Converted.resize(static_cast<std::size_t>(scalars->GetNumberOfTuples()));
  ParallelFor(0, scalars->GetNumberOfTuples(), 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const bool isHidden = hidden && (hidden->GetValue(i) & bit) != 0;
        volume.Converted[i] = isHidden ? std::numeric_limits<float>::quiet_NaN()
                                       : static_cast<float>(scalars->GetComponent(i, component));
      }
    });
}

/// An even grid. Nodes are points, or the middles of cells.
void PlaceImage(vtkImageData* image, bool ofCells, VolumeData& volume)
{
  int extent[6];
  image->GetExtent(extent);
  const double half = ofCells ? 0.5 : 0.0;
  glm::dmat4 toIndex(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    volume.Size[axis] = extent[2 * axis + 1] - extent[2 * axis] + (ofCells ? 0 : 1);
    volume.Low[axis] = -half;
    volume.High[axis] = volume.Size[axis] - 1 + half;
    toIndex[3][axis] = extent[2 * axis] + half;
  }
  volume.ToData = ToMatrix(image->GetIndexToPhysicalMatrix()->GetData()) * toIndex;
}

/// A grid whose axes have coordinates. False if these do not increase, or are not as many as nodes.
bool PlaceRectilinear(vtkRectilinearGrid* grid, bool ofCells, VolumeData& volume)
{
  vtkDataArray* arrays[3] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType count = arrays[axis] ? arrays[axis]->GetNumberOfTuples() : 0;
    if (count < 2 || count != grid->GetDimensions()[axis] ||
      arrays[axis]->GetNumberOfComponents() != 1)
    {
      return false;
    }
    // Near the origin, so that floats hold them.
    const double first = arrays[axis]->GetComponent(0, 0);
    const auto get = [&](vtkIdType i) { return arrays[axis]->GetComponent(i, 0) - first; };
    std::vector<float>& nodes = volume.Axes[axis];
    for (vtkIdType i = ofCells ? 1 : 0; i < count; ++i)
    {
      nodes.push_back(static_cast<float>(ofCells ? 0.5 * (get(i - 1) + get(i)) : get(i)));
      if (nodes.size() > 1 && !(nodes.back() > *(nodes.end() - 2)))
      {
        return false;
      }
    }
    volume.Size[axis] = static_cast<int>(nodes.size());
    volume.Low[axis] = 0.0;
    volume.High[axis] = get(count - 1);
    volume.ToData[3][axis] = first;
  }
  return true;
}

/// The colours, and how they are placed over the scalars.
bool ReadLook(vtkDataObject* data, VolumeData& volume)
{
  vtkDataArray* colors = FindField(data, vtkCSLFVolume::ColorsName(), 4);
  vtkDataArray* range = FindField(data, vtkCSLFVolume::RangeName(), 2);
  if (!colors || colors->GetNumberOfTuples() < 2 || !range)
  {
    return false;
  }
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    glm::vec4 entry;
    for (int k = 0; k < 4; ++k)
    {
      entry[k] = static_cast<float>(colors->GetComponent(i, k));
      if (!std::isfinite(entry[k]))
      {
        return false;
      }
    }
    volume.Table.push_back(entry);
  }
  volume.Range[0] = static_cast<float>(range->GetComponent(0, 0));
  volume.Range[1] = static_cast<float>(range->GetComponent(0, 1));
  volume.UnitDistance = ReadNumber(data, vtkCSLFVolume::UnitDistanceName(), 1.0);
  volume.IsNearest = ReadNumber(data, vtkCSLFVolume::InterpolationName(), 1.0) == 0.0;
  volume.IsLit = ReadNumber(data, vtkCSLFVolume::ShadeName(), 0.0) != 0.0;
  volume.Anisotropy = static_cast<float>(ReadNumber(data, vtkCSLFVolume::AnisotropyName(), 0.0));
  volume.Anisotropy = std::abs(volume.Anisotropy) > MinimumAnisotropy ? volume.Anisotropy : 0.0f;
  return volume.UnitDistance > 0.0 && std::abs(volume.Anisotropy) < 1.0f &&
    volume.Range[0] <= volume.Range[1];
}

/// The place in the world. False for matrices that flatten.
bool ReadPlace(vtkDataObject* data, VolumeData& volume)
{
  if (vtkDataArray* matrix = FindField(data, vtkCSLFVolume::MatrixName(), 16))
  {
    double rows[16];
    matrix->GetTuple(0, rows);
    volume.Placement = ToMatrix(rows);
  }
  vtkDataArray* planes = FindField(data, vtkCSLFVolume::PlanesName(), 4);
  for (vtkIdType i = 0; planes && i < planes->GetNumberOfTuples(); ++i)
  {
    double plane[4];
    planes->GetTuple(i, plane);
    volume.Planes.emplace_back(plane[0], plane[1], plane[2], plane[3]);
    if (!std::isfinite(plane[0] + plane[1] + plane[2] + plane[3]))
    {
      return false;
    }
  }
  const glm::dmat4 toWorld = volume.GetToWorld();
  const double content = std::abs(glm::determinant(glm::dmat3(toWorld)));
  return content > 0.0 && std::isfinite(content) && std::isfinite(glm::dot(toWorld[3], toWorld[3]));
}
}

bool IsVolume(vtkDataObject* data)
{
  return data && data->GetFieldData() &&
    data->GetFieldData()->HasArray(vtkCSLFVolume::ColorsName()) != 0 &&
    (data->IsA("vtkImageData") || data->IsA("vtkRectilinearGrid"));
}

std::optional<VolumeData> ReadVolume(vtkDataObject* object, std::string& problem)
{
  auto* data = vtkDataSet::SafeDownCast(object);
  VolumeData volume;
  bool ofCells = false;
  vtkDataArray* scalars = FindScalars(data, ofCells);
  const double number = ReadNumber(data, vtkCSLFVolume::ComponentName(), 0.0);
  if (!scalars || !(number >= 0.0 && number < scalars->GetNumberOfComponents()))
  {
    problem = "without scalars";
    return std::nullopt;
  }
  const int component = static_cast<int>(number);
  auto* image = vtkImageData::SafeDownCast(data);
  if (image)
  {
    PlaceImage(image, ofCells, volume);
  }
  else if (!PlaceRectilinear(vtkRectilinearGrid::SafeDownCast(data), ofCells, volume))
  {
    problem = "whose coordinates do not increase, or do not fit";
    return std::nullopt;
  }
  const std::int64_t nodes =
    std::int64_t(volume.Size[0]) * volume.Size[1] * std::int64_t(volume.Size[2]);
  if (volume.Size[0] < 2 || volume.Size[1] < 2 || volume.Size[2] < 2 ||
    nodes != scalars->GetNumberOfTuples())
  {
    problem = "with fewer than 2 layers along an axis";
    return std::nullopt;
  }
  if (nodes > MaximumNodes)
  {
    problem = "with more than 2^31 points";
    return std::nullopt;
  }
  if (!ReadLook(data, volume) || !ReadPlace(data, volume))
  {
    problem = "with arrays of vtkCSLFVolume that do not match or are out of range";
    return std::nullopt;
  }
  ReadValues(data, scalars, component, ofCells, volume);
  return volume;
}
}
