// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfContactSheet.h"

#include <vtkActor2D.h>
#include <vtkColorTransferFunction.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace cslf
{
namespace testing
{
namespace
{
// The difference, in levels of 255, where the colour scale ends: differences are amplified 4 times.
constexpr double MaximumLevel = 64.0;

// Sizes in pixels.
constexpr int Gap = 4;
constexpr int Margin = 12;
constexpr int LineHeight = 16;
constexpr int FontSize = 13;
constexpr int LegendHeight = 64;
constexpr int Columns = 2;

vtkSmartPointer<vtkColorTransferFunction> MakeDifferenceColors()
{
  auto colors = vtkSmartPointer<vtkColorTransferFunction>::New();
  colors->AddRGBPoint(-MaximumLevel, 0.05, 0.15, 0.6);
  colors->AddRGBPoint(-0.5 * MaximumLevel, 0.35, 0.55, 0.95);
  colors->AddRGBPoint(0.0, 1.0, 1.0, 1.0);
  colors->AddRGBPoint(0.5 * MaximumLevel, 0.95, 0.5, 0.3);
  colors->AddRGBPoint(MaximumLevel, 0.6, 0.05, 0.05);
  return colors;
}

/// A window with coordinates in pixels from the upper left corner.
class Sheet
{
public:
  Sheet(int width, int height)
    : Height(height)
  {
    this->Renderer->SetBackground(1.0, 1.0, 1.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Window->AddRenderer(this->Renderer);
  }

  void AddPicture(const SheetPicture& picture, int size, int left, int top)
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(size, size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    // Invisible steps of 4 levels, which save a quarter of the file's size.
    std::transform(picture.begin(), picture.end(),
      static_cast<unsigned char*>(image->GetScalarPointer()),
      [](unsigned char level)
      { return static_cast<unsigned char>(std::min(level / 4 * 4 + 2, 255)); });
    vtkNew<vtkImageMapper> mapper;
    mapper->SetInputData(image);
    mapper->SetColorWindow(255.0);
    mapper->SetColorLevel(127.5);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(left, this->Height - top - size);
    this->Renderer->AddViewProp(actor);
  }

  void AddText(const std::string& text, int left, int top, bool bold = false)
  {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    actor->SetPosition(left, this->Height - top);
    vtkTextProperty* style = actor->GetTextProperty();
    style->SetFontSize(FontSize);
    style->SetBold(bold);
    style->SetColor(0.1, 0.1, 0.1);
    style->SetVerticalJustificationToTop();
    this->Renderer->AddViewProp(actor);
  }

  void AddLegend(int left, int top, int width)
  {
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(MakeDifferenceColors());
    bar->SetOrientationToHorizontal();
    bar->SetNumberOfLabels(5);
    bar->SetLabelFormat("%.0f");
    bar->UnconstrainedFontSizeOn();
    bar->GetLabelTextProperty()->SetFontSize(FontSize);
    bar->GetLabelTextProperty()->SetColor(0.1, 0.1, 0.1);
    bar->GetLabelTextProperty()->SetBold(0);
    bar->GetLabelTextProperty()->SetItalic(0);
    bar->GetLabelTextProperty()->SetShadow(0);
    bar->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
    bar->GetPositionCoordinate()->SetValue(left, this->Height - top - LegendHeight / 2);
    bar->GetPosition2Coordinate()->SetCoordinateSystemToDisplay();
    bar->GetPosition2Coordinate()->SetValue(width, LegendHeight / 2);
    this->Renderer->AddViewProp(bar);
  }

  bool Write(const std::string& fileName)
  {
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(this->Window);
    picture->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(picture->GetOutputPort());
    writer->SetFileName(fileName.c_str());
    writer->SetCompressionLevel(9);
    writer->Write();
    return writer->GetErrorCode() == vtkErrorCode::NoError;
  }

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  int Height;
};
}

SheetPicture DrawDifference(const SheetPicture& first, const SheetPicture& second)
{
  const vtkSmartPointer<vtkColorTransferFunction> colors = MakeDifferenceColors();
  SheetPicture picture;
  for (std::size_t i = 0; i + 3 <= std::min(first.size(), second.size()); i += 3)
  {
    int largest = 0;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      const int difference = second[c] - first[c];
      largest = std::abs(difference) > std::abs(largest) ? difference : largest;
    }
    const unsigned char* color = colors->MapValue(largest);
    picture.insert(picture.end(), color, color + 3);
  }
  return picture;
}

bool WriteContactSheet(const std::string& fileName, const std::vector<std::string>& titles,
  const std::vector<SheetCell>& cells, const std::vector<std::string>& notes, int size)
{
  const int cellWidth = static_cast<int>(titles.size()) * (size + Gap) + Margin;
  const int cellHeight = size + 2 * LineHeight + Margin;
  const int rows = (static_cast<int>(cells.size()) + Columns - 1) / Columns;
  const int top = Margin + LineHeight + Gap;
  Sheet sheet(Columns * cellWidth + Margin, top + rows * cellHeight + LegendHeight + LineHeight);
  for (int column = 0; column < Columns; ++column)
  {
    for (std::size_t i = 0; i < titles.size(); ++i)
    {
      const int left = Margin + column * cellWidth + static_cast<int>(i) * (size + Gap);
      sheet.AddText(titles[i], left, Margin, true);
    }
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const int left = Margin + static_cast<int>(cell % Columns) * cellWidth;
    const int y = top + static_cast<int>(cell / Columns) * cellHeight;
    sheet.AddText(cells[cell].Name, left, y, true);
    sheet.AddText(cells[cell].Figures, left, y + LineHeight);
    for (std::size_t i = 0; i < cells[cell].Pictures.size(); ++i)
    {
      sheet.AddPicture(cells[cell].Pictures[i], size, left + static_cast<int>(i) * (size + Gap),
        y + 2 * LineHeight);
    }
  }
  const int bottom = top + rows * cellHeight;
  sheet.AddText("Difference in levels of 255; red: the bake is brighter", Margin, bottom);
  sheet.AddLegend(2 * Margin, bottom + LineHeight, 2 * cellWidth / 3);
  int line = bottom;
  for (const std::string& text : notes)
  {
    sheet.AddText(text, Margin + cellWidth, line);
    line += LineHeight;
  }
  return sheet.Write(fileName);
}
}
}
