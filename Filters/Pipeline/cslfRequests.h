// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What consumers request from producers. VTK's executives keep the last request: after a consumer
 * has pulled single slices, the user's next Update() of the producer would make only those. And
 * what both lend each other through the information of outputs, without knowing each other's class.
 */
#ifndef cslfRequests_h
#define cslfRequests_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationVector.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

class vtkAlgorithmOutput;
class vtkInformation;

namespace cslf
{
class CacheKeeper;
struct TracedScene;

/// Whether the whole of an output is requested, as one piece.
inline bool IsWholeRequested(vtkInformation* output)
{
  const int* whole = output->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const int* asked = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
  return whole && asked && std::equal(whole, whole + 6, asked) &&
    output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()) <= 1;
}

/// Handles REQUEST_DATA_NOT_GENERATED. Whoever makes the whole field makes both ports, as VTK's
/// Update() does. A request for a part of it makes that part only, because consumers that stream
/// make many of them, and may not need the geometry. A request for the geometry makes no samples.
/// An output that is not made stays as it is.
inline void ChoosePorts(vtkInformation* request, vtkInformationVector* outputs, bool isWhole)
{
  vtkInformation* field = outputs->GetInformationObject(0);
  vtkInformation* geometry = outputs->GetInformationObject(1);
  if (request->Get(vtkExecutive::FROM_OUTPUT_PORT()) == 1)
  {
    field->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
  else if (!isWhole)
  {
    geometry->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

/// Handles REQUEST_UPDATE_TIME: the field and its geometry are those of one time, which is
/// requested of either.
inline void ShareTime(vtkInformation* request, vtkInformationVector* outputs)
{
  const auto key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  vtkInformation* asked =
    outputs->GetInformationObject(std::max(request->Get(vtkExecutive::FROM_OUTPUT_PORT()), 0));
  for (int port = 0; port < outputs->GetNumberOfInformationObjects() && asked->Has(key); ++port)
  {
    outputs->GetInformationObject(port)->Set(key, asked->Get(key));
  }
}

/// Whether a port's output is to be made, in REQUEST_DATA.
inline bool IsPortWanted(vtkInformationVector* outputs, int port)
{
  return outputs->GetInformationObject(port)->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()) ==
    0;
}

/// Tells the pipeline, in REQUEST_DATA, that a port's output was not made after all, so that the
/// next request makes it.
inline void SetNotMade(vtkInformationVector* outputs, int port)
{
  outputs->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
}

/// Restores the requests to a connection's producer, and to all filters before it, when it is
/// destroyed. Restoring makes no filter execute. Whoever pulls parts creates it before the first
/// one.
class VTKCSLF_EXPORT KeptRequests
{
public:
  /// Keeps the present requests. The connection may be null.
  explicit KeptRequests(vtkAlgorithmOutput* connection);
  ~KeptRequests();
  KeptRequests(const KeptRequests&) = delete;
  KeptRequests& operator=(const KeptRequests&) = delete;

private:
  /// The pipeline information of an output, and a copy of its request.
  std::vector<std::pair<vtkSmartPointer<vtkInformation>, vtkSmartPointer<vtkInformation>>> Kept;
};

/// Requests the part that a filter needs at first, in its RequestUpdateExtent. The filter pulls
/// other parts in RequestData, where it creates a KeptRequests. As the filter's own first part is
/// not what a user requested, the whole is requested afterwards.
void RequestFirstPart(vtkInformation* information, const int extent[6]);

/// Updates the output of that pipeline information, as one piece, to a range of slices.
bool UpdateSlices(vtkInformation* information, int first, int last);

///@{
/// The quality that a filter bakes in, one of vtkCSLFPathTracer's: it sets it in
/// RequestInformation. Filters that do not bake have none.
void SetBakeQuality(vtkInformation* output, int quality);
std::optional<int> GetBakeQuality(vtkInformation* output);
///@}

///@{
/// Lends a keeper of radiance caches to the filter of that output, which uses it when it executes.
/// Null ends the loan.
void LendCacheKeeper(vtkInformation* output, CacheKeeper* keeper);
CacheKeeper* BorrowCacheKeeper(vtkInformation* output);
///@}

///@{
/// Offers the scene of a filter to those that its output feeds: it does so in RequestInformation.
/// Null if there is none.
void OfferScene(vtkInformation* output, const TracedScene* scene);
const TracedScene* FindScene(vtkInformation* output);
///@}

/// Whether a connection's whole output, image data, is there already, as UpdateInformation left its
/// pipeline.
bool IsWholeThere(vtkAlgorithmOutput* connection);

/// Updates the information of a connection at the time that is requested of it.
bool UpdateInformation(vtkAlgorithmOutput* connection);

/// Updates a connection to its whole output, whatever was requested before, at the same time.
VTKCSLF_EXPORT bool UpdateWhole(vtkAlgorithmOutput* connection);
}

#endif
