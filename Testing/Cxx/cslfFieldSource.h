// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A source that makes only the requested slices of a light field, and counts them.
 */
#ifndef cslfFieldSource_h
#define cslfFieldSource_h

#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

namespace cslf
{
namespace testing
{
class FieldSource : public vtkImageAlgorithm
{
public:
  static FieldSource* New();
  vtkTypeMacro(FieldSource, vtkImageAlgorithm);

  vtkSmartPointer<vtkImageData> Field;
  int MaximumRequest = 0;
  int Slices = 0;        ///< made so far
  int FailingSlice = -1; ///< fails when it is requested

protected:
  FieldSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
};

vtkSmartPointer<FieldSource> MakeSource(vtkImageData* field);
}
}

#endif
