// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCertifier.h"

#include "Pipeline/cslfFieldStream.h"
#include "cslfColor.h"
#include "cslfShownPixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace cslf
{
namespace
{
/// The progress when the field has been looked up.
constexpr double LookUpShare = 0.4;

/// The mean of numbers, and its standard error.
class MeanOfRays
{
public:
  void Add(double value)
  {
    this->Count += 1.0;
    this->Sum += value;
    this->Squares += value * value;
  }

  double GetMean() const { return this->Sum / this->Count; }

  double GetError() const
  {
    const double mean = this->GetMean();
    const double variance = std::max(0.0, this->Squares / this->Count - mean * mean);
    return std::sqrt(variance / std::max(1.0, this->Count - 1.0));
  }

private:
  double Count = 0.0;
  double Sum = 0.0;
  double Squares = 0.0;
};

glm::dvec3 Encode(const glm::dvec4& mean)
{
  return EncodeRadiance(glm::dvec3(mean), mean.w);
}

/// The displayed colour of a half of a pixel, whose parts these are.
glm::dvec3 EncodeHalf(const glm::dvec4& first, const glm::dvec4& second)
{
  return 2.0 * Encode(0.5 * (first + second)) - 0.5 * (Encode(first) + Encode(second));
}

bool HasSurface(const TracedPixel& pixel)
{
  return std::any_of(std::begin(pixel.Means), std::end(pixel.Means),
    [](const glm::dvec4& mean) { return mean.w > 0.0; });
}

/// The colours that the field shows, or nothing after an error.
std::vector<glm::dvec4> LookUp(FieldStream& stream, vtkPolyData* geometry,
  const std::vector<PixelBeam>& beams, const Progress& progress)
{
  ShownPixels shown(stream.GetDescription(), geometry, beams);
  const std::vector<ViewpointBand> bands = shown.PlanBands();
  for (std::size_t k = 0; k < bands.size(); ++k)
  {
    const double share = static_cast<double>(k) / static_cast<double>(bands.size());
    if (!progress(share) || !stream.Read(bands[k].Slices))
    {
      return {};
    }
    shown.LookUp(bands[k], stream.GetImage());
  }
  return shown.GetColors();
}

void Compare(const std::vector<glm::dvec4>& shown, const std::vector<TracedPixel>& traced,
  Certificate& certificate)
{
  MeanOfRays difference;
  MeanOfRays square;
  int seen = 0;
  for (std::size_t ray = 0; ray < shown.size(); ++ray)
  {
    const glm::dvec4* parts = traced[ray].Means;
    const glm::dvec3 a = glm::dvec3(shown[ray]) - EncodeHalf(parts[0], parts[1]);
    const glm::dvec3 b = glm::dvec3(shown[ray]) - EncodeHalf(parts[2], parts[3]);
    difference.Add((a.x + a.y + a.z + b.x + b.y + b.z) / 6.0);
    square.Add((a.x * b.x + a.y * b.y + a.z * b.z) / 3.0);
    seen += shown[ray].w > 0.0 || HasSurface(traced[ray]) ? 1 : 0;
  }
  certificate.Mean = difference.GetMean();
  certificate.MeanError = difference.GetError();
  certificate.Square = square.GetMean();
  certificate.SquareError = square.GetError();
  certificate.Seen = static_cast<double>(seen) / static_cast<double>(shown.size());
}
}

bool MeasureCertificate(vtkAlgorithmOutput* field, vtkPolyData* geometry, const PixelTracer& trace,
  const CertificateSettings& settings, const Progress& progress, Certificate& certificate,
  std::string& error)
{
  FieldStream stream(field);
  error = "The field could not be read.";
  if (!stream.Open() || !stream.Read({ stream.GetWhole().First, stream.GetWhole().First }))
  {
    error = stream.GetError().empty() ? error : stream.GetError();
    return false;
  }
  const Description description = stream.GetDescription();
  if (stream.GetWhole().GetCount() != description.Grid.GetSlices())
  {
    error = "The field does not have all of its viewpoints.";
    return false;
  }
  if (!description.FindChannel(KnownChannel::Color))
  {
    error = "The field has no colours.";
    return false;
  }
  certificate.Rays = settings.Rays;
  certificate.Samples =
    (settings.Samples + TracedPixel::PathStep - 1) / TracedPixel::PathStep * TracedPixel::PathStep;
  certificate.Seed = settings.Seed;
  certificate.Version = CSLF_VERSION;
  const auto beams = MakePixelBeams(description.Box, settings.Rays, settings.Seed);
  const auto shown = LookUp(stream, geometry, beams, Within(progress, 0.0, LookUpShare));
  std::vector<TracedPixel> traced;
  if (shown.empty() ||
    !trace(beams, certificate.Samples, settings.Seed, Within(progress, LookUpShare, 1.0), traced))
  {
    error = stream.GetError();
    return false;
  }
  Compare(shown, traced, certificate);
  certificate = certificate.Round();
  error.clear();
  return true;
}
}
