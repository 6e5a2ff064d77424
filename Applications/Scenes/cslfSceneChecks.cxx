// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneChecks.h"

#include "Console/cslfMessages.h"
#include "Files/cslfFileSystem.h"
#include "cslfXMLArrayHeaders.h"
#include "cslfXMLStrings.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <vector>

namespace cslf::tool
{
namespace
{
namespace fs = std::filesystem;

// The most values per byte of a file: zlib compresses zeros by a factor of about 1000. Small files
// may announce some more.
constexpr double ValuesPerByte = 1100.0;
constexpr double SmallestLimit = 65536.0;

// Blocks of a composite data set take memory even if they are empty.
constexpr double MostBlocks = 1048576.0; // of a file

// VTK reads and deletes nested elements recursively.
constexpr int MostLevels = 1000;

constexpr double BytesOfLargestValue = 8.0;

/// The number in a text, which must contain nothing else.
template <typename Number>
bool Parse(const std::string& text, Number& number)
{
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (!text.empty() && text[0] == '+' ? 1 : 0);
  const auto result = std::from_chars(begin, end, number);
  return result.ec == std::errc() && result.ptr == end;
}

/// The lines of an OBJ file that have one index each.
class OBJChecker
{
public:
  explicit OBJChecker(const std::string& fileName)
    : File(ToPath(fileName), std::ios::binary)
  {
  }

  void Check()
  {
    this->ForEachLine([this](const std::string& command, std::istringstream&)
      { this->Count(command, this->Totals); });
    this->File.clear();
    this->File.seekg(0);
    this->ForEachLine(
      [this](const std::string& command, std::istringstream& words)
      {
        this->Count(command, this->Counts);
        if (command == "f" || command == "l" || command == "p")
        {
          std::string word;
          while (words >> word)
          {
            this->CheckCorner(word);
          }
        }
      });
    this->CheckEnd();
  }

private:
  /// Vertices, texture coordinates and normals.
  using Numbers = std::array<std::int64_t, 3>;

  template <typename Visit>
  void ForEachLine(Visit visit)
  {
    this->Line = 0;
    std::string line;
    while (std::getline(this->File, line))
    {
      ++this->Line;
      this->Continue(line);
      std::istringstream words(line);
      std::string command;
      words >> command;
      visit(command, words);
    }
  }

  /// A truncated file may end within a line.
  void CheckEnd()
  {
    this->File.clear();
    this->File.seekg(0);
    std::size_t words = 0;
    std::string last;
    this->ForEachLine(
      [&](const std::string& command, std::istringstream& rest)
      {
        last = command;
        words = std::distance(std::istream_iterator<std::string>(rest), {});
      });
    const std::map<std::string, std::size_t> fewest = { { "v", 3 }, { "vn", 3 }, { "vt", 1 },
      { "f", 3 }, { "l", 2 }, { "p", 1 } };
    const auto found = fewest.find(last);
    if (found != fewest.end() && words < found->second)
    {
      this->Fail("is incomplete: the file is truncated");
    }
  }

  /// Appends the next lines if a line ends with a backslash.
  void Continue(std::string& line)
  {
    std::string next;
    for (std::size_t last = line.find_last_not_of('\r');
         last != std::string::npos && line[last] == '\\' && std::getline(this->File, next);
         last = line.find_last_not_of('\r'))
    {
      ++this->Line;
      line.replace(last, std::string::npos, " " + next);
    }
  }

  static void Count(const std::string& command, Numbers& counts)
  {
    const char* const commands[] = { "v", "vt", "vn" };
    for (int i = 0; i < 3; ++i)
    {
      counts[i] += command == commands[i] ? 1 : 0;
    }
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn, each from 1 on, or from -1 on backwards.
  void CheckCorner(const std::string& word) const
  {
    std::size_t begin = 0;
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t end = std::min(word.find('/', begin), word.size());
      const std::string text = word.substr(begin, end - begin);
      const bool isLeftOut = text.empty() && i == 1 && end < word.size();
      if (!isLeftOut)
      {
        this->CheckIndex(text, i);
      }
      if (end == word.size())
      {
        return;
      }
      begin = end + 1;
    }
    this->Fail("has an invalid index");
  }

  void CheckIndex(const std::string& text, int kind) const
  {
    int index = 0;
    if (!Parse(text, index))
    {
      this->Fail("has an invalid index");
    }
    if (index == 0 || index > this->Totals[kind] || index < -this->Counts[kind])
    {
      const char* const kinds[] = { "vertex", "texture coordinate", "normal" };
      this->Fail(std::string("has the index of a missing ") + kinds[kind]);
    }
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw Failure("line " + std::to_string(this->Line) + " " + what + ".");
  }

  std::ifstream File;
  std::size_t Line = 0;
  Numbers Totals{};
  Numbers Counts{}; // up to this line
};

/// Whether an STL file is complete. VTK reads truncated files without an error.
class STLChecker
{
public:
  explicit STLChecker(const std::string& fileName)
    : File(ToPath(fileName), std::ios::binary)
  {
    std::error_code failure;
    this->Size = fs::file_size(ToPath(fileName), failure);
    this->Begin.resize(std::min<std::uintmax_t>(this->Size, BytesLookedAt));
    this->File.read(this->Begin.data(), static_cast<std::streamsize>(this->Begin.size()));
  }

  /// Returns whether the file is a text file.
  bool Check()
  {
    const bool isText = this->IsText();
    if (isText)
    {
      this->CheckLetters();
      this->CheckText();
    }
    else
    {
      this->CheckBinary();
    }
    return isText;
  }

private:
  static constexpr std::uintmax_t BytesLookedAt = 1024;
  static constexpr std::uintmax_t HeaderSize = 84; // the last four bytes count the triangles
  static constexpr std::uintmax_t TriangleSize = 50;

  /// Headers of binary files may begin like text, but then the number of triangles fits the size,
  /// or there are zeros, as after each triangle. The name of a solid may have letters beyond ASCII.
  bool IsText() const
  {
    if (this->Size >= HeaderSize &&
      this->Size == HeaderSize + TriangleSize * this->CountTriangles())
    {
      return false;
    }
    const std::size_t first = this->Begin.find_first_not_of(" \t\r\n");
    return first != std::string::npos && ToLower(this->Begin.substr(first, 5)) == "solid" &&
      this->Begin.find('\0') == std::string::npos;
  }

  /// VTK reads a text as binary numbers if a twentieth of its first 256 bytes is not ASCII.
  void CheckLetters() const
  {
    const std::string begin = this->Begin.substr(0, 256);
    const auto others = std::count_if(begin.begin(), begin.end(),
      [](char letter)
      {
        return (letter < 32 || letter > 126) &&
          std::string("\t\r\n").find(letter) == std::string::npos;
      });
    if (20 * static_cast<std::size_t>(others) >= begin.size())
    {
      throw Failure("the name of its solid has too many letters that are not ASCII.");
    }
  }

  void CheckText()
  {
    this->File.clear();
    this->File.seekg(0);
    std::string line;
    bool isOpen = false;
    while (std::getline(this->File, line))
    {
      std::string word;
      std::istringstream(line) >> word;
      word = ToLower(word);
      isOpen = word == "solid" || (isOpen && word != "endsolid");
    }
    if (isOpen)
    {
      throw Failure("it is truncated: its last solid has no endsolid.");
    }
  }

  static std::string ToLower(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(),
      [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
  }

  /// The number that a binary file gives.
  std::uintmax_t CountTriangles() const
  {
    std::uintmax_t triangles = 0;
    for (int i = 1; i <= 4; ++i)
    {
      triangles = triangles << 8 | static_cast<unsigned char>(this->Begin[HeaderSize - i]);
    }
    return triangles;
  }

  void CheckBinary() const
  {
    if (this->Size < HeaderSize)
    {
      throw Failure("it is too short for the header of a binary STL file.");
    }
    const std::uintmax_t triangles = this->CountTriangles();
    const std::uintmax_t present = (this->Size - HeaderSize) / TriangleSize;
    if (present < triangles)
    {
      throw Failure("it is truncated: it has " + std::to_string(present) + " of " +
        std::to_string(triangles) + " triangles.");
    }
  }

  std::ifstream File;
  std::uintmax_t Size = 0;
  std::string Begin;
};

/// Leaves out elements that are nested too deeply, and records that there were some.
class vtkShallowXMLParser : public vtkXMLDataParser
{
public:
  static vtkShallowXMLParser* New();
  vtkTypeMacro(vtkShallowXMLParser, vtkXMLDataParser);

  bool HasDeepElements() const { return this->DeepestLevel > MostLevels; }

protected:
  vtkShallowXMLParser() = default;

  void StartElement(const char* name, const char** attributes) override
  {
    this->DeepestLevel = std::max(this->DeepestLevel, ++this->Level);
    if (this->Level <= MostLevels)
    {
      this->Superclass::StartElement(name, attributes);
    }
  }

  void EndElement(const char* name) override
  {
    if (this->Level-- <= MostLevels)
    {
      this->Superclass::EndElement(name);
    }
  }

private:
  int Level = 0;
  int DeepestLevel = 0;
};

vtkStandardNewMacro(vtkShallowXMLParser);

/// The elements of an XML file.
class XMLChecker
{
public:
  explicit XMLChecker(const fs::path& path)
    : Path(path)
  {
    std::error_code failure;
    const double bytes = static_cast<double>(fs::file_size(path, failure));
    this->Limit = std::max(ValuesPerByte * (failure ? 0.0 : bytes), SmallestLimit);
  }

  void Check()
  {
    vtkNew<vtkShallowXMLParser> parser;
    parser->SetFileName(ToName(this->Path).c_str());
    const bool isParsed = parser->Parse() != 0;
    if (parser->HasDeepElements())
    {
      this->Fail("elements nested on more than " + std::to_string(MostLevels) + " levels");
    }
    const std::string error = isParsed ? std::string() : GetFirstError();
    if (!error.empty())
    {
      throw Failure("Cannot read " + ToName(this->Path) + ": " + error);
    }
    if (isParsed && parser->GetRootElement())
    {
      this->CheckElements(parser);
    }
  }

private:
  void CheckElements(vtkXMLDataParser* parser)
  {
    XMLArrayHeaders headers(ToName(this->Path), parser);
    XMLStrings strings(ToName(this->Path), parser);
    std::vector<vtkXMLDataElement*> pending = { parser->GetRootElement() };
    while (!pending.empty())
    {
      vtkXMLDataElement* element = pending.back();
      pending.pop_back();
      for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
      {
        pending.push_back(element->GetNestedElement(i));
      }
      this->CheckElement(element);
      this->CountBlocks(element);
      if (!headers.Fit(element, BytesOfLargestValue * this->Limit))
      {
        this->Fail("an array of too many blocks or bytes");
      }
      if (!strings.Fit(element))
      {
        this->Fail("fewer strings than an array holds");
      }
    }
    if (this->LargestCount * this->MostComponents > this->Limit)
    {
      this->Fail(
        "an array of " + std::to_string(static_cast<std::int64_t>(this->LargestCount)) + " tuples");
    }
  }

  /// VTK uses an array without checking whether it could create one of that type.
  void CheckType(vtkXMLDataElement* element) const
  {
    static const std::set<std::string> types = { "Bit", "Float32", "Float64", "Int8", "Int16",
      "Int32", "Int64", "String", "UInt8", "UInt16", "UInt32", "UInt64" };
    const std::string name = element->GetName() ? element->GetName() : "";
    const char* type = element->GetAttribute("type");
    if ((name == "DataArray" || name == "Array") && (!type || types.count(type) == 0))
    {
      this->Fail("an array of unknown type");
    }
  }

  /// VTK writes the ranges of arrays, but cannot read those that are not finite.
  void CheckRange(vtkXMLDataElement* element) const
  {
    static const std::set<std::string> ranges = { "COMPONENT_RANGE", "L2_NORM_RANGE",
      "L2_NORM_FINITE_RANGE" };
    const char* name = element->GetAttribute("name");
    for (int i = 0; name && ranges.count(name) > 0 && i < element->GetNumberOfNestedElements(); ++i)
    {
      const char* text = element->GetNestedElement(i)->GetCharacterData();
      if (text && !std::isfinite(std::strtod(text, nullptr)))
      {
        throw Failure(ToName(this->Path.filename()) +
          " has an array with coordinates or other values that are not finite.");
      }
    }
  }

  void CheckElement(vtkXMLDataElement* element)
  {
    this->CheckType(element);
    this->CheckRange(element);
    for (int i = 0; i < element->GetNumberOfAttributes(); ++i)
    {
      const std::string name = element->GetAttributeName(i);
      const std::string text = element->GetAttributeValue(i);
      if (name == "NumberOfComponents")
      {
        this->MostComponents = std::max(this->MostComponents, this->CheckNumber(name, text));
      }
      else if (name.compare(0, 8, "NumberOf") == 0)
      {
        this->LargestCount = std::max(this->LargestCount, this->CheckNumber(name, text));
      }
      else if (name == "WholeExtent" || name == "Extent")
      {
        this->CheckExtent(name, text);
      }
      else if (name == "file")
      {
        this->CheckFile(text);
      }
    }
  }

  /// An element has as many blocks as its largest index says.
  void CountBlocks(vtkXMLDataElement* element)
  {
    double blocks = 0.0;
    for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
    {
      if (const char* index = element->GetNestedElement(i)->GetAttribute("index"))
      {
        blocks = std::max(blocks, this->CheckNumber("index", index) + 1.0);
      }
    }
    this->Blocks += blocks;
    if (this->Blocks > MostBlocks)
    {
      this->Fail("more than " + std::to_string(static_cast<int>(MostBlocks)) + " blocks");
    }
  }

  /// A number of items, each of which needs bytes in the file.
  double CheckNumber(const std::string& name, const std::string& text) const
  {
    std::int64_t number = 0;
    std::istringstream words(text);
    std::string word;
    words >> word;
    if (!Parse(word, number) || number < 0 || static_cast<double>(number) > this->Limit)
    {
      this->Fail(name + " " + text.substr(0, 40));
    }
    return static_cast<double>(number);
  }

  void CheckExtent(const std::string& name, const std::string& text) const
  {
    std::istringstream words(text);
    double size = 1.0;
    for (int i = 0; i < 3; ++i)
    {
      double lower = 0.0;
      double upper = 0.0;
      words >> lower >> upper;
      size *= std::max(upper - lower + 1.0, 1.0);
    }
    if (!(size <= this->Limit))
    {
      this->Fail(name + " " + text.substr(0, 60));
    }
  }

  /// A file that this one refers to. VTK does not read trees within trees.
  void CheckFile(const std::string& name) const
  {
    const fs::path path = this->Path.parent_path() / ToPath(name);
    std::error_code failure;
    if (path.extension() != this->Path.extension() && fs::is_regular_file(path, failure))
    {
      XMLChecker(path).Check();
    }
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw Failure(ToName(this->Path.filename()) + " declares " + what +
      ", which is invalid or more than the file can hold.");
  }

  fs::path Path;
  double Limit = 0.0;
  double LargestCount = 0.0;
  double Blocks = 0.0;
  double MostComponents = 1.0;
};
}

void CheckOBJ(const std::string& fileName)
{
  OBJChecker(fileName).Check();
}

bool CheckSTL(const std::string& fileName)
{
  return STLChecker(fileName).Check();
}

void CheckVTKXML(const std::string& fileName)
{
  XMLChecker(ToPath(fileName)).Check();
}
}
