// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBSDF.h"

#include <algorithm>
#include <limits>

namespace cslf
{
namespace
{
// No lobe that reflects anything is taken less often than this, of it and those after it.
constexpr float LeastProbability = 0.1f;

template <typename... AllLobes>
std::tuple<AllLobes...> MakeLobes(const std::tuple<AllLobes...>*, const SurfaceMaterial& material,
  const MaterialPoint& point, const glm::vec3& outgoing, bool inside)
{
  return { AllLobes(material, point, outgoing, inside)... };
}
}

BSDF::BSDF(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
  bool inside)
  : Parts(MakeLobes(static_cast<const LobeList*>(nullptr), material, point, outgoing, inside))
{
  const auto importances = std::apply(
    [](const auto&... part) { return std::array{ part.GetImportance()... }; }, this->Parts);
  float rest = 1.0f; // of the probability
  for (std::size_t i = 0; i < importances.size(); ++i)
  {
    float others = 0.0f;
    std::for_each(importances.begin() + i + 1, importances.end(),
      [&others](float importance) { others += importance; });
    float share = importances[i] > 0.0f ? 1.0f : 0.0f;
    if (others > 0.0f && importances[i] > 0.0f)
    {
      share = std::clamp(
        importances[i] / (importances[i] + others), LeastProbability, 1.0f - LeastProbability);
    }
    this->Probabilities[i] = rest * share;
    rest -= this->Probabilities[i];
  }
}

/// Calls `visit(lobe, probability)` for the lobes that exist, with the probability of taking each
/// among these.
template <typename Visit>
void BSDF::ForEachLobe(Lobes lobes, const Visit& visit) const
{
  const float all = lobes == Lobes::All ? 1.0f : this->GetProbability(lobes);
  std::size_t i = 0;
  const auto visitOne = [&](const auto& part)
  {
    const float probability = this->Probabilities[i++];
    if (probability > 0.0f && (lobes == Lobes::All || lobes == part.Kind))
    {
      visit(part, probability / all);
    }
  };
  std::apply([&](const auto&... part) { (visitOne(part), ...); }, this->Parts);
}

float BSDF::GetProbability(Lobes lobes) const
{
  float sum = 0.0f;
  std::size_t i = 0;
  const auto add = [&](const auto& part)
  {
    sum += lobes == Lobes::All || lobes == part.Kind ? this->Probabilities[i] : 0.0f;
    ++i;
  };
  std::apply([&](const auto&... part) { (add(part), ...); }, this->Parts);
  return sum;
}

bool BSDF::IsMirror(Lobes lobes) const
{
  bool isMirror = true;
  this->ForEachLobe(
    lobes, [&isMirror](const auto& part, float) { isMirror = isMirror && part.IsSmooth(); });
  return isMirror;
}

glm::vec3 BSDF::EvaluateCosine(const glm::vec3& incident, Lobes lobes) const
{
  glm::vec3 value(0.0f);
  this->ForEachLobe(
    lobes, [&](const auto& part, float) { value += part.EvaluateCosine(incident); });
  return value;
}

float BSDF::Pdf(const glm::vec3& incident, Lobes lobes) const
{
  float pdf = 0.0f;
  this->ForEachLobe(
    lobes, [&](const auto& part, float probability) { pdf += probability * part.Pdf(incident); });
  return pdf;
}

bool BSDF::Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes) const
{
  // Choose a lobe, and use the rest of the number within it.
  LobeSample chosen;
  float taken = 0.0f; // the probability of the lobe
  float end = 0.0f;
  bool isValid = false;
  this->ForEachLobe(lobes,
    [&](const auto& part, float probability)
    {
      const float begin = end;
      end += probability;
      if (taken == 0.0f && lobe < end)
      {
        taken = probability;
        isValid = part.Sample((lobe - begin) / probability, u, chosen);
      }
    });
  if (!isValid)
  {
    return false;
  }
  sample.Direction = chosen.Direction;
  sample.Compression = chosen.Compression;
  if (chosen.IsSmooth)
  {
    sample.Weight = chosen.Weight / taken;
    sample.Pdf = std::numeric_limits<float>::infinity();
    return true;
  }
  sample.Pdf = this->Pdf(sample.Direction, lobes);
  if (!(sample.Pdf > 0.0f))
  {
    return false;
  }
  sample.Weight = this->EvaluateCosine(sample.Direction, lobes) / sample.Pdf;
  return true;
}
}
