// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pictures of several scenes on one sheet, with captions and a legend of differences.
 */
#ifndef cslfContactSheet_h
#define cslfContactSheet_h

#include <string>
#include <vector>

namespace cslf
{
namespace testing
{
/// Red, green and blue of a square, rows from the bottom up.
using SheetPicture = std::vector<unsigned char>;

/// One scene: its name and figures, one line each, above its pictures.
struct SheetCell
{
  std::string Name;
  std::string Figures;
  std::vector<SheetPicture> Pictures; ///< as many as there are titles
};

/// The colours of the difference between two pictures: white where they are equal, red where
/// `second` is brighter and blue where it is darker, in the component that differs most.
SheetPicture DrawDifference(const SheetPicture& first, const SheetPicture& second);

/// Writes a PNG file of cells in two columns, under the titles of their pictures, of `size` x
/// `size` pixels each. The legend of differences and up to four lines of notes are below. Returns
/// whether the file could be written.
bool WriteContactSheet(const std::string& fileName, const std::vector<std::string>& titles,
  const std::vector<SheetCell>& cells, const std::vector<std::string>& notes, int size);
}
}

#endif
