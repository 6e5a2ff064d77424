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
#include <vtkSmartPointer.h>

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
/// What a forked process does, which must end within seconds. Returns whether it has succeeded.
template <typename Work>
bool IsDoneForked(const Work& work)
{
  const pid_t child = fork();
  if (child == 0)
  {
    constexpr unsigned int mostSeconds = 30;
    alarm(mostSeconds);
    _exit(work() ? 0 : 1);
  }
  int status = -1;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Forks again and again while viewpoints are decoded in the background. The forked processes use
/// the decoder of their parent in different ways, and end with its destructor.
void TestForkWhilePrefetching(const Samples& expected)
{
  constexpr int times = 12;
  for (int k = 0; k < times; ++k)
  {
    auto decoder = vtkSmartPointer<vtkCSLFDecoder>::New();
    decoder->SetFileName(FileName);
    vtkNew<vtkIdTypeArray> soon;
    for (vtkIdType z = 0; z < Slices; ++z)
    {
      soon->InsertNextValue((z + k) % Slices);
    }
    decoder->Prefetch(soon);
    const auto readSingle = [&decoder]
    {
      Samples samples;
      for (vtkIdType z = 0; z < Slices; ++z)
      {
        vtkNew<vtkImageData> image;
        if (decoder->GetViewpoint(z, image))
        {
          samples.Add(image);
        }
      }
      return samples;
    };
    CSLF_CHECK(IsDoneForked(
      [&]
      {
        bool isGood = true;
        if (k % 4 == 1)
        {
          decoder->WaitForPrefetch();
          isGood = decoder->IsViewpointReady(0) && decoder->IsViewpointReady(Slices - 1);
        }
        else if (k % 4 == 2)
        {
          isGood = readSingle() == expected;
        }
        else if (k % 4 == 3)
        {
          decoder->Update();
          Samples whole;
          whole.Add(decoder->GetOutput());
          isGood = whole == expected && ReadAll(expected);
        }
        decoder = nullptr;
        return isGood;
      }));
    CSLF_CHECK(readSingle() == expected);
    decoder->WaitForPrefetch();
    CSLF_CHECK(decoder->IsViewpointReady(0));
  }
}

/// Parent and child read one open file at the same time: its position is not shared.
void TestReadingAtOnce(const Samples& expected)
{
  vtkNew<vtkCSLFDecoder> open;
  open->SetFileName(FileName);
  open->SetCacheSize(0);
  open->UpdateInformation();
  const auto readOften = [&]
  {
    constexpr int times = 10;
    bool isGood = true;
    for (int k = 0; k < times && isGood; ++k)
    {
      Samples samples;
      for (vtkIdType z = 0; z < Slices; ++z)
      {
        vtkNew<vtkImageData> image;
        if (!open->GetViewpoint(z, image))
        {
          return false;
        }
        samples.Add(image);
      }
      isGood = samples == expected;
    }
    return isGood;
  };
  const pid_t child = fork();
  if (child == 0)
  {
    constexpr unsigned int mostSeconds = 30;
    alarm(mostSeconds);
    _exit(readOften() ? 0 : 1);
  }
  CSLF_CHECK(readOften());
  int status = -1;
  CSLF_CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/// A forked process does not have its parent's threads.
void TestFork(const Samples& expected)
{
  vtkNew<vtkCSLFDecoder> open;
  open->SetFileName(FileName);
  open->Update();
  CSLF_CHECK(IsDoneForked([&] { return ReadAll(expected); }));
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
  TestForkWhilePrefetching(expected);
  TestReadingAtOnce(expected);
#endif
  return cslf::testing::Result();
}
