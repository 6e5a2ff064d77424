// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSTLReader.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Files/cslfFileSystem.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

namespace cslf::tool
{
namespace
{
using Point = std::array<double, 3>;

constexpr std::uintmax_t BytesLookedAt = 1024;
constexpr std::uintmax_t HeaderSize = 84; // the last four bytes count the triangles
constexpr std::uintmax_t TriangleSize = 50;

/// The first bytes of a file, and its size.
class Beginning
{
public:
  explicit Beginning(const std::string& fileName)
  {
    std::ifstream file(ToPath(fileName), std::ios::binary);
    std::error_code failure;
    this->Size = std::filesystem::file_size(ToPath(fileName), failure);
    this->Bytes.resize(std::min<std::uintmax_t>(this->Size, BytesLookedAt));
    file.read(this->Bytes.data(), static_cast<std::streamsize>(this->Bytes.size()));
  }

  /// Headers of binary files may begin like text, but then the number of triangles fits the size,
  /// or there are zeros, as after each triangle. The name of a solid may have letters beyond ASCII.
  bool IsText() const
  {
    if (this->Size >= HeaderSize &&
      this->Size == HeaderSize + TriangleSize * this->CountTriangles())
    {
      return false;
    }
    const std::size_t first = this->Bytes.find_first_not_of(" \t\r\n");
    return first != std::string::npos && ToLower(this->Bytes.substr(first, 5)) == "solid" &&
      this->Bytes.find('\0') == std::string::npos;
  }

  void CheckBinary() const
  {
    if (this->Size < HeaderSize)
    {
      throw Failure("it is too short for the header of a binary STL file.");
    }
    const std::uintmax_t triangles = this->CountTriangles();
    const std::uintmax_t present = (this->Size - HeaderSize) / TriangleSize;
    if (present < triangles)
    {
      throw Failure("it is truncated: it has " + std::to_string(present) + " of " +
        std::to_string(triangles) + " triangles.");
    }
  }

private:
  /// The number that a binary file gives.
  std::uintmax_t CountTriangles() const
  {
    std::uintmax_t triangles = 0;
    for (int i = 1; i <= 4; ++i)
    {
      triangles = triangles << 8 | static_cast<unsigned char>(this->Bytes[HeaderSize - i]);
    }
    return triangles;
  }

  std::uintmax_t Size = 0;
  std::string Bytes;
};

/// Points, of which equal ones are one, and triangles.
class Triangles
{
public:
  void Add(const std::array<Point, 3>& corners)
  {
    std::array<vtkIdType, 3> ids{};
    std::transform(corners.begin(), corners.end(), ids.begin(),
      [this](const Point& corner) { return this->FindPoint(corner); });
    if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0])
    {
      this->Cells->InsertNextCell(3, ids.data());
    }
  }

  vtkSmartPointer<vtkPolyData> GetData() const
  {
    const bool areFloats = std::all_of(this->Points.begin(), this->Points.end(),
      [](const Point& point) { return std::all_of(point.begin(), point.end(), FitsFloat); });
    vtkNew<vtkPoints> points;
    points->SetDataType(areFloats ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), this->Points[i].data());
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(this->Cells);
    return data;
  }

private:
  struct Hash
  {
    std::size_t operator()(const Point& point) const
    {
      std::size_t hash = 0;
      for (const double coordinate : point)
      {
        hash = 31 * hash + std::hash<double>()(coordinate);
      }
      return hash;
    }
  };

  vtkIdType FindPoint(const Point& point)
  {
    const auto [found, isNew] =
      this->Ids.emplace(point, static_cast<vtkIdType>(this->Points.size()));
    if (isNew)
    {
      this->Points.push_back(point);
    }
    return found->second;
  }

  std::vector<Point> Points;
  std::unordered_map<Point, vtkIdType, Hash> Ids;
  vtkNew<vtkCellArray> Cells;
};

/// Reads a text file word by word; only the names of solids end with a line.
class TextReader
{
public:
  explicit TextReader(std::string_view text)
    : Lines(text)
  {
  }

  vtkSmartPointer<vtkPolyData> Read()
  {
    bool isOpen = false;
    for (std::string word = this->TakeWord(); !word.empty(); word = this->TakeWord())
    {
      if (word == "solid" || word == "endsolid")
      {
        isOpen = word == "solid";
        this->Word = this->Lines.GetWords().size();
      }
      else if (word == "vertex")
      {
        this->Corners.push_back({ this->TakeNumber(), this->TakeNumber(), this->TakeNumber() });
      }
      else if (word == "normal")
      {
        // Some programs write NaN for triangles without an area. The corners determine normals.
        this->Word += 3;
      }
      else if (word == "endloop" || word == "endfacet" || word == "facet")
      {
        this->EndLoop();
      }
      else if (word != "outer" && word != "loop")
      {
        this->Fail("has an unknown word");
      }
    }
    if (isOpen)
    {
      throw Failure("it is truncated: its last solid has no endsolid.");
    }
    this->EndLoop();
    return this->Found.GetData();
  }

private:
  /// In lower case, and empty at the end of the file.
  std::string TakeWord()
  {
    while (this->Word >= this->Lines.GetWords().size())
    {
      if (!this->Lines.Next())
      {
        return {};
      }
      this->Word = 0;
    }
    return ToLower(this->Lines.GetWords()[this->Word++]);
  }

  double TakeNumber()
  {
    const std::string word = this->TakeWord();
    const std::optional<double> number = ToFinite(word);
    if (!number)
    {
      this->Fail(word.empty() ? "is incomplete" : "has a value that is not a finite number");
    }
    return *number;
  }

  void EndLoop()
  {
    if (this->Corners.empty())
    {
      return;
    }
    if (this->Corners.size() != 3)
    {
      this->Fail("ends a facet of " + std::to_string(this->Corners.size()) + " corners");
    }
    this->Found.Add({ this->Corners[0], this->Corners[1], this->Corners[2] });
    this->Corners.clear();
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw Failure("line " + std::to_string(this->Lines.GetNumber()) + " " + what + ".");
  }

  TextLines Lines;
  std::size_t Word = 0; // the next one of the line
  std::vector<Point> Corners;
  Triangles Found;
};
}

vtkSmartPointer<vtkPolyData> ReadSTL(const std::string& fileName)
{
  const Beginning beginning(fileName);
  if (beginning.IsText())
  {
    const std::string text = ReadBytes(fileName);
    return TextReader(text).Read();
  }
  beginning.CheckBinary();
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  return reader->GetOutput();
}
}
