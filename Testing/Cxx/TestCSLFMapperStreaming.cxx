// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field drawn from its decoder: the same pictures as from memory, coarse ones at first unless the
// mapper waits, within a budget of graphics memory, and despite damage.
#include "Lookup/cslfLookup.h"
#include "Pipeline/cslfFieldStore.h"
#include "cslfCodecTesting.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

namespace
{
using cslf::testing::ComparePictures;
using cslf::testing::Picture;
using cslf::testing::View;

constexpr int Viewpoints = 9;
constexpr int Resolution = 32;
constexpr vtkTypeInt64 RawBytes =
  vtkTypeInt64(6) * 6 * Viewpoints * Viewpoints * 5 * Resolution * Resolution;
/// In dB. The start of the search along a ray depends on viewpoints that were loaded before, so
/// single pixels at silhouettes differ.
constexpr double Same = 38.0;

/// A mapper of a file.
struct Streamed
{
  vtkNew<vtkCSLFDecoder> Decoder;
  vtkNew<vtkCSLFMapper> Mapper;

  explicit Streamed(const std::string& fileName)
  {
    this->Decoder->SetFileName(fileName.c_str());
    this->Mapper->SetInputConnection(this->Decoder->GetOutputPort());
    this->Mapper->SetPixelSamples(1);
  }
};

vtkSmartPointer<vtkCSLFMapper> MakeMapper(vtkImageData* field)
{
  auto mapper = vtkSmartPointer<vtkCSLFMapper>::New();
  mapper->SetInputData(field);
  mapper->SetPixelSamples(1);
  return mapper;
}

/// The picture of a mapper that has drawn nothing before.
Picture DrawAnew(vtkImageData* field, const double position[3])
{
  View view;
  view.Add(MakeMapper(field));
  view.GetCamera()->SetPosition(position);
  return view.Render();
}

/// Cameras that see one, two and three faces in turn, with little memory for decoded viewpoints.
void TestMoves(const std::string& fileName, vtkImageData* whole)
{
  const double positions[][3] = { { 0.3, 0.2, 5.0 }, { 2.5, 0.2, 4.5 }, { 2.5, 2.5, 3.5 },
    { -3.0, 2.5, 3.0 }, { -3.0, -2.5, -3.0 }, { 0.3, 0.2, 5.0 } };
  Streamed streamed(fileName);
  streamed.Decoder->SetCacheSize(vtkTypeInt64(100) * 30 * Resolution * Resolution);
  View view;
  view.Add(streamed.Mapper);
  for (const double* position : positions)
  {
    view.GetCamera()->SetPosition(position);
    const double psnr = ComparePictures(view.Render(), DrawAnew(whole, position));
    std::cout << "after a move: " << psnr << " dB\n";
    CSLF_CHECK(psnr > Same);
    CSLF_CHECK(streamed.Mapper->IsComplete());
    CSLF_CHECK(streamed.Mapper->GetTextureBytes() < 0.35 * RawBytes);
  }
  CSLF_CHECK(streamed.Decoder->GetOutput()->GetNumberOfPoints() == 0);

  // From inside the cube all faces count; outside again, they do not.
  view.GetCamera()->SetPosition(0.1, 0.2, 0.3);
  view.GetCamera()->SetClippingRange(0.01, 12.0);
  view.Render();
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() > 0.9 * RawBytes);
  view.GetCamera()->SetClippingRange(1.0, 12.0);
  view.GetCamera()->SetPosition(positions[2]);
  CSLF_CHECK(ComparePictures(view.Render(), DrawAnew(whole, positions[2])) > Same);
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() < 0.35 * RawBytes);
}

void Count(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

void TestStreaming(const std::string& fileName, vtkImageData* whole)
{
  const double position[3] = { 2.5, 2.0, 3.5 };
  const Picture complete = DrawAnew(whole, position);
  Streamed streamed(fileName);
  streamed.Mapper->StreamingOn();
  int requests = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetCallback(Count);
  counter->SetClientData(&requests);
  streamed.Mapper->AddObserver(vtkCommand::UpdateDataEvent, counter);
  View view;
  view.Add(streamed.Mapper);
  view.GetCamera()->SetPosition(position);
  const Picture first = view.Render();
  CSLF_CHECK(!streamed.Mapper->IsComplete() && requests > 0);
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() < 0.1 * RawBytes);
  CSLF_CHECK(first.CountDrawn() > complete.CountDrawn() / 2);
  int renders = 0;
  Picture last = first;
  for (; renders < 10000 && !streamed.Mapper->IsComplete(); ++renders)
  {
    last = view.Render();
  }
  std::cout << "first: " << ComparePictures(first, complete) << " dB, complete after " << renders
            << " more\n";
  CSLF_CHECK(renders > 0 && renders < 10000);
  CSLF_CHECK(ComparePictures(last, complete) > Same);
  requests = 0;
  view.Render();
  CSLF_CHECK(requests == 0);

  // Released resources are created again.
  streamed.Mapper->ReleaseGraphicsResources(view.Window);
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() == 0);
  streamed.Mapper->StreamingOff();
  CSLF_CHECK(ComparePictures(view.Render(), complete) > Same);
}

/// Each window has the samples for its own camera.
void TestWindows(const std::string& fileName, vtkImageData* whole)
{
  const double here[3] = { 2.5, 2.0, 3.5 };
  const double there[3] = { -2.5, -2.0, -3.5 };
  Streamed streamed(fileName);
  View first;
  View second;
  first.Add(streamed.Mapper);
  second.Add(streamed.Mapper);
  first.GetCamera()->SetPosition(here);
  second.GetCamera()->SetPosition(there);
  for (int turn = 0; turn < 2; ++turn)
  {
    CSLF_CHECK(ComparePictures(first.Render(), DrawAnew(whole, here)) > Same);
    CSLF_CHECK(ComparePictures(second.Render(), DrawAnew(whole, there)) > Same);
  }
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() < 0.7 * RawBytes);
}

/// Actors that share a mapper, and need different samples, do not take them from each other.
void TestSharedMapper(const std::string& fileName)
{
  Streamed streamed(fileName);
  streamed.Decoder->SetCacheSize(vtkTypeInt64(100) * 30 * Resolution * Resolution);
  View view;
  for (int index = 0; index < 2; ++index)
  {
    const auto actor = view.Add(streamed.Mapper);
    actor->SetScale(0.5);
    actor->RotateY(180.0 * index);
    actor->SetPosition(index == 0 ? -0.7 : 0.7, 0.0, 0.0);
  }
  using Clock = std::chrono::steady_clock;
  std::vector<double> seconds;
  for (int frame = 0; frame < 6; ++frame)
  {
    const auto start = Clock::now();
    view.Render();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const double later = *std::min_element(seconds.begin() + 1, seconds.end());
  std::cout << "two actors: " << seconds[0] << " s at first, then " << later << " s\n";
  CSLF_CHECK(later < 0.2 * seconds[0]);
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() < 0.7 * RawBytes);

  // Streamed, the pictures become complete and stay so.
  streamed.Mapper->ReleaseGraphicsResources(view.Window);
  streamed.Mapper->StreamingOn();
  int renders = 0;
  do
  {
    view.Render();
  } while (++renders < 10000 && !streamed.Mapper->IsComplete());
  CSLF_CHECK(renders > 1 && renders < 10000);
  int requests = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetCallback(Count);
  counter->SetClientData(&requests);
  streamed.Mapper->AddObserver(vtkCommand::UpdateDataEvent, counter);
  for (int frame = 0; frame < 3; ++frame)
  {
    view.Render();
  }
  CSLF_CHECK(requests == 0);

  // Within less memory, each frame has the same share for both, and a single actor all of it.
  streamed.Mapper->StreamingOff();
  const auto limit = static_cast<vtkTypeInt64>(0.2 * RawBytes);
  streamed.Mapper->SetTextureMemoryLimit(limit);
  const Picture both = view.Render();
  CSLF_CHECK(streamed.Mapper->GetTextureBytes() <= limit);
  CSLF_CHECK(ComparePictures(view.Render(), both) > Same);
}

/// With less memory the grid is coarser where the camera does not look.
void TestBudget(const std::string& fileName, vtkImageData* whole)
{
  const double position[3] = { 2.5, 2.0, 3.5 };
  const Picture complete = DrawAnew(whole, position);
  Streamed streamed(fileName);
  View view;
  view.Add(streamed.Mapper);
  view.GetCamera()->SetPosition(position);
  for (const double share : { 0.2, 0.1, 0.02 })
  {
    const auto limit = static_cast<vtkTypeInt64>(share * RawBytes);
    streamed.Mapper->SetTextureMemoryLimit(limit);
    const Picture picture = view.Render();
    CSLF_CHECK(streamed.Mapper->GetTextureBytes() <= limit);
    CSLF_CHECK(streamed.Mapper->GetTextureBytes() > limit / 2);
    CSLF_CHECK(streamed.Mapper->IsComplete());
    const double psnr = ComparePictures(picture, complete);
    std::cout << share << " of the raw bytes: " << psnr << " dB to the complete picture\n";
    CSLF_CHECK(psnr > 15.0);
  }
}

void TestDamage(const std::string& fileName, vtkImageData* whole)
{
  const double position[3] = { 2.5, 2.0, 3.5 };
  const std::string damaged = fileName + ".damaged.mp4";
  std::vector<char> bytes = cslf::testing::ReadBytes(fileName);
  std::mt19937 random(5);
  for (std::size_t hit = 0; hit < 12; ++hit)
  {
    bytes[bytes.size() / 4 + random() % (bytes.size() / 2)] ^= 0x55;
  }
  cslf::testing::WriteBytes(damaged, bytes);
  Streamed streamed(damaged);
  const cslf::testing::Observed decoder(streamed.Decoder);
  const cslf::testing::Observed mapper(streamed.Mapper);
  View view;
  view.Add(streamed.Mapper);
  view.GetCamera()->SetPosition(position);
  const Picture picture = view.Render();
  view.Render();
  CSLF_CHECK(decoder.GetErrors() == 0 && mapper.GetErrors() == 0);
  CSLF_CHECK(mapper.GetWarnings() == 1 && mapper.HasWarning("The light field is damaged"));
  const double psnr = ComparePictures(picture, DrawAnew(whole, position));
  std::cout << "damaged: " << psnr << " dB to the whole\n";
  CSLF_CHECK(psnr > 15.0);

  vtkNew<vtkCSLFMapper> nothing;
  const cslf::testing::Observed refused(nothing);
  vtkNew<vtkCSLFDecoder> missing;
  const cslf::testing::Observed missed(missing);
  missing->SetFileName((fileName + ".missing.mp4").c_str());
  nothing->SetInputConnection(missing->GetOutputPort());
  View other;
  other.Add(nothing);
  CSLF_CHECK(other.Render().GetMean() == 0.0);
  other.Render();
  CSLF_CHECK(missed.GetErrors() == 1 && refused.GetErrors() == 0);
}

/// The loss of quality without the tiles that viewpoints have of faces visible to the camera,
/// compared with the scene itself, in dB.
void TestLoss(vtkImageData* whole)
{
  std::string error;
  const cslf::Description field = *cslf::Description::ReadFrom(whole, error);
  const cslf::Lookup all(field, whole);
  cslf::Lookup kept(field, whole);
  const cslf::ChannelReader colors(field.Grid, whole->GetPointData()->GetArray(cslf::ColorName));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const glm::dvec3& eye :
    { glm::dvec3(0.3, 0.2, 5.0), glm::dvec3(2.5, 0.2, 4.5), glm::dvec3(2.5, 2.5, 3.5) })
  {
    int seen = 0;
    for (int face = 0; face < cslf::FaceCount; ++face)
    {
      seen |= cslf::FaceSign(face) * eye[cslf::FaceAxis(face)] > 1.0 ? 1 << face : 0;
    }
    double sums[2] = { 0.0, 0.0 };
    kept.LeaveOut(seen);
    for (int k = 0; k < 20000; ++k)
    {
      const glm::dvec3 target(uniform(random), uniform(random), uniform(random));
      const auto ray = cslf::RayToCoordinates(eye, target - eye);
      const cslf::testing::TestHit hit = cslf::testing::TraceTestScene(eye, target - eye);
      for (int part = 0; part < 2; ++part)
      {
        const glm::dvec4 color = colors.Blend((part == 0 ? all : kept).DepthCorrected(*ray));
        for (int c = 0; c < 3; ++c)
        {
          const double linear = hit.Hit ? hit.Color[c] : 0.0;
          const double truth =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
          sums[part] += (color[c] - truth) * (color[c] - truth);
        }
      }
    }
    const double loss = 10.0 * std::log10(sums[1] / sums[0]);
    std::cout << "without the exits of faces seen: " << loss << " dB lost of "
              << -10.0 * std::log10(sums[0] / 60000.0) << "\n";
    CSLF_CHECK(loss < 0.3);
  }
}

/// With StaticOn, the mapper draws the file that the decoder has open, until somebody else updates
/// the decoder. Fields of other sizes, and no field at all, come next.
void TestStatic(const std::string& fileName, vtkImageData* whole)
{
  const double position[3] = { 2.5, 2.0, 3.5 };
  Streamed streamed(fileName);
  streamed.Decoder->UpdateInformation();
  streamed.Mapper->StaticOn();
  View view;
  view.Add(streamed.Mapper);
  // One face, so that others are decoded only after the change.
  view.GetCamera()->SetPosition(0.3, 0.2, 5.0);
  view.Render();
  view.GetCamera()->SetPosition(position);
  const Picture expected = DrawAnew(whole, position);
  for (const int viewpoints : { 3, 17 })
  {
    const std::string other = fileName + "." + std::to_string(viewpoints) + ".mp4";
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetPreset("ultrafast");
    CSLF_CHECK(cslf::testing::Encode(
      encoder, cslf::testing::MakeByteField(viewpoints, viewpoints == 3 ? 64 : 16), other));
    streamed.Decoder->SetFileName(other.c_str());
    CSLF_CHECK(ComparePictures(view.Render(), expected) > Same);
    CSLF_CHECK(streamed.Mapper->IsComplete());
    // Whoever asks the decoder for something opens the other file. The mapper keeps its own.
    vtkNew<vtkImageData> image;
    const auto store = cslf::BorrowStore(streamed.Decoder->GetOutputInformation(0));
    CSLF_CHECK(store->GetDescription().Grid.GetViewpoints() == Viewpoints);
    CSLF_CHECK(
      store->Get(6 * Viewpoints * Viewpoints - 1).Get<unsigned char>(cslf::KnownChannel::Color) !=
      nullptr);
    CSLF_CHECK(ComparePictures(view.Render(), expected) > Same);
    CSLF_CHECK(streamed.Decoder->GetViewpoint(viewpoints, image));
    const Picture next = view.Render();
    CSLF_CHECK(ComparePictures(next, DrawAnew(cslf::testing::Decode(other), position)) > Same);
    CSLF_CHECK(ComparePictures(next, expected) < Same);
    streamed.Decoder->SetFileName(fileName.c_str());
    streamed.Decoder->UpdateInformation();
    CSLF_CHECK(ComparePictures(view.Render(), expected) > Same);
  }
  const cslf::testing::Observed observed(streamed.Decoder);
  streamed.Decoder->SetFileName((fileName + ".none").c_str());
  CSLF_CHECK(ComparePictures(view.Render(), expected) > Same);
  CSLF_CHECK(observed.GetErrors() == 0);
  streamed.Decoder->UpdateInformation();
  CSLF_CHECK(observed.GetErrors() > 0);
  CSLF_CHECK(view.Render().CountDrawn() == 0);
}
}

int TestCSLFMapperStreaming(int argc, char* argv[])
{
  const std::string fileName =
    cslf::testing::MakeFolder(argc, argv, "MapperStreaming") + "/field.mp4";
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  CSLF_CHECK(
    cslf::testing::Encode(encoder, cslf::testing::MakeByteField(Viewpoints, Resolution), fileName));
  const auto whole = cslf::testing::Decode(fileName);
  CSLF_CHECK(whole != nullptr);
  if (whole)
  {
    TestMoves(fileName, whole);
    TestStreaming(fileName, whole);
    TestWindows(fileName, whole);
    TestSharedMapper(fileName);
    TestBudget(fileName, whole);
    TestDamage(fileName, whole);
    TestLoss(whole);
    TestStatic(fileName, whole);
  }
  return cslf::testing::Result();
}
