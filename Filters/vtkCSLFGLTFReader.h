// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFGLTFReader
 * @brief   reads glTF 2.0 with its materials
 *
 * Reads a `.gltf` or `.glb` file. The output, a vtkMultiBlockDataSet, has a block for each
 * primitive of each node of the file's default scene, in world coordinates, with its material as
 * defined by vtkCSLFMaterial. Transforms of nodes are applied in double precision; points of nodes
 * that are moved are doubles. Supported are:
 *
 * - base colour factor and texture, times the colours of vertices; metallic and roughness factors
 * and texture; normal texture and its scale; emissive factor and texture;
 * - alpha modes: opaque gives opacity 1, blend the alpha of factor, texture and vertices, and mask
 * the same with the cut-off;
 * - the extensions KHR_materials_emissive_strength, KHR_materials_ior (without it, the index of
 * refraction is 1.5, as glTF defines it), KHR_materials_transmission (factor), and from
 * KHR_materials_volume whether glass is solid: without a thickness it is thin-walled;
 * - KHR_texture_transform, KHR_mesh_quantization, EXT_texture_webp, sparse accessors, data URIs,
 * and all modes of primitives.
 *
 * Without a default scene, the first scene is read, and without scenes all nodes. Primitives
 * without a material are grey and diffuse, like all data without one, or have the colours of their
 * vertices; glTF's own default would be a rough white metal.
 *
 * Files are not trusted. Invalid parts, such as triangles with indices of vertices that do not
 * exist, are left out, and a warning names them. If no geometry is left, or if the file is not glTF
 * 2.0 or requires compressed meshes (KHR_draco_mesh_compression, EXT_meshopt_compression), there is
 * an error, and the output is empty.
 *
 * The following features are not represented, and one warning names them: other extensions,
 * transmission textures, textures of one material with different coordinates, skins and morph
 * targets (shown at rest), unlit materials (which are lit), lights. Cameras and animations are
 * ignored.
 *
 * @sa vtkCSLFMaterial vtkCSLFPathTracer
 */
#ifndef vtkCSLFGLTFReader_h
#define vtkCSLFGLTFReader_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class VTKCSLF_EXPORT vtkCSLFGLTFReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCSLFGLTFReader* New();
  vtkTypeMacro(vtkCSLFGLTFReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file, `.gltf` or `.glb`. Required.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The radius of points, in the file's unit. With 0, the path tracer takes half of the distance
   * between neighbouring points, see vtkCSLFMaterial. Range: 0 to 1e30. Default: 0.
   */
  void SetPointRadius(double radius);
  vtkGetMacro(PointRadius, double);
  ///@}

protected:
  vtkCSLFGLTFReader();
  ~vtkCSLFGLTFReader() override;

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFGLTFReader(const vtkCSLFGLTFReader&) = delete;
  void operator=(const vtkCSLFGLTFReader&) = delete;

  char* FileName = nullptr;
  double PointRadius;
};

#endif
