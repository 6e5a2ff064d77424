// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The rest of an interrupted run: the first byte selects the file of OUT.partial for the others.
#include "Coding/Writing/cslfGroupStore.h"
#include "cslfFuzzing.h"

namespace
{
namespace fs = std::filesystem;

constexpr char Manifest[] = R"({"field":"a","tracks":1})";
constexpr char Trials[] = "[[0,20,1,1,1,true],[0,36,1,1,1,true]]";

/// Leaves a folder with a part, like a killed run.
void Interrupt(const std::string& out)
{
  cslf::GroupStore store(out);
  std::string error;
  bool discarded = false;
  cslf::CodedGroup part;
  part.ParameterSets = { 1, 2 };
  part.Frames = { { 0, { 3 } }, { 1, { 4, 5 } } };
  cslf::fuzzing::Require(store.Open(Manifest, true, discarded, error) && !discarded &&
    store.WriteTrials(Trials, error) && store.Write(cslf::ColorRole, 0, part, error));
}

/// Continues with the existing files.
void Resume(const std::string& out)
{
  cslf::GroupStore store(out);
  std::string error;
  bool discarded = false;
  if (!store.Open(Manifest, true, discarded, error))
  {
    cslf::fuzzing::Require(!error.empty());
    return;
  }
  store.ReadTrials();
  cslf::CodedGroup part;
  if (store.Read(cslf::ColorRole, 0, part, error))
  {
    cslf::fuzzing::Require(store.Has(cslf::ColorRole, 0));
    cslf::fuzzing::Require(store.Write(cslf::ColorRole, 1, part, error));
    cslf::CodedGroup again;
    cslf::fuzzing::Require(store.Read(cslf::ColorRole, 1, again, error) &&
      again.ParameterSets == part.ParameterSets && again.Frames.size() == part.Frames.size());
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const cslf::fuzzing::Folder& folder = cslf::fuzzing::Folder::Get();
  const std::string out = folder.GetName("out.mp4");
  const std::string names[] = { "manifest.json", "trials.json", "group-0-color.part", "cslf.lock" };
  Interrupt(out);
  if (size > 0)
  {
    folder.Write("out.mp4.partial/" + names[data[0] % 4], data + 1, size - 1);
  }
  Resume(out);
  fs::remove_all(out + ".partial");
  return 0;
}
