// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the tool tells its user on standard error: one line an error, one line a warning, and a
 * progress bar where that is a terminal.
 */
#ifndef cslfMessages_h
#define cslfMessages_h

#include <stdexcept>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkXMLReader;

namespace cslf
{
namespace tool
{
/// Ends the command. An error that VTK has reported before is the one shown, being the cause.
struct Failure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Ends a command that would write what lacks viewpoints: with an exit code of its own.
struct MissingViewpoints : Failure
{
  using Failure::Failure;
};

/// Catches VTK's messages from now on, and keeps them.
void CatchMessages();

/// The first error VTK has reported, in one line; empty where there is none.
std::string GetFirstError();

/// Throws a Failure if VTK has reported an error.
void ThrowOnError();

/// For readers whose errors do not name the file: puts it in front of them.
void NameFileInErrors(vtkXMLReader* reader, const std::string& fileName);

/// The different warnings so far, each in one line.
std::vector<std::string> GetWarnings();

/// Adds a warning of the tool's own.
void AddWarning(const std::string& text);

/// Prints the warnings. A command that fails prints its error alone.
void PrintWarnings();

/// Warns where the noise of a truth, as a PSNR in dB, is too near to a figure measured against it:
/// less than 10 dB above. `figure` is of what, and `option` is what lowers the noise.
void WarnOfNoise(
  double noiseFloor, double psnr, const std::string& figure, const std::string& option);

void PrintError(const std::string& text);

/// Shows the progress of a filter under this label. Does nothing unless standard error is a
/// terminal. The filter must outlive the bar.
class ProgressBar
{
public:
  ProgressBar(vtkAlgorithm* algorithm, const std::string& label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  void operator=(const ProgressBar&) = delete;

private:
  vtkAlgorithm* Algorithm;
  unsigned long Observer = 0;
};
}
}

#endif
