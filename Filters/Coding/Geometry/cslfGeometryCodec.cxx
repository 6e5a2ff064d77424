// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryCodec.h"

#include "cslfBodyGroups.h"
#include "cslfMapCodes.h"

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
#include <glm/vec3.hpp>

#include <meshoptimizer.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

/// The limits of the bits of a coordinate. Files that do not state them have the most.
constexpr int MaximumPositionBits = 16;
constexpr int MinimumPositionBits = 12;

/// The fewest steps of coordinates in a texel's width, which is the cube's edge divided by the
/// resolution, unless that needs more bits than there are.
constexpr int StepsOfTexel = 64;

/// Colours of bytes have this many steps: fewer if they are only for what no viewpoint sees.
constexpr int ExactSteps = 255;
constexpr int ColorSteps = 63;

/// The flags of exact colours, with padding.
constexpr std::size_t FlagsSize = 4;

/// Three coordinates and padding.
constexpr std::size_t PositionSize = 8;

/// More are refused, so that a file cannot ask for much memory.
constexpr std::size_t MaximumItems = std::size_t(1) << 25;

constexpr const char* ByteColors = "srgb6";
constexpr const char* ExactByteColors = "srgb8";
constexpr const char* HalfColors = "linear16f";
constexpr const char* MappedColors = "light8"; ///< as srgb8, but those of mapped points are light

/// What is subtracted from colours, so that they take fewer bytes: from red and blue their green,
/// and from backs their fronts.
constexpr const char* Green = "green";
constexpr const char* Front = "front";

/// The bytes of a colour's component.
constexpr std::size_t GetCodeSize(bool areHalves)
{
  return areHalves ? sizeof(std::uint16_t) : 1;
}

/// The streams of a geometry before and after they are compressed.
struct Streams
{
  std::size_t Points = 0;
  std::vector<unsigned int> Corners;
  int PositionBits = MaximumPositionBits;
  glm::dvec3 Low{ -1.0 }; ///< the bounds of the positions in CC, which are exact
  glm::dvec3 High{ 1.0 };
  std::vector<unsigned char> Positions;
  std::vector<unsigned char> Colors;     ///< none if the geometry has none
  std::vector<unsigned char> BackColors; ///< none without others
  std::vector<unsigned char> Flags;      ///< none if no colour is exact
  bool AreHalves = false;
  bool HasFlags = false;
  BodyGroups Bodies;                     ///< their points and triangles come after the others
  MapCodes Maps;                         ///< with the points that are not those of bodies
  std::vector<unsigned char> BodyPlaces; ///< the others, as in MapCodes

  int GetColorSteps() const { return this->HasFlags ? ExactSteps : ColorSteps; }
  std::size_t GetColorSize() const { return 4 * GetCodeSize(this->AreHalves); }
  double GetPositionSteps() const { return (1 << this->PositionBits) - 1; }
};

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

template <typename Value>
void Store(Value value, unsigned char* place)
{
  // Little-endian on all machines.
  for (std::size_t byte = 0; byte < sizeof(Value); ++byte)
  {
    place[byte] = static_cast<unsigned char>(value >> (8 * byte));
  }
}

template <typename Value>
Value Load(const unsigned char* place)
{
  Value value = 0;
  for (std::size_t byte = 0; byte < sizeof(Value); ++byte)
  {
    value = static_cast<Value>(value | static_cast<Value>(place[byte]) << (8 * byte));
  }
  return value;
}

/// Of the points that triangles use, which lie in the cube.
void AddPositions(vtkPolyData* triangles, const Cube& box, Streams& streams)
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
      Store(static_cast<std::uint16_t>(std::round(share * streams.GetPositionSteps())),
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
        Store(glm::packHalf1x16(static_cast<float>(value)), place);
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
    const int sum = Load<std::uint16_t>(code) + sign * Load<std::uint16_t>(other);
    Store(static_cast<std::uint16_t>(sum), code);
  }
  else
  {
    *code = static_cast<unsigned char>(*code + sign * *other);
  }
}

/// Adds or subtracts the codes of other colours.
void Combine(std::vector<unsigned char>& codes, const std::vector<unsigned char>& others,
  bool areHalves, int sign)
{
  for (std::size_t i = 0; i < codes.size(); i += GetCodeSize(areHalves))
  {
    Combine(&codes[i], &others[i], areHalves, sign);
  }
}

/// Adds green to red and blue, or subtracts it.
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

void AddColors(vtkPolyData* triangles, Streams& streams)
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
    streams.Maps.PutLight(mapped, 0, streams.Colors);
    if (!streams.BackColors.empty())
    {
      streams.Maps.PutLight(mapped, 1, streams.BackColors);
    }
  }
}

/// Takes the bodies that are one mesh at several places out of the streams. The colours of floats
/// have no such form.
void TakeBodies(vtkPolyData* geometry, vtkPolyData* triangles, const Cube& box, Streams& streams)
{
  if (streams.AreHalves)
  {
    return;
  }
  PointCodes codes{ std::move(streams.Colors), std::move(streams.BackColors),
    std::move(streams.Flags) };
  streams.Bodies = BodyGroups::Take(
    geometry, triangles, box, streams.PositionBits, streams.GetColorSteps(), codes);
  streams.Points -= streams.Bodies.CountPoints();
  streams.Positions.resize(PositionSize * streams.Points);
  if (!streams.Maps.IsEmpty())
  {
    std::vector<unsigned char>& places = streams.Maps.Points;
    const auto first =
      places.begin() + static_cast<std::ptrdiff_t>(MapCodes::PointSize * streams.Points);
    streams.BodyPlaces.assign(first, places.end());
    places.erase(first, places.end());
  }
  streams.Corners.resize(streams.Corners.size() - 3 * streams.Bodies.CountTriangles());
  for (std::vector<unsigned char>* stream : { &codes.Colors, &codes.BackColors, &codes.Flags })
  {
    stream->resize(stream->empty() ? 0 : 4 * streams.Points);
  }
  streams.Colors = std::move(codes.Colors);
  streams.BackColors = std::move(codes.BackColors);
  streams.Flags = std::move(codes.Flags);
}

/// The codecs need triangles and points in an order of use. Drops unused points.
void Sort(Streams& streams)
{
  if (streams.Corners.empty())
  {
    streams.Points = 0;
    for (std::vector<unsigned char>* stream : { &streams.Positions, &streams.Colors,
           &streams.BackColors, &streams.Flags, &streams.Maps.Points })
    {
      stream->clear();
    }
    return;
  }
  std::vector<unsigned int> sorted(streams.Corners.size());
  meshopt_optimizeVertexCacheStrip(
    sorted.data(), streams.Corners.data(), sorted.size(), streams.Points);
  std::vector<unsigned int> numbers(streams.Points);
  const std::size_t used =
    meshopt_optimizeVertexFetchRemap(numbers.data(), sorted.data(), sorted.size(), streams.Points);
  meshopt_remapIndexBuffer(streams.Corners.data(), sorted.data(), sorted.size(), numbers.data());
  const auto move = [&](std::vector<unsigned char>& stream, std::size_t size)
  {
    if (!stream.empty())
    {
      std::vector<unsigned char> moved(size * used);
      meshopt_remapVertexBuffer(moved.data(), stream.data(), streams.Points, size, numbers.data());
      stream = std::move(moved);
    }
  };
  move(streams.Positions, PositionSize);
  move(streams.Colors, streams.GetColorSize());
  move(streams.BackColors, streams.GetColorSize());
  move(streams.Flags, FlagsSize);
  move(streams.Maps.Points, MapCodes::PointSize);
  streams.Points = used;
}

std::vector<unsigned char> CodeVertices(
  const std::vector<unsigned char>& stream, std::size_t count, std::size_t size)
{
  meshopt_encodeVertexVersion(0);
  std::vector<unsigned char> coded(
    stream.empty() ? 0 : meshopt_encodeVertexBufferBound(count, size));
  if (!stream.empty())
  {
    coded.resize(
      meshopt_encodeVertexBuffer(coded.data(), coded.size(), stream.data(), count, size));
  }
  return coded;
}

std::vector<unsigned char> CodeColors(const Streams& streams, std::vector<unsigned char> colors)
{
  CombineWithGreen(colors, streams.AreHalves, -1);
  return CodeVertices(colors, streams.Points, streams.GetColorSize());
}

/// Codes the colours of the back less those of the front.
std::vector<unsigned char> CodeColorDifferences(const Streams& streams)
{
  std::vector<unsigned char> differences = streams.BackColors;
  Combine(differences, streams.Colors, streams.AreHalves, -1);
  return CodeColors(streams, std::move(differences));
}

std::vector<unsigned char> CodeCorners(const Streams& streams)
{
  if (streams.Corners.empty())
  {
    return {};
  }
  // The version of EXT_meshopt_compression.
  meshopt_encodeIndexVersion(1);
  std::vector<unsigned char> coded(
    meshopt_encodeIndexBufferBound(streams.Corners.size(), streams.Points));
  coded.resize(meshopt_encodeIndexBuffer(
    coded.data(), coded.size(), streams.Corners.data(), streams.Corners.size()));
  return coded;
}

void Require(bool condition)
{
  if (!condition)
  {
    throw std::invalid_argument("its data is damaged");
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
    Require(number >= 0.0);
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(number);
    geometry->GetFieldData()->AddArray(array);
  }
}

JSON DescribeGeometry(vtkPolyData* geometry, const Streams& streams)
{
  JSON header = { { "points", streams.Points }, { "triangles", streams.Corners.size() / 3 },
    { "position_bits", streams.PositionBits },
    { "position_bounds",
      { streams.Low.x, streams.Low.y, streams.Low.z, streams.High.x, streams.High.y,
        streams.High.z } } };
  if (FindPointColors(geometry).Front)
  {
    header["colors"] = streams.AreHalves ? HalfColors
      : !streams.Maps.IsEmpty()          ? MappedColors
      : streams.HasFlags                 ? ExactByteColors
                                         : ByteColors;
  }
  if (!streams.Maps.IsEmpty())
  {
    streams.Maps.Describe(header);
  }
  if (!streams.Bodies.IsEmpty())
  {
    header["bodies"] = streams.Bodies.Describe();
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

std::vector<unsigned char> Compress(const std::vector<unsigned char>& bytes)
{
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> compressed(size);
  if (compress2(compressed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()),
        Z_BEST_COMPRESSION) != Z_OK)
  {
    throw std::runtime_error("it cannot be compressed");
  }
  compressed.resize(size);
  return compressed;
}

/// The coded streams of a part, besides bodies and the colours of maps.
constexpr std::size_t Parts = 7;

/// The bytes of the part.
std::vector<unsigned char> Pack(vtkPolyData* geometry, Streams& streams)
{
  Sort(streams);
  std::array<std::vector<unsigned char>, Parts> parts = { CodeCorners(streams),
    CodeVertices(streams.Positions, streams.Points, PositionSize),
    CodeColors(streams, streams.Colors), CodeColors(streams, streams.BackColors),
    CodeVertices(streams.Flags, streams.Points, FlagsSize),
    CodeVertices(streams.Maps.Points, streams.Points, MapCodes::PointSize),
    CodeVertices(
      streams.BodyPlaces, streams.BodyPlaces.size() / MapCodes::PointSize, MapCodes::PointSize) };
  std::vector<unsigned char> differences = CodeColorDifferences(streams);
  JSON subtracted = { Green };
  if (differences.size() < parts[3].size())
  {
    parts[3] = std::move(differences);
    subtracted.push_back(Front);
  }
  JSON header = DescribeGeometry(geometry, streams);
  if (!parts[2].empty())
  {
    header["subtracted"] = subtracted;
  }
  header["corner_bytes"] = parts[0].size();
  header["position_bytes"] = parts[1].size();
  header["color_bytes"] = parts[2].size();
  if (!parts[3].empty())
  {
    header["back_color_bytes"] = parts[3].size();
  }
  if (!parts[4].empty())
  {
    header["exact_bytes"] = parts[4].size();
  }
  if (!streams.Maps.IsEmpty())
  {
    header["place_bytes"] = parts[5].size();
    header["body_place_bytes"] = parts[6].size();
  }
  std::vector<unsigned char> all;
  for (const std::vector<unsigned char>& part : parts)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  const std::vector<unsigned char> bodies = streams.Bodies.Pack();
  all.insert(all.end(), bodies.begin(), bodies.end());
  const std::vector<unsigned char> mapColors = streams.Maps.PackColors();
  all.insert(all.end(), mapColors.begin(), mapColors.end());
  const std::string text = header.dump();
  std::vector<unsigned char> bytes(sizeof(std::uint32_t));
  Store(static_cast<std::uint32_t>(text.size()), bytes.data());
  std::copy(text.begin(), text.end(), std::back_inserter(bytes));
  const std::vector<unsigned char> compressed = Compress(all);
  bytes.insert(bytes.end(), compressed.begin(), compressed.end());
  return bytes;
}

/// The size of a stream in the header, within limits.
std::size_t GetCount(const JSON& header, const char* key)
{
  const JSON& number = header.at(key);
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() > MaximumItems)
  {
    throw std::invalid_argument(std::string("its number of ") + key + " is invalid");
  }
  return number.get<std::size_t>();
}

std::vector<unsigned char> Uncompress(const unsigned char* bytes, std::size_t size, uLongf raw)
{
  std::vector<unsigned char> result(raw);
  uLongf count = raw;
  if (uncompress(result.data(), &count, bytes, static_cast<uLong>(size)) != Z_OK || count != raw)
  {
    throw std::invalid_argument("its data is damaged");
  }
  return result;
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
      areHalves ? glm::unpackHalf1x16(Load<std::uint16_t>(place))
                : std::round(std::min<double>(*place, steps) * 255.0 / steps));
  }
  return colors;
}

/// Mapped points get their scalars and light, and the colours that these have.
void AddMaps(const Streams& streams, vtkPolyData* geometry)
{
  if (streams.Maps.IsEmpty())
  {
    return;
  }
  MapCodes codes = streams.Maps;
  codes.Points.insert(codes.Points.end(), streams.BodyPlaces.begin(), streams.BodyPlaces.end());
  const MappedPoints mapped = codes.GetPoints(streams.Colors, streams.BackColors);
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

vtkSmartPointer<vtkPolyData> ToPolyData(const Streams& streams, const JSON& header, const Cube& box)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(streams.Points));
  for (std::size_t point = 0; point < streams.Points; ++point)
  {
    glm::dvec3 pointCC;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto step = Load<std::uint16_t>(&streams.Positions[PositionSize * point + 2 * axis]);
      Require(step <= streams.GetPositionSteps());
      pointCC[axis] =
        glm::mix(streams.Low[axis], streams.High[axis], step / streams.GetPositionSteps());
    }
    const glm::dvec3 place = box.PointToWorld(pointCC);
    points->SetPoint(static_cast<vtkIdType>(point), place.x, place.y, place.z);
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < streams.Corners.size(); i += 3)
  {
    triangles->InsertNextCell(
      { streams.Corners[i], streams.Corners[i + 1], streams.Corners[i + 2] });
  }
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  geometry->SetPoints(points);
  geometry->SetPolys(triangles);
  streams.Bodies.Append(box, geometry);
  if (!streams.Colors.empty())
  {
    geometry->GetPointData()->SetScalars(
      DecodeColors(ColorName, streams.Colors, streams.AreHalves, streams.GetColorSteps()));
  }
  if (!streams.BackColors.empty())
  {
    geometry->GetPointData()->AddArray(
      DecodeColors(BackColorName, streams.BackColors, streams.AreHalves, streams.GetColorSteps()));
  }
  AddMaps(streams, geometry);
  if (!streams.Flags.empty())
  {
    vtkNew<vtkUnsignedCharArray> exact;
    exact->SetName(ExactColorName);
    exact->SetNumberOfComponents(2);
    for (std::size_t point = 0; point < streams.Flags.size() / FlagsSize; ++point)
    {
      exact->InsertNextTuple2(
        streams.Flags[FlagsSize * point], streams.Flags[FlagsSize * point + 1]);
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

vtkSmartPointer<vtkPolyData> Decode(const std::vector<unsigned char>& bytes, const Cube& box)
{
  constexpr std::size_t head = sizeof(std::uint32_t);
  Require(bytes.size() > head);
  const std::size_t textSize = Load<std::uint32_t>(bytes.data());
  Require(textSize <= bytes.size() - head);
  const auto begin = bytes.begin() + head;
  const auto end = begin + static_cast<std::ptrdiff_t>(textSize);
  const JSON header = ParseJSON(std::string(begin, end));
  const std::size_t points = GetCount(header, "points");
  const std::size_t triangles = GetCount(header, "triangles");
  const auto getSize = [&](const char* key)
  { return header.contains(key) ? GetCount(header, key) : std::size_t(0); };
  const std::array<std::size_t, Parts> sizes = { GetCount(header, "corner_bytes"),
    GetCount(header, "position_bytes"), GetCount(header, "color_bytes"),
    getSize("back_color_bytes"), getSize("exact_bytes"), getSize("place_bytes"),
    getSize("body_place_bytes") };
  const std::size_t size = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));
  const std::size_t rest = bytes.size() - head - textSize;
  // Few bytes cannot ask for many: deflate has a limit, a triangle takes at least a byte, and 64
  // equal bytes of points take at least one.
  constexpr std::size_t mostGrowth = 1100;
  constexpr std::size_t mostPerByte = 64;
  Streams streams;
  streams.Points = points;
  if (header.contains("position_bits"))
  {
    const std::size_t bits = GetCount(header, "position_bits");
    Require(bits >= MinimumPositionBits && bits <= MaximumPositionBits);
    streams.PositionBits = static_cast<int>(bits);
  }
  if (header.contains("bodies"))
  {
    streams.Bodies = BodyGroups::Read(
      header.at("bodies"), streams.PositionBits, MaximumItems, mostGrowth * (rest + 1));
  }
  const std::size_t bodySize = streams.Bodies.GetSize();
  const bool areMapped = header.value("colors", std::string()) == MappedColors;
  if (areMapped)
  {
    streams.Maps = MapCodes::Read(header);
  }
  Require(areMapped || sizes[5] + sizes[6] == 0);
  const std::size_t mapSize = streams.Maps.GetColorSize();
  Require((points > 0) == (triangles > 0) && (points > 0 || !streams.Bodies.IsEmpty()));
  Require(size + bodySize + mapSize <= mostGrowth * (rest + 1) && triangles <= sizes[0]);
  // The encoder drops points that no triangle uses.
  Require(points <= 3 * triangles);
  const auto canHold = [&](std::size_t stream, std::size_t pointSize)
  { return points * pointSize <= mostPerByte * stream; };
  Require(canHold(sizes[1], PositionSize));
  if (header.contains("position_bounds"))
  {
    const auto bounds = header.at("position_bounds").get<std::array<double, 6>>();
    for (int axis = 0; axis < 3; ++axis)
    {
      streams.Low[axis] = bounds[axis];
      streams.High[axis] = bounds[axis + 3];
      Require(-1.0 <= bounds[axis] && bounds[axis] <= bounds[axis + 3] && bounds[axis + 3] <= 1.0);
    }
  }
  const std::vector<unsigned char> coded = Uncompress(
    bytes.data() + head + textSize, rest, static_cast<uLongf>(size + bodySize + mapSize));
  streams.Maps.UnpackColors(coded.data() + size + bodySize);
  streams.Bodies.Unpack(coded.data() + size);
  Require(streams.Bodies.IsEmpty() || streams.Bodies.HasColors() == header.contains("colors"));
  streams.Corners.resize(3 * triangles);
  const unsigned char* place = coded.data();
  Require(points == 0 ||
    meshopt_decodeIndexBuffer(
      streams.Corners.data(), streams.Corners.size(), sizeof(unsigned int), place, sizes[0]) == 0);
  Require(std::all_of(streams.Corners.begin(), streams.Corners.end(),
    [&](unsigned int corner) { return corner < streams.Points; }));
  place += sizes[0];
  const auto decodeSome = [&](std::vector<unsigned char>& stream, std::size_t some,
                            std::size_t pointSize, std::size_t count)
  {
    Require(some * pointSize <= mostPerByte * count);
    stream.resize(pointSize * some);
    Require(
      some == 0 || meshopt_decodeVertexBuffer(stream.data(), some, pointSize, place, count) == 0);
    place += count;
  };
  const auto decodePoints = [&](std::vector<unsigned char>& stream, std::size_t pointSize,
                              std::size_t count) { decodeSome(stream, points, pointSize, count); };
  decodePoints(streams.Positions, PositionSize, sizes[1]);
  if (header.contains("colors"))
  {
    const auto kind = header.at("colors").get<std::string>();
    streams.AreHalves = kind == HalfColors;
    streams.HasFlags = sizes[4] > 0 || streams.Bodies.HasExactColors();
    Require(!areMapped || streams.HasFlags);
    Require(kind ==
      (streams.AreHalves     ? HalfColors
          : areMapped        ? MappedColors
          : streams.HasFlags ? ExactByteColors
                             : ByteColors));
    Require(streams.Bodies.IsEmpty() ||
      (!streams.AreHalves && streams.HasFlags == streams.Bodies.HasExactColors()));
    const std::set<std::string> subtracted =
      header.value("subtracted", std::set<std::string>{ Front });
    Require(std::all_of(subtracted.begin(), subtracted.end(),
      [](const std::string& what) { return what == Green || what == Front; }));
    PointCodes codes;
    const auto decode = [&](std::vector<unsigned char>& colors, std::size_t count)
    {
      decodePoints(colors, streams.GetColorSize(), count);
      if (subtracted.count(Green) > 0)
      {
        CombineWithGreen(colors, streams.AreHalves, 1);
      }
    };
    decode(codes.Colors, sizes[2]);
    if (sizes[3] > 0)
    {
      decode(codes.BackColors, sizes[3]);
      if (subtracted.count(Front) > 0)
      {
        Combine(codes.BackColors, codes.Colors, streams.AreHalves, 1);
      }
    }
    if (sizes[4] > 0)
    {
      decodePoints(codes.Flags, FlagsSize, sizes[4]);
    }
    if (areMapped)
    {
      decodePoints(streams.Maps.Points, MapCodes::PointSize, sizes[5]);
      decodeSome(streams.BodyPlaces, streams.Bodies.CountPoints(), MapCodes::PointSize, sizes[6]);
    }
    const bool hasBack = sizes[3] > 0 || streams.Bodies.HasBackColors();
    Require(points == 0 || streams.Bodies.IsEmpty() ||
      (hasBack == (sizes[3] > 0) && streams.HasFlags == (sizes[4] > 0)));
    streams.Bodies.AddCodes(streams.GetColorSteps(), hasBack, codes);
    streams.Colors = std::move(codes.Colors);
    streams.BackColors = std::move(codes.BackColors);
    streams.Flags = std::move(codes.Flags);
  }
  return ToPolyData(streams, header, box);
}
}

std::vector<unsigned char> EncodeGeometry(
  vtkPolyData* geometry, const Cube& box, int resolution, std::string& error)
{
  try
  {
    const std::string fault = DescribeGeometryError(geometry, box);
    if (!fault.empty())
    {
      throw std::invalid_argument(fault);
    }
    const vtkSmartPointer<vtkPolyData> triangles = Triangulate(geometry);
    if (triangles->GetNumberOfPolys() == 0)
    {
      throw std::invalid_argument("the geometry has no triangles");
    }
    Streams streams;
    streams.Corners = ListCorners(triangles);
    streams.PositionBits = FindPositionBits(resolution);
    AddPositions(triangles, box, streams);
    AddColors(triangles, streams);
    Streams apart = streams;
    TakeBodies(geometry, triangles, box, apart);
    std::vector<unsigned char> bytes = Pack(geometry, streams);
    if (!apart.Bodies.IsEmpty())
    {
      // A few bodies may take fewer bytes as triangles.
      std::vector<unsigned char> other = Pack(geometry, apart);
      if (other.size() < bytes.size())
      {
        bytes = std::move(other);
      }
    }
    return bytes;
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
    return {};
  }
}

vtkSmartPointer<vtkPolyData> DecodeGeometry(
  const std::vector<unsigned char>& bytes, const Cube& box, std::string& error)
{
  try
  {
    return Decode(bytes, box);
  }
  catch (const std::exception&)
  {
    error = "its geometry is damaged";
    return nullptr;
  }
}
}
