// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A program's messages on standard error: one line per error, one line per warning, and a progress
 * bar if it is a terminal.
 */
#ifndef cslfMessages_h
#define cslfMessages_h

#include <stdexcept>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkXMLReader;

namespace cslf::tool
{
/// Ends the command. If VTK has reported an error before, that one is shown, because it is the
/// cause.
struct Failure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Ends a command that would write a field with missing viewpoints, with its own exit code.
struct MissingViewpoints : Failure
{
  using Failure::Failure;
};

/// Sets the name of the program, which its messages begin with. By default, it is "cslf".
void SetProgramName(const std::string& name);

/// Catches VTK's messages from now on, and keeps them.
void CatchMessages();

/// The first error that VTK has reported, in one line. Empty if there is none.
std::string GetFirstError();

/// Throws a Failure if VTK has reported an error.
void ThrowOnError();

/// For files that a command can do without: as long as it exists, GetFirstError tells only later
/// errors. They and the warnings of that time are forgotten at its end.
class SeparateMessages
{
public:
  SeparateMessages();
  ~SeparateMessages();
  SeparateMessages(const SeparateMessages&) = delete;
  void operator=(const SeparateMessages&) = delete;

private:
  std::string Error;
  std::vector<std::string> Warnings;
};

/// For readers whose errors do not name the file: puts it in front of them.
void NameFileInErrors(vtkXMLReader* reader, const std::string& fileName);

/// The different warnings so far, each in one line.
std::vector<std::string> GetWarnings();

/// Adds one of the tool's own warnings.
void AddWarning(const std::string& text);

/// Prints the warnings. A command that fails prints only its error.
void PrintWarnings();

/// Warns if the noise of a reference, as a PSNR in dB, is too close to a figure measured against
/// it: less than 10 dB above. `figure` names what was measured, and `option` what lowers the noise.
void WarnOfNoise(
  double noiseFloor, double psnr, const std::string& figure, const std::string& option);

/// The same for a figure from which the noise has been subtracted, which must not be more than
/// twice the error.
void WarnOfRemovedNoise(
  double noiseFloor, double psnr, const std::string& figure, const std::string& option);

void PrintError(const std::string& text);

/// Prints a line for people who wait: only if standard error is a terminal.
void PrintNote(const std::string& text);

/// Shows the progress of a filter: the phase that it names by its ProgressText, or else this label.
/// Does nothing unless standard error is a terminal. The filter must outlive the bar.
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

/// As long as it exists, an interruption (Ctrl+C) says that the next run will resume this one.
class ResumableWork
{
public:
  ResumableWork();
  ~ResumableWork();
  ResumableWork(const ResumableWork&) = delete;
  void operator=(const ResumableWork&) = delete;
};
}

#endif
