// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFImageReader
 * @brief read a light field from a folder of cube maps
 *
 * vtkCSLFImageReader reads what vtkCSLFImageWriter wrote, bit for bit. The whole extent comes from
 * the folder's description alone; of the images only those of the viewpoints in the update extent
 * are read, in parallel.
 *
 * A viewpoint of which an image is missing or damaged is filled with colour 0 and depth 1, and a
 * warning says how many there are. It is an error if none of those asked for can be read.
 *
 * @sa vtkCSLFImageWriter
 */
#ifndef vtkCSLFImageReader_h
#define vtkCSLFImageReader_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr

class VTKCSLF_EXPORT vtkCSLFImageReader : public vtkImageAlgorithm
{
public:
  static vtkCSLFImageReader* New();
  vtkTypeMacro(vtkCSLFImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to read.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Returns 1 if the folder holds a light field's description, and 0 otherwise.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  /**
   * The field's description as JSON text, after UpdateInformation(); empty before, and where it
   * could not be read.
   */
  const char* GetDescription();

  ///@{
  /**
   * The viewpoints (z indices) of the last update that could not be read, ascending.
   */
  int GetNumberOfMissingViewpoints();
  int GetMissingViewpoint(int index);
  ///@}

protected:
  vtkCSLFImageReader();
  ~vtkCSLFImageReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFImageReader(const vtkCSLFImageReader&) = delete;
  void operator=(const vtkCSLFImageReader&) = delete;

  bool ReadDescription();

  struct Internal;
  std::unique_ptr<Internal> Internals;
  char* FileName = nullptr;
};

#endif
