// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A cube that is far away, so that its texels are smaller than pixels, or several rays for each
// pixel by choice: each pixel shows the mean of its contents, as in a larger picture.
#include "cslfColor.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstddef>
#include <iostream>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

constexpr int SmallSize = 24;
constexpr int NearSize = 160;

Picture Draw(vtkCSLFMapper* mapper, int size, double background = 0.0)
{
  View view(size);
  view.Renderer->SetBackground(background, background, background);
  view.Add(mapper);
  return view.Render();
}

/// The mean of each block of a larger picture's pixels, over black: of their light, in the part
/// that they cover, which two backgrounds tell.
Picture DrawMean(vtkCSLFMapper* mapper, int size, int factor)
{
  const Picture black = Draw(mapper, size * factor);
  const Picture white = Draw(mapper, size * factor, 1.0);
  Picture small;
  small.Width = size;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        double light = 0.0;
        double covered = 0.0;
        for (int k = 0; k < factor * factor; ++k)
        {
          const std::size_t row = static_cast<std::size_t>(y) * factor + k / factor;
          const std::size_t value = 3 * (row * black.Width + x * factor + k % factor) + c;
          const double alpha = 1.0 - (white.Colors[value] - black.Colors[value]) / 255.0;
          const double color = black.Colors[value] / 255.0;
          covered += alpha;
          light += alpha > 0.0 ? alpha * cslf::SRGBToLinear(std::min(color / alpha, 1.0)) : 0.0;
        }
        const double mean =
          covered > 0.0 ? covered / (factor * factor) * cslf::LinearToSRGB(light / covered) : 0.0;
        small.Colors.push_back(cslf::ToByte(mean));
      }
    }
  }
  return small;
}
}

int TestCSLFMapperFar(int, char*[])
{
  const vtkSmartPointer<vtkCSLFMapper> mapper = cslf::testing::MakeTestMapper();
  mapper->SetPixelSamples(1);
  for (const int lookup : { vtkCSLFMapper::BILINEAR, vtkCSLFMapper::DEPTH })
  {
    mapper->SetLookup(lookup);
    const Picture far = Draw(mapper, SmallSize);
    const Picture mean = DrawMean(mapper, SmallSize, 16);
    const double psnr = cslf::testing::ComparePictures(far, mean);
    std::cout << mapper->GetLookupAsString() << ": " << psnr << " dB\n";
    CSLF_CHECK(psnr > 40.0);
  }

  const Picture mean = DrawMean(mapper, NearSize, 2);
  const double single = cslf::testing::ComparePictures(Draw(mapper, NearSize), mean);
  mapper->SetPixelSamples(2);
  const double several = cslf::testing::ComparePictures(Draw(mapper, NearSize), mean);
  std::cout << "near: " << single << " dB, with more rays " << several << " dB\n";
  CSLF_CHECK(several > 45.0);
  CSLF_CHECK(several > single + 6.0);

  // Used only in the depth lookup.
  mapper->SetLookupToBilinear();
  const Picture bilinear = Draw(mapper, NearSize);
  mapper->SetPixelSamples(1);
  CSLF_CHECK(bilinear.Colors == Draw(mapper, NearSize).Colors);
  return cslf::testing::Result();
}
