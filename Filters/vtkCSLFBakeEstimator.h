// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFBakeEstimator
 * @brief   tells how long a light field will take, and how large its file will be
 *
 * The estimator takes a vtkCSLFSampler and, for video, a vtkCSLFEncoder, both set up as for the
 * bake itself, and predicts from a short probe what writing the sampler's field would cost: on this
 * machine, with the threads that vtkSMPTools has now, by one process.
 *
 * - The radiance cache is built for a part of the surfaces, spread over the scene, and roughly
 *   interpolated elsewhere; one that the sampler has already costs nothing.
 * - Groups of viewpoints, spread over the faces, are rendered and coded in a small size; they tell
 *   how the cost is spread over the field.
 * - A few of these groups are rendered and coded in full size, as the encoder would, so frames
 *   that are predicted from others are counted for what they take. Where one such group would take
 *   too long, the largest size that does not is extrapolated.
 *
 * Image data and folders of cube maps are predicted from viewpoints that are written to a temporary
 * folder.
 *
 * The sampler's output is not that of its parameters afterwards, which its next update sets right.
 * Nothing is left of the probe.
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
    ImageData,  ///< as vtkXMLImageDataWriter writes it: .vti
    ImageFolder ///< as vtkCSLFImageWriter writes it
  };

  ///@{
  /**
   * What is written. Default: Video.
   */
  vtkSetClampMacro(Format, int, Video, ImageFolder);
  vtkGetMacro(Format, int);
  ///@}

  ///@{
  /**
   * What makes the field. Its parameters may be changed meanwhile, and are set back.
   */
  virtual void SetSampler(vtkCSLFSampler* sampler);
  vtkCSLFSampler* GetSampler();
  ///@}

  ///@{
  /**
   * Whose parameters video is coded with: its CRF, not its targets of size or quality. Null stands
   * for an encoder's defaults. Default: null.
   */
  virtual void SetEncoder(vtkCSLFEncoder* encoder);
  vtkCSLFEncoder* GetEncoder();
  ///@}

  ///@{
  /**
   * About the most seconds of a probe. At least 1. Default: 10.
   */
  vtkSetClampMacro(ProbeSeconds, double, 1.0, 1e6);
  vtkGetMacro(ProbeSeconds, double);
  ///@}

  /**
   * Probes. Returns 1 on success, 0 after an error.
   */
  int Estimate();

  /**
   * Probes, and sets the sampler's Samples to as many as can be taken in about so many seconds, at
   * least 1: the best quality within the time. Numbers of samples are rounded down to three binary
   * digits. Where NoiseTarget is above 0, all texels may not need them, so that the bake may end
   * earlier. Returns 1 on success; 0 after an error, which it is that one sample takes longer.
   */
  int ChooseSamples(double seconds);

  /**
   * Sets the sampler's Samples to those of a run that was killed while it wrote the same field to
   * that file, but for the samples with the same parameters, so that they need not be chosen anew.
   * Returns 1 if there is such a run, else 0.
   */
  int RecallSamples(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * What the last probe found: the seconds of building the scene, of the radiance cache, of
   * rendering and of coding, and their sum; and the bytes of the file, or of all files in the
   * folder. After ChooseSamples, rendering is that with the samples chosen, all else that with 4
   * samples a texel; after its error that one sample takes too long, all is that with 4. Estimate
   * tells all for the samples that the sampler has then.
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
   * What the last probe of a video tells of fields of other numbers of viewpoints and texels: the
   * PSNR of novel views in dB, looked up with depth, and the bytes of the file. A model with
   * constants that were measured on a few scenes: Documentation/Planning.md tells how far it can be
   * trusted. Viewpoints are at least 2, the resolution is at least 1; 0 for other numbers, and
   * without a probe.
   */
  double PredictPSNR(int viewpoints, int resolution) const;
  double PredictBytes(int viewpoints, int resolution) const;
  ///@}

  ///@{
  /**
   * Suggests the numbers of viewpoints and texels of the smallest file that reaches a PSNR, or of
   * the best field whose file is no larger than so many bytes. Chosen among 9, 17, 33 and 65
   * viewpoints and 32 to 1024 texels, powers of two. Returns 1 where there is one, else 0, which is
   * no error; both numbers are then 0, as they are by default.
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
