// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A short look at what a bake costs: see vtkCSLFBakeEstimator.
 */
#ifndef cslfBakeProbe_h
#define cslfBakeProbe_h

#include "Coding/cslfEncodeProbe.h"
#include "Planning/cslfFieldDetail.h"

#include <string>

class vtkCSLFSampler;

namespace cslf
{
/// Seconds of wall-clock time, and the bytes of what is written.
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

  /// Changes the sampler's resolution and samples, and does not set them back. `seconds` are about
  /// the most that an estimate takes.
  BakeProbe(vtkCSLFSampler* sampler, EncodeSettings settings, Format kind, double seconds);

  ///@{
  /// False on failure: GetError says why.
  bool Estimate();

  /// The seconds of rendering all viewpoints with so many samples, from some of them.
  bool TimeRendering(int samples, double& seconds);
  ///@}

  const BakeCosts& GetCosts() const { return this->Costs; }
  /// Of the field that is probed.
  int GetResolution() const { return this->Resolution; }

  const FieldDetail& GetDetail() const { return this->Detail; }

  /// By what power of the texels along a tile's side the bytes grow.
  double GetGrowth() const { return this->Growth; }

  const std::string& GetError() const { return this->Error; }

private:
  bool EstimateVideo();
  bool EstimateImages();
  bool Begin(EncodeProbe& probe);
  void NoteScene(double seconds, double cacheSecondsBefore);
  void SetSize(int resolution, int samples);

  /// The resolution of groups in small size.
  int ChooseSmallResolution() const;

  /// How large groups in full size may be, and how many are probed.
  int ChooseSize(double smallSeconds, int small, int groups, int& fullGroups) const;

  /// Wall-clock seconds of coding, on a machine as busy as while it rendered.
  double GetCodingSeconds(const GroupCosts& costs) const;

  vtkCSLFSampler* Sampler;
  EncodeSettings Settings;
  Format Kind;
  double Seconds;
  int Resolution;
  int Samples;
  double Threads;
  BakeCosts Costs;
  FieldDetail Detail;
  double Growth = 1.5;
  std::string Error;
};
}

#endif
