// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFBakeEstimator.h"

#include "Files/cslfJSONFile.h"
#include "Options/cslfOption.h"
#include "Pipeline/cslfGuard.h"
#include "Planning/cslfBakeProbe.h"
#include "cslfJSONText.h"
#include "cslfSeconds.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFSampler.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkCSLFBakeEstimator);
cslfSetClampMacro(vtkCSLFBakeEstimator, Format, Video, ImageFolder);
cslfSetClampMacro(vtkCSLFBakeEstimator, ProbeSeconds, 1.0, 1e6);
vtkCxxSetSmartPointerMacro(vtkCSLFBakeEstimator, Encoder, vtkCSLFEncoder);
vtkCxxSetSmartPointerMacro(vtkCSLFBakeEstimator, Sampler, vtkCSLFSampler);

namespace
{
using Clock = std::chrono::steady_clock;

// The share of the probe's seconds for the radiance cache.
constexpr double CacheShare = 0.4;

// The samples per texel of the measurements that choose their number, and the most that may be
// chosen.
constexpr int FewSamples = 4;
constexpr int MaximumSamples = 1 << 16;

// Times of the whole field that are less than this do not tell how its viewpoints differ.
constexpr double MinimumScaleSeconds = 1.0;

// Chosen numbers of samples have only this many leading binary digits, because sequences are better
// at round numbers.
constexpr int SampleDigits = 3;

/// Stores the seconds of its lifetime when it ends.
class Stopwatch
{
public:
  explicit Stopwatch(double& seconds)
    : Seconds(seconds)
  {
  }
  ~Stopwatch() { this->Seconds = cslf::SecondsSince(this->Start); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  double& Seconds;
  Clock::time_point Start = Clock::now();
};

int RoundDown(double samples)
{
  int rounded = static_cast<int>(std::clamp<double>(samples, 1.0, MaximumSamples));
  int step = 1;
  while (rounded / step >= 1 << SampleDigits)
  {
    step *= 2;
  }
  return rounded / step * step;
}

/// Removes the measurements of a bake from a manifest, so that only the settings remain.
void EraseMeasured(nlohmann::json& manifest)
{
  manifest.erase("measured");
  const nlohmann::json::json_pointer cache("/description/sampling/cache");
  if (manifest.contains(cache))
  {
    manifest[cache].erase("check");
    manifest[cache].erase("used_spacing");
  }
}

cslf::EncodeSettings GetSettings(vtkCSLFEncoder* encoder, int quality)
{
  vtkCSLFRateControl* rate = encoder->GetRateControl();
  return { cslf::ChoosePreset(encoder->GetPreset(), quality), encoder->GetPixelFormat(),
    rate->GetCRF(), rate->GetCoverageCRF(), rate->GetDepthCRF(), encoder->GetGroupLength(),
    encoder->GetLossless(), encoder->GetDepthFromGeometry(),
    cslf::MakeRateTarget(rate->GetTargetRatio(), rate->GetTargetSize(), rate->GetTargetPSNR()),
    std::max(1, rate->GetKeyViewStep()), 0.0, encoder->GetCodec() };
}

/// Restores a sampler's parameters.
class Restorer
{
public:
  explicit Restorer(vtkCSLFSampler* sampler)
    : Sampler(sampler)
    , Resolution(sampler->GetResolution())
    , Samples(sampler->GetSamples())
    , GeometryTriangles(sampler->GetGeometryTriangles())
    , CacheOptions(sampler->GetCacheOptions())
    , CacheProbeSeconds(sampler->GetCacheProbeSeconds())
  {
  }
  ~Restorer()
  {
    this->Sampler->SetResolution(this->Resolution);
    this->Sampler->SetSamples(this->Samples);
    this->Sampler->SetGeometryTriangles(this->GeometryTriangles);
    this->Sampler->SetCacheOptions(this->CacheOptions);
    this->Sampler->SetCacheProbeSeconds(this->CacheProbeSeconds);
  }
  Restorer(const Restorer&) = delete;
  Restorer& operator=(const Restorer&) = delete;

private:
  vtkCSLFSampler* Sampler;
  int Resolution;
  int Samples;
  int GeometryTriangles;
  vtkSmartPointer<vtkCSLFRadianceCacheOptions> CacheOptions;
  double CacheProbeSeconds;
};
}

/// The results of a probe that apply to other fields.
struct vtkCSLFBakeEstimator::Outlook
{
  cslf::FieldDetail Detail;
  double Bytes;
  double Growth;
  int Viewpoints;
  int Resolution;
};

vtkCSLFBakeEstimator::vtkCSLFBakeEstimator() = default;
vtkCSLFBakeEstimator::~vtkCSLFBakeEstimator() = default;

vtkCSLFSampler* vtkCSLFBakeEstimator::GetSampler()
{
  return this->Sampler;
}

vtkCSLFEncoder* vtkCSLFBakeEstimator::GetEncoder()
{
  return this->Encoder;
}

double vtkCSLFBakeEstimator::GetSeconds() const
{
  return this->SceneSeconds + this->CacheSeconds + this->RenderSeconds + this->CodingSeconds;
}

void vtkCSLFBakeEstimator::BeginProbe()
{
  // The spacing for the resolution, whatever size is probed.
  if (this->Sampler->GetCacheOptions()->GetSpacing() <= 0.0)
  {
    // A copy, because other filters may use the options, too.
    vtkNew<vtkCSLFRadianceCacheOptions> cacheOptions;
    cacheOptions->DeepCopy(this->Sampler->GetCacheOptions());
    cacheOptions->SetSpacing(vtkCSLFPathTracer::GetAutomaticCacheSpacing(
      this->Sampler->GetResolution(), this->Sampler->GetQuality()));
    this->Sampler->SetCacheOptions(cacheOptions);
  }
  this->Sampler->SetCacheProbeSeconds(CacheShare * this->ProbeSeconds);
}

bool vtkCSLFBakeEstimator::RunProbe(cslf::BakeProbe& probe)
{
  if (!probe.Estimate())
  {
    vtkErrorMacro(<< probe.GetError());
    return false;
  }
  const cslf::BakeCosts& costs = probe.GetCosts();
  this->SceneSeconds = costs.Scene;
  this->CacheSeconds = costs.Cache;
  this->RenderSeconds = costs.Rendering;
  this->CodingSeconds = costs.Coding;
  this->Bytes = costs.Bytes;
  this->Look.reset();
  if (this->Format == Video)
  {
    this->Look = std::make_unique<Outlook>(Outlook{ probe.GetDetail(), costs.Bytes,
      probe.GetGrowth(), this->Sampler->GetViewpoints(), probe.GetResolution() });
  }
  return true;
}

cslf::BakeProbe vtkCSLFBakeEstimator::MakeProbe()
{
  vtkNew<vtkCSLFEncoder> standard;
  vtkCSLFEncoder* encoder = this->Encoder ? this->Encoder.Get() : standard.Get();
  const bool hasGeometry = encoder->GetNumberOfInputConnections(1) > 0;
  if (!hasGeometry)
  {
    // Otherwise it would be made with small fields, which are requested as a whole.
    this->Sampler->SetGeometryTriangles(0);
  }
  return { this->Sampler, GetSettings(encoder, this->Sampler->GetQuality()), hasGeometry,
    static_cast<cslf::BakeProbe::Format>(this->Format), this->ProbeSeconds };
}

int vtkCSLFBakeEstimator::Estimate()
{
  const Stopwatch watch(this->SecondsTaken);
  if (!this->Sampler)
  {
    vtkErrorMacro("There is no sampler.");
    return 0;
  }
  return cslf::GuardMethod(this, "The bake cannot be estimated",
    [this]
    {
      const Restorer restorer(this->Sampler);
      this->BeginProbe();
      cslf::BakeProbe probe = this->MakeProbe();
      return this->RunProbe(probe) ? 1 : 0;
    });
}

int vtkCSLFBakeEstimator::ChooseSamples(double seconds)
{
  const Stopwatch watch(this->SecondsTaken);
  if (!this->Sampler)
  {
    vtkErrorMacro("There is no sampler.");
    return 0;
  }
  return cslf::GuardMethod(this, "The number of samples cannot be chosen",
    [this, seconds] { return this->FindSamples(seconds); });
}

int vtkCSLFBakeEstimator::FindSamples(double seconds)
{
  int samples = 1;
  {
    const Restorer restorer(this->Sampler);
    this->BeginProbe();
    this->Sampler->SetSamples(FewSamples);
    cslf::BakeProbe probe = this->MakeProbe();
    if (!this->RunProbe(probe))
    {
      return 0;
    }
    double few = 0.0;
    if (!probe.TimeRendering(FewSamples, few))
    {
      vtkErrorMacro(<< probe.GetError());
      return 0;
    }
    // Assumes that the time of rendering is linear in the samples. The estimate's own figure, from
    // more viewpoints, sets the scale, unless it is so short that the pipeline takes most of it.
    const double scale =
      this->RenderSeconds > MinimumScaleSeconds ? this->RenderSeconds / few : 1.0;
    // Times that hardly differ would say little.
    int manySamples = FewSamples;
    double many = 0.0;
    do
    {
      manySamples *= 4;
      if (!probe.TimeRendering(manySamples, many))
      {
        vtkErrorMacro(<< probe.GetError());
        return 0;
      }
    } while (many < 2.0 * few && scale * many < seconds && manySamples < MaximumSamples);
    const double slope = std::max(scale * (many - few) / (manySamples - FewSamples), 1e-9);
    const double single =
      std::max(this->RenderSeconds - slope * (FewSamples - 1), 0.25 * this->RenderSeconds);
    const double fixed = this->SceneSeconds + this->CacheSeconds + this->CodingSeconds;
    if (fixed + single > seconds)
    {
      vtkErrorMacro("The field takes about "
        << std::ceil(fixed + single) << " s with a single sample per texel, more than " << seconds
        << " s.");
      return 0;
    }
    samples = RoundDown(1.0 + (seconds - fixed - single) / slope);
    this->RenderSeconds = single + slope * (samples - 1);
  }
  this->Sampler->SetSamples(samples);
  return 1;
}

int vtkCSLFBakeEstimator::RecallSamples(const char* fileName)
{
  return cslf::GuardMethod(this, "The number of samples cannot be read",
    [this, fileName] { return this->ReadSamples(fileName ? fileName : ""); });
}

int vtkCSLFBakeEstimator::ReadSamples(const std::string& name)
{
  nlohmann::json manifest = cslf::ReadJSON(name + ".partial/manifest.json");
  const nlohmann::json::json_pointer place("/description/sampling/samples");
  if (!this->Sampler || this->Format != Video || name.empty() || !manifest.is_object() ||
    !manifest.contains(place) || !cslf::IsInteger<int>(manifest[place]))
  {
    return 0;
  }
  // Whether it belongs to the same field except for the samples.
  const int samples = manifest[place];
  const int before = this->Sampler->GetSamples();
  nlohmann::json mine;
  {
    const Restorer restorer(this->Sampler);
    this->Sampler->SetCacheProbeSeconds(CacheShare);
    this->Sampler->SetSamples(samples);
    vtkNew<vtkCSLFEncoder> standard;
    cslf::EncodeSettings settings = GetSettings(
      this->Encoder ? this->Encoder.Get() : standard.Get(), this->Sampler->GetQuality());
    if (this->Encoder &&
      this->Encoder->GetRateControl()->GetKeyViewStep() == vtkCSLFRateControl::AutomaticKeyViews)
    {
      settings.KeyViewStep = cslf::ToInteger(manifest[place.parent_pointer()], "key_view_step", 1);
    }
    cslf::EncodeProbe probe(this->Sampler, settings);
    std::string error;
    if (!probe.Begin(error))
    {
      return 0;
    }
    mine = nlohmann::json::parse(probe.GetManifest(), nullptr, false);
  }
  EraseMeasured(manifest);
  EraseMeasured(mine);
  this->Sampler->SetSamples(manifest == mine ? samples : before);
  return manifest == mine ? 1 : 0;
}

double vtkCSLFBakeEstimator::PredictPSNR(int viewpoints, int resolution) const
{
  return this->Look ? cslf::PredictPSNR(this->Look->Detail, viewpoints, resolution) : 0.0;
}

double vtkCSLFBakeEstimator::PredictBytes(int viewpoints, int resolution) const
{
  if (!this->Look || viewpoints < 2 || resolution < 1)
  {
    return 0.0;
  }
  const double texels = static_cast<double>(resolution) / this->Look->Resolution;
  const double views = static_cast<double>(viewpoints) / this->Look->Viewpoints;
  return this->Look->Bytes * std::pow(texels, this->Look->Growth) *
    std::pow(views, cslf::GrowthWithViewpoints);
}

int vtkCSLFBakeEstimator::Suggest(const std::function<double(double psnr, double bytes)>& getCost)
{
  this->SuggestedViewpoints = 0;
  this->SuggestedResolution = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int viewpoints : { 9, 17, 33, 65 })
  {
    for (int resolution = 32; this->Look && resolution <= 1024; resolution *= 2)
    {
      const double cost = getCost(
        this->PredictPSNR(viewpoints, resolution), this->PredictBytes(viewpoints, resolution));
      if (cost < least)
      {
        least = cost;
        this->SuggestedViewpoints = viewpoints;
        this->SuggestedResolution = resolution;
      }
    }
  }
  return std::isfinite(least) ? 1 : 0;
}

int vtkCSLFBakeEstimator::SuggestForPSNR(double psnr)
{
  return this->Suggest([psnr](double found, double bytes)
    { return found >= psnr ? bytes : std::numeric_limits<double>::infinity(); });
}

int vtkCSLFBakeEstimator::SuggestForBytes(double bytes)
{
  return this->Suggest([bytes](double psnr, double found)
    { return found <= bytes ? -psnr : std::numeric_limits<double>::infinity(); });
}

void vtkCSLFBakeEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Format: " << this->Format << "\n";
  os << indent << "Sampler: " << this->Sampler.Get() << "\n";
  os << indent << "Encoder: " << this->Encoder.Get() << "\n";
  os << indent << "ProbeSeconds: " << this->ProbeSeconds << "\n";
  os << indent << "SceneSeconds: " << this->SceneSeconds << "\n";
  os << indent << "CacheSeconds: " << this->CacheSeconds << "\n";
  os << indent << "RenderSeconds: " << this->RenderSeconds << "\n";
  os << indent << "CodingSeconds: " << this->CodingSeconds << "\n";
  os << indent << "Bytes: " << this->Bytes << "\n";
  os << indent << "SuggestedViewpoints: " << this->SuggestedViewpoints << "\n";
  os << indent << "SuggestedResolution: " << this->SuggestedResolution << "\n";
  os << indent << "SecondsTaken: " << this->SecondsTaken << "\n";
}
