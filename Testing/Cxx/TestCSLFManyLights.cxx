// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A thousand lights: the cost and noise of a sample, and no light is missed.
#include "RandomNumbers/cslfDistribution.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

class Random
{
public:
  float Get(float lower, float upper)
  {
    const auto unit = static_cast<float>(this->Engine() >> 8) * 0x1p-24f;
    return lower + (upper - lower) * unit;
  }

private:
  std::mt19937 Engine{ 4 };
};

enum class Kinds
{
  Spheres,
  Tubes,
  Rectangles,
  Instances,
  Points,
  Mixed
};

cslf::PointLight MakePoint(const glm::vec3& place, float intensity, int index)
{
  cslf::PointLight point{ place, glm::vec3(intensity) };
  if (index % 3 == 0)
  {
    point.Axis = glm::normalize(glm::vec3(0.3f, index % 2, -1.0f));
    point.ConeCosine = 0.5f;
    point.Exponent = 2.0f;
  }
  return point;
}

/// A floor, and lamps above it.
struct Lamps
{
  std::vector<cslf::Mesh> Meshes;
  cslf::LightSet Lights;

  Lamps(Kinds kinds, int count)
  {
    Random random;
    constexpr int kindCount = 5;
    cslf::Mesh spheres;
    cslf::Mesh tubes;
    cslf::Mesh rectangles;
    cslf::Mesh instances =
      MakeRectangle({ 0, 0, 0 }, { 0.004f, 0, 0 }, { 0, 0.004f, 0 }, MakeDiffuse(0.0f, 50.0f));
    spheres.Shape = cslf::Mesh::Shapes::Spheres;
    tubes.Shape = cslf::Mesh::Shapes::Tubes;
    for (cslf::Mesh* mesh : { &spheres, &tubes, &rectangles })
    {
      mesh->Material = MakeDiffuse(0.0f, 50.0f);
    }
    for (int i = 0; i < count; ++i)
    {
      const glm::vec3 place(
        random.Get(-0.7f, 0.7f), random.Get(-0.7f, 0.7f), random.Get(0.05f, 0.2f));
      const Kinds kind = kinds == Kinds::Mixed ? Kinds(i % kindCount) : kinds;
      switch (kind)
      {
        case Kinds::Spheres:
          spheres.Vertices.push_back(place);
          spheres.Radii.push_back(random.Get(0.001f, 0.004f));
          break;
        case Kinds::Tubes:
          tubes.Vertices.push_back(place);
          tubes.Vertices.push_back(place + glm::vec3(random.Get(-0.02f, 0.02f), 0.02f, 0));
          tubes.Radii.insert(tubes.Radii.end(), { 0.001f, random.Get(0.001f, 0.002f) });
          break;
        case Kinds::Rectangles:
          this->AddTriangle(rectangles, place, random);
          break;
        case Kinds::Instances:
        {
          cslf::MeshInstance instance;
          instance.Linear[2] = { random.Get(-0.5f, 0.5f), 0, 1 };
          instance.Linear[0] = { 1, random.Get(-0.5f, 0.5f), random.Get(-2.0f, 2.0f) };
          instance.Offset = place;
          instances.Instances.push_back(instance);
          break;
        }
        default:
          this->Lights.Points.push_back(MakePoint(place, random.Get(0.001f, 0.002f), i));
          break;
      }
    }
    this->Meshes.push_back(
      MakeRectangle({ 0, 0, 0 }, { 0.7f, 0, 0 }, { 0, 0.7f, 0 }, MakeDiffuse(0.7f)));
    for (cslf::Mesh* mesh : { &spheres, &tubes, &rectangles })
    {
      if (mesh->GetNumberOfShapes() > 0)
      {
        this->Meshes.push_back(std::move(*mesh));
      }
    }
    if (!instances.Instances.empty())
    {
      this->Meshes.push_back(std::move(instances));
    }
  }

  /// Keeps a number of emissive ones of each kind, and leaves the others in place.
  void Extinguish(std::size_t count)
  {
    std::vector<cslf::Mesh> dark;
    for (cslf::Mesh& mesh : this->Meshes)
    {
      if (mesh.Material.IsEmissive())
      {
        dark.push_back(mesh);
        dark.back().Material = MakeDiffuse(0.0f);
        Divide(mesh.Instances, dark.back().Instances, count);
        const bool isSpheres = mesh.Shape == cslf::Mesh::Shapes::Spheres;
        const std::size_t vertices = isSpheres ? count : 2 * count;
        if (mesh.Shape == cslf::Mesh::Shapes::Triangles && mesh.Instances.empty())
        {
          Divide(mesh.Triangles, dark.back().Triangles, count);
        }
        else if (mesh.Shape != cslf::Mesh::Shapes::Triangles)
        {
          Divide(mesh.Vertices, dark.back().Vertices, vertices);
          Divide(mesh.Radii, dark.back().Radii, vertices);
        }
      }
    }
    std::move(dark.begin(), dark.end(), std::back_inserter(this->Meshes));
    this->Lights.Points.resize(std::min(this->Lights.Points.size(), count));
  }

private:
  template <typename Value>
  static void Divide(std::vector<Value>& first, std::vector<Value>& rest, std::size_t count)
  {
    if (first.size() > count)
    {
      rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(count));
      first.resize(count);
    }
  }

  static void AddTriangle(cslf::Mesh& mesh, const glm::vec3& place, Random& random)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Vertices.size());
    mesh.Vertices.push_back(place);
    mesh.Vertices.push_back(place + glm::vec3(random.Get(-0.01f, 0.01f), 0.01f, 0));
    mesh.Vertices.push_back(place + glm::vec3(0.01f, 0, random.Get(-0.01f, 0.01f)));
    mesh.Triangles.emplace_back(first, first + 1, first + 2);
  }
};

/// All lights, for a choice by power.
std::vector<cslf::Emitter> ListEmitters(const cslf::Scene& scene)
{
  std::vector<cslf::Emitter> emitters;
  for (const cslf::Mesh& mesh : scene.GetMeshes())
  {
    const std::size_t places = std::max<std::size_t>(mesh.Instances.size(), 1);
    for (std::uint32_t i = 0; mesh.Material.IsEmissive() && i < places; ++i)
    {
      for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
      {
        emitters.emplace_back(mesh, shape, mesh.Instances.empty() ? cslf::TrianglePoint::None : i);
      }
    }
  }
  for (const cslf::PointLight& point : scene.GetPointLights())
  {
    emitters.emplace_back(point);
  }
  return emitters;
}

/// The contribution of a sample to the irradiance of an unshadowed point of the floor.
double GetIrradiance(const cslf::LightSample& sample)
{
  return sample.Pdf > 0.0f ? std::max(sample.Direction.z, 0.0f) * sample.Radiance.x /
      (std::isinf(sample.Pdf) ? 1.0 : double(sample.Pdf))
                           : 0.0;
}

struct Moments
{
  double Mean = 0.0;
  double Variance = 0.0;
};

template <typename Sample>
Moments Measure(int count, const Sample& sample)
{
  double sum = 0.0;
  double squares = 0.0;
  Random random;
  for (int i = 0; i < count; ++i)
  {
    const float x = random.Get(0.0f, 1.0f);
    const float y = random.Get(0.0f, 1.0f);
    const double value =
      sample(glm::vec2(std::min(x, cslf::BelowOne), std::min(y, cslf::BelowOne)));
    sum += value;
    squares += value * value;
  }
  return { sum / count, squares / count - (sum / count) * (sum / count) };
}

/// The tree's estimate of the light is that of a sum over all lights, and has much less noise than
/// that of a choice by power.
void TestNoise()
{
  for (const Kinds kind : { Kinds::Spheres, Kinds::Tubes, Kinds::Rectangles, Kinds::Instances,
         Kinds::Points, Kinds::Mixed })
  {
    Lamps lamps(kind, 1000);
    const cslf::Scene scene(std::move(lamps.Meshes), std::move(lamps.Lights));
    const std::vector<cslf::Emitter> emitters = ListEmitters(scene);
    CSLF_CHECK(emitters.size() >= 1000);
    std::vector<double> powers;
    powers.reserve(emitters.size());
    for (const cslf::Emitter& emitter : emitters)
    {
      powers.push_back(emitter.GetBounds().Power);
    }
    const cslf::Distribution1D byPower(powers);
    double gain = 0.0;
    constexpr int places = 8;
    for (int place = 0; place < places; ++place)
    {
      const cslf::LightReceiver receiver{ { 0.15f * place - 0.5f, 0.1f * place - 0.4f, 0.0f },
        { 0, 0, 1 } };
      constexpr int samples = 1 << 15;
      const Moments tree = Measure(samples,
        [&](const glm::vec2& u)
        { return GetIrradiance(scene.GetLocalLights().Sample(receiver, u)); });
      const Moments power = Measure(samples,
        [&](const glm::vec2& u)
        {
          const cslf::DiscreteSample choice = byPower.Sample(u.x);
          return GetIrradiance(
                   emitters[choice.Index].Sample(receiver.Position, { choice.Remainder, u.y })) /
            choice.Probability;
        });
      double sum = 0.0;
      for (const cslf::Emitter& emitter : emitters)
      {
        constexpr int few = 16;
        for (int i = 0; i < few; ++i)
        {
          const glm::vec2 u = cslf::SampleStream(7, i).Get2D(cslf::Dimension::Pixel);
          sum += GetIrradiance(emitter.Sample(receiver.Position, u)) / few;
        }
      }
      CSLF_CHECK_NEAR(tree.Mean / sum, 1.0, 0.005 + 4.0 * std::sqrt(tree.Variance / samples) / sum);
      gain += power.Variance / tree.Variance / places;
    }
    std::cout << "kind " << int(kind) << ": variance by power / by tree " << gain << "\n";
    CSLF_CHECK(gain > 10.0);
  }
}

/// The rays of a path in a room of 1000 lamps, some of which of each kind emit light.
double GetRaysPerPath(Kinds kinds, std::size_t count)
{
  Lamps lamps(kinds, 1000);
  lamps.Extinguish(count);
  for (const glm::vec3& side : { glm::vec3(0.7f, 0, 0), glm::vec3(-0.7f, 0, 0),
         glm::vec3(0, 0.7f, 0), glm::vec3(0, -0.7f, 0) })
  {
    lamps.Meshes.push_back(MakeRectangle(side + glm::vec3(0, 0, 0.2f),
      glm::vec3(side.y, -side.x, 0), { 0, 0, 0.2f }, MakeDiffuse(0.7f)));
    lamps.Meshes.push_back(MakeRectangle(
      0.5f * side, { 0, 0, 0.05f }, 0.1f * glm::vec3(side.y, -side.x, 0), MakeDiffuse(0.5f)));
  }
  const cslf::Scene scene(std::move(lamps.Meshes), std::move(lamps.Lights));
  cslf::PathSettings settings;
  settings.MaximumDepth = 4;
  const cslf::PathIntegrator integrator(scene, settings);
  std::uint64_t rays = 0;
  cslf::PathBatch batch;
  for (int i = 0; i < cslf::PathBatch::Capacity; ++i)
  {
    const float x = 0.02f * static_cast<float>(i % 64) - 0.65f;
    const float y = 0.02f * static_cast<float>(i / 64) - 0.65f;
    cslf::PathBatch::Start path;
    path.First = LookAt({ 1.2f * x, 1.2f * y, 0.5f }, { x, y, 0.0f });
    path.Hash = cslf::SampleStream::HashTexel(1, 0, i, 0);
    batch.Add(path);
  }
  integrator.Follow(batch, rays);
  return double(rays) / cslf::PathBatch::Capacity;
}

/// Paths among 1000 lamps need no more rays than those among 10. The benchmark path-tracing/lamps
/// measures their time.
void TestCost()
{
  for (const Kinds kind : { Kinds::Spheres, Kinds::Rectangles, Kinds::Points, Kinds::Mixed })
  {
    const double few = GetRaysPerPath(kind, kind == Kinds::Mixed ? 2 : 10);
    const double many = GetRaysPerPath(kind, 1000);
    std::cout << "kind " << int(kind) << ": rays of a path " << many << " / " << few << "\n";
    CSLF_CHECK(many < 1.1 * few + 0.1);
  }
}

/// Probabilities of all lights sum to 1; these are the probabilities of samples, and every light
/// that sends light to the receiver has one above 0.
void TestProbabilities()
{
  for (const Kinds kind : { Kinds::Mixed, Kinds::Rectangles, Kinds::Points })
  {
    Lamps lamps(kind, 200);
    const cslf::Scene scene(std::move(lamps.Meshes), std::move(lamps.Lights));
    const std::vector<cslf::Emitter> emitters = ListEmitters(scene);
    std::vector<cslf::LightBounds> bounds;
    bounds.reserve(emitters.size());
    for (const cslf::Emitter& emitter : emitters)
    {
      bounds.push_back(emitter.GetBounds());
    }
    const cslf::LightTree tree(bounds);
    Random random;
    for (int i = 0; i < 300; ++i)
    {
      cslf::LightReceiver receiver;
      receiver.Position = { random.Get(-1, 1), random.Get(-1, 1), random.Get(-0.1f, 0.4f) };
      receiver.Normal = { random.Get(-1, 1), random.Get(-1, 1), random.Get(-1, 1) };
      receiver.Normal = i % 4 == 0 ? glm::vec3(0.0f) : glm::normalize(receiver.Normal);
      double sum = 0.0;
      for (std::uint32_t light = 0; light < emitters.size(); ++light)
      {
        const double probability = tree.GetProbability(receiver, light);
        sum += probability;
        for (int j = 0; j < 4; ++j)
        {
          const glm::vec2 u(random.Get(0, 1), random.Get(0, 1));
          const cslf::LightSample sample = emitters[light].Sample(receiver.Position, u);
          const float cosine =
            receiver.Normal == glm::vec3(0.0f) ? 1.0f : glm::dot(sample.Direction, receiver.Normal);
          const bool arrives = sample.Pdf > 0.0f && sample.Radiance.x > 0.0f && cosine > 1e-4f;
          CSLF_CHECK(!arrives || probability > 0.0);
        }
      }
      CSLF_CHECK(sum < 1.0 + 1e-5);
      const double u = random.Get(0, 1);
      const cslf::LightTree::Choice choice = tree.Sample(receiver, u);
      if (choice.Probability > 0.0)
      {
        CSLF_CHECK_NEAR(
          choice.Probability / tree.GetProbability(receiver, choice.Light), 1.0, 1e-5);
        CSLF_CHECK(choice.Remainder >= 0.0 && choice.Remainder <= 1.0);
      }
      else
      {
        CSLF_CHECK(sum < 1.0 - 1e-9 || emitters.empty());
      }
    }
  }
}

/// Many lights in one place, and lights without power.
void TestDegenerate()
{
  cslf::LightSet lights;
  for (int i = 0; i < 100; ++i)
  {
    lights.Points.push_back({ { 0, 0, 1 }, glm::vec3(i % 2 == 0 ? 0.01f : 0.0f) });
  }
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.5f)));
  const cslf::Scene scene(std::move(meshes), lights);
  cslf::PathSettings settings;
  settings.MaximumDepth = 1;
  const cslf::Ray ray = LookAt({ 0.5f, 0, 0.5f }, { 0, 0, 0 });
  for (const bool sampling : { true, false })
  {
    settings.LightSampling = sampling;
    const Estimate estimate = Trace(scene, ray, settings, 1 << 10);
    CSLF_CHECK_NEAR(estimate.Mean, 0.5 * 0.5 / cslf::Pi, 1e-5);
  }
}
}

int TestCSLFManyLights(int, char*[])
{
  TestNoise();
  TestCost();
  TestProbabilities();
  TestDegenerate();
  return cslf::testing::Result();
}
