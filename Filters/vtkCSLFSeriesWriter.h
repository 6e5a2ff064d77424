// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSeriesWriter
 * @brief   bakes a scene that changes over time: a light field for each of its steps
 *
 * The input of the sampler announces its time steps to the pipeline (TIME_STEPS), as readers of
 * VTK do. For each of them, the encoder writes a video: if its FileName is `wave.mp4`, those are
 * `wave_0000.mp4`, `wave_0001.mp4` and so on, numbered as the steps of the input. In the end, the
 * index `wave.mp4.series` names them with their times, as ParaView's file series do, and
 * vtkCSLFSeriesReader reads it.
 *
 * @code
 *   look->SetInputConnection(reader->GetOutputPort());
 *   sampler->SetInputConnection(look->GetOutputPort());
 *   encoder->SetInputConnection(0, sampler->GetOutputPort(0));
 *   encoder->SetInputConnection(1, sampler->GetOutputPort(1));
 *   encoder->SetFileName("wave.mp4");
 *   writer->SetSampler(sampler);
 *   writer->SetEncoder(encoder);
 *   writer->SetLook(look);
 *   writer->Write();
 * @endcode
 *
 * All steps have the same cube, and the same colours for the same values: unless the sampler's
 * cube and the colour range of the look are set, all steps are read first, for their bounds and
 * ranges. Everything else may change from step to step. One step is in memory at a time, besides
 * what filters keep of the previous one until it is replaced.
 *
 * While steps are written, the folder `wave.mp4.series.partial` keeps which are finished. If a run
 * is interrupted, the next one keeps each of them whose file is whole and whose scene and settings
 * are the same, by a hash, and resumes the step that was being written, as vtkCSLFEncoder does. The
 * files then have the bytes of an uninterrupted run. So has a run that only adds steps, if the cube
 * and the range were set. With the encoder's Restart off, all steps are written.
 *
 * @sa
 * vtkCSLFSeriesReader vtkCSLFEncoder vtkCSLFSampler vtkCSLFSceneLook
 */
#ifndef vtkCSLFSeriesWriter_h
#define vtkCSLFSeriesWriter_h

#include "vtkCSLFModule.h" // For export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // For members

#include <string> // For names
#include <vector> // For times

class vtkCSLFEncoder;
class vtkCSLFSampler;
class vtkCSLFSceneLook;

namespace cslf
{
class SeriesIndex;
}

class VTKCSLF_EXPORT vtkCSLFSeriesWriter : public vtkObject
{
public:
  static vtkCSLFSeriesWriter* New();
  vtkTypeMacro(vtkCSLFSeriesWriter, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The sampler of the steps, and the encoder that writes what it makes. Both are required. The
   * encoder's file name and the sampler's cube are changed during Write, and restored afterwards.
   */
  virtual void SetSampler(vtkCSLFSampler* sampler);
  vtkCSLFSampler* GetSampler();
  virtual void SetEncoder(vtkCSLFEncoder* encoder);
  vtkCSLFEncoder* GetEncoder();
  ///@}

  ///@{
  /**
   * The filter that colours the scene before the sampler, or null if its colours need no range over
   * all steps. Default: null.
   */
  virtual void SetLook(vtkCSLFSceneLook* look);
  vtkCSLFSceneLook* GetLook();
  ///@}

  ///@{
  /**
   * The numbers of the first and the last step that are written, from 0 on. A last step that does
   * not exist means the last one that does. Default: 0, VTK_INT_MAX.
   */
  vtkSetVector2Macro(TimeStepRange, int);
  vtkGetVector2Macro(TimeStepRange, int);
  ///@}

  ///@{
  /**
   * The interval between these steps, at least 1. Default: 1.
   */
  vtkSetClampMacro(TimeStepInterval, int, 1, VTK_INT_MAX);
  vtkGetMacro(TimeStepInterval, int);
  ///@}

  /**
   * Writes the steps that are not finished yet, and the index. Returns 1 on success, and 0 after an
   * error or if the encoder was aborted. StartEvent is invoked before each step.
   */
  int Write();

  /**
   * The name of the index: the encoder's file name with `.series`. Empty without an encoder.
   */
  std::string GetIndexName() const;

  ///@{
  /**
   * The steps of the last Write: how many there are, how many are done, how many of these an
   * earlier run had left, and the file of the one that is being written or was last.
   */
  vtkGetMacro(NumberOfSteps, int);
  vtkGetMacro(DoneSteps, int);
  vtkGetMacro(KeptSteps, int);
  const char* GetStepFileName() const { return this->StepFileName.c_str(); }
  ///@}

protected:
  vtkCSLFSeriesWriter();
  ~vtkCSLFSeriesWriter() override;

private:
  vtkCSLFSeriesWriter(const vtkCSLFSeriesWriter&) = delete;
  void operator=(const vtkCSLFSeriesWriter&) = delete;

  struct Step
  {
    int Number;
    double Time;
  };

  bool Fail(const std::string& text);
  bool WriteSteps();
  bool FindSteps(std::vector<Step>& steps);
  bool FixCube(const std::vector<Step>& steps);
  bool WriteStep(const Step& step, cslf::SeriesIndex* index);
  void RequestTime(double time);
  bool IsFirstRank() const;
  bool Agree(bool isSo) const;

  vtkSmartPointer<vtkCSLFSampler> Sampler;
  vtkSmartPointer<vtkCSLFEncoder> Encoder;
  vtkSmartPointer<vtkCSLFSceneLook> Look;
  int TimeStepRange[2] = { 0, VTK_INT_MAX };
  int TimeStepInterval = 1;
  int NumberOfSteps = 0;
  int DoneSteps = 0;
  int KeptSteps = 0;
  std::string StepFileName;
};

#endif
