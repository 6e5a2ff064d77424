// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A table of text, its columns aligned.
 */
#ifndef cslfTable_h
#define cslfTable_h

#include <string>
#include <vector>

namespace cslf::tool
{
class Table
{
public:
  void AddRow(const std::vector<std::string>& cells) { this->Rows.push_back(cells); }

  /// The rows as lines. The first column is aligned to the left, and so is the second of two.
  std::string ToText() const;

  /// The rows as a table of Markdown, the first one its head.
  std::string ToMarkdown() const;

private:
  std::vector<std::vector<std::string>> Rows;
};

/// A number with this many digits after the point.
std::string Format(double value, int digits);
}
#endif
