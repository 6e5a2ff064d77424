// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPictures.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfOutputFiles.h"
#include "Files/cslfEncodedImage.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfTableOptions.h"
#include "cslfFieldColors.h"
#include "cslfFrameFiles.h"

#include "cslfSeconds.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkExporter.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>

#include <CLI/CLI.hpp>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace fs = std::filesystem;

namespace cslf::tool
{
vtkSmartPointer<vtkImageData> GrabPicture(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->SetInputBufferTypeToRGB();
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  grabber->Update();
  ThrowOnError();
  return grabber->GetOutput();
}

OffscreenWindow::OffscreenWindow(int width, int height)
{
  this->Renderer->SetBackground(0.0, 0.0, 0.0);
  this->Window->SetOffScreenRendering(1);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
}

OffscreenWindow::~OffscreenWindow() = default;

void OffscreenWindow::AddActor(vtkActor* actor)
{
  this->Renderer->AddActor(actor);
}

void OffscreenWindow::SetBackground(const double color[3])
{
  this->Renderer->SetBackground(color[0], color[1], color[2]);
}

void OffscreenWindow::AddScalarBar(ScalarBar& bar)
{
  const int* size = this->Window->GetSize();
  bar.Fit(size[0], size[1], this->Renderer->GetBackground());
  this->Renderer->AddViewProp(bar.GetProp());
}

void OffscreenWindow::SetDesiredUpdateRate(double rate)
{
  this->Window->SetDesiredUpdateRate(rate);
}

double OffscreenWindow::Draw(vtkCamera* camera)
{
  // Fields know by the camera which pictures follow each other.
  this->Renderer->GetActiveCamera()->DeepCopy(camera);
  const auto start = std::chrono::steady_clock::now();
  this->Renderer->ResetCameraClippingRange();
  this->Window->Render();
  this->Window->WaitForCompletion();
  const double seconds = SecondsSince(start);
  ThrowOnError();
  return seconds;
}

void OffscreenWindow::Export(vtkCamera* camera, vtkExporter* exporter)
{
  this->Renderer->GetActiveCamera()->DeepCopy(camera);
  exporter->SetRenderWindow(this->Window);
  exporter->Write();
  ThrowOnError();
}

vtkSmartPointer<vtkImageData> OffscreenWindow::Grab()
{
  return GrabPicture(this->Window);
}

std::string OffscreenWindow::GetDeviceName()
{
  static const std::regex line("OpenGL renderer string: *([^\n]*)");
  const std::string capabilities = this->Window->ReportCapabilities();
  std::smatch match;
  return std::regex_search(capabilities, match, line) ? match[1].str() : "unknown";
}

vtkSmartPointer<vtkImageData> ReadPicture(const std::string& fileName)
{
  std::error_code failure;
  if (!fs::is_regular_file(ToPath(fileName), failure))
  {
    throw Failure("There is no file " + fileName + ".");
  }
  std::ifstream stream(ToPath(fileName), std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(stream), {});
  std::string error;
  const auto picture =
    DecodeImage(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), "", error);
  if (!picture)
  {
    throw Failure(fileName + " " + error + ".");
  }
  return picture;
}

bool IsPictureName(const std::string& fileName)
{
  static const std::set<std::string> extensions = { ".png", ".jpg", ".jpeg", ".webp", ".gif" };
  return extensions.count(LowerExtension(fileName)) > 0;
}

void RequirePicture(const std::string& fileName)
{
  if (!IsPictureName(fileName))
  {
    throw Failure(std::string("Pictures are written as ") + PictureFormats + ".");
  }
  RequireWritable(fileName);
}

void WritePicture(const std::string& fileName, vtkImageData* picture)
{
  if (LowerExtension(fileName) != ".png")
  {
    ImageFile file(fileName, picture->GetDimensions(), 0.0);
    file.Add(picture);
    file.Publish();
    return;
  }
  const auto bytes = EncodePNG(picture);
  WriteWholeBytes(bytes->GetPointer(0), bytes->GetNumberOfValues(), fileName);
}

// In memory, because VTK does not notice all disk errors.
vtkSmartPointer<vtkUnsignedCharArray> EncodePNG(vtkImageData* picture)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->WriteToMemoryOn();
  writer->Write();
  ThrowOnError();
  return writer->GetResult();
}

vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* picture, const double background[3])
{
  auto result = vtkSmartPointer<vtkImageData>::New();
  result->SetDimensions(picture->GetDimensions());
  result->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* source = static_cast<const unsigned char*>(picture->GetScalarPointer());
  auto* target = static_cast<unsigned char*>(result->GetScalarPointer());
  for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i, source += 4, target += 3)
  {
    for (int k = 0; k < 3; ++k)
    {
      target[k] = static_cast<unsigned char>(
        std::min(255L, std::lround(source[k] + (255 - source[3]) * background[k])));
    }
  }
  return result;
}

namespace
{
/// What a field lacks for a lookup; empty if nothing.
std::string FindLack(const LookupName& lookup, const FieldFile& file)
{
  if (lookup.Lookup == vtkCSLFMapper::GEOMETRY && !file.HasUsefulGeometry())
  {
    return file.GeometryReader ? "geometry that lost at most a fifth of the surfaces" : "geometry";
  }
  return lookup.Lookup >= vtkCSLFMapper::DEPTH && !file.Field.FindChannel(KnownChannel::Depth)
    ? "a depth channel"
    : "";
}

/// The error of a lookup if a field lacks what it needs.
std::string DescribeLack(const LookupName& lookup, const std::string& lack, const FieldFile& file)
{
  const bool isIgnored = lookup.Lookup == vtkCSLFMapper::GEOMETRY && !file.GeometryMismatch.empty();
  return "The " + std::string(lookup.Name) + " lookup needs " + lack +
    ", which the field does not have" + (isIgnored ? ": " + file.GeometryMismatch : ".");
}
}

const std::vector<LookupName>& GetLookups()
{
  static const std::vector<LookupName> lookups = []
  {
    std::vector<LookupName> all;
    all.reserve(vtkCSLFMapper::NUMBER_OF_LOOKUPS);
    for (int lookup = 0; lookup < vtkCSLFMapper::NUMBER_OF_LOOKUPS; ++lookup)
    {
      all.push_back({ lookup, vtkCSLFMapper::GetLookupName(lookup) });
    }
    return all;
  }();
  return lookups;
}

std::vector<LookupName> GetLookups(const FieldFile& file)
{
  std::vector<LookupName> lookups = GetLookups();
  lookups.erase(std::remove_if(lookups.begin(), lookups.end(),
                  [&file](const LookupName& lookup) { return !FindLack(lookup, file).empty(); }),
    lookups.end());
  return lookups;
}

std::vector<std::string> GetLookupNames()
{
  std::vector<std::string> names;
  for (const LookupName& lookup : GetLookups())
  {
    names.emplace_back(lookup.Name);
  }
  return names;
}

std::vector<LookupName> ChooseLookups(const std::vector<std::string>& names, const FieldFile& file)
{
  std::vector<LookupName> lookups;
  for (const LookupName& lookup : GetLookups())
  {
    const bool isNamed = std::count(names.begin(), names.end(), lookup.Name) > 0;
    const std::string lack = FindLack(lookup, file);
    if (isNamed && !lack.empty())
    {
      throw Failure(DescribeLack(lookup, lack, file));
    }
    if (isNamed || (names.empty() && lack.empty()))
    {
      lookups.push_back(lookup);
    }
  }
  return lookups;
}

void AddPixelSamples(CLI::App& command, int& samples)
{
  AddOption(command, options::PixelSamples, samples);
}

void AddLookups(CLI::App& command, std::vector<std::string>& names)
{
  command
    .add_option("--lookups", names,
      "lookups to measure, for example bilinear,depth (default: all for which the field has what "
      "they need)")
    ->delimiter(',')
    ->type_name("LIST")
    ->check(OneOf(GetLookupNames()));
}

int FindLookup(const std::string& name)
{
  const auto& lookups = GetLookups();
  const auto found = std::find_if(
    lookups.begin(), lookups.end(), [&](const LookupName& lookup) { return name == lookup.Name; });
  return found->Lookup;
}

void AddLookup(CLI::App& command, std::string& name, const std::string& help)
{
  command
    .add_option("--lookup", name,
      help + " (default: geometry; without geometry depth, and without depth focal)")
    ->check(OneOf(GetLookupNames()))
    ->default_str("");
}

std::string ChooseLookup(const std::string& name, const FieldFile& file)
{
  const LookupName geometry{ vtkCSLFMapper::GEOMETRY,
    vtkCSLFMapper::GetLookupName(vtkCSLFMapper::GEOMETRY) };
  std::string chosen = name;
  if (name.empty() || name == geometry.Name)
  {
    const std::string lack = FindLack(geometry, file);
    if (!name.empty() && !lack.empty())
    {
      throw Failure(DescribeLack(geometry, lack, file));
    }
    chosen = lack.empty() ? geometry.Name : vtkCSLFMapper::GetLookupName(vtkCSLFMapper::DEPTH);
  }
  const bool needsDepth = FindLookup(chosen) >= vtkCSLFMapper::DEPTH;
  if (needsDepth && !file.Field.FindChannel(KnownChannel::Depth))
  {
    AddWarning("The field has no depth: the focal lookup is used.");
    chosen = vtkCSLFMapper::GetLookupName(vtkCSLFMapper::FOCAL);
  }
  return chosen;
}

FieldRenderer::FieldRenderer(vtkAlgorithmOutput* field, int width, int height)
  : Window(width, height)
{
  this->Mapper->SetInputConnection(field);
  this->Actor->SetMapper(this->Mapper);
  this->Window.AddActor(this->Actor);
}

FieldRenderer::FieldRenderer(const FieldFile& file, int width, int height)
  : FieldRenderer(file.Reader->GetOutputPort(), width, height)
{
  if (file.GeometryReader)
  {
    this->Mapper->SetInputConnection(1, file.GetGeometry());
  }
}

FieldRenderer::~FieldRenderer() = default;

void FieldRenderer::SetColors(const FieldColors& colors)
{
  colors.Apply(this->Mapper);
}

void FieldRenderer::AddScalarBar(const std::string& title)
{
  ScalarBar bar(this->Mapper, title);
  this->Window.AddScalarBar(bar);
}

void FieldRenderer::SetToneMapping(vtkCSLFToneMapping* toneMapping)
{
  this->Mapper->SetToneMapping(toneMapping);
}

double FieldRenderer::Draw(vtkCamera* camera, int lookup)
{
  this->Mapper->SetLookup(lookup);
  return this->Window.Draw(camera);
}

vtkSmartPointer<vtkImageData> FieldRenderer::Render(vtkCamera* camera, int lookup)
{
  this->Draw(camera, lookup);
  return this->Window.Grab();
}

void FieldRenderer::Export(vtkCamera* camera, vtkExporter* exporter)
{
  this->Mapper->SetLookupToGeometry();
  this->Window.Export(camera, exporter);
}

double FieldRenderer::MeasureFrameRate(vtkCamera* camera, int lookup)
{
  constexpr double measuredSeconds = 0.5;
  constexpr int mostFrames = 100;
  // An unchanged view would not be looked up again.
  constexpr double degrees = 0.01;
  vtkNew<vtkCamera> moved;
  moved->DeepCopy(camera);
  this->Draw(moved, lookup);
  // The first picture of a view.
  const bool isStreaming = this->Mapper->GetStreaming();
  this->Mapper->StreamingOn();
  double seconds = 0.0;
  int frames = 0;
  while (frames == 0 || (seconds < measuredSeconds && frames < mostFrames))
  {
    moved->Azimuth(frames % 2 == 0 ? degrees : -degrees);
    seconds += this->Draw(moved, lookup);
    ++frames;
  }
  this->Mapper->SetStreaming(isStreaming);
  return frames / seconds;
}

int FieldRenderer::GetPixelSamples() const
{
  return this->Mapper->GetPixelSamples();
}

void FieldRenderer::SetPixelSamples(int samples)
{
  this->Mapper->SetPixelSamples(samples);
}

void FieldRenderer::SetStreaming(bool streaming)
{
  this->Mapper->SetStreaming(streaming);
}

bool FieldRenderer::IsComplete()
{
  return this->Mapper->IsComplete();
}

std::int64_t FieldRenderer::GetTextureBytes()
{
  return this->Mapper->GetTextureBytes();
}
}
