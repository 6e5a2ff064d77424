// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The words and numbers in text files of scenes. They do not depend on the language of the program.
 */
#ifndef cslfSceneText_h
#define cslfSceneText_h

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslf::tool
{
/// Throws a Failure that gives the reason if a file cannot be opened.
void RequireReadable(const std::string& fileName);

/// The bytes of a file. Throws a Failure if it cannot be opened.
std::string ReadBytes(const std::string& fileName);

/// In lower case, for ASCII letters.
std::string ToLower(std::string_view text);

bool IsSpace(char character);

///@{
/// The words of a text, between white space.
std::vector<std::string_view> Split(std::string_view text);
void Split(std::string_view text, std::vector<std::string_view>& words);
///@}

/// The number that a text is, with a decimal point. A number too large for a double is infinite,
/// one too small 0. Empty for any other text.
std::optional<double> ToNumber(std::string_view text);

/// The same, but empty for numbers that are not finite.
std::optional<double> ToFinite(std::string_view text);

/// Whether a float keeps all decimal digits of a number: the shortest decimal that stands for the
/// float is that number.
bool FitsFloat(double number);

/// The lines of a text one after the other. A backslash at the end of a line joins it with the
/// next, except in comments, whose paths may end with one. A mark of UTF-8 is skipped.
class TextLines
{
public:
  /// The text must outlive this.
  explicit TextLines(std::string_view text)
    : Text(text.substr(text.compare(0, 3, "\xef\xbb\xbf") == 0 ? 3 : 0))
  {
  }

  /// Goes to the first or to the next line. False after the last.
  bool Next();

  /// The words of the line, which are valid until Next.
  const std::vector<std::string_view>& GetWords() const { return this->Words; }

  /// The line from a word on, without white space at the end. Empty if there are fewer words.
  std::string GetRest(std::size_t word) const;

  /// The number of the line, from 1 on.
  std::size_t GetNumber() const { return this->Number; }

private:
  /// A line without its end.
  std::string_view Cut();

  std::string_view Text;
  std::size_t Place = 0;
  std::size_t Number = 0;
  std::string Joined;
  std::vector<std::string_view> Words;
};
}

#endif
