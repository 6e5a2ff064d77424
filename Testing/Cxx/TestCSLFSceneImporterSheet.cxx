// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares VTK's window with the bake for scenes of all kinds: prints figures for each, and with
// `--sheet FILE` draws the pictures on one sheet.
#include "cslfColor.h"
#include "cslfContactSheet.h"
#include "cslfSheetScenes.h"
#include "cslfTestWindow.h"
#include "cslfTesting.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCollectionRange.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using cslf::testing::Expectation;
using cslf::testing::SheetPicture;
using cslf::testing::SheetScene;

constexpr int Size = 102;
// Pixels of the window per pixel of the pictures, along each side.
constexpr int Finer = 3;
constexpr double Background = 0.8;
constexpr int BackgroundLevel = 204;

/// The size of the window's pixels, of a parallel projection, relative to the scene's diagonal.
double GetPixelSize(vtkRenderer* renderer)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  const double diagonal =
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  return 2.0 * renderer->GetActiveCamera()->GetParallelScale() / (Finer * Size) / diagonal;
}

/// The middle of the squares of Finer x Finer pixels.
SheetPicture Shrink(const SheetPicture& fine)
{
  SheetPicture picture(3 * Size * Size);
  for (int i = 0; i < 3 * Size * Size; ++i)
  {
    const int column = i / 3 % Size;
    const int row = i / 3 / Size;
    int sum = 0;
    for (int j = 0; j < Finer * Finer; ++j)
    {
      const int x = Finer * column + j % Finer;
      const int y = Finer * row + j / Finer;
      sum += fine[3 * (y * Finer * Size + x) + i % 3];
    }
    picture[i] = static_cast<unsigned char>((sum + Finer * Finer / 2) / (Finer * Finer));
  }
  return picture;
}

/// The expected traced colour if the window shows `ambient` for a surface without light, and `full`
/// for one that faces the light: the same, except that the cosine multiplies light.
SheetPicture ApplyCosine(
  const SheetPicture& window, const SheetPicture& ambient, const SheetPicture& full)
{
  SheetPicture expected(window.size());
  for (std::size_t i = 0; i < window.size(); ++i)
  {
    const double low = cslf::SRGBToLinear(ambient[i] / 255.0);
    const double high = cslf::SRGBToLinear(full[i] / 255.0);
    const double cosine = full[i] == ambient[i]
      ? 1.0
      : static_cast<double>(window[i] - ambient[i]) / (full[i] - ambient[i]);
    const double light = std::clamp(low + cosine * (high - low), 0.0, 1.0);
    expected[i] = static_cast<unsigned char>(255.0 * cslf::LinearToSRGB(light) + 0.5);
  }
  return expected;
}

/// How far a traced component lies outside of the range of the finer picture in and around the
/// pixel.
int GetOutside(const SheetPicture& fine, int traced, int component)
{
  const int column = component / 3 % Size;
  const int row = component / 3 / Size;
  int low = 255;
  int high = 0;
  for (int y = Finer * row - Finer; y < Finer * (row + 2); ++y)
  {
    for (int x = Finer * column - Finer; x < Finer * (column + 2); ++x)
    {
      const int inside = Finer * Size - 1;
      const int value =
        fine[3 * (std::clamp(y, 0, inside) * Finer * Size + std::clamp(x, 0, inside)) +
          component % 3];
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return std::max({ 0, low - traced, traced - high });
}

struct Figures
{
  double Median = 0.0;
  double Percentile99 = 0.0;
};

Figures Summarize(std::vector<int> values)
{
  std::sort(values.begin(), values.end());
  Figures figures;
  if (!values.empty())
  {
    figures.Median = values[values.size() / 2];
    figures.Percentile99 = values[99 * values.size() / 100];
  }
  return figures;
}

/// Calls `get(component)` for the pixels where something is shown, and takes the largest value of
/// each pixel.
template <typename Get>
Figures Measure(const SheetPicture& window, const SheetPicture& bake, const Get& get)
{
  std::vector<int> values;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    int largest = 0;
    bool isShown = false;
    for (int i = 3 * pixel; i < 3 * pixel + 3; ++i)
    {
      isShown = isShown || window[i] != BackgroundLevel || bake[i] != BackgroundLevel;
      largest = std::max(largest, get(i));
    }
    if (isShown)
    {
      values.push_back(largest);
    }
  }
  return Summarize(values);
}

/// Draws the window after a temporary change to the actors' properties.
template <typename Change>
SheetPicture DrawChanged(vtkRenderer* renderer, const Change& change)
{
  std::vector<vtkSmartPointer<vtkProperty>> properties;
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    properties.emplace_back(actor->GetProperty());
    vtkNew<vtkProperty> changed;
    changed->DeepCopy(actor->GetProperty());
    change(changed);
    actor->SetProperty(changed);
  }
  SheetPicture picture = cslf::testing::DrawWindow(renderer, Finer * Size, Background);
  std::size_t next = 0;
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    actor->SetProperty(properties[next++]);
  }
  return picture;
}

SheetPicture Expect(vtkRenderer* renderer, const SheetPicture& window)
{
  const SheetPicture full =
    DrawChanged(renderer, [](vtkProperty* property) { property->LightingOff(); });
  const SheetPicture ambient =
    DrawChanged(renderer, [](vtkProperty* property) { property->SetDiffuse(0.0); });
  return ApplyCosine(window, ambient, full);
}

std::string Print(const Figures& figures)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.0f (99 %%: %.0f)", figures.Median, figures.Percentile99);
  return text;
}

cslf::testing::SheetCell Compare(const SheetScene& scene, bool draws)
{
  vtkNew<vtkRenderer> renderer;
  scene.Build(renderer);
  const SheetPicture fine = cslf::testing::DrawWindow(renderer, Finer * Size, Background);
  cslf::testing::BakeOptions options;
  options.Background = Background;
  options.PixelSize = GetPixelSize(renderer);
  options.PointRadius = scene.PointRadius;
  options.Samples = 144;
  cslf::testing::SheetCell cell;
  cell.Name = scene.Name;
  const SheetPicture window = Shrink(fine);
  const SheetPicture bake = cslf::testing::TraceBake(renderer, Size, options);
  const Figures whole = Measure(window, bake, [&](int i) { return std::abs(window[i] - bake[i]); });
  cell.Figures = "differs by " + Print(whole);
  if (scene.Expected != Expectation::Bounds)
  {
    SheetPicture expected = fine;
    if (scene.Expected == Expectation::Cosine)
    {
      expected = Expect(renderer, fine);
    }
    const Figures rest =
      Measure(window, bake, [&](int i) { return GetOutside(expected, bake[i], i); });
    cell.Figures += ", unexplained " + Print(rest);
    CSLF_CHECK(rest.Percentile99 <= scene.Unexplained);
  }
  std::cout << cell.Name << ": " << cell.Figures << "\n";
  CSLF_CHECK(whole.Median <= scene.Median && whole.Percentile99 <= scene.Percentile);
  if (draws)
  {
    options.HeadlightsAllAround = true;
    options.MaximumDepth = 8;
    options.Samples = 256;
    cell.Pictures = { window, bake, cslf::testing::DrawDifference(window, bake),
      cslf::testing::TraceBake(renderer, Size, options) };
  }
  return cell;
}
}

int TestCSLFSceneImporterSheet(int argc, char* argv[])
{
  std::string fileName;
  for (int i = 1; i + 1 < argc; ++i)
  {
    fileName = std::string(argv[i]) == "--sheet" ? argv[i + 1] : fileName;
  }
  std::vector<cslf::testing::SheetCell> cells;
  for (const SheetScene& scene : cslf::testing::MakeSheetScenes())
  {
    cells.push_back(Compare(scene, !fileName.empty()));
  }
  if (!fileName.empty())
  {
    CSLF_CHECK(cslf::testing::WriteContactSheet(fileName,
      { "window", "baked", "difference", "default bake" }, cells,
      { "Figures: the median pixel's difference, and that of 99 %.",
        "Unexplained: what is left when the cosine to the light",
        "multiplies light, in place of displayed colours.",
        "Default bake: headlights all around, light bounces." },
      Size));
  }
  return cslf::testing::Result();
}
