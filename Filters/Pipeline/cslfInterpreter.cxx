// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfInterpreter.h"

#include <atomic>

namespace cslf
{
namespace
{
std::atomic<Interpreter*> TheInterpreter{ nullptr };
}

void SetInterpreter(Interpreter* interpreter)
{
  TheInterpreter = interpreter;
}

bool IsInterrupted()
{
  Interpreter* interpreter = TheInterpreter;
  return interpreter && interpreter->IsInterrupted();
}

LongCall::LongCall()
{
  if (Interpreter* interpreter = TheInterpreter)
  {
    interpreter->BeginCall();
  }
}

LongCall::~LongCall()
{
  if (Interpreter* interpreter = TheInterpreter)
  {
    interpreter->EndCall();
  }
}

WithoutLock::WithoutLock()
{
  if (Interpreter* interpreter = TheInterpreter)
  {
    this->State = interpreter->Unlock();
  }
}

WithoutLock::~WithoutLock()
{
  if (this->State)
  {
    TheInterpreter.load()->Lock(this->State);
  }
}

WithLock::WithLock()
{
  Interpreter* interpreter = TheInterpreter;
  this->IsBorrowed = interpreter && interpreter->Borrow();
}

WithLock::~WithLock()
{
  if (this->IsBorrowed)
  {
    TheInterpreter.load()->Return();
  }
}
}
