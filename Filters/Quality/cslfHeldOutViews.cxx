// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Quality/cslfHeldOutViews.h"

#include "Quality/cslfPSNR.h"
#include "Quality/cslfTexelChoice.h"
#include "cslfLookup.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <sstream>

namespace cslf
{
namespace
{
constexpr std::uint32_t Seed = 20210831;

/// Each face is divided into so many squares along a side; of each, one viewpoint is looked at.
constexpr int Squares = 3;
constexpr int Attempts = 16;

/// The texels compared of each viewpoint.
constexpr int TexelsPerView = 512;

constexpr double Peak = 255.0;
constexpr double MostPSNR = 100.0;

/// One viewpoint of each square of each face, where one can be found that is no key view.
std::vector<int> ChooseViews(const Layout& grid, const KeyViews& keys)
{
  const int side = grid.GetViewpoints();
  const int squares = std::min(Squares, side);
  std::vector<int> chosen;
  for (int square = 0; square < FaceCount * squares * squares; ++square)
  {
    const int column = square % squares;
    const int row = square / squares % squares;
    const auto pick = [&](int part, std::uint64_t random)
    {
      const int begin = part * side / squares;
      const int end = (part + 1) * side / squares;
      return begin + static_cast<int>(random % static_cast<std::uint64_t>(end - begin));
    };
    for (int attempt = 0; attempt < Attempts; ++attempt)
    {
      const std::uint64_t random = MixBits(MixBits(Seed, square), 2 * attempt);
      const std::uint64_t other = MixBits(MixBits(Seed, square), 2 * attempt + 1);
      const int slice =
        grid.SliceOf({ square / (squares * squares), pick(column, random), pick(row, other) });
      if (!keys.IsKey(slice))
      {
        chosen.push_back(slice);
        break;
      }
    }
  }
  return chosen;
}

/// The slices, of the key views, that surround a viewpoint.
std::vector<int> FindSurroundings(const Layout& keyGrid, int face, double u, double v)
{
  const NodeBracket i = keyGrid.FindNodes(u);
  const NodeBracket j = keyGrid.FindNodes(v);
  std::vector<int> slices;
  for (const Viewpoint& viewpoint : { Viewpoint{ face, i.Lower, j.Lower },
         Viewpoint{ face, i.Upper, j.Lower }, Viewpoint{ face, i.Lower, j.Upper },
         Viewpoint{ face, i.Upper, j.Upper } })
  {
    slices.push_back(keyGrid.SliceOf(viewpoint));
  }
  return slices;
}

/// Image data of some slices, which the arrays do not own.
template <typename Array, typename Value>
void AddArray(vtkImageData* image, const char* name, int components, const Value* values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<Value*>(values), components * image->GetNumberOfPoints(), 1);
  image->GetPointData()->AddArray(array);
}

/// The sum of squared errors of some texels of a viewpoint, looked up from key views.
double Compare(const Lookup& lookup, const Layout& grid, int slice, const unsigned char* truth)
{
  const Viewpoint viewpoint = grid.ViewpointOf(slice);
  const int resolution = grid.GetResolution();
  const int width = grid.GetStripWidth();
  const TexelChoice texels(
    static_cast<std::uint64_t>(width) * resolution, TexelsPerView, static_cast<std::uint32_t>(slice));
  std::vector<double> squares(texels.GetCount());
  vtkSMPTools::For(0, static_cast<vtkIdType>(squares.size()),
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
        const glm::dvec4 color = lookup.DepthCorrected(ray).Color;
        for (int component = 0; component < 3; ++component)
        {
          const double found = std::round(Peak * std::clamp(color[component], 0.0, 1.0));
          squares[k] += std::pow(found - truth[4 * texel + component], 2);
        }
      }
    });
  return std::accumulate(squares.begin(), squares.end(), 0.0) / squares.size();
}

/// The steps that keep different key views, ascending, the smallest of each.
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
}

bool MeasureHeldOutViews(SlicePuller& puller, int step, double& psnr, std::string& error)
{
  const Description whole = puller.GetField();
  const KeyViews keys(whole.Grid.GetViewpoints(), step);
  const Description field = keys.Apply(whole);
  double sum = 0.0;
  const std::vector<int> views = ChooseViews(whole.Grid, keys);
  for (int view : views)
  {
    const Viewpoint viewpoint = whole.Grid.ViewpointOf(view);
    const std::vector<int> around = FindSurroundings(field.Grid, viewpoint.Face,
      whole.Grid.NodeCoordinate(viewpoint.I), whole.Grid.NodeCoordinate(viewpoint.J));
    std::vector<int> slices;
    std::transform(around.begin(), around.end(), std::back_inserter(slices),
      [&keys](int slice) { return keys.ToWhole(slice); });
    slices.push_back(view);
    if (!puller.Pull(slices, error))
    {
      return false;
    }
    // What was pulled lies in one piece.
    const std::vector<ConstSlice> pulled = puller.GetSlices();
    vtkNew<vtkImageData> image;
    image->SetDimensions(whole.Grid.GetStripWidth(), whole.Grid.GetResolution(),
      static_cast<int>(around.size()));
    AddArray<vtkUnsignedCharArray>(image, ColorName, 4, pulled.front().Color);
    if (pulled.front().Depth)
    {
      AddArray<vtkUnsignedShortArray>(image, DepthName, 1, pulled.front().Depth);
    }
    sum += Compare(Lookup(field, image, around), whole.Grid, view, pulled.back().Color);
  }
  psnr = PSNR(sum / (3.0 * std::max<std::size_t>(views.size(), 1)), Peak, MostPSNR);
  return true;
}

bool ChooseKeyViews(SlicePuller& puller, double goal, const std::function<bool()>& proceed,
  KeyViewChoice& choice, std::string& error)
{
  const std::vector<int> steps = ListSteps(puller.GetField().Grid.GetViewpoints());
  KeyViewChoice best; // of those that are not good enough
  choice = {};
  std::size_t good = 0; // so many steps are good enough
  for (std::size_t bad = steps.size(); good < bad;)
  {
    const std::size_t middle = (good + bad) / 2;
    KeyViewChoice candidate{ steps[middle], 0.0 };
    if (!proceed())
    {
      error = "it was stopped";
      return false;
    }
    if (!MeasureHeldOutViews(puller, candidate.Step, candidate.PSNR, error))
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
