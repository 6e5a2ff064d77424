// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The commands of cslf-lab, which measure CSLF for its developers, and the common options of those
 * that measure a light field: the field, perhaps its scene for novel views, and the folder for the
 * results.
 */
#ifndef cslfLab_h
#define cslfLab_h

#include "Console/cslfProgram.h"
#include "Fields/cslfFieldFiles.h"
#include "Measurements/cslfNovelViews.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfJSON.h"

#include <string>
#include <vector>

namespace cslf::tool
{
///@{
/// Adds a command, as `Program` says.
void AddBenchmarkCodec(CLI::App& app, Command& chosen);
void AddBenchmarkKeyViews(CLI::App& app, Command& chosen);
void AddBenchmarkOpening(CLI::App& app, Command& chosen);
void AddBenchmarkRender(CLI::App& app, Command& chosen);
void AddBenchmarkSampler(CLI::App& app, Command& chosen);
void AddEvaluateTexels(CLI::App& app, Command& chosen);
///@}

/// The novel views of a measurement, and the mean of their noise floors in dB.
struct BenchmarkViews
{
  std::vector<NovelView> Views;
  double NoiseFloor = 0.0;
};

/// Writes a result into a folder, as NAME.md and NAME.json. Throws a Failure.
void WriteResult(const Result& result, const std::string& folder, const std::string& name);

struct BenchmarkOptions
{
  std::string Field;
  std::string Folder;
  SceneOptions Scene;
  NovelViewOptions Novel;

  /// Adds the field, --output, the scene and the views' options.
  void AddTo(CLI::App& command);

  /// Reads the whole field. Throws a Failure.
  FieldFile ReadField() const;

  /// Reads the scene, if there is one, with the parameters stored in the field. Makes the folder,
  /// which must be writable, and traces the views of the scene. Throws a Failure.
  BenchmarkViews Begin(const Description& field);

  ///@{
  /// The settings for tracing the views.
  nlohmann::json DescribeViews(double noiseFloor) const;
  static std::string DescribeNoise(double noiseFloor);
  ///@}

  /// Writes a result into the folder.
  void Write(const Result& result, const std::string& name) const
  {
    WriteResult(result, this->Folder, name);
  }
};
}

#endif
