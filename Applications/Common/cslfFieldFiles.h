// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light fields in files of every format that the tool knows: coded video (.mp4, .mkv), image data
 * (.vti) and folders of cube maps.
 */
#ifndef cslfFieldFiles_h
#define cslfFieldFiles_h

#include "cslfDescription.h"
#include "cslfFieldParts.h"

#include <vtkSmartPointer.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkAlgorithmOutput;
class vtkCSLFEncoder;

namespace CLI
{
class App;
}

namespace cslf
{
namespace tool
{
enum class FieldFormat
{
  Video,
  ImageData,
  Folder
};

/// The names of all formats, for help and errors.
constexpr const char* FieldFormats = ".mp4, .mkv, .vti or a folder of cube maps";

/// What a tool without the video encoder says where it would need it.
constexpr const char* NoEncoder =
  "This cslf was built without the video encoder: write .vti or a folder.";

/// A field's file, open for reading. Port 0 of the reader delivers the field.
struct FieldFile
{
  FieldFormat Format = FieldFormat::Folder;
  vtkSmartPointer<vtkAlgorithm> Reader;
  Description Field;
};

/// A field that a command reads. All commands have the same rule about damaged files: what lacks
/// viewpoints is read only if the user allows it.
struct FieldInput
{
  std::string FileName;
  bool AllowMissing = false;

  /// Adds the file, as a positional argument of that name, and the option --allow-missing.
  void AddTo(CLI::App& command, const std::string& name = "field");
};

/// Adds the option --allow-missing.
void AddAllowMissing(CLI::App& command, bool& isAllowed);

/// The format that follows from a file's extension; a name without one is a folder's. Throws a
/// Failure where there is none.
FieldFormat GetFormat(const std::string& fileName);

/// Whether a field of that file name is a video.
bool IsVideo(const std::string& fileName);

/// Opens a field. Throws a Failure where it is missing or is no light field. Nothing but its header
/// is read.
FieldFile OpenField(const std::string& fileName);

/// Opens a field and checks, without decoding it, that all its viewpoints are there. Throws a
/// MissingViewpoints where they are not, unless that is allowed.
FieldFile OpenField(const FieldInput& input);

/// Reads a field for vtkCSLFMapper. Videos are left alone, since the mapper takes what it needs
/// from their decoder. Throws a Failure.
void ReadToDraw(const FieldFile& file);

/// Checks the whole file, without decoding it, for viewpoints that are not there.
int CountMissing(const FieldFile& file);

/// How colour is coded: "hevc", "av1", "h264", "png", "exr" or "none".
std::string GetCodecName(const FieldFile& file);

/// The size of a file, or of all files in a folder.
std::uintmax_t CountBytes(const std::string& fileName);

/// How video is coded. The defaults are the encoder's.
struct CodingOptions
{
  std::string Codec = "hevc";
  double CRF = 22.0;
  double CoverageCRF = 24.0;
  double DepthCRF = 8.0;
  double TargetRatio = 0.0;
  double TargetSize = 0.0;
  double TargetPSNR = 0.0;
  std::string KeyViews = "1"; ///< a number, or "auto"
  double TargetNovelPSNR = 0.0;
  std::string Preset = "slow";
  std::string PixelFormat = "auto";
  int GroupLength = 16;
  bool Lossless = false;
  bool Restart = true;
  std::vector<std::string> Parts; ///< as ReadParts takes them

  void AddTo(CLI::App& command);
  void Apply(vtkCSLFEncoder* encoder) const; ///< only with the video encoder

  /// Whether more than a rate factor is asked for.
  bool HasTarget() const;

  /// Whether not all viewpoints are coded.
  bool HasKeyViews() const { return this->KeyViews != "1"; }

private:
  void AddTargetsTo(CLI::App& command);
  void AddKeyViewsTo(CLI::App& command);
};

/// A place to write a field to.
class FieldWriter
{
public:
  /// The format follows from the extension; a name without one is a folder's. Reads the parts that
  /// a video shall carry. Throws a Failure where the place cannot be written.
  FieldWriter(const std::string& fileName, const CodingOptions& coding);

  /// Pulls the field from the connection and writes it. Throws a Failure. Under mpirun, all
  /// processes write a video together. Returns what came out of coding a video, on the first
  /// process: "crf", "ratio", "psnr".
  nlohmann::json Write(vtkAlgorithmOutput* connection, const std::string& label) const;

  FieldFormat GetFormat() const { return this->Format; }

  /// Gives a video what another field's file carries, except for what it has of its own.
  void TakeParts(const FieldFile& file) { MergeParts(this->Parts, GetParts(file)); }

private:
  /// Only with the video encoder.
  nlohmann::json WriteVideo(vtkAlgorithmOutput* connection, const std::string& label) const;
  void WriteImageData(vtkAlgorithmOutput* connection, const std::string& label) const;
  void WriteFolder(vtkAlgorithmOutput* connection, const std::string& label) const;

  std::string FileName;
  CodingOptions Coding;
  FieldFormat Format = FieldFormat::Folder;
  std::vector<FieldPart> Parts; ///< on the first process
};

/// Throws a Failure unless a file of that name can be made.
void RequireWritable(const std::string& fileName);

/// What FieldWriter::Write returned, in words: ", ...", or nothing.
std::string DescribeCoding(const nlohmann::json& coding);

/// What a field is, as `info` and its kin report it.
nlohmann::json Summarize(const Description& description);
}
}

#endif
