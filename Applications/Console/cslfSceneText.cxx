// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneText.h"

#include "Files/cslfFileSystem.h"
#include "cslfMessages.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>

namespace cslf::tool
{
namespace
{
/// Whether a line ends with a backslash and is not a comment.
bool IsContinued(std::string_view line)
{
  const auto* first = std::find_if_not(line.begin(), line.end(), IsSpace);
  return !line.empty() && line.back() == '\\' && *first != '#';
}
}

void RequireReadable(const std::string& fileName)
{
  InputFile file;
  std::string reason;
  if (!file.Open(fileName, reason))
  {
    throw Failure("it cannot be opened: " + reason + ".");
  }
}

std::string ReadBytes(const std::string& fileName)
{
  RequireReadable(fileName);
  std::ifstream file(ToPath(fileName), std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

std::string ToLower(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](char letter)
    { return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter; });
  return lower;
}

bool IsSpace(char character)
{
  return character == ' ' || (character >= '\t' && character <= '\r');
}

std::vector<std::string_view> Split(std::string_view text)
{
  std::vector<std::string_view> words;
  Split(text, words);
  return words;
}

void Split(std::string_view text, std::vector<std::string_view>& words)
{
  words.clear();
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const std::size_t begin = i;
    while (i < text.size() && !IsSpace(text[i]))
    {
      ++i;
    }
    if (i > begin)
    {
      words.push_back(text.substr(begin, i - begin));
    }
  }
}

std::optional<double> ToNumber(std::string_view text)
{
  const bool hasPlus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  text.remove_prefix(hasPlus ? 1 : 0);
  const char* end = text.data() + text.size();
  double number = 0.0;
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ptr != end || result.ec == std::errc::invalid_argument)
  {
    return std::nullopt;
  }
  if (result.ec == std::errc::result_out_of_range)
  {
    const bool isSmall =
      text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
    const double size = isSmall ? 0.0 : std::numeric_limits<double>::infinity();
    return text[0] == '-' ? -size : size;
  }
  return number;
}

std::optional<double> ToFinite(std::string_view text)
{
  const std::optional<double> number = ToNumber(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

bool FitsFloat(double number)
{
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), static_cast<float>(number));
  double again = 0.0;
  std::from_chars(text, end.ptr, again);
  return again == number;
}

bool TextLines::Next()
{
  if (this->Place >= this->Text.size())
  {
    return false;
  }
  std::string_view line = this->Cut();
  if (IsContinued(line))
  {
    this->Joined.clear();
    while (!line.empty() && line.back() == '\\' && this->Place < this->Text.size())
    {
      this->Joined.append(line.substr(0, line.size() - 1)).append(" ");
      line = this->Cut();
    }
    this->Joined.append(line);
    line = this->Joined;
  }
  Split(line, this->Words);
  return true;
}

std::string TextLines::GetRest(std::size_t word) const
{
  if (word >= this->Words.size())
  {
    return {};
  }
  const char* begin = this->Words[word].data();
  const char* end = this->Words.back().data() + this->Words.back().size();
  return { begin, end };
}

std::string_view TextLines::Cut()
{
  const std::size_t begin = this->Place;
  const std::size_t end = std::min(this->Text.find('\n', begin), this->Text.size());
  this->Place = end + 1;
  ++this->Number;
  std::string_view line = this->Text.substr(begin, end - begin);
  line.remove_suffix(line.size() - (line.find_last_not_of('\r') + 1));
  return line;
}
}
