// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPLYReader.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "cslfPLYHeader.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

namespace cslf::tool
{
namespace
{
/// The properties that make up a vector: their indices in the element.
using Places = std::vector<int>;

/// Finds the properties if all of them exist; none if one is missing.
Places FindAll(const PLYElement& element, std::initializer_list<const char*> names)
{
  Places places;
  for (const char* name : names)
  {
    const int place = element.Find(name, false);
    if (place < 0)
    {
      return {};
    }
    places.push_back(place);
  }
  return places;
}

/// Colours as bytes, from bytes or from fractions of the largest number.
class Colors
{
public:
  explicit Colors(const PLYElement& element)
    : From(FindAll(element, { "red", "green", "blue" }))
  {
    if (this->From.empty())
    {
      this->From = FindAll(element, { "diffuse_red", "diffuse_green", "diffuse_blue" });
    }
    const Places alpha = FindAll(element, { "alpha" });
    if (!this->From.empty() && !alpha.empty())
    {
      this->From.push_back(alpha[0]);
    }
    for (int place : this->From)
    {
      const PLYType& type = element.Properties[place].Type;
      this->Factors.push_back(
        type.IsFloat ? 255.0 : 255.0 / (std::pow(2.0, 8.0 * static_cast<double>(type.Size)) - 1.0));
    }
    this->Array->SetName(this->From.size() == 4 ? "RGBA" : "RGB");
    this->Array->SetNumberOfComponents(std::max<int>(static_cast<int>(this->From.size()), 1));
  }

  void Add(const std::vector<double>& row)
  {
    for (std::size_t i = 0; i < this->From.size(); ++i)
    {
      const double byte = std::round(row[this->From[i]] * this->Factors[i]);
      // NaN becomes 0.
      this->Array->InsertNextValue(
        static_cast<unsigned char>(byte > 0.0 ? std::min(byte, 255.0) : 0.0));
    }
  }

  void SetTo(vtkDataSetAttributes* attributes)
  {
    if (!this->From.empty())
    {
      attributes->SetScalars(this->Array);
    }
  }

private:
  Places From;
  std::vector<double> Factors;
  vtkNew<vtkUnsignedCharArray> Array;
};

/// Vectors of floats.
class Vectors
{
public:
  Vectors(const char* name, Places from)
    : From(std::move(from))
  {
    this->Array->SetName(name);
    this->Array->SetNumberOfComponents(std::max<int>(static_cast<int>(this->From.size()), 1));
  }

  void Add(const std::vector<double>& row)
  {
    for (int place : this->From)
    {
      this->Array->InsertNextValue(static_cast<float>(row[place]));
    }
  }

  vtkFloatArray* Get() { return this->From.empty() ? nullptr : this->Array.Get(); }

private:
  Places From;
  vtkNew<vtkFloatArray> Array;
};

class Reader
{
public:
  explicit Reader(const std::string& bytes)
    : Header(ReadPLYHeader(bytes))
    , Numbers(bytes, this->Header)
  {
  }

  vtkSmartPointer<vtkPolyData> Read()
  {
    this->FindVertices();
    for (const PLYElement& element : this->Header.Elements)
    {
      if (element.Name == "vertex")
      {
        this->ReadVertices(element);
      }
      else if (element.Name == "face" || element.Name == "tristrips")
      {
        this->ReadFaces(element);
      }
      else
      {
        this->Skip(element);
      }
    }
    this->AddVertexCells();
    if (this->Broken > 0)
    {
      AddWarning(std::to_string(this->Broken) +
        " face(s) of the PLY file were left out: they have indices of missing vertices.");
    }
    return this->Data;
  }

private:
  void FindVertices()
  {
    for (const PLYElement& element : this->Header.Elements)
    {
      if (element.Name == "vertex" && !FindAll(element, { "x", "y", "z" }).empty())
      {
        this->Vertices = static_cast<vtkIdType>(element.Count);
        return;
      }
    }
    throw Failure("it has no vertices with x, y and z.");
  }

  /// Reads an element's numbers and, if there is one, its list at a place.
  void ReadRow(const PLYElement& element, int listPlace)
  {
    this->Row.assign(element.Properties.size(), 0.0);
    this->List.clear();
    for (std::size_t i = 0; i < element.Properties.size(); ++i)
    {
      const PLYProperty& property = element.Properties[i];
      if (!property.IsList)
      {
        this->Row[i] = this->Numbers.Read(property.Type);
        continue;
      }
      const std::size_t count = this->Numbers.ReadCount(property);
      for (std::size_t j = 0; j < count; ++j)
      {
        const double number = this->Numbers.Read(property.Type);
        if (static_cast<int>(i) == listPlace)
        {
          this->List.push_back(number);
        }
      }
    }
  }

  void Skip(const PLYElement& element)
  {
    if (element.Count > 0 && !element.Properties.empty())
    {
      AddWarning("The elements " + element.Name +
        " of the PLY file were left out: only vertices, faces and triangle strips are read.");
      for (std::size_t i = 0; i < element.Count; ++i)
      {
        this->ReadRow(element, -1);
      }
    }
  }

  void ReadVertices(const PLYElement& element)
  {
    const Places position = FindAll(element, { "x", "y", "z" });
    vtkNew<vtkPoints> points;
    const bool isSingle = std::all_of(position.begin(), position.end(),
      [&](int place) { return element.Properties[place].Type.Size <= sizeof(float); });
    points->SetDataType(isSingle ? VTK_FLOAT : VTK_DOUBLE);
    Vectors normals("Normals", FindAll(element, { "nx", "ny", "nz" }));
    Vectors coordinates("TCoords", FindTexCoords(element));
    Colors colors(element);
    for (std::size_t i = 0; i < element.Count; ++i)
    {
      this->ReadRow(element, -1);
      points->InsertNextPoint(
        this->Row[position[0]], this->Row[position[1]], this->Row[position[2]]);
      normals.Add(this->Row);
      coordinates.Add(this->Row);
      colors.Add(this->Row);
    }
    this->Data->SetPoints(points);
    this->Data->GetPointData()->SetNormals(normals.Get());
    this->Data->GetPointData()->SetTCoords(coordinates.Get());
    colors.SetTo(this->Data->GetPointData());
  }

  static Places FindTexCoords(const PLYElement& element)
  {
    for (const auto& names :
      { std::pair("u", "v"), std::pair("texture_u", "texture_v"), std::pair("s", "t") })
    {
      Places places = FindAll(element, { names.first, names.second });
      if (!places.empty())
      {
        return places;
      }
    }
    return {};
  }

  void ReadFaces(const PLYElement& element)
  {
    const int indices = element.Find("vertex_indices", true);
    const int list = indices >= 0 ? indices : element.Find("vertex_index", true);
    if (list < 0 && element.Count > 0)
    {
      throw Failure("its element " + element.Name + " has no list vertex_indices.");
    }
    const bool areStrips = element.Name == "tristrips";
    Colors colors(element);
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < element.Count; ++i)
    {
      this->ReadRow(element, list);
      if (areStrips)
      {
        this->AddStrips(cells);
      }
      else if (this->AddCell(this->List.begin(), this->List.end(), cells))
      {
        colors.Add(this->Row);
      }
    }
    if (areStrips)
    {
      this->Data->SetStrips(cells);
      return;
    }
    this->Data->SetPolys(cells);
    colors.SetTo(this->Data->GetCellData());
  }

  using Iterator = std::vector<double>::const_iterator;

  /// Strips of a list are separated by -1.
  void AddStrips(vtkCellArray* cells)
  {
    for (Iterator begin = this->List.begin(); begin != this->List.end();)
    {
      const Iterator end = std::find(begin, Iterator(this->List.end()), -1.0);
      this->AddCell(begin, end, cells);
      begin = end == this->List.end() ? end : end + 1;
    }
  }

  /// False if a cell is left out because it has no area or indices of missing vertices.
  bool AddCell(Iterator begin, Iterator end, vtkCellArray* cells)
  {
    std::vector<vtkIdType>& ids = this->Ids;
    ids.clear();
    for (Iterator number = begin; number != end; ++number)
    {
      if (!(*number >= 0.0) || *number >= static_cast<double>(this->Vertices))
      {
        ++this->Broken;
        return false;
      }
      ids.push_back(static_cast<vtkIdType>(*number));
    }
    if (ids.size() < 3)
    {
      return false;
    }
    cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
    return true;
  }

  /// Shows points if there are no faces.
  void AddVertexCells()
  {
    const auto isFaces = [](const PLYElement& element)
    { return (element.Name == "face" || element.Name == "tristrips") && element.Count > 0; };
    if (std::none_of(this->Header.Elements.begin(), this->Header.Elements.end(), isFaces))
    {
      vtkNew<vtkCellArray> cells;
      for (vtkIdType i = 0; i < this->Vertices; ++i)
      {
        cells->InsertNextCell(1, &i);
      }
      this->Data->SetVerts(cells);
    }
  }

  PLYHeader Header;
  PLYNumbers Numbers;
  vtkIdType Vertices = 0;
  vtkIdType Broken = 0;
  std::vector<double> Row;  // the numbers of an element that are not lists
  std::vector<double> List; // and the one list that is used
  std::vector<vtkIdType> Ids;
  vtkSmartPointer<vtkPolyData> Data = vtkSmartPointer<vtkPolyData>::New();
};
}

vtkSmartPointer<vtkPolyData> ReadPLY(const std::string& fileName)
{
  const std::string bytes = ReadBytes(fileName);
  return Reader(bytes).Read();
}
}
