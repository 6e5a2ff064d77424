// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGridReader.h"

#include "Pipeline/cslfArrayLayout.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Fields/cslfSceneChecks.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "cslfDescription.h"
#include "cslfGridText.h"
#include "cslfJoin.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkDataReader.h>
#include <vtkDataSet.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFieldData.h>
#include <vtkGenericCell.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSMPTools.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVertexGlyphFilter.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLPPolyDataReader.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetReader.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <system_error>
#include <vector>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#endif

namespace cslf::tool
{
namespace
{
using Part = vtkSmartPointer<vtkDataObject>;

// A legacy file is not compressed, but image data without values needs only its size.
constexpr double PointsPerByte = 1000.0;
constexpr double MinimumLimit = 65536.0;

// The memory for reading a legacy file: a digit and a space become a double or an index, of which
// several copies are made.
constexpr double BytesPerByte = 100.0;
constexpr double MinimumMemory = 1073741824.0;

constexpr const char* Damaged = "it is damaged.";

/// Removes the arrays that have fewer tuples than there are points or cells.
void RemoveShortArrays(
  vtkDataSetAttributes* attributes, vtkIdType tuples, std::set<std::string>& removed)
{
  for (int i = attributes->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < tuples)
    {
      removed.insert(
        "array " + std::string(array->GetName() ? array->GetName() : "(without a name)"));
      attributes->RemoveArray(i);
    }
  }
}

/// Whether cells have the number of points that their type needs.
class CellTypes
{
public:
  bool Fit(int type, vtkIdType points)
  {
    const auto [found, isNew] = this->Sizes.emplace(type, -1);
    if (isNew)
    {
      vtkSmartPointer<vtkCell> cell;
      cell.TakeReference(vtkGenericCell::InstantiateCell(type));
      // Lagrange and Bezier cells have the points of the lowest order until their own are set.
      const bool isOfAnyOrder = type >= VTK_LAGRANGE_CURVE && type <= VTK_BEZIER_PYRAMID;
      found->second = !cell ? -1 : isOfAnyOrder ? 0 : cell->GetNumberOfPoints();
    }
    // Types of any size have no points yet.
    return found->second == 0 ? points > 0 : points == found->second;
  }

private:
  std::map<int, vtkIdType> Sizes;
};

/// The cells of a grid whose points exist and whose types are known, with their data. The grid
/// itself if that is all of them.
vtkSmartPointer<vtkUnstructuredGrid> KeepSoundCells(
  vtkUnstructuredGrid* grid, std::set<std::string>& removed)
{
  vtkCellArray* cells = grid->GetCells();
  const vtkIdType count = grid->GetNumberOfCells();
  if (count == 0)
  {
    return grid;
  }
  if (!cells->IsValid())
  {
    throw Failure(Damaged);
  }
  CellTypes types;
  vtkNew<vtkIdList> sound;
  const vtkIdType points = grid->GetNumberOfPoints();
  auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(size, ids);
    const vtkIdType id = cell->GetCurrentCellId();
    if (std::all_of(ids, ids + size, [points](vtkIdType i) { return i >= 0 && i < points; }) &&
      types.Fit(grid->GetCellType(id), size))
    {
      sound->InsertNextId(id);
    }
  }
  if (sound->GetNumberOfIds() == count)
  {
    return grid;
  }
  removed.insert(std::to_string(count - sound->GetNumberOfIds()) + " cell(s)");
  auto kept = vtkSmartPointer<vtkUnstructuredGrid>::New();
  kept->SetPoints(grid->GetPoints());
  kept->GetPointData()->ShallowCopy(grid->GetPointData());
  kept->GetFieldData()->ShallowCopy(grid->GetFieldData());
  const auto all = KeepNumeric(grid->GetCellData());
  kept->GetCellData()->CopyAllOn();
  kept->GetCellData()->CopyAllocate(all, sound->GetNumberOfIds());
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < sound->GetNumberOfIds(); ++i)
  {
    // The faces of a polyhedron, the points of any other cell.
    grid->GetFaceStream(sound->GetId(i), ids);
    kept->InsertNextCell(grid->GetCellType(sound->GetId(i)), ids);
    kept->GetCellData()->CopyData(all, sound->GetId(i), i);
  }
  return kept;
}

/// Whether values increase or decrease all the way. VTK reads an axis with too few values as it is.
bool IsMonotonic(vtkDataArray* axis)
{
  bool increases = true;
  bool decreases = true;
  for (vtkIdType i = 1; i < axis->GetNumberOfTuples(); ++i)
  {
    increases = increases && axis->GetTuple1(i) >= axis->GetTuple1(i - 1);
    decreases = decreases && axis->GetTuple1(i) <= axis->GetTuple1(i - 1);
  }
  return increases || decreases;
}

/// Whether structured data have as many points as their extent says.
bool HasItsPoints(vtkDataSet* data)
{
  if (data->GetNumberOfPoints() < 0 || data->GetNumberOfCells() < 0)
  {
    return false;
  }
  if (auto* grid = vtkStructuredGrid::SafeDownCast(data))
  {
    int size[3];
    grid->GetDimensions(size);
    const double points = 1.0 * size[0] * size[1] * size[2];
    return !grid->GetPoints() ||
      static_cast<double>(grid->GetPoints()->GetNumberOfPoints()) == points;
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    int size[3];
    grid->GetDimensions(size);
    const std::array<vtkDataArray*, 3> axes = { grid->GetXCoordinates(), grid->GetYCoordinates(),
      grid->GetZCoordinates() };
    return std::equal(axes.begin(), axes.end(), size,
      [](vtkDataArray* axis, int points)
      { return axis && axis->GetNumberOfValues() == points && IsMonotonic(axis); });
  }
  return true;
}

/// Makes surfaces, and collects what to say about them.
class SurfaceMaker
{
public:
  explicit SurfaceMaker(double mostPoints)
    : MaximumPoints(mostPoints)
  {
  }

  vtkSmartPointer<vtkPolyData> Make(vtkDataSet* data)
  {
    auto* points = vtkPointSet::SafeDownCast(data);
    if (points && points->GetNumberOfCells() == 0 && points->GetNumberOfPoints() > 0)
    {
      return this->ShowPoints(points);
    }
    if (auto* polyData = vtkPolyData::SafeDownCast(data))
    {
      return polyData;
    }
    if (data->GetFieldData()->GetAbstractArray(Description::FieldDataName))
    {
      throw Failure("it is a light field, not a scene.");
    }
    if (static_cast<double>(data->GetNumberOfPoints()) > this->MaximumPoints)
    {
      throw Failure("it announces " + std::to_string(data->GetNumberOfPoints()) +
        " points, more than the file can hold.");
    }
    if (!HasItsPoints(data))
    {
      throw Failure("it does not have as many points as its dimensions say.");
    }
    auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
    copy->ShallowCopy(data);
    RemoveShortArrays(copy->GetPointData(), copy->GetNumberOfPoints(), this->Removed);
    RemoveShortArrays(copy->GetCellData(), copy->GetNumberOfCells(), this->Removed);
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(copy))
    {
      copy = KeepSoundCells(grid, this->Removed);
    }
    vtkNew<vtkDataSetSurfaceFilter> filter;
    filter->SetInputData(copy);
    filter->Update();
    vtkSmartPointer<vtkPolyData> surface = filter->GetOutput();
    surface->GetFieldData()->ShallowCopy(data->GetFieldData());
    this->AddColors(surface);
    return surface;
  }

  /// Records a part that has no surface.
  void Remove(const std::string& what) { this->Removed.insert(what); }

  void Warn(const std::string& fileName) const
  {
    if (this->Surfaces > 0)
    {
      AddWarning("Of the cells of " + fileName + ", the surface is shown. " +
        (this->Colors.empty() ? "No scalars are active."
                              : "Its active scalars are " + Join(this->Colors) + "."));
    }
    if (!this->Removed.empty())
    {
      AddWarning("Parts of " + fileName +
        " that are invalid or have no surface were left out: " + Join(this->Removed) + ".");
    }
  }

private:
  /// Points without cells, as of particles.
  vtkSmartPointer<vtkPolyData> ShowPoints(vtkPointSet* data)
  {
    auto copy = vtkSmartPointer<vtkPointSet>::Take(data->NewInstance());
    copy->ShallowCopy(data);
    RemoveShortArrays(copy->GetPointData(), copy->GetNumberOfPoints(), this->Removed);
    vtkNew<vtkVertexGlyphFilter> filter;
    filter->SetInputData(copy);
    filter->Update();
    vtkSmartPointer<vtkPolyData> result = filter->GetOutput();
    result->GetFieldData()->ShallowCopy(data->GetFieldData());
    return result;
  }

  void AddColors(vtkPolyData* surface)
  {
    if (surface->GetNumberOfCells() == 0)
    {
      return;
    }
    ++this->Surfaces;
    vtkDataArray* scalars = surface->GetPointData()->GetScalars();
    scalars = scalars ? scalars : surface->GetCellData()->GetScalars();
    if (scalars)
    {
      this->Colors.insert(scalars->GetName() ? scalars->GetName() : "(without a name)");
    }
  }

  double MaximumPoints;
  int Surfaces = 0;
  std::set<std::string> Removed;
  std::set<std::string> Colors; // the names of arrays
};

/// Data sets, of which trees have many, as polygonal data.
Part ToSurfaces(vtkDataObject* data, SurfaceMaker& maker)
{
  if (auto* single = vtkDataSet::SafeDownCast(data))
  {
    return maker.Make(single);
  }
  auto* tree = vtkDataObjectTree::SafeDownCast(data);
  if (!tree)
  {
    throw Failure(data
        ? std::string("it has data of the type ") + data->GetClassName() + ", which has no surface."
        : Damaged);
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->GetFieldData()->ShallowCopy(tree->GetFieldData());
  vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
  leaf.TakeReference(tree->NewTreeIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* block = leaf->GetCurrentDataObject();
    if (auto* single = vtkDataSet::SafeDownCast(block))
    {
      blocks->SetBlock(blocks->GetNumberOfBlocks(), maker.Make(single));
    }
    else
    {
      maker.Remove(std::string("data of the type ") + block->GetClassName());
    }
  }
  return blocks;
}

#ifndef _WIN32
/// Limits the memory that this process may have in addition to what it has. Not everywhere is the
/// latter known.
void LimitMemory(double bytes)
{
  double pages = 0.0;
  if (std::ifstream("/proc/self/statm") >> pages)
  {
    const double most = pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) + bytes;
    struct rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && most < static_cast<double>(limit.rlim_cur))
    {
      limit.rlim_cur = static_cast<rlim_t>(most);
      ::setrlimit(RLIMIT_AS, &limit);
    }
  }
}

/// Reads in a copy of this process, and writes what is wrong to a pipe.
[[noreturn]] void Try(const std::function<void()>& read, double mostBytes, int pipe)
{
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  // Threads are not copied.
  vtkSMPTools::SetBackend("Sequential");
  LimitMemory(mostBytes);
  std::string error;
  try
  {
    read();
  }
  catch (const std::bad_alloc&)
  {
    error = "it announces more than it can hold.";
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
  }
  const bool isWritten = ::write(pipe, error.data(), error.size()) == ssize_t(error.size());
  ::_exit(isWritten ? 0 : 1);
}
#endif

/// Reads in a process of its own, with a limit for its memory, and throws a Failure if that ends in
/// any way but well. VTK's readers of legacy files and of grids trust the numbers in them: damaged
/// ones make them read and write out of bounds. Does nothing on Windows, and if there cannot be
/// another process.
void RequireSafe(const std::function<void()>& read, double mostBytes)
{
#ifdef _WIN32
  (void)read;
  (void)mostBytes;
#else
  int ends[2];
  if (::pipe(ends) != 0)
  {
    return;
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    ::close(ends[0]);
    Try(read, mostBytes, ends[1]);
  }
  ::close(ends[1]);
  std::string error;
  char letters[256];
  for (ssize_t count = 1; child > 0 && count != 0;)
  {
    count = ::read(ends[0], letters, sizeof(letters));
    error.append(letters, static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    count = count < 0 && errno != EINTR ? 0 : count;
  }
  ::close(ends[0]);
  int status = 0;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (child > 0 && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
  {
    throw Failure(Damaged);
  }
  if (!error.empty())
  {
    throw Failure(error);
  }
#endif
}

/// Throws a Failure if VTK has only warned of values that it could not read.
void RequireValues()
{
  for (const std::string& warning : GetWarnings())
  {
    if (warning.rfind("Error reading", 0) == 0)
    {
      throw Failure(warning);
    }
  }
}

/// Whether a file may be of the formats that IsEmptyGrid knows.
bool IsXMLGrid(const std::string& fileName)
{
  const std::string extension = ToLower(ToName(ToPath(fileName).extension()));
  return extension == ".vtp" || extension == ".vtu";
}

/// Legacy files may have several arrays of a kind, of which their reader takes one unless it is
/// asked for all.
void ReadAllArrays(vtkDataReader* reader)
{
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
}

void ReadAllArrays(vtkXMLReader*) {}

/// Reads a file, or the text that stands for it unless that is empty.
template <typename Reader>
Part Read(const std::string& fileName, double mostPoints, double mostBytes,
  const std::string& text = std::string(), std::optional<double> time = std::nullopt)
{
  const auto read = [&](SurfaceMaker& maker)
  {
    vtkNew<Reader> reader;
    reader->SetFileName(fileName.c_str());
    ReadAllArrays(reader.Get());
    if (!text.empty())
    {
      reader->SetReadFromInputString(true);
      reader->SetInputString(text);
    }
    if (time)
    {
      reader->UpdateTimeStep(*time);
    }
    reader->Update();
    ThrowOnError();
    RequireValues();
    if (!text.empty())
    {
      RestoreNotFinite(reader->GetOutputDataObject(0));
    }
    return ToSurfaces(reader->GetOutputDataObject(0), maker);
  };
  RequireSafe(
    [&]
    {
      SurfaceMaker maker(mostPoints);
      read(maker);
    },
    mostBytes);
  SurfaceMaker maker(mostPoints);
  Part part = read(maker);
  maker.Warn(fileName);
  return part;
}
}

vtkSmartPointer<vtkDataObject> ReadXMLGrid(const std::string& fileName, std::optional<double> time)
{
  CheckVTKXML(fileName);
  // Extents and numbers of values are checked.
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const std::string extension = ToLower(ToName(ToPath(fileName).extension()));
  if (extension == ".pvtp" || extension == ".pvtu")
  {
    const std::string text = LeaveOutEmptyPieces(fileName);
    if (!text.empty())
    {
      return extension == ".pvtp"
        ? Read<vtkXMLPPolyDataReader>(fileName, unlimited, unlimited, text)
        : Read<vtkXMLPUnstructuredGridReader>(fileName, unlimited, unlimited, text);
    }
  }
  // VTK's generic reader knows these two since 9.2 only.
  return extension == ".vtpd" ? Read<vtkXMLPartitionedDataSetReader>(fileName, unlimited, unlimited)
    : extension == ".vtpc"
    ? Read<vtkXMLPartitionedDataSetCollectionReader>(fileName, unlimited, unlimited)
    : Read<vtkXMLGenericDataObjectReader>(fileName, unlimited, unlimited, {}, time);
}

std::vector<double> FindXMLTimes(const std::string& fileName)
{
  // The element of the data has them in an attribute. Who reads the file reports what is wrong.
  const SeparateMessages messages;
  vtkSmartPointer<vtkXMLDataElement> root;
  try
  {
    root = ReadVTKXML(fileName);
  }
  catch (const Failure&)
  {
    return {};
  }
  const char* type = root ? root->GetAttribute("type") : nullptr;
  vtkXMLDataElement* data = type ? root->FindNestedElementWithName(type) : nullptr;
  const char* text = data ? data->GetAttribute("TimeValues") : nullptr;
  std::vector<double> times;
  for (const std::string_view word : Split(text ? text : ""))
  {
    times.push_back(ToFinite(word).value_or(0.0));
  }
  return times;
}

vtkSmartPointer<vtkDataObject> ReadLegacyGrid(const std::string& fileName)
{
  std::error_code failure;
  const auto size = std::filesystem::file_size(ToPath(fileName), failure);
  const double bytes = failure ? 0.0 : static_cast<double>(size);
  return Read<vtkGenericDataObjectReader>(fileName, std::max(PointsPerByte * bytes, MinimumLimit),
    BytesPerByte * bytes + MinimumMemory, ReplaceNotFinite(fileName));
}

TimedFiles FindCollected(const std::string& fileName)
{
  const auto root = ReadVTKXML(fileName);
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  TimedFiles steps;
  for (int i = 0; collection && i < collection->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    const char* time = element->GetAttribute("timestep");
    const char* file = element->GetAttribute("file");
    const std::optional<double> number = time ? ToFinite(time) : 0.0;
    if (!file || !number)
    {
      throw Failure(
        "its entry " + std::to_string(i + 1) + " has no " + (file ? "valid time step." : "file."));
    }
    steps[*number].push_back(ToName(ToPath(fileName).parent_path() / ToPath(file)));
  }
  if (steps.empty())
  {
    throw Failure("it is not a collection of files.");
  }
  return steps;
}

TimedFiles FindSeries(const std::string& fileName)
{
  std::string error;
  const auto series = FileSeries::Read(fileName, error);
  if (!series)
  {
    throw Failure(error + ".");
  }
  TimedFiles steps;
  for (std::size_t step = 0; step < series->Files.size(); ++step)
  {
    steps[series->Files[step].Time].push_back(series->GetPath(step, fileName));
  }
  return steps;
}

vtkSmartPointer<vtkDataObject> ReadBlocks(const std::vector<std::string>& fileNames,
  const std::function<vtkSmartPointer<vtkDataObject>(const std::string&)>& read)
{
  std::map<std::string, Part> parts;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const std::string& file : fileNames)
  {
    Part& part = parts[file];
    if (!part && !(IsXMLGrid(file) && IsEmptyGrid(file)))
    {
      part = read(file);
    }
    if (part)
    {
      blocks->SetBlock(blocks->GetNumberOfBlocks(), part);
    }
  }
  return blocks;
}
}
