// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The random numbers, the tables for choices, and the lights' samples compared with their density.
#include "PathTracing/Lights/cslfEnvironment.h"
#include "PathTracing/Lights/cslfLocalLights.h"
#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Shapes/cslfMesh.h"
#include "RandomNumbers/cslfDistribution.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
using cslf::Dimension;
using cslf::SampleStream;

void TestSampleStream()
{
  // Every elementary interval of 16 boxes contains one of each 16 consecutive samples, in every
  // pair of dimensions.
  for (int texel = 0; texel < 20; ++texel)
  {
    const std::uint64_t hash = SampleStream::HashTexel(7, 3, texel, 2);
    for (std::uint32_t first : { 0u, 16u, 160u })
    {
      for (int log = 0; log <= 4; ++log)
      {
        const int columns = 1 << log;
        const int rows = 16 / columns;
        std::vector<int> count(16, 0);
        for (std::uint32_t i = 0; i < 16; ++i)
        {
          SampleStream stream(hash, first + i);
          stream.NextVertex();
          const glm::vec2 u = stream.Get2D(Dimension::Direction);
          CSLF_CHECK(u.x >= 0.0f && u.x < 1.0f && u.y >= 0.0f && u.y < 1.0f);
          ++count[static_cast<int>(u.x * columns) * rows + static_cast<int>(u.y * rows)];
        }
        CSLF_CHECK(std::all_of(count.begin(), count.end(), [](int c) { return c == 1; }));
      }
    }
  }

  // Over texels, seeds, vertices and dimensions, first samples are uniform and uncorrelated.
  double sums[2] = { 0.0, 0.0 };
  double product = 0.0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i)
  {
    const float a = SampleStream(SampleStream::HashTexel(0, 0, i, 0), 0).Get1D(Dimension::Lobe);
    const float b = SampleStream(SampleStream::HashTexel(1, 0, i, 0), 0).Get1D(Dimension::Lobe);
    sums[0] += a;
    sums[1] += b;
    product += (a - 0.5) * (b - 0.5);
  }
  CSLF_CHECK_NEAR(sums[0] / count, 0.5, 0.01);
  CSLF_CHECK_NEAR(sums[1] / count, 0.5, 0.01);
  CSLF_CHECK_NEAR(product / count, 0.0, 0.003);
}

void TestSinCos()
{
  constexpr int count = 10000;
  for (int i = 0; i <= count; ++i)
  {
    const float turn = static_cast<float>(i) / count;
    float sine = 0.0f;
    float cosine = 0.0f;
    cslf::SinCosOfTurn(turn, sine, cosine);
    const double angle = 8.0 * std::atan(1.0) * double(turn);
    CSLF_CHECK_NEAR(sine, std::sin(angle), 3e-7);
    CSLF_CHECK_NEAR(cosine, std::cos(angle), 3e-7);
  }
}

void TestDistributions()
{
  const cslf::Distribution1D table({ 0.0, 3.0, 0.0, 1.0, 0.0 });
  CSLF_CHECK(table.GetTotal() == 4.0);
  CSLF_CHECK(table.Sample(0.0f).Index == 1);
  CSLF_CHECK_NEAR(table.Sample(0.375f).Remainder, 0.5, 1e-6);
  CSLF_CHECK(table.Sample(0.76f).Index == 3);
  CSLF_CHECK(table.Sample(0x1.fffffep-1f).Index == 3);
  CSLF_CHECK_NEAR(table.Sample(0.8f).Probability, 0.25, 1e-6);

  const cslf::Distribution2D grid({ 1.0, 0.0, 2.0, 4.0, 0.0, 1.0 }, 3, 2);
  double sum = 0.0;
  for (int i = 0; i < 64; ++i)
  {
    float pdf = 0.0f;
    const glm::vec2 point = grid.Sample({ (i % 8 + 0.5f) / 8, (i / 8 + 0.5f) / 8 }, pdf);
    CSLF_CHECK(pdf > 0.0f);
    CSLF_CHECK_NEAR(grid.GetPdf(point), pdf, 1e-5);
    sum += 1.0 / pdf; // the area where the density is not 0
  }
  CSLF_CHECK_NEAR(sum / 64.0, 4.0 / 6.0, 0.1);
}

glm::vec3 MakeDirection(double cosine, double azimuth)
{
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), cosine };
}

void TestFrame()
{
  for (const glm::vec3& normal : { glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0),
         glm::normalize(glm::vec3(1, -2, 3)), glm::normalize(glm::vec3(1e-4f, 0, -1)) })
  {
    const cslf::Frame frame(normal);
    CSLF_CHECK(glm::distance(glm::cross(frame.X, frame.Y), frame.Z) < 1e-5f);
    const glm::vec3 vector(0.3f, -0.5f, 0.7f);
    CSLF_CHECK(glm::distance(frame.ToWorld(frame.ToLocal(vector)), vector) < 1e-5f);
  }
}

void TestLights()
{
  // The samples of an area light have the correct density.
  std::vector<cslf::Mesh> meshes(1);
  meshes[0].Vertices = { { 0, 0, 2 }, { 1, 0, 2 }, { 0, 1, 2 }, { 3, 0, 1 }, { 3, 1, 1 },
    { 3, 0, 3 } };
  meshes[0].Triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  meshes[0].Material.Emission = glm::vec3(1.0f);
  const cslf::LocalLights lights(meshes, {});
  double solidAngle = 0.0;
  for (std::uint32_t i = 0; i < 4096; ++i)
  {
    const glm::vec2 u =
      SampleStream(SampleStream::HashTexel(2, 0, 0, 0), i).Get2D(Dimension::Pixel);
    const cslf::LightSample sample = lights.Sample({}, u);
    CSLF_CHECK(sample.Pdf > 0.0f);
    solidAngle += 1.0 / sample.Pdf / 4096.0;
  }
  // Both triangles' solid angles, by van Oosterom and Strackee.
  const auto triangle = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
  {
    const double x = glm::length(a);
    const double y = glm::length(b);
    const double z = glm::length(c);
    return 2.0 *
      std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
        x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  };
  CSLF_CHECK_NEAR(solidAngle,
    triangle({ 0, 0, 2 }, { 1, 0, 2 }, { 0, 1, 2 }) +
      triangle({ 3, 0, 1 }, { 3, 1, 1 }, { 3, 0, 3 }),
    0.002);

  // So do those of an environment image. Its integral is that of the image.
  cslf::EnvironmentImage image{ 8, 4, std::vector<glm::vec3>(32, glm::vec3(0.0f)) };
  image.Pixels[11] = glm::vec3(50.0f);
  image.Pixels[2] = glm::vec3(1.0f);
  const cslf::Environment environment(
    image, 2.0f, cslf::EnvironmentAxes::FromUp(glm::dvec3(1, 1, 0)));
  double sampled = 0.0;
  double integrated = 0.0;
  int misplaced = 0;
  constexpr std::uint32_t count = 1 << 14;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const glm::vec2 u =
      SampleStream(SampleStream::HashTexel(4, 0, 0, 0), i).Get2D(Dimension::Pixel);
    const cslf::LightSample sample = environment.Sample(u);
    CSLF_CHECK(sample.Pdf > 0.0f);
    // A sample on a pixel's edge may be found in the next one.
    const double ratio = environment.Pdf(sample.Direction) / sample.Pdf;
    misplaced += std::abs(ratio - 1.0) > 0.02 ? 1 : 0;
    CSLF_CHECK(glm::distance(environment.GetRadiance(sample.Direction), sample.Radiance) <=
      0.01f * (1.0f + glm::length(sample.Radiance)));
    sampled += sample.Radiance.x / sample.Pdf / count;
    const glm::vec3 uniform = MakeDirection(2.0 * u.x - 1.0, 2.0 * cslf::Pi * u.y);
    integrated += environment.GetRadiance(uniform).x * 4.0 * cslf::Pi / count;
  }
  CSLF_CHECK(misplaced < 10);
  CSLF_CHECK_NEAR(sampled / integrated, 1.0, 0.01);
}
}

int TestCSLFSampling(int, char*[])
{
  TestSampleStream();
  TestSinCos();
  TestDistributions();
  TestFrame();
  TestLights();
  return cslf::testing::Result();
}
