// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldColors.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "cslfColor.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSceneLook.h"

#include <vtkLookupTable.h>
#include <vtkProperty2D.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <CLI/CLI.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace cslf::tool
{
namespace
{
///@{
/// The bar, as shares of the picture's height, and in sizes of the font.
constexpr double BarBottom = 0.1;
constexpr double BarTop = 0.9;
constexpr double BarThickness = 1.4;
constexpr double BarMargin = 0.8; ///< between it and the picture's edge
constexpr double TitleGap = 0.6;  ///< above the uppermost label
///@}

///@{
/// The font, in pixels: this share of the picture's smaller side, but readable.
constexpr double FontShare = 1.0 / 26.0;
constexpr int MinimumFont = 10;
constexpr int MaximumFont = 64;
///@}

/// How much the background hides of the scene behind the bar.
constexpr double BackgroundOpacity = 0.6;

/// The largest share of the picture's width that a long title takes.
constexpr double MaximumTitle = 0.5;

constexpr const char* ColorGroup = "Colours of a field's scalars";

constexpr int LabelCount = 5;
constexpr int ColorCount = 512;
constexpr int LabelDigits = 4;

/// The resolution of text on a screen, as in render windows.
constexpr int DotsPerInch = 72;

int MeasureText(vtkTextProperty* font, const std::string& text)
{
  std::array<int, 4> box{};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  return renderer && renderer->GetBoundingBox(font, text, box.data(), DotsPerInch)
    ? box[1] - box[0] + 1
    : 0;
}

/// Enough digits to tell the labels of a range from each other. The space parts them from the bar,
/// because padding also moves them along it.
std::string MakeLabelFormat(const double range[2])
{
  const double largest = std::max(std::abs(range[0]), std::abs(range[1]));
  const int lost = static_cast<int>(std::log10(largest / (range[1] - range[0])));
  return " %." + std::to_string(std::clamp(LabelDigits + lost, LabelDigits, 15)) + "g";
}

bool IsBright(const double color[3])
{
  const glm::dvec3 linear = SRGBToLinear(glm::dvec3(color[0], color[1], color[2]));
  constexpr double middle = 0.18; // as different from black as from white
  return glm::dot(LuminanceWeights, linear) > middle;
}
}

void FieldColorOptions::AddTo(CLI::App& command)
{
  this->AddColorsTo(command);
  this->AddBarTo(command)->group(ColorGroup);
}

void FieldColorOptions::AddColorsTo(CLI::App& command)
{
  this->Colors.AddTo(command, ColorGroup,
    { "all that the field has", "the colours of an array's values; automatic: those of the field",
      "the range of the field's colour map" });
}

CLI::Option* FieldColorOptions::AddBarTo(CLI::App& command)
{
  return command.add_flag(
    "--scalar-bar", this->HasBar, "draw a bar with the colours and values of the field's scalars");
}

FieldColors::FieldColors(const FieldColorOptions& options, const FieldFile& file)
  : Options(options.Colors)
{
  const std::vector<FieldScalars> scalars = ListScalars(file);
  if (!scalars.empty())
  {
    this->Choose(scalars);
  }
  else if (!options.IsEmpty())
  {
    throw Failure("The field has no scalars, which those of scenes with a colour map have: cslf "
                  "info lists them.");
  }
  if (options.HasBar && this->Title.empty())
  {
    throw Failure("A scalar bar needs an array: --color-by must not be none.");
  }
}

void FieldColors::Choose(const std::vector<FieldScalars>& scalars)
{
  const std::string& name = this->Options.Array;
  this->HasNoMap = std::none_of(
    scalars.begin(), scalars.end(), [](const FieldScalars& each) { return each.HasMap; });
  const auto found = std::find_if(scalars.begin(), scalars.end(),
    [&](const FieldScalars& each) { return name.empty() || each.IsMeantBy(name); });
  if (found != scalars.end())
  {
    this->Shown = *found;
    this->Title = found->GetLabel();
  }
  else if (name == NoArray)
  {
    this->HidesScalars = true;
  }
  else
  {
    throw Failure(
      "There is no array " + name + " to colour by: the field has " + ListLabels(scalars) + ".");
  }
  this->Options.CheckRange();
  const std::vector<double>& range = this->Options.Range;
  if (this->Shown.IsLogarithmic && !range.empty() && range[0] <= 0.0)
  {
    throw Failure("The colour map of " + this->Title + " is logarithmic: --range must be above 0.");
  }
}

void FieldColors::Apply(vtkCSLFMapper* mapper) const
{
  mapper->SetScalarVisibility(!this->HidesScalars);
  if (!this->Options.Array.empty())
  {
    // An array's name alone means all its components.
    const bool isWhole = this->Options.Array == this->Shown.Array && this->Shown.HasMap;
    mapper->SelectColorArray((isWhole ? this->Shown.Array : this->Shown.ScalarName).c_str());
  }
  std::array<double, 2> range = this->Shown.MapRange;
  if (!this->Options.Range.empty())
  {
    std::copy_n(this->Options.Range.begin(), 2, range.begin());
    mapper->SetScalarRange(range.data());
  }
  if (this->Options.HasMap() || this->HasNoMap)
  {
    vtkNew<vtkLookupTable> table;
    vtkCSLFSceneLook::SetUpLookupTable(this->Options.Map, table);
    table->SetTableRange(range.data()); // before a scale that does not allow the default
    table->SetScale(this->Shown.IsLogarithmic ? VTK_SCALE_LOG10 : VTK_SCALE_LINEAR);
    mapper->SetLookupTable(table);
  }
}

ScalarBar::ScalarBar(vtkCSLFMapper* mapper, const std::string& title)
{
  vtkScalarsToColors* table = mapper->GetLookupTable();
  this->Bar->SetLookupTable(table);
  this->Bar->SetTitle(title.c_str());
  this->Bar->SetNumberOfLabels(LabelCount);
  this->Bar->SetMaximumNumberOfColors(ColorCount);
  this->Bar->SetLabelFormat(MakeLabelFormat(table->GetRange()).c_str());
  this->Bar->UnconstrainedFontSizeOn();
  this->Bar->DrawBackgroundOn();
  this->Bar->GetBackgroundProperty()->SetOpacity(BackgroundOpacity);
  this->Bar->SetPickable(false);
}

ScalarBar::~ScalarBar() = default;

vtkProp* ScalarBar::GetProp()
{
  return this->Bar;
}

void ScalarBar::Fit(int width, int height, const double background[3], int lowest)
{
  const int size = static_cast<int>(FontShare * std::min(width, height));
  this->SetFonts(std::clamp(size, MinimumFont, MaximumFont), background);
  vtkTextProperty* titleFont = this->Bar->GetTitleTextProperty();
  const int font = titleFont->GetFontSize();
  int title = MeasureText(titleFont, this->Bar->GetTitle());
  if (title > MaximumTitle * width)
  {
    titleFont->SetFontSize(std::max(MinimumFont, int(font * MaximumTitle * width / title)));
    title = MeasureText(titleFont, this->Bar->GetTitle());
  }
  const double thickness = BarThickness * font;
  const double needed = std::max<double>(title, thickness + this->MeasureLabels());
  this->Bar->SetBarRatio(thickness / needed);
  this->Bar->SetVerticalTitleSeparation(static_cast<int>(TitleGap * font));
  const double bottom =
    std::clamp((lowest + BarMargin * font) / height, BarBottom, 0.5 * (BarBottom + BarTop));
  this->Bar->SetPosition(1.0 - (needed + BarMargin * font) / width, bottom);
  this->Bar->SetWidth(needed / width);
  this->Bar->SetHeight(BarTop - bottom);
}

void ScalarBar::SetFonts(int size, const double background[3])
{
  this->Bar->GetBackgroundProperty()->SetColor(background[0], background[1], background[2]);
  const double level = IsBright(background) ? 0.0 : 1.0;
  for (vtkTextProperty* font :
    { this->Bar->GetTitleTextProperty(), this->Bar->GetLabelTextProperty() })
  {
    font->SetFontSize(size);
    font->SetColor(level, level, level);
    font->BoldOff();
    font->ItalicOff();
    font->ShadowOff();
  }
}

/// The width of the widest label, in pixels.
int ScalarBar::MeasureLabels() const
{
  vtkScalarsToColors* table = this->Bar->GetLookupTable();
  const double* range = table->GetRange();
  const std::string format = MakeLabelFormat(range);
  int widest = 0;
  for (int i = 0; i < LabelCount; ++i)
  {
    const double part = i / (LabelCount - 1.0);
    const double value = table->UsingLogScale() ? range[0] * std::pow(range[1] / range[0], part)
                                                : range[0] + part * (range[1] - range[0]);
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format.c_str(), value);
    widest = std::max(widest, MeasureText(this->Bar->GetLabelTextProperty(), text.data()));
  }
  return widest;
}
}
