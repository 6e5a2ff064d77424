// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes that emit, absorb and scatter light, compared with closed forms.
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "PathTracing/Volumes/cslfPhaseFunction.h"
#include "PathTracing/Volumes/cslfVolumeSet.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkUnsignedShortArray.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

// A scene whose frame is not that of the world.
const cslf::SceneFrame Frame{ { 10.0, -4.0, 3.0 }, 5.0 };

/// The box [-0.5,0.5]^3 of the scene on a grid. Without values, all are 0.
cslf::VolumeData MakeBox(int side, const std::vector<float>& values = {})
{
  cslf::VolumeData data;
  std::fill_n(data.Size, 3, side);
  data.Converted = values;
  data.Converted.resize(std::size_t(side) * side * side);
  data.High = glm::dvec3(side - 1.0);
  const double spacing = Frame.Radius / (side - 1.0);
  data.ToData = glm::dmat4(spacing);
  data.ToData[3] = glm::dvec4(Frame.Center - 0.5 * Frame.Radius, 1.0);
  data.Table = { { 0.2f, 0.5f, 0.8f, 0.3f }, { 1.0f, 0.5f, 0.0f, 0.9f } };
  return data;
}

std::shared_ptr<cslf::VolumeSet> MakeSet(std::vector<cslf::VolumeData> data)
{
  std::vector<cslf::Volume> volumes;
  for (cslf::VolumeData& one : data)
  {
    volumes.emplace_back(std::move(one), Frame);
  }
  return std::make_shared<cslf::VolumeSet>(std::move(volumes));
}

std::shared_ptr<cslf::VolumeSet> MakeSet(cslf::VolumeData data)
{
  std::vector<cslf::VolumeData> all;
  all.push_back(std::move(data));
  return MakeSet(std::move(all));
}

/// Coverage, radiance and depth of one texel that looks down from z = 2 to z = -2.
struct Texel
{
  float Color[4];
  double Depth; ///< as z
};

Texel Render(const cslf::Scene& scene, cslf::RenderSettings settings, double x = 0.0)
{
  cslf::RayGrid grid;
  grid.Origin = { x - 0.01, -0.01, 2.0 };
  grid.OriginX = { 0.02, 0.0, 0.0 };
  grid.OriginY = { 0.0, 0.02, 0.0 };
  grid.Direction = { 0.0, 0.0, -4.0 };
  vtkNew<vtkFloatArray> color;
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(1);
  vtkNew<vtkUnsignedShortArray> depth;
  depth->SetNumberOfTuples(1);
  cslf::ViewpointSamples output;
  output.SetArray(cslf::KnownChannel::Color, color);
  output.SetArray(cslf::KnownChannel::Depth, depth);
  const cslf::PictureLayout layout{ 1, 1, 1, 0, 1 };
  const cslf::TexelRenderer renderer(
    scene, layout, settings, [&grid](int, int) { return grid; }, output);
  CSLF_CHECK(renderer.Render([](double) { return true; }));
  Texel texel{};
  color->GetTypedTuple(0, texel.Color);
  texel.Depth = 2.0 - 4.0 * depth->GetValue(0) / 65535.0;
  return texel;
}

Texel Render(const cslf::Scene& scene, int samples = 16, double x = 0.0)
{
  cslf::RenderSettings settings;
  settings.Samples = samples;
  return Render(scene, settings, x);
}

/// The mean of the first component over several seeds: sums of many samples are not precise.
double RenderMean(const cslf::Scene& scene, cslf::RenderSettings settings, double x = 0.0)
{
  constexpr int seeds = 16;
  double mean = 0.0;
  for (int seed = 0; seed < seeds; ++seed)
  {
    settings.Seed = static_cast<std::uint32_t>(seed);
    mean += Render(scene, settings, x).Color[0] / seeds;
  }
  return mean;
}

double GetTransmittance(double opacity, double unitDistance, double length)
{
  return std::pow(1.0 - opacity, length / unitDistance);
}

cslf::Mesh MakeFloor(float z, const cslf::SurfaceMaterial& material)
{
  return MakeRectangle({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, material);
}

void TestSlab()
{
  for (const double unit : { 1.0, 3.0, 20.0 })
  {
    cslf::VolumeData data = MakeBox(5);
    data.UnitDistance = unit;
    const cslf::Scene scene({}, cslf::LightSet(), nullptr, MakeSet(data));
    // 5 units of the world long.
    const double transmittance = GetTransmittance(0.3, unit, 5.0);
    const Texel texel = Render(scene);
    CSLF_CHECK_NEAR(texel.Color[3], 1.0 - transmittance, 0.005 * (1.0 - transmittance));
    const glm::dvec3 color = cslf::SRGBToLinear(glm::dvec3(0.2, 0.5, 0.8));
    for (int k = 0; k < 3; ++k)
    {
      CSLF_CHECK_NEAR(texel.Color[k], color[k] * texel.Color[3], 1e-4);
    }
    // Half of what is seen lies in front of the depth.
    const double half = 0.5 * (1.0 + transmittance);
    const double length = std::log(half) / std::log(0.7) * unit / Frame.Radius;
    CSLF_CHECK_NEAR(texel.Depth, 0.5 - length, 2e-3);
    CSLF_CHECK(Render(scene, 16, 0.6).Color[3] == 0.0f);
  }
}

void TestSurfaces()
{
  cslf::VolumeData data = MakeBox(5);
  data.UnitDistance = 5.0;
  const double t = GetTransmittance(0.3, 5.0, 5.0);
  const glm::dvec3 color = cslf::SRGBToLinear(glm::dvec3(0.2, 0.5, 0.8));
  const auto set = MakeSet(data);
  const cslf::SurfaceMaterial lamp = MakeDiffuse(0.0f, 2.0f);

  // Behind, inside and in front.
  for (const float z : { -1.0f, 0.0f, 1.0f })
  {
    const cslf::Scene scene({ MakeFloor(z, lamp) }, cslf::LightSet(), nullptr, set);
    const double length = z > 0.5f ? 0.0 : z < -0.5f ? 5.0 : 2.5;
    const double passed = GetTransmittance(0.3, 5.0, length);
    const Texel texel = Render(scene);
    CSLF_CHECK(texel.Color[3] == 1.0f);
    for (int k = 0; k < 3; ++k)
    {
      CSLF_CHECK_NEAR(texel.Color[k], 2.0 * passed + (1.0 - passed) * color[k], 2e-3);
    }
    CSLF_CHECK_NEAR(texel.Depth, z, 1e-3); // less than half is hidden
  }

  // A dense volume hides most of the surface, and gives the depth.
  data.UnitDistance = 1.0;
  const cslf::Scene hidden({ MakeFloor(-1.0f, lamp) }, cslf::LightSet(), nullptr, MakeSet(data));
  CSLF_CHECK_NEAR(Render(hidden).Depth, 0.5 - std::log(0.5) / std::log(0.7) / Frame.Radius, 2e-3);

  // The environment behind it, if it is shown.
  cslf::RenderSettings settings;
  settings.Samples = 16;
  settings.ShowEnvironment = true;
  const cslf::Scene sky({}, MakeUniformLight(3.0f), nullptr, set);
  const Texel above = Render(sky, settings);
  CSLF_CHECK(above.Color[3] == 1.0f);
  CSLF_CHECK_NEAR(above.Color[2], 3.0 * t + (1.0 - t) * color.z, 5e-3);
  const Texel beside = Render(sky, settings, 0.8);
  CSLF_CHECK_NEAR(beside.Color[2], 3.0, 1e-6);

  // A volume casts a shadow: the light of a direction, on a white floor.
  cslf::LightSet sun;
  sun.Directional.push_back({ { 0.0f, 0.0f, -1.0f }, glm::vec3(3.0f) });
  data.Table = { glm::vec4(0.0f, 0.0f, 0.0f, 0.3f), glm::vec4(0.0f, 0.0f, 0.0f, 0.3f) };
  data.UnitDistance = 5.0;
  const cslf::Scene shadow({ MakeFloor(-1.0f, MakeDiffuse(1.0f)) }, sun, nullptr, MakeSet(data));
  settings.ShowEnvironment = false;
  settings.Samples = 1 << 15;
  settings.Paths.MaximumDepth = 1;
  const double shaded = 3.0 / cslf::Pi * t * t;
  CSLF_CHECK_NEAR(RenderMean(shadow, settings), shaded, 0.005 * shaded);
  CSLF_CHECK_NEAR(RenderMean(shadow, settings, 0.8), 3.0 / cslf::Pi, 1e-3);
}

/// Extinction that grows along z.
void TestGradient()
{
  constexpr int side = 33;
  std::vector<float> values(side * side * side);
  for (int i = 0; i < side * side * side; ++i)
  {
    values[i] = static_cast<float>(i / (side * side)) / (side - 1); // z
  }
  // An opacity for which the extinction is affine would need a table of its own: integrate.
  const auto integrate = [](bool isNearest)
  {
    constexpr int steps = 100000;
    double depth = 0.0;
    for (int i = 0; i < steps; ++i)
    {
      double value = (i + 0.5) / steps;
      value = isNearest ? std::floor(value * (side - 1) + 0.5) / (side - 1) : value;
      depth -= std::log(1.0 - (0.3 + 0.6 * value)) / steps;
    }
    return std::exp(-depth * 5.0 / 12.0);
  };
  for (const bool isNearest : { false, true })
  {
    cslf::VolumeData data = MakeBox(side, values);
    data.UnitDistance = 12.0;
    data.IsNearest = isNearest;
    const cslf::Scene scene({}, cslf::LightSet(), nullptr, MakeSet(data));
    const double opacity = 1.0 - integrate(isNearest);
    CSLF_CHECK_NEAR(Render(scene).Color[3], opacity, 0.002 * opacity);

    // The same nodes with coordinates of their own.
    data.Axes[0] = data.Axes[1] = data.Axes[2] = std::vector<float>(side);
    for (int i = 0; i < side; ++i)
    {
      const double x = static_cast<double>(i) / (side - 1);
      data.Axes[0][i] = static_cast<float>((side - 1) * x * x);
      data.Axes[1][i] = static_cast<float>(i);
      data.Axes[2][i] = static_cast<float>(i);
    }
    const cslf::Scene uneven({}, cslf::LightSet(), nullptr, MakeSet(data));
    CSLF_CHECK_NEAR(Render(uneven).Color[3], opacity, 0.002 * opacity);
  }
}

void TestParts()
{
  // Two volumes in one place: opacities multiply. And beside each other, with a gap.
  cslf::VolumeData data = MakeBox(5);
  data.UnitDistance = 5.0;
  cslf::VolumeData other = MakeBox(9);
  other.UnitDistance = 10.0;
  const double t = GetTransmittance(0.3, 5.0, 5.0);
  const double u = GetTransmittance(0.3, 10.0, 5.0);
  const cslf::Scene both({}, cslf::LightSet(), nullptr, MakeSet({ data, other }));
  CSLF_CHECK_NEAR(Render(both).Color[3], 1.0 - t * u, 1e-3);
  cslf::VolumeData above = other;
  above.ToData[3].z += 1.5 * Frame.Radius;
  const cslf::Scene apart({}, cslf::LightSet(), nullptr, MakeSet({ data, above }));
  CSLF_CHECK_NEAR(Render(apart).Color[3], 1.0 - t * u, 1e-3);

  // Planes in the world cut it: a quarter is left.
  cslf::VolumeData cut = data;
  cut.Planes = { { 0.0, 0.0, 1.0, -Frame.Center.z }, { 0.0, 0.0, -1.0, Frame.Center.z + 1.25 } };
  const cslf::Scene quarter({}, cslf::LightSet(), nullptr, MakeSet(cut));
  CSLF_CHECK_NEAR(Render(quarter).Color[3], 1.0 - GetTransmittance(0.3, 5.0, 1.25), 1e-3);

  // Values that are not numbers are empty, and so are transparent ones.
  std::vector<float> values(5 * 5 * 5, std::numeric_limits<float>::quiet_NaN());
  CSLF_CHECK(MakeSet(MakeBox(5, values))->IsEmpty());
  std::fill(values.begin() + 3 * 25, values.end(), 0.0f); // above the middle, without a layer
  cslf::VolumeData half = MakeBox(5, values);
  half.UnitDistance = 5.0;
  const cslf::Scene upper({}, cslf::LightSet(), nullptr, MakeSet(half));
  CSLF_CHECK_NEAR(Render(upper).Color[3], 1.0 - GetTransmittance(0.3, 5.0, 1.25), 1e-3);
  cslf::VolumeData clear = data;
  clear.Table = { glm::vec4(1.0f, 1.0f, 1.0f, 0.0f), glm::vec4(0.0f) };
  CSLF_CHECK(MakeSet(clear)->IsEmpty());

  // An opaque one.
  cslf::VolumeData solid = data;
  solid.Table = { glm::vec4(0.5f, 0.5f, 0.5f, 1.0f), glm::vec4(1.0f) };
  const Texel opaque = Render(cslf::Scene({}, cslf::LightSet(), nullptr, MakeSet(solid)));
  CSLF_CHECK(opaque.Color[3] == 1.0f);
  CSLF_CHECK_NEAR(opaque.Color[0], cslf::SRGBToLinear(glm::dvec3(0.5)).x, 1e-3);
}

/// What is deterministic and what is tracked at random agree where nothing is even.
void TestTracking()
{
  constexpr int side = 24;
  std::vector<float> values(side * side * side);
  for (int i = 0; i < side * side * side; ++i)
  {
    const int x = i % side;
    const int y = i / side % side;
    const int z = i / side / side;
    values[i] = std::max(0.0f, std::sin(0.7f * x) * std::cos(0.5f * y) * std::sin(0.3f * z + 1.0f));
  }
  cslf::VolumeData data = MakeBox(side, values);
  data.Table = { glm::vec4(0.0f), glm::vec4(1.0f, 1.0f, 1.0f, 0.8f) };
  data.UnitDistance = 2.0;
  const auto set = MakeSet(data);
  for (const glm::vec3& at : { glm::vec3(0.0f), glm::vec3(0.2f, -0.1f, 0.3f) })
  {
    const cslf::Ray ray = LookAt(glm::vec3(1.5f, 0.8f, 1.1f), at);
    cslf::RayLanes rays;
    cslf::Lanes<float> far;
    cslf::Lanes<float> shifts;
    for (int lane = 0; lane < cslf::LaneCount; ++lane)
    {
      rays.Active[lane] = -1;
      rays.Origin.Set(lane, ray.Origin);
      rays.Direction.Set(lane, ray.Direction);
      far[lane] = 5.0f;
      shifts[lane] = (lane + 0.5f) / cslf::LaneCount;
    }
    cslf::VeilLanes veils;
    set->Integrate(rays, far, shifts, veils);
    double expected = 0.0;
    for (int lane = 0; lane < cslf::LaneCount; ++lane)
    {
      expected += veils.Transmittance[lane] / cslf::LaneCount;
    }
    CSLF_CHECK(expected > 0.05 && expected < 0.95);
    // Rays that differ only by rounding have random numbers of their own.
    constexpr int count = 4096;
    double mean = 0.0;
    for (int i = 0; i < count; ++i)
    {
      for (int lane = 0; lane < cslf::LaneCount; ++lane)
      {
        const float more = static_cast<float>(i * cslf::LaneCount + lane) * 1e-9f;
        rays.Origin.Set(lane, ray.Origin - more * 1e3f * ray.Direction);
      }
      cslf::Lanes<float> transmittances;
      std::fill_n(transmittances.Values, cslf::LaneCount, 1.0f);
      set->Attenuate(rays, far, transmittances);
      for (int lane = 0; lane < cslf::LaneCount; ++lane)
      {
        mean += transmittances[lane] / (count * cslf::LaneCount);
      }
    }
    CSLF_CHECK_NEAR(mean, expected, 0.005);
  }
}

/// Directions have the density of the phase function, whose integral is 1 and whose mean cosine is
/// the anisotropy.
void TestPhase()
{
  constexpr int count = 200;
  const glm::vec3 path = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
  for (const float g : { 0.0f, 0.6f, -0.8f })
  {
    double sum = 0.0;
    double cosines = 0.0;
    for (int i = 0; i < count * count; ++i)
    {
      const glm::vec2 u((i % count + 0.5f) / count, (i / count + 0.5f) / count);
      const glm::vec3 direction = cslf::SamplePhase(path, g, u);
      CSLF_CHECK_NEAR(glm::length(direction), 1.0, 1e-5);
      cosines += glm::dot(path, direction) / (count * count);
      const float cosine = -1.0f + 2.0f * (i + 0.5f) / (count * count);
      sum += 4.0 * cslf::Pi * cslf::EvaluatePhase(cosine, g) / (count * count);
    }
    CSLF_CHECK_NEAR(sum, 1.0, 1e-3);
    CSLF_CHECK_NEAR(cosines, g, 1e-3);
  }
}

cslf::VolumeData MakeLit(double opacity, double unit, float albedo, float anisotropy = 0.0f)
{
  cslf::VolumeData data = MakeBox(5);
  const auto color = static_cast<float>(cslf::LinearToSRGB(glm::dvec3(albedo)).x);
  data.Table = { glm::vec4(glm::vec3(color), opacity), glm::vec4(glm::vec3(color), opacity) };
  data.UnitDistance = unit;
  data.IsLit = true;
  data.Anisotropy = anisotropy;
  return data;
}

/// White media of any density and phase function stay white where light comes from all around.
void TestFurnace()
{
  cslf::RenderSettings settings;
  settings.Samples = 1 << 13;
  settings.Paths.MaximumDepth = 1000;
  for (const auto& [unit, anisotropy] :
    { std::pair(10.0, 0.0f), std::pair(1.0, 0.0f), std::pair(1.0, 0.7f), std::pair(1.0, -0.5f) })
  {
    const cslf::Scene scene(
      {}, MakeUniformLight(1.0f), nullptr, MakeSet(MakeLit(0.3, unit, 1.0f, anisotropy)));
    const Texel texel = Render(scene, settings);
    const double opacity = 1.0 - GetTransmittance(0.3, unit, 5.0);
    CSLF_CHECK_NEAR(texel.Color[3], opacity, 1e-3);
    CSLF_CHECK_NEAR(RenderMean(scene, settings), opacity, 0.005 * opacity);
    // And a white floor in it.
    const cslf::Scene floor({ MakeFloor(0.1f, MakeDiffuse(1.0f)) }, MakeUniformLight(1.0f), nullptr,
      MakeSet(MakeLit(0.3, unit, 1.0f, anisotropy)));
    CSLF_CHECK_NEAR(RenderMean(floor, settings), 1.0, 0.005);
  }
}

/// Light of a direction that is scattered once, in closed form.
void TestSingleScattering()
{
  cslf::LightSet sun;
  sun.Directional.push_back({ { 0.0f, 0.0f, -1.0f }, glm::vec3(7.0f) });
  cslf::RenderSettings settings;
  settings.Samples = 1 << 15;
  settings.Paths.MaximumDepth = 1;
  for (const float g : { 0.0f, 0.5f })
  {
    // Back along the light: both ways have the same length.
    const cslf::Scene scene({}, sun, nullptr, MakeSet(MakeLit(0.3, 2.0, 0.6f, g)));
    const double depth = -std::log(0.7) * 5.0 / 2.0;
    const double expected =
      7.0 * 0.6 * cslf::EvaluatePhase(-1.0f, g) * 0.5 * (1.0 - std::exp(-2.0 * depth));
    CSLF_CHECK_NEAR(RenderMean(scene, settings), expected, 0.005 * expected);
  }

  // A floor in the middle is lit through the volume, and scatters light only once.
  const cslf::Scene floor(
    { MakeFloor(0.0f, MakeDiffuse(0.5f)) }, sun, nullptr, MakeSet(MakeLit(0.3, 2.0, 0.6f)));
  const double depth = -std::log(0.7) * 2.5 / 2.0;
  const double scattered = 7.0 * 0.6 / (8.0 * cslf::Pi) * (1.0 - std::exp(-2.0 * depth));
  const double reflected = 7.0 * 0.5 / cslf::Pi * std::exp(-2.0 * depth);
  const double expected = scattered + reflected;
  CSLF_CHECK_NEAR(RenderMean(floor, settings), expected, 0.005 * expected);
}

/// An emissive surface that both estimators of direct light find, in a medium.
void TestEstimators()
{
  const auto set = MakeSet(MakeLit(0.4, 1.5, 0.8f, 0.3f));
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle(
    { 0.0f, 0.0f, 0.3f }, { -0.3f, 0.0f, 0.0f }, { 0.0f, 0.3f, 0.0f }, MakeDiffuse(0.0f, 4.0f)));
  meshes.push_back(MakeFloor(-0.4f, MakeDiffuse(0.7f)));
  const cslf::Scene scene(meshes, cslf::LightSet(), nullptr, set);
  cslf::PathSettings settings;
  settings.MaximumDepth = 4;
  CheckEstimators(
    scene, LookAt(glm::vec3(1.2f, 0.1f, 0.2f), glm::vec3(0.1f, 0.0f, -0.4f)), settings, 1 << 19);
}
}

int TestCSLFVolumes(int, char*[])
{
  TestPhase();
  TestFurnace();
  TestSingleScattering();
  TestEstimators();
  TestSlab();
  TestSurfaces();
  TestGradient();
  TestParts();
  TestTracking();
  return cslf::testing::Result();
}
