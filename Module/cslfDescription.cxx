// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDescription.h"

#include "cslfJSON.h"
#include "cslfJSONText.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <glm/common.hpp>
#include <vtkType.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>

namespace cslf
{
namespace
{
bool IsName(const std::string& name)
{
  const auto isPrintable = [](unsigned char letter) { return letter >= ' ' && letter != 0x7f; };
  return !name.empty() && name.size() <= MaximumNameLength &&
    std::all_of(name.begin(), name.end(), isPrintable);
}

std::string FindError(const Channel& channel)
{
  if (!IsName(channel.Name) || !(channel.Encoding.empty() || IsName(channel.Encoding)))
  {
    return "a channel's name or encoding is not 1 to " + std::to_string(MaximumNameLength) +
      " printable characters";
  }
  if (channel.Components < 1 || channel.Components > MaximumComponents)
  {
    return "the channel \"" + channel.Name + "\" does not have 1 to " +
      std::to_string(MaximumComponents) + " components";
  }
  return FindKnownChannel(channel.Name) && !FindForm(channel) ? "the channel \"" + channel.Name +
      "\" has a type, a number of components or an encoding that it cannot have"
                                                              : std::string();
}

std::string FindError(const std::vector<Channel>& channels)
{
  if (channels.size() > MaximumChannels)
  {
    return "it has more than " + std::to_string(MaximumChannels) + " channels";
  }
  std::set<std::string> names;
  for (const Channel& channel : channels)
  {
    std::string fault = FindError(channel);
    if (!fault.empty())
    {
      return fault;
    }
    if (!names.insert(channel.Name).second)
    {
      return "it has two channels \"" + channel.Name + "\"";
    }
  }
  return {};
}

std::string FindError(const Cube& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double center = std::abs(box.Center[axis]);
    const double edge = box.Edges[axis];
    // These comparisons are false for NaN.
    if (!(center <= MaximumCoordinate && edge >= 1.0 / MaximumCoordinate &&
          edge <= MaximumCoordinate))
    {
      return "the cube's centre and edges are not within their limits";
    }
    if (!(edge >= MinimumRelativeEdge * center))
    {
      return "the cube is too small for its distance from the origin";
    }
  }
  return {};
}

std::string FindError(const Cube& box, const std::array<double, 6>& bounds)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double lower = bounds[2 * axis];
    const double upper = bounds[2 * axis + 1];
    if (!(lower <= upper && lower >= -MaximumCoordinate && upper <= MaximumCoordinate))
    {
      return "the scene's bounds are not in order or not within their limits";
    }
    const double half = 0.5 * box.Edges[axis];
    if (!(upper >= box.Center[axis] - half && lower <= box.Center[axis] + half))
    {
      return "the scene's bounds lie outside of the cube";
    }
  }
  return {};
}
}

std::int64_t Description::GetTexelBytes() const
{
  std::int64_t bytes = 0;
  for (const Channel& channel : this->Channels)
  {
    bytes += channel.GetTexelBytes();
  }
  return bytes;
}

std::int64_t Description::GetBytes() const
{
  return this->GetTexelBytes() * this->Grid.GetStripWidth() * this->Grid.GetResolution() *
    this->Grid.GetSlices();
}

std::string Description::FindError() const
{
  if (!this->Grid.IsValid())
  {
    return "its viewpoint nodes or its resolution are not valid";
  }
  std::string fault = cslf::FindError(this->Box);
  if (fault.empty() && this->SceneBounds)
  {
    fault = cslf::FindError(this->Box, *this->SceneBounds);
  }
  fault = fault.empty() ? cslf::FindError(this->Channels) : fault;
  if (!fault.empty())
  {
    return fault;
  }
  // VTK's ids may have 32 bits.
  const std::int64_t texels =
    std::int64_t(this->Grid.GetStripWidth()) * this->Grid.GetResolution() * this->Grid.GetSlices();
  int components = 1;
  for (const Channel& channel : this->Channels)
  {
    components = std::max(components, channel.Components);
  }
  return texels > VTK_ID_MAX / components || this->GetBytes() > MaximumFieldBytes
    ? "it has too many texels"
    : std::string();
}

namespace
{
using JSON = nlohmann::json;

constexpr const char* FormatName = "cube surface light field";
constexpr const char* CertificateKey = "certificate";

struct TypeName
{
  int Type;
  const char* Name;
};

constexpr TypeName TypeNames[] = {
  { VTK_UNSIGNED_CHAR, "uint8" },
  { VTK_UNSIGNED_SHORT, "uint16" },
  { VTK_FLOAT, "float32" },
  { VTK_DOUBLE, "float64" },
};

const char* NameOfType(int type)
{
  for (const TypeName& row : TypeNames)
  {
    if (row.Type == type)
    {
      return row.Name;
    }
  }
  throw std::invalid_argument("the type of a channel is not uint8, uint16, float32 or float64");
}

/// VTK_VOID for unknown types.
int FindType(const std::string& name)
{
  for (const TypeName& row : TypeNames)
  {
    if (name == row.Name)
    {
      return row.Type;
    }
  }
  return VTK_VOID;
}

JSON ToArray(const glm::dvec3& vector)
{
  return { vector.x, vector.y, vector.z };
}

glm::dvec3 ToVector(const JSON& json)
{
  const auto values = json.get<std::vector<double>>();
  if (values.size() != 3)
  {
    throw std::invalid_argument("the cube's centre and edges must be three numbers each");
  }
  return { values[0], values[1], values[2] };
}

/// Format 1 had one number, later formats have two.
void CheckVersion(const JSON& version)
{
  const bool isPair = version.is_array() && version.size() == 2;
  const int format = ToInteger(isPair ? version[0] : version);
  const int minor = isPair ? ToInteger(version[1]) : 0;
  if (format > Description::Format)
  {
    throw std::invalid_argument("it was written by a newer CSLF: format " + std::to_string(format) +
      ", this reads " + std::to_string(Description::Format) + " and 1");
  }
  if (format < 1 || minor < 0 || isPair != (format > 1))
  {
    throw std::invalid_argument("its version is not valid");
  }
}

/// Refuses a description that needs features of later versions. There are none yet.
void CheckRequired(const JSON& json)
{
  std::string names;
  const JSON required = json.value("required", JSON::array());
  for (const JSON& name : RequireArray(required))
  {
    names += (names.empty() ? "" : ", ") + name.get<std::string>();
  }
  if (!names.empty())
  {
    throw std::invalid_argument(
      "it requires features that this version does not support: " + names);
  }
}

Description Parse(const JSON& json)
{
  if (json.at("format") != FormatName)
  {
    throw std::invalid_argument("it describes something else");
  }
  CheckVersion(json.at("version"));
  CheckRequired(json);
  Description description;
  description.Grid = Layout(ToInteger(json.at("base_nodes")), ToIntegers(json.at("nodes")),
    ToInteger(json.at("resolution")));
  description.Box.Center = ToVector(json.at("center"));
  description.Box.Edges = ToVector(json.at("edges"));
  if (json.contains("bounds"))
  {
    description.SceneBounds = json.at("bounds").get<std::array<double, 6>>();
  }
  for (const JSON& item : RequireArray(json.at("channels")))
  {
    Channel channel;
    channel.Name = item.at("name").get<std::string>();
    channel.Type = FindType(item.at("type").get<std::string>());
    if (channel.Type == VTK_VOID && !FindKnownChannel(channel.Name))
    {
      description.Unknown.push_back(channel.Name);
      continue;
    }
    channel.Components = ToInteger(item.at("components"));
    channel.Encoding = item.at("encoding").get<std::string>();
    description.Channels.push_back(channel);
  }
  const JSON sampling = json.value("sampling", JSON::object());
  if (!sampling.is_object())
  {
    throw std::invalid_argument("its \"sampling\" is not an object");
  }
  description.Sampling = sampling.dump();
  if (json.contains(CertificateKey))
  {
    description.Measured = Certificate::FromJSON(json.at(CertificateKey));
  }
  const std::string fault = description.FindError();
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
  return description;
}

/// Says how an image differs from its description. Empty if they match.
std::string FindMisfit(const Description& description, vtkImageData* image)
{
  int whole[6];
  description.Grid.GetWholeExtent(whole);
  const int* extent = image->GetExtent();
  if (extent[0] != whole[0] || extent[1] != whole[1] || extent[2] != whole[2] ||
    extent[3] != whole[3] || extent[4] < whole[4] || extent[5] > whole[5] || extent[4] > extent[5])
  {
    return "its extent is not a range of complete viewpoints of the described field";
  }
  const double* spacing = image->GetSpacing();
  const double* origin = image->GetOrigin();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (spacing[axis] != 1.0 || origin[axis] != 0.0)
    {
      return "its spacing must be 1 and its origin 0";
    }
  }
  for (const Channel& channel : description.Channels)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(channel.Name.c_str());
    if (!array)
    {
      return "its array \"" + channel.Name + "\" is missing";
    }
    if (array->GetDataType() != channel.Type ||
      array->GetNumberOfComponents() != channel.Components)
    {
      return "its array \"" + channel.Name + "\" has another type than described";
    }
    if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
    {
      return "its array \"" + channel.Name + "\" does not have one value for each texel";
    }
  }
  return {};
}
}

bool Description::HasSurfaceTexels() const
{
  const JSON sampling = JSON::parse(this->Sampling, nullptr, false);
  const auto found = sampling.find("surface_texels");
  return found != sampling.end() && *found == true;
}

glm::dvec3 Description::GetSceneMinimumCC() const
{
  if (!this->SceneBounds)
  {
    return glm::dvec3(-1.0);
  }
  const auto& bounds = *this->SceneBounds;
  return glm::max(this->Box.PointToCube({ bounds[0], bounds[2], bounds[4] }), -1.0);
}

glm::dvec3 Description::GetSceneMaximumCC() const
{
  if (!this->SceneBounds)
  {
    return glm::dvec3(1.0);
  }
  const auto& bounds = *this->SceneBounds;
  return glm::min(this->Box.PointToCube({ bounds[1], bounds[3], bounds[5] }), 1.0);
}

const Channel* Description::FindChannel(const std::string& name) const
{
  for (const Channel& channel : this->Channels)
  {
    if (channel.Name == name)
    {
      return &channel;
    }
  }
  return nullptr;
}

nlohmann::json Description::ToJSON() const
{
  JSON channels = JSON::array();
  for (const Channel& channel : this->Channels)
  {
    channels.push_back({ { "name", channel.Name }, { "type", NameOfType(channel.Type) },
      { "components", channel.Components }, { "encoding", channel.Encoding } });
  }
  JSON json = { { "format", FormatName }, { "version", { Format, Minor } },
    { "base_nodes", this->Grid.GetBaseNodes() }, { "nodes", this->Grid.GetNodes() },
    { "resolution", this->Grid.GetResolution() }, { "center", ToArray(this->Box.Center) },
    { "edges", ToArray(this->Box.Edges) }, { "channels", channels },
    { "sampling", JSON::parse(this->Sampling) } };
  if (this->SceneBounds)
  {
    json["bounds"] = *this->SceneBounds;
  }
  if (this->Measured)
  {
    json[CertificateKey] = this->Measured->ToJSON();
  }
  return json;
}

std::string Description::ToText() const
{
  return this->ToJSON().dump();
}

std::optional<Description> Description::FromJSON(const nlohmann::json& json, std::string& error)
{
  try
  {
    return Parse(json);
  }
  catch (const std::exception& exception)
  {
    error =
      std::string("The light field's description cannot be used: ") + DescribeException(exception);
    return std::nullopt;
  }
}

std::optional<Description> Description::FromText(const std::string& text, std::string& error)
{
  std::string reason;
  const JSON json = ParseJSON(text, &reason);
  if (json.is_discarded())
  {
    error = "The light field's description is " + reason + ".";
    return std::nullopt;
  }
  return Description::FromJSON(json, error);
}

void Description::WriteTo(vtkFieldData* fieldData) const
{
  vtkNew<vtkStringArray> text;
  text->SetName(FieldDataName);
  text->InsertNextValue(this->ToText());
  fieldData->AddArray(text);
}

std::optional<Description> Description::ReadFrom(vtkImageData* image, std::string& error)
{
  auto* text = image
    ? vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray(FieldDataName))
    : nullptr;
  if (!text || text->GetNumberOfValues() != 1)
  {
    error = "The image data is not a light field: its field data has no description.";
    return std::nullopt;
  }
  auto description = Description::FromText(text->GetValue(0), error);
  if (description)
  {
    const std::string misfit = FindMisfit(*description, image);
    if (!misfit.empty())
    {
      error = "The image data does not fit its light field description: " + misfit + ".";
      return std::nullopt;
    }
  }
  return description;
}
}
