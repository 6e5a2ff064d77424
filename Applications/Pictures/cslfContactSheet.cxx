// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfContactSheet.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>

namespace cslf::tool
{
namespace
{
constexpr int Gap = 4;
constexpr int LabelHeight = 22;
constexpr int FontSize = 14;

/// The text in white on black.
vtkSmartPointer<vtkImageData> DrawText(const std::string& text)
{
  vtkNew<vtkTextProperty> property;
  property->SetFontSize(FontSize);
  property->SetColor(1.0, 1.0, 1.0);
  constexpr int dotsPerInch = 72;
  int size[2];
  auto picture = vtkSmartPointer<vtkImageData>::New();
  vtkTextRenderer::GetInstance()->RenderString(
    property, text, picture, size, dotsPerInch, vtkTextRenderer::FreeType);
  return picture;
}

/// Copies the part of a picture that fits into the sheet, its lower left corner at (left, bottom).
/// A fourth component is alpha, over black.
void Paste(vtkImageData* picture, int left, int bottom, int mostWidth, vtkImageData* sheet)
{
  int extent[6];
  picture->GetExtent(extent);
  const int components = picture->GetNumberOfScalarComponents();
  const int width = std::min(mostWidth, extent[1] - extent[0] + 1);
  for (int y = 0; y <= extent[3] - extent[2]; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const auto* source = static_cast<const unsigned char*>(
        picture->GetScalarPointer(extent[0] + x, extent[2] + y, extent[4]));
      auto* target = static_cast<unsigned char*>(sheet->GetScalarPointer(left + x, bottom + y, 0));
      for (int k = 0; k < 3; ++k)
      {
        const int value = source[components < 3 ? 0 : k];
        target[k] = static_cast<unsigned char>(components == 4 ? value * source[3] / 255 : value);
      }
    }
  }
}
}

vtkSmartPointer<vtkImageData> MakeContactSheet(
  const std::vector<LabelledPicture>& pictures, int columns)
{
  int cellWidth = 0;
  int pictureHeight = 0;
  int labelHeight = 0;
  for (const LabelledPicture& item : pictures)
  {
    cellWidth = std::max(cellWidth, item.Picture->GetDimensions()[0]);
    pictureHeight = std::max(pictureHeight, item.Picture->GetDimensions()[1]);
    labelHeight = item.Label.empty() ? labelHeight : LabelHeight;
  }
  const int count = static_cast<int>(pictures.size());
  const int usedColumns = std::min(columns, count);
  const int rows = (count + columns - 1) / columns;
  const int cellHeight = pictureHeight + labelHeight;
  auto sheet = vtkSmartPointer<vtkImageData>::New();
  sheet->SetDimensions(usedColumns * (cellWidth + Gap) - Gap, rows * (cellHeight + Gap) - Gap, 1);
  sheet->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::fill_n(static_cast<unsigned char*>(sheet->GetScalarPointer()),
    3 * sheet->GetNumberOfPoints(), static_cast<unsigned char>(0));

  for (int index = 0; index < count; ++index)
  {
    const LabelledPicture& item = pictures[index];
    const int left = index % columns * (cellWidth + Gap);
    const int bottom = (rows - 1 - index / columns) * (cellHeight + Gap);
    Paste(item.Picture, left, bottom + labelHeight, cellWidth, sheet);
    if (!item.Label.empty())
    {
      const vtkSmartPointer<vtkImageData> text = DrawText(item.Label);
      Paste(text, left, bottom + std::max(0, (LabelHeight - text->GetDimensions()[1]) / 2),
        cellWidth, sheet);
    }
  }
  return sheet;
}
}
