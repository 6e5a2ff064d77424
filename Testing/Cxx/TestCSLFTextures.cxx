// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Textures: their pixels, their storage in data, and their effect on light.
#include "PathTracing/Materials/cslfTexture.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTestErrorObserver.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

cslf::TextureImage MakeChecker(bool repeat, bool interpolate)
{
  const cslf::TextureWrap wrap = repeat ? cslf::TextureWrap::Repeat : cslf::TextureWrap::Edge;
  return { 2, 2, { wrap, wrap }, interpolate,
    { 0, 0, 0, 255, 255, 51, 0, 128, 255, 255, 255, 255, 0, 0, 255, 0 } };
}

void TestPixels()
{
  // The centres of pixels have their values, with any interpolation; the first row is at the
  // bottom.
  for (bool interpolate : { false, true })
  {
    const cslf::Texture colors(MakeChecker(true, interpolate), cslf::TextureKind::Colors);
    CSLF_CHECK(colors.IsTranslucent());
    const glm::vec4 right = colors.Get({ 0.75f, 0.25f });
    CSLF_CHECK_NEAR(right.x, 1.0, 1e-6);
    CSLF_CHECK_NEAR(right.y, cslf::SRGBToLinear(0.2), 1e-6);
    CSLF_CHECK_NEAR(right.w, 128.0 / 255.0, 1e-6);
    CSLF_CHECK(colors.Get({ 0.25f, 0.75f }) == glm::vec4(1.0f));
    const cslf::Texture numbers(MakeChecker(true, interpolate), cslf::TextureKind::Numbers);
    CSLF_CHECK_NEAR(numbers.Get({ 0.75f, 0.25f }).y, 0.2, 1e-6);
    // A full period away is the same place.
    CSLF_CHECK(
      glm::distance(numbers.Get({ -0.25f, 3.25f }), numbers.Get({ 0.75f, 0.25f })) < 1e-5f);
  }
  const cslf::Texture clamped(MakeChecker(false, true), cslf::TextureKind::Numbers);
  CSLF_CHECK(clamped.Get({ 0.1f, 7.0f }) == glm::vec4(1.0f));
  CSLF_CHECK_NEAR(clamped.Get({ 0.5f, 0.0f }).x, 0.5, 1e-6);
  const cslf::Texture repeated(MakeChecker(true, true), cslf::TextureKind::Numbers);
  CSLF_CHECK_NEAR(repeated.Get({ 0.5f, 0.0f }).x, 0.5, 1e-6);
  CSLF_CHECK_NEAR(repeated.Get({ 0.0f, 0.25f }).x, 0.5, 1e-6);
  const cslf::Texture nearest(MakeChecker(true, false), cslf::TextureKind::Numbers);
  CSLF_CHECK(nearest.Get({ 0.49f, 0.51f }).x == 1.0f && nearest.Get({ 1.0f, 1.0f }).x == 0.0f);
}

/// Two pixels side by side, 0 and 1, and the continuation beyond them along u.
void TestWraps()
{
  using Wrap = cslf::TextureWrap;
  const auto get = [](Wrap wrap, bool interpolate, float u)
  {
    cslf::TextureImage image{ 2, 1, { wrap, Wrap::Edge }, interpolate,
      { 0, 0, 0, 255, 255, 255, 255, 255 } };
    image.Border = { 51, 51, 51, 255 };
    const cslf::Texture texture(image, cslf::TextureKind::Numbers);
    CSLF_CHECK(!texture.IsTranslucent());
    return texture.Get({ u, 5.0f }).x;
  };
  for (const bool interpolate : { false, true })
  {
    CSLF_CHECK_NEAR(get(Wrap::Edge, interpolate, 2.25f), 1.0, 1e-6);
    CSLF_CHECK_NEAR(get(Wrap::Repeat, interpolate, 2.25f), 0.0, 1e-6);
    for (const float turn : { -100.0f, -2.0f, 0.0f, 64.0f })
    {
      CSLF_CHECK_NEAR(get(Wrap::Mirror, interpolate, turn + 0.25f), 0.0, 1e-6);
      CSLF_CHECK_NEAR(get(Wrap::Mirror, interpolate, turn + 1.25f), 1.0, 1e-6);
      CSLF_CHECK_NEAR(get(Wrap::Mirror, interpolate, turn - 0.25f), 0.0, 1e-6);
      CSLF_CHECK_NEAR(get(Wrap::Mirror, interpolate, turn - 0.75f), 1.0, 1e-6);
    }
    for (const float far : { -1e20f, -0.5f, 1.25f, 1e20f })
    {
      CSLF_CHECK_NEAR(get(Wrap::Border, interpolate, far), 0.2, 1e-6);
    }
    CSLF_CHECK_NEAR(get(Wrap::Border, interpolate, 0.75f), 1.0, 1e-6);
  }
  // Halfway between a pixel and its neighbour.
  CSLF_CHECK_NEAR(get(Wrap::Edge, true, 1.0f), 1.0, 1e-6);
  CSLF_CHECK_NEAR(get(Wrap::Repeat, true, 1.0f), 0.5, 1e-6);
  CSLF_CHECK_NEAR(get(Wrap::Mirror, true, 1.0f), 1.0, 1e-6);
  CSLF_CHECK_NEAR(get(Wrap::Border, true, 1.0f), 0.6, 1e-6);
}

/// An image of RGB pixels, row by row from the bottom.
vtkSmartPointer<vtkImageData> MakeImage(
  int width, int height, int components, std::initializer_list<int> values)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, components);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int value : values)
  {
    *pixels++ = static_cast<unsigned char>(value);
  }
  return image;
}

void TestFieldData()
{
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkPolyData* data = plane->GetOutput();
  auto image = MakeImage(2, 1, 3, { 255, 0, 0, 0, 255, 0 });
  const int slot = vtkCSLFMaterial::BaseColorTexture;
  CSLF_CHECK(vtkCSLFMaterial::SetTexture(data, slot, image, false, true));
  CSLF_CHECK(data->GetFieldData()->GetArray(vtkCSLFMaterial::TextureName(slot)) != nullptr);
  CSLF_CHECK(image->GetPointData()->GetScalars() !=
    data->GetFieldData()->GetArray(vtkCSLFMaterial::TextureName(slot)));

  // It survives filters and files.
  vtkNew<vtkTransform> transform;
  transform->Translate(1, 2, 3);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetTransform(transform);
  filter->SetInputData(data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(filter->GetOutputPort());
  writer->WriteToOutputStringOn();
  CSLF_CHECK(writer->Write() == 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  vtkNew<vtkImageData> read;
  bool repeat = true;
  bool interpolate = false;
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(reader->GetOutput(), slot, read, repeat, interpolate));
  CSLF_CHECK(!repeat && interpolate);
  CSLF_CHECK(read->GetDimensions()[0] == 2 && read->GetDimensions()[1] == 1);
  CSLF_CHECK(read->GetScalarComponentAsDouble(1, 0, 0, 1) == 255.0);

  // A block takes its root's texture; null removes it.
  vtkNew<vtkPolyData> block;
  vtkCSLFMaterial::Inherit(block, data);
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(block, slot, read, repeat, interpolate));
  CSLF_CHECK(!vtkCSLFMaterial::SetTexture(block, slot, nullptr));
  CSLF_CHECK(!vtkCSLFMaterial::GetTexture(block, slot, read, repeat, interpolate));

  // From a property.
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->InterpolateOn();
  vtkNew<vtkProperty> property;
  property->SetInterpolationToPBR();
  property->SetEmissiveFactor(0.5, 1.0, 2.0);
  property->SetNormalTexture(texture);
  vtkNew<vtkTexture> colors;
  colors->SetInputData(image);
  colors->InterpolateOn();
  colors->UseSRGBColorSpaceOn();
  property->SetEmissiveTexture(colors);
  property->SetNormalScale(0.5);
  vtkNew<vtkPolyData> holder;
  vtkCSLFMaterial::SetFromProperty(holder, property);
  CSLF_CHECK(vtkCSLFMaterial::GetTexture(
    holder, vtkCSLFMaterial::EmissionTexture, read, repeat, interpolate));
  CSLF_CHECK(interpolate && repeat);
  CSLF_CHECK(
    vtkCSLFMaterial::GetTexture(holder, vtkCSLFMaterial::NormalTexture, read, repeat, interpolate));
  CSLF_CHECK(!vtkCSLFMaterial::GetTexture(holder, slot, read, repeat, interpolate));
  double emission[3];
  vtkCSLFMaterial::GetEmission(holder, emission);
  CSLF_CHECK(emission[0] == 0.5 && emission[2] == 2.0);
  CSLF_CHECK(vtkCSLFMaterial::GetNormalScale(holder) == 0.5);
}

/// A square that fills the picture, textured, under a white sky; its colours left and right.
void TestPicture()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1, -1, 0);
  plane->SetPoint1(1, -1, 0);
  plane->SetPoint2(-1, 1, 0);
  plane->Update();
  vtkPolyData* data = plane->GetOutput();
  data->GetPointData()->SetNormals(nullptr);
  vtkCSLFMaterial::SetBaseColor(data, 1.0, 0.5, 1.0);
  // Lower left, lower right, upper left, upper right.
  vtkCSLFMaterial::SetTexture(data, vtkCSLFMaterial::BaseColorTexture,
    MakeImage(2, 2, 4, { 255, 255, 255, 255, 51, 255, 255, 255, 0, 0, 0, 255, 255, 0, 0, 0 }), true,
    false);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 5);
  camera->ParallelProjectionOn();
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputData(data);
  tracer->SetCamera(camera);
  tracer->SetSize(4, 4);
  tracer->SetSamples(16);
  tracer->SetColorTypeToFloat();
  vtkNew<vtkTest::ErrorObserver> messages;
  tracer->AddObserver(vtkCommand::WarningEvent, messages);
  const auto check = [&tracer](int column, int row, const glm::dvec4& expected)
  {
    double color[4];
    tracer->GetOutput()->GetPointData()->GetScalars()->GetTuple(row * 4 + column, color);
    for (int i = 0; i < 4; ++i)
    {
      CSLF_CHECK_NEAR(color[i], expected[i], 2e-3);
    }
  };
  tracer->Update();
  const double half = cslf::SRGBToLinear(0.5);
  check(0, 0, { 1.0, half, 1.0, 1.0 });
  check(3, 1, { cslf::SRGBToLinear(0.2), half, 1.0, 1.0 });
  check(1, 3, { 0.0, 0.0, 0.0, 1.0 });
  check(2, 2, { 0.0, 0.0, 0.0, 0.0 });
  CSLF_CHECK(!messages->GetWarning());

  // Without coordinates there is a warning, and no texture.
  data->GetPointData()->SetTCoords(nullptr);
  tracer->SetInputData(data);
  tracer->Update();
  check(0, 0, { 1.0, half, 1.0, 1.0 });
  check(2, 2, { 1.0, half, 1.0, 1.0 });
  CSLF_CHECK(messages->GetWarning());
}

/// A rectangle with coordinates in [0,1].
cslf::Mesh MakeTextured(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v,
  const cslf::SurfaceMaterial& material)
{
  cslf::Mesh mesh = MakeRectangle(center, u, v, material);
  mesh.TexCoords = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  return mesh;
}

std::shared_ptr<const cslf::Texture> MakeUniform(
  std::uint8_t red, std::uint8_t green, std::uint8_t blue, cslf::TextureKind kind)
{
  return std::make_shared<cslf::Texture>(
    cslf::TextureImage{ 1, 1, { cslf::TextureWrap::Repeat, cslf::TextureWrap::Repeat }, true,
      { red, green, blue, 255 } },
    kind);
}

void TestNormals()
{
  // A mirror that is bent by a quarter of a right angle towards u, or v, reflects as if it were
  // turned, from both sides, and with any orientation of the texture.
  const float turn = cslf::Pi / 8.0f;
  const auto byte = [](float value)
  { return static_cast<std::uint8_t>(std::lround(255.0f * 0.5f * (value + 1.0f))); };
  cslf::LightSet lights;
  lights.Surroundings =
    cslf::Environment(Dark, glm::vec3(2.0f), cslf::EnvironmentAxes::FromUp(glm::dvec3(1, 0, 0)));
  const cslf::SurfaceMaterial mirror(White, 1.0f, 0.0f, 1.0f, Dark);
  for (float side : { 1.0f, -1.0f })
  {
    for (bool mirrored : { false, true })
    {
      cslf::Mesh mesh = MakeTextured({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, mirror);
      if (mirrored)
      {
        mesh.TexCoords = { { 1, 0 }, { 0, 0 }, { 0, 1 }, { 1, 1 } };
      }
      mesh.Textures.Normal = MakeUniform(byte(std::sin(turn) * (mirrored ? -1.0f : 1.0f)),
        byte(0.0f), byte(std::cos(turn)), cslf::TextureKind::Numbers);
      const cslf::Scene scene({ mesh }, lights);
      // The reflected direction is (sin, 0, cos) of twice the turn; below, the bent normal's
      // opposite reflects to (-sin, 0, -cos).
      const Estimate estimate =
        Trace(scene, LookAt({ 0.1f, 0.2f, side }, { 0.1f, 0.2f, 0 }), {}, 16);
      CSLF_CHECK_NEAR(estimate.Mean, 1.0 + side * std::sin(2.0 * turn), 0.02);
    }
  }
  // Along v: the sky's x does not change.
  cslf::Mesh mesh = MakeTextured({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, mirror);
  mesh.Textures.Normal =
    MakeUniform(byte(0.0f), byte(std::sin(turn)), byte(std::cos(turn)), cslf::TextureKind::Numbers);
  lights.Surroundings =
    cslf::Environment(Dark, glm::vec3(2.0f), cslf::EnvironmentAxes::FromUp(glm::dvec3(0, 1, 0)));
  const cslf::Scene scene({ mesh }, lights);
  CSLF_CHECK_NEAR(Trace(scene, LookAt({ 0.1f, 0.2f, 1 }, { 0.1f, 0.2f, 0 }), {}, 16).Mean,
    1.0 + std::sin(2.0 * turn), 0.02);
}

void TestMetallicRoughness()
{
  // Blue and green of the texture make a rough metal with factors of 1 look like the material
  // alone.
  cslf::LightSet lights;
  lights.Surroundings =
    cslf::Environment(Dark, White, cslf::EnvironmentAxes::FromUp(glm::dvec3(0, 1, 0)));
  cslf::SurfaceMaterial factors(glm::vec3(0.5f), 1.0f, 1.0f, 1.5f, Dark);
  factors.DielectricSpecular = cslf::SpecularAlbedo(1.5f);
  cslf::Mesh textured = MakeTextured({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, factors);
  textured.Textures.MetallicRoughness = MakeUniform(7, 102, 51, cslf::TextureKind::Numbers);
  const cslf::Mesh plain = MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
    cslf::SurfaceMaterial(glm::vec3(0.5f), 0.2f, 0.4f, 1.5f, Dark));
  const cslf::Ray ray = LookAt({ 0.3f, 0.8f, 0.5f }, { 0.1f, 0.2f, 0 });
  const cslf::Scene first({ textured }, lights);
  const cslf::Scene second({ plain }, lights);
  const Estimate a = Trace(first, ray, {}, 1 << 14);
  const Estimate b = Trace(second, ray, {}, 1 << 14);
  CSLF_CHECK_NEAR(a.Mean, b.Mean, 4.0 * (a.Error + b.Error) + 0.002);
}

void TestEmission()
{
  // A lamp with a bright corner: the estimators agree with each other, and with a lamp of only the
  // corner.
  const auto trace = [](cslf::Mesh lamp, bool light, bool surface)
  {
    std::vector<cslf::Mesh> meshes{ MakeRectangle(
      { 0, 0, 0 }, { 9, 0, 0 }, { 0, 9, 0 }, MakeDiffuse(0.5f)) };
    meshes.push_back(std::move(lamp));
    const cslf::Scene scene(std::move(meshes), {});
    cslf::PathSettings settings;
    settings.MaximumDepth = 1;
    settings.LightSampling = light;
    settings.BSDFSampling = surface;
    return Trace(scene, LookAt({ 3, 0, 0.5f }, { 0.5f, 0.2f, 0 }), settings, 1 << 16);
  };
  const Estimate corner =
    trace(MakeRectangle({ 0.5f, 0.5f, 1 }, { 0.5f, 0, 0 }, { 0, 0.5f, 0 }, MakeDiffuse(0.0f, 3.0f)),
      true, true);
  for (int estimators : { 1, 2, 3 })
  {
    cslf::Mesh lamp = MakeTextured({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.0f, 3.0f));
    lamp.Textures.Emission = std::make_shared<cslf::Texture>(
      cslf::TextureImage{ 2, 2, { cslf::TextureWrap::Edge, cslf::TextureWrap::Edge }, false,
        { 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255 } },
      cslf::TextureKind::Colors);
    const Estimate estimate = trace(std::move(lamp), (estimators & 1) != 0, (estimators & 2) != 0);
    CSLF_CHECK_NEAR(
      estimate.Mean, corner.Mean, 4.0 * (estimate.Error + corner.Error) + 0.002 * corner.Mean);
  }
}
void TestDarkEmission()
{
  // An emissive surface with a black texture is not a light.
  cslf::Mesh mesh = MakeTextured({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.5f, 3.0f));
  mesh.Textures.Emission = MakeUniform(0, 0, 0, cslf::TextureKind::Colors);
  const cslf::Scene scene({ mesh }, MakeUniformLight(1.0f));
  CSLF_CHECK(!scene.GetLocalLights().HasSurfaces());
  CSLF_CHECK_NEAR(
    Trace(scene, LookAt({ 0.1f, 0.2f, 1 }, { 0.1f, 0.2f, 0 }), {}, 64).Mean, 0.5, 1e-4);
}
}

int TestCSLFTextures(int, char*[])
{
  TestPixels();
  TestWraps();
  TestFieldData();
  TestPicture();
  TestNormals();
  TestMetallicRoughness();
  TestEmission();
  TestDarkEmission();
  return cslf::testing::Result();
}
