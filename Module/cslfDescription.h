// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The description of a light field: everything but its samples, as one JSON text, read and written
 * only here. It is stored in the image data's field data and in the comment of a coded file.
 */
#ifndef cslfDescription_h
#define cslfDescription_h

#include "cslfCertificate.h"
#include "cslfChannel.h"
#include "cslfCube.h"
#include "cslfJSONForward.h"
#include "cslfLayout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkFieldData;
class vtkImageData;

namespace cslf
{
///@{
/// The upper limits of a description. Files that exceed them are refused before memory is
/// allocated.
constexpr std::size_t MaximumChannels = 16;
constexpr int MaximumComponents = 64;
constexpr std::size_t MaximumNameLength = 100;                    ///< of channels, in bytes
constexpr std::int64_t MaximumFieldBytes = std::int64_t(1) << 50; ///< of all samples
///@}

///@{
/// Limits of the cube's centre and edges and of the scene's bounds: graphics hardware can hold the
/// values, and the cube's texels can be told apart.
constexpr double MaximumCoordinate = 1e30;
constexpr double MinimumRelativeEdge = 1e-12; ///< of the distance from the origin, for each axis
///@}

struct VTKCSLF_EXPORT Description
{
  ///@{
  /// The version of the conventions and of coded files that this code writes. It reads those of the
  /// same format, whatever their minor number, and of format 1.
  static constexpr int Format = 2;
  static constexpr int Minor = 0;
  ///@}
  /// The name of the string array in field data that holds the JSON text.
  static constexpr const char* FieldDataName = "CSLF";

  Layout Grid;
  Cube Box;
  /// The bounds of the scene in the world, in VTK's order, or the cube's bounds if they are not
  /// known. Lookups do not search outside.
  std::optional<std::array<double, 6>> SceneBounds;
  std::vector<Channel> Channels;
  /// Sampling and scene parameters, a JSON object as text, for the record.
  std::string Sampling = "{}";
  /// How well a coded file shows the scene. Whoever changes samples drops it.
  std::optional<Certificate> Measured;
  /// The channels that were left out of `Channels` because this version does not know their type.
  std::vector<std::string> Unknown;

  /// Whether rays that meet no surface may show the environment. Only fields without it have
  /// bounds.
  bool MayShowEnvironment() const { return !this->SceneBounds; }

  /// The corners of the scene's bounds in CC, within [-1,1]^3.
  glm::dvec3 GetSceneMinimumCC() const;
  glm::dvec3 GetSceneMaximumCC() const;

  ///@{
  /// The channel of that name, or null.
  const Channel* FindChannel(const std::string& name) const;
  const Channel* FindChannel(ChannelId id) const { return this->FindChannel(NameOf(id)); }
  ///@}

  ///@{
  /// The times of the field, and its frames: all viewpoints of the first time, then those of the
  /// next.
  int CountTimes() const { return 1; }
  int CountFrames() const { return this->CountTimes() * this->Grid.GetSlices(); }
  FrameId GetFrame(int index) const
  {
    return { index % this->Grid.GetSlices(), index / this->Grid.GetSlices() };
  }
  int GetIndex(FrameId frame) const { return frame.Time * this->Grid.GetSlices() + frame.Slice; }
  ///@}

  /// Whether, according to the record, the colours of texels are those of the surfaces at their
  /// centres.
  bool HasSurfaceTexels() const;

  /// The size of a texel of all channels of a valid description, in bytes.
  std::int64_t GetTexelBytes() const;

  /// The size of all samples of a valid description, in bytes.
  std::int64_t GetBytes() const;

  /// Says in a few words what is invalid: a grid, a cube or bounds outside their limits, `Color` or
  /// `Depth` of an unknown type, two channels of one name, or too many bytes. Empty if the
  /// description is valid. All readers of descriptions check this.
  std::string FindError() const;

  nlohmann::json ToJSON() const;
  std::string ToText() const;

  /// Reads what ToJSON wrote. On bad input returns nothing and gives the reason in one line.
  static std::optional<Description> FromJSON(const nlohmann::json& json, std::string& error);
  static std::optional<Description> FromText(const std::string& text, std::string& error);

  /// Replaces the description held by a data object's field data.
  void WriteTo(vtkFieldData* fieldData) const;

  /// Reads the description of image data and checks it against extent, spacing, origin and arrays,
  /// since VTK's filters pass field data along even when they change what it describes. Image data
  /// may hold any z part of the field. On a mismatch returns nothing and gives the reason in one
  /// line.
  static std::optional<Description> ReadFrom(vtkImageData* image, std::string& error);
};
}

#endif
