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
 * warning says how many there are. It is an error instead, and there is no output, with
 * AllowMissing off, if none of those asked for can be read, or if fewer than one in 64 of many has
 * images.
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
   * The folder to read.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether a folder is a light field: 3 if it is, 0 if not. Reports no error.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName);

  /**
   * What to call such folders in a file dialog.
   */
  const char* GetDescriptiveName() { return "Cube surface light field (cube maps)"; }

  /**
   * The field's description (JSON text), once UpdateInformation has run; empty before, and where it
   * could not be read.
   */
  const char* GetDescription() const;

  ///@{
  /**
   * The viewpoints (z) found to be missing by the last update or by FindMissingViewpoints, in
   * ascending order.
   */
  vtkIdType GetNumberOfMissingViewpoints() const;
  vtkIdTypeArray* GetMissingViewpoints() const;
  ///@}

  ///@{
  /**
   * Whether viewpoints that are missing are left empty, with a warning. If not, asking for any of
   * them is an error, whose code is vtkErrorCode::PrematureEndOfFileError. Default: true.
   */
  vtkSetMacro(AllowMissing, bool);
  vtkGetMacro(AllowMissing, bool);
  vtkBooleanMacro(AllowMissing, bool);
  ///@}

  /**
   * Checks that all images are there and of the right size and type, and their checksums. Returns
   * the number of missing viewpoints, or -1 with an error if the folder is none that can be read.
   */
  vtkIdType FindMissingViewpoints();

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

  class Internals;

  bool Guard(const std::function<bool()>& work);
  bool Fail(unsigned long code, const std::string& text);
  bool ReadDescription();
  bool ReadRange(int first, int last, vtkImageData* image);

  char* FileName = nullptr;
  bool AllowMissing = true;
  const std::unique_ptr<Internals> Internal;
};

#endif
