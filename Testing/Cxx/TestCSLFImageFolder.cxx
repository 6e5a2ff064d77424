// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A folder of cube maps: exact round trips, the contents of files, and bad folders.
#include "vtkCSLFImageReader.h"
#include "vtkCSLFImageWriter.h"

#include "CubeMaps/cslfCubeMapFiles.h"
#include "Files/cslfJSONFile.h"
#include "cslfDescription.h"
#include "cslfProgressWatch.h"
#include "cslfTestField.h"
#include "cslfTesting.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkExtractVOI.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkTestErrorObserver.h>
#include <vtkTestUtilities.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{
constexpr int Side = 3;
constexpr int Size = 7;
constexpr int Slices = 6 * Side * Side;

vtkSmartPointer<vtkImageData> MakeField(int colorType, int depthType)
{
  const cslf::Cube box{ { 1.0, 2.0, 3.0 }, { 4.0, 5.0, 6.0 } };
  auto image = cslf::testing::MakeTestField(cslf::Layout(Side, Size), box, colorType, depthType, 2);
  // Associated colour above its alpha, as lossy coding may leave it, must survive too.
  if (auto* colors =
        vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetArray(cslf::ColorName)))
  {
    unsigned char strange[4] = { 200, 3, 0, 7 };
    colors->SetTypedTuple(11, strange);
    strange[3] = 0;
    colors->SetTypedTuple(12, strange);
  }
  return image;
}

bool Write(vtkImageData* field, const std::string& folder)
{
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputData(field);
  writer->SetFileName(folder.c_str());
  return writer->Write() == 1;
}

/// Whether slices `first` to `last` of an array have the same bytes in both images.
bool AreEqual(vtkImageData* a, vtkImageData* b, const char* name, int first, int last)
{
  vtkDataArray* arrayA = a->GetPointData()->GetArray(name);
  vtkDataArray* arrayB = b->GetPointData()->GetArray(name);
  if (!arrayA || !arrayB || arrayA->GetDataType() != arrayB->GetDataType() ||
    arrayA->GetNumberOfComponents() != arrayB->GetNumberOfComponents())
  {
    return false;
  }
  const std::size_t slice =
    std::size_t(5) * Size * Size * arrayA->GetNumberOfComponents() * arrayA->GetDataTypeSize();
  const auto begin = [&](vtkImageData* image, vtkDataArray* array)
  {
    return static_cast<const char*>(array->GetVoidPointer(0)) +
      slice * (first - image->GetExtent()[4]);
  };
  return std::memcmp(begin(a, arrayA), begin(b, arrayB), slice * (last - first + 1)) == 0;
}

std::string GetText(vtkImageData* image)
{
  return vtkStringArray::SafeDownCast(
    image->GetFieldData()->GetAbstractArray(cslf::Description::FieldDataName))
    ->GetValue(0);
}

void TestRoundTrip(const std::string& folder, int colorType, int depthType)
{
  vtkSmartPointer<vtkImageData> field = MakeField(colorType, depthType);
  CSLF_CHECK(Write(field, folder));
  CSLF_CHECK(!fs::exists(folder + ".partial") && !fs::exists(folder + ".replaced"));
  vtkNew<vtkCSLFImageReader> reader;
  CSLF_CHECK(reader->CanReadFile(folder.c_str()) == 3);
  reader->SetFileName(folder.c_str());
  reader->Update();
  vtkImageData* output = reader->GetOutput();
  CSLF_CHECK(output->GetExtent()[5] == Slices - 1);
  CSLF_CHECK(AreEqual(field, output, cslf::ColorName, 0, Slices - 1));
  CSLF_CHECK(depthType == 0 || AreEqual(field, output, cslf::DepthName, 0, Slices - 1));
  CSLF_CHECK(reader->GetNumberOfMissingViewpoints() == 0);
  CSLF_CHECK(GetText(output) == GetText(field) && GetText(field) == reader->GetDescription());

  const int part[6] = { 0, 5 * Size - 1, 0, Size - 1, 20, 23 };
  vtkNew<vtkCSLFImageReader> partReader;
  partReader->SetFileName(folder.c_str());
  partReader->UpdateExtent(part);
  output = partReader->GetOutput();
  CSLF_CHECK(output->GetExtent()[4] == 20 && output->GetExtent()[5] == 23);
  CSLF_CHECK(AreEqual(field, output, cslf::ColorName, 20, 23));
}

/// A folder with only some viewpoints keeps their absolute numbers.
void TestPart(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  vtkNew<vtkExtractVOI> extract;
  extract->SetInputData(field);
  extract->SetVOI(0, 5 * Size - 1, 0, Size - 1, 30, 40);
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputConnection(extract->GetOutputPort());
  writer->SetFileName((folder + "/").c_str());
  CSLF_CHECK(writer->Write() == 1);
  vtkNew<vtkCSLFImageReader> reader;
  reader->SetFileName(folder.c_str());
  reader->Update();
  CSLF_CHECK(reader->GetOutput()->GetExtent()[4] == 30);
  CSLF_CHECK(reader->GetOutput()->GetExtent()[5] == 40);
  CSLF_CHECK(AreEqual(field, reader->GetOutput(), cslf::DepthName, 30, 40));
}

/// The strip as another program sees it: OpenGL's face order, the entry face transparent.
void TestStrip(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  CSLF_CHECK(Write(field, folder));
  constexpr int slice = (2 * Side + 1) * Side + 2; // on face +Y
  vtkNew<vtkPNGReader> png;
  png->SetFileName((folder + "/000023.Color.png").c_str());
  png->Update();
  static_assert(slice == 23, "the file's name is the slice's number");
  vtkImageData* strip = png->GetOutput();
  CSLF_CHECK(strip->GetDimensions()[0] == 6 * Size && strip->GetDimensions()[1] == Size);
  CSLF_CHECK(strip->GetNumberOfScalarComponents() == 4);
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < 6 * Size; ++x)
    {
      const int face = x / Size;
      const int column = (face < 2 ? face : face - 1) * Size + x % Size;
      for (int component = 0; component < 4; ++component)
      {
        const double value = strip->GetScalarComponentAsDouble(x, Size - 1 - y, 0, component);
        const double expected =
          face == 2 ? 0.0 : field->GetScalarComponentAsDouble(column, y, slice, component);
        CSLF_CHECK(value == expected);
      }
    }
  }
  png->SetFileName((folder + "/000023.Depth.png").c_str());
  png->Update();
  CSLF_CHECK(png->GetOutput()->GetScalarType() == VTK_UNSIGNED_SHORT);
  CSLF_CHECK(png->GetOutput()->GetScalarComponentAsDouble(2 * Size, 0, 0, 0) == 65535.0);
}

/// The result of a missing image and of a truncated one.
void TestMissing(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  CSLF_CHECK(Write(field, folder));
  fs::remove(folder + "/000005.Depth.png");
  fs::resize_file(folder + "/000009.Color.png", 150);
  vtkNew<vtkCSLFImageReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::WarningEvent, observer);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(folder.c_str());
  reader->Update();
  CSLF_CHECK(!observer->GetError());
  CSLF_CHECK(observer->GetWarningMessage().find("2 of 54 viewpoints") != std::string::npos);
  CSLF_CHECK(reader->GetNumberOfMissingViewpoints() == 2);
  CSLF_CHECK(reader->GetMissingViewpoints()->GetValue(0) == 5);
  CSLF_CHECK(reader->GetMissingViewpoints()->GetValue(1) == 9);
  // Later updates make new arrays, so what was returned stays as it is.
  const vtkSmartPointer<vtkIdTypeArray> missing = reader->GetMissingViewpoints();
  CSLF_CHECK(reader->FindMissingViewpoints() == 2);
  CSLF_CHECK(reader->GetMissingViewpoints() != missing);
  CSLF_CHECK(AreEqual(field, reader->GetOutput(), cslf::ColorName, 10, Slices - 1));
  vtkDataArray* colors = reader->GetOutput()->GetPointData()->GetArray(cslf::ColorName);
  vtkDataArray* depths = reader->GetOutput()->GetPointData()->GetArray(cslf::DepthName);
  for (const int slice : { 5, 9 })
  {
    for (vtkIdType texel = 0; texel < 5 * Size * Size; ++texel)
    {
      const vtkIdType point = slice * 5 * Size * Size + texel;
      CSLF_CHECK(colors->GetComponent(point, 0) == 0.0 && colors->GetComponent(point, 3) == 0.0);
      CSLF_CHECK(depths->GetComponent(point, 0) == 65535.0);
    }
  }
  observer->Clear();
  const int part[6] = { 0, 5 * Size - 1, 0, Size - 1, 9, 9 };
  reader->Modified();
  CSLF_CHECK(!reader->UpdateExtent(part));
  CSLF_CHECK(observer->GetErrorMessage().find("viewpoints 9 to 9") != std::string::npos);
  CSLF_CHECK(missing->GetNumberOfValues() == 2);
  CSLF_CHECK(missing->GetValue(0) == 5 && missing->GetValue(1) == 9);
}

/// A folder that is replaced by that of another field between two steps of the pipeline.
void TestReplaced(const std::string& folder)
{
  CSLF_CHECK(Write(MakeField(VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT), folder));
  vtkNew<vtkCSLFImageReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(folder.c_str());
  reader->UpdateInformation();
  CSLF_CHECK(Write(MakeField(VTK_FLOAT, VTK_FLOAT), folder));
  reader->Update();
  CSLF_CHECK(
    observer->GetErrorMessage().find("replaced while it was being read") != std::string::npos);
  CSLF_CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  observer->Clear();
  reader->Modified();
  reader->Update();
  CSLF_CHECK(!observer->GetError());
  CSLF_CHECK(
    AreEqual(MakeField(VTK_FLOAT, VTK_FLOAT), reader->GetOutput(), cslf::DepthName, 0, Slices - 1));
}

/// Any byte of an image of floats replaced by another one: the image is right or missing.
void TestChecksums(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_FLOAT, 0);
  CSLF_CHECK(Write(field, folder));
  const std::string name = folder + "/000004.Color.exr";
  std::ifstream input(name, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(input), {} };
  std::mt19937 random(5);
  int missing = 0;
  constexpr int flips = 200;
  for (int flip = 0; flip < flips; ++flip)
  {
    std::string flipped = bytes;
    const std::size_t place = random() % flipped.size();
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << random() % 8));
    std::ofstream(name, std::ios::binary) << flipped;
    vtkNew<vtkCSLFImageReader> reader;
    vtkNew<vtkTest::ErrorObserver> observer;
    reader->AddObserver(vtkCommand::WarningEvent, observer);
    reader->SetFileName(folder.c_str());
    const int part[6] = { 0, 5 * Size - 1, 0, Size - 1, 3, 4 };
    CSLF_CHECK(reader->UpdateExtent(part));
    CSLF_CHECK(AreEqual(field, reader->GetOutput(), cslf::ColorName, 3, 3));
    const bool isMissing = reader->GetNumberOfMissingViewpoints() > 0;
    CSLF_CHECK(isMissing || AreEqual(field, reader->GetOutput(), cslf::ColorName, 4, 4));
    CSLF_CHECK(observer->GetWarning() == isMissing);
    missing += isMissing ? 1 : 0;
  }
  std::cout << missing << " of " << flips << " flipped bits were found\n";
  CSLF_CHECK(missing > flips / 2);
}

/// Headers of EXR that OpenEXR would not read as they were written.
void TestHeaders(const std::string& folder)
{
  CSLF_CHECK(Write(MakeField(VTK_FLOAT, 0), folder));
  std::ifstream input(folder + "/000004.Color.exr", std::ios::binary);
  const std::vector<unsigned char> bytes{ std::istreambuf_iterator<char>(input), {} };
  constexpr int width = 6 * Size;
  CSLF_CHECK(cslf::IsSoundEXR(bytes, width, Size));
  CSLF_CHECK(!cslf::IsSoundEXR(bytes, width, Size + 1));
  CSLF_CHECK(!cslf::IsSoundEXR({}, width, Size));
  const auto isSoundWith = [&bytes](const std::string& after, std::size_t offset, char byte)
  {
    std::vector<unsigned char> changed = bytes;
    const auto place = std::search(changed.begin(), changed.end(), after.begin(), after.end());
    CSLF_CHECK(place != changed.end());
    *(place + static_cast<std::ptrdiff_t>(after.size() + offset)) = byte;
    return cslf::IsSoundEXR(changed, width, Size);
  };
  // The list of channels, which are "A", "B", "G" and "R", ends at an empty name.
  const std::string channels("channels\0chlist", 15);
  CSLF_CHECK(isSoundWith(channels, 5, 'Z'));
  CSLF_CHECK(!isSoundWith(channels, 5 + 18, 0));
  CSLF_CHECK(!isSoundWith(channels, 5 + 4 * 18, 'Z'));
  // Sizes that are not those of their types.
  CSLF_CHECK(!isSoundWith(channels, 1, 72));
  CSLF_CHECK(!isSoundWith(std::string("lineOrder\0lineOrder", 19), 1, 2));
  CSLF_CHECK(!isSoundWith(std::string("compression\0compressio", 22), 0, 'x'));
}

/// Missing viewpoints are an error if this is requested.
void TestAllowMissing(const std::string& folder)
{
  CSLF_CHECK(Write(MakeField(VTK_UNSIGNED_CHAR, 0), folder));
  fs::remove(folder + "/000005.Color.png");
  vtkNew<vtkCSLFImageReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(folder.c_str());
  reader->AllowMissingOff();
  reader->Update();
  CSLF_CHECK(observer->GetErrorMessage().find("1 of 54 viewpoints") != std::string::npos);
  CSLF_CHECK(reader->GetErrorCode() == vtkErrorCode::PrematureEndOfFileError);
  CSLF_CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
}

void CheckReadFails(const std::string& folder, const char* message)
{
  vtkNew<vtkCSLFImageReader> reader;
  CSLF_CHECK(reader->CanReadFile(folder.c_str()) == 0);
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(folder.c_str());
  reader->Update();
  CSLF_CHECK(observer->GetErrorMessage().find(message) != std::string::npos);
}

void CheckWriteFails(vtkImageData* field, const std::string& folder, const char* message)
{
  vtkNew<vtkCSLFImageWriter> writer;
  vtkNew<vtkTest::ErrorObserver> observer;
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->SetInputData(field);
  writer->SetFileName(folder.c_str());
  CSLF_CHECK(writer->Write() == 0);
  CSLF_CHECK(writer->GetErrorCode() != 0);
  CSLF_CHECK(observer->GetErrorMessage().find(message) != std::string::npos);
  CSLF_CHECK(!fs::exists(folder + ".partial"));
}

void TestBad(const std::string& root)
{
  fs::create_directories(root + "/other");
  std::ofstream(root + "/other/letter.txt") << "Dear reader";
  std::ofstream(root + "/file") << "no folder";
  CheckReadFails(root + "/nowhere", "has no readable description.json");
  CheckReadFails(root + "/other", "has no readable description.json");
  CheckReadFails(root + "/file", "has no readable description.json");

  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, 0);
  CheckWriteFails(field, root + "/other", "contains other files");
  CSLF_CHECK(fs::exists(root + "/other/letter.txt"));
  CheckWriteFails(field, root + "/file", "is not a folder");
  CheckWriteFails(field, root + "/nowhere/else", "cannot make the folder");
  CheckWriteFails(field, "", "file name");
  vtkNew<vtkImageData> plain;
  plain->SetDimensions(4, 4, 4);
  plain->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  CheckWriteFails(plain, root + "/plain", "is not a light field");
  CSLF_CHECK(!fs::exists(root + "/plain"));

  CSLF_CHECK(Write(field, root + "/lies"));
  auto description = cslf::ReadJSON(root + "/lies/description.json");
  std::ofstream(root + "/lies/description.json") << R"({"format": "poem"})";
  vtkNew<vtkCSLFImageReader> reader;
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName((root + "/lies").c_str());
  CSLF_CHECK(reader->FindMissingViewpoints() == -1 && observer->GetError());
  CheckReadFails(root + "/lies", "describes something else");
  // Two channels of one name: each is read into the memory of the other's type.
  description["channels"].push_back(description["channels"][0]);
  description["channels"][1]["type"] = "float32";
  description["channels"][1]["encoding"] = "linear-associated-alpha";
  std::ofstream(root + "/lies/description.json") << description.dump();
  CheckReadFails(root + "/lies", "two channels \"Color\"");
}

void WriteText(const std::string& fileName)
{
  fs::create_directories(fs::path(fileName).parent_path());
  std::ofstream(fileName) << "thesis";
}

bool HasText(const std::string& fileName)
{
  std::string text;
  std::ifstream(fileName) >> text;
  return text == "thesis";
}

/// Other files around the folder stay.
void TestForeign(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, 0);
  WriteText(folder + ".replaced/thesis");
  CSLF_CHECK(Write(field, folder));
  WriteText(folder + ".partial/thesis");
  WriteText(folder + ".partial/unfinished-abcdef/new/thesis");
  vtkNew<vtkCSLFImageWriter> writer;
  vtkNew<vtkTest::ErrorObserver> observer;
  writer->AddObserver(vtkCommand::WarningEvent, observer);
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->SetInputData(field);
  writer->SetFileName(folder.c_str());
  CSLF_CHECK(writer->Write() == 1);
  CSLF_CHECK(observer->GetWarningMessage().find("contains other files") != std::string::npos);
  CSLF_CHECK(HasText(folder + ".replaced/thesis") && HasText(folder + ".partial/thesis"));
  CSLF_CHECK(HasText(folder + ".partial/unfinished-abcdef/new/thesis"));
  fs::remove_all(folder + ".partial");

  // In the folder itself.
  for (const char* name : { "/thesis", "/notes/thesis", "/000099.Color.png", "/000000.Depth.png" })
  {
    WriteText(folder + name);
    CheckWriteFails(field, folder, "contains other files");
    CSLF_CHECK(HasText(folder + name) && fs::exists(folder + "/000000.Color.png"));
    fs::remove_all(folder + "/notes");
    fs::remove(folder + name);
  }

  // A link to it is followed.
  const std::string link = folder + "-link";
  fs::create_directory_symlink(folder, link);
  CSLF_CHECK(
    Write(field, link) && fs::is_symlink(link) && fs::exists(folder + "/000000.Color.png"));
}

/// What a run leaves if it is killed between removing an earlier folder and renaming the new one,
/// on a file system that cannot exchange them in one step.
void TestKilled(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, 0);
  CSLF_CHECK(Write(field, folder));
  const std::string scratch = folder + ".partial/unfinished-abcdef";
  fs::create_directories(scratch);
  std::ofstream(folder + ".partial/cslf.lock") << "CSLF: a light field is being written here.\n";
  fs::copy(folder, scratch + "/new");
  fs::rename(folder, scratch + "/replaced");
  vtkNew<vtkImageData> plain;
  plain->SetDimensions(4, 4, 4);
  plain->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  CheckWriteFails(plain, folder, "is not a light field");
  vtkNew<vtkCSLFImageReader> reader;
  CSLF_CHECK(reader->CanReadFile(folder.c_str()) == 3);
}

/// A second writer of the same folder fails, and does not disturb the first.
void TestLock(const std::string& folder)
{
  vtkSmartPointer<vtkImageData> field = MakeField(VTK_UNSIGNED_CHAR, 0);
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputData(field);
  writer->SetFileName(folder.c_str());
  vtkNew<vtkCallbackCommand> disturb;
  disturb->SetClientData(writer);
  disturb->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      auto* first = static_cast<vtkCSLFImageWriter*>(data);
      vtkNew<vtkCSLFImageWriter> second;
      vtkNew<vtkTest::ErrorObserver> observer;
      second->AddObserver(vtkCommand::ErrorEvent, observer);
      second->SetInputDataObject(first->GetInputDataObject(0, 0));
      second->SetFileName(first->GetFileName());
      CSLF_CHECK(second->Write() == 0);
      CSLF_CHECK(observer->GetErrorMessage().find("another process") != std::string::npos);
    });
  writer->AddObserver(vtkCommand::ProgressEvent, disturb);
  CSLF_CHECK(writer->Write() == 1);
  CSLF_CHECK(!fs::exists(folder + ".partial"));
}

/// The phases of writing, reading and checking have names and can be stopped.
void TestPhases(const std::string& folder)
{
  const auto field = MakeField(VTK_UNSIGNED_CHAR, 0);
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputData(field);
  writer->SetFileName(folder.c_str());
  {
    const cslf::testing::ProgressWatch watch(writer, "Writing images", 2);
    CSLF_CHECK(writer->Write() == 0);
    watch.CheckAborted();
    CSLF_CHECK(!fs::exists(folder));
  }
  {
    const cslf::testing::ProgressWatch watch(writer);
    CSLF_CHECK(writer->Write() == 1);
    watch.CheckWhole({ "Writing images" });
  }
  vtkNew<vtkCSLFImageReader> reader;
  reader->SetFileName(folder.c_str());
  vtkNew<vtkTest::ErrorObserver> observer;
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  {
    const cslf::testing::ProgressWatch watch(reader, "Reading viewpoints", 2);
    reader->Update();
    watch.CheckAborted();
    CSLF_CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
    reader->SetAbortExecute(0);
  }
  {
    const cslf::testing::ProgressWatch watch(reader, "Checking viewpoints", 2);
    CSLF_CHECK(reader->FindMissingViewpoints() == -1);
    watch.CheckAborted();
    CSLF_CHECK(!observer->GetError());
  }
  {
    const cslf::testing::ProgressWatch watch(reader);
    CSLF_CHECK(reader->FindMissingViewpoints() == 0);
    watch.CheckWhole({ "Checking viewpoints" });
  }
  const cslf::testing::ProgressWatch watch(reader);
  reader->Update();
  watch.CheckWhole({ "Reading viewpoints" });
  CSLF_CHECK(reader->GetOutput()->GetNumberOfPoints() == field->GetNumberOfPoints());
}
}

int TestCSLFImageFolder(int argc, char* argv[])
{
  char* temporary =
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "VTK_TEMP_DIR", "Testing/Temporary");
  const std::string root = std::string(temporary) + "/TestCSLFImageFolder";
  delete[] temporary;
  fs::remove_all(root);
  fs::create_directories(root);
  TestRoundTrip(root + "/bytes", VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  TestRoundTrip(root + "/bytes", VTK_UNSIGNED_CHAR, 0); // replaces the first
  CSLF_CHECK(!fs::exists(root + "/bytes/000000.Depth.png"));
  TestRoundTrip(root + "/floats", VTK_FLOAT, VTK_FLOAT);
  TestRoundTrip(root + "/mixed", VTK_FLOAT, VTK_UNSIGNED_SHORT);
  TestPart(root + "/part");
  TestStrip(root + "/strip");
  TestChecksums(root + "/checksums");
  TestHeaders(root + "/headers");
  TestAllowMissing(root + "/allowed");
  TestMissing(root + "/missing");
  TestReplaced(root + "/replaced");
  TestBad(root);
  TestForeign(root + "/foreign");
  TestKilled(root + "/killed");
  TestLock(root + "/lock");
  TestPhases(root + "/phases");
  return cslf::testing::Result();
}
