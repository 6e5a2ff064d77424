// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryStreams.h"

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfChannel.h"
#include "cslfColor.h"
#include "cslfJSONText.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

/// The fewest steps of coordinates in a texel's width, which is the cube's edge divided by the
/// resolution, unless that needs more bits than there are.
constexpr int StepsOfTexel = 64;

/// The bits of a coordinate in fields of a resolution.
int FindPositionBits(int resolution)
{
  int bits = MinimumPositionBits;
  while (bits < MaximumPositionBits && 1 << bits < StepsOfTexel * resolution)
  {
    ++bits;
  }
  return bits;
}

/// Of the points that triangles use, which lie in the cube.
void AddPositions(vtkPolyData* triangles, const Cube& box, GeometryStreams& streams)
{
  streams.Points = triangles->GetNumberOfPoints();
  streams.Positions.assign(PositionSize * streams.Points, 0);
  std::vector<char> isUsed(streams.Points, 0);
  for (unsigned int corner : streams.Corners)
  {
    isUsed[corner] = 1;
  }
  std::vector<glm::dvec3> placesCC(streams.Points);
  streams.Low = glm::dvec3(1.0);
  streams.High = glm::dvec3(-1.0);
  for (std::size_t point = 0; point < streams.Points; ++point)
  {
    double place[3];
    triangles->GetPoint(static_cast<vtkIdType>(point), place);
    if (isUsed[point] != 0)
    {
      placesCC[point] = glm::clamp(box.PointToCube({ place[0], place[1], place[2] }), -1.0, 1.0);
      streams.Low = glm::min(streams.Low, placesCC[point]);
      streams.High = glm::max(streams.High, placesCC[point]);
    }
  }
  for (std::size_t value = 0; value < 3 * streams.Points; ++value)
  {
    const int axis = static_cast<int>(value % 3);
    const double size = streams.High[axis] - streams.Low[axis];
    if (isUsed[value / 3] != 0 && size > 0.0)
    {
      const double share = (placesCC[value / 3][axis] - streams.Low[axis]) / size;
      StoreNumber(static_cast<std::uint16_t>(std::round(share * streams.GetPositionSteps())),
        &streams.Positions[PositionSize * (value / 3) + 2 * axis]);
    }
  }
}

/// The codes of the colours in an array. None without one.
std::vector<unsigned char> ListCodes(vtkDataArray* colors, bool areHalves, double steps)
{
  const std::size_t size = GetCodeSize(areHalves);
  const vtkIdType points = colors ? colors->GetNumberOfTuples() : 0;
  std::vector<unsigned char> codes(4 * size * static_cast<std::size_t>(points));
  unsigned char* place = codes.data();
  for (vtkIdType point = 0; point < points; ++point)
  {
    for (int channel = 0; channel < 4; ++channel, place += size)
    {
      const double value = colors->GetComponent(point, channel);
      if (areHalves)
      {
        StoreNumber(glm::packHalf1x16(static_cast<float>(value)), place);
      }
      else
      {
        *place = static_cast<unsigned char>(std::lround(value * steps / 255.0));
      }
    }
  }
  return codes;
}

/// Adds or subtracts a code, modulo its range.
void Combine(unsigned char* code, const unsigned char* other, bool areHalves, int sign)
{
  if (areHalves)
  {
    const int sum = LoadNumber<std::uint16_t>(code) + sign * LoadNumber<std::uint16_t>(other);
    StoreNumber(static_cast<std::uint16_t>(sum), code);
  }
  else
  {
    *code = static_cast<unsigned char>(*code + sign * *other);
  }
}

void AddColors(vtkPolyData* triangles, GeometryStreams& streams)
{
  const PointColorArrays colors = FindPointColors(triangles);
  streams.AreHalves = colors.Front && colors.Front->GetDataType() != VTK_UNSIGNED_CHAR;
  streams.HasFlags = colors.Exact != nullptr;
  for (std::size_t i = 0; colors.Exact && i < FlagsSize * streams.Points; ++i)
  {
    const auto point = static_cast<vtkIdType>(i / FlagsSize);
    const double code = i % FlagsSize < 2 ? colors.GetCode(point, i % FlagsSize == 1) : 0.0;
    streams.Flags.push_back(static_cast<unsigned char>(std::clamp(code, 0.0, 255.0)));
  }
  streams.Colors = ListCodes(colors.Front, streams.AreHalves, streams.GetColorSteps());
  streams.BackColors = ListCodes(colors.Back, streams.AreHalves, streams.GetColorSteps());
  const MappedPoints mapped = FindMappedPoints(triangles);
  if (!mapped.IsEmpty() && streams.HasFlags && !streams.AreHalves)
  {
    streams.Maps = MapCodes(mapped);
    for (const SurfaceArray& array : mapped.Arrays)
    {
      streams.Arrays.emplace_back(array);
    }
    streams.Maps.PutLight(mapped, 0, streams.Colors);
    if (!streams.BackColors.empty())
    {
      streams.Maps.PutLight(mapped, 1, streams.BackColors);
    }
  }
}

double GetNumber(vtkPolyData* geometry, const char* name)
{
  vtkDataArray* array = geometry->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() == 1 ? array->GetTuple1(0) : -1.0;
}

void AddNumber(const JSON& header, const char* key, const char* name, vtkPolyData* geometry)
{
  if (header.contains(key))
  {
    const double number = header.at(key).get<double>();
    RequireSound(number >= 0.0);
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(number);
    geometry->GetFieldData()->AddArray(array);
  }
}

vtkSmartPointer<vtkDataArray> DecodeColors(
  const char* name, const std::vector<unsigned char>& codes, bool areHalves, double steps)
{
  const std::size_t size = GetCodeSize(areHalves);
  auto colors =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(areHalves ? VTK_FLOAT : VTK_UNSIGNED_CHAR));
  colors->SetName(name);
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(codes.size() / (4 * size)));
  for (std::size_t value = 0; value < codes.size() / size; ++value)
  {
    const unsigned char* place = &codes[size * value];
    colors->SetComponent(static_cast<vtkIdType>(value / 4), static_cast<int>(value % 4),
      areHalves ? glm::unpackHalf1x16(LoadNumber<std::uint16_t>(place))
                : std::round(std::min<double>(*place, steps) * 255.0 / steps));
  }
  return colors;
}

/// Mapped points get their scalars and light, and the colours that these have.
void AddMaps(const GeometryStreams& streams, vtkPolyData* geometry)
{
  if (streams.Maps.IsEmpty())
  {
    return;
  }
  MapCodes codes = streams.Maps;
  codes.Points.insert(codes.Points.end(), streams.BodyPlaces.begin(), streams.BodyPlaces.end());
  MappedPoints mapped = codes.GetPoints(streams.Colors, streams.BackColors);
  for (std::size_t i = 0; i < streams.Arrays.size(); ++i)
  {
    ArrayCodes array = streams.Arrays[i];
    array.Points.insert(
      array.Points.end(), streams.BodyArrays[i].begin(), streams.BodyArrays[i].end());
    mapped.Arrays.push_back(array.GetArray());
  }
  const SurfaceArray* onImages = mapped.FindTexturePlaces();
  for (std::size_t i = 0; i < mapped.Numbers.size(); ++i)
  {
    RequireSound(!mapped.Has(i) || !mapped.GetMap(i).IsImage() ||
      (onImages && std::isfinite(onImages->Components[0].Values[i]) &&
        std::isfinite(onImages->Components[1].Values[i])));
  }
  AddMappedPoints(mapped, geometry);
  const PointColorArrays arrays = FindPointColors(geometry);
  for (std::size_t i = 0; i < mapped.Numbers.size(); ++i)
  {
    for (const int side : { 0, 1 })
    {
      vtkDataArray* colors = side == 0 ? arrays.Front : arrays.Back;
      if (colors && mapped.Has(i))
      {
        const glm::dvec3 color =
          ShowLight(glm::dvec3(mapped.Light[side][i]), mapped.GetMap(i), mapped.GetPlace(i));
        colors->SetTuple4(
          static_cast<vtkIdType>(i), ToByte(color.x), ToByte(color.y), ToByte(color.z), 255.0);
      }
    }
  }
}
}

GeometryStreams GeometryStreams::Make(vtkPolyData* triangles, const Cube& box, int resolution)
{
  GeometryStreams streams;
  streams.Corners = ListCorners(triangles);
  streams.PositionBits = FindPositionBits(resolution);
  AddPositions(triangles, box, streams);
  AddColors(triangles, streams);
  streams.BodyArrays.resize(streams.Arrays.size());
  return streams;
}

void GeometryStreams::TakeBodies(vtkPolyData* geometry, vtkPolyData* triangles, const Cube& box)
{
  if (this->AreHalves)
  {
    return;
  }
  PointCodes codes{ std::move(this->Colors), std::move(this->BackColors), std::move(this->Flags) };
  this->Bodies =
    BodyGroups::Take(geometry, triangles, box, this->PositionBits, this->GetColorSteps(), codes);
  this->Points -= this->Bodies.CountPoints();
  this->Positions.resize(PositionSize * this->Points);
  const auto divide = [this](std::vector<unsigned char>& points, std::size_t size)
  {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(size * this->Points);
    std::vector<unsigned char> ofBodies(first, points.end());
    points.erase(first, points.end());
    return ofBodies;
  };
  if (!this->Maps.IsEmpty())
  {
    this->BodyPlaces = divide(this->Maps.Points, MapCodes::PointSize);
  }
  this->BodyArrays.clear();
  for (ArrayCodes& array : this->Arrays)
  {
    this->BodyArrays.push_back(divide(array.Points, array.GetPointSize()));
  }
  this->Corners.resize(this->Corners.size() - 3 * this->Bodies.CountTriangles());
  for (std::vector<unsigned char>* stream : { &codes.Colors, &codes.BackColors, &codes.Flags })
  {
    stream->resize(stream->empty() ? 0 : 4 * this->Points);
  }
  this->Colors = std::move(codes.Colors);
  this->BackColors = std::move(codes.BackColors);
  this->Flags = std::move(codes.Flags);
}

JSON GeometryStreams::Describe(vtkPolyData* geometry) const
{
  JSON header = { { "points", this->Points }, { "triangles", this->Corners.size() / 3 },
    { "position_bits", this->PositionBits },
    { "position_bounds",
      { this->Low.x, this->Low.y, this->Low.z, this->High.x, this->High.y, this->High.z } } };
  if (FindPointColors(geometry).Front)
  {
    header["colors"] = this->AreHalves ? HalfColors
      : !this->Maps.IsEmpty()          ? MappedColors
      : this->HasFlags                 ? ExactByteColors
                                       : ByteColors;
  }
  if (!this->Maps.IsEmpty())
  {
    this->Maps.Describe(header);
    for (const ArrayCodes& array : this->Arrays)
    {
      header[ArraysKey].push_back(array.Describe());
    }
  }
  if (!this->Bodies.IsEmpty())
  {
    header["bodies"] = this->Bodies.Describe();
  }
  const double error = GetNumber(geometry, GeometryErrorName);
  const double loss = GetNumber(geometry, GeometryLossName);
  const double opaqueLoss = GetNumber(geometry, GeometryOpaqueLossName);
  if (error >= 0.0)
  {
    header["error"] = error;
  }
  if (loss >= 0.0)
  {
    header["loss"] = loss;
  }
  if (opaqueLoss >= 0.0)
  {
    header["opaque_loss"] = opaqueLoss;
  }
  auto* scene =
    vtkStringArray::SafeDownCast(geometry->GetFieldData()->GetAbstractArray(GeometrySceneName));
  if (scene && scene->GetNumberOfValues() == 1)
  {
    header["scene"] = scene->GetValue(0);
  }
  return header;
}

vtkSmartPointer<vtkPolyData> GeometryStreams::ToPolyData(const JSON& header, const Cube& box) const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points));
  for (std::size_t point = 0; point < this->Points; ++point)
  {
    glm::dvec3 pointCC;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto step =
        LoadNumber<std::uint16_t>(&this->Positions[PositionSize * point + 2 * axis]);
      RequireSound(step <= this->GetPositionSteps());
      pointCC[axis] = glm::mix(this->Low[axis], this->High[axis], step / this->GetPositionSteps());
    }
    const glm::dvec3 place = box.PointToWorld(pointCC);
    points->SetPoint(static_cast<vtkIdType>(point), place.x, place.y, place.z);
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < this->Corners.size(); i += 3)
  {
    triangles->InsertNextCell({ this->Corners[i], this->Corners[i + 1], this->Corners[i + 2] });
  }
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  geometry->SetPoints(points);
  geometry->SetPolys(triangles);
  this->Bodies.Append(box, geometry);
  if (!this->Colors.empty())
  {
    geometry->GetPointData()->SetScalars(
      DecodeColors(ColorName, this->Colors, this->AreHalves, this->GetColorSteps()));
  }
  if (!this->BackColors.empty())
  {
    geometry->GetPointData()->AddArray(
      DecodeColors(BackColorName, this->BackColors, this->AreHalves, this->GetColorSteps()));
  }
  AddMaps(*this, geometry);
  if (!this->Flags.empty())
  {
    vtkNew<vtkUnsignedCharArray> exact;
    exact->SetName(ExactColorName);
    exact->SetNumberOfComponents(2);
    for (std::size_t point = 0; point < this->Flags.size() / FlagsSize; ++point)
    {
      exact->InsertNextTuple2(this->Flags[FlagsSize * point], this->Flags[FlagsSize * point + 1]);
    }
    geometry->GetPointData()->AddArray(exact);
  }
  AddNumber(header, "error", GeometryErrorName, geometry);
  AddNumber(header, "loss", GeometryLossName, geometry);
  AddNumber(header, "opaque_loss", GeometryOpaqueLossName, geometry);
  if (header.contains("scene"))
  {
    vtkNew<vtkStringArray> scene;
    scene->SetName(GeometrySceneName);
    scene->InsertNextValue(header.at("scene").get<std::string>());
    geometry->GetFieldData()->AddArray(scene);
  }
  return geometry;
}

void CombineCodes(std::vector<unsigned char>& codes, const std::vector<unsigned char>& others,
  bool areHalves, int sign)
{
  for (std::size_t i = 0; i < codes.size(); i += GetCodeSize(areHalves))
  {
    Combine(&codes[i], &others[i], areHalves, sign);
  }
}

void CombineWithGreen(std::vector<unsigned char>& codes, bool areHalves, int sign)
{
  const std::size_t size = GetCodeSize(areHalves);
  for (std::size_t red = 0; red < codes.size(); red += 4 * size)
  {
    const std::size_t green = red + size;
    Combine(&codes[red], &codes[green], areHalves, sign);
    Combine(&codes[green + size], &codes[green], areHalves, sign);
  }
}

void RequireSound(bool condition)
{
  if (!condition)
  {
    throw std::invalid_argument("its data is damaged");
  }
}
}
