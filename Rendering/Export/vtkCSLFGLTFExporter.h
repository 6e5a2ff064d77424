// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFGLTFExporter
 * @brief Writes the surfaces of a window's light field, with their light, as binary glTF 2.0.
 *
 * The file (.glb) has the triangles of the field's geometry in the colours that the mapper shows,
 * without light of the viewer's own (KHR_materials_unlit), for viewers such as three.js and model-
 * viewer. Sides with different colours are two primitives, the second with the opposite winding;
 * where closed bodies are seen from outside only, there is no second one. Colours are those of
 * points (COLOR_0), linear, of 16 bits. Only where colours between points differ visibly from
 * those of a colour map, the map is a texture, with which the viewer multiplies the light. The
 * root node has the name of the title, the actor's matrix, and as extras what the file leaves out,
 * which is also named in warnings: see vtkCSLFPageExporter. The second node is the window's
 * camera.
 *
 * The light field is that of the first visible actor with a vtkCSLFMapper in ActiveRenderer or, if
 * that is null, in any renderer. It must have geometry with colours.
 *
 * The file appears complete or not at all. If it cannot be written, there is an error.
 */
#ifndef vtkCSLFGLTFExporter_h
#define vtkCSLFGLTFExporter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkExporter.h"

class VTKCSLF_EXPORT vtkCSLFGLTFExporter : public vtkExporter
{
public:
  static vtkCSLFGLTFExporter* New();
  vtkTypeMacro(vtkCSLFGLTFExporter, vtkExporter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file's name, which ends in .glb by convention. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The name of the root node, in UTF-8. Default: none, which means the file's name without its
   * extension.
   */
  vtkSetStringMacro(Title);
  vtkGetStringMacro(Title);
  ///@}

  ///@{
  /**
   * Whether to compress the file, by EXT_meshopt_compression and positions of 16 bits
   * (KHR_mesh_quantization): three to five times. three.js and model-viewer read such files, VTK 9.1
   * and f3d 1.3 do not. Default: off.
   */
  vtkSetMacro(Compact, bool);
  vtkGetMacro(Compact, bool);
  vtkBooleanMacro(Compact, bool);
  ///@}

protected:
  vtkCSLFGLTFExporter();
  ~vtkCSLFGLTFExporter() override;

  void WriteData() override;

private:
  vtkCSLFGLTFExporter(const vtkCSLFGLTFExporter&) = delete;
  void operator=(const vtkCSLFGLTFExporter&) = delete;

  char* FileName = nullptr;
  char* Title = nullptr;
  bool Compact = false;
};

#endif
