// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfJSONFile.h"

#include "cslfFileSystem.h"
#include "cslfJSONText.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>

namespace cslf
{
nlohmann::json ReadJSON(const std::string& fileName, std::string* error)
{
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(ToPath(fileName), failure);
  std::ifstream file(ToPath(fileName), std::ios::binary);
  // One byte too many makes ParseJSON refuse the text as too long.
  const std::uintmax_t read = std::min<std::uintmax_t>(bytes, MaximumJSONBytes + 1);
  std::string text(failure ? 0 : static_cast<std::size_t>(read), '\0');
  if (failure || !file.read(text.data(), static_cast<std::streamsize>(text.size())))
  {
    if (error)
    {
      *error = "not readable";
    }
    return nlohmann::json(nlohmann::json::value_t::discarded);
  }
  return ParseJSON(text, error);
}
}
