// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfRequests.h"

#include "Pipeline/cslfPhase.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationObjectBaseKey.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace cslf
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// The extent that RequestFirstPart has requested, until it is replaced.
vtkInformationIntegerVectorKey* FirstPart()
{
  static auto* key = vtkInformationIntegerVectorKey::MakeKey("FIRST_PART", "cslfRequests", 6);
  return key;
}

/// Whether RequestFirstPart has made filters before that output request parts of it.
vtkInformationIntegerKey* ForFirstPart()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("FOR_FIRST_PART", "cslfRequests");
  return key;
}

vtkInformationIntegerKey* BakeQuality()
{
  static auto* key = vtkInformationIntegerKey::MakeKey("BAKE_QUALITY", "cslfRequests");
  return key;
}

/// What one filter lends another, in an output's information.
class SceneLoan : public vtkObject
{
public:
  static SceneLoan* New();
  vtkTypeMacro(SceneLoan, vtkObject);

  CacheKeeper* Keeper = nullptr;
  const TracedScene* Scene = nullptr;
};
vtkStandardNewMacro(SceneLoan);

vtkInformationObjectBaseKey* LentKeeper()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("CACHE_KEEPER", "cslfRequests");
  return key;
}

vtkInformationObjectBaseKey* OfferedScene()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("SCENE", "cslfRequests");
  return key;
}

bool HasEqualExtents(vtkInformation* first, vtkInformationIntegerVectorKey* firstKey,
  vtkInformation* second, vtkInformationIntegerVectorKey* secondKey)
{
  const int* a = first->Get(firstKey);
  const int* b = second->Get(secondKey);
  return a && b ? std::equal(a, a + 6, b) : a == b;
}

/// Whether the output's request was made for a first part, not by a user.
bool IsForFirstPart(vtkInformation* information)
{
  return information->Has(ForFirstPart()) ||
    (information->Has(FirstPart()) &&
      HasEqualExtents(information, FirstPart(), information, Pipeline::UPDATE_EXTENT()));
}

void CopyRequest(vtkInformation* from, vtkInformation* to)
{
  to->CopyEntry(from, Pipeline::UPDATE_EXTENT());
  to->CopyEntry(from, Pipeline::COMBINED_UPDATE_EXTENT());
  to->CopyEntry(from, Pipeline::EXACT_EXTENT());
  to->CopyEntry(from, Pipeline::UPDATE_PIECE_NUMBER());
  to->CopyEntry(from, Pipeline::UPDATE_NUMBER_OF_PIECES());
  to->CopyEntry(from, Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
}

void RequestWhole(vtkInformation* information)
{
  information->Set(Pipeline::UPDATE_EXTENT(), information->Get(Pipeline::WHOLE_EXTENT()), 6);
}

bool Update(vtkInformation* information, const int extent[6])
{
  vtkExecutive* executive = vtkExecutive::PRODUCER()->GetExecutive(information);
  const int port = vtkExecutive::PRODUCER()->GetPort(information);
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(port + 1);
  vtkInformation* request = requests->GetInformationObject(port);
  request->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (extent)
  {
    request->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
  return executive && executive->GetAlgorithm()->Update(port, requests) != 0;
}
}

KeptRequests::KeptRequests(vtkAlgorithmOutput* connection)
{
  for (const auto& producer : FindProducers(connection))
  {
    for (int port = 0; port < producer->GetNumberOfOutputPorts(); ++port)
    {
      vtkInformation* information = producer->GetOutputInformation(port);
      const auto request = vtkSmartPointer<vtkInformation>::New();
      CopyRequest(information, request);
      request->CopyEntry(information, Pipeline::WHOLE_EXTENT());
      if (IsForFirstPart(information))
      {
        RequestWhole(request);
      }
      this->Kept.emplace_back(information, request);
    }
  }
}

KeptRequests::~KeptRequests()
{
  for (const auto& [information, request] : this->Kept)
  {
    CopyRequest(request, information);
    information->Remove(FirstPart());
    information->Remove(ForFirstPart());
    if (!HasEqualExtents(information, Pipeline::WHOLE_EXTENT(), request, Pipeline::WHOLE_EXTENT()))
    {
      // The output has changed, as has the pipeline's default request with it.
      RequestWhole(information);
    }
  }
}

void RequestFirstPart(vtkInformation* information, const int extent[6])
{
  information->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  information->Set(FirstPart(), extent, 6);
  // Filters between, such as vtkExtractVOI, request parts in turn.
  vtkAlgorithm* consumer = vtkExecutive::PRODUCER()->GetExecutive(information)->GetAlgorithm();
  const int consumerPort = vtkExecutive::PRODUCER()->GetPort(information);
  for (const auto& producer : FindProducers(consumer->GetOutputPort(consumerPort)))
  {
    for (int port = 0; producer != consumer && port < producer->GetNumberOfOutputPorts(); ++port)
    {
      vtkInformation* output = producer->GetOutputInformation(port);
      if (output->Has(Pipeline::WHOLE_EXTENT()))
      {
        output->Set(ForFirstPart(), 1);
      }
    }
  }
}

bool UpdateSlices(vtkInformation* information, int first, int last)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  information->Get(Pipeline::WHOLE_EXTENT(), extent);
  extent[4] = first;
  extent[5] = last;
  return Update(information, extent);
}

void SetBakeQuality(vtkInformation* output, int quality)
{
  output->Set(BakeQuality(), quality);
}

std::optional<int> GetBakeQuality(vtkInformation* output)
{
  return output->Has(BakeQuality()) ? std::make_optional(output->Get(BakeQuality())) : std::nullopt;
}

void LendCacheKeeper(vtkInformation* output, CacheKeeper* keeper)
{
  vtkNew<SceneLoan> loan;
  loan->Keeper = keeper;
  output->Set(LentKeeper(), keeper ? loan.Get() : nullptr);
}

CacheKeeper* BorrowCacheKeeper(vtkInformation* output)
{
  auto* loan = SceneLoan::SafeDownCast(output->Get(LentKeeper()));
  return loan ? loan->Keeper : nullptr;
}

void OfferScene(vtkInformation* output, const TracedScene* scene)
{
  vtkNew<SceneLoan> loan;
  loan->Scene = scene;
  output->Set(OfferedScene(), loan.Get());
}

const TracedScene* FindScene(vtkInformation* output)
{
  auto* loan = SceneLoan::SafeDownCast(output->Get(OfferedScene()));
  return loan ? loan->Scene : nullptr;
}

bool IsWholeThere(vtkAlgorithmOutput* connection)
{
  vtkAlgorithm* producer = connection->GetProducer();
  auto* executive = Pipeline::SafeDownCast(producer->GetExecutive());
  vtkInformation* information = producer->GetOutputInformation(connection->GetIndex());
  auto* image = vtkImageData::GetData(information);
  const int* whole = information->Get(Pipeline::WHOLE_EXTENT());
  return executive && image && whole && std::equal(whole, whole + 6, image->GetExtent()) &&
    image->GetNumberOfPoints() > 0 && image->GetUpdateTime() > executive->GetPipelineMTime();
}

bool UpdateInformation(vtkAlgorithmOutput* connection)
{
  vtkExecutive* executive = connection->GetProducer()->GetExecutive();
  auto* timed = Pipeline::SafeDownCast(executive);
  const int port = connection->GetIndex();
  return executive->UpdateInformation() != 0 &&
    (!timed || (timed->PropagateTime(port) && timed->UpdateTimeDependentInformation(port)));
}

bool UpdateWhole(vtkAlgorithmOutput* connection)
{
  vtkAlgorithm* producer = connection->GetProducer();
  auto* executive = Pipeline::SafeDownCast(producer->GetExecutive());
  if (!executive)
  {
    return producer->GetExecutive()->Update(connection->GetIndex()) != 0;
  }
  if (!UpdateInformation(connection))
  {
    return false;
  }
  vtkInformation* information = producer->GetOutputInformation(connection->GetIndex());
  return Update(information, information->Get(Pipeline::WHOLE_EXTENT()));
}
}
