// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Certificates of files: what they say, that they are true, that damage and other scenes are found,
// and where there is none.
#include "Certificate/cslfCertifier.h"
#include "Certificate/cslfShownPixels.h"
#include "cslfCertificate.h"
#include "cslfCodecTesting.h"
#include "cslfDescription.h"
#include "cslfJSON.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFFieldCertifier.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace
{
struct SceneOptions
{
  double Radius = 0.5;
  double Metallic = 0.0;
};

/// The light and the scene that every tracer of this test shares: two balls, one on the other.
void SetScene(vtkCSLFPathTracer* tracer, const SceneOptions& options)
{
  for (const double height : { 0.0, 0.7 })
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(height > 0.0 ? 0.3 : options.Radius);
    ball->SetCenter(0.0, height, 0.0);
    ball->SetThetaResolution(32);
    ball->SetPhiResolution(32);
    ball->Update();
    vtkCSLFMaterial::SetMetallic(ball->GetOutput(), options.Metallic);
    vtkCSLFMaterial::SetRoughness(ball->GetOutput(), 0.3);
    tracer->AddInputData(ball->GetOutput());
  }
  tracer->GetEnvironment()->SetModeToGradient();
  tracer->SetMaximumDepth(3);
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler(const SceneOptions& options)
{
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  SetScene(sampler, options);
  sampler->SetViewpoints(3);
  sampler->SetResolution(32);
  sampler->GenerateDepthOn();
  return sampler;
}

struct EncoderOptions
{
  bool Certificate = true;
  double TargetSize = 0.0;
};

void Write(vtkCSLFSampler* sampler, const std::string& fileName, const EncoderOptions& options = {})
{
  vtkNew<vtkCSLFEncoder> encoder;
  CSLF_CHECK(encoder->GetCertificate());
  encoder->SetInputConnection(0, sampler->GetOutputPort(0));
  encoder->SetInputConnection(1, sampler->GetOutputPort(1));
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  encoder->SetCertificate(options.Certificate);
  encoder->GetRateControl()->SetTargetSize(options.TargetSize);
  CSLF_CHECK(encoder->Write() == 1);
}

vtkSmartPointer<vtkCSLFDecoder> Open(const std::string& fileName)
{
  auto decoder = vtkSmartPointer<vtkCSLFDecoder>::New();
  decoder->SetFileName(fileName.c_str());
  decoder->Update();
  return decoder;
}

std::optional<cslf::Certificate> ReadCertificate(vtkImageData* field)
{
  std::string error;
  const auto description = cslf::Description::ReadFrom(field, error);
  CSLF_CHECK(description.has_value());
  return description ? description->Measured : std::nullopt;
}

vtkSmartPointer<vtkCSLFFieldCertifier> MakeCertifier(
  const SceneOptions& options, vtkImageData* field, vtkPolyData* geometry)
{
  auto certifier = vtkSmartPointer<vtkCSLFFieldCertifier>::New();
  SetScene(certifier, options);
  certifier->SetInputData(1, field);
  certifier->SetInputData(2, geometry);
  return certifier;
}

cslf::Certificate Measure(vtkCSLFFieldCertifier* certifier)
{
  CSLF_CHECK(certifier->Measure() == 1);
  const auto measured =
    cslf::Certificate::FromJSON(nlohmann::json::parse(certifier->GetCertificate()));
  CSLF_CHECK(measured.has_value());
  return measured.value_or(cslf::Certificate());
}

void ScaleColors(vtkDataArray* colors, double factor)
{
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      colors->SetComponent(i, k, factor * colors->GetComponent(i, k));
    }
  }
}

/// The comparison of two certificates, and their text.
void TestComparison()
{
  cslf::Certificate good;
  good.Rays = 1000;
  good.Samples = 64;
  good.Seed = 3;
  good.Mean = 0.001;
  good.MeanError = 0.0005;
  good.Square = 1e-4;
  good.SquareError = 1e-5;
  good.Seen = 0.5;
  good.Version = "1.2.3";
  good.Scene = "abc";
  CSLF_CHECK_NEAR(good.GetPSNR(), 40.0, 1e-9);
  CSLF_CHECK_NEAR(good.GetRMS(), 0.01, 1e-9);
  const auto copy = cslf::Certificate::FromJSON(good.ToJSON());
  CSLF_CHECK(copy.has_value() && copy->ToJSON() == good.ToJSON() && copy->HasSameRays(good));
  CSLF_CHECK(good.Describe().find("40.00 dB") == 0);
  CSLF_CHECK(good.FindWorse(good).empty());

  // What is below its standard error is known to be no more than that.
  cslf::Certificate noise = good;
  noise.Square = -3e-6;
  CSLF_CHECK_NEAR(noise.GetPSNR(), 50.0, 1e-9);
  CSLF_CHECK(good.FindWorse(noise).empty());

  // The same rays: more than 1 dB, and more than one standard error.
  cslf::Certificate later = good;
  later.Square = 1.2e-4;
  CSLF_CHECK(good.FindWorse(later).empty());
  later.Square = 1.3e-4;
  CSLF_CHECK(good.FindWorse(later).find("not 40.00 dB") != std::string::npos);
  CSLF_CHECK(later.FindWorse(good).empty());
  later.SquareError = 4e-5;
  CSLF_CHECK(good.FindWorse(later).empty());
  // Other rays: four standard errors of the difference.
  later = good;
  later.Seed = 4;
  CSLF_CHECK(!later.HasSameRays(good));
  later.Square = 1.5e-4;
  CSLF_CHECK(good.FindWorse(later).empty());
  later.Square = 1.6e-4;
  CSLF_CHECK(!good.FindWorse(later).empty());
  later = good;
  later.Mean = -0.004;
  CSLF_CHECK(good.FindWorse(later).find("mean") != std::string::npos);
  later.Mean = std::nan("");
  CSLF_CHECK(!good.FindWorse(later).empty());

  for (const char* key : { "rays", "mean", "mean_square", "cslf", "scene" })
  {
    nlohmann::json json = good.ToJSON();
    json.erase(key);
    CSLF_CHECK(!cslf::Certificate::FromJSON(json));
  }
  nlohmann::json json = good.ToJSON();
  json["rays"] = 0;
  CSLF_CHECK(!cslf::Certificate::FromJSON(json) && !cslf::Certificate::FromJSON(nullptr));
}

/// Each pixel belongs to a camera outside, and its middle sees the cube.
void TestBeams()
{
  const cslf::Cube box{ { 1.0, -2.0, 3.0 }, { 4.0, 1.0, 2.0 } };
  const auto beams = cslf::MakePixelBeams(box, 100, 5);
  const auto others = cslf::MakePixelBeams(box, 100, 6);
  CSLF_CHECK(beams.size() == 100);
  glm::dvec3 sum(0.0);
  int different = 0;
  for (std::size_t k = 0; k < beams.size(); ++k)
  {
    const glm::dvec3 eyeCC = box.PointToCube(beams[k].Eye);
    const auto ray =
      cslf::RayToCoordinates(eyeCC, box.VectorToCube(beams[k].GetDirection(0.5, 0.5)));
    CSLF_CHECK(ray.has_value() && ray->EntryDistance > 0.0 && ray->ExitDistance < 1.0);
    CSLF_CHECK(
      ray.has_value() && (cslf::FindSeenFaces(box, beams[k].Eye) >> ray->Entry.Face & 1) == 1);
    sum += (beams[k].Eye - box.Center) / 8.0;
    different += beams[k].Eye != others[k].Eye;
  }
  CSLF_CHECK(std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z) < 5.0);
  CSLF_CHECK(different == 100);
}

/// A diffuse scene: what the file says is what another measurement finds, and damage is found.
void TestDiffuse(const std::string& folder)
{
  const SceneOptions scene;
  const std::string fileName = folder + "/diffuse.mp4";
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 2 }, [&]() { Write(MakeSampler(scene), fileName); });
  const auto decoder = Open(fileName);
  const auto certificate = ReadCertificate(decoder->GetOutput());
  CSLF_CHECK(certificate.has_value());
  if (!certificate)
  {
    return;
  }
  std::cout << certificate->Describe() << "\n";
  CSLF_CHECK(certificate->Rays == cslf::CertificateSettings().Rays);
  CSLF_CHECK(certificate->Seed == 0 && !certificate->Version.empty());
  CSLF_CHECK(certificate->GetPSNR() > 35.0 && std::abs(certificate->Mean) < 0.003);
  CSLF_CHECK(certificate->Seen > 0.1 && certificate->Seen < 0.9);

  // The file does not depend on threads.
  const std::string single = folder + "/single.mp4";
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 }, [&]() { Write(MakeSampler(scene), single); });
  CSLF_CHECK(cslf::testing::ReadBytes(single) == cslf::testing::ReadBytes(fileName));

  // The same rays have the same result, others one that chance explains.
  const auto certifier = MakeCertifier(scene, decoder->GetOutput(), decoder->GetGeometry());
  const cslf::Certificate again = Measure(certifier);
  CSLF_CHECK(again.ToJSON() == certificate->ToJSON());
  CSLF_CHECK(certifier->GetPSNR() == again.GetPSNR() && certifier->GetRMS() == again.GetRMS());
  CSLF_CHECK(certifier->GetMeanSquare() == again.Square);
  CSLF_CHECK(certifier->GetMeanDifference() == again.Mean);
  CSLF_CHECK(certifier->GetSeenShare() == again.Seen);
  certifier->SetSeed(7);
  certifier->SetRaySamples(100);
  const cslf::Certificate other = Measure(certifier);
  CSLF_CHECK(other.Samples == 128 && other.Mean != again.Mean);
  CSLF_CHECK(certificate->FindWorse(other).empty() && other.FindWorse(*certificate).empty());

  // Damaged colours.
  vtkNew<vtkImageData> field;
  field->DeepCopy(decoder->GetOutput());
  vtkNew<vtkPolyData> geometry;
  geometry->DeepCopy(decoder->GetGeometry());
  ScaleColors(field->GetPointData()->GetArray("Color"), 0.9);
  ScaleColors(geometry->GetPointData()->GetArray("Color"), 0.9);
  const cslf::Certificate damaged = Measure(MakeCertifier(scene, field, geometry));
  CSLF_CHECK(damaged.Mean < -0.01);
  CSLF_CHECK(certificate->FindWorse(damaged).find("dB") != std::string::npos);

  // Another scene.
  SceneOptions larger;
  larger.Radius = 0.45;
  const auto stranger = MakeCertifier(larger, decoder->GetOutput(), decoder->GetGeometry());
  const cslf::testing::Observed observed(stranger);
  CSLF_CHECK(stranger->Measure() == 0 && stranger->GetCertificate().empty());
  CSLF_CHECK(stranger->GetPSNR() == 0.0);
  CSLF_CHECK(observed.GetErrors() > 0);
}

/// Metal needs the viewpoints. Some of them suffice for rays that enter between these.
void TestViewpoints(const std::string& folder)
{
  SceneOptions scene;
  scene.Metallic = 1.0;
  const std::string fileName = folder + "/metal.mp4";
  Write(MakeSampler(scene), fileName);
  const auto decoder = Open(fileName);
  const auto certificate = ReadCertificate(decoder->GetOutput());
  CSLF_CHECK(certificate.has_value());
  if (!certificate)
  {
    return;
  }
  std::cout << certificate->Describe() << "\n";
  CSLF_CHECK(certificate->GetPSNR() > 22.0 && certificate->GetPSNR() < 50.0);
  const cslf::Certificate again =
    Measure(MakeCertifier(scene, decoder->GetOutput(), decoder->GetGeometry()));
  CSLF_CHECK(again.ToJSON() == certificate->ToJSON());

  std::string error;
  const auto field = cslf::Description::ReadFrom(decoder->GetOutput(), error);
  const auto beams = cslf::MakePixelBeams(field->Box, 300, 1);
  const auto lookUp = [&](double bytes, std::size_t expected)
  {
    cslf::ShownPixels pixels(*field, decoder->GetGeometry(), beams);
    const auto bands = pixels.PlanBands(bytes);
    CSLF_CHECK(bands.size() == expected);
    for (const cslf::ViewpointBand& band : bands)
    {
      vtkNew<vtkCSLFDecoder> part;
      part->SetFileName(fileName.c_str());
      part->UpdateInformation();
      int extent[6];
      field->Grid.GetWholeExtent(extent);
      extent[4] = band.Slices.First;
      extent[5] = band.Slices.Last;
      part->UpdateExtent(extent);
      pixels.LookUp(band, part->GetOutput());
    }
    return pixels.GetColors();
  };
  const auto whole = lookUp(1e9, 1);
  const auto parts = lookUp(1e5, 12);
  int different = 0;
  for (std::size_t k = 0; k < whole.size(); ++k)
  {
    for (int component = 0; component < 3; ++component)
    {
      different += std::abs(whole[k][component] - parts[k][component]) > 0.02 ? 1 : 0;
    }
  }
  std::cout << different << " of " << 3 * whole.size() << " values differ\n";
  CSLF_CHECK(different < 30);

  // Without geometry, depth has to do.
  const cslf::Certificate depth = Measure(MakeCertifier(scene, decoder->GetOutput(), nullptr));
  CSLF_CHECK(depth.Square > 0.0 && depth.Square < 0.1);
}

/// The certificate takes its part of a target size. Fields that are not as they were sampled have
/// none.
void TestOthers(const std::string& folder)
{
  const SceneOptions scene;
  const auto sampler = MakeSampler(scene);
  constexpr double size = 40000.0;
  const std::string target = folder + "/target.mkv";
  Write(sampler, target, { true, size });
  CSLF_CHECK(ReadCertificate(Open(target)->GetOutput()).has_value());
  CSLF_CHECK(static_cast<double>(cslf::testing::ReadBytes(target).size()) <= size);

  const std::string without = folder + "/without.mp4";
  Write(sampler, without, { false });
  CSLF_CHECK(!ReadCertificate(Open(without)->GetOutput()));

  // A field that was coded again, and one that is coarser.
  const auto decoder = Open(target);
  const std::string again = folder + "/again.mp4";
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(decoder->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(again.c_str());
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(!ReadCertificate(Open(again)->GetOutput()));
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(decoder->GetOutputPort());
  resample->SetViewpointStride(2);
  resample->Update();
  CSLF_CHECK(!ReadCertificate(resample->GetOutput()));

  // A sampler's own field can be measured, too.
  const auto certifier = MakeCertifier(scene, nullptr, nullptr);
  certifier->SetInputConnection(1, sampler->GetOutputPort(0));
  certifier->SetInputConnection(2, sampler->GetOutputPort(1));
  CSLF_CHECK(Measure(certifier).GetPSNR() > 35.0);
}

void TestBad()
{
  const auto expectError = [](vtkCSLFFieldCertifier* certifier)
  {
    const cslf::testing::Observed observed(certifier);
    CSLF_CHECK(certifier->Measure() == 0 && certifier->GetCertificate().empty());
    CSLF_CHECK(observed.GetErrors() > 0);
  };
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(4, 4, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  expectError(MakeCertifier({}, picture, nullptr));
  vtkNew<vtkCSLFFieldCertifier> empty;
  empty->SetInputData(1, picture);
  expectError(empty);
}
}

int TestCSLFFieldCertifier(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "FieldCertifier");
  TestComparison();
  TestBeams();
  TestDiffuse(folder);
  TestViewpoints(folder);
  TestOthers(folder);
  TestBad();
  return cslf::testing::Result();
}
