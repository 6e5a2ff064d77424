// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A short measurement of the cost of a bake: see vtkCSLFBakeEstimator.
 */
#ifndef cslfBakeProbe_h
#define cslfBakeProbe_h

#include "Coding/Writing/cslfEncodeProbe.h"
#include "Planning/cslfFieldDetail.h"

#include <vtkSmartPointer.h>

#include <chrono>
#include <optional>
#include <string>

class vtkCSLFSampler;
class vtkPolyData;

namespace cslf
{
/// Seconds of wall-clock time, and the bytes that are written.
struct BakeCosts
{
  double Scene = 0.0;
  double Cache = 0.0;
  double Rendering = 0.0;
  double Coding = 0.0;
  double Bytes = 0.0;

  double GetSeconds() const { return this->Scene + this->Cache + this->Rendering + this->Coding; }
};

class BakeProbe
{
public:
  enum class Format
  {
    Video,
    ImageData,
    ImageFolder
  };

  /// Changes the sampler's resolution and samples, and does not restore them. `seconds` is about
  /// the maximum time of an estimate, without that of making the geometry if videos contain it.
  BakeProbe(vtkCSLFSampler* sampler, EncodeSettings settings, bool hasGeometry, Format kind,
    double seconds);

  ///@{
  /// False on failure; then GetError gives the reason.
  bool Estimate();

  /// The seconds for rendering all viewpoints with that many samples, from a subset of them.
  bool TimeRendering(int samples, double& seconds);
  ///@}

  const BakeCosts& GetCosts() const { return this->Costs; }
  /// Of the probed field.
  int GetResolution() const { return this->Resolution; }

  const FieldDetail& GetDetail() const { return this->Detail; }

  /// The exponent by which the bytes grow with the texels along a tile's side.
  double GetGrowth() const { return this->Growth; }

  const std::string& GetError() const { return this->Error; }

private:
  using Clock = std::chrono::steady_clock;

  bool EstimateVideo();
  bool EstimateImages();
  vtkSmartPointer<vtkPolyData> MakeGeometry();
  bool Begin(int resolution, std::optional<EncodeProbe>& probe);
  bool HasRoughCache() const;
  void NoteScene(Clock::time_point start, double cacheSecondsBefore);
  void SetSize(int resolution, int samples);

  /// The resolution of groups of small size.
  int ChooseSmallResolution() const;

  /// The size and the number of probed groups of full size.
  int ChooseSize(double smallSeconds, int small, int groups, int& fullGroups) const;

  /// Wall-clock seconds of coding, on a machine as busy as during rendering.
  double GetCodingSeconds(const GroupCosts& costs) const;

  vtkCSLFSampler* Sampler;
  EncodeSettings Settings;
  bool HasGeometry;
  Format Kind;
  double Seconds;
  int Resolution;
  int Samples;
  double Threads;
  BakeCosts Costs;
  FieldDetail Detail;
  vtkSmartPointer<vtkPolyData> Geometry;   ///< null if the sampler makes none
  std::optional<double> WholeCacheSeconds; ///< that have been measured
  double Growth = 1.5;
  std::string Error;
};
}

#endif
