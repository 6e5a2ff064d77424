// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCSLFPageExporter
 * @brief Writes the light field of a window as one HTML page that shows it without a server.
 *
 * The page has the surfaces of the field's geometry with their light, compressed as in coded files,
 * and a viewer for browsers with WebGL 2: to turn, move and zoom the view, and to show the field's
 * scalars in other colours. It loads nothing else. Its first view is that of the window's camera,
 * in perspective, before the renderer's background colour, in the colours that the mapper shows.
 *
 * The light field is that of the first visible actor with a vtkCSLFMapper in ActiveRenderer or, if
 * that is null, in any renderer. It must have geometry with colours, as fields of diffuse surfaces
 * have it: see Documentation/Conventions.md. What the page cannot show is named in a warning and in
 * the page's help: light that changes with the direction of view, translucent surfaces, the
 * environment, tone mapping, clipping planes and other actors.
 *
 *     exporter.SetRenderWindow(window)
 *     exporter.SetFileName("page.html")
 *     exporter.Write()
 *
 * The file appears complete or not at all. If it cannot be written, there is an error.
 */
#ifndef vtkCSLFPageExporter_h
#define vtkCSLFPageExporter_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkExporter.h"

class VTKCSLF_EXPORT vtkCSLFPageExporter : public vtkExporter
{
public:
  static vtkCSLFPageExporter* New();
  vtkTypeMacro(vtkCSLFPageExporter, vtkExporter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The page's name, which ends in .html by convention. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The page's title, in UTF-8. Default: none, which means the file's name without its extension.
   */
  vtkSetStringMacro(Title);
  vtkGetStringMacro(Title);
  ///@}

  ///@{
  /**
   * Whether the page has the window's picture, in JPEG, which is seen until the surfaces are drawn,
   * and in browsers without WebGL 2. The window is drawn for it. Default: on.
   */
  vtkSetMacro(Poster, bool);
  vtkGetMacro(Poster, bool);
  vtkBooleanMacro(Poster, bool);
  ///@}

protected:
  vtkCSLFPageExporter();
  ~vtkCSLFPageExporter() override;

  void WriteData() override;

private:
  vtkCSLFPageExporter(const vtkCSLFPageExporter&) = delete;
  void operator=(const vtkCSLFPageExporter&) = delete;

  char* FileName = nullptr;
  char* Title = nullptr;
  bool Poster = true;
};

#endif
