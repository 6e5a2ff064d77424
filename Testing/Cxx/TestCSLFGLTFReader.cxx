// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Materials of glTF files, textual and binary.
#include "cslfColor.h"
#include "cslfJSON.h"
#include "cslfTesting.h"
#include "vtkCSLFGLTFReader.h"
#include "vtkCSLFMaterial.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace
{
using nlohmann::json;

/// A square with texture coordinates and vertex colours: positions, coordinates, colours, indices.
std::string MakeBuffer()
{
  const float numbers[] = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, // positions
    0, 1, 1, 1, 1, 0, 0, 0,                                     // v grows downwards
    0.5f, 0.5f, 0.5f, 0.5f, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 };
  const std::uint16_t indices[] = { 0, 1, 2, 0, 2, 3 };
  std::string buffer(sizeof(numbers) + sizeof(indices), '\0');
  std::memcpy(&buffer[0], numbers, sizeof(numbers));
  std::memcpy(&buffer[sizeof(numbers)], indices, sizeof(indices));
  return buffer;
}

/// A square with each of some materials, side by side.
json MakeDocument(const json& materials)
{
  json document = { { "asset", { { "version", "2.0" } } }, { "scene", 0 } };
  document["extensionsUsed"] = { "KHR_materials_transmission", "KHR_materials_sheen",
    "KHR_texture_transform" };
  document["buffers"] = { { { "byteLength", 156 } } };
  document["bufferViews"] = {
    { { "buffer", 0 }, { "byteOffset", 0 }, { "byteLength", 48 } },
    { { "buffer", 0 }, { "byteOffset", 48 }, { "byteLength", 32 } },
    { { "buffer", 0 }, { "byteOffset", 80 }, { "byteLength", 64 } },
    { { "buffer", 0 }, { "byteOffset", 144 }, { "byteLength", 12 } },
  };
  document["accessors"] = {
    { { "bufferView", 0 }, { "componentType", 5126 }, { "count", 4 }, { "type", "VEC3" },
      { "min", { 0, 0, 0 } }, { "max", { 1, 1, 0 } } },
    { { "bufferView", 1 }, { "componentType", 5126 }, { "count", 4 }, { "type", "VEC2" } },
    { { "bufferView", 2 }, { "componentType", 5126 }, { "count", 4 }, { "type", "VEC4" } },
    { { "bufferView", 3 }, { "componentType", 5123 }, { "count", 6 }, { "type", "SCALAR" } },
  };
  document["images"] = { { { "uri", "TestCSLFGLTFReader.png" } } };
  document["samplers"] = { { { "magFilter", 9728 }, { "wrapS", 33071 }, { "wrapT", 33071 } },
    { { "wrapS", 33648 }, { "wrapT", 33071 } } };
  document["textures"] = { { { "source", 0 } }, { { "source", 0 }, { "sampler", 0 } },
    { { "source", 0 }, { "sampler", 1 } } };
  document["materials"] = materials;
  json nodes = json::array();
  json meshes = json::array();
  json roots = json::array();
  for (std::size_t i = 0; i < materials.size(); ++i)
  {
    json attributes = { { "POSITION", 0 }, { "TEXCOORD_0", 1 } };
    if (materials[i].value("name", "") == "colored")
    {
      attributes["COLOR_0"] = 2;
    }
    meshes.push_back({ { "primitives",
      { { { "attributes", attributes }, { "indices", 3 }, { "material", i } } } } });
    nodes.push_back({ { "mesh", i }, { "translation", { 2 * i, 0, 0 } } });
    roots.push_back(i);
  }
  document["meshes"] = meshes;
  document["nodes"] = nodes;
  document["scenes"] = { { { "nodes", roots } } };
  return document;
}

json MakeMaterials()
{
  return json::parse(R"([
    { "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1.0, 0.5], "metallicFactor": 0.75,
        "roughnessFactor": 0.5, "baseColorTexture": { "index": 0 },
        "metallicRoughnessTexture": { "index": 1 } },
      "normalTexture": { "index": 0, "scale": 0.5 }, "emissiveTexture": { "index": 2 },
      "emissiveFactor": [1.0, 0.5, 0.0],
      "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4.0 } } },
    { "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25],
        "baseColorTexture": { "index": 0 } } },
    { "alphaMode": "MASK", "alphaCutoff": 0.75 },
    { "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.9 },
        "KHR_materials_ior": { "ior": 1.33 }, "KHR_materials_volume": { "thicknessFactor": 1 } } },
    { "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_sheen": {} } },
    { "name": "colored", "alphaMode": "BLEND",
      "pbrMetallicRoughness": { "baseColorFactor": [0.5, 1, 1, 1] } }
  ])");
}

/// Writes the document in either form.
std::string WriteText(const std::string& folder, json document)
{
  std::ofstream(folder + "/TestCSLFGLTFReader.bin", std::ios::binary) << MakeBuffer();
  document["buffers"][0]["uri"] = "TestCSLFGLTFReader.bin";
  std::string name = folder + "/TestCSLFGLTFReader.gltf";
  std::ofstream(name) << document.dump();
  return name;
}

std::string WriteBinary(const std::string& folder, const json& document)
{
  const auto number = [](std::size_t value)
  {
    std::string bytes(4, '\0');
    for (int i = 0; i < 4; ++i)
    {
      bytes[i] = static_cast<char>((value >> (8 * i)) & 0xff);
    }
    return bytes;
  };
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string binary = MakeBuffer();
  std::string name = folder + "/TestCSLFGLTFReader.glb";
  std::ofstream(name, std::ios::binary)
    << "glTF" << number(2) << number(28 + text.size() + binary.size()) << number(text.size())
    << "JSON" << text << number(binary.size()) << std::string("BIN\0", 4) << binary;
  return name;
}

/// Two pixels, the upper one translucent.
void WriteImage(const std::string& folder)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const unsigned char pixels[] = { 255, 0, 0, 255, 0, 0, 255, 128 };
  std::memcpy(image->GetScalarPointer(), pixels, sizeof(pixels));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName((folder + "/TestCSLFGLTFReader.png").c_str());
  writer->Write();
}

void CheckMaterials(const std::string& fileName)
{
  vtkNew<vtkCSLFGLTFReader> reader;
  vtkNew<vtkTest::ErrorObserver> messages;
  reader->AddObserver(vtkCommand::WarningEvent, messages);
  reader->SetFileName(fileName.c_str());
  reader->Update();
  CSLF_CHECK(messages->GetWarningMessage().find("KHR_materials_sheen.") != std::string::npos);
  vtkMultiBlockDataSet* output = reader->GetOutput();
  CSLF_CHECK(output->GetNumberOfBlocks() == 6);
  const auto get = [output](unsigned int i)
  { return vtkPolyData::SafeDownCast(output->GetBlock(i)); };

  // All factors and textures; opaque, whatever alpha says.
  vtkPolyData* block = get(0);
  double tuple[3];
  vtkCSLFMaterial::GetBaseColor(block, tuple);
  CSLF_CHECK_NEAR(tuple[0], cslf::LinearToSRGB(0.5), 1e-6);
  CSLF_CHECK(vtkCSLFMaterial::GetMetallic(block) == 0.75);
  CSLF_CHECK(vtkCSLFMaterial::GetRoughness(block) == 0.5);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(block) == 1.0);
  CSLF_CHECK(vtkCSLFMaterial::GetIndexOfRefraction(block) == 1.5);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetNormalScale(block), 0.5, 1e-6);
  vtkCSLFMaterial::GetEmission(block, tuple);
  CSLF_CHECK(tuple[0] == 4.0 && tuple[1] == 2.0);
  vtkNew<vtkImageData> image;
  bool repeat = false;
  bool interpolate = false;
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    block, vtkCSLFMaterial::BaseColorTexture, image, repeat, interpolate));
  CSLF_CHECK(repeat && interpolate && image->GetNumberOfScalarComponents() == 3);
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    block, vtkCSLFMaterial::MetallicRoughnessTexture, image, repeat, interpolate));
  CSLF_CHECK(!repeat && !interpolate);
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    block, vtkCSLFMaterial::EmissionTexture, image, repeat, interpolate));
  int wraps[2];
  CSLF_CHECK(vtkCSLFMaterial::GetTextureWrap(block, vtkCSLFMaterial::EmissionTexture, wraps) &&
    wraps[0] == vtkCSLFMaterial::MirroredRepeat && wraps[1] == vtkCSLFMaterial::ClampToEdge);
  // The point at the lower edge of the image in glTF is at v = 0, like the image's first row.
  vtkDataArray* coordinates = block->GetPointData()->GetTCoords();
  CSLF_CHECK(coordinates && coordinates->GetComponent(0, 1) == 0.0);
  CSLF_CHECK(image->GetScalarComponentAsDouble(0, 0, 0, 0) == 255.0);

  // Alpha modes.
  CSLF_CHECK(vtkCSLFMaterial::GetOpacity(get(1)) == 0.25);
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    get(1), vtkCSLFMaterial::BaseColorTexture, image, repeat, interpolate));
  CSLF_CHECK(image->GetNumberOfScalarComponents() == 4);
  CSLF_CHECK(vtkCSLFMaterial::GetOpacityCutoff(get(2)) == 0.75);

  // Glass, solid and thin.
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetTransmission(get(3)), 0.9, 1e-9);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetIndexOfRefraction(get(3)), 1.33, 1e-9);
  CSLF_CHECK(!vtkCSLFMaterial::GetThinWalled(get(3)));
  CSLF_CHECK(vtkCSLFMaterial::GetThinWalled(get(4)));

  // Colours of vertices times the factor, linear; the node's place.
  vtkDataArray* colors = get(5)->GetPointData()->GetScalars();
  CSLF_CHECK(colors && colors->GetNumberOfComponents() == 4);
  CSLF_CHECK(colors && colors->GetComponent(0, 0) == cslf::ToByte(cslf::LinearToSRGB(0.25)));
  CSLF_CHECK(colors && colors->GetComponent(0, 3) == 128.0);
  CSLF_CHECK(get(5)->GetBounds()[0] == 10.0);
}

void TestErrors(const std::string& folder)
{
  const std::string name = folder + "/TestCSLFGLTFReaderBroken.gltf";
  std::ofstream(name) << "{ \"asset\": ";
  vtkNew<vtkCSLFGLTFReader> reader;
  vtkNew<vtkTest::ErrorObserver> messages;
  vtkNew<vtkTest::ErrorObserver> pipeline;
  reader->AddObserver(vtkCommand::ErrorEvent, messages);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  reader->Update();
  CSLF_CHECK(messages->GetErrorMessage().find("FileName is not set") != std::string::npos);
  messages->Clear();
  reader->SetFileName(name.c_str());
  reader->Update();
  CSLF_CHECK(messages->GetErrorMessage().find("cannot be read as glTF") != std::string::npos);
  CSLF_CHECK(reader->GetErrorCode() != 0);
  CSLF_CHECK(reader->GetOutput()->GetNumberOfBlocks() == 0);
}
}

int TestCSLFGLTFReader(int argc, char* argv[])
{
  std::unique_ptr<char[]> folder(
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary"));
  WriteImage(folder.get());
  const json document = MakeDocument(MakeMaterials());
  CheckMaterials(WriteText(folder.get(), document));
  CheckMaterials(WriteBinary(folder.get(), document));
  TestErrors(folder.get());
  return cslf::testing::Result();
}
