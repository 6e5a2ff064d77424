// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFileSeries.h"

#include "cslfFileSystem.h"
#include "cslfJSONFile.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace cslf
{
namespace
{
constexpr const char* VersionKey = "file-series-version";
constexpr const char* Version = "1.0";
constexpr const char* FilesKey = "files";
constexpr const char* NameKey = "name";
constexpr const char* TimeKey = "time";
constexpr const char* HashKey = "hash";

/// Throws an exception of the JSON library if a value has another type.
SeriesFile ReadFile(const nlohmann::json& json, std::size_t number)
{
  const auto time = json.find(TimeKey);
  const auto hash = json.find(HashKey);
  return { json.at(NameKey).get<std::string>(),
    time == json.end() ? static_cast<double>(number) : time->get<double>(),
    hash != json.end() && hash->is_string() ? hash->get<std::string>() : "" };
}

bool IsEarlier(const SeriesFile& a, const SeriesFile& b)
{
  return a.Time < b.Time;
}
}

std::optional<FileSeries> FileSeries::Read(const std::string& fileName, std::string& error)
{
  const nlohmann::json json = ReadJSON(fileName, &error);
  if (json.is_discarded())
  {
    return std::nullopt;
  }
  FileSeries series;
  error = "it is not the index of a file series";
  try
  {
    for (const nlohmann::json& file : json.at(FilesKey))
    {
      series.Files.push_back(ReadFile(file, series.Files.size()));
    }
  }
  catch (const std::exception&)
  {
    return std::nullopt;
  }
  std::stable_sort(series.Files.begin(), series.Files.end(), IsEarlier);
  const auto isWrong = [](const SeriesFile& file)
  { return file.Name.empty() || !std::isfinite(file.Time); };
  const auto isEqual = [](const SeriesFile& a, const SeriesFile& b) { return a.Time == b.Time; };
  if (std::any_of(series.Files.begin(), series.Files.end(), isWrong))
  {
    return std::nullopt;
  }
  if (series.Files.empty())
  {
    error = "it names no files";
    return std::nullopt;
  }
  if (std::adjacent_find(series.Files.begin(), series.Files.end(), isEqual) != series.Files.end())
  {
    error = "two of its files have the same time";
    return std::nullopt;
  }
  error.clear();
  return series;
}

std::string FileSeries::ToText() const
{
  nlohmann::ordered_json json = { { VersionKey, Version },
    { FilesKey, nlohmann::ordered_json::array() } };
  for (const SeriesFile& file : this->Files)
  {
    nlohmann::ordered_json entry = { { NameKey, file.Name }, { TimeKey, file.Time } };
    if (!file.Hash.empty())
    {
      entry[HashKey] = file.Hash;
    }
    json[FilesKey].push_back(entry);
  }
  return json.dump(2) + "\n";
}

std::vector<double> FileSeries::GetTimes() const
{
  std::vector<double> times;
  for (const SeriesFile& file : this->Files)
  {
    times.push_back(file.Time);
  }
  return times;
}

std::string FileSeries::GetPath(std::size_t step, const std::string& indexName) const
{
  // An absolute name remains as it is.
  return ToName(ToPath(indexName).parent_path() / ToPath(this->Files[step].Name));
}

std::size_t FindTimeStep(const std::vector<double>& times, double time)
{
  const auto later = std::upper_bound(times.begin(), times.end(), time);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(later - times.begin() - 1, 0));
}
}
