// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What consumers request from producers. VTK's executives keep the last request: after a consumer
 * has pulled single slices, the user's next Update() of the producer would make only those.
 */
#ifndef cslfRequests_h
#define cslfRequests_h

#include "vtkCSLFModule.h" // for export macro

#include <vtkSmartPointer.h>

#include <utility>
#include <vector>

class vtkAlgorithmOutput;
class vtkInformation;

namespace cslf
{
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

/// Whether a connection's whole output, image data, is there already, as UpdateInformation left its
/// pipeline.
bool IsWholeThere(vtkAlgorithmOutput* connection);

/// Updates a connection to its whole output, whatever was requested before.
VTKCSLF_EXPORT bool UpdateWhole(vtkAlgorithmOutput* connection);
}

#endif
