// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What all long methods do. No exception may leave them, because VTK and its users do not expect
 * any, and programs would end. An interpreter that called them can end them.
 */
#ifndef cslfGuard_h
#define cslfGuard_h

#include "Pipeline/cslfInterpreter.h"
#include "Pipeline/cslfVTKCompatibility.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationVector.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace cslf
{
/// Does `work()`, which may be long, and returns its result. If it throws, returns false and gives
/// the reason.
template <typename Work>
bool Guard(const Work& work, std::string& problem)
{
  const LongCall call;
  try
  {
    return work();
  }
  catch (const std::bad_alloc&)
  {
    problem = "there is not enough memory";
  }
  catch (const std::length_error&)
  {
    // A container's size is beyond what memory can hold.
    problem = "there is not enough memory";
  }
  catch (const std::system_error& error)
  {
    // A thread could not be started.
    problem = error.code() == std::errc::resource_unavailable_try_again
      ? "there is not enough memory, or there are too many threads"
      : error.what();
  }
  catch (const std::exception& exception)
  {
    problem = exception.what();
  }
  catch (...)
  {
    problem = "there was an unknown error";
  }
  return false;
}

/// Does the `work()` of an object's method and returns its result. If it throws, the object reports
/// an error that begins with `failure`, and the result is 0 or false.
template <typename Work>
auto GuardMethod(vtkObject* object, const std::string& failure, const Work& work)
{
  decltype(work()) result{};
  std::string problem;
  Guard(
    [&]
    {
      result = work();
      return true;
    },
    problem);
  if (!problem.empty())
  {
    vtkErrorWithObjectMacro(object, << failure << ": " << problem << ".");
    result = {};
  }
  return result;
}

/// Keeps VTK from printing the request that a filter could not fulfil: many lines, after the error
/// in which the filter has given the reason.
class FailedRequestObserver : public vtkCommand
{
public:
  /// Observes an executive until it reports that the current request of its filter has failed.
  static void Add(vtkExecutive* executive)
  {
    if (executive && vtkObject::GetGlobalWarningDisplay())
    {
      auto observer = vtkSmartPointer<FailedRequestObserver>::Take(new FailedRequestObserver);
      executive->AddObserver(vtkCommand::ErrorEvent, observer);
    }
  }

  void Execute(vtkObject* executive, unsigned long, void* text) override
  {
    const char* message = static_cast<const char*>(text);
    if (message && !std::strstr(message, "returned failure for request"))
    {
      vtkOutputWindow::GetInstance()->DisplayErrorText(message);
    }
    executive->RemoveObserver(this);
  }
};

/// The same for ProcessRequest, which makes a filter's outputs: they are empty then, and the
/// request is not printed, since filters report why they fail. If the filter was aborted, all are
/// empty, as newer versions of VTK have it, and the next request makes them; if the
/// interpreter's user ended it, the request also fails. After a failure it also drops the extents
/// that VTK combines the next request with, which VTK does only after success: they could be beyond
/// what the output is after a change.
template <typename Work>
vtkTypeBool GuardRequest(
  vtkAlgorithm* filter, vtkInformation* request, vtkInformationVector* outputs, const Work& work)
{
  const LongCall call;
  bool isDone = false;
  vtkTypeBool result = GuardMethod(filter, "The output cannot be made",
    [&]
    {
      const vtkTypeBool made = work();
      isDone = true;
      return made;
    });
  const bool makesData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) != 0;
  const bool isAborted = makesData && IsAborted(filter);
  result = isAborted && IsInterrupted() ? 0 : result;
  isDone = isDone && !isAborted;
  if (!result)
  {
    FailedRequestObserver::Add(filter->GetExecutive());
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    vtkDataObject* data = vtkDataObject::GetData(output);
    if (isAborted && data)
    {
      data->ReleaseData();
      output->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
    else if (makesData && !isDone && data &&
      !output->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()))
    {
      data->Initialize();
    }
    if ((makesData && !result) || request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
    {
      output->Remove(vtkStreamingDemandDrivenPipeline::COMBINED_UPDATE_EXTENT());
    }
  }
  return result;
}
}

/// Defines a filter's ProcessRequest, through which VTK calls RequestInformation,
/// RequestUpdateExtent and RequestData, so that no exception leaves any of them.
#define cslfGuardedRequestMacro(Class)                                                             \
  vtkTypeBool Class::ProcessRequest(                                                               \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    return cslf::GuardRequest(this, request, outputs,                                              \
      [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });                 \
  }                                                                                                \
  static_assert(true, "a semicolon follows")

#endif
