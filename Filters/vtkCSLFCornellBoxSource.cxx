// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFCornellBoxSource.h"

#include "Pipeline/cslfGuard.h"

#include "cslfColor.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <glm/vec3.hpp>

#include <vector>

vtkStandardNewMacro(vtkCSLFCornellBoxSource);
cslfGuardedRequestMacro(vtkCSLFCornellBoxSource);

namespace
{
using Quadrilateral = std::vector<glm::dvec3>;

struct Block
{
  const char* Name;
  std::vector<Quadrilateral> Faces; // in the published millimetres
  glm::dvec3 Reflectance;           // linear
  glm::dvec3 Emission;
};

// The room's inner size, in millimetres.
const glm::dvec3 RoomSize(556.0, 548.8, 559.2);

// How far the lamp hangs below the ceiling, in millimetres.
constexpr double LampGap = 0.5488;

const glm::dvec3 White(0.73);
const glm::dvec3 Red(0.65, 0.05, 0.05);
const glm::dvec3 Green(0.12, 0.45, 0.15);
const glm::dvec3 LampRadiance(17.0, 12.0, 4.0);
const glm::dvec3 Dark(0.0);

/// The published axes run to the left, up, and away from the opening.
glm::dvec3 ToRoom(const glm::dvec3& published)
{
  const glm::dvec3 unit = 2.0 * published / RoomSize - 1.0;
  return { -unit.x, unit.y, -unit.z };
}

/// A face, and four walls from its edges up to a height.
std::vector<Quadrilateral> Extrude(const Quadrilateral& face, double height)
{
  std::vector<Quadrilateral> faces{ face };
  for (std::size_t i = 0; i < 4; ++i)
  {
    const glm::dvec3& a = face[i];
    const glm::dvec3& b = face[(i + 1) % 4];
    faces.push_back({ a, { a.x, height, a.z }, { b.x, height, b.z }, b });
  }
  return faces;
}

/// The ceiling, and the rim that closes the gap between it and the lamp: light from the lamp's back
/// must not escape.
std::vector<Quadrilateral> MakeCeiling(const Quadrilateral& lamp)
{
  std::vector<Quadrilateral> faces = Extrude(lamp, RoomSize.y);
  faces[0] = { { RoomSize.x, RoomSize.y, 0 }, RoomSize, { 0, RoomSize.y, RoomSize.z },
    { 0, RoomSize.y, 0 } };
  return faces;
}

std::vector<Block> MakeBlocks()
{
  const double x = RoomSize.x;
  const double y = RoomSize.y;
  const double z = RoomSize.z;
  const double height = y - LampGap;
  const Quadrilateral lamp = { { 343, height, 227 }, { 343, height, 332 }, { 213, height, 332 },
    { 213, height, 227 } };
  return {
    { "Floor", { { { x, 0, 0 }, { 0, 0, 0 }, { 0, 0, z }, { x, 0, z } } }, White, Dark },
    { "Ceiling", MakeCeiling(lamp), White, Dark },
    { "BackWall", { { { x, 0, z }, { 0, 0, z }, { 0, y, z }, { x, y, z } } }, White, Dark },
    { "LeftWall", { { { x, 0, 0 }, { x, 0, z }, { x, y, z }, { x, y, 0 } } }, Red, Dark },
    { "RightWall", { { { 0, 0, z }, { 0, 0, 0 }, { 0, y, 0 }, { 0, y, z } } }, Green, Dark },
    { "ShortBlock",
      Extrude({ { 130, 165, 65 }, { 82, 165, 225 }, { 240, 165, 272 }, { 290, 165, 114 } }, 0.0),
      White, Dark },
    { "TallBlock",
      Extrude({ { 423, 330, 247 }, { 265, 330, 296 }, { 314, 330, 456 }, { 472, 330, 406 } }, 0.0),
      White, Dark },
    { "Lamp", { lamp }, White, LampRadiance },
  };
}

void Fill(vtkPolyData* data, const Block& block)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quadrilaterals;
  for (const Quadrilateral& face : block.Faces)
  {
    quadrilaterals->InsertNextCell(4);
    for (const glm::dvec3& corner : face)
    {
      const glm::dvec3 point = ToRoom(corner);
      quadrilaterals->InsertCellPoint(points->InsertNextPoint(point.x, point.y, point.z));
    }
  }
  data->SetPoints(points);
  data->SetPolys(quadrilaterals);
  const glm::dvec3 color = cslf::LinearToSRGB(block.Reflectance);
  vtkCSLFMaterial::SetBaseColor(data, color.x, color.y, color.z);
  vtkCSLFMaterial::SetEmission(data, block.Emission.x, block.Emission.y, block.Emission.z);
}
}

vtkCSLFCornellBoxSource::vtkCSLFCornellBoxSource()
{
  this->SetNumberOfInputPorts(0);
}

int vtkCSLFCornellBoxSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  const std::vector<Block> blocks = MakeBlocks();
  output->SetNumberOfBlocks(static_cast<unsigned int>(blocks.size()));
  for (unsigned int i = 0; i < output->GetNumberOfBlocks(); ++i)
  {
    vtkNew<vtkPolyData> data;
    Fill(data, blocks[i]);
    output->SetBlock(i, data);
    output->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), blocks[i].Name);
  }
  return 1;
}

void vtkCSLFCornellBoxSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
