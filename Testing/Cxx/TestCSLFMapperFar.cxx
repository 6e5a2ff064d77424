// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A cube that is far away, so that its texels are smaller than pixels, or several rays for each
// pixel by choice: each pixel shows the mean of its contents, as in a larger picture.
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkSmartPointer.h>

#include <cstddef>
#include <iostream>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

constexpr int SmallSize = 24;
constexpr int NearSize = 160;

/// The mean of each block of pixels.
Picture Shrink(const Picture& large, int factor)
{
  Picture small;
  small.Width = large.Width / factor;
  for (int y = 0; y < small.Width; ++y)
  {
    for (int x = 0; x < small.Width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        int sum = 0;
        for (int k = 0; k < factor * factor; ++k)
        {
          const std::size_t row = static_cast<std::size_t>(y) * factor + k / factor;
          sum += large.Colors[3 * (row * large.Width + x * factor + k % factor) + c];
        }
        small.Colors.push_back(
          static_cast<unsigned char>((sum + factor * factor / 2) / (factor * factor)));
      }
    }
  }
  return small;
}

Picture Draw(vtkCSLFMapper* mapper, int size)
{
  View view(size);
  view.Add(mapper);
  return view.Render();
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
    const Picture mean = Shrink(Draw(mapper, SmallSize * 16), 16);
    const double psnr = cslf::testing::ComparePictures(far, mean);
    std::cout << mapper->GetLookupAsString() << ": " << psnr << " dB\n";
    CSLF_CHECK(psnr > 40.0);
  }

  const Picture mean = Shrink(Draw(mapper, NearSize * 2), 2);
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
