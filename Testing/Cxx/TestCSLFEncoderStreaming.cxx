// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The encoder requests bounded slabs, writes the same bytes for any number of threads, names its
// phases, and leaves nothing behind when it is stopped.
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfProgressWatch.h"
#include "cslfTesting.h"
#include "vtkCSLFCornellBoxSource.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSampler.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace
{
using cslf::testing::MakeSource;

void TestThreads(vtkImageData* field, const std::string& folder)
{
  for (int threads : { 1, 2 })
  {
    const auto source = MakeSource(field);
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputConnection(source->GetOutputPort());
    encoder->SetPreset("ultrafast");
    const std::string fileName = folder + "/threads" + std::to_string(threads) + ".mkv";
    encoder->SetFileName(fileName.c_str());
    int written = 0;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads }, [&]() { written = encoder->Write(); });
    CSLF_CHECK(written == 1);
    CSLF_CHECK(source->MaximumRequest <= 32 * threads);
    CSLF_CHECK(source->Slices <= field->GetExtent()[5] + 2);
  }
  const auto one = cslf::testing::ReadBytes(folder + "/threads1.mkv");
  CSLF_CHECK(!one.empty() && one == cslf::testing::ReadBytes(folder + "/threads2.mkv"));
}

void TestAbort(vtkImageData* field, const std::string& folder)
{
  const std::string fileName = folder + "/aborted.mp4";
  cslf::testing::WriteBytes(fileName, { 'o', 'l', 'd' });
  const auto source = MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      algorithm->SetAbortExecute(algorithm->GetProgress() > 0.8 ? 1 : 0);
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, abort);
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.HasError("stopped"));
  CSLF_CHECK(observed.HasError("groups of viewpoints are kept in " + fileName + ".partial"));
  CSLF_CHECK(cslf::testing::Exists(fileName + ".partial/group-0-color.part"));
  CSLF_CHECK(cslf::testing::ReadBytes(fileName).size() == 3);
}

vtkSmartPointer<vtkCSLFSampler> MakeSampler()
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  auto sampler = vtkSmartPointer<vtkCSLFSampler>::New();
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(3);
  sampler->SetResolution(16);
  sampler->SetSamples(1);
  sampler->GenerateDepthOn();
  sampler->SetIntegratorToPathTracing();
  return sampler;
}

vtkSmartPointer<vtkCSLFEncoder> MakeEncoder(vtkCSLFSampler* sampler, const std::string& fileName)
{
  auto encoder = vtkSmartPointer<vtkCSLFEncoder>::New();
  encoder->SetInputConnection(0, sampler->GetOutputPort(0));
  encoder->SetInputConnection(1, sampler->GetOutputPort(1));
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  return encoder;
}

// The phases of the input are those of writing, too. Each can be aborted through the encoder, and
// the next time writes the file.
void TestPhases(const std::string& folder)
{
  const std::vector<std::string> phases = { "Reading the scene", "Building the tree of the scene",
    "Sampling viewpoints", "Making the geometry", "Colouring the geometry",
    "Comparing depth with the geometry", "Coding viewpoints", "Writing the file",
    "Comparing the file with the scene" };
  const std::string whole = folder + "/whole.mkv";
  {
    const auto sampler = MakeSampler();
    const auto encoder = MakeEncoder(sampler, whole);
    const cslf::testing::ProgressWatch watch(encoder);
    CSLF_CHECK(encoder->Write() == 1);
    watch.CheckWhole(phases);
  }
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    const std::string fileName = folder + "/phase" + std::to_string(k) + ".mkv";
    const auto sampler = MakeSampler();
    const auto encoder = MakeEncoder(sampler, fileName);
    {
      const cslf::testing::ProgressWatch watch(encoder, phases[k]);
      const cslf::testing::Observed observed(encoder);
      CSLF_CHECK(encoder->Write() == 0);
      CSLF_CHECK(observed.GetErrors() == 1 && observed.HasError("it was stopped"));
      watch.CheckAborted();
    }
    CSLF_CHECK(!cslf::testing::Exists(fileName));
    CSLF_CHECK(encoder->Write() == 1);
    CSLF_CHECK(cslf::testing::ReadBytes(fileName) == cslf::testing::ReadBytes(whole));
  }
}

void TestFailingInput(vtkImageData* field, const std::string& folder, int slice)
{
  const std::string fileName = folder + "/failing.mkv";
  const auto source = MakeSource(field);
  source->FailingSlice = slice;
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  const cslf::testing::Observed observed(encoder);
  const cslf::testing::Observed sourceObserved(source);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.GetErrors() == 1);
  CSLF_CHECK(sourceObserved.GetErrors() == 1);
  CSLF_CHECK(!cslf::testing::Exists(fileName));
  const bool isKept = cslf::testing::Exists(fileName + ".partial");
  CSLF_CHECK(isKept == (slice > 0));
  const auto whole = MakeSource(field);
  vtkNew<vtkCSLFEncoder> next;
  next->SetInputConnection(whole->GetOutputPort());
  next->SetPreset("ultrafast");
  next->SetFileName(fileName.c_str());
  CSLF_CHECK(next->Write() == 1);
  CSLF_CHECK((whole->Slices < field->GetExtent()[5]) == isKept);
  const auto expected = cslf::testing::ReadBytes(folder + "/threads1.mkv");
  CSLF_CHECK(cslf::testing::ReadBytes(fileName) == expected);
  std::filesystem::remove(fileName);
}
}

int TestCSLFEncoderStreaming(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderStreaming");
  const auto field = cslf::testing::MakeByteField(6, 16);
  TestThreads(field, folder);
  TestAbort(field, folder);
  TestFailingInput(field, folder, 0);
  TestFailingInput(field, folder, 200);
  TestPhases(folder);
  return cslf::testing::Result();
}
