// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfOBJReader.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Files/cslfFileSystem.h"
#include "cslfJoin.h"
#include "cslfOBJMaterials.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cslf::tool
{
namespace
{
namespace fs = std::filesystem;

/// The indices of a vertex, a texture coordinate and a normal, from 0 on; -1 for none.
using Corner = std::array<int, 3>;
enum Kinds
{
  Vertex,
  TCoord,
  Normal
};

/// A point, a line or a polygon: a range of all corners.
struct Cell
{
  int Dimension;
  std::size_t First;
  std::size_t Count;
  std::size_t Line; // of the file
};

/// Cells of one material that all have, or all lack, texture coordinates and normals.
struct Block
{
  std::string Material;
  bool HasTCoords;
  bool HasNormals;
  std::vector<Cell> Cells;
};

/// What the file contains.
struct Content
{
  std::vector<std::array<double, 3>> Vertices;
  std::vector<std::array<double, 4>> Colors; // of each vertex, or none
  bool HasAlpha = false;
  std::vector<std::array<float, 2>> TCoords;
  std::vector<std::array<float, 3>> Normals;
  std::vector<Corner> Corners;
  std::vector<Block> Blocks;
};

class FileReader
{
public:
  explicit FileReader(const std::string& fileName)
    : FileName(fileName)
    , Bytes(ReadBytes(fileName))
    , Lines(this->Bytes)
  {
  }

  Content Read()
  {
    while (this->Lines.Next())
    {
      this->IsIncomplete = false;
      if (!this->Lines.GetWords().empty())
      {
        this->ReadLine(this->Lines.GetWords()[0]);
      }
    }
    // A truncated file may end within a line.
    if (this->IsIncomplete)
    {
      this->Fail("is incomplete: the file is truncated", this->Lines.GetNumber());
    }
    if (this->Found.Blocks.empty() && !this->Found.Vertices.empty())
    {
      this->AddAllVertices();
    }
    this->CheckCorners();
    this->UsePaint();
    if (this->Short > 0)
    {
      AddWarning(std::to_string(this->Short) + " line(s) and face(s) of " + this->FileName +
        " were left out: they have too few corners.");
    }
    if (!this->Ignored.empty())
    {
      AddWarning("Unsupported features of " + this->FileName +
        " were ignored: " + Join(this->Ignored) + ".");
    }
    return std::move(this->Found);
  }

  /// The names of the libraries, in the order of the file.
  const std::vector<std::string>& GetLibraries() const { return this->Libraries; }

private:
  void ReadLine(std::string_view command)
  {
    static const std::set<std::string_view> freeForms = { "curv", "curv2", "surf" };
    if (command == "v")
    {
      this->ReadVertex();
    }
    else if (command == "vt")
    {
      const auto& numbers = this->ReadNumbers(1, 3);
      this->Found.TCoords.push_back({ static_cast<float>(numbers[0]),
        numbers.size() > 1 ? static_cast<float>(numbers[1]) : 0.0f });
    }
    else if (command == "vn")
    {
      const auto& numbers = this->ReadNumbers(3, 3);
      this->Found.Normals.push_back({ static_cast<float>(numbers[0]),
        static_cast<float>(numbers[1]), static_cast<float>(numbers[2]) });
    }
    else if (command == "f" || command == "l" || command == "p")
    {
      this->ReadCell(command == "f" ? 2 : command == "l" ? 1 : 0);
    }
    else if (command == "usemtl")
    {
      this->Material = DropComment(this->Lines.GetRest(1));
    }
    else if (command == "mtllib")
    {
      this->AddLibraries();
    }
    else if (command == "#MRGB" && this->Lines.GetWords().size() > 1)
    {
      this->ReadPaint(this->Lines.GetWords()[1]);
    }
    else if (freeForms.count(command) > 0)
    {
      this->Ignored.insert("free-form curves and surfaces");
    }
  }

  /// The words after the first, up to a comment.
  std::size_t CountWords() const
  {
    const auto& words = this->Lines.GetWords();
    const auto comment = std::find_if(
      words.begin(), words.end(), [](std::string_view word) { return word[0] == '#'; });
    return static_cast<std::size_t>(comment - words.begin()) - 1;
  }

  /// Numbers, of which those beyond `most` are ignored.
  const std::vector<double>& ReadNumbers(std::size_t least, std::size_t most)
  {
    const std::size_t count = this->CountWords();
    if (count < least)
    {
      this->Fail("has too few values", this->Lines.GetNumber());
    }
    if (count > most)
    {
      this->Ignored.insert("more than " + std::to_string(most) + " values of " +
        std::string(this->Lines.GetWords()[0]));
    }
    this->Numbers.clear();
    for (std::size_t i = 1; i <= std::min(count, most); ++i)
    {
      const std::optional<double> number = ToFinite(this->Lines.GetWords()[i]);
      if (!number)
      {
        this->Fail("has a value that is not a finite number", this->Lines.GetNumber());
      }
      this->Numbers.push_back(*number);
    }
    return this->Numbers;
  }

  /// Three coordinates; then a weight, which only free-form surfaces need, or a colour, to which
  /// some programs add alpha.
  void ReadVertex()
  {
    const auto& numbers = this->ReadNumbers(3, 7);
    if (numbers.size() == 5)
    {
      this->Fail(
        "has neither a weight nor a colour after its coordinates", this->Lines.GetNumber());
    }
    this->Found.Vertices.push_back({ numbers[0], numbers[1], numbers[2] });
    auto& colors = this->Found.Colors;
    if (numbers.size() >= 6)
    {
      const double alpha = numbers.size() == 7 ? numbers[6] : 1.0;
      this->Found.HasAlpha = this->Found.HasAlpha || numbers.size() == 7;
      colors.resize(this->Found.Vertices.size() - 1, White);
      colors.push_back({ numbers[3], numbers[4], numbers[5], alpha });
    }
    else if (!colors.empty())
    {
      colors.push_back(White);
    }
  }

  /// ZBrush's colours of the next vertices: a mask, which is not shown, red, green and blue, of two
  /// hexadecimal digits each.
  void ReadPaint(std::string_view digits)
  {
    for (; digits.size() >= 8; digits.remove_prefix(8))
    {
      std::uint32_t number = 0;
      const auto result = std::from_chars(digits.data(), digits.data() + 8, number, 16);
      if (result.ptr != digits.data() + 8)
      {
        break;
      }
      this->Paint.push_back({ ((number >> 16) & 255) / 255.0, ((number >> 8) & 255) / 255.0,
        (number & 255) / 255.0, 1.0 });
    }
    this->IsPaintSound = this->IsPaintSound && digits.empty();
  }

  void UsePaint()
  {
    if (this->IsPaintSound && this->Paint.size() == this->Found.Vertices.size() &&
      this->Found.Colors.empty())
    {
      this->Found.Colors = std::move(this->Paint);
    }
    else if (!this->Paint.empty() || !this->IsPaintSound)
    {
      this->Ignored.insert("#MRGB that does not fit the vertices");
    }
  }

  static constexpr std::array<double, 4> White{ 1.0, 1.0, 1.0, 1.0 };

  void ReadCell(int dimension)
  {
    const std::size_t count = this->CountWords();
    if (count < static_cast<std::size_t>(dimension + 1))
    {
      this->IsIncomplete = true;
      ++this->Short;
      return;
    }
    const std::size_t first = this->Found.Corners.size();
    bool hasTCoords = true;
    bool hasNormals = true;
    for (std::size_t i = 1; i <= count; ++i)
    {
      const Corner corner = this->ReadCorner(this->Lines.GetWords()[i]);
      hasTCoords = hasTCoords && corner[TCoord] >= 0;
      hasNormals = hasNormals && corner[Normal] >= 0;
      this->Found.Corners.push_back(corner);
    }
    this->FindBlock(hasTCoords, hasNormals)
      .Cells.push_back({ dimension, first, count, this->Lines.GetNumber() });
  }

  /// Point clouds are files of vertices alone.
  void AddAllVertices()
  {
    const std::size_t count = this->Found.Vertices.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Found.Corners.push_back({ static_cast<int>(i), -1, -1 });
    }
    this->FindBlock(false, false).Cells.push_back({ 0, 0, count, this->Lines.GetNumber() });
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn.
  Corner ReadCorner(std::string_view word)
  {
    Corner corner{ -1, -1, -1 };
    std::size_t begin = 0;
    for (int kind = Vertex; kind <= Normal; ++kind)
    {
      const std::size_t end = std::min(word.find('/', begin), word.size());
      const std::string_view text = word.substr(begin, end - begin);
      const bool isLeftOut = text.empty() && kind == TCoord && end < word.size();
      if (!isLeftOut)
      {
        corner[kind] = this->ReadIndex(text, kind);
      }
      if (end == word.size())
      {
        return corner;
      }
      begin = end + 1;
    }
    this->Fail("has an invalid index", this->Lines.GetNumber());
  }

  /// Indices count from 1 on, or backwards from -1 on.
  int ReadIndex(std::string_view text, int kind) const
  {
    text.remove_prefix(text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
    int index = 0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, index);
    if (result.ec != std::errc() || result.ptr != end)
    {
      this->Fail("has an invalid index", this->Lines.GetNumber());
    }
    const auto backwards = static_cast<std::int64_t>(this->Count(kind)) + index;
    if (index == 0 || backwards < 0)
    {
      this->FailMissing(kind, this->Lines.GetNumber());
    }
    return index > 0 ? index - 1 : static_cast<int>(backwards);
  }

  std::size_t Count(int kind) const
  {
    return kind == Vertex ? this->Found.Vertices.size()
      : kind == TCoord    ? this->Found.TCoords.size()
                          : this->Found.Normals.size();
  }

  /// A cell may come before its vertices, so this is only known at the end.
  void CheckCorners() const
  {
    for (const Block& block : this->Found.Blocks)
    {
      for (const Cell& cell : block.Cells)
      {
        for (std::size_t i = cell.First; i < cell.First + cell.Count; ++i)
        {
          for (int kind = Vertex; kind <= Normal; ++kind)
          {
            if (this->Found.Corners[i][kind] >= static_cast<std::int64_t>(this->Count(kind)))
            {
              this->FailMissing(kind, cell.Line);
            }
          }
        }
      }
    }
  }

  [[noreturn]] void FailMissing(int kind, std::size_t line) const
  {
    const char* const kinds[] = { "vertex", "texture coordinate", "normal" };
    this->Fail(std::string("has the index of a missing ") + kinds[kind], line);
  }

  [[noreturn]] void Fail(const std::string& what, std::size_t line) const
  {
    throw Failure("line " + std::to_string(line) + " " + what + ".");
  }

  Block& FindBlock(bool hasTCoords, bool hasNormals)
  {
    const auto key = std::make_tuple(this->Material, hasTCoords, hasNormals);
    const auto [found, isNew] = this->Places.emplace(key, this->Found.Blocks.size());
    if (isNew)
    {
      this->Found.Blocks.push_back({ this->Material, hasTCoords, hasNormals, {} });
    }
    return this->Found.Blocks[found->second];
  }

  /// One name with spaces, or several names.
  void AddLibraries()
  {
    const fs::path folder = ToPath(this->FileName).parent_path();
    std::error_code failure;
    const std::string whole = FindBeside(folder, this->Lines.GetRest(1));
    const bool isOne = fs::is_regular_file(ToPath(whole), failure);
    for (std::size_t i = 1; i <= (isOne ? 1 : this->CountWords()); ++i)
    {
      const std::string name =
        isOne ? whole : FindBeside(folder, std::string(this->Lines.GetWords()[i]));
      if (std::find(this->Libraries.begin(), this->Libraries.end(), name) == this->Libraries.end())
      {
        this->Libraries.push_back(name);
      }
    }
  }

  std::string FileName;
  std::string Bytes;
  TextLines Lines;
  Content Found;
  std::map<std::tuple<std::string, bool, bool>, std::size_t> Places; // of blocks
  std::string Material;
  std::vector<std::string> Libraries;
  std::vector<double> Numbers; // of the line
  std::vector<std::array<double, 4>> Paint;
  bool IsPaintSound = true;
  std::set<std::string> Ignored;
  std::size_t Short = 0;
  bool IsIncomplete = false; // the last line
};

/// Makes polygonal data of blocks. Corners that are alike are one point.
class BlockMaker
{
public:
  explicit BlockMaker(const Content& content)
    : From(content)
  {
    this->ArePointsFloats = std::all_of(content.Vertices.begin(), content.Vertices.end(),
      [](const auto& vertex) { return std::all_of(vertex.begin(), vertex.end(), FitsFloat); });
    double largest = 0.0;
    for (const auto& color : content.Colors)
    {
      largest = std::max(largest, *std::max_element(color.begin(), color.begin() + 3));
    }
    this->ColorScale = largest > 1.0 ? 1.0 : 255.0;
  }

  vtkSmartPointer<vtkPolyData> Make(const Block& block)
  {
    this->Points.clear();
    this->Ids.clear();
    std::array<vtkNew<vtkCellArray>, 3> cells;
    for (const Cell& cell : block.Cells)
    {
      cells[cell.Dimension]->InsertNextCell(static_cast<int>(cell.Count));
      for (std::size_t i = cell.First; i < cell.First + cell.Count; ++i)
      {
        cells[cell.Dimension]->InsertCellPoint(this->FindPoint(this->From.Corners[i]));
      }
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    this->SetPoints(data);
    data->SetVerts(cells[0]);
    data->SetLines(cells[1]);
    data->SetPolys(cells[2]);
    if (block.HasTCoords)
    {
      data->GetPointData()->SetTCoords(this->Gather("TCoords", TCoord, this->From.TCoords));
    }
    if (block.HasNormals)
    {
      data->GetPointData()->SetNormals(this->Gather("Normals", Normal, this->From.Normals));
    }
    if (!this->From.Colors.empty())
    {
      this->SetColors(data);
    }
    return data;
  }

private:
  struct Hash
  {
    std::size_t operator()(const Corner& corner) const
    {
      std::uint64_t hash = 0;
      for (const int index : corner)
      {
        hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
      }
      return static_cast<std::size_t>(hash);
    }
  };

  vtkIdType FindPoint(const Corner& corner)
  {
    const auto [found, isNew] =
      this->Ids.emplace(corner, static_cast<vtkIdType>(this->Points.size()));
    if (isNew)
    {
      this->Points.push_back(corner);
    }
    return found->second;
  }

  void SetPoints(vtkPolyData* data) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(this->ArePointsFloats ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      points->SetPoint(
        static_cast<vtkIdType>(i), this->From.Vertices[this->Points[i][Vertex]].data());
    }
    data->SetPoints(points);
  }

  template <std::size_t Size>
  vtkSmartPointer<vtkFloatArray> Gather(
    const char* name, int kind, const std::vector<std::array<float, Size>>& all) const
  {
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(static_cast<int>(Size));
    array->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      array->SetTypedTuple(static_cast<vtkIdType>(i), all[this->Points[i][kind]].data());
    }
    return array;
  }

  void SetColors(vtkPolyData* data) const
  {
    vtkNew<vtkUnsignedCharArray> colors;
    const int components = this->From.HasAlpha ? 4 : 3;
    colors->SetName(this->From.HasAlpha ? "RGBA" : "RGB");
    colors->SetNumberOfComponents(components);
    colors->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      const auto& color = this->From.Colors[this->Points[i][Vertex]];
      for (int c = 0; c < components; ++c)
      {
        const double byte = std::round(color[c] * (c < 3 ? this->ColorScale : 255.0));
        colors->SetTypedComponent(
          static_cast<vtkIdType>(i), c, static_cast<unsigned char>(std::clamp(byte, 0.0, 255.0)));
      }
    }
    data->GetPointData()->SetScalars(colors);
  }

  const Content& From;
  std::vector<Corner> Points;
  std::unordered_map<Corner, vtkIdType, Hash> Ids;
  bool ArePointsFloats = true;
  double ColorScale = 255.0; // from the file's values to bytes
};

/// Gives blocks the materials of their names, if these exist.
class MaterialChooser
{
public:
  MaterialChooser(const std::string& fileName, const std::vector<std::string>& libraries)
    : FileName(fileName)
  {
    for (const std::string& library : libraries)
    {
      std::error_code failure;
      std::string problem = " is missing";
      try
      {
        // Devices can be read without an end.
        if (fs::is_regular_file(ToPath(library), failure))
        {
          this->Materials.ReadLibrary(library);
          continue;
        }
      }
      catch (const Failure&)
      {
        problem = " cannot be opened";
      }
      AddWarning("The material library " + library + " of " + fileName + problem +
        ": its materials are shown in the default colour.");
      this->IsLibraryMissing = true;
    }
  }

  /// Joins the blocks whose materials do not exist, with the cells in the order of the file.
  std::vector<Block> JoinUnknown(const std::vector<Block>& blocks)
  {
    std::vector<Block> joined;
    std::map<std::pair<bool, bool>, std::size_t> places;
    std::set<std::string> unknown;
    for (const Block& block : blocks)
    {
      if (this->Materials.Has(block.Material))
      {
        joined.push_back(block);
        continue;
      }
      unknown.insert(block.Material);
      const auto key = std::make_pair(block.HasTCoords, block.HasNormals);
      const auto [found, isNew] = places.emplace(key, joined.size());
      if (isNew)
      {
        joined.push_back({ {}, block.HasTCoords, block.HasNormals, {} });
      }
      std::vector<Cell>& cells = joined[found->second].Cells;
      cells.insert(cells.end(), block.Cells.begin(), block.Cells.end());
    }
    for (Block& block : joined)
    {
      std::sort(block.Cells.begin(), block.Cells.end(),
        [](const Cell& a, const Cell& b) { return a.Line < b.Line; });
    }
    unknown.erase("");
    if (!unknown.empty() && !this->IsLibraryMissing)
    {
      this->WarnOf(unknown);
    }
    return joined;
  }

  /// Gives a block its material, if it has one.
  void Apply(const std::string& name, vtkPolyData* block)
  {
    if (this->Materials.Has(name))
    {
      this->Materials.Apply(name, block);
    }
  }

private:
  void WarnOf(const std::set<std::string>& unknown) const
  {
    constexpr std::size_t most = 8;
    const std::size_t count = std::min(most, unknown.size());
    const std::vector<std::string> first(unknown.begin(), std::next(unknown.begin(), count));
    AddWarning("Materials that " + this->FileName +
      " uses but no library defines have the default colour: " + Join(first) +
      (count < unknown.size() ? " and " + std::to_string(unknown.size() - count) + " more." : "."));
  }

  std::string FileName;
  OBJMaterials Materials;
  bool IsLibraryMissing = false;
};
}

vtkSmartPointer<vtkDataObject> ReadOBJ(const std::string& fileName)
{
  FileReader reader(fileName);
  const Content content = reader.Read();
  BlockMaker maker(content);
  MaterialChooser materials(fileName, reader.GetLibraries());
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (const Block& block : materials.JoinUnknown(content.Blocks))
  {
    const auto data = maker.Make(block);
    materials.Apply(block.Material, data);
    const unsigned int place = blocks->GetNumberOfBlocks();
    blocks->SetBlock(place, data);
    blocks->GetMetaData(place)->Set(vtkCompositeDataSet::NAME(), block.Material.c_str());
  }
  if (blocks->GetNumberOfBlocks() == 1)
  {
    return blocks->GetBlock(0);
  }
  return blocks.Get();
}
}
