// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMessages.h"

#include "cslfJoin.h"
#include "cslfTable.h"
#include "cslfTerminal.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkXMLReader.h>

#ifndef _WIN32
#include <unistd.h>
#endif

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <regex>
#include <utility>
#include <vector>

namespace cslf::tool
{
namespace
{
std::string programName = "cslf";

void PrintLine(const char* kind, const std::string& text)
{
  std::fprintf(stderr, "%s: %s: %s\n", programName.c_str(), kind, MakePrintable(text).c_str());
}

/// The message of VTK's macros without file, line and object, in one line.
std::string Clean(const char* message)
{
  static const std::regex place("^[A-Za-z ]*: ?In [^\n]*, line [0-9]+\n");
  static const std::regex object("^vtk[A-Za-z0-9_]+ \\((0x)?[0-9a-fA-F]+\\): ");
  static const std::regex space("\\s+");
  std::string text = std::regex_replace(message, place, "");
  text = std::regex_replace(text, object, "");
  text = std::regex_replace(text, space, " ");
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

class vtkMessageCatcher : public vtkOutputWindow
{
public:
  static vtkMessageCatcher* New();
  vtkTypeMacro(vtkMessageCatcher, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayWarningText(const char* text) override { this->AddWarning(Clean(text)); }
  void DisplayGenericWarningText(const char* text) override { this->AddWarning(Clean(text)); }

  void DisplayErrorText(const char* text) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const std::string error = Clean(text);
    // The executive repeats the filter's message without its reason.
    if (this->FirstError.empty() && error.find("returned failure for request") == std::string::npos)
    {
      this->FirstError = error;
    }
  }

  std::string GetFirstError()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->FirstError;
  }

  std::vector<std::string> GetWarnings()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Warnings;
  }

  void AddWarning(const std::string& warning)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (std::find(this->Warnings.begin(), this->Warnings.end(), warning) == this->Warnings.end())
    {
      this->Warnings.push_back(warning);
    }
  }

  void Exchange(std::string& error, std::vector<std::string>& warnings)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->FirstError.swap(error);
    this->Warnings.swap(warnings);
  }

protected:
  vtkMessageCatcher() = default;

private:
  std::mutex Mutex;
  std::string FirstError;
  std::vector<std::string> Warnings;
};

vtkStandardNewMacro(vtkMessageCatcher);

vtkMessageCatcher* GetCatcher()
{
  return vtkMessageCatcher::SafeDownCast(vtkOutputWindow::GetInstance());
}

using Clock = std::chrono::steady_clock;

/// The contents of a progress bar.
struct Bar
{
  explicit Bar(std::string label)
    : Label(std::move(label))
    , Phase(this->Label)
  {
    this->Print(0.0);
  }

  /// Shows the phase that the algorithm names, or else the label.
  void Show(const char* text, double progress)
  {
    const auto now = Clock::now();
    const std::string phase = text && *text ? text : this->Label;
    if (phase != this->Phase)
    {
      this->Phase = phase;
      this->PhaseStart = now;
      this->PhaseProgress = progress;
    }
    else if (now - this->Shown < std::chrono::milliseconds(100))
    {
      return;
    }
    this->Shown = now;
    this->Print(std::clamp(progress, 0.0, 1.0));
  }

  void Print(double progress) const
  {
    constexpr int width = 30;
    const int filled = static_cast<int>(width * progress);
    std::fprintf(stderr, "\r%s [%s%s] %3d %%%s\033[K", this->Phase.c_str(),
      std::string(filled, '#').c_str(), std::string(width - filled, ' ').c_str(),
      static_cast<int>(100.0 * progress), this->DescribeRest(progress).c_str());
    std::fflush(stderr);
  }

  /// The time left, at the speed of this phase. Empty until that is known.
  std::string DescribeRest(double progress) const
  {
    constexpr double leastSeconds = 2.0;
    constexpr double leastProgress = 0.01;
    const double seconds = std::chrono::duration<double>(Clock::now() - this->PhaseStart).count();
    const double done = progress - this->PhaseProgress;
    if (seconds < leastSeconds || done < leastProgress)
    {
      return {};
    }
    const auto left = static_cast<long>(seconds * (1.0 - progress) / done + 0.5);
    char text[64];
    std::snprintf(text, sizeof(text), ", %ld:%02ld left", left / 60, left % 60);
    return text;
  }

  std::string Label;
  std::string Phase;
  Clock::time_point PhaseStart = Clock::now();
  Clock::time_point Shown;
  double PhaseProgress = 0.0; ///< at its start

  static void OnProgress(vtkObject* caller, unsigned long, void* self, void* progress)
  {
    auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
    static_cast<Bar*>(self)->Show(
      algorithm ? algorithm->GetProgressText() : nullptr, *static_cast<double*>(progress));
  }
  static void Delete(void* self) { delete static_cast<Bar*>(self); }
};
}

void SetProgramName(const std::string& name)
{
  programName = name;
}

void CatchMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<vtkMessageCatcher> catcher;
  vtkOutputWindow::SetInstance(catcher);
}

std::string GetFirstError()
{
  vtkMessageCatcher* catcher = GetCatcher();
  return catcher ? catcher->GetFirstError() : std::string();
}

void ThrowOnError()
{
  const std::string error = GetFirstError();
  if (!error.empty())
  {
    throw Failure(error);
  }
}

SeparateMessages::SeparateMessages()
{
  if (vtkMessageCatcher* catcher = GetCatcher())
  {
    catcher->Exchange(this->Error, this->Warnings);
  }
}

SeparateMessages::~SeparateMessages()
{
  if (vtkMessageCatcher* catcher = GetCatcher())
  {
    catcher->Exchange(this->Error, this->Warnings);
  }
}

void NameFileInErrors(vtkXMLReader* reader, const std::string& fileName)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new std::string(fileName));
  command->SetClientDataDeleteCallback([](void* data) { delete static_cast<std::string*>(data); });
  command->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* text)
    {
      const std::string error = Clean(static_cast<const char*>(text));
      const std::string& name = *static_cast<std::string*>(data);
      const bool isNamed = error.find(name) != std::string::npos;
      vtkOutputWindow::GetInstance()->DisplayErrorText(
        isNamed ? error.c_str() : ("Cannot read " + name + ": " + error).c_str());
    });
  reader->AddObserver(vtkCommand::ErrorEvent, command);
  reader->SetParserErrorObserver(command);
}

std::vector<std::string> GetWarnings()
{
  vtkMessageCatcher* catcher = GetCatcher();
  return catcher ? catcher->GetWarnings() : std::vector<std::string>();
}

void AddWarning(const std::string& text)
{
  if (vtkMessageCatcher* catcher = GetCatcher())
  {
    catcher->AddWarning(text);
  }
}

void WarnOfNoise(
  double noiseFloor, double psnr, const std::string& figure, const std::string& option)
{
  constexpr double margin = 10.0;
  if (noiseFloor < psnr + margin)
  {
    AddWarning("The reference's noise floor of " + Format(noiseFloor, 2) +
      " dB is less than 10 dB above " + figure + ": use more " + option + ".");
  }
}

void WarnOfRemovedNoise(
  double noiseFloor, double psnr, const std::string& figure, const std::string& option)
{
  constexpr double margin = 3.0;
  if (noiseFloor + margin < psnr)
  {
    AddWarning("The error of " + figure + " is less than half of the reference's noise, " +
      Format(noiseFloor, 2) + " dB: use more " + option + ".");
  }
}

void PrintWarnings()
{
  for (const std::string& warning : GetWarnings())
  {
    PrintLine("warning", warning);
  }
}

void PrintNote(const std::string& text)
{
  if (IsErrorTerminal())
  {
    std::fprintf(stderr, "\r\033[K%s: %s\n", programName.c_str(), MakePrintable(text).c_str());
  }
}

void PrintError(const std::string& text)
{
  PrintLine("error", Clean(text.c_str()));
}

ProgressBar::ProgressBar(vtkAlgorithm* algorithm, const std::string& label)
  : Algorithm(algorithm)
{
  if (IsErrorTerminal())
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetCallback(Bar::OnProgress);
    command->SetClientData(new Bar(label));
    command->SetClientDataDeleteCallback(Bar::Delete);
    this->Observer = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  }
}

ProgressBar::~ProgressBar()
{
  if (this->Observer != 0)
  {
    this->Algorithm->RemoveObserver(this->Observer);
    std::fprintf(stderr, "\r\033[K");
  }
}

#ifndef _WIN32
namespace
{
/// Prints a line, and ends the process as without this handler.
void OnInterruption(int signal)
{
  const char* text = ::isatty(STDERR_FILENO) ? "\r\033[Kcslf: interrupted: rerun to resume\n"
                                             : "cslf: interrupted: rerun to resume\n";
  static_cast<void>(::write(STDERR_FILENO, text, std::strlen(text)) + 1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}
}

ResumableWork::ResumableWork()
{
  // What is started in the background may ignore it.
  if (std::signal(SIGINT, OnInterruption) == SIG_IGN)
  {
    std::signal(SIGINT, SIG_IGN);
  }
}

ResumableWork::~ResumableWork()
{
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN)
  {
    std::signal(SIGINT, SIG_IGN);
  }
}
#else
ResumableWork::ResumableWork() = default;
ResumableWork::~ResumableWork() = default;
#endif
}
