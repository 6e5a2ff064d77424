// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Codes and decodes a light field in many ways and measures each.
 */
#ifndef cslfCodecSweep_h
#define cslfCodecSweep_h

#include "Fields/cslfFieldFiles.h"
#include "Measurements/cslfNovelViews.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cslf::tool
{
/// The size and the quality that curves of quality against size are made of.
struct RatePoint
{
  double Bytes = 0.0;
  double PSNR = 0.0; ///< in dB
};

/// The results of one way of coding.
struct CodecPoint
{
  double CRF = 0.0;
  double Bytes = 0.0;                                 ///< of the file
  double Ratio = 0.0;                                 ///< of 24 bits per texel to these
  std::vector<std::pair<std::string, double>> Tracks; ///< the bytes of each, colour first
  double FieldPSNR = 0.0;                             ///< of red, green and blue, in dB
  std::map<std::string, double> Channels;             ///< PSNR of every channel
  double EncodeRate = 0.0;                            ///< in millions of texels per second
  double DecodeRate = 0.0;                            ///< likewise
  std::vector<double> ViewPSNR;                       ///< for each lookup, the mean of the views
};

class CodecSweep
{
public:
  /// For a whole field. Makes one video after the other in the folder, each `repeats` times. The
  /// last one is removed with the sweep.
  CodecSweep(vtkImageData* field, const Layout& grid, const std::string& folder, int repeats);
  ~CodecSweep();
  CodecSweep(const CodecSweep&) = delete;
  CodecSweep& operator=(const CodecSweep&) = delete;

  /// Also measures novel views with these lookups.
  void SetViews(std::vector<NovelView> views, std::vector<LookupName> lookups);
  const std::vector<LookupName>& GetLookups() const { return this->Lookups; }

  /// Codes, decodes and compares. Throws a Failure. The label is for progress bars.
  CodecPoint Measure(const CodingOptions& coding, const std::string& label);

private:
  double Encode(const CodingOptions& coding, const std::string& label);
  vtkSmartPointer<vtkImageData> Decode(CodecPoint& point, double& seconds);
  void CompareField(vtkImageData* decoded, CodecPoint& point);
  void CompareViews(vtkImageData* decoded, CodecPoint& point);

  vtkSmartPointer<vtkImageData> Field;
  Layout Grid;
  std::string FileName;
  bool HasWritten = false;
  int Repeats;
  std::vector<NovelView> Views;
  std::vector<LookupName> Lookups;
};
}

#endif
