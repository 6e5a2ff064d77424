// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points, wireframes, lines, visible edges and vertices: which ones are imported, and with which
// colours, compared with what VTK draws.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfColor.h"
#include "cslfTestWindow.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCubeSource.h>
#include <vtkDataSetMapper.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLineSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using Cells = std::vector<std::vector<vtkIdType>>;
using Color = std::array<int, 3>;
using Place = std::array<double, 2>;

constexpr Color Red = { { 255, 0, 0 } };
constexpr Color Green = { { 0, 255, 0 } };
constexpr Color Blue = { { 0, 0, 255 } };
constexpr Color Yellow = { { 255, 255, 0 } };

// The corners of a square, and a point above it.
const std::vector<Place> Corners = { { { -0.5, -0.5 } }, { { 0.5, -0.5 } }, { { 0.5, 0.5 } },
  { { -0.5, 0.5 } }, { { 0.0, 0.8 } } };

vtkSmartPointer<vtkCellArray> MakeCells(const Cells& cells)
{
  auto array = vtkSmartPointer<vtkCellArray>::New();
  for (const std::vector<vtkIdType>& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> MakeColors(const std::vector<Color>& colors)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  for (const Color& color : colors)
  {
    array->InsertNextTuple3(color[0], color[1], color[2]);
  }
  return array;
}

/// Cells between the corners.
vtkSmartPointer<vtkPolyData> MakeData(
  const Cells& vertices, const Cells& lines, const Cells& polygons, const Cells& strips = {})
{
  vtkNew<vtkPoints> points;
  for (const Place& place : Corners)
  {
    points->InsertNextPoint(place[0], place[1], 0.0);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(MakeCells(vertices));
  data->SetLines(MakeCells(lines));
  data->SetPolys(MakeCells(polygons));
  data->SetStrips(MakeCells(strips));
  return data;
}

vtkSmartPointer<vtkActor> MakeActor(vtkMapper* mapper, int representation)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetRepresentation(representation);
  actor->GetProperty()->SetPointSize(9.0);
  actor->GetProperty()->SetLineWidth(7.0);
  return actor;
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data, int representation)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  return MakeActor(mapper, representation);
}

/// The numbers of vertices, lines and faces that are imported, and of blocks.
struct Counts
{
  vtkIdType Vertices = 0;
  vtkIdType Lines = 0;
  vtkIdType Faces = 0;
  vtkIdType Blocks = 0;
};

Counts Count(vtkActor* actor)
{
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  importer->Update();
  Counts counts;
  for (unsigned int i = 0; i + 1 < importer->GetOutput()->GetNumberOfBlocks(); ++i)
  {
    auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(i));
    counts.Vertices += block->GetNumberOfVerts();
    counts.Lines += block->GetNumberOfLines();
    counts.Faces += block->GetNumberOfPolys() + block->GetNumberOfStrips();
    ++counts.Blocks;
  }
  return counts;
}

void CheckCounts(vtkActor* actor, vtkIdType vertices, vtkIdType lines, vtkIdType faces)
{
  const Counts counts = Count(actor);
  CSLF_CHECK_NEAR(counts.Vertices, vertices, 0);
  CSLF_CHECK_NEAR(counts.Lines, lines, 0);
  CSLF_CHECK_NEAR(counts.Faces, faces, 0);
}

constexpr int Size = 61;

using AddLights = std::function<void(vtkRenderer*)>;

/// Checks that window and bake have the same colours at places of [-1,1]^2, up to a few levels of
/// the sides of tubes and spheres.
void Compare(const std::string& name, vtkActor* actor, const std::vector<Place>& places = Corners,
  const AddLights& addLights = {}, int tolerance = 8)
{
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  if (addLights)
  {
    addLights(renderer);
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.0, 0.0, 10.0);
  cslf::testing::BakeOptions options;
  options.PixelSize = 0.02;
  options.Samples = 4;
  const auto pictures = cslf::testing::DrawAndTrace(renderer, Size, options);
  for (const Place& place : places)
  {
    const auto pixel = [](double x) { return static_cast<int>(0.5 * (x + 1.0) * Size); };
    const int difference = pictures.GetDifference(pixel(place[0]), pixel(place[1]));
    const int first = 3 * (Size * pixel(place[1]) + pixel(place[0]));
    const auto print = [first](const std::vector<unsigned char>& colors)
    {
      return std::to_string(colors[first]) + " " + std::to_string(colors[first + 1]) + " " +
        std::to_string(colors[first + 2]);
    };
    if (difference > tolerance)
    {
      std::cout << name << " at " << place[0] << " " << place[1] << ": window "
                << print(pictures.Window) << ", bake " << print(pictures.Bake) << "\n";
    }
    CSLF_CHECK(difference <= tolerance);
  }
}

/// Only points that cells use are drawn, each once, in the colour of the last cell that uses it.
void TestPoints()
{
  vtkNew<vtkPointSource> cloud;
  cloud->SetNumberOfPoints(50);
  cloud->Update();
  vtkNew<vtkPolyData> triangle;
  triangle->SetPoints(cloud->GetOutput()->GetPoints());
  triangle->SetPolys(MakeCells({ { 7, 20, 33 } }));
  CheckCounts(MakeActor(triangle, VTK_POINTS), 3, 0, 0);

  struct Case
  {
    const char* Name;
    vtkSmartPointer<vtkPolyData> Data;
    std::vector<Color> Colors;
    int Points;
  };
  const std::vector<Case> cases = {
    { "triangles", MakeData({}, {}, { { 0, 1, 2 }, { 0, 2, 3 } }), { Red, Green }, 4 },
    { "triangles, swapped", MakeData({}, {}, { { 0, 2, 3 }, { 0, 1, 2 } }), { Red, Green }, 4 },
    { "vertex and triangle", MakeData({ { 0 } }, {}, { { 0, 1, 2 } }), { Red, Green }, 3 },
    { "vertices", MakeData({ { 0, 1 }, { 2, 3 } }, {}, {}), { Red, Green }, 4 },
    { "polylines", MakeData({}, { { 0, 1, 2 }, { 2, 3 } }, {}), { Red, Green }, 4 },
    { "strips", MakeData({}, {}, {}, { { 0, 1, 3, 2 }, { 3, 2, 4 } }), { Red, Green }, 5 },
    { "all kinds", MakeData({ { 4 } }, { { 0, 1 } }, { { 1, 2, 3 } }, { { 3, 0, 2 } }),
      { Red, Green, Blue, Yellow }, 5 },
  };
  for (const Case& scene : cases)
  {
    scene.Data->GetCellData()->SetScalars(MakeColors(scene.Colors));
    const vtkSmartPointer<vtkActor> actor = MakeActor(scene.Data, VTK_POINTS);
    CheckCounts(actor, scene.Points, 0, 0);
    Compare(scene.Name, actor);
  }
  const vtkSmartPointer<vtkActor> spheres = MakeActor(cases.back().Data, VTK_POINTS);
  spheres->GetProperty()->RenderPointsAsSpheresOn();
  Compare("spheres", spheres);
}

/// A cube whose faces have their own points and colours: what is drawn last is seen.
void TestSharedPlaces()
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  vtkPolyData* data = cube->GetOutput();
  data->GetPointData()->SetNormals(nullptr);
  data->GetCellData()->SetScalars(MakeColors({ Red, Green, Blue, Yellow, Red, Green }));
  const vtkSmartPointer<vtkActor> points = MakeActor(data, VTK_POINTS);
  CheckCounts(points, 8, 0, 0);
  Compare("points of a cube", points);
  CheckCounts(MakeActor(data, VTK_WIREFRAME), 0, 12, 0);
}

void TestWireframe()
{
  // A tube of 8 strips of 20 triangles.
  vtkNew<vtkLineSource> line;
  line->SetResolution(10);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputConnection(line->GetOutputPort());
  tube->SetNumberOfSides(8);
  tube->Update();
  CSLF_CHECK(tube->GetOutput()->GetNumberOfStrips() == 8);
  CheckCounts(MakeActor(tube->GetOutput(), VTK_WIREFRAME), 0, 248, 0);
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(sphere->GetOutputPort());
  stripper->Update();
  CheckCounts(MakeActor(stripper->GetOutput(), VTK_WIREFRAME), 0, 144, 0);

  // The middles of edges and lines, and the vertex.
  const std::vector<Place> places = { { { 0.0, -0.5 } }, { { 0.0, 0.5 } }, { { 0.0, 0.8 } },
    { { 0.0, 0.0 } } };
  struct Case
  {
    const char* Name;
    vtkSmartPointer<vtkPolyData> Data;
    std::vector<Color> Colors;
    int Vertices;
    int Lines;
  };
  const std::vector<Case> cases = {
    { "polylines", MakeData({}, { { 0, 1, 2 }, { 2, 3 } }, {}), { Red, Green }, 0, 3 },
    { "vertices", MakeData({ { 0, 4 }, { 2 } }, {}, {}), { Red, Green }, 2, 0 },
    { "quad", MakeData({}, {}, { { 0, 1, 2, 3 } }), { Red }, 0, 4 },
    { "triangles", MakeData({}, {}, { { 0, 1, 2 }, { 0, 2, 3 } }), { Red, Green }, 0, 5 },
    { "strip", MakeData({}, {}, {}, { { 0, 1, 3, 2 } }), { Red }, 0, 5 },
    { "all kinds", MakeData({ { 4 } }, { { 3, 2 } }, { { 0, 1, 2 } }), { Red, Green, Blue }, 1, 4 },
    { "line on an edge", MakeData({}, { { 0, 1 } }, { { 0, 1, 2 } }), { Red, Green }, 0, 3 },
    { "polygon of two corners", MakeData({}, {}, { { 0, 1 } }), { Red }, 0, 1 },
  };
  for (const Case& scene : cases)
  {
    scene.Data->GetCellData()->SetScalars(MakeColors(scene.Colors));
    const vtkSmartPointer<vtkActor> actor = MakeActor(scene.Data, VTK_WIREFRAME);
    CheckCounts(actor, scene.Vertices, scene.Lines, 0);
    Compare(scene.Name, actor, places);
  }
}

/// Edges are those of all triangles of strips, but not lines; vertices are drawn over all points,
/// except where the data has vertices of its own.
void TestDecoration()
{
  const vtkSmartPointer<vtkPolyData> data =
    MakeData({ { 4 } }, { { 3, 4 } }, { { 0, 1, 2 } }, { { 0, 2, 3 } });
  const vtkSmartPointer<vtkActor> actor = MakeActor(data, VTK_SURFACE);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(0.5, 0.5, 0.5);
  property->SetEdgeColor(0.0, 1.0, 1.0);
  property->SetVertexColor(1.0, 1.0, 0.0);
  property->EdgeVisibilityOn();
  CheckCounts(actor, 1, 1 + 5, 2);
  property->VertexVisibilityOn();
  CheckCounts(actor, 1 + 4, 1 + 5, 2);
  // The line covers the vertex at its other end in the window.
  const std::vector<Place> places = { Corners[0], Corners[1], Corners[2], Corners[4] };
  Compare("visible edges and vertices", actor, places);
  property->SetDiffuse(0.5);
  property->RenderPointsAsSpheresOn();
  Compare("visible vertices as spheres", actor, { Corners[0], Corners[1], Corners[2] });

  // Without visible edges, only newer versions of VTK draw vertices.
  property->EdgeVisibilityOff();
  const int shown = cslf::VerticesNeedEdges ? 0 : 4;
  CheckCounts(actor, 1 + shown, 1, 2);
  property->SetRepresentationToWireframe();
  CheckCounts(actor, 1 + shown, 1 + 5, 0);
}

AddLights MakeHeadlight(double intensity)
{
  return [intensity](vtkRenderer* renderer)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
}

/// Cells with a colour of the property, of cells, or of points' numbers, which are interpolated
/// before they are mapped.
enum class Scalars
{
  None,
  OfCells,
  Numbers
};

vtkSmartPointer<vtkActor> MakeColored(vtkPolyData* shape, Scalars scalars, int representation)
{
  vtkNew<vtkPolyData> data;
  data->ShallowCopy(shape);
  const vtkSmartPointer<vtkActor> actor = MakeActor(data, representation);
  const Color color = { { 200, 120, 40 } };
  if (scalars == Scalars::OfCells)
  {
    data->GetCellData()->SetScalars(
      MakeColors(std::vector<Color>(data->GetNumberOfCells(), color)));
  }
  if (scalars == Scalars::Numbers)
  {
    vtkNew<vtkFloatArray> numbers;
    numbers->SetNumberOfTuples(data->GetNumberOfPoints());
    numbers->FillValue(0.3f);
    data->GetPointData()->SetScalars(numbers);
    actor->GetMapper()->InterpolateScalarsBeforeMappingOn();
  }
  actor->GetProperty()->SetColor(128.0 / 255.0, 64.0 / 255.0, 0.0);
  return actor;
}

/// Lines and points without normals are drawn in their colours, whatever the lights. Here they face
/// a light that is bright enough, or shine where the window uses no lights.
void TestUnlit()
{
  struct Case
  {
    const char* Name;
    vtkSmartPointer<vtkPolyData> Data;
    int Representation;
    Place Looked;
  };
  const Place middle = { { 0.0, -0.5 } };
  const std::vector<Case> cases = {
    { "line", MakeData({}, { { 0, 1 }, { 2, 3 } }, {}), VTK_SURFACE, middle },
    { "vertex", MakeData({ { 0, 2 } }, {}, {}), VTK_SURFACE, Corners[0] },
    { "points", MakeData({}, {}, { { 0, 1, 2 } }), VTK_POINTS, Corners[0] },
    { "line in a wireframe", MakeData({}, { { 0, 1 } }, { { 1, 2, 3 } }), VTK_WIREFRAME, middle },
    { "line beside a face", MakeData({}, { { 0, 1 } }, { { 1, 2, 3 } }), VTK_SURFACE, middle },
    { "face beside a line", MakeData({}, { { 0, 1 } }, { { 1, 2, 3 } }), VTK_SURFACE,
      { { 0.3, 0.3 } } },
  };
  struct Terms
  {
    const char* Name;
    double Ambient;
    double Diffuse;
    bool Lighting;
    int Interpolation;
    AddLights Lights;
  };
  const AddLights none = [](vtkRenderer* renderer) { renderer->AutomaticLightCreationOff(); };
  const std::vector<Terms> terms = {
    { "some ambient", 0.3, 0.7, true, VTK_GOURAUD, MakeHeadlight(1.0) },
    { "half of the light and colour", 0.1, 0.4, true, VTK_GOURAUD, MakeHeadlight(0.5) },
    { "less light than colour", 0.0, 1.0, true, VTK_GOURAUD, MakeHeadlight(0.3) },
    { "no lighting, some ambient", 0.2, 0.7, false, VTK_FLAT, MakeHeadlight(0.3) },
    { "no lights", 0.2, 0.7, true, VTK_GOURAUD, none },
  };
  for (const Case& shape : cases)
  {
    for (const Terms& look : terms)
    {
      for (const Scalars scalars : { Scalars::None, Scalars::OfCells, Scalars::Numbers })
      {
        const vtkSmartPointer<vtkActor> actor =
          MakeColored(shape.Data, scalars, shape.Representation);
        actor->GetProperty()->SetAmbient(look.Ambient);
        actor->GetProperty()->SetDiffuse(look.Diffuse);
        actor->GetProperty()->SetLighting(look.Lighting);
        actor->GetProperty()->SetInterpolation(look.Interpolation);
        Compare(std::string(shape.Name) + ", " + look.Name + ", scalars " +
            std::to_string(static_cast<int>(scalars)),
          actor, { shape.Looked }, look.Lights, 4);
      }
    }
  }
}

/// Textures on lines and points: those of the actor, and those of PBR, which needs lights.
void TestTextures()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 1, 1);
  image->GetPointData()->SetScalars(
    MakeColors({ { { 200, 100, 40 } }, { { 40, 100, 200 } }, Yellow, Green }));
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  vtkNew<vtkTexture> physical;
  physical->SetInputData(image);
  physical->UseSRGBColorSpaceOn();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (const Place& place : Corners)
  {
    coordinates->InsertNextTuple2(place[0] + 0.5, 0.5);
  }
  const vtkSmartPointer<vtkPolyData> data = MakeData({ { 4 } }, { { 0, 1 } }, {});
  data->GetPointData()->SetTCoords(coordinates);
  for (const int interpolation : { VTK_GOURAUD, VTK_PBR })
  {
    for (const bool lighting : { true, false })
    {
      const vtkSmartPointer<vtkActor> actor = MakeActor(data, VTK_SURFACE);
      vtkProperty* property = actor->GetProperty();
      property->SetColor(0.5, 0.4, 0.3);
      property->SetInterpolation(interpolation);
      property->SetLighting(lighting);
      const std::string name = std::to_string(interpolation) + (lighting ? ", lit" : ", unlit");
      if (interpolation == VTK_PBR)
      {
        property->SetBaseColorTexture(physical);
        Compare("texture of PBR " + name, actor, { { { -0.15, -0.5 } } }, MakeHeadlight(1.0), 4);
        property->RemoveAllTextures();
      }
      actor->SetTexture(texture);
      Compare("texture of the actor " + name, actor, { { { -0.15, -0.5 } }, { { 0.15, -0.5 } } },
        MakeHeadlight(1.0), 4);
    }
  }
}

/// The material of lines whose property has no lighting, in numbers.
void TestEmissionOfLines()
{
  const vtkSmartPointer<vtkPolyData> lines = MakeData({}, { { 0, 1 } }, {});
  for (const Scalars scalars : { Scalars::None, Scalars::OfCells })
  {
    const vtkSmartPointer<vtkActor> actor = MakeColored(lines, scalars, VTK_SURFACE);
    actor->GetProperty()->LightingOff();
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    vtkNew<vtkCSLFSceneImporter> importer;
    importer->SetRenderer(renderer);
    importer->Update();
    vtkDataObject* block = importer->GetOutput()->GetBlock(0);
    double base[3];
    double emission[3];
    vtkCSLFMaterial::GetBaseColor(block, base);
    vtkCSLFMaterial::GetEmission(block, emission);
    CSLF_CHECK_NEAR(base[0], 0.0, 1e-9);
    CSLF_CHECK_NEAR(emission[0], cslf::SRGBToLinear(128.0 / 255.0), 1e-6);
    vtkCellData* data = vtkPolyData::SafeDownCast(block)->GetCellData();
    vtkDataArray* ofCells = data->GetArray(vtkCSLFMaterial::EmissionName());
    CSLF_CHECK((ofCells != nullptr) == (scalars == Scalars::OfCells));
    if (ofCells)
    {
      CSLF_CHECK_NEAR(ofCells->GetComponent(0, 0), cslf::SRGBToLinear(200.0 / 255.0), 1e-6);
      CSLF_CHECK_NEAR(data->GetScalars()->GetComponent(0, 0), 0.0, 0.0);
    }
  }
}

/// Flags of points hide edges of polygons, but not of strips.
void TestEdgeFlags()
{
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("Flags");
  for (const int flag : { 1, 0, 1, 0, 1 })
  {
    flags->InsertNextValue(static_cast<unsigned char>(flag));
  }
  const vtkSmartPointer<vtkPolyData> quad = MakeData({}, {}, { { 0, 1, 2, 3 } });
  quad->GetPointData()->SetAttribute(flags, vtkDataSetAttributes::EDGEFLAG);
  const vtkSmartPointer<vtkActor> actor = MakeActor(quad, VTK_WIREFRAME);
  CheckCounts(actor, 0, 2, 0);
  Compare("flagged edges", actor, { { { 0.0, -0.5 } }, { { 0.0, 0.5 } } });
  actor->GetProperty()->SetRepresentationToSurface();
  actor->GetProperty()->EdgeVisibilityOn();
  CheckCounts(actor, 0, 2, 1);
  const vtkSmartPointer<vtkPolyData> strip = MakeData({}, {}, {}, { { 0, 1, 3, 2 } });
  strip->GetPointData()->SetAttribute(flags, vtkDataSetAttributes::EDGEFLAG);
  CheckCounts(MakeActor(strip, VTK_WIREFRAME), 0, 5, 0);
}

/// Sources of glyphs, blocks, and surfaces of grids.
void TestMappers()
{
  vtkNew<vtkPolyData> origin;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  origin->SetPoints(points);
  const vtkSmartPointer<vtkPolyData> source =
    MakeData({ { 4 } }, { { 3, 2 } }, {}, { { 0, 1, 2 } });
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(origin);
  glyphs->SetSourceData(source);
  const vtkSmartPointer<vtkActor> ofPoints = MakeActor(glyphs, VTK_POINTS);
  ofPoints->GetProperty()->SetColor(1.0, 0.5, 0.0);
  CheckCounts(ofPoints, 5, 0, 0);
  Compare("points of a glyph", ofPoints);
  ofPoints->GetProperty()->SetRepresentationToWireframe();
  CheckCounts(ofPoints, 1, 4, 0);

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeData({}, {}, { { 0, 1, 2 } }));
  blocks->SetBlock(1, MakeData({ { 4 } }, { { 3, 2 } }, {}));
  vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetCellData()->SetScalars(MakeColors({ Red }));
  vtkPolyData::SafeDownCast(blocks->GetBlock(1))
    ->GetCellData()
    ->SetScalars(MakeColors({ Green, Blue }));
  vtkNew<cslf::CompositeMapper> composite;
  composite->SetInputDataObject(blocks);
  const vtkSmartPointer<vtkActor> ofBlocks = MakeActor(composite, VTK_WIREFRAME);
  CheckCounts(ofBlocks, 1, 4, 0);
  Compare("wireframe of blocks", ofBlocks, { { { 0.0, -0.5 } }, { { 0.0, 0.5 } }, Corners[4] });

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(source->GetPoints());
  const vtkIdType quad[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_TRIANGLE, 3, quad);
  grid->InsertNextCell(VTK_LINE, 2, quad + 2);
  grid->GetCellData()->SetScalars(MakeColors({ Red, Green }));
  vtkNew<vtkDataSetMapper> ofGrid;
  ofGrid->SetInputData(grid);
  CheckCounts(MakeActor(ofGrid, VTK_POINTS), 4, 0, 0);
  Compare("points of a grid", MakeActor(ofGrid, VTK_POINTS));
}
}

int TestCSLFSceneImporterRepresentation(int, char*[])
{
  TestPoints();
  TestSharedPlaces();
  TestWireframe();
  TestDecoration();
  TestUnlit();
  TestTextures();
  TestEmissionOfLines();
  TestEdgeFlags();
  TestMappers();
  return cslf::testing::Result();
}
