// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneChecks.h"

#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Files/cslfFileSystem.h"
#include "cslfXMLArrayHeaders.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
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
constexpr double MinimumLimit = 65536.0;

// Blocks of a composite data set take memory even if they are empty.
constexpr double MaximumBlocks = 1048576.0; // of a file

// VTK reads and deletes nested elements recursively.
constexpr int MaximumLevels = 1000;

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

/// Leaves out elements that are nested too deeply, and records that there were some.
class vtkShallowXMLParser : public vtkXMLDataParser
{
public:
  static vtkShallowXMLParser* New();
  vtkTypeMacro(vtkShallowXMLParser, vtkXMLDataParser);

  bool HasDeepElements() const { return this->DeepestLevel > MaximumLevels; }

protected:
  vtkShallowXMLParser() = default;

  void StartElement(const char* name, const char** attributes) override
  {
    this->DeepestLevel = std::max(this->DeepestLevel, ++this->Level);
    if (this->Level <= MaximumLevels)
    {
      this->Superclass::StartElement(name, attributes);
    }
  }

  void EndElement(const char* name) override
  {
    if (this->Level-- <= MaximumLevels)
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
    , File(path, std::ios::binary)
  {
    std::error_code failure;
    const double bytes = static_cast<double>(fs::file_size(path, failure));
    this->Limit = std::max(ValuesPerByte * (failure ? 0.0 : bytes), MinimumLimit);
  }

  void Check()
  {
    const auto parser = this->ParseFile();
    if (parser->GetRootElement())
    {
      this->Limit = std::max(this->Limit, ValuesPerByte * this->CountPieceBytes(parser));
      this->CheckElements(parser);
    }
  }

  /// Has no root element if the file is not XML, which VTK's readers report.
  vtkSmartPointer<vtkXMLDataParser> ParseFile() const
  {
    auto parser = vtkSmartPointer<vtkShallowXMLParser>::New();
    parser->SetFileName(ToName(this->Path).c_str());
    const bool isParsed = parser->Parse() != 0;
    if (parser->HasDeepElements())
    {
      this->Fail("elements nested on more than " + std::to_string(MaximumLevels) + " levels");
    }
    const std::string error = isParsed ? std::string() : GetFirstError();
    if (!error.empty())
    {
      throw Failure("Cannot read " + ToName(this->Path) + ": " + error);
    }
    if (!isParsed)
    {
      return vtkSmartPointer<vtkXMLDataParser>::New();
    }
    return parser;
  }

private:
  /// The size of the files that a parallel file, which has no values itself, consists of.
  double CountPieceBytes(vtkXMLDataParser* parser) const
  {
    std::set<std::string> names;
    vtkXMLDataElement* root = parser->GetRootElement();
    for (int i = 0; i < root->GetNumberOfNestedElements(); ++i)
    {
      vtkXMLDataElement* grid = root->GetNestedElement(i);
      for (int j = 0; j < grid->GetNumberOfNestedElements(); ++j)
      {
        const char* name = grid->GetNestedElement(j)->GetAttribute("Source");
        names.insert(name ? name : "");
      }
    }
    double bytes = 0.0;
    for (const std::string& name : names)
    {
      std::error_code failure;
      const auto size = fs::file_size(this->Path.parent_path() / ToPath(name), failure);
      bytes += failure ? 0.0 : static_cast<double>(size);
    }
    return bytes;
  }

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
    if (this->MaximumCount * this->MaximumComponents > this->Limit)
    {
      this->Fail(
        "an array of " + std::to_string(static_cast<std::int64_t>(this->MaximumCount)) + " tuples");
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
      const auto words = Split(text ? text : "");
      const std::optional<double> number = words.empty() ? std::nullopt : ToNumber(words[0]);
      if (number && !std::isfinite(*number))
      {
        this->FailNotFinite();
      }
    }
  }

  /// VTK reads NaN in arrays of text, and positive infinity if it is called so. Other spellings end
  /// an array, as does a NaN that no space follows.
  void CheckWords(vtkXMLDataElement* element)
  {
    const char* name = element->GetName();
    const char* type = element->GetAttribute("type");
    const char* format = element->GetAttribute("format");
    if (!name || std::string(name) != "DataArray" || !type ||
      std::string(type).rfind("Float", 0) != 0 || !format || ToLower(format) != "ascii")
    {
      return;
    }
    this->File.clear();
    this->File.seekg(element->GetXMLByteIndex());
    this->File.ignore(std::numeric_limits<std::streamsize>::max(), '>');
    bool isEnd = false;
    for (std::string word; !isEnd && this->File >> word;)
    {
      const std::size_t end = word.find('<');
      isEnd = end != std::string::npos;
      if (word.find_first_of("nN") < end)
      {
        const std::string text = ToLower(word.substr(0, end));
        const bool isRead = text == "nan" || text == "-nan" || text == "inf" || text == "+inf";
        if (ToNumber(text) && (isEnd || !isRead))
        {
          this->FailNotFinite();
        }
      }
    }
  }

  void CheckElement(vtkXMLDataElement* element)
  {
    this->CheckType(element);
    this->CheckRange(element);
    this->CheckWords(element);
    for (int i = 0; i < element->GetNumberOfAttributes(); ++i)
    {
      const std::string name = element->GetAttributeName(i);
      const std::string text = element->GetAttributeValue(i);
      if (name == "NumberOfComponents")
      {
        this->MaximumComponents = std::max(this->MaximumComponents, this->CheckNumber(name, text));
      }
      else if (name.compare(0, 8, "NumberOf") == 0)
      {
        this->MaximumCount = std::max(this->MaximumCount, this->CheckNumber(name, text));
      }
      else if (name == "WholeExtent" || name == "Extent")
      {
        this->CheckExtent(name, text);
      }
      else if (name == "file" || name == "Source")
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
    if (this->Blocks > MaximumBlocks)
    {
      this->Fail("more than " + std::to_string(static_cast<int>(MaximumBlocks)) + " blocks");
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
    const bool isFile = fs::is_regular_file(path, failure);
    if (!isFile && fs::exists(path, failure))
    {
      // VTK would wait for a pipe.
      throw Failure(ToName(path) + " is not a file.");
    }
    if (isFile && path.extension() != this->Path.extension())
    {
      XMLChecker(path).Check();
    }
  }

  [[noreturn]] void FailNotFinite() const
  {
    throw Failure(ToName(this->Path.filename()) +
      " has an array with coordinates or other values that are not finite.");
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw Failure(ToName(this->Path.filename()) + " declares " + what +
      ", which is invalid or more than the file can hold.");
  }

  fs::path Path;
  std::ifstream File;
  double Limit = 0.0;
  double MaximumCount = 0.0;
  double Blocks = 0.0;
  double MaximumComponents = 1.0;
};
}

vtkSmartPointer<vtkXMLDataElement> ReadVTKXML(const std::string& fileName)
{
  return XMLChecker(ToPath(fileName)).ParseFile()->GetRootElement();
}

void CheckVTKXML(const std::string& fileName)
{
  XMLChecker(ToPath(fileName)).Check();
}
}
