// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEncodeRanks.h"

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
constexpr std::uint32_t NoRank = 0xffffffffu;

/// All ranks have the same manifest.
constexpr std::uint32_t NoManifest = 0;

/// The kind of a message, which is its first number.
enum Topic : std::uint32_t
{
  State,   ///< to rank 0: whether there is an error, and what must be the same on all ranks
  Verdict, ///< from rank 0: the rank that failed, or NoRank, and rank 0's number
  Ask,     ///< to rank 0: asks for tasks
  Share,   ///< from rank 0: tasks, or none at the end
  Results, ///< to rank 0: the results of a share
  Done,    ///< to rank 0: no more messages follow
  Failed,  ///< to rank 0: no more messages follow because of an error
  Stop     ///< from rank 0: stop the work in progress
};

ByteBuffer MakeMessage(Topic topic)
{
  ByteBuffer buffer;
  buffer.Put(topic);
  return buffer;
}

void Put(const CodingTask& task, ByteBuffer& buffer)
{
  buffer.Put(static_cast<std::uint32_t>(task.Group));
  buffer.Put(task.IsTrial ? 1u : 0u);
  buffer.Put(static_cast<std::uint32_t>(task.Factors.size()));
  for (double factor : task.Factors)
  {
    buffer.Put(factor);
  }
}

void Put(const CodingResult& result, ByteBuffer& buffer)
{
  buffer.Put(static_cast<std::uint32_t>(result.Group));
  buffer.Put(static_cast<std::uint32_t>(result.Trials.size()));
  for (const auto& [factor, cost] : result.Trials)
  {
    for (double number : { factor, cost.Bytes, cost.CoverageBytes, cost.SquaredError })
    {
      buffer.Put(number);
    }
    buffer.Put(cost.CoveredFully ? 1u : 0u);
  }
  buffer.Put(static_cast<std::uint32_t>(result.Tracks.size()));
  for (const CodedGroup& group : result.Tracks)
  {
    buffer.Put(PackGroup(group, NoManifest));
  }
}

bool Take(ByteBuffer& buffer, std::pair<double, GroupCost>& trial)
{
  auto& [factor, cost] = trial;
  std::uint32_t isCovered = 0;
  const bool isGood = buffer.Take(factor) && buffer.Take(cost.Bytes) &&
    buffer.Take(cost.CoverageBytes) && buffer.Take(cost.SquaredError) && buffer.Take(isCovered);
  cost.CoveredFully = isCovered != 0;
  return isGood;
}

bool Take(ByteBuffer& buffer, CodedGroup& group)
{
  std::vector<std::uint8_t> bytes;
  return buffer.Take(bytes) && UnpackGroup(std::move(bytes), NoManifest, group);
}

/// Takes a list of items. The number of them is limited by what the rest of the message can hold.
template <typename Item>
bool Take(ByteBuffer& buffer, std::vector<Item>& items)
{
  std::uint32_t count = 0;
  bool isGood = buffer.Take(count);
  for (std::uint32_t i = 0; isGood && i < count; ++i)
  {
    items.emplace_back();
    isGood = Take(buffer, items.back());
  }
  return isGood;
}

/// The results in a message; none if it is damaged.
std::vector<CodingResult> TakeResults(ByteBuffer& buffer)
{
  std::vector<CodingResult> results;
  for (std::uint32_t group = 0; buffer.Take(group);)
  {
    CodingResult result;
    result.Group = static_cast<int>(group);
    if (!Take(buffer, result.Trials) || !Take(buffer, result.Tracks))
    {
      return {};
    }
    results.push_back(std::move(result));
  }
  return results;
}
}

EncodeRanks::EncodeRanks(vtkMultiProcessController* controller)
  : Team(controller)
  , Working(Team.GetRank() == 0 ? Team.GetCount() - 1 : 0)
{
}

EncodeRanks::Verdict EncodeRanks::Agree(bool hasSucceeded, const std::string& shared, int fromRoot)
{
  cslf::EncodeRanks::Verdict verdict{ hasSucceeded ? -1 : 0, false, fromRoot };
  if (this->Team.GetCount() == 1)
  {
    return verdict;
  }
  auto failed = NoRank;
  auto number = static_cast<std::uint32_t>(fromRoot);
  if (this->Team.GetRank() == 0)
  {
    failed = static_cast<std::uint32_t>(this->FindFailed(hasSucceeded, shared, verdict.Differs));
    for (int rank = 1; rank < this->Team.GetCount(); ++rank)
    {
      ByteBuffer message = MakeMessage(Topic::Verdict);
      message.Put(failed);
      message.Put(number);
      this->Team.Post(rank, message.GetBytes());
    }
  }
  else
  {
    ByteBuffer state = MakeMessage(State);
    state.Put(hasSucceeded ? 0u : 1u);
    state.Put(std::vector<std::uint8_t>(shared.begin(), shared.end()));
    this->Team.Post(0, state.GetBytes());
    // Work that was handed out before another rank failed may still be on its way.
    for (std::uint32_t topic = State; topic != Topic::Verdict;)
    {
      ByteBuffer content(this->Team.Wait().Bytes);
      content.Take(topic);
      content.Take(failed);
      content.Take(number);
    }
  }
  this->Team.Flush();
  verdict.Failed = static_cast<int>(failed);
  verdict.FromRoot = static_cast<int>(number);
  return verdict;
}

int EncodeRanks::FindFailed(bool hasSucceeded, const std::string& shared, bool& differs)
{
  const std::vector<std::uint8_t> expected(shared.begin(), shared.end());
  int failed = hasSucceeded ? this->FailedRank : 0;
  bool equal = true;
  for (int others = this->Team.GetCount() - 1; others > 0;)
  {
    if (this->States.empty())
    {
      this->Handle(this->Team.Wait());
      continue;
    }
    const Ranks::Message message = std::move(this->States.back());
    this->States.pop_back();
    ByteBuffer content(message.Bytes);
    std::uint32_t topic = State;
    std::uint32_t isBad = 0;
    std::vector<std::uint8_t> theirs;
    if (content.Take(topic) && content.Take(isBad) && content.Take(theirs))
    {
      failed = isBad && (failed < 0 || message.From < failed) ? message.From : failed;
      equal = equal && (isBad || theirs == expected);
      --others;
    }
  }
  differs = failed < 0 && !equal;
  return differs ? 0 : failed;
}

bool EncodeRanks::DoTasks(
  std::vector<CodingTask> tasks, int atOnce, const Worker& make, const Receiver& take)
{
  this->Remaining = std::move(tasks);
  this->AtOnce = atOnce;
  this->Receive = &take;
  for (int rank : std::exchange(this->Waiting, {}))
  {
    this->SendTasks(rank);
  }
  while (!this->Stopped && !this->Remaining.empty())
  {
    std::vector<CodingResult> results;
    if (!make(this->ChooseTasks(0), results) || !take(results))
    {
      this->StopOthers();
    }
    this->Serve();
  }
  while (!this->Stopped && this->Outstanding > 0)
  {
    this->Handle(this->Team.Wait());
  }
  this->Receive = nullptr;
  return !this->Stopped;
}

void EncodeRanks::ReleaseOthers()
{
  this->Released = true;
  for (int rank : std::exchange(this->Waiting, {}))
  {
    this->SendTasks(rank);
  }
  while (this->Working > 0)
  {
    this->Handle(this->Team.Wait());
  }
}

void EncodeRanks::ServeRoot(const Worker& make)
{
  const ByteBuffer ask = MakeMessage(Ask);
  this->Team.Post(0, ask.GetBytes());
  bool good = true;
  while (good && !this->Stopped)
  {
    while (!this->Received && !this->Stopped)
    {
      this->Handle(this->Team.Wait());
    }
    const std::vector<CodingTask> tasks = this->Received.value_or(std::vector<CodingTask>());
    this->Received.reset();
    if (this->Stopped || tasks.empty())
    {
      break;
    }
    this->Team.Post(0, ask.GetBytes());
    std::vector<CodingResult> results;
    good = make(tasks, results);
    if (good)
    {
      ByteBuffer message = MakeMessage(Results);
      for (const CodingResult& result : results)
      {
        Put(result, message);
      }
      this->Team.Post(0, message.GetBytes());
    }
  }
  this->Team.Post(0, MakeMessage(good || this->Stopped ? Done : Failed).GetBytes());
}

std::vector<CodingTask> EncodeRanks::ChooseTasks(int rank)
{
  // A rank may still have the viewpoints of groups that it has worked on.
  const auto begin = this->Remaining.begin();
  const auto own = std::stable_partition(begin, this->Remaining.end(),
    [&](const CodingTask& task)
    {
      const auto worker = this->Workers.find(task.Group);
      return worker != this->Workers.end() && worker->second == rank;
    });
  const int remaining = static_cast<int>(this->Remaining.size());
  const int held = static_cast<int>(own - begin);
  // Smaller shares towards the end, so that all ranks finish together.
  const int fair = this->Team.GetCount() > 1 ? remaining / (2 * this->Team.GetCount()) : remaining;
  int count = std::min(remaining, std::clamp(fair, 1, this->AtOnce));
  count = held > 0 ? std::min(count, held) : count;
  std::vector<CodingTask> chosen(begin, begin + count);
  this->Remaining.erase(begin, begin + count);
  for (const CodingTask& task : chosen)
  {
    this->Workers[task.Group] = rank;
  }
  return chosen;
}

bool EncodeRanks::Serve()
{
  while (auto message = this->Team.Poll())
  {
    this->Handle(*std::move(message));
  }
  return !this->Stopped;
}

void EncodeRanks::Handle(Ranks::Message message)
{
  ByteBuffer content(message.Bytes);
  std::uint32_t topic = Stop;
  content.Take(topic);
  switch (topic)
  {
    case Ask:
      this->SendTasks(message.From);
      break;
    case Results:
      --this->Outstanding;
      if (!this->Stopped)
      {
        std::vector<CodingResult> results = TakeResults(content);
        if (!(*this->Receive)(results))
        {
          this->StopOthers();
        }
      }
      break;
    case Done:
      --this->Working;
      break;
    case Failed:
      --this->Working;
      this->FailedRank = this->FailedRank < 0 ? message.From : this->FailedRank;
      this->StopOthers();
      break;
    case Share:
      this->HandleShare(content);
      break;
    case State:
      // From a rank that has already finished.
      this->States.push_back(std::move(message));
      break;
    default:
      this->Stopped = true;
      break;
  }
}

void EncodeRanks::HandleShare(ByteBuffer& content)
{
  this->Received.emplace();
  for (std::uint32_t group = 0; content.Take(group);)
  {
    CodingTask task;
    task.Group = static_cast<int>(group);
    std::uint32_t isTrial = 0;
    std::uint32_t count = 0;
    content.Take(isTrial);
    content.Take(count);
    task.IsTrial = isTrial != 0;
    for (double factor = 0.0; count > 0 && content.Take(factor); --count)
    {
      task.Factors.push_back(factor);
    }
    this->Received->push_back(task);
  }
}

void EncodeRanks::SendTasks(int rank)
{
  const bool isOver = this->Stopped || this->Released;
  if (!isOver && this->Remaining.empty())
  {
    this->Waiting.push_back(rank);
    return;
  }
  ByteBuffer share = MakeMessage(Share);
  if (!isOver)
  {
    for (const CodingTask& task : this->ChooseTasks(rank))
    {
      Put(task, share);
    }
    ++this->Outstanding;
  }
  this->Team.Post(rank, share.GetBytes());
}

void EncodeRanks::StopOthers()
{
  if (!this->Stopped)
  {
    this->Stopped = true;
    for (int rank = 1; rank < this->Team.GetCount(); ++rank)
    {
      this->Team.Post(rank, MakeMessage(Stop).GetBytes());
    }
  }
}
}
