// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfChart.h"

#include "Console/cslfMessages.h"
#include "Pictures/cslfPictures.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorSeries.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace cslf::tool
{
namespace
{
constexpr int Width = 960;
constexpr int Height = 640;

void AddColumn(vtkTable* table, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  for (const double value : values)
  {
    column->InsertNextValue(value);
  }
  table->AddColumn(column);
}

void AddCurve(
  vtkChartXY* plots, const ChartCurve& curve, ChartScale scale, const vtkColor3ub& color)
{
  vtkNew<vtkTable> table;
  std::vector<double> places = curve.X;
  if (scale == ChartScale::Bytes)
  {
    std::transform(
      places.begin(), places.end(), places.begin(), [](double x) { return std::log10(x); });
  }
  AddColumn(table, "x", places);
  AddColumn(table, "y", curve.Y);
  // VTK cannot draw a line through one point.
  vtkPlot* plot = plots->AddPlot(curve.X.size() > 1 ? vtkChart::LINE : vtkChart::POINTS);
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(curve.Name);
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetWidth(2.0F);
  if (auto* points = vtkPlotPoints::SafeDownCast(plot))
  {
    points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    points->SetMarkerSize(8.0F);
  }
}

/// A number of bytes with at most two digits and a unit.
std::string ToText(double bytes)
{
  const char* const units[] = { "", " kB", " MB", " GB", " TB" };
  int unit = 0;
  for (; bytes >= 999.5 && unit < 4; ++unit)
  {
    bytes /= 1000.0;
  }
  std::ostringstream text;
  text << std::lround(bytes) << units[unit];
  return text.str();
}

double FindMaximum(const std::vector<ChartCurve>& curves)
{
  double most = 0.0;
  for (const ChartCurve& curve : curves)
  {
    for (const double x : curve.X)
    {
      most = std::max(most, x);
    }
  }
  return most;
}

/// Begins an axis at 0, and ends it so that there is space for the legend.
void FitLinear(vtkAxis* axis, const std::vector<ChartCurve>& curves)
{
  constexpr double room = 1.25;
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(0.0, room * std::max(FindMaximum(curves), 1.0));
}

/// Marks an axis of decimal logarithms with round numbers: the fewest of a decade's 1 to 9 that
/// give several marks. VTK's own logarithmic axis marks powers of ten only.
void MarkLogarithms(vtkAxis* axis, const std::vector<ChartCurve>& curves)
{
  double least = std::numeric_limits<double>::max();
  const double most = FindMaximum(curves);
  for (const ChartCurve& curve : curves)
  {
    for (const double x : curve.X)
    {
      least = std::min(least, x);
    }
  }
  constexpr double margin = 1.05;
  constexpr int enough = 4;
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(std::log10(least / margin), std::log10(most * margin));
  vtkNew<vtkDoubleArray> places;
  vtkNew<vtkStringArray> labels;
  const std::vector<std::vector<int>> choices = { { 1 }, { 1, 3 }, { 1, 2, 5 },
    { 1, 2, 3, 4, 5, 6, 7, 8, 9 } };
  for (const std::vector<int>& digits : choices)
  {
    places->Reset();
    labels->Reset();
    for (int power = 0; power < 16; ++power)
    {
      for (const int digit : digits)
      {
        const double bytes = digit * std::pow(10.0, power);
        if (bytes >= least / margin && bytes <= most * margin)
        {
          places->InsertNextValue(std::log10(bytes));
          labels->InsertNextValue(ToText(bytes));
        }
      }
    }
    if (places->GetNumberOfValues() >= enough)
    {
      break;
    }
  }
  axis->SetCustomTickPositions(places, labels);
}

void SetAxis(vtkAxis* axis, const std::string& title)
{
  constexpr int titleSize = 16;
  constexpr int labelSize = 14;
  axis->SetTitle(title);
  axis->GetTitleProperties()->SetFontSize(titleSize);
  axis->GetLabelProperties()->SetFontSize(labelSize);
}
}

void WriteChart(const std::string& fileName, const Chart& chart)
{
  constexpr int titleSize = 18;
  constexpr int legendSize = 14;
  vtkNew<vtkContextView> view;
  view->GetRenderWindow()->SetOffScreenRendering(1);
  view->GetRenderWindow()->SetMultiSamples(0);
  view->GetRenderWindow()->SetSize(Width, Height);
  view->GetRenderer()->SetBackground(1.0, 1.0, 1.0);
  vtkNew<vtkChartXY> plots;
  view->GetScene()->AddItem(plots);
  plots->SetTitle(chart.Title);
  plots->GetTitleProperties()->SetFontSize(titleSize);
  SetAxis(plots->GetAxis(vtkAxis::BOTTOM), chart.XTitle);
  SetAxis(plots->GetAxis(vtkAxis::LEFT), chart.YTitle);
  if (chart.Scale == ChartScale::Bytes)
  {
    MarkLogarithms(plots->GetAxis(vtkAxis::BOTTOM), chart.Curves);
  }
  else
  {
    FitLinear(plots->GetAxis(vtkAxis::BOTTOM), chart.Curves);
  }
  vtkNew<vtkColorSeries> colors;
  colors->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_DARK2);
  int index = 0;
  for (const ChartCurve& curve : chart.Curves)
  {
    AddCurve(plots, curve, chart.Scale, colors->GetColorRepeating(index));
    ++index;
  }
  plots->SetShowLegend(true);
  plots->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  plots->GetLegend()->SetVerticalAlignment(vtkChartLegend::BOTTOM);
  plots->GetLegend()->SetLabelSize(legendSize);

  view->GetRenderWindow()->Render();
  ThrowOnError();
  WritePicture(fileName, GrabPicture(view->GetRenderWindow()));
}
}
