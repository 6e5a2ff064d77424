// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Scenes that are made by programs, as data and actors of a scientist's window. Each has a file of
 * its own. They are made of fixed numbers, and always the same.
 */
#ifndef cslfProceduralScene_h
#define cslfProceduralScene_h

#include <vector>

#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

class vtkActor;
class vtkMapper;
class vtkPolyData;

namespace cslf
{
/// Adds an actor with this mapper, which the renderer keeps.
vtkActor* AddActor(vtkRenderer* renderer, vtkMapper* mapper);

/// Adds a surface in one colour.
vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data);

/// Adds a surface in the colours of its scalars, interpolated before they are mapped.
vtkActor* AddSurface(vtkRenderer* renderer, vtkPolyData* data, vtkScalarsToColors* colors);

///@{
/// Colours of a range of values: blue, white and red; dark violet, green and yellow; and those of
/// land, from valleys to snow.
vtkSmartPointer<vtkScalarsToColors> MakeCoolToWarm(double lowest, double highest);
vtkSmartPointer<vtkScalarsToColors> MakeViridis(double lowest, double highest);
vtkSmartPointer<vtkScalarsToColors> MakeLandColors(double lowest, double highest);
///@}

/// The light of a scene.
enum class SceneLight
{
  White,    ///< a white environment
  Gradient, ///< an environment that is white above and dark below
  Window    ///< the lights of the renderer
};

struct ProceduralScene
{
  const char* Name;
  const char* Description; ///< one sentence
  SceneLight Light;
  void (*Add)(vtkRenderer* renderer); ///< adds the actors, and the lights if there are any
};

const std::vector<ProceduralScene>& GetProceduralScenes();

///@{
/// The functions of the scenes.
void AddIsosurfaces(vtkRenderer* renderer);
void AddStreamlines(vtkRenderer* renderer);
void AddArrows(vtkRenderer* renderer);
void AddMolecule(vtkRenderer* renderer);
void AddTerrain(vtkRenderer* renderer);
void AddAssembly(vtkRenderer* renderer);
void AddTurbulence(vtkRenderer* renderer);
void AddPipes(vtkRenderer* renderer);
///@}
}

#endif
