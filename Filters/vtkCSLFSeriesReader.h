// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSeriesReader
 * @brief   reads light fields of several times
 *
 * The file is the index of a series of videos, one for each time, as vtkCSLFSeriesWriter writes it:
 * `NAME.mp4.series`, ParaView's text for file series. A video is read, too, as a series without
 * times. The reader announces the times to the pipeline, and delivers the field and the geometry of
 * the time that is requested: of the last step that is not later, or of the first one.
 *
 * @code
 *   reader->SetFileName("wave.mp4.series");
 *   reader->UpdateInformation();
 *   mapper->SetInputConnection(0, reader->GetOutputPort(0));
 *   mapper->SetInputConnection(1, reader->GetOutputPort(1));
 *   reader->SetTime(reader->GetTimeStep(3));  // or any request for UPDATE_TIME_STEP
 *   window->Render();
 * @endcode
 *
 * One step is open at a time, and what the other methods of vtkCSLFDecoder return is of this one.
 * The fields of a series may have different surfaces, numbers of triangles, cubes and sizes. Where
 * sizes differ, other filters than vtkCSLFMapper and vtkCSLFEncoder, which decide on extents before
 * the time is known, may fail.
 *
 * @sa
 * vtkCSLFSeriesWriter vtkCSLFDecoder
 */
#ifndef vtkCSLFSeriesReader_h
#define vtkCSLFSeriesReader_h

#include "vtkCSLFDecoder.h"
#include "vtkCSLFModule.h" // For export macro

#include <string> // For names
#include <vector> // For times

class VTKCSLF_EXPORT vtkCSLFSeriesReader : public vtkCSLFDecoder
{
public:
  static vtkCSLFSeriesReader* New();
  vtkTypeMacro(vtkCSLFSeriesReader, vtkCSLFDecoder);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Whether a file is the index of a series whose first file is a coded light field, or such a
   * field: 3 if it is, 0 if not. Reports no error.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * The file extensions, and their description in file dialogs.
   */
  const char* GetFileExtensions() { return ".mp4 .mkv .mp4.series .mkv.series"; }
  const char* GetDescriptiveName() { return "Cube surface light field"; }
  ///@}

  ///@{
  /**
   * The times of the steps, ascending, after UpdateInformation: their number, 0 for a video, and a
   * time, in the units of the data that was baked. 0.0 outside the range.
   */
  int GetNumberOfTimeSteps() const { return static_cast<int>(this->Times.size()); }
  double GetTimeStep(int step) const;
  ///@}

  /**
   * The file of a step, after UpdateInformation. Null outside the range.
   */
  const char* GetStepFileName(int step) const;

  /**
   * Requests a time of both outputs, for the next update and for mappers. Other requests for time
   * replace it.
   */
  void SetTime(double time);

  /**
   * The step that is open, after an update of the information at its time. -1 for a video, or if
   * none could be opened.
   */
  vtkGetMacro(OpenStep, int);

protected:
  vtkCSLFSeriesReader();
  ~vtkCSLFSeriesReader() override;

  std::string ChooseFile(vtkInformation* request) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFSeriesReader(const vtkCSLFSeriesReader&) = delete;
  void operator=(const vtkCSLFSeriesReader&) = delete;

  bool ReadIndex();
  int FindStep(vtkInformation* request) const;

  std::vector<double> Times;
  std::vector<std::string> Names;
  int OpenStep = -1;
  double Time = VTK_DOUBLE_MIN; // that SetTime has requested
};

#endif
