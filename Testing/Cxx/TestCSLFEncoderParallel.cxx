// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Several ranks write one file: it has the same bytes as with one rank, each viewpoint is sampled
// once, and only rank 0 touches files. If one rank fails, all fail, with one message.
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRadianceCacheOptions.h"
#include "vtkCSLFRateControl.h"
#include "vtkCSLFSampler.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkCommunicator.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkSTLReader.h>
#include <vtkSphereSource.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>
#include <functional>
#include <utility>

namespace
{
using cslf::testing::FieldSource;
using cslf::testing::ReadBytes;

/// Common data of all tests.
struct Setting
{
  vtkMultiProcessController* Controller;
  vtkSmartPointer<vtkImageData> Field;
  std::string Folder = {};

  int GetRank() const { return this->Controller->GetLocalProcessId(); }

  /// Only rank 0's is touched.
  std::string GetFileName() const
  {
    return (this->GetRank() == 0 ? this->Folder : "/no/such/folder") + "/field.mp4";
  }

  /// Removes what a failed run has kept, before any rank continues.
  void Clear() const
  {
    if (this->GetRank() == 0)
    {
      std::filesystem::remove_all(this->GetFileName() + ".partial");
    }
    this->Controller->Barrier();
  }

  int Sum(int mine) const
  {
    int all = 0;
    this->Controller->AllReduce(&mine, &all, 1, vtkCommunicator::SUM_OP);
    return all;
  }
};

void Set(const Setting& setting, vtkCSLFEncoder* encoder)
{
  encoder->SetController(setting.Controller);
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(setting.GetFileName().c_str());
}

/// The same if a sample of groups is tried first, and if key views are chosen.
void TestTarget(const Setting& setting)
{
  const auto change = [](vtkCSLFEncoder* encoder)
  {
    encoder->SetGroupLength(1);
    encoder->GetRateControl()->SetTargetPSNR(30.0);
    encoder->GetRateControl()->SetKeyViewStepToAutomatic();
    encoder->GetRateControl()->SetTargetNovelViewPSNR(12.0);
  };
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(setting.Field);
  Set(setting, encoder);
  change(encoder);
  CSLF_CHECK(encoder->Write() == 1);
  if (setting.GetRank() == 0)
  {
    CSLF_CHECK(encoder->GetActualKeyViewStep() > 1);
    const std::vector<char> bytes = ReadBytes(setting.GetFileName());
    encoder->SetController(nullptr);
    CSLF_CHECK(encoder->Write() == 1);
    CSLF_CHECK(!bytes.empty() && ReadBytes(setting.GetFileName()) == bytes);
    std::filesystem::remove(setting.GetFileName());
  }
}

void TestBytes(const Setting& setting)
{
  const auto source = cslf::testing::MakeSource(setting.Field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  Set(setting, encoder);
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(encoder->GetErrorCode() == vtkErrorCode::NoError);
  // Every rank pulls the first viewpoint to learn the field; all are pulled once.
  const int slices = setting.Field->GetExtent()[5] + 1;
  const int all = setting.Sum(source->Slices);
  CSLF_CHECK(all >= slices && all <= slices + setting.Controller->GetNumberOfProcesses());
  CSLF_CHECK(source->Slices < slices);
  if (setting.GetRank() == 0)
  {
    const std::vector<char> bytes = ReadBytes(setting.GetFileName());
    CSLF_CHECK(!cslf::testing::Exists(setting.GetFileName() + ".partial"));
    encoder->SetController(nullptr);
    CSLF_CHECK(encoder->Write() == 1);
    CSLF_CHECK(!bytes.empty() && ReadBytes(setting.GetFileName()) == bytes);
    std::filesystem::remove(setting.GetFileName());
  }
}

/// The same if rank 0 has a geometry, which tells depth: only its own is used.
void TestGeometry(const Setting& setting)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(cslf::testing::MakeTestField(
    cslf::Layout(3, 32), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT));
  if (setting.GetRank() == 0)
  {
    encoder->SetGeometryData(cslf::testing::MakeTestSurfaces(cslf::Cube()));
  }
  Set(setting, encoder);
  encoder->SetGroupLength(2);
  CSLF_CHECK(encoder->Write() == 1);
  if (setting.GetRank() == 0)
  {
    CSLF_CHECK(encoder->GetActualDepthFromGeometry());
    const std::vector<char> bytes = ReadBytes(setting.GetFileName());
    encoder->SetController(nullptr);
    CSLF_CHECK(encoder->Write() == 1);
    CSLF_CHECK(!bytes.empty() && ReadBytes(setting.GetFileName()) == bytes);
    std::filesystem::remove(setting.GetFileName());
  }
}

/// One rank fails in some way. All must fail, and only the rank `telling` may give the reason.
void TestFailure(const Setting& setting, int disturbed, int telling, const std::string& message,
  const std::function<void(FieldSource*, vtkCSLFEncoder*)>& disturb)
{
  const auto source = cslf::testing::MakeSource(setting.Field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  Set(setting, encoder);
  if (setting.GetRank() == disturbed)
  {
    disturb(source, encoder);
  }
  const cslf::testing::Observed observed(encoder);
  const cslf::testing::Observed sourceObserved(source);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(encoder->GetErrorCode() != vtkErrorCode::NoError);
  CSLF_CHECK(setting.Sum(observed.GetErrors()) == 1);
  if (setting.GetRank() == telling)
  {
    CSLF_CHECK(observed.HasError(message));
  }
  CSLF_CHECK(!cslf::testing::Exists(setting.GetFileName()));
  setting.Clear();
}

/// Rank 0 detects for all that a target cannot be met.
void TestOutOfReach(const Setting& setting)
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(setting.Field);
  Set(setting, encoder);
  encoder->GetRateControl()->SetTargetPSNR(99.0);
  for (const char* message : { "a PSNR of 99 dB cannot be met", "no key views reach" })
  {
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(setting.Sum(observed.GetErrors()) == 1);
    CSLF_CHECK(setting.GetRank() != 0 || observed.HasError(message));
    CSLF_CHECK(!cslf::testing::Exists(setting.GetFileName() + ".partial"));
    encoder->GetRateControl()->SetKeyViewStepToAutomatic();
    encoder->GetRateControl()->SetTargetNovelViewPSNR(99.0);
  }
}

/// The next run continues from what a failed one has kept.
void TestResume(const Setting& setting)
{
  CSLF_CHECK(setting.GetRank() != 0 || cslf::testing::Exists(setting.GetFileName() + ".partial"));
  const auto source = cslf::testing::MakeSource(setting.Field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  Set(setting, encoder);
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(setting.Sum(source->Slices) < setting.Field->GetExtent()[5]);
  if (setting.GetRank() == 0)
  {
    const std::vector<char> bytes = ReadBytes(setting.GetFileName());
    encoder->SetController(nullptr);
    CSLF_CHECK(encoder->Write() == 1);
    CSLF_CHECK(ReadBytes(setting.GetFileName()) == bytes);
    std::filesystem::remove(setting.GetFileName());
  }
}

void TestFailures(const Setting& setting)
{
  const int last = setting.Controller->GetNumberOfProcesses() - 1;
  for (int rank = 0; rank <= last; ++rank)
  {
    TestFailure(setting, rank, rank, "The input failed",
      [](FieldSource* source, vtkCSLFEncoder*) { source->FailingSlice = 0; });
    TestFailure(setting, rank, rank, "There is no input",
      [](FieldSource*, vtkCSLFEncoder* encoder) { encoder->RemoveAllInputs(); });
    TestFailure(setting, rank, rank, "is none of ultrafast",
      [](FieldSource*, vtkCSLFEncoder* encoder) { encoder->SetPreset("quick"); });
    TestFailure(setting, rank, 0, "different fields, settings, versions or kinds",
      [](FieldSource*, vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetCRF(30.0); });
  }
  // In the middle of the work, on any rank: the same slice fails in the sources of all ranks. The
  // last slice is one of the last to be coded.
  for (int slice : { 60, 148 })
  {
    const auto source = cslf::testing::MakeSource(setting.Field);
    source->FailingSlice = slice;
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputConnection(source->GetOutputPort());
    Set(setting, encoder);
    const cslf::testing::Observed observed(encoder);
    const cslf::testing::Observed sourceObserved(source);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(setting.Sum(observed.GetErrors()) == 1);
    CSLF_CHECK(setting.Sum(sourceObserved.GetErrors()) == 1);
    if (slice == 148)
    {
      // Whichever rank it is, it reports what rank 0 keeps.
      CSLF_CHECK(setting.Sum(observed.HasError("groups of viewpoints are kept in") ? 1 : 0) == 1);
      TestResume(setting);
    }
    setting.Clear();
  }
}

/// A scene in pieces. One rank cannot read its piece: before or while the data is made.
void TestMissingPiece(const Setting& setting)
{
  vtkNew<vtkXMLPolyDataReader> early;
  early->SetFileName("/no/such/piece.vtp");
  vtkNew<vtkSTLReader> late;
  late->SetFileName("/no/such/piece.stl");
  vtkNew<vtkSphereSource> sphere;
  const cslf::testing::Observed earlyObserved(early);
  const cslf::testing::Observed lateObserved(late);
  const int last = setting.Controller->GetNumberOfProcesses() - 1;
  for (const auto& [failing, reader] : { std::pair<int, vtkAlgorithm*>(0, early),
         std::pair<int, vtkAlgorithm*>(last, early), std::pair<int, vtkAlgorithm*>(0, late) })
  {
    vtkNew<vtkCSLFSampler> sampler;
    sampler->SetController(setting.Controller);
    sampler->DistributedSceneOn();
    sampler->SetViewpoints(2);
    sampler->SetResolution(16);
    const bool fails = setting.GetRank() == failing;
    sampler->SetInputConnection(fails ? reader->GetOutputPort() : sphere->GetOutputPort());
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputConnection(sampler->GetOutputPort());
    Set(setting, encoder);
    const cslf::testing::Observed observed(encoder);
    const cslf::testing::Observed samplerObserved(sampler);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(encoder->GetErrorCode() != vtkErrorCode::NoError);
    CSLF_CHECK(setting.Sum(observed.GetErrors()) == 1);
    CSLF_CHECK(!cslf::testing::Exists(setting.GetFileName() + ".partial"));
  }
}

/// Samplers that differ on the last rank in a parameter of the radiance cache's check.
void TestDifferentSamplers(const Setting& setting)
{
  vtkNew<vtkSphereSource> sphere;
  const bool isLast = setting.GetRank() == setting.Controller->GetNumberOfProcesses() - 1;
  for (const bool checksDiffer : { false, true })
  {
    vtkNew<vtkCSLFSampler> sampler;
    sampler->SetViewpoints(isLast && !checksDiffer ? 3 : 2);
    sampler->GetCacheOptions()->SetCheck(!isLast || !checksDiffer);
    sampler->SetResolution(16);
    sampler->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputConnection(sampler->GetOutputPort());
    Set(setting, encoder);
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(setting.Sum(observed.GetErrors()) == 1);
    CSLF_CHECK(setting.GetRank() != 0 || observed.HasError("the ranks have different fields"));
    setting.Clear();
  }
}

void TestAbort(const Setting& setting)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      algorithm->SetAbortExecute(algorithm->GetProgress() > 0.1 ? 1 : 0);
    });
  TestFailure(setting, 0, 0, "stopped",
    [&abort](FieldSource*, vtkCSLFEncoder* encoder)
    { encoder->AddObserver(vtkCommand::ProgressEvent, abort); });
}
}

int TestCSLFEncoderParallel(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv, 0);
  Setting setting{ controller, cslf::testing::MakeByteField(5, 16) };
  if (setting.GetRank() == 0)
  {
    setting.Folder = cslf::testing::MakeFolder(argc, argv, "EncoderParallel");
  }
  CSLF_CHECK(controller->GetNumberOfProcesses() > 1);
  TestBytes(setting);
  TestTarget(setting);
  TestGeometry(setting);
  TestOutOfReach(setting);
  TestFailures(setting);
  TestMissingPiece(setting);
  TestDifferentSamplers(setting);
  TestAbort(setting);
  TestBytes(setting);
  const bool good = setting.Sum(cslf::testing::Failures()) == 0;
  controller->Finalize();
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
