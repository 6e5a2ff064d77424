// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours in which a field's scalars are drawn, and the bar that tells what they mean.
 */
#ifndef cslfFieldColors_h
#define cslfFieldColors_h

#include "Fields/cslfFieldScalars.h"
#include "Options/cslfColorOptions.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}

class vtkCSLFMapper;
class vtkProp;
class vtkScalarBarActor;

namespace cslf::tool
{
struct FieldFile;

/// What the command line says of a field's scalars.
struct FieldColorOptions
{
  ColorOptions Colors;
  bool HasBar = false;

  /// Adds --color-by, --color-map, --range and --scalar-bar.
  void AddTo(CLI::App& command);

  /// Adds --color-by, --color-map and --range.
  void AddColorsTo(CLI::App& command);

  /// Adds --scalar-bar.
  CLI::Option* AddBarTo(CLI::App& command);

  bool IsEmpty() const { return this->Colors.IsEmpty() && !this->HasBar; }
};

/// The colours of a field's scalars. Without options, they are those of the field.
class FieldColors
{
public:
  FieldColors() = default;

  /// Reads the field's geometry. Throws a Failure if it does not have what the options name.
  FieldColors(const FieldColorOptions& options, const FieldFile& file);

  /// What a scalar bar tells of: the array that is chosen, or the first. Empty if there is none.
  const std::string& GetTitle() const { return this->Title; }

  /// Makes a mapper show them with the lookup geometry.
  void Apply(vtkCSLFMapper* mapper) const;

private:
  void Choose(const std::vector<FieldScalars>& scalars);

  ColorOptions Options;
  FieldScalars Shown; ///< the first of those that are chosen
  std::string Title;
  bool HidesScalars = false;
  bool HasNoMap = false; ///< whether the field has no colour map of its own
};

/// Draws the colour map of a mapper at the right side of a picture.
class ScalarBar
{
public:
  /// The mapper must have the field and the colours.
  ScalarBar(vtkCSLFMapper* mapper, const std::string& title);
  ~ScalarBar();

  vtkProp* GetProp();

  /// Chooses sizes for a picture of so many pixels, without the lowest rows, and black or white
  /// texts that contrast with the background, which lies between them and the scene.
  void Fit(int width, int height, const double background[3], int lowest = 0);

private:
  void SetFonts(int size, const double background[3]);
  int MeasureLabels() const;

  vtkNew<vtkScalarBarActor> Bar;
};
}

#endif
