// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Pulling a light field of byte or float colours and 16-bit depth through the pipeline in an order
 * of one's own.
 */
#ifndef cslfSlicePuller_h
#define cslfSlicePuller_h

#include "Coding/cslfFrameConverter.h"
#include "Resampling/cslfKeyViews.h"
#include "cslfDescription.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkImageData;
class vtkInformation;

namespace cslf
{
/// The grid of viewpoints and texels that the whole extent of that pipeline information stands for,
/// if it is a whole light field's.
std::optional<Layout> FindGrid(vtkInformation* information);

class SlicePuller
{
public:
  /// Pulls from the connection of that pipeline information, whose whole extent is `grid`'s.
  SlicePuller(vtkInformation* information, const Layout& grid);

  /// From now on, fields and slices are those of the key views only. All are key views at first.
  void SetKeyViewStep(int step) { this->Keys = KeyViews(this->Grid.GetViewpoints(), step); }

  /// Reads the description of what the input holds already. On failure returns false and says why,
  /// in a sentence.
  bool Begin(std::string& error);

  Description GetField() const { return this->Keys.Apply(this->Field); }

  /// The CRC-32 of the first viewpoint that the input holds already.
  std::uint32_t GetFirstChecksum() const;

  /// Pulls slices, in any order, in as few slabs as possible. On failure returns false and says
  /// why, in one line.
  bool Pull(const std::vector<int>& slices, std::string& error);

  /// What was pulled last, in the order asked for: valid until the next pull, or as long as what
  /// GetHold returns is kept.
  std::vector<ConstSlice> GetSlices() const;
  std::shared_ptr<const void> GetHold() const { return this->Pulled; }

  /// Whether a texel pulled so far has a float colour that a video cannot hold.
  bool HasClipped() const { return this->Clipped; }

private:
  struct Samples
  {
    std::vector<unsigned char> Color;
    std::vector<unsigned short> Depth;
  };

  vtkSmartPointer<vtkImageData> Update(int first, int last, std::string& error);
  void Copy(vtkImageData* image, int slice, std::size_t place);

  vtkInformation* Information;
  Layout Grid;
  KeyViews Keys;
  std::size_t Texels; ///< of one slice
  Description Field;
  std::string Text; ///< the description
  bool HasDepth = false;
  bool IsFloat = false;
  std::size_t ColorBytes = 4; ///< of one texel
  bool Clipped = false;
  std::shared_ptr<Samples> Pulled; ///< of the slices pulled last
};
}

#endif
