// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files whose depth, coverage and some of whose colours are those of their geometry: what
// viewpoints see of triangles is compared with rays, other colours stay, such files are smaller,
// and what the geometry does not tell is coded as in other files. Bad headers are refused.
#include "Coding/Containers/cslfContainerReader.h"
#include "Coding/Geometry/cslfGeometryRays.h"
#include "Coding/Geometry/cslfGeometryTexels.h"
#include "Coding/Writing/cslfGeometryPlan.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfCodecTesting.h"
#include "cslfJSONText.h"
#include "cslfRemux.h"
#include "cslfTestField.h"
#include "cslfTesting.h"
#include "vtkCSLFDecoder.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFRateControl.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTestErrorObserver.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace
{
constexpr int None = cslf::GeometryTexels::None;
const std::atomic<bool> IsStopped{ false };

/// The first triangle that a texel's ray meets.
int FindDepth(vtkPolyData* triangles, const cslf::Layout& grid, int slice, int tile, int x, int y)
{
  const cslf::Viewpoint viewpoint = grid.ViewpointOf(slice);
  const glm::dvec3 from = grid.ViewpointPosition(viewpoint);
  const glm::dvec3 to = cslf::FaceToCube(
    cslf::ExitFaceOf(viewpoint.Face, tile), { grid.TexelCoordinate(x), grid.TexelCoordinate(y) });
  const double begin[3] = { from.x, from.y, from.z };
  const double end[3] = { to.x, to.y, to.z };
  double nearest = 2.0;
  for (vtkIdType cell = 0; cell < triangles->GetNumberOfCells(); ++cell)
  {
    double t = 2.0;
    double point[3];
    double parameters[3];
    int part = 0;
    const bool isHit =
      triangles->GetCell(cell)->IntersectWithLine(begin, end, 0.0, t, point, parameters, part) != 0;
    nearest = isHit ? std::min(nearest, t) : nearest;
  }
  return nearest <= 1.0 ? static_cast<int>(std::lround(65535.0 * nearest)) : None;
}

/// All texels of some viewpoints, among them those on edges and corners of the cube.
void TestDepths()
{
  const auto triangles = cslf::Triangulate(cslf::testing::MakeTestSurfaces(cslf::Cube()));
  const cslf::Layout grid(5, 11);
  const cslf::GeometryTexels depths(triangles, cslf::Cube(), grid);
  int texels = 0;
  int others = 0;
  int hits = 0;
  cslf::DrawnTexels drawn(grid.GetStripTexels(), false);
  const std::vector<unsigned short>& strip = drawn.Depths;
  for (int slice : { 0, 7, 12, 30, 49, 62, 88, 101, 126, 149 })
  {
    depths.Draw(slice, drawn, IsStopped);
    for (int place = 0; place < static_cast<int>(strip.size()); ++place)
    {
      const int x = place % grid.GetStripWidth();
      const int expected = FindDepth(triangles, grid, slice, x / grid.GetResolution(),
        x % grid.GetResolution(), place / grid.GetStripWidth());
      ++texels;
      hits += expected < None ? 1 : 0;
      others += std::abs(expected - strip[place]) > 2 ? 1 : 0;
    }
  }
  std::cout << texels << " texels, " << hits << " with a surface, " << others << " differ\n";
  // At edges of triangles, each may miss or add a hit.
  CSLF_CHECK(hits > texels / 4 && hits < texels && others <= texels / 1000);
}

/// Neighbours leave no gaps, and triangles behind the viewpoint or through it do no harm.
void TestGaps()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  constexpr int side = 37;
  for (int y = 0; y <= side; ++y)
  {
    for (int x = 0; x <= side; ++x)
    {
      points->InsertNextPoint(2.0 * x / side - 1.0, 2.0 * y / side - 1.0, 0.25);
    }
  }
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      const vtkIdType corner = y * (side + 1) + x;
      cells->InsertNextCell({ corner, corner + 1, corner + side + 2 });
      cells->InsertNextCell({ corner, corner + side + 2, corner + side + 1 });
    }
  }
  vtkNew<vtkPolyData> sheet;
  sheet->SetPoints(points);
  sheet->SetPolys(cells);
  const cslf::Layout grid(5, 64);
  const cslf::GeometryTexels depths(sheet, cslf::Cube(), grid);
  cslf::DrawnTexels drawn(grid.GetStripTexels(), false);
  const std::vector<unsigned short>& strip = drawn.Depths;
  for (int slice = 0; slice < grid.GetSlices(); ++slice)
  {
    depths.Draw(slice, drawn, IsStopped);
    const cslf::Viewpoint viewpoint = grid.ViewpointOf(slice);
    // The rays to the opposite face from the two faces beside the sheet all meet it.
    if (viewpoint.Face >= 4)
    {
      const int tile = cslf::TileOf(viewpoint.Face, viewpoint.Face == 4 ? 5 : 4);
      const double expected = viewpoint.Face == 4 ? 0.375 : 0.625;
      for (int texel = 0; texel < 64 * 64; ++texel)
      {
        const int place = texel / 64 * grid.GetStripWidth() + tile * 64 + texel % 64;
        CSLF_CHECK(std::abs(strip[place] - 65535.0 * expected) < 1.0);
      }
    }
  }
}

struct Case
{
  vtkSmartPointer<vtkImageData> Field;
  vtkSmartPointer<vtkPolyData> Geometry;
  std::string FileName;

  /// Writes it, and returns the encoder.
  vtkSmartPointer<vtkCSLFEncoder> Write(bool isLossless = false, bool fromGeometry = true) const
  {
    auto encoder = vtkSmartPointer<vtkCSLFEncoder>::New();
    encoder->SetInputData(this->Field);
    encoder->SetGeometryData(this->Geometry);
    encoder->SetFileName(this->FileName.c_str());
    encoder->GetRateControl()->SetCRF(8.0);
    encoder->SetPreset("ultrafast");
    encoder->SetLossless(isLossless);
    encoder->SetDepthFromGeometry(fromGeometry);
    CSLF_CHECK(encoder->Write() == 1);
    return encoder;
  }

  vtkSmartPointer<vtkImageData> Read() const
  {
    vtkNew<vtkCSLFDecoder> decoder;
    decoder->SetFileName(this->FileName.c_str());
    decoder->Update();
    return decoder->GetOutput();
  }

  cslf::FileHeader ReadHeader() const
  {
    cslf::OpenError failure;
    const auto reader = cslf::ContainerReader::Open(this->FileName, failure);
    CSLF_CHECK(reader != nullptr);
    return reader ? reader->GetHeader() : cslf::FileHeader();
  }
};

vtkDataArray* GetArray(vtkImageData* field, const char* name)
{
  return field->GetPointData()->GetArray(name);
}

/// The depth is the geometry's, alpha tells where it is, and colours are those of the field where
/// both have a surface.
void CheckDecoded(vtkImageData* before, vtkImageData* after, bool hasCoverage, double scale)
{
  CSLF_CHECK(after->GetNumberOfPoints() == before->GetNumberOfPoints());
  vtkIdType both = 0;
  vtkIdType others = 0;
  double squares = 0.0;
  for (vtkIdType texel = 0; texel < after->GetNumberOfPoints(); ++texel)
  {
    const double depth[2] = { GetArray(before, "Depth")->GetTuple1(texel),
      GetArray(after, "Depth")->GetTuple1(texel) };
    double colors[2][4];
    GetArray(before, "Color")->GetTuple(texel, colors[0]);
    GetArray(after, "Color")->GetTuple(texel, colors[1]);
    const bool isCovered = depth[1] < None;
    CSLF_CHECK(colors[1][3] == (isCovered || !hasCoverage ? scale : 0.0));
    CSLF_CHECK(isCovered || !hasCoverage ||
      (colors[1][0] == 0.0 && colors[1][1] == 0.0 && colors[1][2] == 0.0));
    const bool isSame =
      colors[0][3] == scale && std::abs(depth[0] - depth[1]) < 0.02 * depth[1] && isCovered;
    both += isSame ? 1 : 0;
    others += !isSame && isCovered ? 1 : 0;
    for (int k = 0; isSame && k < 3; ++k)
    {
      squares += std::pow((colors[0][k] - colors[1][k]) / scale, 2.0) / 3.0;
    }
  }
  const double psnr = -10.0 * std::log10(squares / static_cast<double>(both));
  std::cout << both << " texels with " << psnr << " dB, " << others << " beside silhouettes\n";
  CSLF_CHECK(psnr > (scale == 1.0 ? 30.0 : 36.0) && both > 4 * others);
}

void TestFile(const std::string& folder, int colorType)
{
  const Case file{ cslf::testing::MakeTestField(
                     cslf::Layout(3, 64), cslf::Cube(), colorType, VTK_UNSIGNED_SHORT),
    cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/field.mp4" };
  const auto with = file.Write();
  std::cout << "loss " << with->GetActualGeometryLoss() << ", " << with->GetActualSize()
            << " bytes\n";
  CSLF_CHECK(with->GetActualDepthFromGeometry() && with->GetActualGeometryLoss() < 0.01);
  const cslf::FileHeader header = file.ReadHeader();
  CSLF_CHECK(header.Tracks.size() == 1 && header.Computed.HasDepth && header.Computed.HasCoverage);
  const auto field = file.Read();
  CheckDecoded(file.Field, field, true, colorType == VTK_FLOAT ? 1.0 : 255.0);

  // A single viewpoint is the same.
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(file.FileName.c_str());
  decoder->UpdateInformation();
  constexpr int slice = 47;
  int extent[6];
  field->GetExtent(extent);
  extent[4] = extent[5] = slice;
  decoder->UpdateExtent(extent);
  auto* one = GetArray(decoder->GetOutput(), "Depth");
  for (vtkIdType k = 0; k < one->GetNumberOfTuples(); ++k)
  {
    CSLF_CHECK(one->GetTuple1(k) ==
      GetArray(field, "Depth")->GetTuple1(k + slice * one->GetNumberOfTuples()));
  }

  const auto without = file.Write(false, false);
  std::cout << "without: " << without->GetActualSize() << " bytes\n";
  CSLF_CHECK(!without->GetActualDepthFromGeometry() && without->GetActualGeometryLoss() == 0.0);
  CSLF_CHECK(with->GetActualSize() < 0.9 * without->GetActualSize());
  CSLF_CHECK(file.ReadHeader().Tracks.size() == 3);
}

/// Surfaces whose colours vary from point to point, other ones on the back. They are exact where
/// x is below the first limit on the front, and y below the second on the back.
vtkSmartPointer<vtkPolyData> MakeColoredSurfaces(double frontLimit, double backLimit)
{
  const auto surfaces = cslf::Triangulate(cslf::testing::MakeTestSurfaces(cslf::Cube()));
  vtkNew<vtkUnsignedCharArray> colors[3];
  const char* const names[3] = { "Color", "BackColor", cslf::ExactColorName };
  for (int k = 0; k < 3; ++k)
  {
    colors[k]->SetName(names[k]);
    colors[k]->SetNumberOfComponents(k < 2 ? 4 : 2);
    surfaces->GetPointData()->AddArray(colors[k]);
  }
  for (vtkIdType point = 0; point < surfaces->GetNumberOfPoints(); ++point)
  {
    double p[3];
    surfaces->GetPoint(point, p);
    colors[0]->InsertNextTuple4(
      std::floor(130 + 90 * p[0]), std::floor(120 - 80 * p[1]), std::floor(90 + 70 * p[2]), 255);
    colors[1]->InsertNextTuple4(
      std::floor(60 - 50 * p[2]), std::floor(200 + 40 * p[0]), std::floor(90 + 60 * p[1]), 255);
    colors[2]->InsertNextTuple2(p[0] < frontLimit ? 1 : 0, p[1] < backLimit ? 1 : 0);
  }
  return surfaces;
}

/// What the ray to a texel's centre meets.
std::optional<cslf::GeometryRays::Hit> FindHit(
  const cslf::GeometryRays& rays, const cslf::Layout& grid, vtkIdType texel)
{
  const auto strip = static_cast<vtkIdType>(grid.GetStripTexels());
  const cslf::Viewpoint viewpoint = grid.ViewpointOf(static_cast<int>(texel / strip));
  const int x = static_cast<int>(texel % strip) % grid.GetStripWidth();
  const int y = static_cast<int>(texel % strip) / grid.GetStripWidth();
  cslf::RayCoordinates ray;
  ray.Entry = { viewpoint.Face,
    { grid.NodeCoordinate(viewpoint.I), grid.NodeCoordinate(viewpoint.J) } };
  ray.Exit = { cslf::ExitFaceOf(viewpoint.Face, x / grid.GetResolution()),
    { grid.TexelCoordinate(x % grid.GetResolution()), grid.TexelCoordinate(y) } };
  return rays.Intersect(ray);
}

/// Gives the texels of a field the exact colours that its geometry has there, with some noise, and
/// returns these; alpha is 0 elsewhere.
std::vector<glm::dvec4> PutExactColors(const Case& file, const cslf::Layout& grid)
{
  cslf::Description field;
  field.Grid = grid;
  const cslf::GeometryRays rays(file.Geometry, field);
  auto* colors = vtkUnsignedCharArray::SafeDownCast(GetArray(file.Field, "Color"));
  std::vector<glm::dvec4> exact(colors->GetNumberOfTuples(), glm::dvec4(0.0));
  for (vtkIdType texel = 0; texel < colors->GetNumberOfTuples(); ++texel)
  {
    const auto hit = FindHit(rays, grid, texel);
    if (hit && hit->IsExact)
    {
      exact[texel] = hit->Color;
      const double alpha = colors->GetTypedComponent(texel, 3);
      for (int k = 0; k < 3; ++k)
      {
        const auto noise = static_cast<double>((texel * 7 + k * 3) % 9 - 4);
        colors->SetTypedComponent(texel, k,
          static_cast<unsigned char>(std::clamp(alpha * hit->Color[k] + noise, 0.0, alpha)));
      }
    }
  }
  return exact;
}

/// Readers have the exact colours, to the level.
void CheckExact(vtkImageData* field, const std::vector<glm::dvec4>& exact)
{
  vtkDataArray* colors = GetArray(field, "Color");
  vtkIdType count = 0;
  vtkIdType others = 0;
  for (vtkIdType texel = 0; texel < colors->GetNumberOfTuples(); ++texel)
  {
    if (exact[texel].w > 0.0)
    {
      ++count;
      bool isSame = colors->GetComponent(texel, 3) == 255.0;
      for (int k = 0; k < 3; ++k)
      {
        isSame =
          isSame && std::abs(colors->GetComponent(texel, k) - 255.0 * exact[texel][k]) < 0.51;
      }
      others += isSame ? 0 : 1;
    }
  }
  std::cout << others << " of " << count << " exact texels differ\n";
  // At edges of triangles, each may miss or add a hit.
  CSLF_CHECK(count > 10000 && others < count / 100);
}

/// Exact colours are not coded, if they are the field's: readers get them from the geometry, to the
/// level, and the others as without.
void TestColors(const std::string& folder)
{
  const cslf::Layout grid(3, 32);
  Case file{ cslf::testing::MakeTestField(
               grid, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    MakeColoredSurfaces(0.5, 0.0), folder + "/colors.mp4" };
  // The field's own colours are others.
  CSLF_CHECK(file.Write()->GetActualDepthFromGeometry());
  CSLF_CHECK(!file.ReadHeader().Computed.HasColor);

  const std::vector<glm::dvec4> exact = PutExactColors(file, grid);
  auto* colors = vtkUnsignedCharArray::SafeDownCast(GetArray(file.Field, "Color"));
  const auto with = file.Write();
  std::cout << "colours of " << with->GetActualColorFromGeometry() << " from the geometry, "
            << with->GetActualSize() << " bytes\n";
  CSLF_CHECK(with->GetActualColorFromGeometry() > 0.1 && with->GetActualColorFromGeometry() < 0.9);
  CSLF_CHECK(file.ReadHeader().Computed.HasColor && file.ReadHeader().Tracks.size() == 1);
  const auto after = file.Read();
  CheckExact(after, exact);

  // Nothing changes beside them.
  file.Geometry->GetPointData()->RemoveArray(cslf::ExactColorName);
  const auto without = file.Write();
  std::cout << without->GetActualSize() << " bytes without\n";
  CSLF_CHECK(without->GetActualColorFromGeometry() == 0.0 && !file.ReadHeader().Computed.HasColor);
  CSLF_CHECK(with->GetActualSize() < 0.95 * without->GetActualSize());
  const auto coded = file.Read();
  double squares = 0.0;
  vtkIdType compared = 0;
  for (vtkIdType texel = 0; texel < colors->GetNumberOfTuples(); ++texel)
  {
    for (int k = 0; k < 4 && exact[texel].w == 0.0; ++k, ++compared)
    {
      const double difference = GetArray(after, "Color")->GetComponent(texel, k) -
        GetArray(coded, "Color")->GetComponent(texel, k);
      squares += difference * difference;
    }
  }
  CSLF_CHECK(compared > 10000 && std::sqrt(squares / static_cast<double>(compared)) < 4.0);
}

/// If all colours are exact, only the viewpoints that the encoder tries are asked for: the others
/// may have anything.
void TestAlone(const std::string& folder)
{
  const cslf::Layout grid(3, 32);
  const Case file{ cslf::testing::MakeTestField(
                     grid, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    MakeColoredSurfaces(2.0, 2.0), folder + "/alone.mp4" };
  const std::vector<glm::dvec4> exact = PutExactColors(file, grid);
  const std::vector<cslf::FrameId> tried = cslf::GetTriedViewpoints(grid);
  const auto texels = static_cast<vtkIdType>(grid.GetStripTexels());
  for (int slice = 0; slice < grid.GetSlices(); ++slice)
  {
    const bool isTried = std::find(tried.begin(), tried.end(), slice) != tried.end();
    for (vtkIdType texel = slice * texels; !isTried && texel < (slice + 1) * texels; ++texel)
    {
      GetArray(file.Field, "Color")->SetTuple4(texel, texel % 251, texel % 31, 7.0, 255.0);
      GetArray(file.Field, "Depth")->SetTuple1(texel, static_cast<double>(texel % 65521));
    }
  }
  const auto encoder = file.Write();
  std::cout << "alone: " << encoder->GetActualSize() << " bytes\n";
  CSLF_CHECK(encoder->GetActualColorFromGeometry() > 0.9);
  CSLF_CHECK(file.ReadHeader().Computed.IsAll && file.ReadHeader().GetCodedGroups() == 1);
  CheckExact(file.Read(), exact);
}

/// Files with geometry whose depth is coded all the same.
void TestUnused(const std::string& folder)
{
  Case file{ cslf::testing::MakeTestField(
               cslf::Layout(3, 32), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/unused.mp4" };
  const auto lossless = file.Write(true);
  CSLF_CHECK(!lossless->GetActualDepthFromGeometry());
  const auto exact = file.Read();
  for (const char* name : { "Depth", "Color" })
  {
    double most = 0.0;
    for (vtkIdType k = 0; k < exact->GetNumberOfPoints(); ++k)
    {
      most = std::max(most,
        std::abs(GetArray(exact, name)->GetComponent(k, 0) -
          GetArray(file.Field, name)->GetComponent(k, 0)));
    }
    CSLF_CHECK(most == 0.0);
  }

  // A part of the surfaces is missing.
  vtkNew<vtkCellArray> some;
  for (vtkIdType k = 0; k < file.Geometry->GetNumberOfPolys() * 4 / 5; ++k)
  {
    some->InsertNextCell(file.Geometry->GetCell(k));
  }
  vtkNew<vtkPolyData> partial;
  partial->SetPoints(file.Geometry->GetPoints());
  partial->SetPolys(some);
  file.Geometry = partial;
  const auto encoder = file.Write();
  std::cout << "loss " << encoder->GetActualGeometryLoss() << " without a part\n";
  CSLF_CHECK(!encoder->GetActualDepthFromGeometry() && encoder->GetActualGeometryLoss() > 0.01);
  CSLF_CHECK(file.ReadHeader().Tracks.size() == 3 && file.ReadHeader().FindGeometry());

  // Of the opaque surfaces, there may be others in front and beside.
  file.Geometry = cslf::testing::MakeTestSurfaces(cslf::Cube());
  CSLF_CHECK(file.Write()->GetActualDepthFromGeometry());
  vtkNew<vtkDoubleArray> loss;
  loss->SetName(cslf::GeometryOpaqueLossName);
  loss->InsertNextValue(0.001);
  file.Geometry->GetFieldData()->AddArray(loss);
  CSLF_CHECK(!file.Write()->GetActualDepthFromGeometry());

  // Without depth there is nothing to compute.
  file.Field =
    cslf::testing::MakeTestField(cslf::Layout(3, 32), cslf::Cube(), VTK_UNSIGNED_CHAR, 0);
  CSLF_CHECK(!file.Write()->GetActualDepthFromGeometry());
}

/// Texels that show the environment keep their colours.
void TestCovered(const std::string& folder)
{
  const Case file{ cslf::testing::MakeTestField(
                     cslf::Layout(3, 64), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/covered.mp4" };
  auto* colors = vtkUnsignedCharArray::SafeDownCast(GetArray(file.Field, "Color"));
  vtkIdType empty = 0;
  for (vtkIdType k = 0; k < colors->GetNumberOfTuples(); ++k)
  {
    if (colors->GetTypedComponent(k, 3) < 255)
    {
      colors->SetTypedComponent(k, 0, 40);
      colors->SetTypedComponent(k, 1, 90);
      colors->SetTypedComponent(k, 2, 160);
      colors->SetTypedComponent(k, 3, 255);
      // As where the ray to the centre shows the environment.
      GetArray(file.Field, "Depth")->SetTuple1(k, None);
      ++empty;
    }
  }
  CSLF_CHECK(empty > 1000);
  CSLF_CHECK(file.Write()->GetActualDepthFromGeometry());
  const cslf::FileHeader header = file.ReadHeader();
  CSLF_CHECK(header.Tracks.size() == 1 && header.Computed.HasDepth && !header.Computed.HasCoverage);
  const auto field = file.Read();
  CheckDecoded(file.Field, field, false, 255.0);
  double sum = 0.0;
  vtkIdType count = 0;
  for (vtkIdType k = 0; k < field->GetNumberOfPoints(); ++k)
  {
    if (GetArray(field, "Depth")->GetTuple1(k) == None)
    {
      sum += GetArray(field, "Color")->GetComponent(k, 2);
      ++count;
    }
  }
  CSLF_CHECK_NEAR(sum / static_cast<double>(count), 160.0, 4.0);
}

/// Wires thinner than texels, in none of which they take more than half: a file from whose geometry
/// coverage is computed would have them in some texels only.
void TestWires(const std::string& folder)
{
  for (const bool hasWires : { false, true })
  {
    const Case file{ cslf::testing::MakeTestField(
                       cslf::Layout(3, 64), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
      cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/wires.mp4" };
    auto* colors = vtkUnsignedCharArray::SafeDownCast(GetArray(file.Field, "Color"));
    for (vtkIdType k = 0; hasWires && k < colors->GetNumberOfTuples(); k += 7)
    {
      if (colors->GetTypedComponent(k, 3) == 0)
      {
        const unsigned char gray[] = { 40, 40, 40, 64 };
        colors->SetTypedTuple(k, gray);
        GetArray(file.Field, "Depth")->SetTuple1(k, 30000);
      }
    }
    CSLF_CHECK(file.Write()->GetActualDepthFromGeometry() != hasWires);
  }
}

/// Only some viewpoints are covered, among them those that the encoder tries: coverage is coded.
void TestCoveredMiddles(const std::string& folder)
{
  const cslf::Layout grid(3, 32);
  const Case file{ cslf::testing::MakeTestField(
                     grid, cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/middles.mp4" };
  const auto texels = static_cast<vtkIdType>(grid.GetStripTexels());
  for (int face = 0; face < cslf::FaceCount; ++face)
  {
    const vtkIdType first = texels * grid.SliceOf({ face, 1, 1 });
    for (vtkIdType k = first; k < first + texels; ++k)
    {
      GetArray(file.Field, "Color")->SetComponent(k, 3, 255.0);
    }
  }
  CSLF_CHECK(file.Write()->GetActualDepthFromGeometry());
  const cslf::FileHeader header = file.ReadHeader();
  CSLF_CHECK(header.Tracks.size() == 2 && header.Computed.HasDepth && !header.Computed.HasCoverage);
  const auto field = file.Read();
  vtkIdType others = 0;
  for (vtkIdType k = 0; k < field->GetNumberOfPoints(); ++k)
  {
    const double alphas[2] = { GetArray(file.Field, "Color")->GetComponent(k, 3),
      GetArray(field, "Color")->GetComponent(k, 3) };
    others += std::abs(alphas[0] - alphas[1]) > 64.0 ? 1 : 0;
    CSLF_CHECK(alphas[1] > 0.0 || GetArray(field, "Depth")->GetTuple1(k) == None);
  }
  CSLF_CHECK(others < field->GetNumberOfPoints() / 500);
}

/// A file with another JSON text or without parts is refused with that message.
template <typename Change>
void CheckRefused(const Case& file, const std::string& message, Change change)
{
  cslf::testing::Tags tags = file.ReadHeader().ToTags();
  auto json = cslf::ParseJSON(cslf::UnsealHeader(tags["comment"]).JSON);
  change(json, tags);
  tags["comment"] = tags["description"] = cslf::SealHeader(json.dump());
  cslf::testing::RemuxChanges changes;
  changes.SetTags = tags;
  const std::string fileName = file.FileName + ".changed.mp4";
  CSLF_CHECK(cslf::testing::Remux(file.FileName, fileName, changes));
  vtkNew<vtkCSLFDecoder> decoder;
  vtkNew<vtkTest::ErrorObserver> observer;
  decoder->AddObserver(vtkCommand::ErrorEvent, observer);
  decoder->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  decoder->SetFileName(fileName.c_str());
  decoder->Update();
  CSLF_CHECK(decoder->GetOutput()->GetNumberOfPoints() == 0);
  if (!observer->GetError() || observer->GetErrorMessage().find(message) == std::string::npos)
  {
    std::cerr << "expected \"" << message << "\", not " << observer->GetErrorMessage() << "\n";
    CSLF_CHECK(false);
  }
}

void TestHeaders(const std::string& folder)
{
  using JSON = nlohmann::json;
  using Tags = cslf::testing::Tags;
  const Case file{ cslf::testing::MakeTestField(
                     cslf::Layout(3, 32), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT),
    cslf::testing::MakeTestSurfaces(cslf::Cube()), folder + "/headers.mp4" };
  CSLF_CHECK(file.Write()->GetActualDepthFromGeometry());
  const auto setComputed = [](const JSON& names)
  { return [names](JSON& json, Tags&) { json["coding"]["from_geometry"] = names; }; };
  CheckRefused(file, "unknown channel", setComputed({ "depth", "normals" }));
  CheckRefused(file, "is not what it requires", setComputed({ "color" }));
  CheckRefused(file, "is not what it requires", setComputed({ "coverage" }));
  CheckRefused(file, "", setComputed("depth"));
  CheckRefused(file, "", setComputed({ 3 }));
  CheckRefused(file, "is not what it requires", setComputed(JSON::array()));
  CheckRefused(file, "other channels from its geometry", setComputed({ "depth", "all" }));
  CheckRefused(
    file, "other channels from its geometry", setComputed({ "depth", "coverage", "all" }));
  CheckRefused(
    file, "its groups do not match", setComputed({ "depth", "coverage", "color", "all" }));
  CheckRefused(file, "is not what it requires", [](JSON& json, Tags&) { json.erase("required"); });
  CheckRefused(file, "its tracks do not match its channels",
    [](JSON& json, Tags&)
    {
      json.erase("required");
      json["coding"].erase("from_geometry");
    });
  CheckRefused(file, "requires features that this version does not support: layers",
    [](JSON& json, Tags&) { json["required"].push_back("layers"); });
  CheckRefused(file, "other channels from its geometry",
    [](JSON& json, Tags&) { json["channels"].erase(json["channels"].begin() + 1); });
  const char* const lost = "the geometry from which its depth is computed is missing or damaged";
  CheckRefused(file, lost, [](JSON& json, Tags&) { json.erase("parts"); });
  CheckRefused(file, lost, [](JSON& json, Tags&) { json["parts"][0]["type"] = "model/other"; });
  CheckRefused(file, lost, [](JSON& json, Tags&) { json["parts"][0]["crc"] = 1; });
  CheckRefused(file, lost, [](JSON& json, Tags&) { json["parts"][0]["frame"] = 1; });
  CheckRefused(file, lost, [](JSON& json, Tags&) { json["parts"][0]["bytes"] = 100000000; });
}
}

int TestCSLFEncoderGeometryDepth(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderGeometryDepth");
  TestDepths();
  TestGaps();
  TestFile(folder, VTK_UNSIGNED_CHAR);
  TestFile(folder, VTK_FLOAT);
  TestColors(folder);
  TestAlone(folder);
  TestUnused(folder);
  TestCovered(folder);
  TestWires(folder);
  TestCoveredMiddles(folder);
  TestHeaders(folder);
  return cslf::testing::Result();
}
