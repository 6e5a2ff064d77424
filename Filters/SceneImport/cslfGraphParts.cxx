// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorParts.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkGlyph3D.h>
#include <vtkGraph.h>
#include <vtkGraphMapper.h>
#include <vtkGraphToPolyData.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkVertexGlyphFilter.h>

namespace cslf
{
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
}
