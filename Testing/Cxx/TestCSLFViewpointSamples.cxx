// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The samples of a viewpoint are found in shared arrays and copied to others.
#include "cslfTestField.h"
#include "cslfTesting.h"

#include "cslfDescription.h"
#include "cslfViewpointSamples.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cstring>
#include <set>
#include <string>

using cslf::KnownChannel;

namespace
{
void TestArrays()
{
  const cslf::Layout grid(2, 4);
  const auto image =
    cslf::testing::MakeTestField(grid, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  const auto texels = grid.GetStripTexels();
  CSLF_CHECK(texels == 5 * 4 * 4);
  const auto second = cslf::ViewpointSamples(image).At(static_cast<vtkIdType>(texels));
  CSLF_CHECK(!second.IsEmpty());
  const auto* colors = second.Get<unsigned char>(KnownChannel::Color);
  const auto* depths = second.Get<unsigned short>(KnownChannel::Depth);
  CSLF_CHECK(colors && !second.Get<float>(KnownChannel::Color));
  CSLF_CHECK(depths && !second.Get<float>(KnownChannel::Depth));
  if (!colors || !depths)
  {
    return;
  }
  const auto texel = static_cast<vtkIdType>(texels) + 7;
  vtkPointData* data = image->GetPointData();
  CSLF_CHECK(
    depths[7] == data->GetArray(cslf::NameOf(KnownChannel::Depth))->GetComponent(texel, 0));
  CSLF_CHECK(
    colors[4 * 7 + 3] == data->GetArray(cslf::NameOf(KnownChannel::Color))->GetComponent(texel, 3));
  const cslf::ColorTexels shown(second);
  CSLF_CHECK(!shown.AreFloats() && shown.GetCoverage(7) == colors[4 * 7 + 3]);
  CSLF_CHECK(shown.GetShown(7, 1) == colors[4 * 7 + 1]);

  // A copy of the second viewpoint in the place of the first.
  second.CopyTo(cslf::ViewpointSamples(image), texels);
  CSLF_CHECK(std::memcmp(data->GetScalars()->GetVoidPointer(0), colors, 4 * texels) == 0);
}

void TestEmpty()
{
  const cslf::ViewpointSamples none;
  CSLF_CHECK(none.IsEmpty() && none.GetMemory(KnownChannel::Color) == nullptr);
  vtkNew<vtkImageData> image;
  CSLF_CHECK(cslf::ViewpointSamples(image).IsEmpty());

  // A field without depth.
  const auto field = cslf::testing::MakeTestField(cslf::Layout(2, 4), cslf::Cube(), VTK_FLOAT, 0);
  const cslf::ViewpointSamples samples(field);
  CSLF_CHECK(!samples.IsEmpty() && !samples.GetArray(KnownChannel::Depth));
  CSLF_CHECK(samples.Get<float>(KnownChannel::Color) && cslf::ColorTexels(samples).AreFloats());
  image->SetDimensions(20, 4, 24);
  samples.AddTo(image);
  CSLF_CHECK(image->GetPointData()->GetScalars() == samples.GetArray(KnownChannel::Color));
}

void TestChannels()
{
  std::set<std::string> names;
  for (std::size_t place = 0; place < cslf::ChannelIds.size(); ++place)
  {
    const cslf::ChannelId id = cslf::ChannelIds[place];
    CSLF_CHECK(id.GetPlace() == place && (place == 0 || cslf::ChannelIds[place - 1] < id));
    CSLF_CHECK(cslf::MakeChannel(id).Name == cslf::NameOf(id));
    CSLF_CHECK(names.insert(cslf::NameOf(id)).second);
  }
  // A channel alone is that of the first layer.
  CSLF_CHECK(cslf::ChannelId(KnownChannel::Depth).Layer == 0);
  CSLF_CHECK(cslf::NameOf(KnownChannel::Color) == std::string(cslf::ColorName));
  CSLF_CHECK(cslf::NameOf(KnownChannel::Depth) == std::string(cslf::DepthName));
  CSLF_CHECK(cslf::MakeChannel(KnownChannel::Color, VTK_FLOAT).GetTexelBytes() == 16);
  CSLF_CHECK(cslf::MakeChannel(KnownChannel::Depth, VTK_UNSIGNED_SHORT).GetTexelBytes() == 2);
  CSLF_CHECK(cslf::ToStored<unsigned short>(1.0) == 65535 && cslf::ToStored<float>(1.0) == 1.0F);
}
}

int TestCSLFViewpointSamples(int, char*[])
{
  TestArrays();
  TestEmpty();
  TestChannels();
  return cslf::testing::Result();
}
