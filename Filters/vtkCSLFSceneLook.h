// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFSceneLook
 * @brief   chooses colours and light for data that has none of its own
 *
 * Data from a file or a simulation rarely says how it is to look. This filter, placed before a path
 * tracer, chooses the array and the colour map that colour it, and a light that shows its shape:
 *
 * @code
 * look->SetInputConnection(reader->GetOutputPort());
 * sampler->SetInputConnection(look->GetOutputPort());
 * look->SetUpEnvironment(sampler->GetEnvironment());
 * @endcode
 *
 * Inputs are polygonal data, any other data sets, of which the surface is shown
 * (vtkDataSetSurfaceFilter), and composite data of them; a light field is an error. They are not
 * modified. There can be any number of them, even none. Each is a block of the output; what is in
 * the field data of the root of composite data is passed on to its blocks, and its lights to a
 * block of their own. The light `sun` adds a last block, "Lights".
 *
 * By default, the active scalars of the points, or else of the cells, colour a surface if they
 * vary. All arrays of the same name share one range and one lookup table. Scalars of a single value
 * are switched off, since any colour would be arbitrary: the surface shows its base colour. Kept as
 * they are: unsigned chars of 3 or 4 components, which are colours; the lookup table of an array,
 * unless a colour map or a range is chosen; and the colours of data with `CSLF:FinishedColors`,
 * such as the output of vtkCSLFSceneImporter.
 *
 * If processes work on pieces of a scene, each knows the range of its piece only: set ColorRange.
 *
 * @sa vtkCSLFPathTracer vtkCSLFMaterial vtkCSLFSceneSource
 */
#ifndef vtkCSLFSceneLook_h
#define vtkCSLFSceneLook_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkNew.h" // for Legend

#include <array>  // for GrownRanges
#include <map>    // for GrownRanges
#include <string> // for ColorArrayName

class vtkCSLFEnvironment;
class vtkLookupTable;
class vtkTable;

class VTKCSLF_EXPORT vtkCSLFSceneLook : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFSceneLook* New();
  vtkTypeMacro(vtkCSLFSceneLook, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The array that colours the surfaces, of points or else of cells. Empty: the active scalars if
   * they vary. `none`: no array, unless there is one of that name. If there is no array of the name
   * and ColorComponent is empty, what follows its last colon is the component: `velocity:x`. It is
   * an error if no input has the array; surfaces without it show their base colour. Default: empty.
   */
  vtkSetStdStringFromCharMacro(ColorArrayName);
  vtkGetCharFromStdStringMacro(ColorArrayName);
  ///@}

  ///@{
  /**
   * The component of the array that is shown: its number, `x`, `y` or `z` for the first three, its
   * own name, or `magnitude`. It is an error if the array does not have it. Default: empty, which
   * is the magnitude of arrays of several components.
   */
  vtkSetStdStringFromCharMacro(ColorComponent);
  vtkGetCharFromStdStringMacro(ColorComponent);
  ///@}

  /**
   * The colours of an array's values. See the setters.
   */
  enum ColorMaps
  {
    AutomaticColors = 0,
    CoolToWarm,
    Viridis,
    Plasma,
    Inferno,
    Gray,
    Rainbow,
    NUMBER_OF_COLOR_MAPS
  };

  ///@{
  /**
   * The colour map. Default: automatic.
   */
  void SetColorMap(int map);
  vtkGetMacro(ColorMap, int);
  /** The lookup table of the array, or else cool to warm. */
  void SetColorMapToAutomatic() { this->SetColorMap(AutomaticColors); }
  /** From blue over light grey to red. */
  void SetColorMapToCoolToWarm() { this->SetColorMap(CoolToWarm); }
  /** From dark blue over green to yellow, perceptually uniform. */
  void SetColorMapToViridis() { this->SetColorMap(Viridis); }
  /** From dark blue over red to yellow, perceptually uniform. */
  void SetColorMapToPlasma() { this->SetColorMap(Plasma); }
  /** From black over red to light yellow, perceptually uniform. */
  void SetColorMapToInferno() { this->SetColorMap(Inferno); }
  /** From black to white. */
  void SetColorMapToGray() { this->SetColorMap(Gray); }
  /** From blue over green to red: the default of VTK. */
  void SetColorMapToRainbow() { this->SetColorMap(Rainbow); }
  ///@}

  /**
   * The name of a colour map, such as `cool-to-warm`. Null for a number that is out of range.
   */
  static const char* GetColorMapName(int map);

  /**
   * Gives a lookup table the colours of a colour map, for example to show a light field in it:
   * vtkCSLFMapper::SetLookupTable. What is not a number becomes gray. Range and scale of the table
   * remain. Automatic is cool to warm. A null table and a number that is out of range are ignored.
   */
  static void SetUpLookupTable(int map, vtkLookupTable* table);

  ///@{
  /**
   * Whether the ends of the colour map are the smallest and largest finite value of the arrays of a
   * name in all inputs. If off, ColorRange sets them. Default: on.
   */
  vtkSetMacro(AutomaticColorRange, bool);
  vtkGetMacro(AutomaticColorRange, bool);
  vtkBooleanMacro(AutomaticColorRange, bool);
  ///@}

  ///@{
  /**
   * Whether automatic ranges grow: that of an array then includes its values in all updates since
   * this was switched on, so that steps of time get equal colours after each of them was updated
   * once. An array that varies only over time is shown then, too. vtkCSLFSeriesWriter does this.
   * Default: off.
   */
  void SetGrowColorRange(bool grow);
  vtkGetMacro(GrowColorRange, bool);
  vtkBooleanMacro(GrowColorRange, bool);
  ///@}

  ///@{
  /**
   * The values at the ends of a colour map whose range is not automatic. It is an error if they are
   * not finite or the first is not smaller than the second. Default: 0, 1.
   */
  vtkSetVector2Macro(ColorRange, double);
  vtkGetVector2Macro(ColorRange, double);
  ///@}

  /**
   * The kinds of light. See the setters.
   */
  enum Lights
  {
    AutomaticLight = 0,
    StudioLight,
    SunLight,
    SkyLight,
    WhiteLight,
    NoLight,
    NUMBER_OF_LIGHTS
  };

  ///@{
  /**
   * The light: what SetUpEnvironment sets, and for the sun also a block of the output. Default:
   * automatic.
   */
  void SetLight(int light);
  vtkGetMacro(Light, int);
  /** The studio, but a dim sky if the inputs have lights of their own. */
  void SetLightToAutomatic() { this->SetLight(AutomaticLight); }
  /** Soft light from above, on the left and in front. */
  void SetLightToStudio() { this->SetLight(StudioLight); }
  /** A sky, and a sun with sharp shadows. */
  void SetLightToSun() { this->SetLight(SunLight); }
  /** White above, dark below. */
  void SetLightToSky() { this->SetLight(SkyLight); }
  /** The same from all directions. */
  void SetLightToWhite() { this->SetLight(WhiteLight); }
  /** None but the lights of the inputs. */
  void SetLightToNone() { this->SetLight(NoLight); }
  ///@}

  /**
   * The name of a light, such as `studio`. Null for a number that is out of range.
   */
  static const char* GetLightName(int light);

  /**
   * The axes of the world. See the setters.
   */
  enum Axes
  {
    XAxis = 0,
    YAxis,
    ZAxis,
    MinusXAxis,
    MinusYAxis,
    MinusZAxis,
    NUMBER_OF_AXES
  };

  ///@{
  /**
   * The direction that is up in the scene, which the light follows. Default: Y.
   */
  void SetUpAxis(int axis);
  vtkGetMacro(UpAxis, int);
  /** The scene stands on the plane of Y and Z. */
  void SetUpAxisToX() { this->SetUpAxis(XAxis); }
  /** The scene stands on the plane of X and Z. */
  void SetUpAxisToY() { this->SetUpAxis(YAxis); }
  /** The scene stands on the plane of X and Y. */
  void SetUpAxisToZ() { this->SetUpAxis(ZAxis); }
  /** The scene hangs from the plane of Y and Z. */
  void SetUpAxisToMinusX() { this->SetUpAxis(MinusXAxis); }
  /** The scene hangs from the plane of X and Z. */
  void SetUpAxisToMinusY() { this->SetUpAxis(MinusYAxis); }
  /** The scene hangs from the plane of X and Y. */
  void SetUpAxisToMinusZ() { this->SetUpAxis(MinusZAxis); }
  ///@}

  /**
   * The name of an axis: `x`, `y`, `z`, `-x`, `-y` or `-z`. Null for a number that is out of range.
   */
  static const char* GetUpAxisName(int axis);

  /**
   * The directions of the scene, as unit vectors, for someone who stands in front of it: to the
   * right, up, and towards the viewer.
   */
  void GetAxes(double right[3], double up[3], double front[3]);

  /**
   * Sets mode, colours and direction of an environment to those of Light. If that is automatic, the
   * filter is updated, to know whether the inputs have lights. Null is ignored.
   */
  void SetUpEnvironment(vtkCSLFEnvironment* environment);

  /**
   * What the colours mean, as of the last update: a row for each array that the filter has mapped.
   * The columns are `array`, its name; `component`, a number or `magnitude`, and empty if it has
   * only one; `minimum` and `maximum`, the values at the ends of the map; and `map`, its name.
   */
  vtkTable* GetLegend();

protected:
  vtkCSLFSceneLook();
  ~vtkCSLFSceneLook() override;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFSceneLook(const vtkCSLFSceneLook&) = delete;
  void operator=(const vtkCSLFSceneLook&) = delete;

  std::string ColorArrayName;
  std::string ColorComponent;
  int ColorMap;
  bool AutomaticColorRange = true;
  bool GrowColorRange = false;
  std::map<std::string, std::array<double, 2>> GrownRanges; // by the names of arrays
  double ColorRange[2] = { 0.0, 1.0 };
  int Light;
  int UpAxis;
  bool HasLights = false; // whether the inputs do, as of the last update
  vtkNew<vtkTable> Legend;
};

#endif
