// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Geometry of glTF files: all modes of primitives, sparse and normalised accessors, bytes between
// elements, data within addresses, transforms of nodes in double precision and of texture
// coordinates.
#include "cslfJSON.h"
#include "cslfTesting.h"
#include "vtkCSLFGLTFReader.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace
{
using nlohmann::json;

/// The folder for files, and the common beginning of their names.
std::string Base;

template <typename Value>
std::string ToBytes(const std::vector<Value>& values)
{
  std::string bytes(values.size() * sizeof(Value), '\0');
  std::memcpy(&bytes[0], values.data(), bytes.size());
  return bytes;
}

/// A document that is built step by step.
class Document
{
public:
  Document()
  {
    this->Root = { { "asset", { { "version", "2.0" } } }, { "scenes", { json::object() } } };
    this->Root["buffers"] = { { { "byteLength", 0 }, { "uri", "TestGeometry%20file.bin" } } };
  }

  /// Adds bytes; the index of their buffer view.
  std::size_t AddView(const std::string& bytes)
  {
    this->Root["bufferViews"].push_back(
      { { "buffer", 0 }, { "byteOffset", this->Buffer.size() }, { "byteLength", bytes.size() } });
    this->Buffer += bytes;
    return this->Root["bufferViews"].size() - 1;
  }

  std::size_t AddAccessor(const json& accessor)
  {
    this->Root["accessors"].push_back(accessor);
    return this->Root["accessors"].size() - 1;
  }

  template <typename Value>
  std::size_t AddNumbers(
    const std::vector<Value>& values, int type, const char* shape, std::size_t components)
  {
    return this->AddAccessor({ { "bufferView", this->AddView(ToBytes(values)) },
      { "componentType", type }, { "count", values.size() / components }, { "type", shape } });
  }

  /// Adds a node with a mesh of one primitive.
  void AddPrimitive(const json& primitive, json node = json::object())
  {
    this->Root["meshes"].push_back({ { "primitives", { primitive } } });
    node["mesh"] = this->Root["meshes"].size() - 1;
    this->Root["nodes"].push_back(node);
    this->Root["scenes"][0]["nodes"].push_back(this->Root["nodes"].size() - 1);
  }

  /// Writes and reads the document. There must be no message.
  vtkSmartPointer<vtkMultiBlockDataSet> Read(double pointRadius = 0.0)
  {
    this->Root["buffers"][0]["byteLength"] = this->Buffer.size();
    std::ofstream(Base + " file.bin", std::ios::binary) << this->Buffer;
    const std::string name = Base + ".gltf";
    std::ofstream(name) << this->Root.dump();
    vtkNew<vtkCSLFGLTFReader> reader;
    vtkNew<vtkTest::ErrorObserver> messages;
    reader->AddObserver(vtkCommand::ErrorEvent, messages);
    reader->AddObserver(vtkCommand::WarningEvent, messages);
    reader->SetFileName(name.c_str());
    reader->SetPointRadius(pointRadius);
    reader->Update();
    CSLF_CHECK(!messages->GetError() && !messages->GetWarning());
    return reader->GetOutput();
  }

  json Root;
  std::string Buffer;
};

vtkPolyData* GetBlock(vtkMultiBlockDataSet* blocks, unsigned int index)
{
  return vtkPolyData::SafeDownCast(blocks->GetBlock(index));
}

/// The ids of all cells in a row.
std::vector<vtkIdType> GetIds(vtkCellArray* cells)
{
  std::vector<vtkIdType> ids;
  vtkNew<vtkIdList> cell;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    cells->GetCellAtId(i, cell);
    ids.insert(ids.end(), cell->begin(), cell->end());
  }
  return ids;
}

void TestModes()
{
  Document document;
  const std::size_t positions =
    document.AddNumbers<float>({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 2, 0 }, 5126, "VEC3", 3);
  const std::size_t indices =
    document.AddNumbers<std::uint32_t>({ 0, 1, 2, 3, 4 }, 5125, "SCALAR", 1);
  for (int mode = 0; mode <= 6; ++mode)
  {
    document.AddPrimitive({ { "attributes", { { "POSITION", positions } } }, { "indices", indices },
      { "mode", mode } });
  }
  document.AddPrimitive({ { "attributes", { { "POSITION", positions } } } }); // without indices
  const vtkSmartPointer<vtkMultiBlockDataSet> blocks = document.Read();
  CSLF_CHECK(blocks->GetNumberOfBlocks() == 8);
  using Ids = std::vector<vtkIdType>;
  CSLF_CHECK(GetIds(GetBlock(blocks, 0)->GetVerts()) == Ids({ 0, 1, 2, 3, 4 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 1)->GetLines()) == Ids({ 0, 1, 2, 3 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 2)->GetLines()) == Ids({ 0, 1, 1, 2, 2, 3, 3, 4, 4, 0 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 3)->GetLines()) == Ids({ 0, 1, 1, 2, 2, 3, 3, 4 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 4)->GetPolys()) == Ids({ 0, 1, 2 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 5)->GetPolys()) == Ids({ 0, 1, 2, 1, 3, 2, 2, 3, 4 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 6)->GetPolys()) == Ids({ 1, 2, 0, 2, 3, 0, 3, 4, 0 }));
  CSLF_CHECK(GetIds(GetBlock(blocks, 7)->GetPolys()) == Ids({ 0, 1, 2 }));
  CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(GetBlock(blocks, 0)) == 0.0);
  const vtkSmartPointer<vtkMultiBlockDataSet> again = document.Read(0.25);
  CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(GetBlock(again, 0)) == 0.25);
  CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(GetBlock(again, 4)) == 0.0);
}

void TestAccessors()
{
  Document document;
  // Zeros, two of which a sparse list replaces.
  const std::size_t places = document.AddView(ToBytes<std::uint16_t>({ 1, 2 }));
  const std::size_t values = document.AddView(ToBytes<float>({ 5, 0, 0, 0, 7, 0 }));
  const std::size_t sparse =
    document.AddAccessor({ { "componentType", 5126 }, { "count", 3 }, { "type", "VEC3" },
      { "sparse",
        { { "count", 2 }, { "indices", { { "bufferView", places }, { "componentType", 5123 } } },
          { "values", { { "bufferView", values } } } } } });
  document.AddPrimitive({ { "attributes", { { "POSITION", sparse } } } });

  // Quantised positions, normalised and not, with a byte of padding between them.
  const std::size_t bytes =
    document.AddView(ToBytes<std::int8_t>({ 0, 0, 0, 99, 127, 0, 0, 99, 0, -128, 0, 99 }));
  document.Root["bufferViews"][bytes]["byteStride"] = 4;
  for (const bool normalized : { true, false })
  {
    const std::size_t quantized =
      document.AddAccessor({ { "bufferView", bytes }, { "componentType", 5120 }, { "count", 3 },
        { "type", "VEC3" }, { "normalized", normalized } });
    document.AddPrimitive({ { "attributes", { { "POSITION", quantized } } } });
  }
  // Colours of bytes are always parts of 255.
  const std::size_t colors =
    document.AddNumbers<std::uint8_t>({ 255, 0, 0, 0, 255, 0, 0, 0, 255 }, 5121, "VEC3", 3);
  document.AddPrimitive({ { "attributes", { { "POSITION", sparse }, { "COLOR_0", colors } } } });

  const vtkSmartPointer<vtkMultiBlockDataSet> blocks = document.Read();
  CSLF_CHECK(blocks->GetNumberOfBlocks() == 4);
  double bounds[6];
  GetBlock(blocks, 0)->GetBounds(bounds);
  CSLF_CHECK(bounds[0] == 0.0 && bounds[1] == 5.0 && bounds[3] == 7.0);
  GetBlock(blocks, 1)->GetBounds(bounds);
  CSLF_CHECK(bounds[1] == 1.0 && bounds[2] == -1.0);
  GetBlock(blocks, 2)->GetBounds(bounds);
  CSLF_CHECK(bounds[1] == 127.0 && bounds[2] == -128.0);
  vtkDataArray* scalars = GetBlock(blocks, 3)->GetPointData()->GetScalars();
  CSLF_CHECK(scalars && scalars->GetComponent(1, 1) == 255.0);
}

void TestTransforms()
{
  Document document;
  const std::size_t positions =
    document.AddNumbers<float>({ 0, 0, 0, 1e-3f, 0, 0, 0, 1e-3f, 0 }, 5126, "VEC3", 3);
  const std::size_t normals =
    document.AddNumbers<float>({ 0, 0, 1, 0, 0, 1, 0, 0, 1 }, 5126, "VEC3", 3);
  const json primitive = { { "attributes", { { "POSITION", positions }, { "NORMAL", normals } } } };
  // Metres of a map, with a precision of only a quarter of a metre in floats; two nodes, one a
  // child.
  document.AddPrimitive(primitive, { { "translation", { 500000.0, 4000000.0, 0.0 } } });
  document.Root["nodes"].push_back({ { "mesh", 0 }, { "scale", { 2, 2, 2 } } });
  document.Root["nodes"][0]["children"] = { 1 };
  // A mirror image keeps its front.
  document.AddPrimitive(primitive, { { "scale", { -1, 1, 1 } } });
  // A quarter turn about z, as a quaternion and as a matrix by columns.
  const double half = std::sqrt(0.5);
  document.AddPrimitive(
    primitive, { { "rotation", { 0, 0, half, half } }, { "translation", { 1, 2, 3 } } });
  document.AddPrimitive(
    primitive, { { "matrix", { 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1 } } });
  const vtkSmartPointer<vtkMultiBlockDataSet> blocks = document.Read();
  CSLF_CHECK(blocks->GetNumberOfBlocks() == 5);
  double point[3];
  GetBlock(blocks, 0)->GetPoint(2, point);
  CSLF_CHECK_NEAR(point[1] - 4000000.0, 1e-3, 1e-8);
  GetBlock(blocks, 1)->GetPoint(2, point);
  CSLF_CHECK_NEAR(point[1] - 4000000.0, 2e-3, 1e-8);
  CSLF_CHECK(GetIds(GetBlock(blocks, 2)->GetPolys()) == std::vector<vtkIdType>({ 2, 1, 0 }));
  for (unsigned int i : { 3u, 4u })
  {
    GetBlock(blocks, i)->GetPoint(1, point);
    CSLF_CHECK_NEAR(point[0], 1.0, 1e-9);
    CSLF_CHECK_NEAR(point[1], 2.001, 1e-9);
    CSLF_CHECK_NEAR(point[2], 3.0, 1e-9);
  }
}

/// Coordinates are scaled, turned and moved before v is counted from the lower edge.
void TestTextureTransform()
{
  Document document;
  const std::size_t positions =
    document.AddNumbers<float>({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, 5126, "VEC3", 3);
  const std::size_t coordinates = document.AddNumbers<float>({ 1, 0, 0, 1, 0, 0 }, 5126, "VEC2", 2);
  // One grey pixel.
  document.Root["images"] = { { { "uri",
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCB"
    "d81ytgAAAABJRU5ErkJggg==" } } };
  document.Root["textures"] = { { { "source", 0 } } };
  document.Root["extensionsUsed"] = { "KHR_texture_transform" };
  const json transform = { { "offset", { 0.5, 0.25 } }, { "scale", { 2.0, 3.0 } },
    { "rotation", 1.5707963267948966 }, { "texCoord", 1 } };
  document.Root["materials"] = { { { "pbrMetallicRoughness",
    { { "baseColorTexture",
      { { "index", 0 }, { "extensions", { { "KHR_texture_transform", transform } } } } } } } } };
  document.AddPrimitive(
    { { "attributes", { { "POSITION", positions }, { "TEXCOORD_1", coordinates } } },
      { "material", 0 } });
  const vtkSmartPointer<vtkMultiBlockDataSet> blocks = document.Read();
  vtkDataArray* result = GetBlock(blocks, 0)->GetPointData()->GetTCoords();
  CSLF_CHECK(result != nullptr);
  if (result)
  {
    // (1, 0) becomes (2, 0), then a quarter turn counterclockwise in the image, up: (0, -2).
    CSLF_CHECK_NEAR(result->GetComponent(0, 0), 0.5, 1e-6);
    CSLF_CHECK_NEAR(result->GetComponent(0, 1), 1.0 - (0.25 - 2.0), 1e-6);
    CSLF_CHECK_NEAR(result->GetComponent(1, 0), 0.5 + 3.0, 1e-6);
    CSLF_CHECK_NEAR(result->GetComponent(1, 1), 1.0 - 0.25, 1e-6);
  }
}

/// Data within an address, and nodes that no scene names.
void TestWithoutScene()
{
  Document document;
  document.AddPrimitive({ { "attributes", { { "POSITION", 0 } } } });
  document.Root["accessors"] = { { { "bufferView", 0 }, { "componentType", 5123 }, { "count", 3 },
    { "type", "VEC3" } } };
  document.Root["bufferViews"] = { { { "buffer", 0 }, { "byteLength", 18 } } };
  // 0 0 0, 256 0 0, 0 256 0.
  document.Root["buffers"] = { { { "byteLength", 18 },
    { "uri", "data:application/octet-stream;base64,AAAAAAAAAAEAAAAAAAAAAQAA" } } };
  document.Root.erase("scenes");
  const vtkSmartPointer<vtkMultiBlockDataSet> blocks = document.Read();
  CSLF_CHECK(blocks->GetNumberOfBlocks() == 1);
  double bounds[6];
  GetBlock(blocks, 0)->GetBounds(bounds);
  CSLF_CHECK(bounds[1] == 256.0 && bounds[3] == 256.0);
}
}

int TestCSLFGLTFReaderGeometry(int argc, char* argv[])
{
  std::unique_ptr<char[]> folder(
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary"));
  Base = std::string(folder.get()) + "/TestGeometry";
  TestModes();
  TestAccessors();
  TestTransforms();
  TestTextureTransform();
  TestWithoutScene();
  return cslf::testing::Result();
}
