// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfChart.h"

#include "cslfMessages.h"
#include "cslfPictures.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorSeries.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

namespace cslf
{
namespace tool
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

void AddCurve(vtkChartXY* plots, const ChartCurve& curve, const vtkColor3ub& color)
{
  vtkNew<vtkTable> table;
  AddColumn(table, "x", curve.X);
  AddColumn(table, "y", curve.Y);
  vtkPlot* plot = plots->AddPlot(vtkChart::LINE);
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
  plots->GetAxis(vtkAxis::BOTTOM)->SetLogScale(true);
  vtkNew<vtkColorSeries> colors;
  colors->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_DARK2);
  int index = 0;
  for (const ChartCurve& curve : chart.Curves)
  {
    AddCurve(plots, curve, colors->GetColorRepeating(index));
    ++index;
  }
  plots->SetShowLegend(true);
  plots->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  plots->GetLegend()->SetVerticalAlignment(vtkChartLegend::BOTTOM);
  plots->GetLegend()->SetLabelSize(legendSize);

  view->GetRenderWindow()->Render();
  ThrowOnError();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(view->GetRenderWindow());
  grabber->SetInputBufferTypeToRGB();
  grabber->ReadFrontBufferOff();
  grabber->Update();
  ThrowOnError();
  WritePicture(fileName, grabber->GetOutput());
}
}
}
