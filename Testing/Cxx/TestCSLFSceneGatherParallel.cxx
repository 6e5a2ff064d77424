// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A scene in pieces on several ranks: lights that come with every piece count once, and messages of
// any size transport the pieces. If one rank fails, all ranks fail with a message that gives the
// reason, and none waits.
#include "Parallel/cslfSceneGather.h"
#include "cslfDescription.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFSampler.h"

#include <vtkAlgorithmOutput.h>
#include <vtkCommand.h>
#include <vtkCommunicator.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMPIController.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{
using Pieces = std::vector<vtkSmartPointer<vtkDataObject>>;

vtkSmartPointer<vtkPolyData> MakePlane(int index)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetCenter(2.0 * index, 0.0, 0.0);
  plane->Update();
  return plane->GetOutput();
}

int Sum(vtkMultiProcessController* controller, int mine)
{
  int all = 0;
  controller->AllReduce(&mine, &all, 1, vtkCommunicator::SUM_OP);
  return all;
}

void SetUp(vtkCSLFSampler* sampler, vtkMultiProcessController* controller)
{
  sampler->SetController(controller);
  sampler->DistributedSceneOn();
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToNone();
  sampler->SetViewpoints(2);
  sampler->SetResolution(8);
  sampler->SetSamples(4);
  sampler->SetColorTypeToFloat();
}

/// The bytes of a field of some inputs.
std::string Sample(vtkMultiProcessController* controller, const Pieces& inputs)
{
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, controller);
  for (const auto& input : inputs)
  {
    sampler->AddInputDataObject(0, input);
  }
  CSLF_CHECK(sampler->GetExecutive()->Update() == 1);
  vtkDataArray* colors = sampler->GetOutput()->GetPointData()->GetScalars();
  const auto size =
    static_cast<std::size_t>(colors->GetNumberOfValues()) * colors->GetDataTypeSize();
  CSLF_CHECK(colors->GetRange(0)[1] > 0.0);
  return { static_cast<const char*>(colors->GetVoidPointer(0)), size };
}

/// Adds lights of each kind.
void AddLights(vtkDataObject* data, double brightness)
{
  const double down[3] = { 0.0, 0.1, -1.0 };
  const double place[3] = { 0.5, 0.0, 2.0 };
  const double power[3] = { brightness, 0.5 * brightness, brightness };
  vtkCSLFLight::AddDirectionalLight(data, down, power);
  vtkCSLFLight::AddPointLight(data, place, power);
  vtkCSLFLight::AddSpotLight(data, place, down, power, 50.0, 2.0);
}

/// A rank's part, and the whole, which each rank makes for comparison.
void Compare(vtkMultiProcessController* controller, const std::function<Pieces(int)>& make,
  const Pieces& whole)
{
  const std::string together = Sample(controller, make(controller->GetLocalProcessId()));
  const std::string alone = Sample(nullptr, whole);
  CSLF_CHECK(together == alone);
}

/// Lights at the root of all pieces; at blocks whose numbers differ, because a piece is empty; at
/// different ranks; and twice at one place of one rank.
void TestLights(vtkMultiProcessController* controller)
{
  const int count = controller->GetNumberOfProcesses();
  vtkNew<vtkMultiBlockDataSet> whole;
  for (int i = 0; i < count; ++i)
  {
    whole->SetBlock(static_cast<unsigned int>(i), MakePlane(i));
  }
  AddLights(whole, 1.0);
  AddLights(whole, 1.0);
  const auto atRoots = [](int rank) -> Pieces
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    blocks->SetBlock(static_cast<unsigned int>(rank), MakePlane(rank));
    AddLights(blocks, 1.0);
    AddLights(blocks, 1.0);
    return { blocks };
  };
  Compare(controller, atRoots, { whole });

  const auto atBlocks = [count](int rank) -> Pieces
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    vtkNew<vtkPolyData> lights;
    AddLights(lights, 1.0);
    AddLights(lights, 1.0);
    if (rank == count - 1)
    {
      blocks->SetBlock(0, lights);
      return { blocks };
    }
    blocks->SetBlock(0, MakePlane(rank));
    if (rank == 0)
    {
      blocks->SetBlock(2, MakePlane(count - 1));
    }
    blocks->SetBlock(1, lights);
    return { blocks };
  };
  Compare(controller, atBlocks, { whole });

  vtkNew<vtkMultiBlockDataSet> different;
  different->ShallowCopy(whole);
  vtkCSLFLight::RemoveLights(different);
  for (int i = 0; i < count; ++i)
  {
    AddLights(different, count - i);
  }
  const auto ofEachRank = [count](int rank) -> Pieces
  {
    auto plane = MakePlane(rank);
    AddLights(plane, count - rank);
    return { plane };
  };
  Compare(controller, ofEachRank, { different });
}

/// Instances of geometry that is cut into pieces.
void TestInstances(vtkMultiProcessController* controller)
{
  const auto make = [](int begin, int end) -> Pieces
  {
    Pieces pieces;
    for (int i = begin; i < end; ++i)
    {
      auto plane = MakePlane(i);
      AddLights(plane, 1.0);
      vtkNew<vtkMatrix4x4> matrix;
      for (const double height : { 0.0, 0.5 })
      {
        matrix->SetElement(2, 3, height);
        vtkCSLFInstances::AddInstance(plane, matrix);
      }
      pieces.push_back(plane);
    }
    return pieces;
  };
  const int count = controller->GetNumberOfProcesses();
  Pieces whole = make(0, count);
  for (int i = 1; i < count; ++i)
  {
    vtkCSLFLight::RemoveLights(whole[i]);
  }
  // The last rank's piece is the whole's first.
  const auto reversed = [&](int rank) { return make(count - 1 - rank, count - rank); };
  Compare(controller, reversed, whole);
}

/// Messages that are smaller than a piece, as for pieces of more than 2 GiB.
void TestParts(vtkMultiProcessController* controller)
{
  const int rank = controller->GetLocalProcessId();
  const int count = controller->GetNumberOfProcesses();
  const Pieces pieces = { MakePlane(rank), MakePlane(10 + rank) };
  std::vector<vtkDataObject*> inputs = { pieces[0], pieces[1] };
  if (rank == 1)
  {
    inputs.clear();
  }
  for (const std::size_t size : { std::size_t(1), std::size_t(999), cslf::MaximumMessage })
  {
    cslf::SceneGather gather(controller, "", size);
    std::string error;
    CSLF_CHECK(gather.Begin(inputs, error));
    CSLF_CHECK(gather.Finish(error));
    CSLF_CHECK(error.empty());
    CSLF_CHECK(gather.GetCost().Pieces > 500);
    CSLF_CHECK(gather.GetCost().Node > gather.GetCost().Pieces * count);
    CSLF_CHECK(gather.GetCost().Memory > 0);
    CSLF_CHECK(static_cast<int>(gather.GetObjects().size()) == 2 * (count - 1));
    for (std::size_t i = 0; i < gather.GetObjects().size(); ++i)
    {
      const int from = gather.GetRanks()[i];
      CSLF_CHECK(from == (i < 2 ? 0 : static_cast<int>(i / 2 + 1)));
      auto* plane = vtkPolyData::SafeDownCast(gather.GetObjects()[i]);
      CSLF_CHECK(plane && plane->GetNumberOfPolys() == 1);
      CSLF_CHECK(plane && plane->GetCenter()[0] == 2.0 * (i % 2 == 0 ? from : 10 + from));
    }
  }

  cslf::GatherCost cost;
  cost.Pieces = std::uint64_t(3) << 30;
  cost.Node = std::uint64_t(40) << 30;
  cost.Memory = std::uint64_t(64) << 30;
  CSLF_CHECK(cost.FindWarning().empty());
  cost.Memory = std::uint64_t(16) << 30;
  CSLF_CHECK(cost.FindWarning().find("have 3 GiB") != std::string::npos);
  CSLF_CHECK(cost.FindWarning().find("need 40 GiB") != std::string::npos);
}

/// Makes a plane unless it fails.
class PlaneMaker : public vtkPolyDataAlgorithm
{
public:
  static PlaneMaker* New();
  vtkTypeMacro(PlaneMaker, vtkPolyDataAlgorithm);

  bool IsInPieces = true; ///< otherwise the pipeline requests data only on rank 0
  bool FailsToDescribe = false;
  bool FailsToMake = false;
  int Place = 0;

protected:
  PlaneMaker() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    if (this->IsInPieces)
    {
      output->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    }
    return this->FailsToDescribe ? 0 : 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkPolyData::GetData(output)->ShallowCopy(MakePlane(this->Place));
    return this->FailsToMake ? 0 : 1;
  }
};
vtkStandardNewMacro(PlaneMaker);

/// A sampler with its input and all their messages.
struct Pipeline
{
  vtkNew<PlaneMaker> Source;
  vtkNew<vtkCSLFSampler> Sampler;
  vtkNew<vtkTest::ErrorObserver> Messages;
  vtkNew<vtkTest::ErrorObserver> Others;

  explicit Pipeline(vtkMultiProcessController* controller)
  {
    SetUp(this->Sampler, controller);
    this->Sampler->SetInputConnection(this->Source->GetOutputPort());
    this->Sampler->GetEnvironment()->SetModeToConstant();
    this->Sampler->AddObserver(vtkCommand::ErrorEvent, this->Messages);
    for (vtkObject* object : { static_cast<vtkObject*>(this->Sampler->GetExecutive()),
           static_cast<vtkObject*>(this->Source),
           static_cast<vtkObject*>(this->Source->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, this->Others);
    }
  }
};

/// One rank fails, in a way that the pipeline may or may not report to the filter.
void TestFailure(vtkMultiProcessController* controller, int failing,
  const std::function<void(Pipeline&)>& disturb, const std::function<void(Pipeline&)>& mend,
  const std::string& message)
{
  const int rank = controller->GetLocalProcessId();
  Pipeline pipeline(controller);
  if (rank == failing)
  {
    disturb(pipeline);
  }
  CSLF_CHECK(pipeline.Sampler->GetExecutive()->Update() == 0);
  const std::string told = pipeline.Messages->GetErrorMessage();
  if (rank == failing)
  {
    CSLF_CHECK(pipeline.Messages->GetError() || pipeline.Others->GetError());
  }
  else
  {
    CSLF_CHECK(told.find("Rank " + std::to_string(failing) + " has failed: " + message) !=
      std::string::npos);
  }
  // No rank is ahead of another: all fail again, and then all succeed.
  pipeline.Messages->Clear();
  pipeline.Source->Modified();
  CSLF_CHECK(pipeline.Sampler->GetExecutive()->Update() == 0);
  CSLF_CHECK(rank == failing || pipeline.Messages->GetError());
  pipeline.Messages->Clear();
  pipeline.Others->Clear();
  if (rank == failing)
  {
    mend(pipeline);
  }
  pipeline.Source->Modified();
  CSLF_CHECK(pipeline.Sampler->GetExecutive()->Update() == 1);
  CSLF_CHECK(!pipeline.Messages->GetError() && !pipeline.Others->GetError());
  CSLF_CHECK(pipeline.Sampler->GetGatheredBytes() > 0);
  CSLF_CHECK(Sum(controller, 1) == controller->GetNumberOfProcesses());
}

/// A source that does not support pieces changes: only rank 0 has data, and all must gather again.
void TestSerialSource(vtkMultiProcessController* controller)
{
  Pipeline pipeline(controller);
  pipeline.Source->IsInPieces = false;
  for (const int place : { 0, 5 })
  {
    pipeline.Source->Place = place;
    pipeline.Source->Modified();
    CSLF_CHECK(pipeline.Sampler->GetExecutive()->Update() == 1);
    std::string error;
    const auto field = cslf::Description::ReadFrom(pipeline.Sampler->GetOutput(), error);
    CSLF_CHECK(field.has_value());
    CSLF_CHECK(field && std::abs(field->Box.Center.x - 2.0 * place) < 1e-6);
  }
  // Data that is updated without a change is not gathered again. One rank may do this alone.
  if (controller->GetLocalProcessId() == 0)
  {
    pipeline.Source->GetOutput()->Modified();
    pipeline.Sampler->Modified();
    CSLF_CHECK(pipeline.Sampler->GetExecutive()->Update() == 1);
  }
  CSLF_CHECK(Sum(controller, 1) == controller->GetNumberOfProcesses());
}

void TestFailures(vtkMultiProcessController* controller)
{
  for (int rank = 0; rank < controller->GetNumberOfProcesses(); ++rank)
  {
    TestFailure(
      controller, rank, [](Pipeline& pipeline) { pipeline.Source->FailsToMake = true; },
      [](Pipeline& pipeline) { pipeline.Source->FailsToMake = false; }, "its input has failed");
    TestFailure(
      controller, rank, [](Pipeline& pipeline) { pipeline.Source->FailsToDescribe = true; },
      [](Pipeline& pipeline) { pipeline.Source->FailsToDescribe = false; }, "its input has failed");
    TestFailure(
      controller, rank, [](Pipeline& pipeline) { pipeline.Sampler->RemoveAllInputs(); },
      [](Pipeline& pipeline)
      { pipeline.Sampler->SetInputConnection(pipeline.Source->GetOutputPort()); },
      "There is neither an input nor a renderer");
    TestFailure(
      controller, rank,
      [](Pipeline& pipeline)
      {
        pipeline.Sampler->GetEnvironment()->SetModeToImage();
        pipeline.Sampler->GetEnvironment()->SetFileName("/no/such/image.exr");
      },
      [](Pipeline& pipeline) { pipeline.Sampler->GetEnvironment()->SetModeToConstant(); }, "");
  }
}
}

int TestCSLFSceneGatherParallel(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv, 0);
  CSLF_CHECK(controller->GetNumberOfProcesses() > 1);
  TestLights(controller);
  TestInstances(controller);
  TestParts(controller);
  TestFailures(controller);
  TestSerialSource(controller);
  const bool good = Sum(controller, cslf::testing::Failures()) == 0;
  controller->Finalize();
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
