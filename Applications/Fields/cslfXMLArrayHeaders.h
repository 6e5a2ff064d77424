// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The headers of binary arrays in XML files of VTK.
 */
#ifndef cslfXMLArrayHeaders_h
#define cslfXMLArrayHeaders_h

#include <cstddef>
#include <cstdint>
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

/// VTK allocates memory for as many bytes and blocks as the header of an array announces.
class XMLArrayHeaders
{
public:
  /// Reads the headers of a file that the parser has parsed.
  XMLArrayHeaders(const std::string& fileName, vtkXMLDataParser* parser);

  /// Whether the blocks that an array announces fit in the file, and their content in `mostBytes`
  /// and in the most that the compressor can make of that many bytes. True for arrays that are text
  /// or end within their header, because VTK reports these.
  bool Fit(vtkXMLDataElement* array, double mostBytes);

private:
  /// The start and the encoding of an array's bytes.
  struct Place
  {
    std::int64_t Begin = -1; // negative: none
    bool IsBase64 = true;
  };

  Place Find(vtkXMLDataElement* array);
  bool FitBlocks(const Place& place, const std::vector<double>& header);
  std::vector<double> ReadWords(const Place& place, std::size_t count);

  std::ifstream File;
  double FileSize = 0.0; // in bytes
  std::int64_t AppendedData = -1;
  bool IsAppendedBase64 = true;
  bool IsCompressed = false;
  double MaximumRatio = 1.0; // of the bytes before and after compression
  bool IsBigEndian = false;
  std::size_t WordSize = 4; // in bytes
};
}

#endif
