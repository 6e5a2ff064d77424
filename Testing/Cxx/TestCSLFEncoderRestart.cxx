// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The encoder resumes after a killed run, and ends with the same bytes. The folder of parts in the
// middle of a run is what a kill at that moment leaves.
#include "cslfCodecTesting.h"
#include "cslfFieldSource.h"
#include "cslfJSON.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>

#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

namespace fs = std::filesystem;

namespace
{
using cslf::testing::ReadBytes;
using Change = std::function<void(vtkCSLFEncoder*)>;

/// How far a run gets before it is killed.
constexpr double Killed = 0.5;

struct Outcome
{
  bool Written = false;
  int Slices = 0; ///< pulled
  int Warnings = 0;
  double FirstProgress = 0.0;
};

void Set(vtkCSLFEncoder* encoder, const std::string& fileName, const Change& change)
{
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  change(encoder);
}

Outcome Write(
  vtkImageData* field, const std::string& fileName, const Change& change = [](vtkCSLFEncoder*) {})
{
  const auto source = cslf::testing::MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  Set(encoder, fileName, change);
  Outcome outcome;
  vtkNew<vtkCallbackCommand> watch;
  watch->SetClientData(&outcome);
  watch->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* progress)
    {
      // The executive begins with 0.
      double& first = static_cast<Outcome*>(data)->FirstProgress;
      first = first > 0.0 ? first : *static_cast<double*>(progress);
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, watch);
  const cslf::testing::Observed observed(encoder);
  outcome.Written = encoder->Write() == 1;
  outcome.Slices = source->Slices;
  outcome.Warnings = observed.GetWarnings();
  CSLF_CHECK(observed.GetErrors() == 0);
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
  return outcome;
}

/// Copies what a run leaves when it is killed half-way, under another name.
struct Remains
{
  std::string Folder;
  std::string Kept;
  bool Taken = false;
  std::ptrdiff_t Files = 0;
};

Remains Interrupt(
  vtkImageData* field, const std::string& fileName, const Change& change = [](vtkCSLFEncoder*) {})
{
  Remains remains{ fileName + ".partial", fileName + ".kept" };
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  Set(encoder, fileName, change);
  vtkNew<vtkCallbackCommand> copy;
  copy->SetClientData(&remains);
  copy->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* progress)
    {
      // Progress includes groups that are being coded, so those must be stored.
      auto* all = static_cast<Remains*>(data);
      std::error_code ignored;
      const auto files =
        std::distance(fs::directory_iterator(all->Folder, ignored), fs::directory_iterator());
      const bool isStored = files > std::exchange(all->Files, files);
      if (!all->Taken && isStored && *static_cast<double*>(progress) > Killed)
      {
        fs::copy(all->Folder, all->Kept);
        all->Taken = true;
      }
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, copy);
  // Small steps, so that half-way some groups are done and some are not.
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ 1 }, [&]() { CSLF_CHECK(encoder->Write() == 1 && remains.Taken); });
  return remains;
}

void PutBack(const Remains& remains)
{
  fs::remove_all(remains.Folder);
  fs::copy(remains.Kept, remains.Folder);
}

void TestRestart(vtkImageData* field, const Remains& remains, const std::string& fileName,
  const std::vector<char>& expected)
{
  PutBack(remains);
  fs::create_directory(remains.Folder + "/unfinished-abcdef");
  cslf::testing::WriteBytes(remains.Folder + "/unfinished-abcdef/group-0-color.part", { 'x' });
  cslf::testing::WriteBytes(remains.Folder + "/unfinished-abcdef/field.mp4", { 'x' });
  const int slices = field->GetExtent()[5] + 1;
  const Outcome outcome = Write(field, fileName);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 0);
  CSLF_CHECK(ReadBytes(fileName) == expected);
  // The first slice, and those of the groups that are missing.
  CSLF_CHECK(outcome.Slices > 1 && outcome.Slices <= (1.0 - Killed) * slices + 1);
  CSLF_CHECK(outcome.FirstProgress > 0.9 * Killed);

  PutBack(remains);
  const Outcome anew =
    Write(field, fileName, [](vtkCSLFEncoder* encoder) { encoder->RestartOff(); });
  CSLF_CHECK(anew.Written && anew.Warnings == 0 && anew.Slices >= slices);
  CSLF_CHECK(ReadBytes(fileName) == expected);
}

void TestDamage(vtkImageData* field, const Remains& remains, const std::string& fileName,
  const std::vector<char>& expected)
{
  PutBack(remains);
  const int whole = Write(field, fileName).Slices;
  for (const char* name : { "/group-0-color.part", "/group-1-depth.part" })
  {
    PutBack(remains);
    std::vector<char> bytes = ReadBytes(remains.Folder + name);
    CSLF_CHECK(bytes.size() > 100);
    bytes[bytes.size() / 2] ^= 1;
    cslf::testing::WriteBytes(remains.Folder + name, bytes);
    const Outcome outcome = Write(field, fileName);
    CSLF_CHECK(outcome.Written && outcome.Warnings == 1 && outcome.Slices > whole);
    CSLF_CHECK(ReadBytes(fileName) == expected);
  }
  // Each part identifies its manifest.
  PutBack(remains);
  cslf::testing::WriteBytes(remains.Folder + "/manifest.json", { '{' });
  const Outcome outcome = Write(field, fileName);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 0 && outcome.Slices == whole);
  CSLF_CHECK(ReadBytes(fileName) == expected);
}

/// Parts of another manifest are useless, whatever manifest is beside them.
void TestManifest(vtkImageData* field, const Remains& remains, const std::string& fileName,
  const std::vector<char>& expected)
{
  const auto manifest = nlohmann::json::parse(ReadBytes(remains.Kept + "/manifest.json"));
  for (const char* name : { "cslf", "ffmpeg", "description", "measured" })
  {
    CSLF_CHECK(manifest.contains(name));
  }
  const Remains other = Interrupt(field, remains.Folder + "-other.mp4",
    [](vtkCSLFEncoder* encoder) { encoder->GetRateControl()->SetCRF(40.0); });
  PutBack(remains);
  for (const char* name : { "/group-0-color.part", "/group-1-depth.part" })
  {
    fs::copy_file(other.Kept + name, remains.Folder + name, fs::copy_options::overwrite_existing);
  }
  const Outcome outcome = Write(field, fileName);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 1);
  CSLF_CHECK(ReadBytes(fileName) == expected);
}

/// Other files beside the parts stay, and so does the folder.
void TestForeign(vtkImageData* field, const Remains& remains, const std::string& fileName,
  const std::vector<char>& expected)
{
  const std::vector<char> thesis = { 't' };
  const auto write = [&](const std::string& reason)
  {
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputData(field);
    Set(encoder, fileName, [](vtkCSLFEncoder*) {});
    const cslf::testing::Observed observed(encoder);
    const bool written = encoder->Write() == 1;
    CSLF_CHECK(written ? observed.HasWarning(reason) : observed.HasError(reason));
    return written;
  };
  PutBack(remains);
  for (const char* name : { "/thesis", "/whole.mp4", "/group-thesis.part", "/a.unfinished" })
  {
    cslf::testing::WriteBytes(remains.Folder + name, thesis);
  }
  CSLF_CHECK(write("contains other files"));
  CSLF_CHECK(ReadBytes(fileName) == expected);
  for (const char* name : { "/thesis", "/whole.mp4", "/group-thesis.part", "/a.unfinished" })
  {
    CSLF_CHECK(ReadBytes(remains.Folder + name) == thesis);
  }
  // Again, when the folder is no longer recognised as ours.
  CSLF_CHECK(write("contains other files"));
  CSLF_CHECK(ReadBytes(remains.Folder + "/thesis") == thesis);
  CSLF_CHECK(std::distance(fs::directory_iterator(remains.Folder), {}) == 4);
  for (const char* name : { "/manifest.json", "/cslf.lock", "/radiance.cache" })
  {
    fs::remove_all(remains.Folder);
    fs::create_directory(remains.Folder);
    cslf::testing::WriteBytes(remains.Folder + name, thesis);
    CSLF_CHECK(!write("elsewhere"));
    CSLF_CHECK(ReadBytes(remains.Folder + name) == thesis);
    CSLF_CHECK(std::distance(fs::directory_iterator(remains.Folder), {}) == 1);
  }
  fs::remove_all(remains.Folder);
}

void TestChange(vtkImageData* field, const Remains& remains, const std::string& fileName)
{
  const int slices = field->GetExtent()[5] + 1;
  const Change change = [](vtkCSLFEncoder* encoder)
  { encoder->GetRateControl()->SetDepthCRF(20.0); };
  PutBack(remains);
  Outcome outcome = Write(field, fileName, change);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 1 && outcome.Slices >= slices);
  const std::vector<char> bytes = ReadBytes(fileName);
  CSLF_CHECK(Write(field, fileName, change).Warnings == 0);
  CSLF_CHECK(ReadBytes(fileName) == bytes);

  // Another field of the same description.
  vtkNew<vtkImageData> other;
  other->DeepCopy(field);
  auto* colors =
    vtkUnsignedCharArray::SafeDownCast(other->GetPointData()->GetArray(cslf::ColorName));
  colors->SetValue(0, colors->GetValue(0) ^ 1);
  PutBack(remains);
  outcome = Write(other, fileName);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 1 && outcome.Slices >= slices);
}

/// Neither trials nor parts are repeated, and damaged trials are made again.
void TestTarget(vtkImageData* field, const std::string& fileName)
{
  const Change change = [](vtkCSLFEncoder* encoder)
  {
    encoder->SetGroupLength(1);
    encoder->GetRateControl()->SetTargetPSNR(30.0);
    encoder->GetRateControl()->SetKeyViewStep(2);
  };
  const Remains remains = Interrupt(field, fileName, change);
  const std::vector<char> expected = ReadBytes(fileName);
  const int slices = cslf::testing::Decode(fileName)->GetExtent()[5] + 1;
  PutBack(remains);
  const Outcome outcome = Write(field, fileName, change);
  CSLF_CHECK(outcome.Written && outcome.Warnings == 0);
  CSLF_CHECK(outcome.Slices > 1 && outcome.Slices < slices);
  CSLF_CHECK(outcome.FirstProgress > 0.9 * Killed);
  CSLF_CHECK(ReadBytes(fileName) == expected);

  for (const std::string& text : { std::string(), std::string("[[0,20.0]]"), std::string("[1,{}") })
  {
    PutBack(remains);
    cslf::testing::WriteBytes(remains.Folder + "/trials.json", { text.begin(), text.end() });
    const Outcome again = Write(field, fileName, change);
    CSLF_CHECK(again.Written && again.Warnings == 0 && again.Slices > outcome.Slices);
    CSLF_CHECK(ReadBytes(fileName) == expected);
  }
}

/// A second writer of the same file fails, and does not disturb the first.
void TestLock(vtkImageData* field, const std::string& fileName, const std::vector<char>& expected)
{
  struct Second
  {
    vtkImageData* Field;
    std::string FileName;
    int Attempts = 0;
  } second{ field, fileName };
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  Set(encoder, fileName, [](vtkCSLFEncoder*) {});
  vtkNew<vtkCallbackCommand> disturb;
  disturb->SetClientData(&second);
  disturb->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* progress)
    {
      // The executive begins with 0 and ends with 1.
      const double share = *static_cast<double*>(progress);
      if (share == 0.0 || share == 1.0)
      {
        return;
      }
      auto* all = static_cast<Second*>(data);
      vtkNew<vtkCSLFEncoder> other;
      other->SetInputData(all->Field);
      Set(other, all->FileName, [](vtkCSLFEncoder*) {});
      const cslf::testing::Observed observed(other);
      CSLF_CHECK(other->Write() == 0);
      CSLF_CHECK(observed.HasError("another process is writing it"));
      ++all->Attempts;
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, disturb);
  CSLF_CHECK(encoder->Write() == 1);
  CSLF_CHECK(second.Attempts > 2);
  CSLF_CHECK(ReadBytes(fileName) == expected);
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
}

/// A file appears under the name while the field is written. It stays, and the groups wait for the
/// next run.
void TestOverwrite(vtkImageData* field, std::string fileName, const std::vector<char>& expected)
{
  const auto keep = [](vtkCSLFEncoder* encoder) { encoder->OverwriteOff(); };
  const std::vector<char> mine = { 'm', 'i', 'n', 'e' };
  fs::remove(fileName);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputData(field);
  Set(encoder, fileName, keep);
  vtkNew<vtkCallbackCommand> appear;
  appear->SetClientData(&fileName);
  appear->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) {
      cslf::testing::WriteBytes(*static_cast<std::string*>(data), { 'm', 'i', 'n', 'e' });
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, appear);
  for (const char* error : { "has appeared meanwhile", "it exists" })
  {
    const cslf::testing::Observed observed(encoder);
    CSLF_CHECK(encoder->Write() == 0);
    CSLF_CHECK(observed.HasError(error));
    CSLF_CHECK(encoder->GetErrorCode() == vtkErrorCode::CannotOpenFileError);
    CSLF_CHECK(ReadBytes(fileName) == mine);
  }
  fs::remove(fileName);
  const Outcome outcome = Write(field, fileName, keep);
  CSLF_CHECK(outcome.Written && outcome.Slices == 1);
  CSLF_CHECK(ReadBytes(fileName) == expected);
}
}

int TestCSLFEncoderRestart(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderRestart");
  const auto field = cslf::testing::MakeByteField(5, 16);
  const std::string fileName = folder + "/field.mp4";
  const Remains remains = Interrupt(field, fileName);
  const std::vector<char> expected = ReadBytes(fileName);
  CSLF_CHECK(!expected.empty());
  TestRestart(field, remains, fileName, expected);
  TestDamage(field, remains, fileName, expected);
  TestManifest(field, remains, fileName, expected);
  TestForeign(field, remains, fileName, expected);
  TestChange(field, remains, fileName);
  TestLock(field, fileName, expected);
  TestOverwrite(field, fileName, expected);
  TestTarget(cslf::testing::MakeByteField(9, 16), folder + "/target.mp4");
  return cslf::testing::Result();
}
