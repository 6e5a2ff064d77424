// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldParts.h"

#include "Console/cslfMessages.h"
#include "Files/cslfFileSystem.h"
#include "cslfFieldFiles.h"
#include "cslfJoin.h"
#include "cslfOutputFiles.h"

#include "vtkCSLFDecoder.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace cslf::tool
{
namespace
{
/// Larger than all parts of a video can be, so there is no need to read more of a file.
constexpr std::streamsize MaximumBytes = 16 * 1024 * 1024;

struct PartOption
{
  std::string Name;
  std::string Type;
  std::string FileName;
};

/// The first "=" ends the name, and the first ":" after it ends the type.
std::optional<PartOption> SplitOption(const std::string& option)
{
  const std::size_t equals = option.find('=');
  const std::size_t colon = equals == std::string::npos ? equals : option.find(':', equals);
  if (colon == std::string::npos || colon == equals + 1 || colon + 1 == option.size())
  {
    return std::nullopt;
  }
  return PartOption{ option.substr(0, equals), option.substr(equals + 1, colon - equals - 1),
    option.substr(colon + 1) };
}

vtkSmartPointer<vtkUnsignedCharArray> ReadBytes(const std::string& fileName)
{
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetNumberOfValues(MaximumBytes);
  errno = 0;
  std::ifstream file(ToPath(fileName), std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes->GetPointer(0)), MaximumBytes);
  if (!file.is_open() || file.bad())
  {
    const std::string reason = errno != 0 ? ": " + std::generic_category().message(errno) : "";
    throw Failure("Cannot read " + fileName + reason + ".");
  }
  bytes->Resize(file.gcount());
  bytes->SetNumberOfValues(file.gcount());
  return bytes;
}

std::string Describe(const FieldPart& part)
{
  return "\"" + part.Name + "\" (" + part.Type + ")";
}
}

std::string FindPartError(const std::string& option)
{
  return SplitOption(option) ? std::string()
                             : "\"" + option +
      "\" is not of the form NAME=TYPE:FILE, such as "
      "scene=model/gltf-binary:scene.glb";
}

std::vector<FieldPart> ReadParts(const std::vector<std::string>& options, const std::string& output)
{
  std::vector<FieldPart> parts;
  for (const std::string& option : options)
  {
    const PartOption words = SplitOption(option).value_or(PartOption());
    RequireOther(words.FileName, output);
    FieldPart part{ words.Name, words.Type, ReadBytes(words.FileName) };
    if (std::any_of(
          parts.begin(), parts.end(), [&](const FieldPart& other) { return other.IsLike(part); }))
    {
      throw Failure("There are two parts " + Describe(part) + ": give them different names.");
    }
    parts.push_back(part);
  }
  return parts;
}

std::vector<FieldPart> GetParts(const FieldFile& file)
{
  std::vector<FieldPart> parts;
  auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader);
  for (int k = 0; decoder && k < decoder->GetNumberOfParts(); ++k)
  {
    // The decoder uses the same array for all.
    auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
    bytes->DeepCopy(decoder->GetPart(k));
    parts.push_back({ decoder->GetPartName(k), decoder->GetPartType(k), bytes });
  }
  return parts;
}

void MergeParts(std::vector<FieldPart>& parts, const std::vector<FieldPart>& others)
{
  const std::vector<FieldPart> first = parts;
  for (const FieldPart& other : others)
  {
    if (std::none_of(
          first.begin(), first.end(), [&](const FieldPart& part) { return part.IsLike(other); }))
    {
      parts.push_back(other);
    }
  }
}

FieldPart FindPart(
  const std::vector<FieldPart>& parts, const std::string& name, const std::string& fileName)
{
  std::vector<FieldPart> found;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(found),
    [&](const FieldPart& part)
    { return part.Name == name || part.Name + "=" + part.Type == name; });
  if (parts.empty())
  {
    throw Failure(fileName + " has no parts.");
  }
  if (found.empty())
  {
    throw Failure(fileName + " has no part \"" + name + "\" but " + JoinAs(parts, Describe) + ".");
  }
  if (found.size() > 1)
  {
    throw Failure(fileName + " has more than one part \"" + name +
      "\": " + JoinAs(found, Describe) + "; ask for one as NAME=TYPE.");
  }
  return found.front();
}
}
