// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorParts.h"

#include "Pipeline/cslfArrayLayout.h"

#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3D.h>
#include <vtkGraph.h>
#include <vtkGraphMapper.h>
#include <vtkGraphToPolyData.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVertexGlyphFilter.h>

namespace cslf
{
namespace
{
/// Copies the points of all cells of an array, and appends the cells' normals, the first of which
/// is that of cell `firstCell`.
vtkSmartPointer<vtkCellArray> SpreadCells(vtkCellArray* cells, vtkIdType firstCell,
  vtkPolyData* block, vtkPolyData* spread, vtkDataArray* normals)
{
  auto result = vtkSmartPointer<vtkCellArray>::New();
  vtkDataArray* cellNormals = block->GetCellData()->GetNormals();
  vtkPointData* data = spread->GetPointData();
  const auto all = KeepNumeric(block->GetPointData());
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cells->GetCellAtId(i, count, corners);
    result->InsertNextCell(static_cast<int>(count));
    for (vtkIdType c = 0; c < count; ++c)
    {
      const vtkIdType point = spread->GetPoints()->InsertNextPoint(block->GetPoint(corners[c]));
      result->InsertCellPoint(point);
      data->CopyData(all, corners[c], point);
      normals->InsertTuple(point, firstCell + i, cellNormals);
    }
  }
  return result;
}
}

vtkSmartPointer<vtkPolyData> SpreadCellNormals(vtkPolyData* block)
{
  vtkDataArray* cellNormals = block->GetCellData()->GetNormals();
  if (!cellNormals || cellNormals->GetNumberOfTuples() != block->GetNumberOfCells() ||
    block->GetPointData()->GetNormals() ||
    block->GetNumberOfPolys() + block->GetNumberOfStrips() == 0)
  {
    return block;
  }
  auto spread = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(block->GetPoints()->GetDataType());
  spread->SetPoints(points);
  spread->GetPointData()->CopyAllocate(KeepNumeric(block->GetPointData()));
  auto normals = vtk::TakeSmartPointer(cellNormals->NewInstance());
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  vtkIdType firstCell = 0;
  const auto next = [&](vtkCellArray* cells)
  {
    auto result = SpreadCells(cells, firstCell, block, spread, normals);
    firstCell += cells->GetNumberOfCells();
    return result;
  };
  spread->SetVerts(next(block->GetVerts()));
  spread->SetLines(next(block->GetLines()));
  spread->SetPolys(next(block->GetPolys()));
  spread->SetStrips(next(block->GetStrips()));
  spread->GetPointData()->SetNormals(normals);
  spread->GetCellData()->ShallowCopy(block->GetCellData());
  spread->GetCellData()->SetNormals(nullptr);
  spread->SetFieldData(block->GetFieldData());
  return spread;
}

namespace
{
/// vtkGraphMapper draws its edges a little behind its vertices.
constexpr double EdgeDepth = -0.003;

/// The sides of the circles of scaled vertices.
constexpr int CircleSides = 16;

/// vtkGraphMapper shows only to subclasses whether vertices are circles of different sizes. (Its
/// GetScaledGlyphs is always false.)
class GraphAccess : public vtkGraphMapper
{
public:
  static bool HasScaledGlyphs(vtkGraphMapper* mapper)
  {
    vtkPolyDataMapper* vertices = mapper->*(&GraphAccess::VertexMapper);
    return vtkGlyph3D::SafeDownCast(vertices->GetInputAlgorithm()) != nullptr;
  }
};

/// A part as vtkGraphMapper draws it, without its actor's matrix and property.
ActorPart MakeGraphPart(vtkPolyDataMapper* mapper, double depth)
{
  ActorPart part;
  part.Actor = vtkSmartPointer<vtkActor>::New();
  part.Actor->SetMapper(mapper);
  part.Matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  part.Matrix->SetElement(2, 3, depth);
  return part;
}

/// Colours data by the array of a name, or else by its scalars, over the full range of values.
void SetColors(
  vtkPolyDataMapper* mapper, vtkDataSetAttributes* data, const char* name, vtkLookupTable* table)
{
  vtkDataArray* values = name ? data->GetArray(name) : nullptr;
  values = values ? values : data->GetScalars();
  mapper->SetScalarVisibility(values != nullptr);
  if (values)
  {
    double range[2];
    values->GetRange(range);
    mapper->SelectColorArray(name);
    mapper->SetScalarRange(range);
    mapper->SetLookupTable(table);
  }
}

vtkSmartPointer<vtkPolyDataMapper> MakeEdges(vtkGraphMapper* graph, vtkGraph* data)
{
  vtkNew<vtkGraphToPolyData> edges;
  edges->SetInputData(data);
  edges->Update();
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(edges->GetOutput());
  mapper->SetScalarModeToUseCellFieldData();
  mapper->ScalarVisibilityOff();
  if (graph->GetColorEdges())
  {
    SetColors(mapper, edges->GetOutput()->GetCellData(), graph->GetEdgeColorArrayName(),
      graph->GetEdgeLookupTable());
  }
  return mapper;
}

/// The vertices as points of some pixels, or as circles with the sizes in an array.
vtkSmartPointer<vtkPolyDataMapper> MakeVertices(vtkGraphMapper* graph, vtkGraph* data)
{
  vtkNew<vtkVertexGlyphFilter> vertices;
  vertices->SetInputData(data);
  vertices->Update();
  vtkSmartPointer<vtkPolyData> shapes = vertices->GetOutput();
  if (GraphAccess::HasScaledGlyphs(graph) && graph->GetScalingArrayName())
  {
    vtkNew<vtkRegularPolygonSource> circle;
    circle->SetNumberOfSides(CircleSides);
    circle->GeneratePolylineOff();
    vtkNew<vtkGlyph3D> circles;
    circles->SetSourceConnection(circle->GetOutputPort());
    circles->SetInputData(shapes);
    circles->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, graph->GetScalingArrayName());
    circles->Update();
    shapes = circles->GetOutput();
  }
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(shapes);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->ScalarVisibilityOff();
  if (graph->GetColorVertices())
  {
    SetColors(mapper, shapes->GetPointData(), graph->GetVertexColorArrayName(),
      graph->GetVertexLookupTable());
  }
  return mapper;
}
}

ActorParts TakeGraphApart(vtkGraphMapper* mapper, ImportedScene& scene)
{
  ActorParts parts;
  auto* data = vtkGraph::SafeDownCast(mapper->GetInputDataObject(0, 0));
  if (!data || data->GetNumberOfVertices() == 0)
  {
    return parts;
  }
  if (mapper->GetEdgeVisibility() && data->GetNumberOfEdges() > 0)
  {
    parts.push_back(MakeGraphPart(MakeEdges(mapper, data), EdgeDepth));
    parts.back().Actor->GetProperty()->SetLineWidth(mapper->GetEdgeLineWidth());
  }
  parts.push_back(MakeGraphPart(MakeVertices(mapper, data), 0.0));
  parts.back().Actor->GetProperty()->SetPointSize(mapper->GetVertexPointSize());
  if (mapper->GetIconVisibility())
  {
    scene.Meet(ImportLimit::GraphIcons);
  }
  return parts;
}

namespace
{
vtkSmartPointer<vtkDoubleArray> MakeRadii(const char* name, vtkIdType count)
{
  auto radii = vtkSmartPointer<vtkDoubleArray>::New();
  radii->SetName(name);
  radii->SetNumberOfTuples(count);
  return radii;
}
}

std::optional<ActorParts> TakeApart(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  vtkMapper* mapper = actor->GetMapper();
  if (mapper->IsA("vtkMoleculeMapper"))
  {
    return TakeMoleculeApart(actor, mapper, matrix, scene);
  }
  if (auto* graph = vtkGraphMapper::SafeDownCast(mapper))
  {
    return TakeGraphApart(graph, scene);
  }
  if (auto* splats = vtkPointGaussianMapper::SafeDownCast(mapper))
  {
    return TakeSplatsApart(actor, splats, matrix, scene);
  }
  auto* shapes = vtkPolyDataMapper::SafeDownCast(mapper);
  if (shapes && shapes->IsA("vtkOpenGLSphereMapper"))
  {
    return TakeSpheresApart(actor, shapes, matrix, scene);
  }
  if (shapes && shapes->IsA("vtkOpenGLStickMapper"))
  {
    return TakeSticksApart(actor, shapes, matrix, scene);
  }
  return std::nullopt;
}

vtkSmartPointer<vtkProperty> CopyProperty(vtkProperty* property)
{
  auto copy = vtkSmartPointer<vtkProperty>::New();
  copy->DeepCopy(property);
  copy->SetEmissiveFactor(property->GetEmissiveFactor());
  copy->GetAllTextures().clear(); // it has not been registered as their user
  for (const auto& [name, texture] : property->GetAllTextures())
  {
    copy->SetTexture(name.c_str(), texture);
  }
  return copy;
}

ActorPart MakePart(vtkPolyData* data, vtkActor* whole, vtkMatrix4x4* matrix)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  ActorPart part;
  part.Actor = vtkSmartPointer<vtkActor>::New();
  part.Actor->SetMapper(mapper);
  part.Actor->SetProperty(CopyProperty(whole->GetProperty()));
  part.Actor->GetProperty()->SetRepresentationToSurface();
  part.Actor->GetProperty()->EdgeVisibilityOff();
  part.Actor->GetProperty()->VertexVisibilityOff();
  part.Actor->SetTexture(whole->GetTexture());
  part.Matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  part.Matrix->DeepCopy(matrix ? matrix : whole->GetMatrix());
  return part;
}

vtkSmartPointer<vtkPolyData> MakeSpheres(
  vtkPoints* points, vtkDataArray* radii, vtkUnsignedCharArray* colors)
{
  auto spheres = vtkSmartPointer<vtkPolyData>::New();
  spheres->SetPoints(points);
  vtkNew<vtkCellArray> vertices;
  const vtkSmartPointer<vtkDoubleArray> ofPoints =
    MakeRadii(vtkCSLFMaterial::PointRadiusName(), points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
    ofPoints->SetValue(i, radii->GetComponent(i, 0));
  }
  spheres->SetVerts(vertices);
  spheres->GetPointData()->AddArray(ofPoints);
  spheres->GetPointData()->SetScalars(colors);
  return spheres;
}

vtkSmartPointer<vtkPolyData> MakeSticks(
  vtkPoints* centers, vtkDataArray* scales, vtkDataArray* directions, vtkUnsignedCharArray* colors)
{
  const vtkIdType count = centers->GetNumberOfPoints();
  vtkNew<vtkPoints> ends;
  ends->SetDataTypeToDouble();
  ends->SetNumberOfPoints(2 * count);
  vtkNew<vtkCellArray> lines;
  const vtkSmartPointer<vtkDoubleArray> radii =
    MakeRadii(vtkCSLFMaterial::LineRadiusName(), 2 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double center[3];
    centers->GetPoint(i, center);
    const vtkIdType line[2] = { 2 * i, 2 * i + 1 };
    for (int end = 0; end < 2; ++end)
    {
      const double along = (end == 0 ? -0.5 : 0.5) * scales->GetComponent(i, 0);
      ends->SetPoint(line[end], center[0] + along * directions->GetComponent(i, 0),
        center[1] + along * directions->GetComponent(i, 1),
        center[2] + along * directions->GetComponent(i, 2));
      radii->SetValue(line[end], scales->GetComponent(i, 1));
    }
    lines->InsertNextCell(2, line);
  }
  auto sticks = vtkSmartPointer<vtkPolyData>::New();
  sticks->SetPoints(ends);
  sticks->SetLines(lines);
  sticks->GetPointData()->AddArray(radii);
  sticks->GetCellData()->SetScalars(colors);
  return sticks;
}
}
