// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light fields in files of all formats of the tool: coded video (.mp4, .mkv), image data (.vti) and
 * folders of cube maps.
 */
#ifndef cslfFieldFiles_h
#define cslfFieldFiles_h

#include "Options/cslfOptionTable.h"
#include "cslfDescription.h"
#include "cslfFieldParts.h"
#include "cslfJSON.h"
#include "vtkCSLFRateControl.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkCSLFEncoder;
class vtkCSLFSeriesWriter;
class vtkPolyData;

namespace CLI
{
class App;
}

namespace cslf::tool
{
enum class FieldFormat
{
  Video,
  ImageData,
  Folder
};

/// The names of all formats, for help and errors.
constexpr const char* FieldFormats = ".mp4, .mkv, .vti or a folder of cube maps";

/// Those that can be read.
constexpr const char* ReadFormats =
  ".mp4, .mkv, a series of these (.mp4.series), .vti or a folder of cube maps";

///@{
/// The option that chooses a time.
constexpr const char* TimeFlag = "--time";
constexpr const char* TimeHelp =
  "of files with several times: the last one that is not later than this (default: the first)";
///@}

/// The heading of the video options in the help.
constexpr const char* VideoGroup = "Video (.mp4, .mkv)";

/// The message of a tool without the video encoder if it needs the encoder.
constexpr const char* NoEncoder =
  "This cslf was built without the video encoder: write .vti or a folder.";

/// A field's file, open for reading. Port 0 of the reader delivers the field.
struct FieldFile
{
  std::string FileName; ///< where it is, see LocateField
  FieldFormat Format = FieldFormat::Folder;
  vtkSmartPointer<vtkAlgorithm> Reader;
  Description Field;
  vtkSmartPointer<vtkAlgorithm> GeometryReader; ///< the field's reader or another one; may be null
  std::string
    GeometryMismatch; ///< why the geometry beside the field is ignored; empty if it is not

  /// Delivers the field's geometry. Null if there is none.
  vtkAlgorithmOutput* GetGeometry() const;

  /// Reads the geometry. Null if there is none.
  vtkPolyData* ReadGeometry() const;

  /// Whether it has one that mappers use. Reads it.
  bool HasUsefulGeometry() const;
};

/// A field that a command reads. All commands but view have the same rule for damaged files: fields
/// with missing viewpoints are read only if the user allows it.
struct FieldInput
{
  std::string FileName;
  bool AllowMissing = false;
  std::optional<double> Time = std::nullopt;
  bool HasAllTimes = false; ///< whether the command shows all times of a series

  /// Adds the file, as a positional argument of that name, and the options --time and
  /// --allow-missing.
  void AddTo(CLI::App& command, const std::string& name = "field");
};

/// Adds the option --allow-missing.
void AddAllowMissing(CLI::App& command, bool& isAllowed);

/// The format for a file's extension. A name without extension is a folder. Throws a Failure for
/// unknown extensions.
FieldFormat GetFormat(const std::string& fileName);

/// Whether a field with that file name is a video.
bool IsVideo(const std::string& fileName);

/// Opens a field, or the preview of an unfinished one, and reads only its header. Of a series, that
/// is the field at a time: see vtkCSLFSeriesReader. Throws a Failure if it is missing or not a
/// light field.
FieldFile OpenField(const std::string& name, std::optional<double> time = std::nullopt);

/// Opens a field and checks, without decoding it, that all its viewpoints exist. If not, throws a
/// MissingViewpoints, unless this is allowed.
FieldFile OpenField(const FieldInput& input);

/// Reads a field for vtkCSLFMapper. Videos are not decoded, because the mapper requests viewpoints
/// from their decoder. Throws a Failure.
void ReadToDraw(const FieldFile& file);

/// Whether the file is the preview of a field that is still being written.
bool IsUnfinished(const FieldFile& file);

/// Checks the whole file for missing viewpoints, without decoding it.
int CountMissing(const FieldFile& file);

/// The coding of colour: "hevc", "av1", "h264", "png", "exr" or "none".
std::string GetCodecName(const FieldFile& file);

/// The steps of a series: a list of "time", "file" and "bytes". Empty for other fields.
nlohmann::json ListSteps(const FieldFile& file);

/// The size of a field: of its file, of all files in a folder, or of an index with its files.
std::uintmax_t CountBytes(const FieldFile& file);

/// The size of a file, or of all files in a folder.
std::uintmax_t CountBytes(const std::string& fileName);

/// The settings of video coding. The defaults are the encoder's. Copies share the rate control.
struct CodingOptions
{
  vtkSmartPointer<vtkCSLFRateControl> Rate = vtkSmartPointer<vtkCSLFRateControl>::New();
  std::string Codec = options::Codec.Default;
  std::string Preset = options::Preset.Default;
  std::string PixelFormat = options::PixelFormat.Default;
  int GroupLength = options::GroupLength.Default;
  bool Lossless = options::Lossless.Default;
  bool DepthFromGeometry = options::DepthFromGeometry.Default;
  bool Certificate = options::Certificate.Default;
  bool Restart = options::Restart.Default;
  bool Overwrite = true; ///< whether a video may replace a file that exists when it is complete
  std::vector<std::string> Parts; ///< in the form that ReadParts takes

  void AddTo(CLI::App& command);
  void Apply(vtkCSLFEncoder* encoder) const; ///< only with the video encoder

  /// Whether more than a rate factor is requested.
  bool HasTarget() const;

  /// Whether only some viewpoints are coded.
  bool HasKeyViews() const { return this->Rate->GetKeyViewStep() != 1; }

private:
  void AddTargetsTo(CLI::App& command);
  void AddKeyViewsTo(CLI::App& command);
};

/// A destination for a field.
class FieldOutput
{
public:
  /// The extension determines the format. A name without extension is a folder. Reads the parts for
  /// a video. Throws a Failure if the destination is not writable.
  FieldOutput(const std::string& fileName, const CodingOptions& coding);

  /// Pulls the field from the connection and writes it, and its geometry from another connection,
  /// which may be null; folders have no place for it. Throws a Failure. Under mpirun, all processes
  /// write a video together. Returns the results of coding a video, on the first process: "crf",
  /// "ratio", "psnr".
  nlohmann::json Write(
    vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& label) const;

  /// Likewise writes a video for each time of the connection, and their index.
  void WriteSeries(vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry,
    vtkCSLFSeriesWriter* writer) const;

  FieldFormat GetFormat() const { return this->Format; }

  /// Adds the parts of another field's file to a video, except those that it has already, and the
  /// geometry.
  void TakeParts(const FieldFile& file);

private:
  /// Only with the video encoder.
  nlohmann::json WriteVideo(
    vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& label) const;
  void SetUp(
    vtkCSLFEncoder* encoder, vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry) const;
  void Write(
    vtkCSLFEncoder* encoder, const std::string& label, const std::function<int()>& write) const;
  void WriteFolder(vtkAlgorithmOutput* connection, const std::string& label) const;

  std::string FileName;
  CodingOptions Coding;
  FieldFormat Format = FieldFormat::Folder;
  std::vector<FieldPart> Parts; ///< on the first process
};

/// Throws a Failure unless a file of that name can be created.
void RequireWritable(const std::string& fileName);

/// A file name's extension, with its dot, in lower case.
std::string LowerExtension(const std::string& fileName);

/// The results of FieldOutput::Write in words: ", ...", or nothing.
std::string DescribeCoding(const nlohmann::json& coding);

/// The description of a field for `info` and similar commands.
nlohmann::json Summarize(const Description& description);
}

#endif
