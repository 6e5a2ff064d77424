// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Textures of surfaces become images of their geometry, which files keep and mappers show.
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "PathTracing/Materials/cslfTexture.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfColor.h"
#include "cslfCube.h"
#include "cslfTestColorMaps.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkAppendPolyData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace
{
const cslf::Cube Box{ { 0.0, 0.0, 0.0 }, { 2.4, 2.4, 2.4 } };

/// How an image lies on a sheet from -1 to 1.
struct Look
{
  const char* Name;
  int Size;               ///< of the image
  cslf::TextureWrap Wrap; ///< along both axes
  bool Interpolates;
  double First; ///< texture coordinates of the sheet's corners
  double Last;
  double MaximumError; ///< RMS, of 255
  std::size_t MaximumBytes;
};

/// Smooth colours, or those of squares.
cslf::TextureImage MakeImage(const Look& look)
{
  cslf::TextureImage image;
  image.Width = look.Size;
  image.Height = look.Size;
  image.Wraps[0] = look.Wrap;
  image.Wraps[1] = look.Wrap;
  image.Interpolate = look.Interpolates;
  for (int y = 0; y < look.Size; ++y)
  {
    for (int x = 0; x < look.Size; ++x)
    {
      const double u = (x + 0.5) / look.Size;
      const double v = (y + 0.5) / look.Size;
      const bool isDark = (x * 7 + y * 3) % 5 < 2;
      image.Pixels.push_back(
        cslf::ToByte(look.Interpolates ? 0.5 + 0.4 * std::sin(9.0 * u) * std::cos(7.0 * v)
            : isDark                   ? 0.1
                                       : 0.9));
      image.Pixels.push_back(cslf::ToByte(0.2 + 0.6 * u));
      image.Pixels.push_back(cslf::ToByte(0.9 - 0.7 * v * v));
      image.Pixels.push_back(255);
    }
  }
  return image;
}

vtkSmartPointer<vtkPolyData> MakeSheet(const Look& look, const cslf::TextureImage& image)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-1.0, -1.0, 0.0);
  source->SetPoint1(1.0, -1.0, 0.0);
  source->SetPoint2(-1.0, 1.0, 0.0);
  source->SetResolution(20, 20);
  source->Update();
  vtkSmartPointer<vtkPolyData> sheet = source->GetOutput();
  vtkDataArray* coordinates = sheet->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; i < sheet->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      coordinates->SetComponent(
        i, axis, look.First + (look.Last - look.First) * coordinates->GetComponent(i, axis));
    }
  }
  vtkNew<vtkImageData> pixels;
  pixels->SetDimensions(look.Size, look.Size, 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  std::copy(image.Pixels.begin(), image.Pixels.end(),
    static_cast<unsigned char*>(pixels->GetScalarPointer()));
  const int slot = vtkCSLFMaterial::BaseColorTexture;
  const int wrap = static_cast<int>(look.Wrap);
  vtkCSLFMaterial::SetBaseColor(sheet, 1.0, 1.0, 1.0);
  CSLF_CHECK(vtkCSLFMaterial::SetTexture(
    sheet, slot, pixels, look.Wrap == cslf::TextureWrap::Repeat, look.Interpolates));
  CSLF_CHECK(vtkCSLFMaterial::SetTextureWrap(sheet, slot, wrap, wrap));
  return sheet;
}

/// The RMS error of a decoded geometry's colours on its front beside those of the texture, in
/// white light.
double MeasureError(vtkPolyData* geometry, const Look& look, const cslf::Texture& texture)
{
  const cslf::MappedPoints points = cslf::FindMappedPoints(geometry);
  CSLF_CHECK(points.Maps.size() == 1 && points.Maps[0].IsImage());
  constexpr int steps = 40;
  double sum = 0.0;
  double weights = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < geometry->GetNumberOfCells(); ++i)
  {
    geometry->GetCellPoints(i, corners);
    std::array<std::size_t, 3> numbers{};
    glm::dvec3 places[3];
    for (int k = 0; k < 3; ++k)
    {
      numbers[k] = static_cast<std::size_t>(corners->GetId(k));
      geometry->GetPoint(corners->GetId(k), &places[k].x);
    }
    // Beyond the sheet, something else may lie.
    if (std::max({ places[0].x, places[1].x, places[2].x }) > 1.01)
    {
      continue;
    }
    const double area = glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
    for (int sample = 0; sample < steps * steps; ++sample)
    {
      double u = (sample % steps + 0.5) / steps;
      double v = (sample / steps + 0.5) / steps;
      if (u + v > 1.0)
      {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const glm::dvec3 weight(1.0 - u - v, u, v);
      const glm::dvec3 place = weight.x * places[0] + weight.y * places[1] + weight.z * places[2];
      const glm::vec2 coordinates(
        glm::mix(glm::dvec2(look.First), glm::dvec2(look.Last), 0.5 * (glm::dvec2(place) + 1.0)));
      const glm::dvec3 expected =
        cslf::LinearToSRGB(glm::dvec3(glm::vec3(texture.Get(coordinates))));
      const glm::dvec3 error = cslf::ShowPlace(points, 0, numbers, weight) - expected;
      sum += area * glm::dot(error, error) / 3.0;
      weights += area;
    }
  }
  return 255.0 * std::sqrt(sum / weights);
}

/// A sheet needs few triangles, and no more pixels than texels ask for.
void TestSheet(const Look& look)
{
  const cslf::TextureImage image = MakeImage(look);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetViewpoints(2);
  sampler->SetResolution(64);
  sampler->SetQuality(vtkCSLFSampler::Preview);
  sampler->SetAutomaticCube(false);
  sampler->SetCubeCenter(&glm::dvec3(Box.Center)[0]);
  sampler->SetCubeEdges(&glm::dvec3(Box.Edges)[0]);
  sampler->GetEnvironment()->SetColor(1.0, 1.0, 1.0);
  sampler->SetInputData(MakeSheet(look, image));
  sampler->Update();
  std::string error;
  const std::vector<unsigned char> bytes =
    cslf::EncodeGeometry(sampler->GetGeometry(), Box, 64, error);
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded != nullptr);
  const cslf::Texture texture(image, cslf::TextureKind::Colors);
  const double rms = MeasureError(decoded, look, texture);
  const auto maps = cslf::FindColorMaps(decoded);
  std::cout << look.Name << ": " << decoded->GetNumberOfCells() << " triangles, " << bytes.size()
            << " bytes, image of " << maps.front().Layout.Width << " x "
            << maps.front().Layout.Height << ", error " << rms << " of 255\n";
  CSLF_CHECK(rms <= look.MaximumError);
  CSLF_CHECK(bytes.size() <= look.MaximumBytes);
  CSLF_CHECK(decoded->GetNumberOfCells() <= 128);
  // The image is coded once.
  CSLF_CHECK(cslf::FindColorMaps(decoded).front().Image->GetEncoded() ==
    cslf::FindColorMaps(sampler->GetGeometry()).front().Image->GetEncoded());
}

/// A neighbour on which the image is much smaller does not make it too coarse for a sheet.
void TestUneven()
{
  const Look look{ "", 128, cslf::TextureWrap::Repeat, true, 0.0, 1.0, 0.0, 0 };
  const Look small{ "", 128, cslf::TextureWrap::Repeat, true, 0.0, 30.0, 0.0, 0 };
  const cslf::TextureImage image = MakeImage(look);
  const auto sheet = MakeSheet(look, image);
  const auto neighbor = MakeSheet(small, image);
  for (vtkIdType i = 0; i < neighbor->GetNumberOfPoints(); ++i)
  {
    double point[3];
    neighbor->GetPoint(i, point);
    neighbor->GetPoints()->SetPoint(i, point[0] + 2.2, point[1], point[2]);
  }
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(sheet);
  both->AddInputData(neighbor);
  both->Update();
  const vtkSmartPointer<vtkPolyData> scene = both->GetOutput();
  scene->GetFieldData()->ShallowCopy(sheet->GetFieldData());
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetViewpoints(2);
  sampler->SetResolution(64);
  sampler->SetQuality(vtkCSLFSampler::Preview);
  sampler->GetEnvironment()->SetColor(1.0, 1.0, 1.0);
  sampler->SetInputData(scene);
  sampler->Update();
  const double rms =
    MeasureError(sampler->GetGeometry(), look, cslf::Texture(image, cslf::TextureKind::Colors));
  std::cout << "beside a dense neighbour: error " << rms << " of 255\n";
  CSLF_CHECK(rms <= 2.5);
}

/// What is damaged is refused.
void TestDamage()
{
  cslf::MapImage::Layout layout;
  layout.Width = 160;
  layout.Height = 90;
  const auto image = cslf::MapImage::Make(layout,
    [](const glm::dvec2& place)
    {
      return glm::vec3(
        0.006 * place.x, 0.01 * place.y, 0.5 + 0.3 * std::sin(0.002 * place.x * place.y));
    });
  std::vector<unsigned char> bytes = image->GetEncoded();
  const auto isRefused = [](const cslf::MapImage::Layout& own, std::vector<unsigned char> encoded)
  {
    try
    {
      cslf::MapImage::Read(own, std::move(encoded));
      return false;
    }
    catch (const std::exception&)
    {
      return true;
    }
  };
  CSLF_CHECK(!isRefused(image->GetLayout(), bytes));
  CSLF_CHECK(image->GetLayout().IsJPEG);
  layout = image->GetLayout();
  layout.Height = 91;
  CSLF_CHECK(isRefused(layout, bytes));
  CSLF_CHECK(isRefused(image->GetLayout(), {}));
  CSLF_CHECK(isRefused(image->GetLayout(), { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 }));
  for (std::size_t size = 2; size < bytes.size(); size += 7)
  {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
    CSLF_CHECK(isRefused(image->GetLayout(), { bytes.begin(), end }));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    std::vector<unsigned char> other = bytes;
    other[i] = static_cast<unsigned char>(other[i] ^ (i % 255 + 1));
    isRefused(image->GetLayout(), other); // or not, but without a crash
  }
}

/// The mapper shows an image as its class does, beside a colour map.
void TestMapper(bool isSmooth, bool repeats)
{
  cslf::MapImage::Layout layout;
  layout.Width = 6;
  layout.Height = 5;
  layout.Repeats[0] = repeats;
  layout.IsSmooth = isSmooth;
  const auto image = cslf::MapImage::Make(layout,
    [](const glm::dvec2& place)
    {
      const int number = int(place.x) * 5 + int(place.y) * 3;
      return glm::vec3(
        0.1f + 0.1f * (number % 8), 0.05f * (number % 17), 0.9f - 0.1f * (number % 7));
    });
  const cslf::ColorMap map = cslf::MakeImageMap(image);
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-0.8, -0.8, 0.0);
  source->SetPoint1(0.8, -0.8, 0.0);
  source->SetPoint2(-0.8, 0.8, 0.0);
  source->SetResolution(3, 3);
  source->Update();
  vtkPolyData* sheet = source->GetOutput();
  sheet->GetPointData()->Initialize();
  // All that VTK needs, and then the image in place of the map.
  cslf::testing::AddColors(sheet, cslf::testing::MakeRainbow(-1.0, 1.0));
  cslf::MappedPoints points = cslf::FindMappedPoints(sheet);
  points.Maps.push_back(map);
  cslf::SurfaceArray places;
  places.Name = cslf::TexturePlacesName;
  places.IsInteger = true;
  places.Components = { { "X", {} }, { "Y", {} } };
  const auto placeAt = [&](double x, double y)
  { return glm::dvec2(5.0 + 7.5 * x, 2.5 + 3.75 * y); };
  for (vtkIdType i = 0; i < sheet->GetNumberOfPoints(); ++i)
  {
    const double* point = sheet->GetPoint(i);
    const glm::dvec2 place = placeAt(point[0], point[1]) * double(layout.Steps);
    places.Components[0].Values.push_back(std::round(place.x));
    places.Components[1].Values.push_back(std::round(place.y));
    points.Numbers[static_cast<std::size_t>(i)] = 2;
  }
  points.Arrays.push_back(places);
  cslf::AddMappedPoints(points, sheet);
  cslf::testing::View view(cslf::testing::MapSize);
  view.Add(cslf::testing::MakeMapper(sheet));
  view.GetCamera()->SetPosition(0.0, 0.0, 4.0);
  view.GetCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  view.GetCamera()->SetViewUp(0.0, 1.0, 0.0);
  view.GetCamera()->ParallelProjectionOn();
  view.GetCamera()->SetParallelScale(1.0);
  const cslf::testing::Picture picture = view.Render();
  int different = 0;
  int inside = 0;
  for (int i = 0; i < cslf::testing::MapSize * cslf::testing::MapSize; ++i)
  {
    const double x = 2.0 * (i % cslf::testing::MapSize + 0.5) / cslf::testing::MapSize - 1.0;
    const double y = 2.0 * (i / cslf::testing::MapSize + 0.5) / cslf::testing::MapSize - 1.0;
    if (std::max(std::abs(x), std::abs(y)) > 0.78)
    {
      continue;
    }
    ++inside;
    const glm::dvec3 expected =
      cslf::ShowLight(glm::dvec3(cslf::EncodeLight(cslf::testing::MapLight)), map, placeAt(x, y));
    double most = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      most = std::max(
        most, std::abs(picture.Colors[static_cast<std::size_t>(3 * i + c)] - 255.0 * expected[c]));
    }
    different += most > 3.0 ? 1 : 0;
  }
  std::cout << (isSmooth ? "smooth" : "squares") << (repeats ? ", repeated: " : ": ") << different
            << " of " << inside << " pixels differ\n";
  CSLF_CHECK(inside > 10000 && different <= inside / 100);
}
}

int TestCSLFGeometryImages(int, char*[])
{
  using cslf::TextureWrap;
  TestSheet({ "a large image", 512, TextureWrap::Edge, true, 0.0, 1.0, 2.5, 20000 });
  TestSheet({ "a part of it", 512, TextureWrap::Repeat, true, 0.25, 0.6, 2.5, 20000 });
  TestSheet({ "a small one that repeats", 16, TextureWrap::Repeat, true, -0.5, 2.0, 2.5, 4000 });
  TestSheet({ "one that is mirrored", 24, TextureWrap::Mirror, true, -1.0, 2.0, 2.5, 8000 });
  TestSheet({ "edges that go on", 24, TextureWrap::Edge, true, -1.0, 2.0, 2.5, 4000 });
  // Edges are off by at most about 1/50 of a texel.
  TestSheet({ "squares", 8, TextureWrap::Edge, false, 0.0, 1.0, 10.0, 3000 });
  TestSheet({ "squares that repeat", 8, TextureWrap::Repeat, false, 0.0, 2.0, 15.0, 3000 });
  TestUneven();
  TestDamage();
  for (const bool isSmooth : { false, true })
  {
    for (const bool repeats : { false, true })
    {
      TestMapper(isSmooth, repeats);
    }
  }
  return cslf::testing::Result();
}
