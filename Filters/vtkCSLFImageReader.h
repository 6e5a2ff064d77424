// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFImageReader
 * @brief read a light field from a folder of cube maps
 *
 * vtkCSLFImageReader reads exactly the values that vtkCSLFImageWriter wrote. The whole extent is
 * known from the folder's description. Only the images of the viewpoints in the update extent are
 * read, in parallel.
 *
 * If an image of a viewpoint is missing or damaged, the viewpoint is filled with colour 0 and depth
 * 1, and a warning states how many there are. In the following cases there is an error instead, and
 * no output: AllowMissing is off, none of the requested viewpoints can be read, or fewer than 1 in
 * 64 of a large number of viewpoints have images.
 *
 * @sa vtkCSLFImageWriter
 */
#ifndef vtkCSLFImageReader_h
#define vtkCSLFImageReader_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkImageAlgorithm.h"

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string

class vtkIdTypeArray;

class VTKCSLF_EXPORT vtkCSLFImageReader : public vtkImageAlgorithm
{
public:
  static vtkCSLFImageReader* New();
  vtkTypeMacro(vtkCSLFImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to read. Required.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether a folder is a light field: 3 if it is, 0 if not. Reports no error.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName);

  /**
   * The description of such folders in file dialogs.
   */
  const char* GetDescriptiveName() { return "Cube surface light field (cube maps)"; }

  /**
   * The field's description (JSON text), available after UpdateInformation. Empty before, and if it
   * could not be read.
   */
  const char* GetDescription() const;

  ///@{
  /**
   * The missing viewpoints (z) found by the last update or by FindMissingViewpoints, in ascending
   * order. Later updates make new arrays, so this one does not change.
   */
  vtkIdType GetNumberOfMissingViewpoints() const;
  vtkIdTypeArray* GetMissingViewpoints() const;
  ///@}

  ///@{
  /**
   * Whether missing viewpoints are left empty, with a warning, and listed in the array
   * `MissingViewpoints` of the output's field data. If off, requesting one of them is an
   * error with the code vtkErrorCode::PrematureEndOfFileError. Default: on.
   */
  vtkSetMacro(AllowMissing, bool);
  vtkGetMacro(AllowMissing, bool);
  vtkBooleanMacro(AllowMissing, bool);
  ///@}

  /**
   * Checks that all images exist with the right size and type, and verifies their checksums.
   * Returns the number of missing viewpoints, or -1 with an error if the folder cannot be read.
   */
  vtkIdType FindMissingViewpoints();

protected:
  vtkCSLFImageReader();
  ~vtkCSLFImageReader() override;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFImageReader(const vtkCSLFImageReader&) = delete;
  void operator=(const vtkCSLFImageReader&) = delete;

  class Internals;

  bool Guard(const std::function<bool()>& work);
  bool Fail(unsigned long code, const std::string& text);
  bool ReadDescription();
  bool ReadRange(int first, int last, vtkImageData* image);

  char* FileName = nullptr;
  bool AllowMissing;
  const std::unique_ptr<Internals> Internal;
};

#endif
