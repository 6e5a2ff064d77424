// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldReader.h"

#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include <vtkErrorCode.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <set>
#include <sstream>
#include <utility>

namespace cslf
{
namespace
{
/// Texels that a thread decodes between two reports of progress, about a second's work.
constexpr std::size_t TexelsAtOnce = 64 << 20;

/// The number of groups between two reports of progress.
std::size_t GetGroupsAtOnce(const FileHeader& header)
{
  const std::size_t groupTexels = static_cast<std::size_t>(header.Field.Grid.GetStripWidth()) *
    header.Field.Grid.GetResolution() * MaximumGroupLength;
  return std::max<std::size_t>(2, TexelsAtOnce / groupTexels) *
    std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
}

/// What viewpoints see of the file's geometry. Null if the geometry is missing, damaged or too
/// large.
std::unique_ptr<GeometryTexels> ReadTexels(const FileHeader& header)
{
  const FilePart* part = header.FindGeometry();
  std::string ignored;
  const auto geometry = part ? DecodeGeometry(part->Bytes, header.Field.Box, ignored) : nullptr;
  return geometry &&
      static_cast<std::size_t>(geometry->GetNumberOfPolys()) <= GeometryTexels::MaximumTriangles
    ? std::make_unique<GeometryTexels>(geometry, header.Field.Box, header.Field.Grid)
    : nullptr;
}
}

/// Slices that are asked for, and their destination.
class FieldView::Range
{
public:
  Range(const FieldView& view, int first, int last, const ViewpointSamples& begin)
    : Decoder(view.GetFile().GetDecoder())
    , Store(view.GetFile().GetViewpoints())
    , Field(view.GetHeader().Field)
    , Time(view.Time)
    , First(first)
    , Begin(begin)
    , Lacks(last - first + 1, 1)
  {
  }

  /// Copies the slices that are kept.
  void CopyKept()
  {
    ParallelFor(0, static_cast<vtkIdType>(this->Lacks.size()), 1,
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType place = begin; place < end; ++place)
        {
          const FrameId frame = this->GetFrame(place);
          const auto kept = this->Store.Find(frame);
          if (kept && !kept->IsEmpty())
          {
            kept->CopyTo(this->GetTarget(frame), this->Field.Grid.GetStripTexels());
            this->Lacks[place] = 0;
          }
        }
      });
  }

  /// The groups that contain missing slices.
  std::vector<int> FindGroups()
  {
    std::set<int> groups;
    std::size_t lacking = 0;
    for (std::size_t place = 0; place < this->Lacks.size(); ++place)
    {
      if (this->Lacks[place])
      {
        groups.insert(this->Store.GetGroup(this->GetFrame(static_cast<vtkIdType>(place))));
        ++lacking;
      }
    }
    std::size_t all = 0;
    for (int group : groups)
    {
      all += this->Decoder.GetFrames(group).size();
    }
    this->KeepsOthers = all - lacking <= this->Store.GetCapacity();
    return { groups.begin(), groups.end() };
  }

  /// Decodes some groups and appends the slices of those that are damaged.
  void Decode(const std::vector<int>& groups, std::vector<int>& missing)
  {
    std::vector<GroupRequest> requests(groups.size());
    std::vector<Others> others(groups.size());
    for (std::size_t k = 0; k < groups.size(); ++k)
    {
      requests[k] = this->MakeRequest(groups[k], others[k]);
    }
    const std::vector<bool> whole = this->Decoder.Decode(requests);
    for (std::size_t k = 0; k < groups.size(); ++k)
    {
      for (const FrameId frame : this->Decoder.GetFrames(groups[k]))
      {
        if (!whole[k] && this->IsLacking(frame))
        {
          missing.push_back(frame.Slice);
        }
      }
      for (std::size_t i = 0; whole[k] && i < others[k].size(); ++i)
      {
        this->Store.Insert(others[k][i].first, std::move(others[k][i].second));
      }
    }
  }

private:
  /// Frames of a group that were not asked for.
  using Others = std::vector<std::pair<FrameId, ViewpointSamples>>;

  GroupRequest MakeRequest(int group, Others& others)
  {
    GroupRequest request;
    request.Group = group;
    for (const FrameId frame : this->Decoder.GetFrames(group))
    {
      ViewpointSamples target;
      if (this->IsLacking(frame))
      {
        target = this->GetTarget(frame);
      }
      else if (this->KeepsOthers && !this->Store.Find(frame))
      {
        target =
          MakeSamples(this->Field, static_cast<vtkIdType>(this->Field.Grid.GetStripTexels()));
        others.emplace_back(frame, target);
      }
      request.Slices.push_back(target);
    }
    return request;
  }

  FrameId GetFrame(vtkIdType place) const
  {
    return { this->First + static_cast<int>(place), this->Time };
  }

  bool IsLacking(FrameId frame) const
  {
    const int place = frame.Slice - this->First;
    return frame.Time == this->Time && place >= 0 && place < static_cast<int>(this->Lacks.size()) &&
      this->Lacks[place] != 0;
  }

  ViewpointSamples GetTarget(FrameId frame) const
  {
    return this->Begin.At(
      static_cast<vtkIdType>(frame.Slice - this->First) * this->Field.Grid.GetStripTexels());
  }

  GroupDecoder& Decoder;
  ViewpointStore& Store;
  const Description& Field;
  int Time;
  int First;
  ViewpointSamples Begin;
  std::vector<char> Lacks; ///< for each slice, whether it is still to be decoded
  bool KeepsOthers = false;
};

std::unique_ptr<FieldReader> FieldReader::Open(const std::string& fileName, OpenError& failure)
{
  auto container = ContainerReader::Open(fileName, failure);
  if (!container)
  {
    return nullptr;
  }
  for (const CodedTrack& track : container->GetHeader().Tracks)
  {
    if (!FindDecoder(IDOfCodec(track.Kind.Coding)))
    {
      failure = { vtkErrorCode::CannotOpenFileError,
        std::string("this FFmpeg has no decoder for ") + NameOfCodec(track.Kind.Coding) };
      return nullptr;
    }
  }
  std::unique_ptr<GeometryTexels> texels;
  if (container->GetHeader().Computed.HasDepth)
  {
    try
    {
      texels = ReadTexels(container->GetHeader());
    }
    catch (const std::bad_alloc&)
    {
      failure = { vtkErrorCode::CannotOpenFileError,
        "there is not enough memory for its geometry" };
      return nullptr;
    }
    if (!texels)
    {
      failure = { vtkErrorCode::FileFormatError,
        "the geometry from which its depth is computed is missing or damaged" };
      return nullptr;
    }
  }
  return std::make_unique<FieldReader>(std::move(container), std::move(texels));
}

FieldReader::FieldReader(
  std::unique_ptr<ContainerReader> container, std::unique_ptr<GeometryTexels> texels)
  : Decoder(std::move(container), std::move(texels))
  , Store(this->Decoder)
{
}

FieldView::FieldView(std::shared_ptr<FieldReader> file, int time)
  : File(std::move(file))
  , Time(time)
  , Unwritten(this->GetHeader().GetMissingSlices(time))
{
  for (const FrameId frame : this->GetHeader().Frames)
  {
    if (frame.Time == time)
    {
      this->Order.push_back(frame.Slice);
    }
  }
}

std::vector<int> FieldView::Read(
  int first, int last, const ViewpointSamples& target, const Progress& progress) const
{
  std::vector<int> missing;
  const auto goesOn = [&progress] { return progress(0.0); };
  if (!this->File->GetViewpoints().WaitFor(this->Time, first, last, goesOn))
  {
    return missing;
  }
  Range range(*this, first, last, target);
  range.CopyKept();
  const std::vector<int> groups = range.FindGroups();
  const std::size_t atOnce = GetGroupsAtOnce(this->GetHeader());
  for (std::size_t begin = 0; begin < groups.size() &&
       progress(static_cast<double>(begin) / static_cast<double>(groups.size()));
       begin += atOnce)
  {
    const std::size_t end = std::min(begin + atOnce, groups.size());
    range.Decode({ groups.begin() + static_cast<std::ptrdiff_t>(begin),
                   groups.begin() + static_cast<std::ptrdiff_t>(end) },
      missing);
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}

std::vector<int> FieldView::FindMissing(const Progress& progress) const
{
  return this->FindMissing(0, this->GetHeader().Field.Grid.GetSlices() - 1, progress);
}

std::vector<int> FieldView::FindMissing(int first, int last, const Progress& progress) const
{
  std::map<int, std::vector<int>> slicesOfGroups;
  for (int slice = first; slice <= last; ++slice)
  {
    slicesOfGroups[this->File->GetViewpoints().GetGroup(this->GetFrame(slice))].push_back(slice);
  }
  std::vector<int> missing;
  const auto groups = static_cast<double>(slicesOfGroups.size());
  int checked = 0;
  for (const auto& [group, slices] : slicesOfGroups)
  {
    if (!progress(checked++ / groups))
    {
      break;
    }
    if (!this->File->GetDecoder().Check(group))
    {
      missing.insert(missing.end(), slices.begin(), slices.end());
    }
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}

FieldView::MissingText FieldView::DescribeMissing(
  const std::vector<int>& missing, bool areLeftEmpty) const
{
  const std::size_t slices = this->Order.size();
  const bool hasChanged = this->File->HasFileChanged();
  std::ostringstream text;
  if (missing.size() == slices)
  {
    text << (hasChanged ? "it was changed while it was open" : "its video is damaged or truncated")
         << ": none of the " << slices << " viewpoints can be read";
    return { {}, text.str() };
  }
  constexpr std::size_t named = 5;
  text << missing.size() << " of " << slices << " viewpoints are missing"
       << (areLeftEmpty ? " and left empty" : "") << " (z = ";
  for (std::size_t k = 0; k < std::min(missing.size(), named); ++k)
  {
    text << (k > 0 ? ", " : "") << missing[k];
  }
  text << (missing.size() > named ? ", ...)" : ")");
  const char* state = missing.size() <= this->Unwritten.size() ? "unfinished"
    : hasChanged ? "damaged, because it was changed while it was open"
                 : "damaged";
  return { state, text.str() };
}

void FieldView::Prefetch(const std::vector<int>& slices) const
{
  std::vector<FrameId> frames;
  std::transform(slices.begin(), slices.end(), std::back_inserter(frames),
    [this](int slice) { return this->GetFrame(slice); });
  this->File->GetViewpoints().Prefetch(frames);
}

namespace
{
class ViewStore : public FieldStore
{
public:
  ViewStore(const FieldView& view, std::function<bool(const std::function<bool()>&)> guard,
    std::function<void()> onMissing)
    : FieldStore(view.GetHeader().Field, view.GetUnwritten())
    , View(view)
    , Guard(std::move(guard))
    , OnMissing(std::move(onMissing))
    , Ranks(view.GetOrder().size())
  {
    int rank = 0;
    for (const int slice : view.GetOrder())
    {
      this->Ranks[slice] = rank++;
    }
  }

  void Prefetch(const std::vector<int>& slices) override
  {
    this->Guard(
      [&]
      {
        this->View.Prefetch(slices);
        return true;
      });
  }

  void Wait() override { this->View.GetFile().GetViewpoints().Wait(); }

  bool IsReady(int slice) override { return this->View.Has(slice); }

  ViewpointSamples Get(int slice) override
  {
    ViewpointSamples samples;
    const bool isRead = this->Guard(
      [&]
      {
        samples = this->View.Get(slice);
        return true;
      });
    if (isRead && samples.IsEmpty())
    {
      this->OnMissing();
    }
    return samples;
  }

  void Sort(std::vector<int>& slices) override
  {
    std::sort(slices.begin(), slices.end(),
      [this](int a, int b) { return this->Ranks[a] < this->Ranks[b]; });
  }

private:
  const FieldView View;
  const std::function<bool(const std::function<bool()>&)> Guard;
  const std::function<void()> OnMissing;
  std::vector<int> Ranks; ///< of the slices, in the file
};
}

std::shared_ptr<FieldStore> MakeStore(const FieldView& view,
  std::function<bool(const std::function<bool()>& work)> guard, std::function<void()> onMissing)
{
  return std::make_shared<ViewStore>(view, std::move(guard), std::move(onMissing));
}
}
