// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field's geometry in a coded file: positions within half a step, colours, figures and triangles
// come back, the mapper draws it from the decoder, and damaged bytes are refused. Its bytes are in
// the first picture of any codec, also after remuxing.
#include "Coding/Codecs/cslfCodec.h"
#include "Coding/Containers/cslfContainerReader.h"
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCodecTesting.h"
#include "cslfRemux.h"
#include "cslfTestField.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFRateControl.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkStaticPointLocator.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{
const cslf::Cube Box{ { 1.0e6, -50.0, 3.0 }, { 4.0, 2.0, 8.0 } };

/// Of viewpoints for which coordinates need 16 bits.
constexpr int Fine = 1024;

/// A sphere in the cube; its colours vary with the position.
vtkSmartPointer<vtkPolyData> MakeGeometry(int colorType)
{
  vtkNew<vtkSphereSource> source;
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->SetRadius(0.9);
  source->SetThetaResolution(40);
  source->SetPhiResolution(40);
  vtkNew<vtkTransform> transform;
  transform->Translate(Box.Center.x, Box.Center.y, Box.Center.z);
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputConnection(source->GetOutputPort());
  move->SetTransform(transform);
  move->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  move->Update();
  vtkSmartPointer<vtkPolyData> geometry = move->GetOutput();
  for (const int side : { 0, 1 })
  {
    const auto colors = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(colorType));
    colors->SetName(side == 0 ? "Color" : "BackColor");
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(geometry->GetNumberOfPoints());
    for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
    {
      double point[3];
      geometry->GetPoint(i, point);
      const double share = 0.5 + 0.5 * (point[side] - Box.Center[side]);
      const double scale = colorType == VTK_FLOAT ? 7.0 : 255.0;
      colors->SetTuple4(
        i, scale * share, scale * (1.0 - share), 0.0, colorType == VTK_FLOAT ? 1.0 : 255.0);
    }
    geometry->GetPointData()->AddArray(colors);
  }
  vtkNew<vtkDoubleArray> error;
  error->SetName(cslf::GeometryErrorName);
  error->InsertNextValue(0.125);
  geometry->GetFieldData()->AddArray(error);
  vtkNew<vtkDoubleArray> loss;
  loss->SetName(cslf::GeometryLossName);
  loss->InsertNextValue(0.0);
  geometry->GetFieldData()->AddArray(loss);
  vtkNew<vtkStringArray> scene;
  scene->SetName(cslf::GeometrySceneName);
  scene->InsertNextValue("abc");
  geometry->GetFieldData()->AddArray(scene);
  return geometry;
}

/// Marks the colours of the upper half's front as exact.
void AddExact(vtkPolyData* geometry)
{
  vtkNew<vtkUnsignedCharArray> exact;
  exact->SetName(cslf::ExactColorName);
  exact->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    // As bright as 2^(i / 8) times white.
    exact->InsertNextTuple2(geometry->GetPoint(i)[1] > Box.Center.y ? 1.0 + i % 255 : 0.0, 0.0);
  }
  geometry->GetPointData()->AddArray(exact);
}

void TestCodec(int colorType, int resolution, bool isExact = false)
{
  const auto geometry = MakeGeometry(colorType);
  if (isExact)
  {
    AddExact(geometry);
  }
  std::string error;
  const auto bytes = cslf::EncodeGeometry(geometry, Box, resolution, error);
  CSLF_CHECK(error.empty());
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded);
  if (!decoded)
  {
    return;
  }
  std::cout << static_cast<double>(bytes.size()) / geometry->GetNumberOfPolys()
            << " bytes per triangle\n";
  CSLF_CHECK(decoded->GetNumberOfPolys() == geometry->GetNumberOfPolys());
  CSLF_CHECK(decoded->GetNumberOfPoints() == geometry->GetNumberOfPoints());
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(geometry);
  locator->BuildLocator();
  for (const char* name : { "Color", "BackColor" })
  {
    vtkDataArray* colors = decoded->GetPointData()->GetArray(name);
    CSLF_CHECK(colors && colors->GetDataType() == colorType);
  }
  double most = 0.0;
  double mostColor = 0.0;
  for (vtkIdType i = 0; i < decoded->GetNumberOfPoints(); ++i)
  {
    double point[3];
    decoded->GetPoint(i, point);
    const vtkIdType same = locator->FindClosestPoint(point);
    double expected[3];
    geometry->GetPoint(same, expected);
    for (int axis = 0; axis < 3; ++axis)
    {
      most = std::max(most, std::abs(point[axis] - expected[axis]) / Box.Edges[axis]);
    }
    vtkDataArray* exact = decoded->GetPointData()->GetArray(cslf::ExactColorName);
    CSLF_CHECK((exact != nullptr) == isExact);
    for (int side = 0; exact && side < 2; ++side)
    {
      CSLF_CHECK(exact->GetComponent(i, side) ==
        geometry->GetPointData()->GetArray(cslf::ExactColorName)->GetComponent(same, side));
    }
    for (const char* name : { "Color", "BackColor" })
    {
      const double before = geometry->GetPointData()->GetArray(name)->GetComponent(same, 0);
      const double after = decoded->GetPointData()->GetArray(name)->GetComponent(i, 0);
      mostColor = std::max(mostColor, std::abs(before - after));
    }
  }
  // A step is a 64th of a texel, or the cube's edge divided by 65535.
  CSLF_CHECK(most <= 0.5001 / (64.0 * std::min(resolution, Fine) - 1.0));
  CSLF_CHECK(mostColor < (colorType == VTK_FLOAT ? 0.005 : isExact ? 0.6 : 2.6));
  // Triangles keep their sides.
  vtkNew<vtkMassProperties> mass;
  mass->SetInputData(decoded);
  CSLF_CHECK_NEAR(mass->GetVolume(), 4.0 / 3.0 * 3.14159265 * 0.9 * 0.9 * 0.9, 0.03);
  CSLF_CHECK(decoded->GetFieldData()->GetArray(cslf::GeometryErrorName)->GetTuple1(0) == 0.125);
  auto* scene = vtkStringArray::SafeDownCast(
    decoded->GetFieldData()->GetAbstractArray(cslf::GeometrySceneName));
  CSLF_CHECK(scene && scene->GetValue(0) == "abc");

  // Points outside of the cube cannot be stored.
  const cslf::Cube small{ Box.Center, { 1.0, 1.0, 1.0 } };
  CSLF_CHECK(cslf::EncodeGeometry(geometry, small, Fine, error).empty() && !error.empty());
}

/// The smallest streams there are: many points in one plane and of one colour.
void TestOneColor(int colorType)
{
  vtkNew<vtkPlaneSource> source;
  source->SetResolution(200, 200);
  source->SetCenter(Box.Center.x, Box.Center.y, Box.Center.z);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkPolyData* geometry = source->GetOutput();
  for (const char* name : { "Color", "BackColor" })
  {
    const auto colors = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(colorType));
    colors->SetName(name);
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(geometry->GetNumberOfPoints());
    colors->Fill(colorType == VTK_FLOAT ? 1.0 : 255.0);
    geometry->GetPointData()->AddArray(colors);
  }
  std::string error;
  const auto bytes = cslf::EncodeGeometry(geometry, Box, Fine, error);
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded && decoded->GetNumberOfPoints() == geometry->GetNumberOfPoints());
}

/// Nothing that a file may contain leads to more than an error.
void TestDamage()
{
  std::string error;
  const auto bytes = cslf::EncodeGeometry(MakeGeometry(VTK_UNSIGNED_CHAR), Box, Fine, error);
  for (std::size_t size = 1; size < bytes.size(); size += 1 + size / 8)
  {
    CSLF_CHECK(!cslf::DecodeGeometry({ bytes.begin(), bytes.begin() + size }, Box, error));
  }
  // Numbers and words that do not belong there, and fewer bits than the coordinates have.
  const std::string text(bytes.begin(), bytes.end());
  const std::pair<std::string, std::string> changes[] = { { "bits\":16", "bits\":17" },
    { "bits\":16", "bits\":12" }, { "green", "groan" } };
  for (const auto& [word, other] : changes)
  {
    const std::size_t place = text.find(word);
    CSLF_CHECK(place != std::string::npos);
    std::string changed = text;
    changed.replace(std::min(place, text.size()), word.size(), other);
    CSLF_CHECK(!cslf::DecodeGeometry({ changed.begin(), changed.end() }, Box, error));
  }
  std::mt19937 random(1);
  for (int i = 0; i < 600; ++i)
  {
    auto damaged = bytes;
    // Mostly in the header.
    const std::size_t range = i % 4 == 0 ? damaged.size() : 300;
    damaged[random() % range] = static_cast<unsigned char>(random());
    const auto geometry = cslf::DecodeGeometry(damaged, Box, error);
    if (geometry)
    {
      CSLF_CHECK(geometry->GetNumberOfPoints() <= (1 << 25));
    }
  }
  for (const char* text :
    { "{\"points\":33554432,\"triangles\":33554432,\"corner_bytes\":33554432,"
      "\"position_bytes\":33554432,\"color_bytes\":0}",
      "{\"points\":33554432,\"triangles\":1,\"corner_bytes\":9,\"position_bytes\":9,\"color_"
      "bytes\":9,"
      "\"colors\":\"linear16f\",\"back_color_bytes\":9}",
      "{\"points\":3,\"triangles\":1,\"corner_bytes\":9,\"position_bytes\":9,\"color_bytes\":0,"
      "\"back_color_bytes\":-1}",
      "{\"points\":3,\"triangles\":1,\"position_bits\":40,\"corner_bytes\":9,\"position_bytes\":9,"
      "\"color_bytes\":0}",
      "{\"points\":3,\"triangles\":1,\"corner_bytes\":9,\"position_bytes\":9,\"color_bytes\":9,"
      "\"colors\":\"srgb8\"}",
      "[]", "{\"points\":-1}", "{\"points\":1e9}", "{\"points\":\"many\"}" })
  {
    const std::string header(text);
    const std::string hostile = std::string(1, static_cast<char>(header.size())) +
      std::string(3, '\0') + header + std::string(100, '\0');
    CSLF_CHECK(!cslf::DecodeGeometry({ hostile.begin(), hostile.end() }, Box, error));
  }
}

/// Units that carry bytes, also those that look like start codes.
void TestUnits()
{
  std::mt19937 random(2);
  for (const cslf::Codec codec : cslf::GetCodecs())
  {
    const cslf::Bitstream& bitstream = cslf::GetBitstream(codec);
    const bool isAV1 = codec == cslf::Codec::AV1;
    // A frame's unit of two bytes.
    const std::vector<std::uint8_t> packet = isAV1
      ? std::vector<std::uint8_t>{ 6 << 3 | 2, 2, 1, 1 }
      : std::vector<std::uint8_t>{ 0, 0, 0, 1, 2, 1, 1, 0x80 };
    const cslf::Framing framing;
    std::uint32_t crc = 0;
    CSLF_CHECK(bitstream.AddToCRC(packet.data(), packet.size(), framing, crc));
    for (const int most : { 0, 3, 255 })
    {
      for (const std::size_t size : { 1, 17, 238, 239, 240, 494, 70000 })
      {
        std::vector<unsigned char> bytes(size);
        std::generate(bytes.begin(), bytes.end(),
          [&] { return static_cast<unsigned char>(random() % (most + 1)); });
        std::vector<std::uint8_t> loaded = bitstream.Load(packet, bytes);
        std::uint32_t same = 0;
        CSLF_CHECK(bitstream.Unload(loaded.data(), loaded.size(), framing) == bytes);
        CSLF_CHECK(bitstream.AddToCRC(loaded.data(), loaded.size(), framing, same) && same == crc);
        CSLF_CHECK(loaded.size() < packet.size() + 1.51 * size + size / 255 + 40);
        // Units of others are refused, as they may change the picture.
        loaded[14] ^= 1;
        CSLF_CHECK(!bitstream.AddToCRC(loaded.data(), loaded.size(), framing, same));
        CSLF_CHECK(bitstream.Unload(loaded.data(), loaded.size(), framing).empty());
        loaded[14] ^= 1;
        // Less than the mark.
        for (std::size_t length = 0; length < 22; ++length)
        {
          CSLF_CHECK(bitstream.Unload(loaded.data(), length, framing).empty());
        }
      }
    }
  }
}

void WriteField(
  vtkImageData* field, vtkPolyData* surfaces, const char* codec, const std::string& fileName)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  encoder->SetGeometryData(surfaces);
  encoder->SetFileName(fileName.c_str());
  encoder->SetCodec(codec);
  encoder->SetPreset("ultrafast");
  encoder->RestartOff();
  CSLF_CHECK(encoder->Write() == 1);
}

/// The geometry of a file. None if it is damaged.
std::vector<unsigned char> ReadBytes(const std::string& fileName)
{
  cslf::OpenError failure;
  const auto reader = cslf::ContainerReader::Open(fileName, failure);
  const cslf::FilePart* part = reader ? reader->GetHeader().FindGeometry() : nullptr;
  CSLF_CHECK(reader && reader->IsWhole(0, reader->Read(0)));
  return part ? part->Bytes : std::vector<unsigned char>();
}

void TestCarried(const std::string& folder)
{
  const auto field = cslf::testing::MakeTestField(
    cslf::Layout(2, 64), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  const auto surfaces = cslf::testing::MakeTestSurfaces(cslf::Cube());
  for (const char* codec : { "hevc", "h264", "av1" })
  {
    for (const char* container : { "mp4", "mkv" })
    {
      const std::string other = container == std::string("mp4") ? "mkv" : "mp4";
      const std::string name = folder + "/" + codec;
      WriteField(field, surfaces, codec, name + "." + container);
      CSLF_CHECK(cslf::testing::Remux(name + "." + container, name + "-1." + other));
      CSLF_CHECK(cslf::testing::Remux(name + "-1." + other, name + "-2." + container));
      const std::vector<unsigned char> bytes = ReadBytes(name + "." + container);
      CSLF_CHECK(bytes.size() > 1000);
      CSLF_CHECK(ReadBytes(name + "-1." + other) == bytes);
      CSLF_CHECK(ReadBytes(name + "-2." + container) == bytes);
      CSLF_CHECK(cslf::testing::ReadTag(name + "." + container, "synopsis").empty());
    }
  }
}

/// Through a file to the mapper.
void TestFile(const std::string& fileName)
{
  const auto field = cslf::testing::MakeTestField(
    cslf::Layout(5, 64), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  const auto surfaces = cslf::testing::MakeTestSurfaces(cslf::Cube());
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  encoder->SetGeometryData(surfaces);
  encoder->SetFileName(fileName.c_str());
  encoder->GetRateControl()->SetCRF(16.0);
  encoder->SetPreset("ultrafast");
  encoder->RestartOff();
  CSLF_CHECK(encoder->Write() == 1);

  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(fileName.c_str());
  decoder->UpdateInformation();
  CSLF_CHECK(decoder->HasGeometry() && decoder->GetNumberOfParts() == 1);
  decoder->Update(1);
  CSLF_CHECK(decoder->GetGeometry()->GetNumberOfPolys() > 1000);
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
  decoder->Update();
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == field->GetNumberOfPoints());
  CSLF_CHECK(decoder->GetGeometry()->GetNumberOfPolys() > 1000);

  vtkNew<vtkCSLFDecoder> both;
  both->SetFileName(fileName.c_str());
  both->Update();
  CSLF_CHECK(both->GetGeometry()->GetNumberOfPolys() == decoder->GetGeometry()->GetNumberOfPolys());

  cslf::testing::View view;
  vtkNew<vtkCSLFMapper> fromFile;
  fromFile->SetInputConnection(0, decoder->GetOutputPort(0));
  fromFile->SetInputConnection(1, decoder->GetOutputPort(1));
  const auto actor = view.Add(fromFile);
  const auto drawn = view.Render();
  vtkNew<vtkCSLFMapper> original;
  original->SetInputData(field);
  original->SetGeometryData(surfaces);
  actor->SetMapper(original);
  const double psnr = cslf::testing::ComparePictures(drawn, view.Render());
  std::cout << "coded: " << psnr << " dB\n";
  CSLF_CHECK(psnr > 36.0);

  // Without geometry, the port is empty.
  encoder->SetInputConnection(1, nullptr);
  CSLF_CHECK(encoder->Write() == 1);
  vtkNew<vtkCSLFDecoder> plain;
  plain->SetFileName(fileName.c_str());
  plain->Update(1);
  CSLF_CHECK(!plain->HasGeometry() && plain->GetGeometry()->GetNumberOfPolys() == 0);
}
}

int TestCSLFEncoderGeometry(int argc, char* argv[])
{
  TestCodec(VTK_UNSIGNED_CHAR, 2 * Fine);
  TestCodec(VTK_UNSIGNED_CHAR, 2 * Fine, true);
  TestCodec(VTK_UNSIGNED_CHAR, 128);
  TestCodec(VTK_FLOAT, Fine);
  TestOneColor(VTK_UNSIGNED_CHAR);
  TestOneColor(VTK_FLOAT);
  TestDamage();
  TestUnits();
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderGeometry");
  TestCarried(folder);
  TestFile(folder + "/field.mp4");
  return cslf::testing::Result();
}
