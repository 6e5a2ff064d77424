// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The module cslf._interpreter, which makes Python the interpreter of the library: other threads of
// Python go on while the library computes, and Ctrl-C ends its long calls.
//
// VTK's wrappers hold Python's lock during a call. Python's handler of Ctrl-C would then raise
// KeyboardInterrupt in the next function of Python that runs, which may be an observer of an event,
// where VTK ends the process. So during a long call the handler is one of this module. It keeps
// the exception until the outermost call of VTK has returned to the function that called it, and
// raises it there by a pending call. Python makes those between two instructions of a function,
// whereas it also handles signals within builtin functions, such as print, which VTK may call.
//
// When Python has ended, threads that take its lock end, too: their stack is unwound, and C++ code
// does not survive that. So before its end, calls in other threads are ended, and no others begin.
#include <Python.h>

#include "Pipeline/cslfInterpreter.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>
#include <vector>

namespace
{
/// A strong reference.
class Reference
{
public:
  explicit Reference(PyObject* object = nullptr)
    : Object(object)
  {
  }
  ~Reference() { Py_XDECREF(this->Object); }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  void Reset(PyObject* object)
  {
    PyObject* old = this->Object;
    this->Object = object;
    Py_XDECREF(old);
  }
  PyObject* Release()
  {
    PyObject* object = this->Object;
    this->Object = nullptr;
    return object;
  }
  PyObject* Get() const { return this->Object; }

private:
  PyObject* Object;
};

/// Holds Python's lock, in a thread that has held it before or holds it.
class LockHolder
{
public:
  LockHolder() = default;
  ~LockHolder() { PyGILState_Release(this->State); }
  LockHolder(const LockHolder&) = delete;
  LockHolder& operator=(const LockHolder&) = delete;

private:
  PyGILState_STATE State = PyGILState_Ensure();
};

/// Whether Python runs, and knows this thread.
bool IsThreadOfPython()
{
  return Py_IsInitialized() && PyGILState_GetThisThreadState();
}

/// Whether a frame waits for another one, which it has called.
bool IsBelow(PyObject* frame, PyFrameObject* other)
{
  Py_INCREF(other);
  for (Reference place(reinterpret_cast<PyObject*>(other)); place.Get();)
  {
    place.Reset(
      reinterpret_cast<PyObject*>(PyFrame_GetBack(reinterpret_cast<PyFrameObject*>(place.Get()))));
    if (place.Get() == frame)
    {
      return true;
    }
  }
  return false;
}

class PythonInterpreter final : public cslf::Interpreter
{
public:
  static PythonInterpreter* Get()
  {
    static auto* interpreter = new PythonInterpreter; // used until the process ends
    return interpreter;
  }

  void BeginCall() override
  {
    if (!IsThreadOfPython())
    {
      return;
    }
    this->CountCall();
    if (this->Thread.load() == std::this_thread::get_id())
    {
      ++this->Depth;
      return;
    }
    const LockHolder lock;
    auto* frame = reinterpret_cast<PyObject*>(PyEval_GetFrame());
    if (this->Thread.load() != std::thread::id() || !frame || PyErr_Occurred())
    {
      return;
    }
    // A call by an observer, after the outer call was interrupted, ends at once.
    const bool isInner = this->IsStopped;
    if (isInner && this->StoppedThread != std::this_thread::get_id())
    {
      return;
    }
    if (isInner || this->InstallHandler())
    {
      this->Thread = std::this_thread::get_id();
      this->Depth = 1;
      this->NextCheck = {};
      if (!isInner)
      {
        Py_INCREF(frame);
        this->Frame.Reset(frame);
      }
    }
  }

  void EndCall() override
  {
    if (this->Thread.load() == std::this_thread::get_id() && --this->Depth == 0)
    {
      const LockHolder lock;
      this->HandleSignals();
      this->Thread = std::thread::id();
      if (this->IsStopped)
      {
        this->RaiseSoon();
      }
      else
      {
        this->RestoreHandler();
        this->Frame.Reset(nullptr);
      }
    }
    this->UncountCall();
  }

  bool IsInterrupted() override
  {
    // Only Python's main thread handles signals.
    if (this->Thread.load() != std::this_thread::get_id())
    {
      return Calls > 0 && this->IsEndedByExit();
    }
    constexpr std::chrono::milliseconds pause(20);
    const auto now = std::chrono::steady_clock::now();
    if (!this->IsStopped && now >= this->NextCheck && Py_IsInitialized())
    {
      this->NextCheck = now + pause;
      const LockHolder lock;
      this->HandleSignals();
      // Other threads get their turn.
      Py_BEGIN_ALLOW_THREADS;
      Py_END_ALLOW_THREADS;
    }
    return this->IsStopped;
  }

  void* Unlock() override
  {
    if (IsWithoutLock || !IsThreadOfPython() || !PyGILState_Check())
    {
      return nullptr;
    }
    IsWithoutLock = true;
    return PyEval_SaveThread();
  }

  void Lock(void* state) override
  {
    this->WaitIfOver();
    PyEval_RestoreThread(static_cast<PyThreadState*>(state));
    IsWithoutLock = false;
  }

  bool Borrow() override
  {
    if (!IsWithoutLock || !Py_IsInitialized())
    {
      return false;
    }
    this->WaitIfOver();
    Borrowed.push_back(PyGILState_Ensure());
    return true;
  }

  void Return() override
  {
    const PyGILState_STATE state = Borrowed.back();
    Borrowed.pop_back();
    PyGILState_Release(state);
  }

  /// The handler during long calls, and until their exception is raised: calls the user's, and
  /// keeps its exception.
  static PyObject* Handle(PyObject*, PyObject* arguments)
  {
    PythonInterpreter* self = Get();
    if (self->Thread.load() == std::thread::id() && self->IsStopped)
    {
      self->RaiseSoon();
      Py_RETURN_NONE;
    }
    const Reference result(PyObject_CallObject(self->Handler.Get(), arguments));
    if (!result.Get())
    {
      self->Stop();
    }
    Py_RETURN_NONE;
  }

  /// Python is about to end: ends the long calls in other threads and waits until they have
  /// returned, but not for ever, because they may wait for this thread.
  static PyObject* EndCalls(PyObject*, PyObject*)
  {
    PythonInterpreter* self = Get();
    constexpr std::chrono::seconds patience(10);
    const int own = Calls > 0 ? 1 : 0;
    Py_BEGIN_ALLOW_THREADS;
    {
      std::unique_lock<std::mutex> lock(self->CallsMutex);
      self->ExitThread = std::this_thread::get_id();
      self->CallEnded.wait_for(lock, patience, [&] { return self->ThreadsInCalls == own; });
      self->IsOver = true;
    }
    Py_END_ALLOW_THREADS;
    Py_RETURN_NONE;
  }

  /// Has Python call EndCalls before its end. Returns false if that fails.
  static bool RegisterEndCalls()
  {
    static PyMethodDef method = { "end_calls", &PythonInterpreter::EndCalls, METH_NOARGS, nullptr };
    const Reference function(PyCFunction_New(&method, nullptr));
    const Reference module(PyImport_ImportModule("atexit"));
    return function.Get() && module.Get() &&
      Reference(PyObject_CallMethod(module.Get(), "register", "O", function.Get())).Get();
  }

private:
  ///@{
  /// Counts the threads that are in long calls. Calls of other threads than the one that ends
  /// Python do not begin any more when it does.
  void CountCall()
  {
    if (Calls++ == 0)
    {
      std::unique_lock<std::mutex> lock(this->CallsMutex);
      if (this->IsEndedByExit())
      {
        lock.unlock();
        Wait();
      }
      ++this->ThreadsInCalls;
    }
  }
  void UncountCall()
  {
    if (Calls > 0 && --Calls == 0)
    {
      const std::lock_guard<std::mutex> lock(this->CallsMutex);
      --this->ThreadsInCalls;
      this->CallEnded.notify_all();
    }
  }
  ///@}

  /// Whether another thread ends Python.
  bool IsEndedByExit() const
  {
    const std::thread::id thread = this->ExitThread;
    return thread != std::thread::id() && thread != std::this_thread::get_id();
  }

  /// Keeps this thread from taking Python's lock after EndCalls.
  void WaitIfOver() const
  {
    if (this->IsOver && this->IsEndedByExit())
    {
      Wait();
    }
  }

  /// Lets this thread wait without Python's lock until the process ends.
  [[noreturn]] static void Wait()
  {
    if (PyGILState_Check())
    {
      PyEval_SaveThread();
    }
    for (;;)
    {
      std::this_thread::sleep_for(std::chrono::hours(1));
    }
  }

  /// Calls a function of Python's module signal. Returns null if it fails. An exception that is on
  /// its way remains the only one.
  template <typename... Arguments>
  static PyObject* CallSignal(const char* name, const char* format, Arguments... arguments)
  {
    PyObject *type, *value, *trace;
    PyErr_Fetch(&type, &value, &trace);
    const Reference module(PyImport_ImportModule("signal"));
    PyObject* result =
      module.Get() ? PyObject_CallMethod(module.Get(), name, format, arguments...) : nullptr;
    PyErr_Restore(type, value, trace);
    return result;
  }

  /// Makes Handle the handler of Ctrl-C. False in threads other than Python's main one, or if
  /// Ctrl-C does not call Python.
  bool InstallHandler()
  {
    if (!this->OwnHandler.Get())
    {
      static PyMethodDef method = { "handle", &PythonInterpreter::Handle, METH_VARARGS, nullptr };
      this->OwnHandler.Reset(PyCFunction_New(&method, nullptr));
    }
    PyObject* old = CallSignal("getsignal", "i", SIGINT);
    this->Handler.Reset(old);
    return old && PyCallable_Check(old) &&
      Reference(CallSignal("signal", "iO", SIGINT, this->OwnHandler.Get())).Get();
  }

  bool IsInstalled() const
  {
    return Reference(CallSignal("getsignal", "i", SIGINT)).Get() == this->OwnHandler.Get();
  }

  /// Restores the user's handler, unless an observer has set another one.
  void RestoreHandler()
  {
    if (this->IsInstalled())
    {
      const Reference result(CallSignal("signal", "iO", SIGINT, this->Handler.Get()));
    }
  }

  void HandleSignals()
  {
    // An exception of Python that is on its way goes first.
    if (!PyErr_Occurred() && PyErr_CheckSignals() != 0)
    {
      this->Stop();
    }
  }

  /// Keeps the present exception until the call has returned.
  void Stop()
  {
    PyObject *type, *value, *trace;
    PyErr_Fetch(&type, &value, &trace);
    PyErr_NormalizeException(&type, &value, &trace);
    Py_XDECREF(trace);
    this->Type.Reset(type);
    this->Value.Reset(value);
    if (!this->IsStopped)
    {
      this->StoppedThread = std::this_thread::get_id();
      this->IsStopped = true;
    }
  }

  /// Has Python call Raise soon.
  void RaiseSoon()
  {
    if (!this->IsRaisedSoon)
    {
      this->IsRaisedSoon = Py_AddPendingCall([](void*) { return Get()->Raise(); }, nullptr) == 0;
      if (!this->IsRaisedSoon)
      {
        PyErr_SetInterrupt(); // there are too many pending calls: Handle tries again
      }
    }
  }

  /// Raises the exception that was kept, unless the function that runs is one that VTK called.
  int Raise()
  {
    this->IsRaisedSoon = false;
    PyFrameObject* present = PyEval_GetFrame();
    if (present && reinterpret_cast<PyObject*>(present) != this->Frame.Get() &&
      IsBelow(this->Frame.Get(), present))
    {
      this->RaiseSoon();
      return 0;
    }
    this->RestoreHandler();
    this->IsStopped = false;
    this->Frame.Reset(nullptr);
    PyErr_Restore(this->Type.Release(), this->Value.Release(), nullptr);
    return -1;
  }

  static thread_local bool IsWithoutLock;
  static thread_local std::vector<PyGILState_STATE> Borrowed;
  static thread_local int Calls; ///< long ones, within each other

  std::mutex CallsMutex;
  std::condition_variable CallEnded;
  int ThreadsInCalls = 0;                                       ///< guarded by CallsMutex
  std::atomic<std::thread::id> ExitThread{ std::thread::id() }; ///< that ends Python
  std::atomic<bool> IsOver{ false };                            ///< EndCalls has returned
  std::atomic<std::thread::id> Thread{ std::thread::id() };     ///< of the long call
  std::atomic<bool> IsStopped{ false };
  std::atomic<std::thread::id> StoppedThread{}; ///< that of the call which a signal ended
  // Everything else is used only by that thread, with Python's lock.
  int Depth = 0;
  bool IsRaisedSoon = false; ///< a pending call of Raise is in Python's queue
  std::chrono::steady_clock::time_point NextCheck;
  Reference Frame; ///< that called the outermost call
  Reference Handler;
  Reference OwnHandler;
  Reference Type; ///< of the exception
  Reference Value;
};

thread_local bool PythonInterpreter::IsWithoutLock = false;
thread_local std::vector<PyGILState_STATE> PythonInterpreter::Borrowed;
thread_local int PythonInterpreter::Calls = 0;
}

PyMODINIT_FUNC PyInit__interpreter()
{
  static PyModuleDef definition = { PyModuleDef_HEAD_INIT, "_interpreter",
    "Ends long calls of the library at Ctrl-C, and lets other threads go on meanwhile.", -1,
    nullptr, nullptr, nullptr, nullptr, nullptr };
  PyObject* module = PyModule_Create(&definition);
  if (module)
  {
    if (!PythonInterpreter::RegisterEndCalls())
    {
      Py_DECREF(module);
      return nullptr;
    }
    cslf::SetInterpreter(PythonInterpreter::Get());
  }
  return module;
}
