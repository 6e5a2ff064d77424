// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A cube that is far away, so that its texels are smaller than pixels: each pixel shows the mean of
// what lies in it, as a larger picture has it.
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
constexpr int Factor = 16;

/// The mean of each block of pixels.
Picture Shrink(const Picture& large)
{
  Picture small;
  small.Width = large.Width / Factor;
  for (int y = 0; y < small.Width; ++y)
  {
    for (int x = 0; x < small.Width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        int sum = 0;
        for (int k = 0; k < Factor * Factor; ++k)
        {
          const std::size_t row = static_cast<std::size_t>(y) * Factor + k / Factor;
          sum += large.Colors[3 * (row * large.Width + x * Factor + k % Factor) + c];
        }
        small.Colors.push_back(
          static_cast<unsigned char>((sum + Factor * Factor / 2) / (Factor * Factor)));
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
  for (const int lookup : { vtkCSLFMapper::BILINEAR, vtkCSLFMapper::DEPTH })
  {
    mapper->SetLookup(lookup);
    const Picture far = Draw(mapper, SmallSize);
    const Picture mean = Shrink(Draw(mapper, SmallSize * Factor));
    const double psnr = cslf::testing::ComparePictures(far, mean);
    std::cout << mapper->GetLookupAsString() << ": " << psnr << " dB\n";
    CSLF_CHECK(psnr > 40.0);
  }
  return cslf::testing::Result();
}
