// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneParts.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Fields/cslfSceneChecks.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Pipeline/cslfValidPolyData.h"
#include "cslfGridReader.h"
#include "cslfJoin.h"
#include "cslfOBJReader.h"
#include "cslfPLYReader.h"
#include "cslfSTLReader.h"
#include "vtkCSLFGLTFReader.h"
#include "vtkCSLFSceneSource.h"

#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <new>
#include <set>

namespace cslf::tool
{
namespace
{
using Part = vtkSmartPointer<vtkDataObject>;

template <typename Reader>
Part ReadWith(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

using Readers = std::map<std::string, std::function<Part(const std::string&)>>;

constexpr const char* CollectionExtension = ".pvd";

/// The readers of one file by its extension.
const Readers& GetFileReaders()
{
  static const Readers readers = []
  {
    Readers all = {
      { ".ply", ReadPLY },
      { ".stl", ReadSTL },
      { ".obj", ReadOBJ },
      { ".vtk", ReadLegacyGrid },
      { ".gltf", ReadWith<vtkCSLFGLTFReader> },
      { ".glb", ReadWith<vtkCSLFGLTFReader> },
    };
    for (const char* extension : { ".vtp", ".vtm", ".vtu", ".vti", ".vtr", ".vts", ".vtpd", ".vtpc",
           ".pvtp", ".pvtu", ".pvti", ".pvtr", ".pvts" })
    {
      all[extension] = [](const std::string& fileName) { return ReadXMLGrid(fileName); };
    }
    return all;
  }();
  return readers;
}

/// The reader of a file; null if there is none for its extension.
const Readers::mapped_type* FindReader(const Readers& readers, const std::string& fileName)
{
  const auto found = readers.find(ToLower(ToName(ToPath(fileName).extension())));
  return found == readers.end() ? nullptr : &found->second;
}

/// A file that a collection names.
Part ReadEntry(const std::string& fileName)
{
  std::error_code failure;
  const auto* reader = FindReader(GetFileReaders(), fileName);
  if (!reader || !std::filesystem::is_regular_file(ToPath(fileName), failure))
  {
    throw Failure(reader ? "there is no file " + fileName + "."
                         : "it names " + fileName + ", which is not a scene.");
  }
  RequireReadable(fileName);
  return (*reader)(fileName);
}

std::string GetExtension(const std::string& fileName)
{
  return ToLower(ToName(ToPath(fileName).extension()));
}

/// Whether a file is the index of a series of scenes. Light fields have the same.
bool IsSeriesName(const std::string& fileName)
{
  return GetExtension(fileName) == FileSeriesExtension &&
    FindReader(GetFileReaders(), ToName(ToPath(fileName).stem()));
}

/// The files of a collection or a series at each of its times. Empty for other files.
TimedFiles FindTimedFiles(const std::string& fileName)
{
  return GetExtension(fileName) == CollectionExtension ? FindCollected(fileName)
    : IsSeriesName(fileName)                           ? FindSeries(fileName)
                                                       : TimedFiles();
}

/// Whether files of that extension may have several times themselves.
bool MayHaveTimes(const std::string& fileName)
{
  static const std::set<std::string> extensions = { ".vtp", ".vtu", ".vti", ".vtr", ".vts" };
  return extensions.count(GetExtension(fileName)) > 0;
}

/// Reads a file of any kind at a time, if it has times.
Part ReadAt(const std::string& fileName, std::optional<double> time)
{
  const TimedFiles steps = FindTimedFiles(fileName);
  if (steps.empty())
  {
    return time && MayHaveTimes(fileName) && !FindXMLTimes(fileName).empty()
      ? ReadXMLGrid(fileName, time)
      : (*FindReader(GetFileReaders(), fileName))(fileName);
  }
  if (!time && steps.size() > 1)
  {
    AddWarning("Of the " + std::to_string(steps.size()) + " time steps of " + fileName +
      ", the first is shown.");
  }
  auto step = steps.upper_bound(time.value_or(steps.begin()->first));
  step = step == steps.begin() ? step : std::prev(step);
  return ReadBlocks(step->second, ReadEntry);
}

/// Whether there is a reader for a file of that name.
bool IsReadable(const std::string& fileName)
{
  return FindReader(GetFileReaders(), fileName) || IsSeriesName(fileName) ||
    GetExtension(fileName) == CollectionExtension;
}

/// Removes cells that would be read out of bounds, with warnings.
Part MakePartSound(vtkDataObject* part, const std::string& input)
{
  std::set<std::string> removed;
  const auto makeSound = [&removed](vtkPolyData* polyData)
  {
    const ValidPolyData sound = MakeSound(polyData);
    sound.AddRemoved(removed);
    return sound.Data;
  };
  Part result = part;
  if (auto* polyData = vtkPolyData::SafeDownCast(part))
  {
    result = makeSound(polyData);
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(part))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
    leaf.TakeReference(tree->NewTreeIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (auto* data = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()))
      {
        tree->SetDataSetFrom(leaf, makeSound(data));
      }
    }
  }
  for (const std::string& what : removed)
  {
    AddWarning("Invalid parts of " + input + " were left out: " + what + ".");
  }
  return result;
}

/// Whether a point has coordinates that are finite as floats, as the tracer needs them.
bool HasFinitePoint(vtkDataObject* part)
{
  bool isFound = false;
  ForEachPolyData(part,
    [&isFound](vtkPolyData* polyData)
    {
      for (vtkIdType i = 0; !isFound && i < polyData->GetNumberOfPoints(); ++i)
      {
        const double* point = polyData->GetPoint(i);
        isFound = std::all_of(
          point, point + 3, [](double coordinate) { return std::abs(coordinate) < VTK_FLOAT_MAX; });
      }
    });
  return isFound;
}
}

void ForEachPolyData(vtkDataObject* part, const std::function<void(vtkPolyData*)>& visit)
{
  auto* tree = vtkDataObjectTree::SafeDownCast(part);
  if (!tree)
  {
    if (auto* polyData = vtkPolyData::SafeDownCast(part))
    {
      visit(polyData);
    }
    return;
  }
  vtkSmartPointer<vtkDataObjectTreeIterator> iterator;
  iterator.TakeReference(tree->NewTreeIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    if (auto* polyData = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject()))
    {
      visit(polyData);
    }
  }
}

bool IsSceneName(const std::string& input)
{
  return vtkCSLFSceneSource::HasScene(input.c_str()) || IsReadable(input);
}

Part ReadScenePart(const std::string& input, std::optional<double> time)
{
  if (vtkCSLFSceneSource::HasScene(input.c_str()))
  {
    vtkNew<vtkCSLFSceneSource> source;
    source->SetSceneName(input.c_str());
    source->Update();
    return source->GetOutputDataObject(0);
  }
  const std::filesystem::path path = ToPath(input);
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
  {
    throw Failure("There is no file " + input + ".");
  }
  if (!IsReadable(input))
  {
    std::set<std::string> extensions = { CollectionExtension };
    for (const auto& item : GetFileReaders())
    {
      extensions.insert(item.first);
    }
    throw Failure(input + " is not a scene: supported are " + Join(extensions) +
      ", series of these (.vtp.series) and the names that cslf scenes lists.");
  }
  Part part;
  try
  {
    RequireReadable(input);
    part = MakePartSound(ReadAt(input, time), input);
  }
  catch (const Failure& failure)
  {
    const std::string text = failure.what();
    const std::string prefix = "Cannot read " + input + ": ";
    throw Failure(text.rfind(prefix, 0) == 0 ? text : prefix + text);
  }
  catch (const std::bad_alloc&)
  {
    throw Failure("Cannot read " + input + ": there is not enough memory.");
  }
  catch (const std::exception&)
  {
    // The standard library's messages about wrong sizes do not help users.
    throw Failure("Cannot read " + input + ": it is damaged or too large.");
  }
  const std::string error = GetFirstError();
  vtkIdType cells = 0;
  tool::ForEachPolyData(
    part, [&](vtkPolyData* polyData) { cells += polyData->GetNumberOfCells(); });
  if (cells == 0 || !error.empty())
  {
    // Some readers only warn of files that they cannot read.
    const std::vector<std::string> warnings = GetWarnings();
    const std::string cause = warnings.empty() ? "it has no cells." : warnings.back();
    throw Failure("Cannot read " + input + ": " + (error.empty() ? cause : error));
  }
  if (!HasFinitePoint(part))
  {
    throw Failure("Cannot read " + input + ": the coordinates of its points are not finite.");
  }
  return part;
}

std::vector<double> FindSceneTimes(const std::string& fileName)
{
  std::vector<double> times;
  try
  {
    for (const auto& step : FindTimedFiles(fileName))
    {
      times.push_back(step.first);
    }
    return times.empty() && MayHaveTimes(fileName) ? FindXMLTimes(fileName) : times;
  }
  catch (const Failure& problem)
  {
    throw Failure("Cannot read " + fileName + ": " + problem.what());
  }
}
}
