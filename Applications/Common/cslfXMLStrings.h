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

namespace cslf
{
namespace tool
{
/// VTK writes as many strings into an array as there are, whatever number the file announces.
class XMLStrings
{
public:
  /// Reads the strings of a file that the parser has parsed. The parser must outlive this.
  XMLStrings(const std::string& fileName, vtkXMLDataParser* parser);
  ~XMLStrings();
  XMLStrings(const XMLStrings&) = delete;
  XMLStrings& operator=(const XMLStrings&) = delete;

  /// Whether an array holds no more strings than the file announces. It is true for what is no
  /// array of strings. The array's header must fit.
  bool Fit(vtkXMLDataElement* array);

private:
  /// Reads characters from a place on, and returns how many there were.
  std::size_t Read(vtkXMLDataElement* array, std::size_t place, std::vector<char>& characters);

  std::ifstream File;
  vtkXMLDataParser* Parser;
};
}
}

#endif
