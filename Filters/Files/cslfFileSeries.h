// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Files for the time steps of a series, and the index that names them: a JSON text, as ParaView
 * writes and reads it. Other programs ignore the hashes.
 */
#ifndef cslfFileSeries_h
#define cslfFileSeries_h

#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// The extension of an index, after that of the files.
constexpr const char* FileSeriesExtension = ".series";

/// A file of a series.
struct SeriesFile
{
  std::string Name; ///< relative to the folder of the index
  double Time = 0.0;
  std::string Hash; ///< of all that the file was made from; may be empty
};

class VTKCSLF_EXPORT FileSeries
{
public:
  std::vector<SeriesFile> Files; ///< in the order of their times

  /// Reads an index. Files without a time get their number, as ParaView does it. On failure returns
  /// nothing and gives the reason in a few words.
  static std::optional<FileSeries> Read(const std::string& fileName, std::string& error);

  /// The text of an index.
  std::string ToText() const;

  std::vector<double> GetTimes() const;

  /// The path of a file of the index of that name.
  std::string GetPath(std::size_t step, const std::string& indexName) const;
};

/// The last of ascending times that is not after a time, or the first one.
VTKCSLF_EXPORT std::size_t FindTimeStep(const std::vector<double>& times, double time);
}

#endif
