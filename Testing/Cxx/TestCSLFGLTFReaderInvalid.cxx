// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Invalid glTF files: valid parts are read, and a warning names the rest; a file without valid
// parts gives an error and no output.
#include "cslfJSON.h"
#include "cslfTesting.h"
#include "vtkCSLFGLTFReader.h"

#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace
{
using nlohmann::json;

/// Three positions, three texture coordinates and three indices: 36, 24 and 3 bytes.
std::string MakeBuffer()
{
  const float numbers[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1 };
  std::string buffer(sizeof(numbers) + 3, '\0');
  std::memcpy(&buffer[0], numbers, sizeof(numbers));
  buffer[61] = 1;
  buffer[62] = 2;
  return buffer;
}

/// A document with one triangle.
json MakeDocument()
{
  return json::parse(R"({
    "asset": { "version": "2.0" },
    "scene": 0,
    "scenes": [ { "nodes": [0] } ],
    "nodes": [ { "mesh": 0 } ],
    "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 },
      "indices": 2, "material": 0 } ] } ],
    "materials": [ { "pbrMetallicRoughness": { "metallicFactor": 0.5 } } ],
    "buffers": [ { "byteLength": 63, "uri": "TestCSLFGLTFReaderInvalid.bin" } ],
    "bufferViews": [
      { "buffer": 0, "byteLength": 36 },
      { "buffer": 0, "byteOffset": 36, "byteLength": 24 },
      { "buffer": 0, "byteOffset": 60, "byteLength": 3 } ],
    "accessors": [
      { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" },
      { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2" },
      { "bufferView": 2, "componentType": 5121, "count": 3, "type": "SCALAR" } ]
  })");
}

/// A PNG file of one pixel.
constexpr const char* Pixel = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptV"
                              "AAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";

/// The same truncated, and with another checksum.
constexpr const char* CutPixel = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUg==";
constexpr const char* DamagedPixel =
  "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptW"
  "AAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";

json MakeTextured()
{
  json document = MakeDocument();
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = { { "index", 0 } };
  document["textures"] = { { { "source", 0 }, { "sampler", 0 } } };
  document["samplers"] = { json::object() };
  document["images"] = { { { "uri", Pixel } } };
  return document;
}

struct Case
{
  std::string Path;    ///< of the replaced part, as a JSON pointer
  json Value;          ///< its replacement; null to remove it
  std::string Message; ///< part of the warning or error
  int Blocks;          ///< how many are left; 0 for an error
};

/// Errors of the document itself.
const std::vector<Case> DocumentCases = {
  { "/asset/version", nullptr, "asset.version is missing", 0 },
  { "/asset/version", "1.0", "glTF 1.0", 0 },
  { "/asset/version", 2, "asset.version is not a string", 0 },
  { "/asset", json::array(), "asset is not an object", 0 },
  { "/extensionsRequired", { "KHR_draco_mesh_compression" }, "KHR_draco_mesh_compression", 0 },
  { "/extensionsRequired", { "EXT_meshopt_compression" }, "EXT_meshopt_compression", 0 },
  { "/extensionsRequired", 1, "extensionsRequired is not an array", 0 },
  { "/extensionsUsed", { "\x1b[31m\nerror\u0085" }, "\\x1b[31m\\x0aerror\\x85", 1 },
  { "/extensionsUsed", { 7 }, "extensionsUsed[0] is not a string", 1 },
  { "/scene", "zero", "scene is not a non-negative integer", 1 },
  { "/scene", 5, "scenes[5] does not exist", 0 },
  { "/scenes/0/nodes", 0, "scenes[0].nodes is not an array", 0 },
  { "/scenes/0/nodes/0", -1, "scenes[0].nodes[0] is not a non-negative integer", 0 },
  { "/scenes/0/nodes/0", 1e300, "scenes[0].nodes[0] is not a non-negative integer", 0 },
  { "/scenes/0/nodes/0", 17, "nodes[17] does not exist", 0 },
  { "/nodes/0/children", { 0 }, "is its own ancestor", 1 },
  { "/nodes/0/mesh", 1, "meshes[1] does not exist", 0 },
  { "/nodes/0/mesh", 0.5, "nodes[0].mesh is not a non-negative integer", 0 },
  { "/nodes/0/matrix", { 1, 2, 3 }, "nodes[0].matrix must have 16 numbers", 0 },
  { "/nodes/0/translation", { 0, 0, "up" }, "nodes[0].translation[2] is not a number", 0 },
  { "/nodes/0", nullptr, "nodes[0]", 0 },
  { "/meshes/0/primitives", json::object(), "meshes[0].primitives is not an array", 0 },
  { "/buffers/0/uri", "nowhere.bin", "there is no file nowhere.bin", 0 },
  { "/buffers/0/uri", "/proc/self/maps", "names /proc/self/maps, which is outside", 0 },
  { "/buffers/0/uri", "../nowhere.bin", "names ../nowhere.bin, which is outside", 0 },
  { "/buffers/0/uri", "%2e%2e/%2E./a.bin", "names ../../a.bin, which is outside", 0 },
  { "/buffers/0/uri", "TestCSLFGLTFReaderInvalidLink.bin", "Link.bin, which is outside", 0 },
  { "/buffers/0/uri", "a/../\x1b.bin", "there is no file a/../\\x1b.bin", 0 },
  { "/buffers/0/uri", "https://example.org/a.bin", "is not the path of a local file", 0 },
  { "/buffers/0/uri", "data:text/plain,abc", "not in base64", 0 },
  { "/buffers/0/uri", "data:;base64,!!!!", "exceeds the 0 bytes of its buffer", 0 },
  { "/buffers/0/uri", nullptr, "buffers[0] has no data", 0 },
  { "/bufferViews/0/buffer", 9, "buffers[9] does not exist", 0 },
  { "/bufferViews/0/byteLength", 1e15, "exceeds the 63 bytes", 0 },
  { "/bufferViews/0/byteOffset", 9007199254740991, "exceeds the 63 bytes", 0 },
  { "/bufferViews/0/byteOffset", -4, "byteOffset is not a non-negative integer", 0 },
  { "/bufferViews/0/byteStride", 4, "larger than its byteStride", 0 },
  { "/bufferViews/0/byteStride", 9007199254740991, "exceeds its bufferView", 0 },
};

/// Errors of accessors and their uses.
const std::vector<Case> AccessorCases = {
  { "/accessors/0/count", 4, "accessors[0] exceeds its bufferView", 0 },
  { "/accessors/0/count", 9007199254740991, "accessors[0] exceeds its bufferView", 0 },
  { "/accessors/0/count", 2, "indices of missing vertices", 0 },
  { "/accessors/0/byteOffset", 9007199254740991, "accessors[0] exceeds", 0 },
  { "/accessors/0/bufferView", 8, "bufferViews[8] does not exist", 0 },
  { "/accessors/0/componentType", 5124, "is not a component type", 0 },
  { "/accessors/0/type", "MAT4", "is not SCALAR", 0 },
  { "/accessors/0/type", "VEC2", "POSITION is not a list of 3D points", 0 },
  { "/accessors/0/sparse", json::object(), "sparse.indices has no bufferView", 0 },
  { "/accessors/2/bufferView", 9, "bufferViews[9] does not exist", 0 },
  { "/accessors/2/componentType", 5126, "indices that are not unsigned integers", 0 },
  { "/accessors/2/type", "VEC3", "accessors[2] exceeds", 0 },
  { "/meshes/0/primitives/0/attributes/POSITION", nullptr, "has no positions", 0 },
  { "/meshes/0/primitives/0/attributes/POSITION", 3, "accessors[3] does not exist", 0 },
  { "/meshes/0/primitives/0/attributes", 3, "attributes is not an object", 0 },
  { "/meshes/0/primitives/0/attributes/NORMAL", 1, "NORMAL is not a list of 3D directions", 1 },
  { "/meshes/0/primitives/0/attributes/NORMAL", 99, "accessors[99] does not exist", 1 },
  { "/meshes/0/primitives/0/attributes/COLOR_0", 1, "COLOR_0 is not a list of colours", 1 },
  { "/meshes/0/primitives/0/indices", 99, "accessors[99] does not exist", 0 },
  { "/meshes/0/primitives/0/mode", 7, "mode is unknown", 0 },
  { "/meshes/0/primitives/0/material", 4, "materials[4] does not exist", 1 },
};

/// Errors of materials and textures.
const std::vector<Case> MaterialCases = {
  { "/materials/0", "gold", "materials[0] is not an object", 1 },
  { "/materials/0/pbrMetallicRoughness", 1, "pbrMetallicRoughness is not an object", 1 },
  { "/materials/0/pbrMetallicRoughness/metallicFactor", "much", "metallicFactor is not a number",
    1 },
  { "/materials/0/pbrMetallicRoughness/baseColorFactor", { 1 }, "must have 4 numbers", 1 },
  { "/materials/0/emissiveFactor", 3, "emissiveFactor is not an array", 1 },
  { "/materials/0/alphaMode", "DITHER", "not OPAQUE, MASK or BLEND", 1 },
  { "/materials/0/extensions", json::array(), "extensions is not an object", 1 },
  { "/images/0/uri", "data:image/png;base64,AAAA", "images[0] is not PNG", 1 },
  { "/images/0/uri", "nowhere.png", "there is no file nowhere.png", 1 },
  { "/images/0/uri", nullptr, "images[0] has neither a uri", 1 },
  { "/images/0/bufferView", 0, "images[0] is not PNG", 1 },
  { "/images/0/bufferView", 33, "bufferViews[33] does not exist", 1 },
  { "/images/0/uri", CutPixel, "images[0] cannot be decoded: it is truncated", 1 },
  { "/images/0/uri", DamagedPixel, "images[0] cannot be decoded: it is damaged", 1 },
  { "/accessors/1/count", 2, "TEXCOORD_0 has 2 elements for 3 positions", 1 },
  { "/textures/0/source", 12, "images[12] does not exist", 1 },
  { "/textures/0/source", nullptr, "textures[0] has no readable image", 1 },
  { "/materials/0/pbrMetallicRoughness/baseColorTexture/index", 2, "textures[2] does not exist",
    1 },
  { "/materials/0/pbrMetallicRoughness/baseColorTexture", json::object(), "has no index", 1 },
};

void CheckFile(const std::string& name, const std::string& message, int blocks)
{
  vtkNew<vtkCSLFGLTFReader> reader;
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkNew<vtkTest::ErrorObserver> pipeline;
  reader->AddObserver(vtkCommand::ErrorEvent, messages);
  reader->AddObserver(vtkCommand::WarningEvent, messages);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  reader->SetFileName(name.c_str());
  reader->Update();
  const std::string text = messages->GetErrorMessage() + messages->GetWarningMessage();
  const bool named = text.find(message) != std::string::npos;
  const bool counted = static_cast<int>(reader->GetOutput()->GetNumberOfBlocks()) == blocks &&
    messages->GetError() == (blocks == 0) && (reader->GetErrorCode() != 0) == (blocks == 0);
  if (!named || !counted)
  {
    std::cerr << "expected " << blocks << " block(s) and: " << message << "\ngot "
              << reader->GetOutput()->GetNumberOfBlocks() << " and: " << text << "\n";
  }
  CSLF_CHECK(named && counted);
}

/// Replaces or removes a part of a document.
void Break(json& document, const Case& of)
{
  const json::json_pointer pointer(of.Path);
  if (!of.Value.is_null())
  {
    document[pointer] = of.Value;
  }
  else if (document[pointer.parent_pointer()].is_array())
  {
    document[pointer] = nullptr;
  }
  else
  {
    document[pointer.parent_pointer()].erase(pointer.back());
  }
}

void TestDocuments(const std::string& name, const json& sound, const std::vector<Case>& cases)
{
  for (const Case& of : cases)
  {
    json document = sound;
    Break(document, of);
    std::ofstream(name) << document.dump();
    CheckFile(name, of.Message, of.Blocks);
  }
}

/// Files that are not JSON, and binary files with invalid chunks.
void TestFiles(const std::string& name)
{
  const auto number = [](std::uint32_t value)
  { return std::string(reinterpret_cast<const char*>(&value), 4); };
  const std::string text = "{\"asset\":{\"version\":\"2.0\"}}  ";
  const std::string header = "glTF" + number(2) + number(1000);
  const std::string chunk = number(static_cast<std::uint32_t>(text.size())) + "JSON" + text;
  const std::pair<std::string, std::string> files[] = {
    { "", "not a JSON object" },
    { "[1, 2]", "not a JSON object" },
    { std::string(100000, '['), "not a JSON object" },
    { "{\"asset\":{\"version\":\"2.0\", \"x\": 1e999}}", "not a JSON object" },
    { "{\"asset\":{\"version\":\"\xff\xfe\"}}", "not a JSON object" },
    { header, "it has no JSON chunk" },
    { "glTF" + number(1) + number(20), "version 1, but version 2 is required" },
    { header + number(0xffffffffu) + "JSON{}", "it is truncated" },
    { header + number(4) + "BIN" + std::string(1, '\0') + "1234", "it has no JSON chunk" },
    { header + chunk.substr(0, 20), "it is truncated" },
  };
  for (const auto& [bytes, message] : files)
  {
    std::ofstream(name, std::ios::binary) << bytes;
    CheckFile(name, message, 0);
  }
  // Deep nesting must not overflow the stack.
  const int depth = 200000;
  json document = MakeDocument();
  std::string deep = document.dump();
  deep.insert(deep.size() - 1,
    ",\"extras\":" + std::string(depth, '[') + std::string(depth, ']') +
      ",\"extensionsUsed\":" + "[\"KHR_unknown\"]");
  std::ofstream(name) << deep;
  CheckFile(name, "KHR_unknown", 1);
}

/// A long chain of nodes, and nodes that double at each step if they are visited again and again.
void TestNodes(const std::string& name)
{
  json chain = MakeDocument();
  chain["extensionsUsed"] = { "KHR_unknown" };
  const int length = 100000;
  for (int i = 0; i < length; ++i)
  {
    chain["nodes"][i] = { { "children", { i + 1 } } };
  }
  chain["nodes"][length] = { { "mesh", 0 } };
  std::ofstream(name) << chain.dump();
  CheckFile(name, "KHR_unknown", 1);

  json doubled = MakeDocument();
  for (int i = 0; i < 64; ++i)
  {
    doubled["nodes"][i] = { { "children", { i + 1, i + 1 } } };
  }
  doubled["nodes"][64] = { { "mesh", 0 } };
  std::ofstream(name) << doubled.dump();
  CheckFile(name, "nodes[64] has more than one parent", 1);
}

/// Few bytes that define very many elements.
void TestLimits(const std::string& name)
{
  json zeros = MakeDocument();
  zeros["accessors"][3] = { { "componentType", 5126 }, { "count", 1 << 23 }, { "type", "VEC3" } };
  for (int i = 1; i <= 200; ++i)
  {
    zeros["meshes"][i] = { { "primitives", { { { "attributes", { { "POSITION", 3 } } } } } } };
    zeros["meshes"][i]["primitives"][0]["indices"] = 2;
    zeros["nodes"][i] = { { "mesh", i } };
    zeros["scenes"][0]["nodes"][i] = i;
  }
  std::ofstream(name) << zeros.dump();
  CheckFile(name, "accessors without a bufferView have more than 16777216 elements", 3);

  json repeated = zeros;
  repeated["meshes"][1]["primitives"] = json::array();
  for (int i = 1; i <= 200; ++i)
  {
    repeated["nodes"][i]["mesh"] = 2;
  }
  std::ofstream(name) << repeated.dump();
  CheckFile(name, "repeat more than 67109116 elements", 9);
}
}

int TestCSLFGLTFReaderInvalid(int argc, char* argv[])
{
  std::unique_ptr<char[]> folder(
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary"));
  const std::string base = std::string(folder.get()) + "/TestCSLFGLTFReaderInvalid";
  std::ofstream(base + ".bin", std::ios::binary) << MakeBuffer();
  std::error_code ignored;
  std::filesystem::create_symlink("/dev/null", base + "Link.bin", ignored);
  const std::string name = base + ".gltf";
  TestDocuments(name, MakeDocument(), DocumentCases);
  TestDocuments(name, MakeDocument(), AccessorCases);
  TestDocuments(name, MakeTextured(), MaterialCases);
  TestFiles(name);
  TestNodes(name);
  TestLimits(name);
  CheckFile(base + ".nowhere.gltf", "there is no file", 0);
  CheckFile(folder.get(), "there is no file", 0);
  return cslf::testing::Result();
}
