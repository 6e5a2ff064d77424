// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The interpreter, such as Python's, from which the library is called. It holds a lock while it
 * calls, and gets signals such as Ctrl-C, which it handles when the call is over. Long calls
 * therefore give the lock away while they compute, and ask whether a signal shall end them.
 */
#ifndef cslfInterpreter_h
#define cslfInterpreter_h

#include "vtkCSLFModule.h" // for export macro

namespace cslf
{
/// What an interpreter implements. The methods are called in any thread, also in those that the
/// interpreter does not know, and must not throw.
class Interpreter
{
public:
  ///@{
  /// A long call begins and ends in this thread. There may be others in it.
  virtual void BeginCall() = 0;
  virtual void EndCall() = 0;
  ///@}

  /// Whether a signal shall end this thread's long call. It remains so until the outermost one
  /// ends. Called often, while this thread holds the lock or not.
  virtual bool IsInterrupted() = 0;

  ///@{
  /// Gives the lock away, so that other threads of the interpreter go on, and takes it back. Unlock
  /// returns null, and Lock is not called, if this thread does not hold the lock.
  virtual void* Unlock() = 0;
  virtual void Lock(void* state) = 0;
  ///@}

  ///@{
  /// Takes the lock for a while in a thread that has given it away, and gives it away again. Borrow
  /// returns false, and Return is not called, in other threads.
  virtual bool Borrow() = 0;
  virtual void Return() = 0;
  ///@}

protected:
  ~Interpreter() = default;
};

/// Sets the interpreter of this process, which must live as long as the process. Called while no
/// method of the library is at work.
VTKCSLF_EXPORT void SetInterpreter(Interpreter* interpreter);

/// Whether the interpreter's user wants this thread's long call to end.
VTKCSLF_EXPORT bool IsInterrupted();

/// A long call, while it exists.
class VTKCSLF_EXPORT LongCall
{
public:
  LongCall();
  ~LongCall();
  LongCall(const LongCall&) = delete;
  LongCall& operator=(const LongCall&) = delete;
};

/// While it exists, the interpreter's other threads go on. Nothing that may call the interpreter is
/// done meanwhile, unless with WithLock: no event of VTK is invoked, so neither progress nor errors
/// are reported.
class VTKCSLF_EXPORT WithoutLock
{
public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

private:
  void* State = nullptr;
};

/// Within the time of a WithoutLock: while it exists, the thread that created that may call the
/// interpreter, and invoke events of VTK. At other times, it does nothing.
class VTKCSLF_EXPORT WithLock
{
public:
  WithLock();
  ~WithLock();
  WithLock(const WithLock&) = delete;
  WithLock& operator=(const WithLock&) = delete;

private:
  bool IsBorrowed = false;
};
}

#endif
