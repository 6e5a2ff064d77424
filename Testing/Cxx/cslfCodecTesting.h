// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Functions for tests of the encoder and the decoder.
 */
#ifndef cslfCodecTesting_h
#define cslfCodecTesting_h

#include "cslfTestField.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkCSLFDecoder;
class vtkCSLFEncoder;
class vtkImageData;

namespace cslf
{
namespace testing
{
/// An empty folder of that name in the tests' output folder (-T).
std::string MakeFolder(int argc, char* argv[], const std::string& name);

/// The closed-form field with byte colour and 16 bits of depth, in the cube [-1,1]^3.
vtkSmartPointer<vtkImageData> MakeByteField(int viewpoints, int resolution, bool depth = true);

/// Writes with an encoder whose other settings are set already. Nothing else may be left in the
/// folder.
bool Encode(vtkCSLFEncoder* encoder, vtkImageData* field, const std::string& fileName);

/// Reads the slices first to last, or all for last < 0. Null if the decoder failed.
vtkSmartPointer<vtkImageData> Decode(const std::string& fileName, int first = 0, int last = -1);

/// Whether the arrays of `part` equal those of `whole` in the slices of `part`.
bool HasEqualSlices(vtkImageData* part, vtkImageData* whole);

/// The difference of two fields: PSNR in dB, 200 if they are equal.
struct FieldPSNR
{
  double Color = 0.0;    ///< red, green, blue
  double Coverage = 0.0; ///< alpha
  double Depth = 0.0;    ///< where the reference is covered
};
FieldPSNR Compare(vtkImageData* image, vtkImageData* reference);

/// Collects the errors and warnings of an algorithm and its executive instead of printing them.
class Observed
{
public:
  explicit Observed(vtkAlgorithm* algorithm);
  ~Observed();

  int GetErrors() const;
  int GetWarnings() const;

  /// The warnings of the algorithm that contain the text.
  int CountWarnings(const std::string& text) const;

  /// Whether there was exactly one error of the algorithm, in one line, that contains the text.
  bool HasError(const std::string& text) const;
  bool HasWarning(const std::string& text) const;

private:
  class Command;
  vtkAlgorithm* Algorithm;
  Command* OfAlgorithm;
  Command* OfExecutive;
};

std::vector<char> ReadBytes(const std::string& fileName);
void WriteBytes(const std::string& fileName, const std::vector<char>& bytes);
bool Exists(const std::string& fileName);
}
}

#endif
