// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Estimates of a bake: the bytes of each format are within a factor of 1.5, and the sampler's
// parameters do not change. The chosen samples fit a time, or are those chosen before. Times are
// not compared.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFBakeEstimator.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFImageWriter.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFSampler.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTestErrorObserver.h>
#include <vtkXMLImageDataWriter.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>

namespace
{
namespace fs = std::filesystem;

constexpr double Factor = 1.5;

void SetUp(vtkCSLFSampler* sampler)
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(4);
  sampler->SetResolution(32);
  sampler->SetSamples(4);
  sampler->SetMaximumDepth(3);
  sampler->GetCacheOptions()->SetSamples(64);
  sampler->GetCacheOptions()->SetTolerance(0.05);
  sampler->GetCacheOptions()->SetSpacing(0.02);
}

double CountBytes(const std::string& name)
{
  if (!fs::is_directory(name))
  {
    return static_cast<double>(fs::file_size(name));
  }
  double sum = 0.0;
  for (const auto& entry : fs::directory_iterator(name))
  {
    sum += static_cast<double>(entry.file_size());
  }
  return sum;
}

void CheckBytes(double estimated, const std::string& name)
{
  const double bytes = CountBytes(name);
  std::cout << name << ": " << bytes << " bytes, estimated " << estimated << "\n";
  CSLF_CHECK(estimated < Factor * bytes && bytes < Factor * estimated);
}

void TestVideo(const std::string& folder, bool isLossless, bool isPath, bool hasGeometry = false)
{
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  if (isPath)
  {
    sampler->SetIntegratorToPathTracing();
  }
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  encoder->SetLossless(isLossless);
  encoder->SetGroupLength(8);
  encoder->SetInputConnection(1, hasGeometry ? sampler->GetOutputPort(1) : nullptr);
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  estimator->SetProbeSeconds(2.0);
  CSLF_CHECK(estimator->Estimate() == 1);
  CSLF_CHECK(estimator->GetSeconds() > 0.0);
  CSLF_CHECK((estimator->GetCacheSeconds() > 0.0) == !isPath);
  CSLF_CHECK(sampler->GetResolution() == 32 && sampler->GetSamples() == 4);
  CSLF_CHECK(
    sampler->GetCacheOptions()->GetSpacing() == 0.02 && sampler->GetCacheProbeSeconds() == 0.0);
  encoder->SetInputConnection(sampler->GetOutputPort());
  const std::string name = folder + "/field.mkv";
  encoder->SetFileName(name.c_str());
  CSLF_CHECK(encoder->Write() == 1);
  CheckBytes(estimator->GetBytes(), name);

  // The bake equals that of a sampler without a probe.
  vtkNew<vtkCSLFSampler> fresh;
  SetUp(fresh);
  fresh->SetIntegrator(sampler->GetIntegrator());
  encoder->SetInputConnection(fresh->GetOutputPort());
  encoder->SetInputConnection(1, hasGeometry ? fresh->GetOutputPort(1) : nullptr);
  const std::string other = folder + "/other.mkv";
  encoder->SetFileName(other.c_str());
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(cslf::testing::ReadBytes(name) == cslf::testing::ReadBytes(other));

  // An existing cache is not made again.
  estimator->SetSampler(fresh);
  CSLF_CHECK(estimator->Estimate() == 1);
  CSLF_CHECK(estimator->GetCacheSeconds() == 0.0);
  CheckBytes(estimator->GetBytes(), name);
}

/// No viewpoint will be rendered of a field that its geometry tells.
void TestTold(const std::string& folder)
{
  vtkNew<vtkCSLFSampler> sampler;
  vtkNew<vtkCSLFCornellBoxSource> box;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(9);
  sampler->SetResolution(64);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  encoder->SetInputConnection(0, sampler->GetOutputPort(0));
  encoder->SetInputConnection(1, sampler->GetOutputPort(1));
  const std::string name = folder + "/told.mp4";
  encoder->SetFileName(name.c_str());
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  // Enough for the whole cache, in passes of which some are probed only.
  estimator->SetProbeSeconds(60.0);
  CSLF_CHECK(estimator->Estimate() == 1);
  CSLF_CHECK(estimator->GetRenderSeconds() == 0.0 && estimator->GetCacheSeconds() > 0.0);
  CSLF_CHECK(encoder->Write() == 1);
  CheckBytes(estimator->GetBytes(), name);
}

/// An encoder that accepts no small pictures: the estimate is still for its files.
void TestLeastResolution(const std::string& folder)
{
  if (!vtkCSLFEncoder::CanEncode("av1"))
  {
    std::cout << "This FFmpeg cannot encode av1: skipped.\n";
    return;
  }
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  sampler->SetIntegratorToPathTracing();
  sampler->SetViewpoints(2);
  sampler->SetResolution(128);
  sampler->SetSamples(1);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  encoder->SetCodec("av1");
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  estimator->SetProbeSeconds(2.0);
  CSLF_CHECK(estimator->Estimate() == 1);
  encoder->SetInputConnection(sampler->GetOutputPort());
  const std::string name = folder + "/av1.mkv";
  encoder->SetFileName(name.c_str());
  CSLF_CHECK(encoder->Write() == 1);
  CheckBytes(estimator->GetBytes(), name);
}

void TestImages(const std::string& folder)
{
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  sampler->SetIntegratorToPathTracing();
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetFormat(vtkCSLFBakeEstimator::ImageData);
  CSLF_CHECK(estimator->Estimate() == 1);
  const std::string file = folder + "/field.vti";
  vtkNew<vtkXMLImageDataWriter> imageData;
  imageData->SetInputConnection(sampler->GetOutputPort());
  imageData->SetFileName(file.c_str());
  imageData->EncodeAppendedDataOff();
  imageData->SetCompressorTypeToLZ4();
  CSLF_CHECK(imageData->Write() == 1);
  CheckBytes(estimator->GetBytes(), file);

  estimator->SetFormat(vtkCSLFBakeEstimator::ImageFolder);
  CSLF_CHECK(estimator->Estimate() == 1);
  const std::string images = folder + "/field";
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputConnection(sampler->GetOutputPort());
  writer->SetFileName(images.c_str());
  CSLF_CHECK(writer->Write() == 1);
  CheckBytes(estimator->GetBytes(), images);
}

void TestTimeBudget()
{
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  sampler->SetIntegratorToPathTracing();
  sampler->SetCacheProbeSeconds(0.5);
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  CSLF_CHECK(estimator->ChooseSamples(1e4) == 1);
  CSLF_CHECK(sampler->GetSamples() > 16);
  CSLF_CHECK(sampler->GetCacheProbeSeconds() == 0.5);
  CSLF_CHECK(estimator->GetSecondsTaken() > 0.0);

  // If there is nothing to suggest, earlier suggestions are removed.
  CSLF_CHECK(estimator->SuggestForBytes(1e12) == 1 && estimator->GetSuggestedViewpoints() > 0);
  CSLF_CHECK(estimator->SuggestForBytes(1.0) == 0);
  CSLF_CHECK(estimator->GetSuggestedViewpoints() == 0 && estimator->GetSuggestedResolution() == 0);
  CSLF_CHECK(estimator->PredictPSNR(9, 32) > 0.0 && estimator->PredictBytes(9, 32) > 0.0);
  CSLF_CHECK(estimator->PredictPSNR(1, 32) == 0.0 && estimator->PredictPSNR(9, 0) == 0.0);
  CSLF_CHECK(estimator->PredictBytes(1, 32) == 0.0 && estimator->PredictBytes(9, 0) == 0.0);
  vtkNew<vtkTest::ErrorObserver> observer;
  estimator->AddObserver(vtkCommand::ErrorEvent, observer);
  CSLF_CHECK(estimator->ChooseSamples(1e-6) == 0);
  CSLF_CHECK(observer->CheckErrorMessage("a single sample") == 0);
}

/// Cells with ids of points that do not exist are left out.
void TestBrokenInput()
{
  vtkNew<vtkPolyData> broken;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 2 });
  polygons->InsertNextCell({ 0, 1, 1000000 });
  broken->SetPoints(points);
  broken->SetPolys(polygons);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  sampler->SetInputData(broken);
  vtkNew<vtkTest::ErrorObserver> observer;
  sampler->AddObserver(vtkCommand::WarningEvent, observer);
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetProbeSeconds(0.1);
  CSLF_CHECK(estimator->Estimate() == 1);
  CSLF_CHECK(observer->GetWarningMessage().find("ids of missing points") != std::string::npos);
}

/// Copies a run's folder of parts, as a kill would leave it.
struct Remains
{
  std::string From;
  std::string To;
};

void Take(vtkObject*, unsigned long, void* data, void*)
{
  const auto* remains = static_cast<Remains*>(data);
  std::error_code ignored;
  fs::copy(remains->From, remains->To,
    fs::copy_options::recursive | fs::copy_options::overwrite_existing, ignored);
}

void TestRecall(const std::string& folder)
{
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler);
  sampler->SetIntegratorToPathTracing();
  sampler->SetSamples(3);
  const std::string name = folder + "/run.mp4";
  const std::string killed = folder + "/killed.mp4";
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(name.c_str());
  encoder->SetInputConnection(sampler->GetOutputPort());
  Remains remains{ name + ".partial", killed + ".partial" };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&remains);
  command->SetCallback(Take);
  encoder->AddObserver(vtkCommand::ProgressEvent, command);
  CSLF_CHECK(encoder->Write() == 1);

  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  sampler->SetSamples(64);
  CSLF_CHECK(estimator->RecallSamples(name.c_str()) == 0);
  CSLF_CHECK(estimator->RecallSamples(killed.c_str()) == 1);
  CSLF_CHECK(sampler->GetSamples() == 3);
  // Neither of another field nor with other settings.
  sampler->SetSamples(64);
  sampler->SetSeed(7);
  CSLF_CHECK(estimator->RecallSamples(killed.c_str()) == 0);
  CSLF_CHECK(sampler->GetSamples() == 64);
  sampler->SetSeed(0);
  encoder->GetRateControl()->SetCRF(30.0);
  CSLF_CHECK(estimator->RecallSamples(killed.c_str()) == 0);
}
}

int TestCSLFBakeEstimator(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "BakeEstimator");
  TestVideo(folder, false, false);
  TestVideo(folder, false, false, true);
  TestVideo(folder, true, true);
  TestTold(folder);
  TestLeastResolution(folder);
  TestImages(folder);
  TestTimeBudget();
  TestBrokenInput();
  TestRecall(folder);
  return cslf::testing::Result();
}
