// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFBakeEstimator.h"

#include "Coding/cslfEncodeProbe.h"
#include "CubeMaps/cslfCubeMapFiles.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSampler.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkCSLFBakeEstimator);

namespace
{
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The parts of the probe's seconds for the radiance cache, and for groups in full size.
constexpr double CacheShare = 0.4;
constexpr double GroupShare = 0.4;

// What of the expected seconds is enough for groups in full size, and the least.
constexpr double EnoughShare = 0.03;
constexpr double LeastSeconds = 0.4;

// Groups in small size, their texels along a tile's side, and their most samples.
constexpr int SmallGroups = 24;
constexpr int SmallResolution = 32;
constexpr int SmallestResolution = 16;
constexpr int SmallSamples = 16;

// The fewest groups in full size.
constexpr int FullGroups = 2;

// The most viewpoints that are written as images.
constexpr int ImageSlices = 48;
constexpr int FirstImageSlices = 6;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// `count` of the numbers below `whole`, evenly spread.
std::vector<int> Spread(int count, int whole)
{
  std::vector<int> chosen;
  for (int i = 0; i < count; ++i)
  {
    chosen.push_back(static_cast<int>((i + 0.5) * whole / count));
  }
  return chosen;
}

double Sum(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Sets a sampler's parameters back.
class Restorer
{
public:
  explicit Restorer(vtkCSLFSampler* sampler)
    : Sampler(sampler)
    , Resolution(sampler->GetResolution())
    , Samples(sampler->GetSamples())
    , Spacing(sampler->GetCacheSpacing())
  {
  }
  ~Restorer()
  {
    this->Sampler->SetResolution(this->Resolution);
    this->Sampler->SetSamples(this->Samples);
    this->Sampler->SetCacheSpacing(this->Spacing);
    this->Sampler->SetCacheProbeSeconds(0.0);
  }
  Restorer(const Restorer&) = delete;
  Restorer& operator=(const Restorer&) = delete;

private:
  vtkCSLFSampler* Sampler;
  int Resolution;
  int Samples;
  double Spacing;
};

/// A folder for what the probe writes.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::error_code ignored;
    std::string name = (fs::temp_directory_path(ignored) / "cslf-probe-XXXXXX").string();
    this->Name = ::mkdtemp(name.data()) ? name : std::string();
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    if (!this->Name.empty())
    {
      fs::remove_all(this->Name, ignored);
    }
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string Name; // empty where it could not be made
};

/// What image data takes in a .vti file.
double CountImageData(vtkImageData* image)
{
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->WriteToOutputStringOn();
  writer->EncodeAppendedDataOff();
  return writer->Write() ? static_cast<double>(writer->GetOutputString().size()) : 0.0;
}
}

/// One estimate at work.
struct vtkCSLFBakeEstimator::Probe
{
  vtkCSLFBakeEstimator* Self;
  vtkCSLFSampler* Sampler;
  std::string Error;
  int Resolution = 0;
  int Samples = 0;
  double Threads = 1.0;

  explicit Probe(vtkCSLFBakeEstimator* self)
    : Self(self)
    , Sampler(self->Sampler)
    , Resolution(this->Sampler->GetResolution())
    , Samples(this->Sampler->GetSamples())
    , Threads(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()))
  {
  }

  cslf::EncodeSettings GetSettings() const
  {
    vtkSmartPointer<vtkCSLFEncoder> encoder = this->Self->Encoder;
    encoder = encoder ? encoder : vtkSmartPointer<vtkCSLFEncoder>::New();
    return { encoder->GetPreset(), encoder->GetPixelFormat(), encoder->GetCRF(),
      encoder->GetCoverageCRF(), encoder->GetDepthCRF(), encoder->GetGroupLength(),
      encoder->GetLossless() };
  }

  void SetSize(int resolution, int samples)
  {
    this->Sampler->SetResolution(resolution);
    this->Sampler->SetSamples(samples);
  }

  /// Wall-clock seconds of coding, on a machine as busy as while it rendered.
  double GetCodingSeconds(const cslf::GroupCosts& costs) const
  {
    const double idle =
      costs.RenderSeconds * this->Threads / std::max(costs.RenderThreadSeconds, 1e-9);
    return costs.CodingThreadSeconds / this->Threads * std::clamp(idle, 1.0, 2.0 * this->Threads);
  }

  /// Builds the scene and looks at the cache.
  bool Begin(cslf::EncodeProbe& probe)
  {
    const auto start = Clock::now();
    const double before = this->Sampler->GetCacheSeconds();
    if (!probe.Begin(this->Error))
    {
      return false;
    }
    this->NoteScene(SecondsSince(start), before);
    return true;
  }

  void NoteScene(double seconds, double cacheSecondsBefore)
  {
    const double cache = this->Sampler->GetCacheSeconds();
    const double probed = cache - (cache >= cacheSecondsBefore ? cacheSecondsBefore : 0.0);
    this->Self->SceneSeconds = std::max(0.0, seconds - probed);
    this->Self->CacheSeconds = this->Sampler->GetExpectedCacheSeconds();
  }

  bool EstimateVideo();
  bool EstimateImages();
  int ChooseSize(double smallSeconds, int small, int groups, int& fullGroups) const;
};

int vtkCSLFBakeEstimator::Probe::ChooseSize(
  double smallSeconds, int small, int groups, int& fullGroups) const
{
  const double work = static_cast<double>(this->Samples) / std::min(this->Samples, SmallSamples);
  const auto expect = [&](int resolution)
  {
    const double ratio = static_cast<double>(resolution) / small;
    return smallSeconds * ratio * ratio * work;
  };
  const double all = this->Self->CacheSeconds + groups * expect(this->Resolution);
  const double budget =
    std::min(GroupShare * this->Self->ProbeSeconds, std::max(LeastSeconds, EnoughShare * all));
  int resolution = this->Resolution;
  while (resolution / 2 >= std::max(small, SmallestResolution) &&
    FullGroups * expect(resolution) > GroupShare * this->Self->ProbeSeconds)
  {
    resolution /= 2;
  }
  resolution -= resolution < this->Resolution ? resolution % 2 : 0;
  const double fitting = budget / std::max(expect(resolution), 1e-9);
  fullGroups = static_cast<int>(std::clamp<double>(fitting, std::min(FullGroups, groups), groups));
  fullGroups = 2 * fullGroups > groups ? groups : fullGroups;
  return resolution;
}

bool vtkCSLFBakeEstimator::Probe::EstimateVideo()
{
  // How is the cost spread?
  const int small = std::min(
    this->Resolution, std::clamp(this->Resolution / 4, SmallestResolution, SmallResolution));
  this->SetSize(small, std::min(this->Samples, SmallSamples));
  cslf::EncodeProbe smallProbe(this->Sampler, this->GetSettings());
  if (!this->Begin(smallProbe))
  {
    return false;
  }
  const int groups = smallProbe.GetGroupCount();
  const std::vector<int> chosen = Spread(std::min(groups, SmallGroups), groups);
  cslf::GroupCosts smallCosts;
  if (!smallProbe.Make(chosen, smallCosts, this->Error))
  {
    return false;
  }
  const double smallSeconds =
    (smallCosts.RenderSeconds + this->GetCodingSeconds(smallCosts)) / chosen.size();
  int count = 0;
  const int resolution = this->ChooseSize(smallSeconds, small, groups, count);

  // Take groups in full size, each as likely as it is large.
  std::vector<int> full;
  std::vector<std::size_t> places;
  if (count >= static_cast<int>(chosen.size()))
  {
    full = Spread(count, groups);
  }
  else
  {
    const double step = Sum(smallCosts.Bytes) / count;
    double end = 0.0;
    for (std::size_t place = 0; place < chosen.size(); ++place)
    {
      end += smallCosts.Bytes[place];
      while (static_cast<int>(places.size()) < count && end > (places.size() + 0.5) * step)
      {
        places.push_back(place);
        if (full.empty() || full.back() != chosen[place])
        {
          full.push_back(chosen[place]);
        }
      }
    }
  }
  this->SetSize(resolution, this->Samples);
  cslf::EncodeProbe probe(this->Sampler, this->GetSettings());
  cslf::GroupCosts costs;
  if (!probe.Begin(this->Error) || !probe.Make(full, costs, this->Error))
  {
    return false;
  }

  // Extrapolate.
  double bytes = Sum(costs.Bytes) / full.size() * groups;
  if (!places.empty())
  {
    double ratios = 0.0;
    for (std::size_t place : places)
    {
      const auto at = std::find(full.begin(), full.end(), chosen[place]) - full.begin();
      ratios += costs.Bytes[at] / smallCosts.Bytes[place];
    }
    bytes = ratios / places.size() * Sum(smallCosts.Bytes) / chosen.size() * groups;
  }
  const double scale = static_cast<double>(this->Resolution) / resolution;
  if (scale > 1.0)
  {
    const double smallBytes = Sum(smallCosts.Bytes) / chosen.size() * groups;
    const double power = resolution > small
      ? std::log(bytes / smallBytes) / std::log(static_cast<double>(resolution) / small)
      : 1.5;
    bytes *= std::pow(scale, std::clamp(power, 1.0, 2.0));
  }
  const double times = scale * scale * groups / full.size();
  this->Self->RenderSeconds = times * costs.RenderSeconds;
  this->Self->CodingSeconds = times * this->GetCodingSeconds(costs);
  this->Self->Bytes = bytes + probe.GetContainerBytes();
  return true;
}

bool vtkCSLFBakeEstimator::Probe::EstimateImages()
{
  const TemporaryFolder folder;
  if (this->Self->Format == ImageFolder && folder.Name.empty())
  {
    this->Error = "There is no folder for temporary files.";
    return false;
  }
  cslf::SlabStream stream(this->Sampler->GetOutputPort());
  const double before = this->Sampler->GetCacheSeconds();
  const auto start = Clock::now();
  if (!stream.Open() || !stream.Read({ 0, 0 }))
  {
    this->Error = stream.GetError().empty() ? "The sampler failed." : stream.GetError();
    return false;
  }
  this->NoteScene(SecondsSince(start), before);
  const int slices = stream.GetWhole().GetCount();
  double render = 0.0;
  double write = 0.0;
  double bytes = 0.0;
  int done = 0;
  const std::vector<int> order = Spread(std::min(slices, ImageSlices), slices);
  const int step = std::max(1, static_cast<int>(order.size()) / FirstImageSlices);
  for (int offset = 0; offset < step; ++offset)
  {
    for (std::size_t place = offset; place < order.size(); place += step)
    {
      const int slice = order[place];
      const auto begin = Clock::now();
      if (!stream.Read({ slice, slice }))
      {
        this->Error = stream.GetError().empty() ? "The sampler failed." : stream.GetError();
        return false;
      }
      render += SecondsSince(begin);
      const auto middle = Clock::now();
      if (this->Self->Format == ImageData)
      {
        bytes += CountImageData(this->Sampler->GetOutput());
      }
      for (const cslf::Channel& channel : stream.GetDescription().Channels)
      {
        const cslf::Layout& grid = stream.GetDescription().Grid;
        std::error_code failure;
        if (this->Self->Format == ImageFolder &&
          cslf::WriteCubeMap(folder.Name, grid, channel, slice, stream.GetSlice(channel, slice),
            this->Error))
        {
          bytes += fs::file_size(cslf::CubeMapFileName(folder.Name, channel, slice), failure);
        }
      }
      write += SecondsSince(middle);
      ++done;
    }
    if (render + write > GroupShare * this->Self->ProbeSeconds ||
      render + write > std::max(LeastSeconds, EnoughShare * (render + write) / done * slices))
    {
      break;
    }
  }
  const double times = static_cast<double>(slices) / done;
  this->Self->RenderSeconds = times * render;
  // Image data is written by one thread, folders by all.
  this->Self->CodingSeconds =
    times * write / (this->Self->Format == ImageFolder ? this->Threads : 1.0);
  this->Self->Bytes = times * bytes;
  return this->Error.empty();
}

vtkCSLFBakeEstimator::vtkCSLFBakeEstimator() = default;
vtkCSLFBakeEstimator::~vtkCSLFBakeEstimator() = default;

void vtkCSLFBakeEstimator::SetSampler(vtkCSLFSampler* sampler)
{
  if (this->Sampler != sampler)
  {
    this->Sampler = sampler;
    this->Modified();
  }
}

vtkCSLFSampler* vtkCSLFBakeEstimator::GetSampler()
{
  return this->Sampler;
}

void vtkCSLFBakeEstimator::SetEncoder(vtkCSLFEncoder* encoder)
{
  if (this->Encoder != encoder)
  {
    this->Encoder = encoder;
    this->Modified();
  }
}

vtkCSLFEncoder* vtkCSLFBakeEstimator::GetEncoder()
{
  return this->Encoder;
}

double vtkCSLFBakeEstimator::GetSeconds() const
{
  return this->SceneSeconds + this->CacheSeconds + this->RenderSeconds + this->CodingSeconds;
}

int vtkCSLFBakeEstimator::Estimate()
{
  if (!this->Sampler)
  {
    vtkErrorMacro("There is no sampler.");
    return 0;
  }
  const auto start = Clock::now();
  const Restorer restorer(this->Sampler);
  // The spacing that goes with the resolution, whatever size is probed.
  if (this->Sampler->GetCacheSpacing() <= 0.0)
  {
    this->Sampler->SetCacheSpacing(
      vtkCSLFPathTracer::GetAutomaticCacheSpacing(this->Sampler->GetResolution()));
  }
  this->Sampler->SetCacheProbeSeconds(CacheShare * this->ProbeSeconds);
  Probe probe(this);
  const bool isDone = this->Format == Video ? probe.EstimateVideo() : probe.EstimateImages();
  if (!isDone)
  {
    vtkErrorMacro(<< probe.Error);
  }
  this->SecondsTaken = SecondsSince(start);
  return isDone ? 1 : 0;
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
  os << indent << "SecondsTaken: " << this->SecondsTaken << "\n";
}
