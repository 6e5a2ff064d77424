// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Several readers of one file at once: in threads, and in a process that was forked while the file
// was open.
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"

#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

// The thread sanitizer does not support a process that was forked while other threads ran, and some
// libraries start threads when they are loaded.
#if defined(__SANITIZE_THREAD__)
#define CSLF_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CSLF_THREAD_SANITIZER
#endif
#endif
#if defined(__linux__) && !defined(CSLF_THREAD_SANITIZER)
#define CSLF_TEST_FORK
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace
{
constexpr const char* FileName = CSLF_TEST_DATA "/field.mp4";
constexpr int Slices = 24;

/// The bytes of an array, from a tuple on.
std::vector<unsigned char> GetBytes(vtkImageData* image, const char* name)
{
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  const auto* begin = static_cast<const unsigned char*>(array->GetVoidPointer(0));
  return { begin, begin + array->GetNumberOfValues() * array->GetDataTypeSize() };
}

/// All samples of a field, by slices.
struct Samples
{
  std::vector<unsigned char> Color;
  std::vector<unsigned char> Depth;

  void Add(vtkImageData* image)
  {
    for (auto* bytes : { &this->Color, &this->Depth })
    {
      const auto added = GetBytes(image, bytes == &this->Color ? cslf::ColorName : cslf::DepthName);
      bytes->insert(bytes->end(), added.begin(), added.end());
    }
  }
  bool operator==(const Samples& other) const
  {
    return this->Color == other.Color && this->Depth == other.Depth;
  }
};

/// Reads a file as a whole, and its viewpoints ahead and one by one.
bool ReadAll(const Samples& expected)
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(FileName);
  vtkNew<vtkIdTypeArray> soon;
  for (vtkIdType z = Slices - 1; z >= 0; z -= 2)
  {
    soon->InsertNextValue(z);
  }
  decoder->Prefetch(soon);
  Samples single;
  for (vtkIdType z = 0; z < Slices; ++z)
  {
    vtkNew<vtkImageData> image;
    if (!decoder->GetViewpoint(z, image))
    {
      return false;
    }
    single.Add(image);
  }
  decoder->WaitForPrefetch();
  decoder->SetCacheSize(0);
  decoder->Update();
  Samples whole;
  whole.Add(decoder->GetOutput());
  return single == expected && whole == expected && decoder->FindMissingViewpoints() == 0;
}

void TestThreads(const Samples& expected)
{
  constexpr int count = 4;
  std::atomic<int> good{ 0 };
  std::vector<std::thread> threads;
  threads.reserve(count);
  for (int k = 0; k < count; ++k)
  {
    threads.emplace_back([&] { good += ReadAll(expected) ? 1 : 0; });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  CSLF_CHECK(good == count);
}

#ifdef CSLF_TEST_FORK
/// A forked process does not have its parent's threads. Open files stay the parent's.
void TestFork(const Samples& expected)
{
  vtkNew<vtkCSLFDecoder> open;
  open->SetFileName(FileName);
  open->Update();
  const pid_t child = fork();
  if (child == 0)
  {
    constexpr unsigned int mostSeconds = 30;
    alarm(mostSeconds);
    _exit(ReadAll(expected) ? 0 : 1);
  }
  int status = -1;
  CSLF_CHECK(waitpid(child, &status, 0) == child);
  CSLF_CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  Samples after;
  open->Modified();
  open->Update();
  after.Add(open->GetOutput());
  CSLF_CHECK(after == expected);
}
#endif
}

int TestCSLFDecoderThreads(int, char*[])
{
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(FileName);
  decoder->Update();
  Samples expected;
  expected.Add(decoder->GetOutput());
  std::cout << "vtkSMPTools uses " << vtkSMPTools::GetBackend() << "\n";
  TestThreads(expected);
#ifdef CSLF_TEST_FORK
  TestFork(expected);
#endif
  return cslf::testing::Result();
}
