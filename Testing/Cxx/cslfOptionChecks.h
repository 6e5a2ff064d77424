// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Compares setters of options with the rows of the table of options.
 */
#ifndef cslfOptionChecks_h
#define cslfOptionChecks_h

#include "Options/cslfOption.h"
#include "cslfTesting.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <limits>

namespace cslf
{
namespace testing
{
/// A number has the row's default and range, and a change, but nothing else, is a modification.
template <typename T, typename Object>
void CheckOption(
  const NumberOption<T>& row, Object* object, void (Object::*set)(T), T (Object::*get)())
{
  CSLF_CHECK((object->*get)() == row.Default);
  const T change = row.Default < row.Maximum ? row.Maximum : row.Minimum;
  const auto before = object->GetMTime();
  (object->*set)(row.Default);
  CSLF_CHECK(object->GetMTime() == before);
  (object->*set)(change);
  CSLF_CHECK((object->*get)() == change && object->GetMTime() > before);
  if (row.Minimum > std::numeric_limits<T>::lowest() / 2)
  {
    (object->*set)(row.Minimum - 1);
    CSLF_CHECK((object->*get)() == row.Minimum);
  }
  if (row.Maximum < std::numeric_limits<T>::max() / 2)
  {
    (object->*set)(2 * row.Maximum + 1);
    CSLF_CHECK((object->*get)() == row.Maximum);
  }
  (object->*set)(row.Default);
}

/// A switch has the row's default.
template <typename Object>
void CheckOption(
  const Option<bool>& row, Object* object, void (Object::*set)(bool), bool (Object::*get)())
{
  CSLF_CHECK((object->*get)() == row.Default);
  const auto before = object->GetMTime();
  (object->*set)(!row.Default);
  CSLF_CHECK((object->*get)() != row.Default && object->GetMTime() > before);
  (object->*set)(row.Default);
}

/// A vector has the row's default.
template <typename Row>
void CheckVector(const Row& row, const double vector[3])
{
  CSLF_CHECK(vector[0] == row.Default[0] && vector[1] == row.Default[1]);
  CSLF_CHECK(vector[2] == row.Default[2]);
}

/// Counts the executions of a filter.
class ExecutionCounter
{
public:
  explicit ExecutionCounter(vtkAlgorithm* filter)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long, void* self, void*)
      { ++static_cast<ExecutionCounter*>(self)->Count; });
    filter->AddObserver(vtkCommand::StartEvent, command);
  }

  /// The executions since the last call.
  int Take()
  {
    const int count = this->Count;
    this->Count = 0;
    return count;
  }

private:
  int Count = 0;
};
}
}

#endif
