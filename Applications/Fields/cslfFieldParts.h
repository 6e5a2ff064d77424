// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of videos other than the light field: from files, and to files.
 */
#ifndef cslfFieldParts_h
#define cslfFieldParts_h

#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <string>
#include <vector>

namespace cslf::tool
{
struct FieldFile;

struct FieldPart
{
  std::string Name; ///< may be empty
  std::string Type; ///< a media type
  vtkSmartPointer<vtkUnsignedCharArray> Bytes;

  bool IsLike(const FieldPart& other) const
  {
    return this->Name == other.Name && this->Type == other.Type;
  }
};

/// Says in one line why an option is not of the form "NAME=TYPE:FILE". Empty if it is.
std::string FindPartError(const std::string& option);

/// Reads the files of valid options. Throws a Failure if a file cannot be read or is the output, or
/// if two parts have the same name and type.
std::vector<FieldPart> ReadParts(
  const std::vector<std::string>& options, const std::string& output);

/// The parts of an open field; none if it is not a video.
std::vector<FieldPart> GetParts(const FieldFile& file);

/// Joins lists of parts. Of parts with the same name and type, the first one stays.
void MergeParts(std::vector<FieldPart>& parts, const std::vector<FieldPart>& others);

/// The part of that name, or of "NAME=TYPE". Throws a Failure unless there is exactly one.
/// `fileName` is the field's.
FieldPart FindPart(
  const std::vector<FieldPart>& parts, const std::string& name, const std::string& fileName);
}

#endif
