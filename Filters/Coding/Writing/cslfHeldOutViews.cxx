// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHeldOutViews.h"
#include "Coding/Geometry/cslfGeometryRays.h"
#include "Coding/Geometry/cslfShownRays.h"
#include "Coding/Groups/cslfGroupEncoder.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include "Quality/cslfDisplayCurve.h"
#include "Quality/cslfTexelChoice.h"
#include "cslfColor.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

namespace cslf
{
namespace
{
/// The viewpoints tested on each face.
constexpr int ViewsPerFace = 4;

/// The additional viewpoints tested on faces where the error is largest, because one side of many
/// scenes shows nearly everything: at least this many, and this share of the field's.
constexpr int FurtherViews = 40;
constexpr int FurtherShare = 80;

/// The texels compared in each viewpoint.
constexpr int TexelsPerView = 1024;

/// The rings of key views that are asked besides the four around a viewpoint, with geometry.
constexpr int RingsWithGeometry = 1;

/// The viewpoints of a face that are not key views, each once. Any number of the first ones is
/// evenly spread.
class ViewSequence
{
public:
  ViewSequence(const Layout& grid, const KeyViews& keys, int face)
    : Grid(grid)
    , Keys(keys)
    , Face(face)
  {
  }

  /// The slice of the next one, or -1 at the end.
  int Next()
  {
    const int side = this->Grid.GetViewpoints();
    // This many tries include all viewpoints.
    for (const int end = this->Try + 16 * side * side; this->Try < end;)
    {
      ++this->Try;
      int place[2];
      for (int axis = 0; axis < 2; ++axis)
      {
        const double position = RobertsNumber(this->Try + this->Face * side, axis);
        place[axis] = std::min(side - 1, static_cast<int>(side * position));
      }
      const int slice = this->Grid.SliceOf({ this->Face, place[0], place[1] });
      if (!this->Keys.IsKey(slice) && this->Seen.insert(slice).second)
      {
        return slice;
      }
    }
    return -1;
  }

private:
  const Layout& Grid;
  const KeyViews& Keys;
  int Face;
  int Try = 0;
  std::set<int> Seen;
};

/// Mean square errors at each exposure.
using ExposureErrors = std::vector<double>;

/// The mean square errors of some viewpoints of a face.
struct FaceErrors
{
  std::vector<ExposureErrors> Errors;

  double GetMean(std::size_t exposure) const
  {
    double sum = 0.0;
    for (const ExposureErrors& errors : this->Errors)
    {
      sum += errors[exposure];
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, this->Errors.size()));
  }

  /// The error at the exposure where it is largest.
  double GetDeviation() const
  {
    double largest = 0.0;
    for (std::size_t k = 0; !this->Errors.empty() && k < this->Errors[0].size(); ++k)
    {
      const double mean = this->GetMean(k);
      double sum = 0.0;
      for (const ExposureErrors& errors : this->Errors)
      {
        sum += (errors[k] - mean) * (errors[k] - mean);
      }
      largest = std::max(largest, sum);
    }
    return std::sqrt(largest / static_cast<double>(std::max<std::size_t>(1, this->Errors.size())));
  }
};

/// The slices of the key views that surround a viewpoint, and of `rings` more around them.
std::vector<int> FindSurroundings(const Layout& keyGrid, int face, double u, double v, int rings)
{
  const int last = keyGrid.GetViewpoints() - 1;
  const NodeBracket columns = keyGrid.FindNodes(u);
  const NodeBracket rows = keyGrid.FindNodes(v);
  std::vector<int> slices;
  for (int j = std::max(0, rows.Lower - rings); j <= std::min(last, rows.Upper + rings); ++j)
  {
    for (int i = std::max(0, columns.Lower - rings); i <= std::min(last, columns.Upper + rings);
         ++i)
    {
      slices.push_back(keyGrid.SliceOf({ face, i, j }));
    }
  }
  return slices;
}

/// The colour of a texel over black, looked up from key views: with geometry, the mean of the light
/// of several rays.
glm::dvec4 LookUpTexel(
  const ShownRays& keys, const Description& field, bool hasGeometry, const RayCoordinates& center)
{
  if (!hasGeometry)
  {
    return keys.LookUp(center);
  }
  LightMean mean(field);
  const double texel = 2.0 / field.Grid.GetResolution();
  for (const glm::dvec2 place : { glm::dvec2(-0.25, -0.25), glm::dvec2(0.25, -0.25),
         glm::dvec2(-0.25, 0.25), glm::dvec2(0.25, 0.25) })
  {
    RayCoordinates ray = center;
    ray.Exit.Coordinates += texel * place;
    mean.Add(keys.LookUp(ray), 0.25);
  }
  return mean.GetColor();
}

/// The squared differences of red, green and blue as they are displayed.
double CompareDisplayed(
  const glm::dvec4& color, const ColorTexels& truth, std::size_t texel, double exposure)
{
  double squares = 0.0;
  for (int component = 0; component < 3; ++component)
  {
    const double shown = truth.AreFloats() ? LinearToSRGB(exposure * color[component])
                                           : std::clamp(color[component], 0.0, 1.0);
    const double difference =
      std::round(MaximumLevel * shown) - truth.GetShown(texel, component, exposure);
    squares += difference * difference;
  }
  return squares;
}

/// The mean square errors of some texels of a viewpoint, looked up from key views.
ExposureErrors Compare(const ShownRays& keys, const Description& whole, bool hasGeometry, int slice,
  const ColorTexels& truth)
{
  const Layout& grid = whole.Grid;
  const Viewpoint viewpoint = grid.ViewpointOf(slice);
  const int resolution = grid.GetResolution();
  const int width = grid.GetStripWidth();
  const TexelChoice texels(static_cast<std::uint64_t>(width) * resolution, TexelsPerView,
    static_cast<std::uint32_t>(slice));
  const std::vector<double> exposures = GetViewExposures(truth.AreFloats());
  std::vector<double> squares(texels.GetCount() * exposures.size());
  ParallelFor(0, static_cast<vtkIdType>(texels.GetCount()), 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        const int texel = static_cast<int>(texels[k]);
        const int x = texel % width;
        RayCoordinates ray;
        ray.Entry = { viewpoint.Face,
          { grid.NodeCoordinate(viewpoint.I), grid.NodeCoordinate(viewpoint.J) } };
        ray.Exit = { ExitFaceOf(viewpoint.Face, x / resolution),
          { grid.TexelCoordinate(x % resolution), grid.TexelCoordinate(texel / width) } };
        const glm::dvec4 color = LookUpTexel(keys, whole, hasGeometry, ray);
        for (std::size_t i = 0; i < exposures.size(); ++i)
        {
          squares[k * exposures.size() + i] = CompareDisplayed(color, truth, texel, exposures[i]);
        }
      }
    });
  ExposureErrors errors(exposures.size(), 0.0);
  for (std::size_t i = 0; i < squares.size(); ++i)
  {
    constexpr double components = 3.0;
    errors[i % exposures.size()] += squares[i] / (components * texels.GetCount());
  }
  return errors;
}

/// The mean square errors of a viewpoint of the whole field, looked up from key views. On failure
/// returns false and gives the reason.
bool MeasureView(ViewpointReader& input, const GeometryRays* surfaces, const KeyViews& keys,
  int view, ExposureErrors& errors, std::string& error)
{
  const Description whole = input.GetField();
  const Description field = keys.Apply(whole);
  const Viewpoint viewpoint = whole.Grid.ViewpointOf(view);
  const std::vector<int> around =
    FindSurroundings(field.Grid, viewpoint.Face, whole.Grid.NodeCoordinate(viewpoint.I),
      whole.Grid.NodeCoordinate(viewpoint.J), surfaces ? RingsWithGeometry : 0);
  std::vector<FrameId> frames;
  std::transform(around.begin(), around.end(), std::back_inserter(frames),
    [&keys](int slice) { return FrameId(keys.ToWhole(slice)); });
  frames.push_back(view);
  if (!input.Read(frames, error))
  {
    return false;
  }
  // All pulled slices are in the same arrays, one after the other.
  const std::vector<ViewpointSamples> pulled = input.GetSlices();
  vtkNew<vtkImageData> image;
  image->SetDimensions(
    whole.Grid.GetStripWidth(), whole.Grid.GetResolution(), static_cast<int>(around.size()));
  pulled.front().AddTo(image);
  errors = Compare(ShownRays(field, image, around, surfaces), whole, surfaces != nullptr, view,
    ColorTexels(pulled.back()));
  return true;
}

/// The mean error of the face and at the exposure where it is largest.
double FindLargestMean(const std::vector<FaceErrors>& faces)
{
  double largest = 0.0;
  for (const FaceErrors& face : faces)
  {
    const std::size_t exposures = face.Errors.empty() ? 0 : face.Errors[0].size();
    for (std::size_t k = 0; k < exposures; ++k)
    {
      largest = std::max(largest, face.GetMean(k));
    }
  }
  return largest;
}

/// The steps that keep different key views, ascending. Of equal ones, the smallest.
std::vector<int> ListSteps(int viewpoints)
{
  std::vector<int> steps;
  std::size_t kept = viewpoints;
  for (int step = 2; step < viewpoints; ++step)
  {
    const std::size_t count = KeyViews(viewpoints, step).GetIndices().size();
    if (count < kept)
    {
      steps.push_back(step);
      kept = count;
    }
  }
  return steps;
}

/// The PSNR of the viewpoints that a step of key views leaves out, see KeyViewChoice. On failure
/// returns false and gives the reason in one line.
bool MeasureHeldOutViews(ViewpointReader& input, const GeometryRays* surfaces, int step,
  const std::function<bool()>& proceed, double& psnr, std::string& error)
{
  const Layout grid = input.GetField().Grid;
  const KeyViews keys(grid.GetViewpoints(), step);
  std::vector<ViewSequence> sequences;
  std::vector<FaceErrors> faces(FaceCount);
  std::vector<double> deviations;
  const auto look = [&](int face, int count)
  {
    for (int view = 0; view < count; ++view)
    {
      if (!proceed())
      {
        error = Stopped;
        return false;
      }
      const int slice = sequences[face].Next();
      ExposureErrors errors;
      if (slice >= 0 && !MeasureView(input, surfaces, keys, slice, errors, error))
      {
        return false;
      }
      if (slice >= 0)
      {
        faces[face].Errors.push_back(errors);
      }
    }
    return true;
  };
  for (int face = 0; face < FaceCount; ++face)
  {
    sequences.emplace_back(grid, keys, face);
    if (!look(face, ViewsPerFace))
    {
      return false;
    }
    deviations.push_back(faces[face].GetDeviation());
  }
  const int further = std::max(FurtherViews, grid.GetSlices() / FurtherShare);
  const double all = std::accumulate(deviations.begin(), deviations.end(), 0.0);
  for (int face = 0; face < FaceCount; ++face)
  {
    const double share = all > 0.0 ? deviations[face] / all : 0.0;
    if (!look(face, static_cast<int>(std::lround(further * share))))
    {
      return false;
    }
  }
  psnr = PSNR(FindLargestMean(faces), MaximumLevel, MaximumPSNR);
  return true;
}
}

bool ChooseKeyViews(ViewpointReader& input, vtkPolyData* geometry, double goal,
  const std::function<bool()>& proceed, KeyViewChoice& choice, std::string& error)
{
  const Description field = input.GetField();
  std::optional<GeometryRays> surfaces;
  if (geometry && IsUsefulGeometry(geometry) && field.FindChannel(KnownChannel::Depth))
  {
    surfaces.emplace(geometry, field);
  }
  const std::vector<int> steps = ListSteps(field.Grid.GetViewpoints());
  KeyViewChoice best; // of steps that are not good enough
  choice = {};
  std::size_t good = 0; // the number of steps known to be good enough
  for (std::size_t bad = steps.size(); good < bad;)
  {
    const std::size_t middle = (good + bad) / 2;
    KeyViewChoice candidate{ steps[middle], 0.0 };
    if (!MeasureHeldOutViews(
          input, surfaces ? &*surfaces : nullptr, candidate.Step, proceed, candidate.PSNR, error))
    {
      return false;
    }
    const bool isGood = candidate.PSNR >= goal;
    (isGood ? choice : best) = candidate;
    (isGood ? good : bad) = isGood ? middle + 1 : middle;
  }
  if (choice.Step == 1)
  {
    std::ostringstream text;
    text << "no key views reach a PSNR of " << goal << " dB";
    if (best.Step > 1)
    {
      text << ": the best, with a step of " << best.Step << ", have " << best.PSNR << " dB";
    }
    error = text.str();
  }
  return choice.Step > 1;
}
}
