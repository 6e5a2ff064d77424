// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Mappers that draw other shapes than their input's polygons: the shapes are imported, and a
// warning names props that are not.
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfTestShapes.h"
#include "cslfTesting.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSceneImporter.h"

#include <vtkAMRBox.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkGraphMapper.h>
#include <vtkIntArray.h>
#include <vtkLODProp3D.h>
#include <vtkLookupTable.h>
#include <vtkMassProperties.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMutableUndirectedGraph.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkOpenGLStickMapper.h>
#include <vtkOverlappingAMR.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkStructuredData.h>
#include <vtkTestErrorObserver.h>
#include <vtkTriangleFilter.h>
#include <vtkUniformGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>

#ifdef CSLF_TEST_MOLECULES
#include <vtkMolecule.h>
#include <vtkOpenGLMoleculeMapper.h>
#endif

#include <cmath>
#include <iostream>
#include <limits>
#include <string>

namespace
{
using cslf::testing::ShapeComparison;

/// The scene of a renderer as data, and the warning.
struct Import
{
  explicit Import(vtkRenderer* renderer)
  {
    vtkNew<vtkTest::ErrorObserver> messages;
    this->Filter->AddObserver(vtkCommand::WarningEvent, messages);
    this->Filter->SetRenderer(renderer);
    this->Filter->Update();
    this->Warning = messages->GetWarningMessage();
  }

  /// How many blocks there are besides that of the lights.
  unsigned int GetCount() const { return this->Filter->GetOutput()->GetNumberOfBlocks() - 1; }

  vtkPolyData* Get(unsigned int block) const
  {
    return vtkPolyData::SafeDownCast(this->Filter->GetOutput()->GetBlock(block));
  }

  bool Warns(const char* of) const { return this->Warning.find(of) != std::string::npos; }

  vtkNew<vtkCSLFSceneImporter> Filter;
  std::string Warning;
};

/// Compares the window with the traced picture.
void CheckPicture(ShapeComparison& window, const char* name, double limit)
{
  const double share = window.Compare();
  std::cout << name << ": " << window.Covered << " pixels drawn, " << 100.0 * share
            << " % of them traced differently\n";
  CSLF_CHECK(window.Covered > 50 && share < limit);
}

#ifdef CSLF_TEST_MOLECULES
void TestMolecules(ShapeComparison& window)
{
  // One atom: one sphere, whose radius is the atom's times the factor.
  vtkNew<vtkMolecule> molecule;
  vtkAtom carbon = molecule->AppendAtom(6, -0.5, 0.0, 0.0);
  vtkNew<vtkOpenGLMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->SetAtomicRadiusTypeToUnitRadius();
  mapper->SetAtomicRadiusScaleFactor(0.3f);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.ShowOnly(actor);
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.Warning.empty() && import.GetCount() == 1);
    CSLF_CHECK(import.Get(0)->GetNumberOfVerts() == 1);
    vtkDataArray* radii =
      import.Get(0)->GetPointData()->GetArray(vtkCSLFMaterial::PointRadiusName());
    CSLF_CHECK(radii && radii->GetNumberOfTuples() == 1);
    CSLF_CHECK_NEAR(radii ? radii->GetComponent(0, 0) : 0.0, 0.3, 1e-6);
  }
  CheckPicture(window, "An atom", 0.1);

  // Bonds of one, two and three cylinders, in all modes.
  vtkAtom oxygen = molecule->AppendAtom(8, 0.5, 0.0, 0.0);
  vtkAtom nitrogen = molecule->AppendAtom(7, -0.5, -0.7, 0.0);
  vtkAtom sulphur = molecule->AppendAtom(16, 0.3, 0.7, 0.0);
  molecule->AppendBond(carbon, oxygen, 2);
  molecule->AppendBond(carbon, nitrogen, 3);
  molecule->AppendBond(oxygen, sulphur, 1);
  mapper->UseBallAndStickSettings();
  mapper->SetAtomicRadiusScaleFactor(0.15f);
  mapper->SetBondRadius(0.05f);
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.GetCount() == 2 && import.Get(0)->GetNumberOfVerts() == 4);
    CSLF_CHECK(import.Get(1)->GetNumberOfLines() == 12); // halves of their atoms' colours
  }
  CheckPicture(window, "Balls and sticks", 0.12);
  mapper->UseLiquoriceStickSettings();
  CheckPicture(window, "Sticks", 0.12);
  mapper->UseVDWSpheresSettings();
  mapper->SetAtomicRadiusScaleFactor(0.3f);
  CheckPicture(window, "Spheres of van der Waals", 0.12);
  mapper->UseFastSettings();
  mapper->SetAtomicRadiusScaleFactor(0.2f);
  CheckPicture(window, "Fast settings", 0.12);
  mapper->SetAtomColorMode(vtkMoleculeMapper::SingleColor);
  mapper->SetAtomColor(200, 20, 20);
  mapper->SetAtomicRadiusTypeToCovalentRadius();
  CheckPicture(window, "One colour", 0.2); // some are as dark as the background
  mapper->RenderAtomsOff();
  CheckPicture(window, "Without atoms", 0.35); // the ends of the bonds are round
  mapper->RenderAtomsOn();
  mapper->RenderBondsOff();
  CheckPicture(window, "Without bonds", 0.12);

  // With a transform and a scale.
  mapper->UseBallAndStickSettings();
  mapper->SetAtomicRadiusScaleFactor(0.15f);
  mapper->SetBondRadius(0.05f);
  actor->SetPosition(0.1, 0.1, 0.0);
  actor->RotateZ(40.0);
  CheckPicture(window, "Placed", 0.12);
  mapper->RenderBondsOff();
  actor->SetScale(0.6); // which moves atoms, but does not scale them
  CheckPicture(window, "Scaled", 0.12);
  mapper->RenderBondsOn();

  // The lattice.
  molecule->SetLattice({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.GetCount() == 3 && import.Get(2)->GetNumberOfLines() == 12);
  }
}
#endif

void TestGraphs(ShapeComparison& window)
{
  vtkNew<vtkMutableUndirectedGraph> graph;
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> weights;
  weights->SetName("weight");
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("sizes");
  for (int i = 0; i < 4; ++i)
  {
    graph->AddVertex();
    points->InsertNextPoint(i % 2 - 0.5, i / 2 - 0.5, 0.0);
    sizes->InsertNextValue(0.2 + 0.1 * i);
  }
  graph->SetPoints(points);
  for (int i = 0; i < 3; ++i)
  {
    graph->AddEdge(i, i + 1);
    weights->InsertNextValue(i);
  }
  graph->GetEdgeData()->AddArray(weights);
  graph->GetVertexData()->AddArray(sizes);
  vtkNew<vtkGraphMapper> mapper;
  mapper->SetInputData(graph);
  mapper->SetEdgeLineWidth(3.0f);
  mapper->SetVertexPointSize(9.0f);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.ShowOnly(actor);
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.Warning.empty() && import.GetCount() == 2);
    CSLF_CHECK(import.Get(0)->GetNumberOfLines() == 3 && import.Get(1)->GetNumberOfVerts() == 4);
    CSLF_CHECK(import.Get(0)->GetCellData()->GetScalars() == nullptr);
    const double line = vtkCSLFMaterial::GetLineRadius(import.Get(0));
    CSLF_CHECK_NEAR(vtkCSLFMaterial::GetPointRadius(import.Get(1)), 3.0 * line, 1e-9);
  }
  mapper->ColorEdgesOn();
  mapper->SetEdgeColorArrayName("weight");
  mapper->SetScalingArrayName("sizes");
  mapper->ScaledGlyphsOn();
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.GetCount() == 2 && import.Get(1)->GetNumberOfPolys() == 4);
    vtkDataArray* colors = import.Get(0)->GetCellData()->GetScalars();
    CSLF_CHECK(colors && colors->GetNumberOfTuples() == 3 &&
      colors->GetComponent(0, 0) != colors->GetComponent(2, 0));
  }
  mapper->SetEdgeLineWidth(1.0f);
  CheckPicture(window, "A graph", 0.25); // lines of pixels are thinner in the world, rims are not
  mapper->EdgeVisibilityOff();
  CSLF_CHECK(Import(window.Renderer).GetCount() == 1);
}

/// Points without cells, with sizes, directions and colours.
vtkSmartPointer<vtkPolyData> MakePoints()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> sizes;
  sizes->SetName("Sizes");
  vtkNew<vtkFloatArray> sticks;
  sticks->SetName("Sticks");
  sticks->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> directions;
  directions->SetName("Directions");
  directions->SetNumberOfComponents(3);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(4);
  for (int i = 0; i < 3; ++i)
  {
    points->InsertNextPoint(0.6 * (i - 1), 0.3 * i - 0.3, 0.0);
    sizes->InsertNextValue(0.1f + 0.05f * i);
    sticks->InsertNextTuple3(0.6, 0.1, 0.1);
    directions->InsertNextTuple3(i == 0 ? 0.0 : 0.6, i == 0 ? 1.0 : 0.8, 0.0);
    colors->InsertNextTuple4(i == 0 ? 255 : 0, i == 1 ? 255 : 0, i == 2 ? 255 : 0, 255);
  }
  data->SetPoints(points);
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(sizes),
         static_cast<vtkDataArray*>(sticks), static_cast<vtkDataArray*>(directions) })
  {
    data->GetPointData()->AddArray(array);
  }
  data->GetPointData()->SetScalars(colors);
  return data;
}

void TestPointMappers(ShapeComparison& window)
{
  const vtkSmartPointer<vtkPolyData> data = MakePoints();
  vtkNew<vtkActor> actor;
  vtkNew<vtkPointGaussianMapper> splats;
  splats->SetInputData(data);
  splats->SetScaleArray("Sizes");
  splats->SetScaleFactor(0.5);
  actor->SetMapper(splats);
  window.ShowOnly(actor);
  {
    const Import import(window.Renderer);
    CSLF_CHECK(import.Warns("splats") && import.GetCount() == 1);
    CSLF_CHECK(import.Get(0)->GetNumberOfVerts() == 3);
    vtkDataArray* radii =
      import.Get(0)->GetPointData()->GetArray(vtkCSLFMaterial::PointRadiusName());
    CSLF_CHECK_NEAR(radii->GetComponent(2, 0), 0.1, 1e-6);
    vtkDataArray* emission =
      import.Get(0)->GetPointData()->GetArray(vtkCSLFMaterial::EmissionName());
    CSLF_CHECK(emission && emission->GetComponent(1, 1) == 1.0); // they are drawn without lights
  }
  splats->SetScaleFactor(0.0); // points of some pixels
  actor->GetProperty()->SetPointSize(8.0);
  {
    const Import import(window.Renderer);
    CSLF_CHECK(!import.Warns("splats") && import.GetCount() == 1);
    CSLF_CHECK(!import.Get(0)->GetPointData()->HasArray(vtkCSLFMaterial::PointRadiusName()));
    CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(import.Get(0)) > 0.0);
    // Another radius, or none, which the path tracer then takes from the spacing.
    import.Filter->SetPointRadius(0.25);
    import.Filter->Update();
    CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(import.Get(0)) == 0.25);
    import.Filter->SetPointRadiusFromSpacing();
    import.Filter->Update();
    CSLF_CHECK(vtkCSLFMaterial::GetPointRadius(import.Get(0)) == 0.0);
  }

  // These are drawn only if there are cells, because they have no bounds otherwise.
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < 3; ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  data->SetVerts(vertices);
  vtkNew<vtkOpenGLSphereMapper> spheres;
  spheres->SetInputData(data);
  spheres->SetScaleArray("Sizes");
  actor->SetMapper(spheres);
  CheckPicture(window, "Spheres", 0.1);
  spheres->SetScaleArray(nullptr);
  spheres->SetRadius(0.2f);
  CheckPicture(window, "Equal spheres", 0.1);
  vtkNew<vtkOpenGLStickMapper> sticks;
  sticks->SetInputData(data);
  sticks->SetScaleArray("Sticks");
  sticks->SetOrientationArray("Directions");
  actor->SetMapper(sticks);
  CheckPicture(window, "Sticks", 0.4); // the ends are round
}

/// A grid of 4 x 4 x 4 cells with its low corner at the origin.
vtkSmartPointer<vtkUniformGrid> MakeGrid(double spacing)
{
  auto grid = vtkSmartPointer<vtkUniformGrid>::New();
  grid->SetDimensions(5, 5, 5);
  grid->SetSpacing(spacing, spacing, spacing);
  vtkNew<vtkDoubleArray> level;
  level->SetName("Level");
  level->SetNumberOfTuples(64);
  level->Fill(spacing);
  grid->GetCellData()->AddArray(level);
  return grid;
}

void TestGridsOfLevels()
{
  // A cube of 4 x 4 x 4 cells, of which one eighth has cells of half the size.
  const vtkSmartPointer<vtkUniformGrid> coarse = MakeGrid(1.0);
  const vtkSmartPointer<vtkUniformGrid> fine = MakeGrid(0.5);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < 64; ++i)
  {
    const bool refined = i % 4 < 2 && i / 4 % 4 < 2 && i / 16 < 2;
    ghosts->InsertNextValue(refined ? vtkDataSetAttributes::REFINEDCELL : 0);
  }
  coarse->GetCellData()->AddArray(ghosts);
  vtkNew<vtkOverlappingAMR> grids;
  cslf::SetNumbersOfGrids(grids.Get(), { 1, 1 });
  const double origin[3] = { 0.0, 0.0, 0.0 };
  grids->SetOrigin(origin);
  int size[3];
  coarse->GetDimensions(size);
  grids->SetGridDescription(vtkStructuredData::GetDataDescription(size));
  for (unsigned int level : { 0u, 1u })
  {
    const int low[3] = { 0, 0, 0 };
    const int high[3] = { 3, 3, 3 };
    vtkUniformGrid* grid = level == 0 ? coarse : fine;
    grids->SetSpacing(level, grid->GetSpacing());
    grids->SetAMRBox(level, 0, vtkAMRBox(low, high));
    grids->SetDataSet(level, 0, grid);
  }
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(grids);
  mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray("Level");
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const Import import(renderer);
  CSLF_CHECK(import.Warning.empty() && import.GetCount() == 1);
  vtkPolyData* surface = import.Get(0);
  CSLF_CHECK(surface->GetNumberOfPolys() == 6 * 16 - 3 * 4 + 3 * 16);
  CSLF_CHECK(surface->GetCellData()->GetScalars() != nullptr);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  vtkNew<vtkMassProperties> measure;
  measure->SetInputConnection(triangles->GetOutputPort());
  measure->Update();
  CSLF_CHECK_NEAR(measure->GetSurfaceArea(), 96.0, 1e-9);
  CSLF_CHECK_NEAR(measure->GetVolume(), 64.0, 1e-9); // all faces look outwards
}

void TestPartitionedData()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkNew<vtkPartitionedDataSetCollection> collection;
  vtkNew<vtkPartitionedDataSet> parts[2];
  for (unsigned int i = 0; i < 2; ++i)
  {
    parts[i]->SetPartition(0, sphere->GetOutput());
    parts[i]->SetPartition(1, sphere->GetOutput());
    collection->SetPartitionedDataSet(i, parts[i]);
  }
  vtkNew<cslf::CompositeMapper> mapper;
  mapper->SetInputDataObject(collection);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  CSLF_CHECK(Import(renderer).GetCount() == 4 && Import(renderer).Warning.empty());
  mapper->SetInputDataObject(parts[0]);
  CSLF_CHECK(Import(renderer).GetCount() == 2);

  // The surface of a volume's cells, in another mapper.
  vtkNew<vtkUnstructuredGrid> volume;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  points->InsertNextPoint(0, 1, 0);
  points->InsertNextPoint(0, 0, 1);
  volume->SetPoints(points);
  const vtkIdType corners[] = { 0, 1, 2, 3 };
  volume->InsertNextCell(VTK_TETRA, 4, corners);
  vtkNew<vtkDataSetMapper> surfaceMapper;
  surfaceMapper->SetInputData(volume);
  actor->SetMapper(surfaceMapper);
  CSLF_CHECK(Import(renderer).GetCount() == 1);
  CSLF_CHECK(Import(renderer).Get(0)->GetNumberOfPolys() == 4);
}

/// A mapper that draws something unknown.
class OtherMapper : public vtkPolyDataMapper
{
public:
  static OtherMapper* New();
  vtkTypeMacro(OtherMapper, vtkPolyDataMapper);
  double* GetBounds() override
  {
    static double bounds[6] = { 0, 1, 0, 1, 0, 1 };
    return bounds;
  }
};

vtkStandardNewMacro(OtherMapper);

void TestLevels()
{
  vtkNew<vtkSphereSource> fine;
  fine->SetThetaResolution(32);
  vtkNew<vtkSphereSource> coarse;
  vtkNew<vtkPolyDataMapper> fineMapper;
  fineMapper->SetInputConnection(fine->GetOutputPort());
  vtkNew<vtkPolyDataMapper> coarseMapper;
  coarseMapper->SetInputConnection(coarse->GetOutputPort());
  vtkNew<vtkLODProp3D> levels;
  vtkNew<vtkProperty> red;
  red->SetColor(1, 0, 0);
  const int coarseLevel = levels->AddLOD(coarseMapper, 0.0);
  levels->AddLOD(fineMapper, red, 0.0);
  levels->SetPosition(0, 0.5, 0);
  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(levels);
  {
    const Import import(renderer);
    fine->Update();
    CSLF_CHECK(import.Warning.empty() && import.GetCount() == 1);
    CSLF_CHECK(import.Get(0)->GetNumberOfPolys() == fine->GetOutput()->GetNumberOfPolys());
    double color[3];
    vtkCSLFMaterial::GetBaseColor(import.Get(0), color);
    CSLF_CHECK(color[0] == 1.0 && color[1] == 0.0);
    CSLF_CHECK_NEAR(import.Get(0)->GetBounds()[3], 1.0, 0.02);
  }
  levels->AutomaticLODSelectionOff();
  levels->SetSelectedLODID(coarseLevel);
  {
    const Import import(renderer);
    coarse->Update();
    CSLF_CHECK(import.Get(0)->GetNumberOfPolys() == coarse->GetOutput()->GetNumberOfPolys());
  }
}

void TestWarnings()
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  renderer->AddActor(actor);
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(empty);
  actor->SetMapper(mapper);
  CSLF_CHECK(Import(renderer).Warning.empty() && Import(renderer).GetCount() == 0);

  // A visible object of which nothing is imported.
  vtkNew<OtherMapper> other;
  other->SetInputData(empty);
  actor->SetMapper(other);
  CSLF_CHECK(Import(renderer).Warns("OtherMapper"));
  actor->VisibilityOff();
  CSLF_CHECK(Import(renderer).Warning.empty());

  vtkNew<vtkVolume> volume;
  renderer->AddViewProp(volume);
  CSLF_CHECK(Import(renderer).Warns("vtkVolume"));
  renderer->RemoveViewProp(volume);
  vtkNew<vtkFollower> follower;
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> spheres;
  spheres->SetInputConnection(sphere->GetOutputPort());
  follower->SetMapper(spheres);
  follower->SetCamera(renderer->GetActiveCamera());
  renderer->AddActor(follower);
  CSLF_CHECK(Import(renderer).Warns("followers") && Import(renderer).GetCount() == 1);
}

/// Radii of points are those in the world, whatever the scale of glyphs. Widths in pixels follow
/// from the finite part of the scene.
void TestRadii()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(3.0, 4.0, 0.0);
  points->InsertNextPoint(std::numeric_limits<double>::infinity(), 0.0, 0.0);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 0, 1, 2 });
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  vtkNew<vtkPolyDataMapper> vertexMapper;
  vertexMapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->GetProperty()->SetPointSize(2.0);
  actor->SetMapper(vertexMapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetPointRadius(Import(renderer).Get(0)), 0.005, 1e-9);

  vtkNew<vtkPoints> ends;
  ends->InsertNextPoint(0.0, 0.0, 0.0);
  ends->InsertNextPoint(3.0, 4.0, 0.0);
  vtkNew<vtkPolyData> places;
  places->SetPoints(ends);
  vtkNew<vtkCellArray> vertex;
  vertex->InsertNextCell({ 0 });
  vtkNew<vtkPolyData> source;
  source->SetPoints(ends);
  source->SetVerts(vertex);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputData(places);
  glyphs->SetSourceData(source);
  glyphs->SetScaleFactor(4.0);
  actor->SetMapper(glyphs);
  const Import import(renderer);
  import.Filter->SetPointRadius(0.1);
  import.Filter->Update();
  CSLF_CHECK_NEAR(vtkCSLFMaterial::GetPointRadius(import.Get(0)), 0.1 / 4.0, 1e-9);
}
}

int TestCSLFSceneImporterMappers(int, char*[])
{
  ShapeComparison window;
#ifdef CSLF_TEST_MOLECULES
  TestMolecules(window);
#endif
  TestGraphs(window);
  TestPointMappers(window);
  TestRadii();
  TestGridsOfLevels();
  TestPartitionedData();
  TestLevels();
  TestWarnings();
  return cslf::testing::Result();
}
