// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFBakeEstimator
 * @brief   predicts the time and the file size of a light field
 *
 * The estimator takes a vtkCSLFSampler and, for video, a vtkCSLFEncoder, both set up as for the
 * bake. It predicts from a short probe the cost of writing the sampler's field on this machine, by
 * one process with the current number of threads of vtkSMPTools.
 *
 * - The radiance cache is built for a part of the surfaces, spread over the scene, and roughly
 * interpolated elsewhere. If the sampler already has a cache, it costs nothing.
 * - Groups of viewpoints, spread over the faces, are rendered and coded at a small size. They show
 * how the cost varies over the field.
 * - If the encoder is connected to the sampler's output port 1, the geometry is made, and tells
 * depth unless the encoder is told otherwise.
 * - A few of these groups are rendered and coded at full size as by the encoder, so the cost of
 * predicted frames is included. If one such group would take too long, the cost is extrapolated
 * from the largest size that does not.
 *
 * For image data and folders of cube maps, the prediction uses viewpoints that are written to a
 * temporary folder.
 *
 * Afterwards, the sampler's output does not match its parameters until its next update. The probe
 * leaves no files.
 */
#ifndef vtkCSLFBakeEstimator_h
#define vtkCSLFBakeEstimator_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"
#include "vtkSmartPointer.h" // for members

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr

namespace cslf
{
class BakeProbe;
}

class vtkCSLFEncoder;
class vtkCSLFSampler;

class VTKCSLF_EXPORT vtkCSLFBakeEstimator : public vtkObject
{
public:
  static vtkCSLFBakeEstimator* New();
  vtkTypeMacro(vtkCSLFBakeEstimator, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The kinds of files whose cost can be estimated.
   */
  enum Formats
  {
    Video = 0,  ///< as the encoder writes it: .mp4, .mkv
    ImageData,  ///< .vti, as vtkXMLImageDataWriter writes it with LZ4
    ImageFolder ///< as vtkCSLFImageWriter writes it
  };

  ///@{
  /**
   * The kind of file. Default: Video.
   */
  void SetFormat(int format);
  vtkGetMacro(Format, int);
  ///@}

  ///@{
  /**
   * The sampler of the field. Required. Its parameters may be changed during a probe, and are
   * restored afterwards.
   */
  virtual void SetSampler(vtkCSLFSampler* sampler);
  vtkCSLFSampler* GetSampler();
  ///@}

  ///@{
  /**
   * The encoder whose parameters are used for video: its CRF, not its targets of size or quality.
   * Null selects the defaults of an encoder. Default: null.
   */
  virtual void SetEncoder(vtkCSLFEncoder* encoder);
  vtkCSLFEncoder* GetEncoder();
  ///@}

  ///@{
  /**
   * The approximate maximum time of a probe in seconds. At least 1. Default: 10.
   */
  void SetProbeSeconds(double seconds);
  vtkGetMacro(ProbeSeconds, double);
  ///@}

  /**
   * Runs the probe. Returns 1 on success, 0 after an error.
   */
  int Estimate();

  /**
   * Runs the probe and sets the sampler's Samples to the number that fits into about this number of
   * seconds, at least 1. The number is rounded down to three binary digits. If NoiseTarget is above
   * 0, some texels may need fewer samples, so the bake may end earlier. Returns 1 on success, and 0
   * after an error; it is an error if a single sample takes longer.
   */
  int ChooseSamples(double seconds);

  /**
   * Sets the sampler's Samples to those of an interrupted run that wrote the same field to this
   * file, with the same parameters except for the samples, so that they need not be chosen again.
   * Returns 1 if there is such a run, otherwise 0.
   */
  int RecallSamples(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * The results of the last probe: the seconds for building the scene, for the radiance cache, for
   * rendering and for coding, and their sum; and the bytes of the file, or of all files in the
   * folder. After Estimate, all results are for the sampler's Samples. After ChooseSamples,
   * rendering is for the chosen number of samples, and the rest for 4 samples per texel; if a
   * single sample takes too long, everything is for 4.
   */
  vtkGetMacro(SceneSeconds, double);
  vtkGetMacro(CacheSeconds, double);
  vtkGetMacro(RenderSeconds, double);
  vtkGetMacro(CodingSeconds, double);
  double GetSeconds() const;
  vtkGetMacro(Bytes, double);
  ///@}

  ///@{
  /**
   * Predictions, from the last probe of a video, for fields with other numbers of viewpoints and
   * texels: the PSNR of novel views in dB with the depth lookup, and the bytes of the file. The
   * constants of the model were measured on a few scenes; Documentation/Planning.md states its
   * accuracy. There must be at least 2 viewpoints and a resolution of at least 1; for other
   * numbers, and without a probe, the result is 0.
   */
  double PredictPSNR(int viewpoints, int resolution) const;
  double PredictBytes(int viewpoints, int resolution) const;
  ///@}

  ///@{
  /**
   * Suggests the numbers of viewpoints and texels of the smallest file that reaches a PSNR, or of
   * the best field whose file has at most this number of bytes. Candidates are 9, 17, 33 and 65
   * viewpoints, and powers of two from 32 to 1024 texels. Returns 1 if there is one. Otherwise it
   * returns 0, which is not an error, and both numbers are 0, as they are by default.
   */
  int SuggestForPSNR(double psnr);
  int SuggestForBytes(double bytes);
  vtkGetMacro(SuggestedViewpoints, int);
  vtkGetMacro(SuggestedResolution, int);
  ///@}

  /**
   * The seconds that the last call of Estimate or ChooseSamples took, failed or not.
   */
  vtkGetMacro(SecondsTaken, double);

protected:
  vtkCSLFBakeEstimator();
  ~vtkCSLFBakeEstimator() override;

private:
  vtkCSLFBakeEstimator(const vtkCSLFBakeEstimator&) = delete;
  void operator=(const vtkCSLFBakeEstimator&) = delete;

  void BeginProbe();
  bool RunProbe(cslf::BakeProbe& probe);
  cslf::BakeProbe MakeProbe();
  int FindSamples(double seconds);
  int ReadSamples(const std::string& name);
  int Suggest(const std::function<double(double psnr, double bytes)>& getCost);

  int Format = Video;
  double ProbeSeconds = 10.0;
  double SceneSeconds = 0.0;
  double CacheSeconds = 0.0;
  double RenderSeconds = 0.0;
  double CodingSeconds = 0.0;
  double Bytes = 0.0;
  double SecondsTaken = 0.0;
  int SuggestedViewpoints = 0;
  int SuggestedResolution = 0;
  struct Outlook;
  std::unique_ptr<Outlook> Look; // null without a probe of a video
  vtkSmartPointer<vtkCSLFSampler> Sampler;
  vtkSmartPointer<vtkCSLFEncoder> Encoder;
};

#endif
