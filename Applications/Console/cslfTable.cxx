// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTable.h"

#include <algorithm>
#include <cstdio>

namespace cslf::tool
{
std::string Table::ToText() const
{
  std::vector<std::size_t> widths;
  for (const auto& row : this->Rows)
  {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      widths[column] = std::max(widths[column], row[column].size());
    }
  }
  const bool isList = widths.size() == 2;
  std::string text;
  for (const auto& row : this->Rows)
  {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      const std::string space(widths[column] - row[column].size(), ' ');
      const bool isLeft = column == 0 || isList;
      line += (column == 0 ? "" : "  ") + (isLeft ? row[column] + space : space + row[column]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string Table::ToMarkdown() const
{
  std::string text;
  for (const auto& row : this->Rows)
  {
    const bool isHead = text.empty();
    text += "|";
    for (const std::string& cell : row)
    {
      text += " " + cell + " |";
    }
    text += "\n";
    for (std::size_t column = 0; isHead && column < row.size(); ++column)
    {
      text += std::string(column == 0 ? "|" : "") + (column == 0 ? "---|" : "---:|") +
        (column + 1 == row.size() ? "\n" : "");
    }
  }
  return text;
}

std::string Format(double value, int digits)
{
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), "%.*f", digits, value);
  return buffer;
}
}
