// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMaterialProblems.h"

#include "cslfJoin.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cstring>
#include <sstream>

namespace cslf
{
namespace
{
/// An array of points or cells that has a meaning.
struct Attribute
{
  const char* Name;
  int Components;
};

const Attribute PointAttributes[] = { { vtkCSLFMaterial::EmissionName(), 3 },
  { vtkCSLFMaterial::LineRadiusName(), 1 }, { vtkCSLFMaterial::PointRadiusName(), 1 } };
const Attribute CellAttributes[] = { { vtkCSLFMaterial::EmissionName(), 3 } };

std::string Count(int components)
{
  return std::to_string(components) + (components == 1 ? " component" : " components");
}

/// The problem of an array, or nothing.
std::string DescribeMismatch(vtkAbstractArray* array, int components)
{
  if (!vtkDataArray::SafeDownCast(array))
  {
    return std::string("of type ") + array->GetClassName() + " (numbers expected)";
  }
  if (array->GetNumberOfComponents() != components)
  {
    return "of " + Count(array->GetNumberOfComponents()) + " (" + std::to_string(components) +
      " expected)";
  }
  return array->GetNumberOfTuples() < 1 ? "without tuples (1 expected)" : "";
}

template <typename Attributes>
const Attribute* Find(const Attributes& attributes, const char* name)
{
  for (const Attribute& attribute : attributes)
  {
    if (std::strcmp(attribute.Name, name) == 0)
    {
      return &attribute;
    }
  }
  return nullptr;
}

/// How many values of an array are negative or not finite.
vtkIdType CountInvalid(vtkDataArray* array)
{
  vtkIdType count = 0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const double value = array->GetComponent(i, c);
      count += value >= 0.0 && value <= material::Unlimited ? 0 : 1;
    }
  }
  return count;
}
}

void MaterialProblems::FindUnused(vtkDataObject* data)
{
  if (!data)
  {
    return;
  }
  this->FindUnusedParameters(data->GetFieldData());
  this->FindUnusedTextures(data);
  if (auto* dataSet = vtkDataSet::SafeDownCast(data))
  {
    this->FindUnusedAttributes(dataSet);
  }
}

void MaterialProblems::FindUnusedParameters(vtkFieldData* fields)
{
  for (const material::Parameter& parameter : material::Parameters)
  {
    vtkAbstractArray* array = fields->GetAbstractArray(parameter.Name);
    const std::string problem = array ? DescribeMismatch(array, parameter.Components) : "";
    if (!problem.empty())
    {
      this->Unused.insert(std::string(parameter.Name) + " " + problem);
    }
  }
}

void MaterialProblems::FindUnusedTextures(vtkDataObject* data)
{
  vtkFieldData* fields = data->GetFieldData();
  for (int slot = 0; vtkCSLFMaterial::TextureName(slot); ++slot)
  {
    const char* names[] = { vtkCSLFMaterial::TextureName(slot),
      vtkCSLFMaterial::TextureLayoutName(slot) };
    vtkNew<vtkImageData> image;
    bool repeat = false;
    bool interpolate = false;
    if ((fields->HasArray(names[0]) || fields->HasArray(names[1])) &&
      !vtkCSLFMaterial::GetTexture(data, slot, image, repeat, interpolate))
    {
      this->Unused.insert(std::string(names[0]) +
        " (expected: unsigned chars of 1 to 4 components, a tuple for each pixel; and " + names[1] +
        ", of 4 or 9 integers that begin with the width and the height)");
    }
  }
}

void MaterialProblems::FindUnusedAttributes(vtkDataSet* data)
{
  const auto find = [this](vtkFieldData* fields, const auto& attributes, const char* place)
  {
    for (const material::Parameter& parameter : material::Parameters)
    {
      vtkAbstractArray* array = fields->GetAbstractArray(parameter.Name);
      const Attribute* attribute = Find(attributes, parameter.Name);
      const std::string problem = !array ? ""
        : attribute                      ? DescribeMismatch(array, attribute->Components)
                                         : "(expected in the field data)";
      if (!problem.empty() && (!attribute || array->GetNumberOfTuples() > 0))
      {
        this->Unused.insert(std::string(parameter.Name) + " of " + place + " " + problem);
      }
    }
  };
  find(data->GetPointData(), PointAttributes, "points");
  find(data->GetCellData(), CellAttributes, "cells");
}

void MaterialProblems::FindOutOfRange(vtkDataObject* data)
{
  if (!data)
  {
    return;
  }
  for (const material::Parameter& parameter : material::Parameters)
  {
    vtkAbstractArray* array = data->GetFieldData()->GetAbstractArray(parameter.Name);
    for (int c = 0;
         array && DescribeMismatch(array, parameter.Components).empty() && c < parameter.Components;
         ++c)
    {
      const double value = vtkDataArray::SafeDownCast(array)->GetComponent(0, c);
      const double used = material::Clamp(parameter, value);
      if (!(value == used))
      {
        std::ostringstream text;
        text << parameter.Name << " of " << value << " is replaced by " << used;
        this->OutOfRange.insert(text.str());
      }
    }
  }
  auto* dataSet = vtkDataSet::SafeDownCast(data);
  const auto find = [this](vtkFieldData* fields, const auto& attributes, const char* place)
  {
    for (const Attribute& attribute : attributes)
    {
      vtkAbstractArray* array = fields->GetAbstractArray(attribute.Name);
      const bool isUsed = array && DescribeMismatch(array, attribute.Components).empty();
      const vtkIdType count = isUsed ? CountInvalid(vtkDataArray::SafeDownCast(array)) : 0;
      if (count > 0)
      {
        this->OutOfRange.insert(std::to_string(count) + " value(s) of " + attribute.Name + " of " +
          place + " that are below 0 or not finite are replaced by 0");
      }
    }
  };
  if (dataSet)
  {
    find(dataSet->GetPointData(), PointAttributes, "points");
    find(dataSet->GetCellData(), CellAttributes, "cells");
  }
}

std::string MaterialProblems::ToText() const
{
  std::string text;
  if (!this->Unused.empty())
  {
    text = "Material arrays were ignored: " + Join(this->Unused) + ".";
  }
  if (!this->OutOfRange.empty())
  {
    text += (text.empty() ? "" : " ") +
      ("Material values are out of range: " + Join(this->OutOfRange)) + ".";
  }
  return text;
}
}
