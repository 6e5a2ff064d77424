// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryCodec.h"

#include "cslfGeometryStreams.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfJSONText.h"

#include <vtkPolyData.h>

#include <meshoptimizer.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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
using Streams = GeometryStreams;

/// More are refused, so that a file cannot ask for much memory.
constexpr std::size_t MaximumItems = std::size_t(1) << 25;

/// What is subtracted from colours, so that they take fewer bytes: from red and blue their green,
/// and from backs their fronts.
constexpr const char* Green = "green";
constexpr const char* Front = "front";

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
    for (ArrayCodes& array : streams.Arrays)
    {
      array.Points.clear();
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
  for (ArrayCodes& array : streams.Arrays)
  {
    move(array.Points, array.GetPointSize());
  }
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
  CombineCodes(differences, streams.Colors, streams.AreHalves, -1);
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

/// The coded streams of a part, besides arrays, bodies and the colours of maps.
constexpr std::size_t Parts = 7;

///@{
/// The bytes of the streams of an array: of the points that are not those of bodies, and of these.
constexpr const char* ArrayBytesKey = "bytes";
constexpr const char* BodyBytesKey = "body_bytes";
///@}

/// More arrays are refused, so that a file cannot ask for much memory.
constexpr std::size_t MaximumArrays = 1024;

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
  JSON header = streams.Describe(geometry);
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
  for (std::size_t i = 0; i < streams.Arrays.size(); ++i)
  {
    const std::size_t size = streams.Arrays[i].GetPointSize();
    const std::vector<unsigned char>& ofBodies = streams.BodyArrays[i];
    const std::vector<unsigned char> coded[2] = { CodeVertices(
                                                    streams.Arrays[i].Points, streams.Points, size),
      CodeVertices(ofBodies, ofBodies.size() / size, size) };
    header[ArraysKey][i][ArrayBytesKey] = coded[0].size();
    header[ArraysKey][i][BodyBytesKey] = coded[1].size();
    for (const std::vector<unsigned char>& part : coded)
    {
      all.insert(all.end(), part.begin(), part.end());
    }
  }
  const std::vector<unsigned char> bodies = streams.Bodies.Pack();
  all.insert(all.end(), bodies.begin(), bodies.end());
  const std::vector<unsigned char> mapColors = streams.Maps.PackColors();
  all.insert(all.end(), mapColors.begin(), mapColors.end());
  const std::string text = header.dump();
  std::vector<unsigned char> bytes(sizeof(std::uint32_t));
  StoreNumber(static_cast<std::uint32_t>(text.size()), bytes.data());
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

vtkSmartPointer<vtkPolyData> Decode(const std::vector<unsigned char>& bytes, const Cube& box)
{
  constexpr std::size_t head = sizeof(std::uint32_t);
  RequireSound(bytes.size() > head);
  const std::size_t textSize = LoadNumber<std::uint32_t>(bytes.data());
  RequireSound(textSize <= bytes.size() - head);
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
  const JSON noArrays = JSON::array();
  const JSON& arrays = header.contains(ArraysKey) ? header.at(ArraysKey) : noArrays;
  RequireSound(arrays.is_array() && arrays.size() <= MaximumArrays);
  std::size_t size = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));
  for (const JSON& array : arrays)
  {
    size += GetCount(array, ArrayBytesKey) + GetCount(array, BodyBytesKey);
  }
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
    RequireSound(bits >= MinimumPositionBits && bits <= MaximumPositionBits);
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
  RequireSound(areMapped || (sizes[5] + sizes[6] == 0 && arrays.empty()));
  const std::size_t mapSize = streams.Maps.GetColorSize();
  RequireSound((points > 0) == (triangles > 0) && (points > 0 || !streams.Bodies.IsEmpty()));
  RequireSound(size + bodySize + mapSize <= mostGrowth * (rest + 1) && triangles <= sizes[0]);
  // The encoder drops points that no triangle uses.
  RequireSound(points <= 3 * triangles);
  const auto canHold = [&](std::size_t stream, std::size_t pointSize)
  { return points * pointSize <= mostPerByte * stream; };
  RequireSound(canHold(sizes[1], PositionSize));
  if (header.contains("position_bounds"))
  {
    const auto bounds = header.at("position_bounds").get<std::array<double, 6>>();
    for (int axis = 0; axis < 3; ++axis)
    {
      streams.Low[axis] = bounds[axis];
      streams.High[axis] = bounds[axis + 3];
      RequireSound(
        -1.0 <= bounds[axis] && bounds[axis] <= bounds[axis + 3] && bounds[axis + 3] <= 1.0);
    }
  }
  const std::vector<unsigned char> coded = Uncompress(
    bytes.data() + head + textSize, rest, static_cast<uLongf>(size + bodySize + mapSize));
  streams.Maps.UnpackColors(coded.data() + size + bodySize);
  streams.Bodies.Unpack(coded.data() + size);
  RequireSound(streams.Bodies.IsEmpty() || streams.Bodies.HasColors() == header.contains("colors"));
  streams.Corners.resize(3 * triangles);
  const unsigned char* place = coded.data();
  RequireSound(points == 0 ||
    meshopt_decodeIndexBuffer(
      streams.Corners.data(), streams.Corners.size(), sizeof(unsigned int), place, sizes[0]) == 0);
  RequireSound(std::all_of(streams.Corners.begin(), streams.Corners.end(),
    [&](unsigned int corner) { return corner < streams.Points; }));
  place += sizes[0];
  const auto decodeSome = [&](std::vector<unsigned char>& stream, std::size_t some,
                            std::size_t pointSize, std::size_t count)
  {
    RequireSound(some * pointSize <= mostPerByte * count);
    stream.resize(pointSize * some);
    RequireSound(
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
    RequireSound(!areMapped || streams.HasFlags);
    RequireSound(kind ==
      (streams.AreHalves     ? HalfColors
          : areMapped        ? MappedColors
          : streams.HasFlags ? ExactByteColors
                             : ByteColors));
    RequireSound(streams.Bodies.IsEmpty() ||
      (!streams.AreHalves && streams.HasFlags == streams.Bodies.HasExactColors()));
    const std::set<std::string> subtracted =
      header.value("subtracted", std::set<std::string>{ Front });
    RequireSound(std::all_of(subtracted.begin(), subtracted.end(),
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
        CombineCodes(codes.BackColors, codes.Colors, streams.AreHalves, 1);
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
      for (const JSON& array : arrays)
      {
        ArrayCodes codesOfArray = ArrayCodes::Read(array);
        const std::size_t pointSize = codesOfArray.GetPointSize();
        decodePoints(codesOfArray.Points, pointSize, GetCount(array, ArrayBytesKey));
        decodeSome(streams.BodyArrays.emplace_back(), streams.Bodies.CountPoints(), pointSize,
          GetCount(array, BodyBytesKey));
        streams.Arrays.push_back(std::move(codesOfArray));
      }
    }
    const bool hasBack = sizes[3] > 0 || streams.Bodies.HasBackColors();
    RequireSound(points == 0 || streams.Bodies.IsEmpty() ||
      (hasBack == (sizes[3] > 0) && streams.HasFlags == (sizes[4] > 0)));
    streams.Bodies.AddCodes(streams.GetColorSteps(), hasBack, codes);
    streams.Colors = std::move(codes.Colors);
    streams.BackColors = std::move(codes.BackColors);
    streams.Flags = std::move(codes.Flags);
  }
  return streams.ToPolyData(header, box);
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
    Streams streams = Streams::Make(triangles, box, resolution);
    Streams apart = streams;
    apart.TakeBodies(geometry, triangles, box);
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
