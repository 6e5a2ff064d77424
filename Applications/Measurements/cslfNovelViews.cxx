// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNovelViews.h"

#include "Console/cslfMessages.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfCameraPath.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"

#include "Console/cslfHelp.h"
#include "Console/cslfNumberChecks.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfFileSystem.h"
#include "cslfJSON.h"
#include "vtkCSLFImageQuality.h"
#include "vtkCSLFToneMapping.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkMath.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtksys/MD5.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

namespace cslf::tool
{
namespace
{
constexpr double MaximumViewPSNR = 60.0; // dB

/// The weighted sum of two linear float pictures, encoded like the field's colours.
vtkSmartPointer<vtkImageData> EncodeSum(vtkImageData* first, double firstWeight,
  vtkImageData* second, double secondWeight, vtkCSLFToneMapping* toneMapping)
{
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->SetDimensions(first->GetDimensions());
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* a = static_cast<const float*>(first->GetScalarPointer());
  const auto* b = static_cast<const float*>(second->GetScalarPointer());
  auto* pixels = static_cast<unsigned char*>(picture->GetScalarPointer());
  for (vtkIdType pixel = 0; pixel < picture->GetNumberOfPoints(); ++pixel)
  {
    double sum[4];
    for (int k = 0; k < 4; ++k)
    {
      sum[k] = firstWeight * a[4 * pixel + k] + secondWeight * b[4 * pixel + k];
    }
    EncodeShown(toneMapping, { sum[0], sum[1], sum[2] }, sum[3], pixels + 3 * pixel);
  }
  return picture;
}

std::string ComputeMD5(const std::string& text)
{
  vtksysMD5* md5 = vtksysMD5_New();
  vtksysMD5_Initialize(md5);
  vtksysMD5_Append(
    md5, reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  std::string hex(32, ' ');
  vtksysMD5_FinalizeHex(md5, hex.data());
  vtksysMD5_Delete(md5);
  return hex;
}

/// A view's picture from an earlier run.
vtkSmartPointer<vtkImageData> ReadHalf(const std::string& fileName, int size)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  ThrowOnError();
  vtkImageData* image = reader->GetOutput();
  const int* dimensions = image->GetDimensions();
  if (dimensions[0] != size || dimensions[1] != size || image->GetScalarType() != VTK_FLOAT ||
    image->GetNumberOfScalarComponents() != 4)
  {
    throw Failure("There is no path-traced view of " + std::to_string(size) + " x " +
      std::to_string(size) + " in " + fileName + ".");
  }
  return image;
}
}

double ComputeNoiseFloor(const Truth& truth, vtkImageStencilData* stencil)
{
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, truth.Halves[0]);
  quality->SetInputData(1, truth.Halves[1]);
  quality->SetStencilData(stencil);
  quality->SetMaximumPSNR(100.0);
  quality->Update();
  ThrowOnError();
  return quality->GetPSNR() + 10.0 * std::log10(4.0);
}

double SubtractNoise(double psnr, double noiseFloor)
{
  constexpr double smallest = 0.05; // of the noise
  const double noise = std::pow(10.0, -0.1 * noiseFloor);
  const double error = std::pow(10.0, -0.1 * psnr) - noise;
  return std::min(MaximumViewPSNR, -10.0 * std::log10(std::max(error, smallest * noise)));
}

TruthTracer::TruthTracer(const SceneOptions& options, const Scene& scene, const std::string& folder)
  : Folder(folder)
{
  options.Apply(scene, this->Tracer);
  this->Tracer->SetColorType(VTK_FLOAT);
  if (folder.empty())
  {
    return;
  }
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  RequireWritable(folder + "/truth.vti");
  vtkNew<vtkCamera> camera;
  const auto pixel = this->TraceHalf(camera, 1, 1, 0);
  auto* sampling = vtkStringArray::SafeDownCast(
    pixel->GetFieldData()->GetAbstractArray(vtkCSLFViewTracer::SAMPLING_NAME()));
  this->Description = sampling->GetValue(0);
}

TruthTracer::~TruthTracer() = default;

Truth TruthTracer::Trace(
  vtkCamera* camera, int size, int samples, int seed, vtkCSLFToneMapping* toneMapping)
{
  const int firstSamples = samples / 2;
  const int secondSamples = samples - firstSamples;
  const auto first = this->GetHalf(camera, size, firstSamples, 2 * seed);
  const auto second = this->GetHalf(camera, size, secondSamples, 2 * seed + 1);
  Truth truth;
  const double weight = static_cast<double>(firstSamples) / samples;
  truth.Picture = EncodeSum(first, weight, second, 1.0 - weight, toneMapping);
  truth.Halves[0] = EncodeSum(first, 1.0, second, 0.0, toneMapping);
  truth.Halves[1] = EncodeSum(first, 0.0, second, 1.0, toneMapping);
  return truth;
}

vtkSmartPointer<vtkImageData> TruthTracer::GetHalf(
  vtkCamera* camera, int size, int samples, int seed)
{
  if (this->Folder.empty())
  {
    return this->TraceHalf(camera, size, samples, seed);
  }
  const std::string fileName = this->GetFileName(camera, size, samples, seed);
  std::error_code failure;
  if (std::filesystem::exists(ToPath(fileName), failure))
  {
    return ReadHalf(fileName, size);
  }
  auto half = this->TraceHalf(camera, size, samples, seed);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(half);
  // Raw appended data is not always readable with newer versions of expat.
  writer->SetDataModeToBinary();
  WriteWhole(writer.Get(), fileName);
  return half;
}

// Linear float colours.
vtkSmartPointer<vtkImageData> TruthTracer::TraceHalf(
  vtkCamera* camera, int size, int samples, int seed)
{
  this->Tracer->SetCamera(camera);
  this->Tracer->SetSize(size, size);
  this->Tracer->SetSamples(samples);
  this->Tracer->SetSeed(seed);
  {
    const ProgressBar bar(this->Tracer, "Tracing the reference");
    this->Tracer->Update();
  }
  ThrowOnError();
  auto half = vtkSmartPointer<vtkImageData>::New();
  half->ShallowCopy(this->Tracer->GetOutput());
  return half;
}

std::string TruthTracer::GetFileName(vtkCamera* camera, int size, int samples, int seed) const
{
  const double* position = camera->GetPosition();
  const double* focalPoint = camera->GetFocalPoint();
  const double* up = camera->GetViewUp();
  nlohmann::json key = nlohmann::json::parse(this->Description);
  key["cslf"] = CSLF_VERSION;
  key["samples"] = samples;
  key["seed"] = seed;
  key["size"] = size;
  key["camera"] = { { position[0], position[1], position[2] },
    { focalPoint[0], focalPoint[1], focalPoint[2] }, { up[0], up[1], up[2] },
    camera->GetViewAngle() };
  return this->Folder + "/" + ComputeMD5(key.dump()) + ".vti";
}

void NovelViewOptions::AddTo(CLI::App& command, const std::string& group)
{
  command.add_option("--views", this->Views, "number of novel views")
    ->check(Between(1, 1000))
    ->capture_default_str()
    ->group(group);
  command.add_option("--size", this->Size, "width and height of a view, in pixels")
    ->check(Between(1, 8192))
    ->capture_default_str()
    ->group(group);
  command
    .add_option(
      "--spp", this->Samples, "samples per pixel of the reference, in both halves together")
    ->check(Between(2, 1 << 20))
    ->capture_default_str()
    ->group(group);
  command.add_option("--seed", this->Seed, "random seed of the views and the reference")
    ->check(Between(0, 1 << 29))
    ->capture_default_str()
    ->group(group);
  command
    .add_option(
      "--truth", this->TruthFolder, "folder that stores the path-traced reference for later runs")
    ->type_name(FolderPlaceholder)
    ->group(group);
}

namespace
{
/// Turns a spiral's next point by the golden angle, which spreads the points evenly.
const double GoldenAngle = vtkMath::Pi() * (3.0 - std::sqrt(5.0));
}

std::vector<vtkSmartPointer<vtkCamera>> MakeNovelViews(
  const Cube& cube, int count, int seed, bool isCornellBox)
{
  std::mt19937 generator(static_cast<unsigned int>(seed));
  const auto random = [&] { return generator() / 4294967296.0; };
  const double lowest = isCornellBox ? std::cos(glm::radians(SwingAngle)) : -1.0;
  const double edge = std::max({ cube.Edges.x, cube.Edges.y, cube.Edges.z });
  const double firstAngle = 2.0 * vtkMath::Pi() * random();
  std::vector<vtkSmartPointer<vtkCamera>> cameras;
  for (int view = 0; view < count; ++view)
  {
    const double cosine = 1.0 - (1.0 - lowest) * (view + random()) / count;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double angle = firstAngle + view * GoldenAngle;
    const glm::dvec3 direction(sine * std::cos(angle), sine * std::sin(angle), cosine);
    cameras.push_back(MakeCamera(cube.Center + MeasuringDistance * edge * direction, cube.Center,
      { 0.0, 1.0, 0.0 }, DefaultViewAngle));
  }
  return cameras;
}

double ComputeChangePSNR(vtkImageData* truthBefore, vtkImageData* pictureBefore,
  vtkImageData* truth, vtkImageData* picture, vtkImageStencilData* stencil)
{
  constexpr double peak = 255.0;
  const auto read = [](vtkImageData* image, int x, int y, int k) -> int
  { return static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0))[k]; };
  const int* size = truth->GetDimensions();
  double sum = 0.0;
  double count = 0.0;
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      for (int k = 0; k < 3 && stencil->IsInside(x, y, 0); ++k)
      {
        const int before = read(pictureBefore, x, y, k) - read(truthBefore, x, y, k);
        const int difference = read(picture, x, y, k) - read(truth, x, y, k) - before;
        sum += 1.0 * difference * difference;
        count += 1.0;
      }
    }
  }
  return sum > 0.0 ? std::min(MaximumViewPSNR, 10.0 * std::log10(peak * peak * count / sum))
                   : MaximumViewPSNR;
}

vtkSmartPointer<vtkImageStencilData> MakeCubeStencil(
  const Cube& cube, vtkCamera* camera, int width, int height)
{
  const double* position = camera->GetPosition();
  const double* focalPoint = camera->GetFocalPoint();
  const double* up = camera->GetViewUp();
  const glm::dvec3 eye(position[0], position[1], position[2]);
  const glm::dvec3 forward =
    glm::normalize(glm::dvec3(focalPoint[0], focalPoint[1], focalPoint[2]) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(up[0], up[1], up[2])));
  const glm::dvec3 above = glm::cross(right, forward);
  const double tangent = std::tan(0.5 * glm::radians(camera->GetViewAngle()));
  const glm::dvec3 eyeCC = cube.PointToCube(eye);
  const auto meetsCube = [&](int x, int y)
  {
    const double s = tangent * (2.0 * (x + 0.5) - width) / height;
    const double t = tangent * (2.0 * (y + 0.5) - height) / height;
    const auto ray = RayToCoordinates(eyeCC, cube.VectorToCube(forward + s * right + t * above));
    return ray && ray->ExitDistance > 0.0;
  };

  auto stencil = vtkSmartPointer<vtkImageStencilData>::New();
  stencil->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  stencil->AllocateExtents();
  for (int y = 0; y < height; ++y)
  {
    // The cube is convex, so each row of its picture is one interval.
    int first = 0;
    int last = width - 1;
    while (first < width && !meetsCube(first, y))
    {
      ++first;
    }
    while (last > first && !meetsCube(last, y))
    {
      --last;
    }
    if (first < width)
    {
      stencil->InsertNextExtent(first, last, y, 0);
    }
  }
  return stencil;
}

std::vector<NovelView> TraceNovelViews(
  const SceneOptions& options, const Scene& scene, const Cube& cube, const NovelViewOptions& novel)
{
  std::vector<NovelView> views;
  TruthTracer tracer(options, scene, novel.TruthFolder);
  for (const auto& camera : MakeNovelViews(cube, novel.Views, novel.Seed, options.HasCornellBox()))
  {
    const int number = static_cast<int>(views.size());
    const Truth truth = tracer.Trace(
      camera, novel.Size, novel.Samples, novel.Seed + number, vtkNew<vtkCSLFToneMapping>());
    const auto stencil = MakeCubeStencil(cube, camera, novel.Size, novel.Size);
    views.push_back({ camera, truth.Picture, stencil, ComputeNoiseFloor(truth, stencil) });
  }
  return views;
}

ViewQuality MeasureViews(FieldRenderer& renderer, int lookup, const std::vector<NovelView>& views)
{
  ViewQuality result;
  for (const NovelView& view : views)
  {
    vtkNew<vtkCSLFImageQuality> quality;
    quality->SetInputData(0, view.Picture);
    quality->SetInputData(1, renderer.Render(view.Camera, lookup));
    quality->SetStencilData(view.Stencil);
    quality->SetMaximumPSNR(100.0);
    quality->Update();
    ThrowOnError();
    result.PSNR.push_back(SubtractNoise(quality->GetPSNR(), view.NoiseFloor));
    result.SSIM.push_back(quality->GetSSIM());
  }
  return result;
}
}
