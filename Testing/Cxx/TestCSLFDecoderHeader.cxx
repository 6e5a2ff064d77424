// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files whose header is not as an encoder writes it: one line of error, never a crash.
#include "cslfRemux.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>

#include <filesystem>
#include <string>

namespace
{
constexpr const char* Original = CSLF_TEST_DATA "/field.mp4";

std::string MakeFolder(int argc, char* argv[])
{
  char* root =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const auto folder = std::filesystem::path(root) / "TestCSLFDecoderHeader";
  delete[] root;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

/// A file of other tags is refused with that message.
void CheckRefused(
  const std::string& folder, const cslf::testing::Tags& tags, const std::string& message)
{
  const std::string fileName = folder + "/changed.mp4";
  cslf::testing::RemuxChanges changes;
  changes.SetTags = tags;
  CSLF_CHECK(cslf::testing::Remux(Original, fileName, changes));
  vtkNew<vtkCSLFDecoder> decoder;
  CSLF_CHECK(decoder->CanReadFile(fileName.c_str()) == 0);
  vtkNew<vtkTest::ErrorObserver> observer;
  decoder->AddObserver(vtkCommand::ErrorEvent, observer);
  decoder->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  decoder->SetFileName(fileName.c_str());
  decoder->Update();
  CSLF_CHECK(decoder->GetErrorCode() != vtkErrorCode::NoError);
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
  if (!observer->GetError() || observer->GetErrorMessage().find(message) == std::string::npos)
  {
    std::cerr << "expected \"" << message << "\", not " << observer->GetErrorMessage() << "\n";
    CSLF_CHECK(false);
  }
}

std::string Repeat(const std::string& text, int times)
{
  std::string all;
  for (int k = 0; k < times; ++k)
  {
    all += text;
  }
  return all;
}

/// Far deeper than the stack of a thread allows a function to call itself.
void TestDeep(const std::string& folder)
{
  const std::string begin = R"({"coding":0,"checksum":0,"x":)";
  constexpr int depth = 100000;
  CheckRefused(folder, { { "comment", begin + Repeat("[", depth) + Repeat("]", depth) + "}" } },
    "it is no light field");
  CheckRefused(folder, { { "comment", begin + Repeat("{\"a\":", depth) } }, "it is no light field");
}
}

int TestCSLFDecoderHeader(int argc, char* argv[])
{
  const std::string folder = MakeFolder(argc, argv);
  TestDeep(folder);
  return cslf::testing::Result();
}
