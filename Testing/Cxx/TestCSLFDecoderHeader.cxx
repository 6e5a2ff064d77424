// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files with headers that no encoder writes: one line of error, never a crash. Files of later
// versions, and damaged ones, are read as far as they can be.
#include "Coding/Containers/cslfContainerReader.h"
#include "Coding/Frames/cslfFrameConverter.h"
#include "cslfJSONText.h"
#include "cslfRemux.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

namespace
{
constexpr const char* Original = CSLF_TEST_DATA "/Golden/v1-hevc-yuv444p.mp4";

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

/// A file with other tags is refused with that message.
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

/// Far deeper than recursion on a thread's stack allows.
void TestDeep(const std::string& folder)
{
  const std::string begin = R"({"coding":0,"checksum":0,"x":)";
  constexpr int depth = 100000;
  CheckRefused(folder, { { "comment", begin + Repeat("[", depth) + Repeat("]", depth) + "}" } },
    "it is not a light field");
  CheckRefused(
    folder, { { "comment", begin + Repeat("{\"a\":", depth) } }, "it is not a light field");
}

/// The header of the original as this version writes it, with two parts.
cslf::testing::Tags MakeTags()
{
  cslf::OpenError failure;
  const auto reader = cslf::ContainerReader::Open(Original, failure);
  CSLF_CHECK(reader != nullptr);
  cslf::FileHeader header = reader ? reader->GetHeader() : cslf::FileHeader();
  header.Parts = { { "model/gltf-binary", "mesh", { 'g', 'l', 'T', 'F', 0, 255 } },
    { "text/plain", "", {} }, { "text/csv", "table", { '1', ',', '2' } } };
  return header.ToTags();
}

/// The same with another JSON text, with a correct checksum.
template <typename Change>
cslf::testing::Tags ChangeTags(Change change)
{
  cslf::testing::Tags tags = MakeTags();
  auto json = cslf::ParseJSON(cslf::UnsealHeader(tags["comment"]).JSON);
  change(json);
  tags["comment"] = tags["description"] = cslf::SealHeader(json.dump());
  return tags;
}

/// The result and the messages of a file with other tags.
struct Reading
{
  vtkNew<vtkCSLFDecoder> Decoder;
  std::string Warning;

  Reading(const std::string& fileName, const cslf::testing::Tags& tags)
  {
    cslf::testing::RemuxChanges changes;
    changes.SetTags = tags;
    CSLF_CHECK(cslf::testing::Remux(Original, fileName, changes));
    this->Read(fileName);
  }

  explicit Reading(const std::string& fileName) { this->Read(fileName); }

  void Read(const std::string& fileName)
  {
    vtkNew<vtkTest::ErrorObserver> observer;
    this->Decoder->AddObserver(vtkCommand::ErrorEvent, observer);
    this->Decoder->AddObserver(vtkCommand::WarningEvent, observer);
    this->Decoder->SetFileName(fileName.c_str());
    this->Decoder->Update();
    CSLF_CHECK(!observer->GetError());
    CSLF_CHECK(this->Decoder->GetOutput()->GetNumberOfPoints() == 24 * 5 * 16 * 16);
    this->Warning = observer->GetWarningMessage();
  }

  vtkDataArray* GetArray(const char* name) const
  {
    return this->Decoder->GetOutput()->GetPointData()->GetArray(name);
  }

  bool Says(const std::string& text) const { return this->Warning.find(text) != std::string::npos; }
};

bool AreEqual(vtkDataArray* a, vtkDataArray* b)
{
  const auto bytes = static_cast<std::size_t>(a->GetDataSize()) * a->GetDataTypeSize();
  return a->GetDataSize() == b->GetDataSize() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes) == 0;
}

void CheckWhole(const Reading& reading)
{
  CSLF_CHECK(reading.Decoder->GetNumberOfMissingViewpoints() == 0);
  const Reading original(Original);
  for (const char* name : { cslf::ColorName, cslf::DepthName })
  {
    CSLF_CHECK(AreEqual(reading.GetArray(name), original.GetArray(name)));
  }
}

void CheckParts(const Reading& reading)
{
  vtkCSLFDecoder* decoder = reading.Decoder;
  CSLF_CHECK(decoder->GetNumberOfParts() == 3);
  CSLF_CHECK(std::string(decoder->GetPartType(0)) == "model/gltf-binary");
  CSLF_CHECK(std::string(decoder->GetPartName(0)) == "mesh");
  CSLF_CHECK(decoder->GetPart(0)->GetNumberOfValues() == 6);
  CSLF_CHECK(decoder->GetPart(0)->GetValue(5) == 255);
  CSLF_CHECK(decoder->GetPart(1)->GetNumberOfValues() == 0);
  CSLF_CHECK(decoder->GetPart(2)->GetValue(2) == '2');
  CSLF_CHECK(!decoder->GetPart(3) && !decoder->GetPartType(-1) && !decoder->GetPartName(3));
}

void TestContainers(const std::string& folder)
{
  const Reading written(folder + "/written.mp4", MakeTags());
  CSLF_CHECK(written.Warning.empty());
  CheckWhole(written);
  CheckParts(written);
  std::string from = folder + "/written.mp4";
  for (const char* name : { "/there.mkv", "/back.mp4", "/again.mkv" })
  {
    CSLF_CHECK(cslf::testing::Remux(from, folder + name));
    from = folder + name;
    const Reading reading(from);
    CSLF_CHECK(reading.Warning.empty());
    CheckWhole(reading);
    CheckParts(reading);
  }
}

/// Any byte of one copy may be wrong, or the copy may be missing.
void TestCopies(const std::string& folder)
{
  const std::string fileName = folder + "/copies.mp4";
  const std::size_t length = MakeTags()["comment"].size();
  for (const char* name : { "comment", "description" })
  {
    for (const std::size_t place : { std::size_t(0), std::size_t(5), std::size_t(6), std::size_t(9),
           std::size_t(15), std::size_t(16), length / 2, length - 1 })
    {
      cslf::testing::Tags tags = MakeTags();
      tags[name][place] ^= 1;
      const Reading reading(fileName, tags);
      CSLF_CHECK(reading.Says(std::string("tag \"") + name + "\" is damaged"));
      CheckParts(reading);
    }
    cslf::testing::Tags tags = MakeTags();
    tags[name] = "";
    CSLF_CHECK(Reading(fileName, tags).Says("is damaged"));
    tags[name] = "A film about boxes";
    CSLF_CHECK(Reading(fileName, tags).Says("is damaged"));
  }
  cslf::testing::Tags tags = MakeTags();
  tags["comment"][length / 2] ^= 1;
  tags["description"][length / 3] ^= 1;
  CheckRefused(folder, tags, "its description is damaged");
  tags = MakeTags();
  tags["comment"].resize(length / 2);
  tags["description"] = "";
  CheckRefused(folder, tags, "its description is damaged");
}

void TestVersions(const std::string& folder)
{
  using JSON = nlohmann::json;
  cslf::testing::Tags tags = MakeTags();
  tags["comment"][5] = tags["description"][5] = '3';
  CheckRefused(folder, tags, "written by a newer CSLF: format 3, this reads 2 and 1");
  const auto setVersion = [](const JSON& version)
  { return ChangeTags([version](JSON& json) { json["version"] = version; }); };
  CheckRefused(folder, setVersion({ 3, 0 }), "written by a newer CSLF: format 3");
  for (const JSON& version : { JSON(2), JSON({ 2 }), JSON({ 2, -1 }), JSON({ 1, 0 }), JSON("2") })
  {
    CheckRefused(folder, setVersion(version), "");
  }
  CheckRefused(folder,
    ChangeTags(
      [](JSON& json) {
        json["required"] = { "layers", "times" };
      }),
    "requires features that this version does not support: layers, times");
  const Reading later(folder + "/later.mp4",
    ChangeTags(
      [](JSON& json)
      {
        json["version"] = { 2, 7 };
        json["required"] = JSON::array();
        json["certificate"] = { { "by", "nobody" } };
        json["coding"]["tracks"][0]["mastering"] = 5;
      }));
  CSLF_CHECK(later.Warning.empty());
  CheckWhole(later);
}

/// Additions of later versions are left out and reported.
void TestUnknown(const std::string& folder)
{
  using JSON = nlohmann::json;
  const Reading more(folder + "/more.mp4",
    ChangeTags(
      [](JSON& json)
      {
        for (const char* type : { "float32", "float16" })
        {
          json["channels"].push_back({ { "name", std::string("Normals-") + type }, { "type", type },
            { "components", 3 }, { "encoding", "unit" } });
        }
        auto& tracks = json["coding"]["tracks"];
        tracks.insert(tracks.begin() + 1, JSON({ { "role", "normals" }, { "codec", "vvc" } }));
        json["parts"].push_back({ { "type", "text/plain" }, { "name", "late" }, { "bytes", 3 },
          { "crc", 0 }, { "tag", "lyrics" } });
      }));
  for (const char* name : { "channel \"Normals-float32\"", "channel \"Normals-float16\"",
         "track \"normals\"", "part \"late\" (text/plain)" })
  {
    CSLF_CHECK(more.Says(name));
  }
  CheckWhole(more);
  CheckParts(more);

  // A track of a known codec takes the place of a stream.
  const Reading other(folder + "/other.mp4",
    ChangeTags(
      [](JSON& json)
      {
        json["channels"].erase(1);
        json["coding"]["tracks"][1]["role"] = "heat";
        json["coding"]["tracks"].erase(2);
      }));
  CSLF_CHECK(other.Says("track \"heat\""));
  CSLF_CHECK(!other.GetArray(cslf::DepthName));
  CSLF_CHECK(other.Decoder->GetNumberOfTracks() == 1);
}

/// Unfinished files: what they lack is known from the header.
void TestMissing(const std::string& folder)
{
  using JSON = nlohmann::json;
  const auto lack = [](const JSON& missing)
  { return ChangeTags([missing](JSON& json) { json["coding"]["missing_groups"] = missing; }); };
  const Reading part(folder + "/part.mp4", lack({ { 1, 1 } }));
  CSLF_CHECK(part.Says("is unfinished"));
  CSLF_CHECK(part.Decoder->IsUnfinished());
  CSLF_CHECK(part.Decoder->GetNumberOfMissingViewpoints() > 0);
  const Reading whole(folder + "/part.mp4", lack(JSON::array()));
  CSLF_CHECK(whole.Warning.empty() && !whole.Decoder->IsUnfinished());
  CheckWhole(whole);
  for (const JSON& missing : { JSON({ { 0, 2147483647 } }), JSON({ { -1, 2 } }), JSON({ { 0, 0 } }),
         JSON({ { 2147483647, 1 } }), JSON({ { 1, 1 }, { 0, 1 } }), JSON({ { 1, 1 }, { 1, 1 } }),
         JSON({ { 0, -1 } }), JSON({ { 0 } }), JSON({ 0, 1 }), JSON({ { 0.5, 1 } }), JSON(1) })
  {
    CheckRefused(folder, lack(missing), "");
  }
}

void TestParts(const std::string& folder)
{
  cslf::testing::Tags tags = MakeTags();
  tags["synopsis"].back() ^= 1;
  const Reading damaged(folder + "/parts.mp4", tags);
  CSLF_CHECK(damaged.Says("part \"table\" (text/csv) is damaged and left out"));
  CSLF_CHECK(damaged.Decoder->GetNumberOfParts() == 2);
  CheckWhole(damaged);
  tags["synopsis"] = "";
  const Reading gone(folder + "/parts.mp4", tags);
  CSLF_CHECK(gone.Says("part \"mesh\" (model/gltf-binary) is damaged"));
  CheckWhole(gone);
  for (const nlohmann::json& bytes :
    { nlohmann::json(-1), nlohmann::json(1e300), nlohmann::json(18446744073709551615ull) })
  {
    const Reading odd(folder + "/parts.mp4",
      ChangeTags([bytes](nlohmann::json& json) { json["parts"][0]["bytes"] = bytes; }));
    CSLF_CHECK(odd.Says("list of parts is invalid"));
    CSLF_CHECK(odd.Decoder->GetNumberOfParts() == 0);
  }
}

/// The reader's constants are those of the file.
void TestConstants(const std::string& folder)
{
  const auto set = [](const char* role, const char* key, const nlohmann::json& value)
  {
    return ChangeTags(
      [=](nlohmann::json& json)
      {
        for (auto& track : json["coding"]["tracks"])
        {
          if (track["role"] == role)
          {
            CSLF_CHECK(track.contains(key));
            track[key] = value;
          }
        }
      });
  };
  const Reading original(Original);
  const Reading curved(folder + "/curved.mp4", set("depth", "mu", 255));
  vtkDataArray* depths = curved.GetArray(cslf::DepthName);
  const auto before = cslf::MakeCodedDepths(12, 40.0);
  const auto after = cslf::MakeCodedDepths(12, 255.0);
  for (vtkIdType k = 0; k < depths->GetNumberOfTuples(); k += 7)
  {
    const auto depth = original.GetArray(cslf::DepthName)->GetComponent(k, 0);
    const auto code = std::lower_bound(before.begin(), before.end(), depth) - before.begin();
    CSLF_CHECK(depths->GetComponent(k, 0) == after[code]);
  }
  // With the largest tolerance, coverage is all or nothing.
  const Reading tolerant(folder + "/tolerant.mp4", set("coverage", "tolerance", 127));
  vtkIdType partly[2] = { 0, 0 };
  for (vtkIdType k = 0; k < depths->GetNumberOfTuples(); ++k)
  {
    const Reading* const readings[2] = { &original, &tolerant };
    for (int i = 0; i < 2; ++i)
    {
      const double alpha = readings[i]->GetArray(cslf::ColorName)->GetComponent(k, 3);
      partly[i] += alpha > 0.0 && alpha < 255.0 ? 1 : 0;
    }
  }
  CSLF_CHECK(partly[0] > 100 && partly[1] == 0);
  CheckRefused(folder, set("coverage", "tolerance", 128), "\"tolerance\" is not valid");
  CheckRefused(folder, set("coverage", "tolerance", 7.5), "not an integer");
  CheckRefused(folder, set("depth", "mu", 0), "\"mu\" is not valid");
  CheckRefused(folder, set("depth", "transfer", "square root"), "unknown transfer curve");
}

/// Tiles of an odd size would share samples of chroma.
void TestOddSize(const std::string& folder)
{
  for (const char* format : { "yuv420p", "yuv422p" })
  {
    CheckRefused(folder,
      ChangeTags(
        [format](nlohmann::json& json)
        {
          json["resolution"] = 17;
          json["coding"]["tracks"][0]["pixel_format"] = format;
        }),
      "\"color\" has a pixel format that needs an even resolution");
  }
}
}

int TestCSLFDecoderHeader(int argc, char* argv[])
{
  const std::string folder = MakeFolder(argc, argv);
  TestDeep(folder);
  TestContainers(folder);
  TestCopies(folder);
  TestVersions(folder);
  TestUnknown(folder);
  TestMissing(folder);
  TestParts(folder);
  TestConstants(folder);
  TestOddSize(folder);
  return cslf::testing::Result();
}
