// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares each BSDF's samples with its density, and checks that none reflects more light than it
// gets.
#include "PathTracing/Materials/cslfBSDF.h"
#include "PathTracing/Materials/cslfGGX.h"
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

cslf::SurfaceMaterial MakeMaterial(
  float metallic, float roughness, float ior, float base, float transmission = 0.0f)
{
  cslf::SurfaceMaterial material(
    glm::vec3(base, 0.7f * base, base), metallic, roughness, ior, glm::vec3(0.0f));
  material.Transmission = transmission;
  return material;
}

cslf::SurfaceMaterial MakeThin(float roughness, float base)
{
  cslf::SurfaceMaterial material = MakeMaterial(0.0f, roughness, 1.5f, base, 1.0f);
  material.Thin = true;
  return material;
}

cslf::BSDF MakeBSDF(
  const cslf::SurfaceMaterial& material, const glm::vec3& outgoing, bool inside = false)
{
  return { material, { material.BaseColor, material.Metallic, material.Alpha }, outgoing, inside };
}

glm::vec3 MakeDirection(double cosine, double azimuth)
{
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), cosine };
}

/// Counts directions in bins of the cosine and the azimuth.
class Histogram
{
public:
  static constexpr int Rings = 20; // between straight below and straight above
  static constexpr int Sectors = 12;

  Histogram()
    : Counts(Rings * Sectors, 0.0)
  {
  }

  void Add(const glm::vec3& direction)
  {
    const double height = 0.5 * (direction.z + 1.0);
    const double turn = std::atan2(direction.y, direction.x) / (2.0 * cslf::Pi) + 0.5;
    const int ring = std::clamp(static_cast<int>(height * Rings), 0, Rings - 1);
    const int sector = std::clamp(static_cast<int>(turn * Sectors), 0, Sectors - 1);
    ++this->Counts[ring * Sectors + sector];
  }

  /// The expected number in a bin, for one sample of this density.
  static double Expect(const cslf::BSDF& bsdf, int bin)
  {
    constexpr int steps = 48; // along each axis
    double sum = 0.0;
    for (int i = 0; i < steps * steps; ++i)
    {
      const double height = (bin / Sectors + (i / steps + 0.5) / steps) / Rings;
      const double turn = (bin % Sectors + (i % steps + 0.5) / steps) / Sectors;
      sum += bsdf.Pdf(MakeDirection(2.0 * height - 1.0, 2.0 * cslf::Pi * (turn - 0.5)));
    }
    return sum * 4.0 * cslf::Pi / (Rings * Sectors * steps * steps);
  }

  double operator[](int bin) const { return this->Counts[bin]; }

private:
  std::vector<double> Counts;
};

/// Chi-squared test of the samples' directions against the integral of the density; also whether
/// each sample's weight is BSDF over density. Smooth parts have no density, and are left out.
void TestSamplesAgainstDensity(
  const cslf::SurfaceMaterial& material, double cosine, bool inside = false)
{
  constexpr int samples = 1 << 15;
  const cslf::BSDF bsdf = MakeBSDF(material, MakeDirection(cosine, 0.4), inside);
  Histogram observed;
  int left = 0;
  for (int i = 0; i < samples; ++i)
  {
    // Independent numbers: a stratified sequence would pass too easily.
    const SampleStream stream(SampleStream::HashTexel(5, i, 0, 0), 0);
    cslf::BSDFSample sample;
    if (!bsdf.Sample(stream.Get1D(Dimension::Lobe), stream.Get2D(Dimension::Direction), sample) ||
      std::isinf(sample.Pdf))
    {
      ++left;
      continue;
    }
    CSLF_CHECK_NEAR(glm::length(sample.Direction), 1.0, 1e-3);
    const glm::vec3 expected = bsdf.EvaluateCosine(sample.Direction) / bsdf.Pdf(sample.Direction);
    CSLF_CHECK(glm::distance(sample.Weight, expected) <= 1e-4f * (1.0f + glm::length(expected)));
    CSLF_CHECK_NEAR(sample.Pdf / bsdf.Pdf(sample.Direction), 1.0, 1e-4);
    observed.Add(sample.Direction);
  }

  double total = 0.0;
  double chi2 = 0.0;
  int bins = 0;
  for (int bin = 0; bin < Histogram::Rings * Histogram::Sectors; ++bin)
  {
    const double expected = samples * Histogram::Expect(bsdf, bin);
    total += expected;
    if (expected > 10.0)
    {
      chi2 += (observed[bin] - expected) * (observed[bin] - expected) / expected;
      ++bins;
    }
  }
  CSLF_CHECK_NEAR(total / samples, 1.0 - static_cast<double>(left) / samples, 0.01);
  // The mean and variance of chi-squared are the degrees of freedom and twice their number.
  CSLF_CHECK(chi2 < bins + 5.0 * std::sqrt(2.0 * bins));
}

void TestDensities()
{
  for (double cosine : { 0.15, 0.6, 0.99 })
  {
    TestSamplesAgainstDensity(MakeMaterial(0.0f, 1.0f, 1.0f, 0.8f), cosine);
    TestSamplesAgainstDensity(MakeMaterial(1.0f, 0.5f, 1.0f, 0.8f), cosine);
    TestSamplesAgainstDensity(MakeMaterial(1.0f, 1.0f, 1.0f, 0.8f), cosine);
    TestSamplesAgainstDensity(MakeMaterial(0.0f, 0.6f, 1.5f, 0.8f), cosine);
    TestSamplesAgainstDensity(MakeMaterial(0.5f, 0.7f, 1.5f, 0.3f), cosine);
    for (bool inside : { false, true })
    {
      TestSamplesAgainstDensity(MakeMaterial(0.0f, 0.6f, 1.5f, 0.8f, 1.0f), cosine, inside);
      TestSamplesAgainstDensity(MakeMaterial(0.0f, 0.9f, 1.3f, 0.3f, 1.0f), cosine, inside);
      TestSamplesAgainstDensity(MakeMaterial(0.4f, 0.7f, 2.0f, 0.8f, 0.5f), cosine, inside);
    }
    // Light that goes straight on, with a rough metal and through a sheet.
    TestSamplesAgainstDensity(MakeMaterial(0.5f, 0.7f, 1.0f, 0.8f, 0.7f), cosine);
    TestSamplesAgainstDensity(MakeThin(0.6f, 0.8f), cosine);
  }
}

/// The share of uniform light that a surface scatters in a direction, without the growth of
/// radiance in glass; the first component.
double IntegrateAlbedo(const cslf::SurfaceMaterial& material, double cosine, bool inside = false)
{
  constexpr int samples = 4096;
  const cslf::BSDF bsdf = MakeBSDF(material, MakeDirection(cosine, 1.0), inside);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < samples; ++i)
  {
    const SampleStream stream(SampleStream::HashTexel(9, 0, 0, 0), i);
    cslf::BSDFSample sample;
    if (bsdf.Sample(stream.Get1D(Dimension::Lobe), stream.Get2D(Dimension::Direction), sample))
    {
      sum += sample.Weight.x / sample.Compression;
    }
  }
  return sum / samples;
}

void TestEnergyOfReflection()
{
  for (double cosine : { 0.05, 0.3, 0.7, 1.0 })
  {
    for (float roughness : { 0.0f, 0.1f, 0.3f, 0.6f, 1.0f })
    {
      // Nothing reflects more than it receives, and a white base returns all light that a
      // dielectric's boundary transmits.
      CSLF_CHECK_NEAR(
        IntegrateAlbedo(MakeMaterial(0.0f, roughness, 1.5f, 1.0f), cosine), 1.0, 0.01);
      const double metal = IntegrateAlbedo(MakeMaterial(1.0f, roughness, 1.0f, 1.0f), cosine);
      CSLF_CHECK(metal <= 1.001 && metal > 0.2);
      CSLF_CHECK(IntegrateAlbedo(MakeMaterial(0.5f, roughness, 2.5f, 1.0f), cosine) <= 1.005);

      // The table of all roughnesses agrees with that of one.
      cslf::SurfaceMaterial varied = MakeMaterial(0.0f, roughness, 1.5f, 1.0f);
      varied.DielectricSpecular = cslf::SpecularAlbedo(1.5f);
      CSLF_CHECK_NEAR(IntegrateAlbedo(varied, cosine), 1.0, 0.01);
    }
    CSLF_CHECK_NEAR(IntegrateAlbedo(MakeMaterial(0.0f, 0.5f, 1.0f, 0.5f), cosine), 0.5, 1e-4);
    CSLF_CHECK_NEAR(IntegrateAlbedo(MakeMaterial(1.0f, 0.0f, 1.0f, 1.0f), cosine), 1.0, 1e-4);
  }
}

void TestEnergyOfGlass()
{
  for (double cosine : { 0.05, 0.3, 0.7, 1.0 })
  {
    for (bool inside : { false, true })
    {
      for (float ior : { 1.0f, 1.33f, 1.5f, 2.4f })
      {
        // Smooth: light that is not reflected is transmitted, tinted.
        const float eta = inside ? 1.0f / ior : ior;
        const double reflected = cslf::DielectricFresnel(static_cast<float>(cosine), eta);
        CSLF_CHECK_NEAR(
          IntegrateAlbedo(MakeMaterial(0.0f, 0.0f, ior, 1.0f, 1.0f), cosine, inside), 1.0, 1e-4);
        CSLF_CHECK_NEAR(IntegrateAlbedo(MakeMaterial(0.0f, 0.0f, ior, 0.25f, 1.0f), cosine, inside),
          reflected + 0.25 * (1.0 - reflected), 2e-3);
        CSLF_CHECK_NEAR(
          IntegrateAlbedo(MakeMaterial(0.0f, 0.0f, ior, 1.0f, 0.5f), cosine), 1.0, 0.01);

        // Rough: light that meets several facets is lost.
        for (float roughness : { 0.1f, 0.3f, 0.6f, 1.0f })
        {
          const double albedo =
            IntegrateAlbedo(MakeMaterial(0.0f, roughness, ior, 1.0f, 1.0f), cosine, inside);
          CSLF_CHECK(albedo <= 1.001 && albedo > 0.2);
          CSLF_CHECK(roughness > 0.1f || cosine < 0.3 || albedo > 0.97);
        }
      }
    }
  }
  // A sheet reflects at both of its boundaries, from either side: R = F + (1 - F)^2 F + ...
  for (bool inside : { false, true })
  {
    CSLF_CHECK_NEAR(IntegrateAlbedo(MakeThin(0.0f, 1.0f), 0.6, inside), 1.0, 1e-4);
    const double f = cslf::DielectricFresnel(0.6f, 1.5f);
    const double r = f + (1.0 - f) * (1.0 - f) * f / (1.0 - f * f);
    CSLF_CHECK_NEAR(
      IntegrateAlbedo(MakeThin(0.0f, 0.25f), 0.6, inside), r + 0.25 * (1.0 - r), 2e-3);
    for (double cosine : { 0.05, 0.3, 0.7, 1.0 })
    {
      for (float roughness : { 0.3f, 1.0f })
      {
        CSLF_CHECK(IntegrateAlbedo(MakeThin(roughness, 1.0f), cosine, inside) <= 1.001);
      }
    }
  }
  // Grazing angles inside are reflected totally.
  CSLF_CHECK(cslf::DielectricFresnel(0.7f, 1.0f / 1.5f) == 1.0f);
  CSLF_CHECK_NEAR(cslf::DielectricFresnel(1.0f, 1.5f), 0.04, 1e-6);
  CSLF_CHECK_NEAR(cslf::DielectricFresnel(1.0f, 1.0f / 1.5f), 0.04, 1e-6);
}

void TestReciprocity()
{
  const glm::vec3 a = MakeDirection(0.8, 0.1);
  const glm::vec3 b = MakeDirection(0.4, 2.0);
  const cslf::SurfaceMaterial material = MakeMaterial(0.3f, 0.4f, 1.5f, 0.6f);
  const glm::vec3 forth = MakeBSDF(material, a).EvaluateCosine(b) / b.z;
  const glm::vec3 back = MakeBSDF(material, b).EvaluateCosine(a) / a.z;
  CSLF_CHECK(glm::distance(forth, back) < 1e-5f);

  // For refracted light, radiance divided by the squared index is the same in both directions.
  const cslf::SurfaceMaterial glass = MakeMaterial(0.0f, 0.8f, 1.5f, 0.6f, 1.0f);
  const glm::vec3 c = MakeDirection(0.85, 3.4);
  const glm::vec3 out = MakeBSDF(glass, a).EvaluateCosine({ c.x, c.y, -c.z }) / c.z;
  const glm::vec3 in = MakeBSDF(glass, c, true).EvaluateCosine({ a.x, a.y, -a.z }) / a.z;
  CSLF_CHECK(out.x > 0.01f);
  CSLF_CHECK(glm::distance(out * (1.5f * 1.5f), in) < 1e-4f);
}
}

int TestCSLFBSDF(int, char*[])
{
  TestDensities();
  TestEnergyOfReflection();
  TestEnergyOfGlass();
  TestReciprocity();
  return cslf::testing::Result();
}
