// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfArrayCodes.h"

#include "cslfGeometryStreams.h"
#include "cslfJSONText.h"

#include <vtkMath.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cslf
{
namespace
{
/// The fewest steps of a range: an error is at most a half of one. 1023 values have ten bits.
constexpr std::uint32_t MinimumArraySteps = 1022;

/// The most, beside what is not a number: numbers have four bytes.
constexpr double MaximumArraySteps = 4294967294.0;

/// The most that numbers of two bytes can tell.
constexpr std::uint32_t MaximumShort = 65535;

constexpr const char* NameKey = "name";
constexpr const char* ComponentsKey = "components";
constexpr const char* RangesKey = "ranges";
constexpr const char* StepsKey = "steps";
constexpr const char* IntegerKey = "integer";
}

std::uint32_t ArrayCodes::Component::ToCode(double value) const
{
  if (std::isnan(value))
  {
    return this->Steps + 1;
  }
  const double share = this->Last > this->First
    ? std::clamp((value - this->First) / (this->Last - this->First), 0.0, 1.0)
    : 0.0;
  return static_cast<std::uint32_t>(std::llround(share * this->Steps));
}

double ArrayCodes::Component::ToValue(std::uint32_t code) const
{
  RequireSound(code <= this->Steps + 1);
  return code > this->Steps
    ? vtkMath::Nan()
    : this->First + (this->Last - this->First) * double(code) / double(this->Steps);
}

ArrayCodes::ArrayCodes(const SurfaceArray& array)
  : Name(array.Name)
  , IsInteger(array.IsInteger)
{
  for (std::size_t c = 0; c < array.Components.size(); ++c)
  {
    Component& component = this->Components.emplace_back();
    component.Name = array.Components[c].Name;
    const auto range =
      array.GetRange(static_cast<int>(c)).value_or(std::array<double, 2>{ 0.0, 0.0 });
    component.First = range[0];
    component.Last = range[1];
    component.Steps = MinimumArraySteps;
    const double first = std::floor(range[0]);
    const double size = std::ceil(range[1]) - first;
    if (this->IsInteger && size >= 1.0 && size <= MaximumArraySteps)
    {
      component.First = first;
      component.Last = first + size;
      component.Steps = static_cast<std::uint32_t>(size * std::ceil(MinimumArraySteps / size));
    }
  }
  const std::size_t points = array.Components.front().Values.size();
  const std::size_t size = this->GetPointSize();
  this->Points.assign(points * size, 0);
  for (std::size_t i = 0; i < points; ++i)
  {
    unsigned char* place = &this->Points[size * i];
    for (std::size_t c = 0; c < this->Components.size(); ++c, place += this->GetCodeSize())
    {
      const std::uint32_t code = this->Components[c].ToCode(array.Components[c].Values[i]);
      this->GetCodeSize() == 2 ? StoreNumber(static_cast<std::uint16_t>(code), place)
                               : StoreNumber(code, place);
    }
  }
}

std::size_t ArrayCodes::GetCodeSize() const
{
  return std::all_of(this->Components.begin(), this->Components.end(),
           [](const Component& component) { return component.Steps < MaximumShort; })
    ? 2
    : 4;
}

std::size_t ArrayCodes::GetPointSize() const
{
  return (this->GetCodeSize() * this->Components.size() + 3) / 4 * 4;
}

nlohmann::json ArrayCodes::Describe() const
{
  nlohmann::json json = { { NameKey, this->Name } };
  for (const Component& component : this->Components)
  {
    json[ComponentsKey].push_back(component.Name);
    json[RangesKey].push_back({ component.First, component.Last });
    json[StepsKey].push_back(component.Steps);
  }
  if (this->IsInteger)
  {
    json[IntegerKey] = true;
  }
  return json;
}

ArrayCodes ArrayCodes::Read(const nlohmann::json& header)
{
  ArrayCodes codes;
  codes.Name = header.at(NameKey).get<std::string>();
  codes.IsInteger = header.value(IntegerKey, false);
  const auto names = header.at(ComponentsKey).get<std::vector<std::string>>();
  const auto ranges = header.at(RangesKey).get<std::vector<std::array<double, 2>>>();
  const auto steps = header.at(StepsKey).get<std::vector<double>>();
  RequireSound(!codes.Name.empty() && !names.empty() && names.size() <= MaximumArrayComponents &&
    names.size() == ranges.size() && names.size() == steps.size());
  for (std::size_t c = 0; c < names.size(); ++c)
  {
    const auto& [first, last] = ranges[c];
    RequireSound(first <= last && std::isfinite(last - first));
    RequireSound(
      steps[c] >= 1.0 && steps[c] <= MaximumArraySteps && steps[c] == std::floor(steps[c]));
    codes.Components.push_back({ names[c], first, last, static_cast<std::uint32_t>(steps[c]) });
  }
  return codes;
}

SurfaceArray ArrayCodes::GetArray() const
{
  SurfaceArray array;
  array.Name = this->Name;
  array.IsInteger = this->IsInteger;
  const std::size_t size = this->GetPointSize();
  for (std::size_t c = 0; c < this->Components.size(); ++c)
  {
    SurfaceArray::Component& component = array.Components.emplace_back();
    component.Name = this->Components[c].Name;
    for (std::size_t i = 0; i < this->Points.size() / size; ++i)
    {
      const unsigned char* place = &this->Points[size * i + this->GetCodeSize() * c];
      component.Values.push_back(
        this->Components[c].ToValue(this->GetCodeSize() == 2 ? LoadNumber<std::uint16_t>(place)
                                                             : LoadNumber<std::uint32_t>(place)));
    }
  }
  return array;
}
}
