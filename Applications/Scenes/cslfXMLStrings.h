// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arrays of strings in XML files of VTK.
 */
#ifndef cslfXMLStrings_h
#define cslfXMLStrings_h

#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

class vtkXMLDataElement;
class vtkXMLDataParser;

namespace cslf::tool
{
/// VTK writes all strings to an array, whatever number the file announces.
class XMLStrings
{
public:
  /// Reads the strings of a file that the parser has parsed. The parser must outlive this.
  XMLStrings(const std::string& fileName, vtkXMLDataParser* parser);
  ~XMLStrings();
  XMLStrings(const XMLStrings&) = delete;
  XMLStrings& operator=(const XMLStrings&) = delete;

  /// Whether an array contains no more strings than the file announces. True for other arrays. The
  /// array's header must fit in the file.
  bool Fit(vtkXMLDataElement* array);

private:
  /// Reads characters from a position on, and returns their number.
  std::size_t Read(vtkXMLDataElement* array, std::size_t place, std::vector<char>& characters);

  std::ifstream File;
  vtkXMLDataParser* Parser;
};
}

#endif
