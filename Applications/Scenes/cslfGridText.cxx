// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGridText.h"

#include "Console/cslfSceneText.h"
#include "Fields/cslfSceneChecks.h"
#include "Files/cslfFileSystem.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIndent.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace cslf::tool
{
namespace
{
///@{
/// Stand-ins that nobody writes: large whole numbers, which are exact as float and as double.
constexpr float ForNaN = 0x1.fcbda6p+127F;
constexpr float ForInfinity = 0x1.f9e8a4p+127F;
///@}

/// A number in decimal digits, or those of its stand-in.
std::string GetStandIn(double number)
{
  const double standIn = std::isnan(number) ? ForNaN : std::copysign(ForInfinity, number);
  char text[64];
  std::snprintf(text, sizeof(text), "%.0f", standIn);
  return text;
}

template <typename Array>
void Restore(Array* array)
{
  using Value = typename Array::ValueType;
  Value* values = array->GetPointer(0);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    if (values[i] == Value(ForNaN))
    {
      values[i] = std::numeric_limits<Value>::quiet_NaN();
    }
    else if (std::abs(values[i]) == Value(ForInfinity))
    {
      values[i] = std::copysign(std::numeric_limits<Value>::infinity(), values[i]);
    }
  }
  array->DataChanged();
  array->Modified();
}

void RestoreArray(vtkAbstractArray* array)
{
  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    Restore(floats);
  }
  else if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    Restore(doubles);
  }
}

void RestoreArrays(vtkFieldData* arrays)
{
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    RestoreArray(arrays->GetAbstractArray(i));
  }
}

void RestoreDataSet(vtkDataSet* data)
{
  RestoreArrays(data->GetPointData());
  RestoreArrays(data->GetCellData());
  auto* set = vtkPointSet::SafeDownCast(data);
  if (set && set->GetPoints())
  {
    RestoreArray(set->GetPoints()->GetData());
    set->GetPoints()->Modified();
  }
  if (auto* grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    RestoreArray(grid->GetXCoordinates());
    RestoreArray(grid->GetYCoordinates());
    RestoreArray(grid->GetZCoordinates());
  }
}

/// Whether a legacy file has numbers as text, which its third line says.
bool IsText(const std::string& fileName)
{
  std::ifstream file(ToPath(fileName), std::ios::binary);
  std::string line;
  for (int i = 0; i < 3; ++i)
  {
    std::getline(file, line);
  }
  return ToLower(line).rfind("ascii", 0) == 0;
}

/// A line of numbers with stand-ins. Empty if all numbers are finite, or if it has other words.
std::string ReplaceInLine(std::string_view line)
{
  if (line.find_first_of("nN") == std::string_view::npos)
  {
    return {};
  }
  std::string replaced;
  for (const std::string_view word : Split(line))
  {
    const std::optional<double> number = ToNumber(word);
    if (!number)
    {
      return {};
    }
    replaced += std::isfinite(*number) ? std::string(word) : GetStandIn(*number);
    replaced += ' ';
  }
  return replaced;
}

using Elements = std::vector<vtkXMLDataElement*>;

/// The pieces of a file of any kind of grid.
Elements FindPieces(vtkXMLDataElement* root)
{
  Elements pieces;
  for (int i = 0; i < root->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* grid = root->GetNestedElement(i);
    for (int j = 0; j < grid->GetNumberOfNestedElements(); ++j)
    {
      vtkXMLDataElement* piece = grid->GetNestedElement(j);
      if (piece->GetName() && std::string_view(piece->GetName()) == "Piece")
      {
        pieces.push_back(piece);
      }
    }
  }
  return pieces;
}
}

std::string ReplaceNotFinite(const std::string& fileName)
{
  if (!IsText(fileName))
  {
    return {};
  }
  const std::string text = ReadBytes(fileName);
  std::string replaced;
  std::size_t copied = 0;
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = ReplaceInLine(std::string_view(text).substr(begin, end - begin));
    if (!line.empty())
    {
      replaced.append(text, copied, begin - copied);
      replaced += line;
      copied = end;
    }
    begin = end + 1;
  }
  if (copied > 0)
  {
    replaced.append(text, copied, std::string::npos);
  }
  return replaced;
}

void RestoreNotFinite(vtkDataObject* data)
{
  if (!data)
  {
    return;
  }
  RestoreArrays(data->GetFieldData());
  if (auto* single = vtkDataSet::SafeDownCast(data))
  {
    RestoreDataSet(single);
  }
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
    leaf.TakeReference(tree->NewTreeIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      RestoreNotFinite(leaf->GetCurrentDataObject());
    }
  }
}

bool IsEmptyGrid(const std::string& fileName)
{
  std::error_code failure;
  if (!std::filesystem::is_regular_file(ToPath(fileName), failure))
  {
    return false;
  }
  const auto root = ReadVTKXML(fileName);
  const std::string type = root && root->GetAttribute("type") ? root->GetAttribute("type") : "";
  if (type != "PolyData" && type != "UnstructuredGrid")
  {
    return false;
  }
  const Elements pieces = FindPieces(root);
  return std::all_of(pieces.begin(), pieces.end(),
    [](vtkXMLDataElement* piece)
    {
      const char* points = piece->GetAttribute("NumberOfPoints");
      return points && ToNumber(points) == 0.0;
    });
}

std::string LeaveOutEmptyPieces(const std::string& fileName)
{
  const auto root = ReadVTKXML(fileName);
  const Elements pieces = root ? FindPieces(root) : Elements();
  bool isChanged = false;
  for (vtkXMLDataElement* piece : pieces)
  {
    const char* source = piece->GetAttribute("Source");
    if (source && IsEmptyGrid(ToName(ToPath(fileName).parent_path() / ToPath(source))))
    {
      piece->GetParent()->RemoveNestedElement(piece);
      isChanged = true;
    }
  }
  if (!isChanged)
  {
    return {};
  }
  std::ostringstream text;
  root->PrintXML(text, vtkIndent());
  return text.str();
}
}
