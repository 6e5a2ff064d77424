// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/cslfBakeProbe.h"

#include "CubeMaps/cslfCubeMapFiles.h"
#include "Files/cslfFileSystem.h"
#include "cslfSeconds.h"
#include "vtkCSLFSampler.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <vector>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

// The share of the probe's seconds for groups of full size.
constexpr double GroupShare = 0.4;

// The share of the expected seconds that is enough for groups of full size, and the minimum.
constexpr double EnoughShare = 0.03;
constexpr double MinimumSeconds = 0.4;

// The number of groups of small size, their texels along a tile's side, and their most samples. If
// an encoder does not accept such small pictures, there are fewer groups with as many texels in
// total.
constexpr int SmallGroups = 24;
constexpr int SmallResolution = 32;
constexpr int SmallSamples = 16;

// A whole cache, which tells what the geometry shows, may take so many times the probe's seconds.
constexpr double WholeCacheShare = 2.0;

// The fewest groups of full size.
constexpr int FullGroups = 2;

// The most viewpoints that are written as images.
constexpr int ImageSlices = 48;
constexpr int FirstImageSlices = 6;

// Shorter times depend on what else the machine does.
constexpr double MinimumRenderingSeconds = 0.2;

/// `count` of the numbers below `whole`, evenly spread.
std::vector<int> Spread(int count, int whole)
{
  std::vector<int> chosen;
  chosen.reserve(count);
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

/// A folder for the files that the probe writes.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::error_code failure;
    std::string ignored;
    const std::string prefix = ToName(fs::temp_directory_path(failure) / "cslf-probe-");
    this->Name =
      MakeUniqueFolder(prefix, ForOwner, this->Name, ignored) ? this->Name : std::string();
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

  std::string Name; // empty if it could not be made
};

/// The size of a file of image data as the tool writes it, in bytes.
double CountFile(vtkImageData* image)
{
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->WriteToOutputStringOn();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();
  return writer->Write() ? static_cast<double>(writer->GetOutputString().size()) : 0.0;
}

/// The part of it for arrays, which are compressed in blocks.
double CountArrays(vtkImageData* image)
{
  constexpr std::size_t blockSize = 32768;
  vtkNew<vtkLZ4DataCompressor> compressor;
  // What vtkXMLWriterBase sets.
  compressor->SetCompressionLevel(vtkNew<vtkXMLImageDataWriter>()->GetCompressionLevel());
  std::vector<unsigned char> compressed(compressor->GetMaximumCompressionSpace(blockSize));
  double bytes = 0.0;
  for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(i);
    const auto* values = static_cast<const unsigned char*>(array->GetVoidPointer(0));
    const std::size_t size =
      static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
    for (std::size_t begin = 0; begin < size; begin += blockSize)
    {
      const std::size_t count = std::min(blockSize, size - begin);
      bytes += sizeof(std::uint32_t) +
        compressor->Compress(values + begin, count, compressed.data(), compressed.size());
    }
  }
  return bytes;
}
}

BakeProbe::BakeProbe(
  vtkCSLFSampler* sampler, EncodeSettings settings, bool hasGeometry, Format kind, double seconds)
  : Sampler(sampler)
  , Settings(std::move(settings))
  , HasGeometry(hasGeometry)
  , Kind(kind)
  , Seconds(seconds)
  , Resolution(sampler->GetResolution())
  , Samples(sampler->GetUsedSamples())
  , Threads(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()))
{
}

bool BakeProbe::Estimate()
{
  return this->Kind == Format::Video ? this->EstimateVideo() : this->EstimateImages();
}

void BakeProbe::SetSize(int resolution, int samples)
{
  this->Sampler->SetResolution(resolution);
  this->Sampler->SetSamples(samples);
}

double BakeProbe::GetCodingSeconds(const GroupCosts& costs) const
{
  const double idle =
    costs.RenderSeconds * this->Threads / std::max(costs.RenderThreadSeconds, 1e-9);
  return costs.CodingThreadSeconds / this->Threads * std::clamp(idle, 1.0, 2.0 * this->Threads);
}

// At full size, whatever size is probed.
vtkSmartPointer<vtkPolyData> BakeProbe::MakeGeometry()
{
  if (!this->HasGeometry || this->Sampler->GetGeometryTriangles() == 0)
  {
    return nullptr;
  }
  this->SetSize(this->Resolution, std::min(this->Samples, SmallSamples));
  this->Sampler->Update(1);
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  geometry->ShallowCopy(this->Sampler->GetGeometry());
  return geometry->GetNumberOfPolys() > 0 ? geometry : nullptr;
}

bool BakeProbe::Begin(int resolution, std::optional<EncodeProbe>& probe)
{
  auto start = Clock::now();
  double before = this->Sampler->GetCacheSeconds();
  this->Geometry = this->MakeGeometry();
  this->NoteScene(start, before);
  if (this->Geometry && this->HasRoughCache() &&
    this->Sampler->GetExpectedCacheSeconds() <= WholeCacheShare * this->Seconds)
  {
    const double probed = this->Sampler->GetCacheSeconds();
    this->Sampler->SetCacheProbeSeconds(0.0);
    this->Geometry = this->MakeGeometry();
    const double whole = this->Sampler->GetCacheSeconds();
    this->WholeCacheSeconds = whole - (whole >= probed ? probed : 0.0);
  }
  start = Clock::now();
  before = this->Sampler->GetCacheSeconds();
  this->SetSize(resolution, std::min(this->Samples, SmallSamples));
  probe.emplace(this->Sampler, this->Settings, this->Geometry);
  if (!probe->Begin(this->Error))
  {
    return false;
  }
  if (this->HasRoughCache() && probe->MayTellAll())
  {
    // The texels differ from the geometry only because the light is rough.
    ComputedChannels computed = probe->GetComputed();
    computed.HasColor = true;
    computed.IsAll = true;
    probe.emplace(this->Sampler, this->Settings, this->Geometry, computed);
    if (!probe->Begin(this->Error))
    {
      return false;
    }
  }
  this->NoteScene(start, before);
  return true;
}

bool BakeProbe::HasRoughCache() const
{
  return !this->WholeCacheSeconds && this->Sampler->GetExpectedCacheSeconds() > 0.0;
}

void BakeProbe::NoteScene(Clock::time_point start, double cacheSecondsBefore)
{
  const double cache = this->Sampler->GetCacheSeconds();
  const double probed = cache - (cache >= cacheSecondsBefore ? cacheSecondsBefore : 0.0);
  this->Costs.Scene += std::max(0.0, SecondsSince(start) - probed);
  this->Costs.Cache = this->WholeCacheSeconds.value_or(this->Sampler->GetExpectedCacheSeconds());
}

bool BakeProbe::TimeRendering(int samples, double& seconds)
{
  this->SetSize(this->Resolution, samples);
  FieldStream stream(this->Sampler->GetOutputPort());
  if (!stream.Open())
  {
    this->Error = "The sampler failed.";
    return false;
  }
  const int slices = stream.GetWhole().GetCount();
  const auto start = Clock::now();
  double elapsed = 0.0;
  int done = 0;
  do
  {
    // At least one viewpoint of each face.
    for (const int slice : Spread(std::min(slices, FirstImageSlices), slices))
    {
      if (!stream.Read({ slice, slice }))
      {
        this->Error = "The sampler failed.";
        return false;
      }
      ++done;
    }
    elapsed = SecondsSince(start);
  } while (elapsed < MinimumRenderingSeconds);
  seconds = elapsed / done * slices;
  return true;
}

int BakeProbe::ChooseSmallResolution() const
{
  // Small pictures must use the same encoder as the field.
  const bool isRadiance = this->Sampler->GetColorType() == VTK_FLOAT;
  const EncoderChoice choice = ChooseEncoder(this->Settings, isRadiance, this->Resolution);
  const int least = choice.Encoder ? choice.Encoder->MinimumResolution : SmallResolution;
  // Pixel formats may need an even size.
  const int quarter = this->Resolution / 4 / 2 * 2;
  return std::min(this->Resolution, std::clamp(quarter, least, std::max(least, SmallResolution)));
}

int BakeProbe::ChooseSize(double smallSeconds, int small, int groups, int& fullGroups) const
{
  const double work = static_cast<double>(this->Samples) / std::min(this->Samples, SmallSamples);
  const auto expect = [&](int resolution)
  {
    const double ratio = static_cast<double>(resolution) / small;
    return smallSeconds * ratio * ratio * work;
  };
  const double all = this->Costs.Cache + groups * expect(this->Resolution);
  const double budget =
    std::min(GroupShare * this->Seconds, std::max(MinimumSeconds, EnoughShare * all));
  int resolution = this->Resolution;
  while (resolution / 2 >= small && FullGroups * expect(resolution) > GroupShare * this->Seconds)
  {
    resolution /= 2;
  }
  resolution -= resolution < this->Resolution ? resolution % 2 : 0;
  const double fitting = budget / std::max(expect(resolution), 1e-9);
  fullGroups = static_cast<int>(std::clamp<double>(fitting, std::min(FullGroups, groups), groups));
  fullGroups = 2 * fullGroups > groups ? groups : fullGroups;
  return resolution;
}

bool BakeProbe::EstimateVideo()
{
  this->Error = FindError(this->Settings, this->Resolution);
  if (!this->Error.empty())
  {
    return false;
  }
  // Measure how the cost is distributed.
  const int small = this->ChooseSmallResolution();
  std::optional<EncodeProbe> smallProbe;
  if (!this->Begin(small, smallProbe))
  {
    return false;
  }
  const int groups = smallProbe->GetGroupCount();
  const int fitting = SmallGroups * SmallResolution * SmallResolution / (small * small);
  const std::vector<int> chosen =
    Spread(std::min(groups, std::clamp(fitting, FullGroups, SmallGroups)), groups);
  std::vector<GroupCosts> smallCosts;
  GroupCosts smallSum;
  std::vector<FieldDetail> details;
  for (const int group : chosen)
  {
    GroupCosts costs;
    if (!smallProbe->Make({ group }, costs, this->Error))
    {
      return false;
    }
    smallCosts.push_back(costs);
    smallSum += costs;
    details.push_back(FindDetail(smallProbe->GetSlices(), small));
  }
  this->Detail = MergeDetails(details);
  const double smallSeconds =
    (smallSum.RenderSeconds + this->GetCodingSeconds(smallSum)) / chosen.size();
  int count = 0;
  const int resolution = this->ChooseSize(smallSeconds, small, groups, count);

  // Choose groups of full size, with probabilities in proportion to their sizes.
  std::vector<int> full;
  std::vector<std::size_t> places;
  if (count >= static_cast<int>(chosen.size()))
  {
    full = Spread(count, groups);
  }
  else
  {
    const double step = Sum(smallSum.Bytes) / count;
    double end = 0.0;
    for (std::size_t place = 0; place < chosen.size(); ++place)
    {
      end += smallSum.Bytes[place];
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
  EncodeProbe probe(this->Sampler, this->Settings, this->Geometry, smallProbe->GetComputed());
  GroupCosts costs;
  if (!probe.Begin(this->Error) || !probe.Make(full, costs, this->Error))
  {
    return false;
  }

  // Extrapolate: the small size shows how the chosen groups differ from the others.
  this->Costs.Rendering = costs.RenderSeconds / full.size() * groups;
  this->Costs.Coding = this->GetCodingSeconds(costs) / full.size() * groups;
  double bytes = Sum(costs.Bytes) / full.size() * groups;
  if (!places.empty())
  {
    GroupCosts same;
    double ratios = 0.0;
    for (std::size_t place : places)
    {
      const auto at = std::find(full.begin(), full.end(), chosen[place]) - full.begin();
      ratios += costs.Bytes[at] / smallSum.Bytes[place];
    }
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (std::size_t place : places)
    {
      same += smallCosts[place];
    }
    const double share = static_cast<double>(full.size()) / chosen.size();
    this->Costs.Rendering *= share * smallSum.RenderThreadSeconds / same.RenderThreadSeconds;
    this->Costs.Coding *= share * smallSum.CodingThreadSeconds / same.CodingThreadSeconds;
    bytes = ratios / count * Sum(smallSum.Bytes) / chosen.size() * groups;
  }
  if (resolution > small)
  {
    const double smallBytes = Sum(smallSum.Bytes) / chosen.size() * groups;
    const double ratio = static_cast<double>(resolution) / small;
    this->Growth = std::clamp(std::log(bytes / smallBytes) / std::log(ratio), 0.5, 2.0);
  }
  const double scale = static_cast<double>(this->Resolution) / resolution;
  if (scale > 1.0)
  {
    bytes *= std::pow(scale, this->Growth);
    this->Costs.Rendering *= scale * scale;
    this->Costs.Coding *= scale * scale;
  }
  this->Costs.Bytes = bytes + probe.GetContainerBytes();
  return true;
}

bool BakeProbe::EstimateImages()
{
  const TemporaryFolder folder;
  if (this->Kind == Format::ImageFolder && folder.Name.empty())
  {
    this->Error = "There is no folder for temporary files.";
    return false;
  }
  FieldStream stream(this->Sampler->GetOutputPort());
  const double before = this->Sampler->GetCacheSeconds();
  const auto start = Clock::now();
  if (!stream.Open() || !stream.Read({ 0, 0 }))
  {
    this->Error = stream.GetError().empty() ? "The sampler failed." : stream.GetError();
    return false;
  }
  this->NoteScene(start, before);
  const int slices = stream.GetWhole().GetCount();
  double render = 0.0;
  double write = 0.0;
  double bytes = 0.0;
  double header = 0.0;
  std::string error;
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
      if (this->Kind == Format::ImageData)
      {
        const double arrays = CountArrays(this->Sampler->GetOutput());
        bytes += arrays;
        header = done == 0 ? CountFile(this->Sampler->GetOutput()) - arrays : header;
      }
      for (const Channel& channel : stream.GetDescription().Channels)
      {
        const Layout& grid = stream.GetDescription().Grid;
        if (this->Kind != Format::ImageFolder)
        {
          continue;
        }
        if (!WriteCubeMap(
              folder.Name, grid, channel, slice, stream.GetSlice(channel, slice), error))
        {
          this->Error = error;
          return false;
        }
        std::error_code ignored;
        bytes += fs::file_size(ToPath(CubeMapFileName(folder.Name, channel, slice)), ignored);
      }
      write += SecondsSince(middle);
      ++done;
    }
    if (render + write > GroupShare * this->Seconds ||
      render + write > std::max(MinimumSeconds, EnoughShare * (render + write) / done * slices))
    {
      break;
    }
  }
  const double times = static_cast<double>(slices) / done;
  this->Costs.Rendering = times * render;
  // One thread writes image data, all threads write folders.
  this->Costs.Coding = times * write / (this->Kind == Format::ImageFolder ? this->Threads : 1.0);
  this->Costs.Bytes = header + times * bytes;
  return true;
}
}
