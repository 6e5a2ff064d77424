// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCertificate.h"

#include "cslfJSON.h"
#include "cslfJSONText.h"
#include "cslfJoin.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iomanip>
#include <locale>
#include <sstream>

namespace cslf
{
namespace
{
constexpr double HighestPSNR = 60.0; // dB

///@{
/// What numbers are rounded to, as a part of 1.
constexpr double MeanDigits = 1e7;
constexpr double SquareDigits = 1e9;
constexpr double RMSDigits = 1e5;
constexpr double PSNRDigits = 1e2;
constexpr double ShareDigits = 1e4;
///@}

///@{
/// From how many standard errors on a measurement is worse: of the difference of two measurements,
/// and of one, for measurements of the same rays.
constexpr double ErrorsOfOthers = 4.0;
constexpr double ErrorsOfSame = 1.0;
///@}

/// From which ratio of squares on it is worse: 1 dB.
const double WorseRatio = std::pow(10.0, 0.1);

/// Dividing by a whole number gives the number with the fewest digits.
double RoundTo(double value, double digits)
{
  return std::round(value * digits) / digits;
}

double ToPSNR(double square)
{
  return square > 0.0 ? std::min(HighestPSNR, -10.0 * std::log10(square)) : HighestPSNR;
}

/// What the square of a measurement's own value must exceed to be worse.
double Allow(double square, double squareError, double laterError, bool hasSameRays)
{
  const double chance = hasSameRays ? ErrorsOfSame * std::max(squareError, laterError)
                                    : ErrorsOfOthers * std::hypot(squareError, laterError);
  const double known = std::max(square, 0.0);
  return std::max(WorseRatio * known, known + chance);
}

std::ostringstream MakeText()
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed;
  return text;
}
}

double Certificate::GetRMS() const
{
  return std::sqrt(std::max({ this->Square, this->SquareError, 0.0 }));
}

double Certificate::GetPSNR() const
{
  const double rms = this->GetRMS();
  return ToPSNR(rms * rms);
}

bool Certificate::HasSameRays(const Certificate& other) const
{
  return this->Rays == other.Rays && this->Samples == other.Samples && this->Seed == other.Seed &&
    this->Version == other.Version;
}

std::string Certificate::FindWorse(const Certificate& later) const
{
  const bool hasSameRays = this->HasSameRays(later);
  std::ostringstream text = MakeText();
  if (!(later.Square <= Allow(this->Square, this->SquareError, later.SquareError, hasSameRays)))
  {
    text << "the field has " << std::setprecision(2) << later.GetPSNR() << " dB, not "
         << this->GetPSNR() << " dB as its certificate says";
    return text.str();
  }
  const double mean = std::abs(this->Mean);
  const double allowed = std::sqrt(WorseRatio) * mean +
    (hasSameRays ? ErrorsOfSame * std::max(this->MeanError, later.MeanError)
                 : ErrorsOfOthers * std::hypot(this->MeanError, later.MeanError));
  if (!(std::abs(later.Mean) <= allowed))
  {
    text << std::setprecision(5) << "the field's colours differ in the mean by " << later.Mean
         << " of white, not by " << this->Mean << " as its certificate says";
  }
  return text.str();
}

Certificate Certificate::Round() const
{
  Certificate rounded = *this;
  rounded.Mean = RoundTo(this->Mean, MeanDigits);
  rounded.MeanError = RoundTo(this->MeanError, MeanDigits);
  rounded.Square = RoundTo(this->Square, SquareDigits);
  rounded.SquareError = RoundTo(this->SquareError, SquareDigits);
  rounded.Seen = RoundTo(this->Seen, ShareDigits);
  return rounded;
}

nlohmann::json Certificate::ToJSON() const
{
  const Certificate rounded = this->Round();
  return { { "rays", this->Rays }, { "samples", this->Samples }, { "seed", this->Seed },
    { "mean", rounded.Mean }, { "mean_error", rounded.MeanError },
    { "mean_square", rounded.Square }, { "mean_square_error", rounded.SquareError },
    { "rms", RoundTo(rounded.GetRMS(), RMSDigits) },
    { "psnr", RoundTo(rounded.GetPSNR(), PSNRDigits) }, { "seen", rounded.Seen },
    { "cslf", this->Version }, { "scene", this->Scene } };
}

std::optional<Certificate> Certificate::FromJSON(const nlohmann::json& json)
{
  try
  {
    Certificate certificate;
    certificate.Rays = ToInteger(json.at("rays"));
    certificate.Samples = ToInteger(json.at("samples"));
    certificate.Seed = ToInteger(json.at("seed"));
    certificate.Mean = json.at("mean").get<double>();
    certificate.MeanError = json.at("mean_error").get<double>();
    certificate.Square = json.at("mean_square").get<double>();
    certificate.SquareError = json.at("mean_square_error").get<double>();
    certificate.Seen = json.at("seen").get<double>();
    certificate.Version = json.at("cslf").get<std::string>();
    certificate.Scene = json.at("scene").get<std::string>();
    const bool isValid = certificate.Rays > 0 && certificate.Samples > 0 &&
      certificate.MeanError >= 0.0 && certificate.SquareError >= 0.0;
    return isValid ? std::make_optional(certificate) : std::nullopt;
  }
  catch (const std::exception&)
  {
    return std::nullopt;
  }
}

std::string Certificate::Describe() const
{
  std::ostringstream text = MakeText();
  text << std::setprecision(2) << this->GetPSNR() << " dB (rms " << std::setprecision(5)
       << this->GetRMS() << ", mean " << std::showpos << this->Mean << std::noshowpos << " +- "
       << this->MeanError << " of white), " << this->Rays << " rays of " << this->Samples
       << " samples, seed " << this->Seed << ", " << std::setprecision(0) << 100.0 * this->Seen
       << " % of them with a surface, CSLF " << MakePrintable(this->Version) << ", scene "
       << MakePrintable(this->Scene);
  return text.str();
}
}
