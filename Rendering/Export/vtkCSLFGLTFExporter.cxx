// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFGLTFExporter.h"

#include "cslfColor.h"
#include "cslfJSON.h"
#include "cslfShownField.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <meshoptimizer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using JSON = nlohmann::json;

// Numbers of glTF 2.0.
constexpr int ShortType = 5122;
constexpr int UnsignedShortType = 5123;
constexpr int UnsignedIntType = 5125;
constexpr int FloatType = 5126;
constexpr int VertexTarget = 34962;
constexpr int IndexTarget = 34963;
constexpr int NearestFilter = 9728;
constexpr int LinearFilter = 9729;
constexpr int MipmapFilter = 9987; // linear, between images as well
constexpr int Repeat = 10497;
constexpr int ClampToEdge = 33071;
constexpr std::uint32_t Magic = 0x46546C67;
constexpr std::uint32_t JSONChunk = 0x4E4F534A;
constexpr std::uint32_t BinaryChunk = 0x004E4942;
constexpr std::uint32_t Version = 2;

constexpr const char* Unlit = "KHR_materials_unlit";
constexpr const char* Quantization = "KHR_mesh_quantization";
constexpr const char* Compression = "EXT_meshopt_compression";

constexpr double MaximumShort = 32767.0;
constexpr double MaximumCode = 65535.0;
/// Compact colours may err by this much, as shares of 1, sRGB-encoded, for more zeros.
constexpr double CompactError = 0.25 / 255.0;
/// Colours of points are used instead of a texture if those between them differ so little from what
/// the map gives, as shares of 1, sRGB-encoded.
constexpr double MaximumError = 2.0 / 255.0;

/// The nearest plane of the camera, as a share of the distance of the farthest.
constexpr double MinimumNear = 0.001;

/// Of a map's two rows in the image, the upper is for values that are not numbers. Between a number
/// and such a value, there is no number from this share of the way on.
constexpr float NumberRow = 1.0f - static_cast<float>(cslf::ColorMap::NanShare);

/// Which triangles of a geometry have points of their own: those in colours of their own, those
/// whose map is an image, given the number of the map, and those with any other map.
constexpr int OwnColors = -2;
constexpr int ColorMaps = -1;

struct Part
{
  std::vector<std::size_t> Points; ///< of the geometry
  std::vector<std::uint32_t> Fronts;
  std::vector<std::uint32_t> Backs; ///< with the opposite winding
  int Kind = OwnColors;

  bool HasMaps() const { return this->Kind != OwnColors; }
};

int FindKind(const cslf::MappedPoints& points, std::size_t point)
{
  if (!points.Has(point))
  {
    return OwnColors;
  }
  return points.GetMap(point).IsImage() ? points.Numbers[point] - 1 : ColorMaps;
}

/// The binary chunk and what the JSON says of it.
class Buffer
{
public:
  Buffer(JSON& gltf, bool isCompact)
    : GLTF(gltf)
    , IsCompact(isCompact)
  {
  }

  const std::string& GetBytes() const { return this->Bytes; }

  /// Adds bytes as they are, and returns the number of their view.
  std::size_t AddView(const std::string& bytes)
  {
    const JSON view = { { "buffer", 0 }, { "byteOffset", this->Append(bytes) },
      { "byteLength", bytes.size() } };
    return this->AddTo("bufferViews", view);
  }

  /// Adds the values of points, of `size` bytes each, a multiple of four.
  std::size_t AddPoints(
    const void* values, std::size_t count, std::size_t size, const JSON& accessor)
  {
    std::string bytes(static_cast<const char*>(values), count * size);
    JSON view = { { "byteStride", size }, { "target", VertexTarget } };
    if (this->IsCompact)
    {
      std::vector<unsigned char> coded(meshopt_encodeVertexBufferBound(count, size));
      meshopt_encodeVertexVersion(0);
      coded.resize(meshopt_encodeVertexBuffer(coded.data(), coded.size(), values, count, size));
      this->Describe(view, bytes.size(), coded, count, size, "ATTRIBUTES");
    }
    return this->AddAccessor(std::move(view), bytes, count, accessor);
  }

  std::size_t AddCorners(const std::vector<std::uint32_t>& corners, std::size_t points)
  {
    const std::size_t size = corners.size() * sizeof(std::uint32_t);
    const std::string bytes(reinterpret_cast<const char*>(corners.data()), size);
    JSON view = { { "target", IndexTarget } };
    if (this->IsCompact)
    {
      std::vector<unsigned char> coded(meshopt_encodeIndexBufferBound(corners.size(), points));
      meshopt_encodeIndexVersion(1);
      coded.resize(
        meshopt_encodeIndexBuffer(coded.data(), coded.size(), corners.data(), corners.size()));
      this->Describe(view, size, coded, corners.size(), sizeof(std::uint32_t), "TRIANGLES");
    }
    return this->AddAccessor(std::move(view), bytes, corners.size(),
      { { "componentType", UnsignedIntType }, { "type", "SCALAR" } });
  }

  /// Adds an object to a list of the JSON, and returns its number there.
  std::size_t AddTo(const char* list, const JSON& object)
  {
    this->GLTF[list].push_back(object);
    return this->GLTF[list].size() - 1;
  }

  /// Describes the buffers.
  void Finish()
  {
    this->GLTF["buffers"] = { { { "byteLength", this->Bytes.size() } } };
    if (this->IsCompact)
    {
      this->GLTF["buffers"].push_back({ { "byteLength", this->FallbackSize },
        { "extensions", { { Compression, { { "fallback", true } } } } } });
    }
  }

private:
  std::size_t Append(const std::string& bytes)
  {
    const std::size_t offset = this->Bytes.size();
    this->Bytes += bytes;
    this->Bytes.resize((this->Bytes.size() + 3) / 4 * 4, '\0');
    return offset;
  }

  /// A view whose bytes are coded. Where they would lie uncoded is in a buffer without bytes.
  void Describe(JSON& view, std::size_t size, const std::vector<unsigned char>& coded,
    std::size_t count, std::size_t stride, const char* mode)
  {
    view["buffer"] = 1;
    view["byteOffset"] = this->FallbackSize;
    view["byteLength"] = size;
    this->FallbackSize += (size + 3) / 4 * 4;
    view["extensions"][Compression] = { { "buffer", 0 },
      { "byteOffset", this->Append({ coded.begin(), coded.end() }) },
      { "byteLength", coded.size() }, { "byteStride", stride }, { "mode", mode },
      { "count", count } };
  }

  std::size_t AddAccessor(JSON view, const std::string& bytes, std::size_t count, JSON accessor)
  {
    if (!this->IsCompact)
    {
      view["buffer"] = 0;
      view["byteOffset"] = this->Append(bytes);
      view["byteLength"] = bytes.size();
    }
    accessor["bufferView"] = this->AddTo("bufferViews", view);
    accessor["count"] = count;
    return this->AddTo("accessors", accessor);
  }

  JSON& GLTF;
  bool IsCompact;
  std::string Bytes;
  std::size_t FallbackSize = 0;
};

/// Fronts of all triangles, and backs of those that are not of closed parts. The triangles of a
/// part, and their points, are in an order that is good for graphics cards and for compression.
Part MakePart(const cslf::GeometryMesh& mesh, int kind)
{
  Part part;
  part.Kind = kind;
  std::vector<std::uint32_t> all[2];
  const auto add = [&](const std::vector<std::uint32_t>& corners, std::size_t closed)
  {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    {
      if (FindKind(mesh.Mapped, corners[i]) == kind)
      {
        all[0].insert(all[0].end(), { corners[i], corners[i + 1], corners[i + 2] });
        if (i >= closed)
        {
          all[1].insert(all[1].end(), { corners[i], corners[i + 2], corners[i + 1] });
        }
      }
    }
  };
  add(mesh.Corners, mesh.ClosedCorners);
  add(mesh.BallCorners, mesh.BallCorners.size());
  const std::size_t count = mesh.PointsCC.size();
  for (std::vector<std::uint32_t>& corners : all)
  {
    if (!corners.empty())
    {
      meshopt_optimizeVertexCache(corners.data(), corners.data(), corners.size(), count);
    }
  }
  std::vector<std::uint32_t> numbers(count, ~0U);
  if (!all[0].empty())
  {
    part.Points.resize(
      meshopt_optimizeVertexFetchRemap(numbers.data(), all[0].data(), all[0].size(), count));
  }
  for (std::size_t point = 0; point < count; ++point)
  {
    if (numbers[point] != ~0U)
    {
      part.Points[numbers[point]] = point;
    }
  }
  for (const int side : { 0, 1 })
  {
    std::vector<std::uint32_t>& corners = side == 0 ? part.Fronts : part.Backs;
    corners.resize(all[side].size());
    std::transform(all[side].begin(), all[side].end(), corners.begin(),
      [&](std::uint32_t corner) { return numbers[corner]; });
  }
  return part;
}

/// The colours of points on a side, or their light, linear.
std::vector<glm::dvec3> ListColors(const cslf::GeometryMesh& mesh, const Part& part, int side)
{
  const std::vector<glm::vec4>& all =
    side == 1 && !mesh.BackColors.empty() ? mesh.BackColors : mesh.Colors;
  std::vector<glm::dvec3> colors;
  colors.reserve(part.Points.size());
  for (const std::size_t point : part.Points)
  {
    glm::dvec3 color(all[point]);
    if (!part.HasMaps())
    {
      color /= std::max(double(all[point].w), 1e-6);
    }
    colors.push_back(part.HasMaps() || !mesh.IsLinear ? cslf::SRGBToLinear(color) : color);
  }
  return colors;
}

/// The code of a linear value from 0 to 1, in compact files one with zeros at its end.
std::uint16_t ToCode(double linear, bool isCompact)
{
  const double exact = MaximumCode * std::clamp(linear, 0.0, 1.0);
  for (int zeros = isCompact ? 12 : 0; zeros > 0; --zeros)
  {
    const double code = std::ldexp(std::round(std::ldexp(exact, -zeros)), zeros);
    if (code <= MaximumCode &&
      std::abs(cslf::LinearToSRGB(code / MaximumCode) - cslf::LinearToSRGB(linear)) <= CompactError)
    {
      return static_cast<std::uint16_t>(code);
    }
  }
  return static_cast<std::uint16_t>(std::lround(exact));
}

/// How a part with maps is shown: by a texture, or by colours of its points.
class MappedPart
{
public:
  MappedPart(const cslf::GeometryMesh& mesh, const cslf::ShownMaps& maps, const Part& part)
    : Kind(part.Kind)
    , Maps(maps)
    , Light{ ListColors(mesh, part, 0), ListColors(mesh, part, 1) }
  {
    const std::vector<glm::vec3> all = maps.ListPlaces(mesh.Mapped);
    for (const std::size_t point : part.Points)
    {
      this->Places.push_back(all[point]);
    }
    this->HasTexture = this->MeasureError(mesh, part) > MaximumError;
    double brightest = 1.0;
    for (const std::vector<glm::dvec3>& side : this->Light)
    {
      for (const glm::dvec3& light : side)
      {
        brightest = std::max({ brightest, light.x, light.y, light.z });
      }
    }
    double lightest = 1e-3;
    const auto addColor = [&lightest](const glm::dvec3& color) {
      lightest = std::max({ lightest, color.x, color.y, color.z });
    };
    if (const cslf::MapImage* image = this->FindImage())
    {
      for (const cslf::MapImage::Pixel& pixel : image->GetPixels())
      {
        addColor(cslf::SRGBToLinear(glm::dvec3(pixel[0], pixel[1], pixel[2]) / 255.0));
      }
    }
    for (std::size_t i = 0; i < maps.GetImage().size() && part.Kind == ColorMaps; ++i)
    {
      const bool isColor = !maps.GetMaps()[i / (2 * maps.GetWidth())].IsImage();
      addColor(isColor ? glm::dvec3(maps.GetImage()[i]) : glm::dvec3(0.0));
    }
    this->Scale = std::clamp(1.0 / lightest, 1.0, brightest);
    this->IsCut = this->HasTexture && brightest > (1.0 + 1e-3) * this->Scale;
  }

  /// Whether the colours between points differ too much from those of the maps.
  bool HasTexture;

  /// What multiplies the texture, and divides the light, because colours of points must not be
  /// above 1.
  double Scale;

  /// Whether some light is above 1 nevertheless.
  bool IsCut;

  /// The image that is the map, or null.
  const cslf::MapImage* FindImage() const
  {
    return this->Kind >= 0 ? this->Maps.GetMaps()[this->Kind].Image.get() : nullptr;
  }

  /// Places on the texture.
  std::vector<glm::vec2> ListTexturePlaces() const
  {
    std::vector<glm::vec2> places;
    places.reserve(this->Places.size());
    const cslf::MapImage* image = this->FindImage();
    for (const glm::vec3& place : this->Places)
    {
      if (image)
      {
        const cslf::MapImage::Layout& layout = image->GetLayout();
        places.emplace_back(place.x / static_cast<float>(layout.Width),
          1.0f - place.y / static_cast<float>(layout.Height));
        continue;
      }
      places.emplace_back(place.x / static_cast<float>(this->Maps.GetWidth()),
        (2.0f * place.z + NumberRow + place.y) / static_cast<float>(this->Maps.GetHeight()));
    }
    return places;
  }

  /// The colours of the points: with a texture, what multiplies that.
  std::vector<glm::dvec3> ListPointColors(int side) const
  {
    std::vector<glm::dvec3> colors;
    colors.reserve(this->Places.size());
    for (std::size_t i = 0; i < this->Places.size(); ++i)
    {
      colors.push_back(this->HasTexture
          ? this->Light[side][i] / this->Scale
          : this->Light[side][i] * this->GetMapColor(this->Places[i]));
    }
    return colors;
  }

private:
  glm::dvec3 GetMapColor(const glm::vec3& place) const
  {
    return glm::dvec3(this->Maps.GetColor(static_cast<std::size_t>(place.z), glm::vec2(place)));
  }

  /// How far the colours at the middles of edges are from the means of their ends, as the root mean
  /// square of sRGB-encoded components, weighted by the triangles' areas.
  double MeasureError(const cslf::GeometryMesh& mesh, const Part& part) const
  {
    double sum = 0.0;
    double weights = 0.0;
    const auto show = [&](const glm::dvec3& light, const glm::vec3& place)
    { return glm::min(light * this->GetMapColor(place), 1.0); };
    for (std::size_t i = 0; i < part.Fronts.size(); ++i)
    {
      const std::size_t corner = part.Fronts[i];
      const std::size_t next = part.Fronts[i - i % 3 + (i + 1) % 3];
      const std::size_t last = part.Fronts[i - i % 3 + (i + 2) % 3];
      const glm::vec3& place = mesh.PointsCC[part.Points[corner]];
      const double area = glm::length(glm::cross(
        mesh.PointsCC[part.Points[next]] - place, mesh.PointsCC[part.Points[last]] - place));
      const std::vector<glm::dvec3>& light = this->Light[0];
      const glm::dvec3 mean =
        0.5 * (show(light[corner], this->Places[corner]) + show(light[next], this->Places[next]));
      const glm::dvec3 shown = show(
        0.5 * (light[corner] + light[next]), 0.5f * (this->Places[corner] + this->Places[next]));
      const glm::dvec3 error = cslf::LinearToSRGB(mean) - cslf::LinearToSRGB(shown);
      sum += area * glm::dot(error, error) / 3.0;
      weights += area;
    }
    return std::sqrt(sum / std::max(weights, 1e-300));
  }

  int Kind;
  const cslf::ShownMaps& Maps;
  std::array<std::vector<glm::dvec3>, 2> Light;
  std::vector<glm::vec3> Places; // as ShownMaps::ListPlaces
};

/// Writes the geometry of a window.
class Writer
{
public:
  Writer(cslf::ShownField& field, const std::string& title, bool isCompact)
    : Field(field)
    , Mesh(*field.Shown.Mesh)
    , IsCompact(isCompact)
    , Data(this->GLTF, isCompact)
  {
    this->GLTF["asset"] = { { "version", "2.0" }, { "generator", "CSLF " CSLF_VERSION } };
    this->GLTF["extensionsUsed"] = { Unlit };
    if (isCompact)
    {
      for (const char* name : { Quantization, Compression })
      {
        this->GLTF["extensionsUsed"].push_back(name);
        this->GLTF["extensionsRequired"].push_back(name);
      }
    }
    this->GLTF["scene"] = 0;
    this->GLTF["scenes"] = { { { "nodes", { 0, 1 } } } };
    this->AddMesh(title);
    this->AddCamera();
    this->Data.Finish();
  }

  /// Header and chunks.
  std::vector<std::string> Join() const
  {
    std::string text = this->GLTF.dump(-1, ' ', false, JSON::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string& bytes = this->Data.GetBytes();
    constexpr std::size_t headers = 5 * sizeof(std::uint32_t) + 2 * sizeof(std::uint32_t);
    const std::size_t size = headers + text.size() + bytes.size();
    if (size > 0xFFFFFFFF)
    {
      throw std::runtime_error("it would be larger than 4 GiB, which glTF cannot");
    }
    return { Pack({ Magic, Version, std::uint32_t(size), std::uint32_t(text.size()), JSONChunk }),
      text, Pack({ std::uint32_t(bytes.size()), BinaryChunk }), bytes };
  }

private:
  static std::string Pack(const std::vector<std::uint32_t>& numbers)
  {
    std::string bytes;
    for (const std::uint32_t number : numbers)
    {
      for (unsigned int shift = 0; shift < 32; shift += 8)
      {
        bytes.push_back(static_cast<char>(number >> shift & 255U));
      }
    }
    return bytes;
  }

  void AddMesh(const std::string& title)
  {
    JSON mesh = { { "name", title }, { "primitives", JSON::array() } };
    for (int kind = OwnColors; kind < static_cast<int>(this->Mesh.Mapped.Maps.size()); ++kind)
    {
      const Part part = MakePart(this->Mesh, kind);
      if (!part.Points.empty())
      {
        this->AddPart(part, mesh["primitives"]);
      }
    }
    this->Data.AddTo("meshes", mesh);
    // Points are relative to the centre of the cube, so that floats are precise enough.
    const cslf::Cube& box = this->Field.Shown.Field.Box;
    vtkNew<vtkMatrix4x4> matrix;
    for (int axis = 0; axis < 3; ++axis)
    {
      matrix->SetElement(axis, axis, this->IsCompact ? 0.5 * box.Edges[axis] : 1.0);
      matrix->SetElement(axis, 3, box.Center[axis]);
    }
    vtkMatrix4x4::Multiply4x4(this->Field.Actor->GetMatrix(), matrix, matrix);
    JSON node = { { "name", title }, { "mesh", 0 },
      { "extras", { { "leftOut", this->Field.Omissions } } } };
    if (!matrix->IsIdentity())
    {
      node["matrix"] = List(matrix);
    }
    this->Data.AddTo("nodes", node);
  }

  /// Planes before and behind all of the cube.
  std::array<double, 2> FindClippingRange(vtkCamera* camera) const
  {
    const cslf::Cube& box = this->Field.Shown.Field.Box;
    const auto place = [&](double share)
    {
      const glm::dvec3 world = box.Center + share * box.Edges;
      const double point[4] = { world.x, world.y, world.z, 1.0 };
      double moved[4];
      this->Field.Actor->GetMatrix()->MultiplyPoint(point, moved);
      return glm::dvec3(moved[0], moved[1], moved[2]);
    };
    const double* eye = camera->GetPosition();
    const double* direction = camera->GetDirectionOfProjection();
    const glm::dvec3 center = place(0.0);
    const double radius = 1.01 * glm::distance(center, place(0.5));
    const double middle = glm::dot(center - glm::dvec3(eye[0], eye[1], eye[2]),
      glm::dvec3(direction[0], direction[1], direction[2]));
    const double last = std::max(middle + radius, 1e-6 * radius);
    return { std::max(middle - radius, MinimumNear * last), last };
  }

  void AddCamera()
  {
    vtkCamera* camera = this->Field.Renderer->GetActiveCamera();
    const std::array<double, 2> range = this->FindClippingRange(camera);
    JSON view = { { "name", "Camera" } };
    if (camera->GetParallelProjection())
    {
      const double scale = camera->GetParallelScale();
      view["type"] = "orthographic";
      view["orthographic"] = { { "xmag", scale }, { "ymag", scale }, { "znear", range[0] },
        { "zfar", range[1] } };
    }
    else
    {
      view["type"] = "perspective";
      view["perspective"] = { { "yfov", vtkMath::RadiansFromDegrees(camera->GetViewAngle()) },
        { "znear", range[0] }, { "zfar", range[1] } };
    }
    this->Data.AddTo("cameras", view);
    vtkNew<vtkMatrix4x4> matrix;
    vtkMatrix4x4::Invert(camera->GetViewTransformMatrix(), matrix);
    this->Data.AddTo(
      "nodes", { { "name", "Camera" }, { "camera", 0 }, { "matrix", List(matrix) } });
  }

  void AddPart(const Part& part, JSON& primitives)
  {
    const bool hasBacks = !this->Mesh.BackColors.empty() && !part.Backs.empty();
    JSON attributes = { { "POSITION", this->AddPositions(part) } };
    // Without colours of their own, backs show those of the fronts.
    const bool isDouble = this->Mesh.BackColors.empty() && !part.Backs.empty();
    JSON material = { { "extensions", { { Unlit, JSON::object() } } }, { "doubleSided", isDouble },
      { "pbrMetallicRoughness", { { "metallicFactor", 0.0 }, { "roughnessFactor", 1.0 } } } };
    std::optional<MappedPart> mapped;
    if (part.HasMaps())
    {
      mapped.emplace(this->Mesh, *this->Field.Shown.Maps, part);
    }
    if (mapped && mapped->HasTexture)
    {
      const std::vector<glm::vec2> places = mapped->ListTexturePlaces();
      attributes["TEXCOORD_0"] = this->Data.AddPoints(places.data(), places.size(),
        sizeof(places[0]), { { "componentType", FloatType }, { "type", "VEC2" } });
      material["pbrMetallicRoughness"]["baseColorTexture"] = { { "index",
        mapped->FindImage() ? this->AddImage(*mapped->FindImage(), mapped->Scale)
                            : this->AddTexture(mapped->Scale) } };
    }
    if (mapped && mapped->IsCut)
    {
      this->Field.Omissions.emplace_back(
        "Light that would make surfaces with a colour map brighter than the map is cut off.");
    }
    const auto addColors = [&](int side)
    {
      attributes["COLOR_0"] = this->AddColors(
        mapped ? mapped->ListPointColors(side) : ListColors(this->Mesh, part, side));
    };
    addColors(0);
    const std::size_t number = this->Data.AddTo("materials", material);
    primitives.push_back({ { "attributes", attributes }, { "material", number },
      { "indices", this->Data.AddCorners(part.Fronts, part.Points.size()) } });
    if (hasBacks)
    {
      addColors(1);
      primitives.push_back({ { "attributes", attributes }, { "material", number },
        { "indices", this->Data.AddCorners(part.Backs, part.Points.size()) } });
    }
  }

  std::size_t AddPositions(const Part& part)
  {
    const glm::dvec3 half = 0.5 * this->Field.Shown.Field.Box.Edges;
    std::vector<glm::vec3> places;
    std::vector<std::array<std::int16_t, 4>> codes;
    std::array<double, 3> low{ 1e300, 1e300, 1e300 };
    std::array<double, 3> high{ -1e300, -1e300, -1e300 };
    for (const std::size_t point : part.Points)
    {
      const glm::dvec3 place(this->Mesh.PointsCC[point]);
      std::array<std::int16_t, 4>& code = codes.emplace_back();
      places.emplace_back(half * place);
      for (int axis = 0; axis < 3; ++axis)
      {
        code[axis] =
          static_cast<std::int16_t>(std::lround(MaximumShort * std::clamp(place[axis], -1.0, 1.0)));
        const double value = this->IsCompact ? code[axis] : places.back()[axis];
        low[axis] = std::min(low[axis], value);
        high[axis] = std::max(high[axis], value);
      }
    }
    JSON accessor = { { "componentType", this->IsCompact ? ShortType : FloatType },
      { "type", "VEC3" }, { "min", low }, { "max", high } };
    if (this->IsCompact)
    {
      accessor["normalized"] = true;
      return this->Data.AddPoints(codes.data(), codes.size(), sizeof(codes[0]), accessor);
    }
    return this->Data.AddPoints(places.data(), places.size(), sizeof(places[0]), accessor);
  }

  std::size_t AddColors(const std::vector<glm::dvec3>& colors)
  {
    std::vector<std::array<std::uint16_t, 4>> codes(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        codes[i][c] = ToCode(colors[i][c], this->IsCompact);
      }
      codes[i][3] = 0xFFFF;
    }
    return this->Data.AddPoints(codes.data(), codes.size(), sizeof(codes[0]),
      { { "componentType", UnsignedShortType }, { "normalized", true }, { "type", "VEC4" } });
  }

  /// All maps as an image, times a factor.
  std::size_t AddTexture(double scale)
  {
    const cslf::ShownMaps& maps = *this->Field.Shown.Maps;
    vtkNew<vtkImageData> image;
    image->SetDimensions(maps.GetWidth(), maps.GetHeight(), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int y = 0; y < maps.GetHeight(); ++y)
    {
      for (int x = 0; x < maps.GetWidth(); ++x)
      {
        const std::size_t from = std::size_t(y) * maps.GetWidth() + x;
        // Rows of PNG begin at the top, as those of textures of glTF.
        auto* to =
          static_cast<unsigned char*>(image->GetScalarPointer(x, maps.GetHeight() - 1 - y, 0));
        for (int c = 0; c < 3; ++c)
        {
          to[c] = cslf::ToByte(cslf::LinearToSRGB(scale * maps.GetImage()[from][c]));
        }
      }
    }
    return this->AddTexture("image/png", ToPNG(image),
      { { "magFilter", NearestFilter }, { "minFilter", NearestFilter }, { "wrapS", ClampToEdge },
        { "wrapT", ClampToEdge } });
  }

  static std::string ToPNG(vtkImageData* image)
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    return { reinterpret_cast<const char*>(bytes->GetPointer(0)),
      static_cast<std::size_t>(bytes->GetNumberOfValues()) };
  }

  static std::string ToPNG(const cslf::MapImage& from)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(from.GetLayout().Width, from.GetLayout().Height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
    for (const cslf::MapImage::Pixel& pixel : from.GetPixels())
    {
      to = std::copy_n(pixel.begin(), 3, to);
    }
    return ToPNG(image);
  }

  /// An image times a factor.
  std::size_t AddImage(const cslf::MapImage& image, double scale)
  {
    const cslf::MapImage::Layout& layout = image.GetLayout();
    std::shared_ptr<const cslf::MapImage> scaled;
    if (scale != 1.0)
    {
      const auto getColor = [&](const glm::dvec2& place)
      { return static_cast<float>(scale) * image.GetColor(place); };
      scaled = cslf::MapImage::Make(layout, getColor);
    }
    const cslf::MapImage& shown = scaled ? *scaled : image;
    const auto getWrap = [&layout](int axis)
    { return layout.Repeats[axis] ? Repeat : ClampToEdge; };
    const bool isJPEG = shown.GetLayout().IsJPEG;
    return this->AddTexture(isJPEG ? "image/jpeg" : "image/png",
      isJPEG ? std::string(shown.GetEncoded().begin(), shown.GetEncoded().end()) : ToPNG(shown),
      { { "magFilter", layout.IsSmooth ? LinearFilter : NearestFilter },
        { "minFilter", layout.IsSmooth ? MipmapFilter : NearestFilter }, { "wrapS", getWrap(0) },
        { "wrapT", getWrap(1) } });
  }

  std::size_t AddTexture(const char* type, const std::string& bytes, const JSON& sampler)
  {
    const JSON texture = { { "sampler", this->Data.AddTo("samplers", sampler) },
      { "source",
        this->Data.AddTo(
          "images", { { "mimeType", type }, { "bufferView", this->Data.AddView(bytes) } }) } };
    return this->Data.AddTo("textures", texture);
  }

  /// By columns.
  static std::vector<double> List(vtkMatrix4x4* matrix)
  {
    vtkNew<vtkMatrix4x4> columns;
    vtkMatrix4x4::Transpose(matrix, columns);
    return { columns->GetData(), columns->GetData() + 16 };
  }

  cslf::ShownField& Field;
  const cslf::GeometryMesh& Mesh;
  bool IsCompact;
  JSON GLTF;
  Buffer Data;
};
}

vtkStandardNewMacro(vtkCSLFGLTFExporter);

vtkCSLFGLTFExporter::vtkCSLFGLTFExporter() = default;

vtkCSLFGLTFExporter::~vtkCSLFGLTFExporter()
{
  this->SetFileName(nullptr);
  this->SetTitle(nullptr);
}

void vtkCSLFGLTFExporter::WriteData()
{
  cslf::ExportField(this, this->FileName, this->Title,
    [this](cslf::ShownField& field, const std::string& title)
    { return Writer(field, title, this->Compact).Join(); });
}

void vtkCSLFGLTFExporter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Title: " << (this->Title ? this->Title : "(none)") << "\n";
  os << indent << "Compact: " << (this->Compact ? "on" : "off") << "\n";
}
