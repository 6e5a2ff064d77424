// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A field at map coordinates, in metres, is drawn like the same field at the origin.
#include "cslfTestField.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <iostream>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

const glm::dvec3 Far(5e5, 4e6, 120.0);

vtkSmartPointer<vtkImageData> MakeField(const cslf::Cube& box)
{
  return cslf::testing::MakeTestField(
    cslf::Layout(5, 48), box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, 1);
}

Picture Draw(vtkImageData* field, const cslf::Cube& box, int lookup)
{
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputData(field);
  mapper->SetLookup(lookup);
  View view;
  view.Add(mapper);
  vtkCamera* camera = view.GetCamera();
  const glm::dvec3 from = box.PointToWorld({ 1.2, 0.9, 5.0 });
  camera->SetPosition(from.x, from.y, from.z);
  camera->SetFocalPoint(box.Center.x, box.Center.y, box.Center.z);
  const double half = 0.5 * box.Edges.x;
  camera->SetClippingRange(half * 1.0, half * 12.0);
  return view.Render();
}
}

int TestCSLFMapperPrecision(int, char*[])
{
  for (const double edge : { 2.0, 2000.0 })
  {
    const cslf::Cube here{ glm::dvec3(0.0), glm::dvec3(edge) };
    const cslf::Cube there{ Far, glm::dvec3(edge) };
    const vtkSmartPointer<vtkImageData> fields[] = { MakeField(here), MakeField(there) };
    for (const int lookup : { vtkCSLFMapper::BILINEAR, vtkCSLFMapper::DEPTH })
    {
      const Picture near = Draw(fields[0], here, lookup);
      const Picture far = Draw(fields[1], there, lookup);
      const double psnr = cslf::testing::ComparePictures(near, far);
      std::cout << "lookup " << lookup << ", edges of " << edge << ": " << psnr << " dB, "
                << near.CountDrawn() << " and " << far.CountDrawn() << " pixels drawn\n";
      CSLF_CHECK(near.CountDrawn() > 2000 && psnr >= 50.0);
    }
  }
  return cslf::testing::Result();
}
