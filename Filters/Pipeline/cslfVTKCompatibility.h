// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * All differences between the versions of VTK.
 */
#ifndef cslfVTKCompatibility_h
#define cslfVTKCompatibility_h

#include "cslfInterpreter.h"

#include <vtkAlgorithm.h>
#include <vtkMapper.h>
#include <vtkProp.h>
#include <vtkVersionMacros.h>

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include <vtkCompositePolyDataMapper.h>
#else
#include <vtkCompositePolyDataMapper2.h>
#endif

#include <vector>

namespace cslf
{
/// Whether a filter has been asked to stop, by its user or by that of the interpreter.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return algorithm->CheckAbort() || IsInterrupted();
#else
  return algorithm->GetAbortExecute() != 0 || IsInterrupted();
#endif
}

/// The mapper of composite data.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
using CompositeMapper = vtkCompositePolyDataMapper;
#else
using CompositeMapper = vtkCompositePolyDataMapper2;
#endif

/// How a mapper of composite data shows its blocks; null for other mappers.
inline vtkCompositeDataDisplayAttributes* GetDisplayAttributes(vtkMapper* mapper)
{
  auto* composite = CompositeMapper::SafeDownCast(mapper);
  return composite ? composite->GetCompositeDataDisplayAttributes() : nullptr;
}

/// The key of the matrix that transforms a prop's texture coordinates.
inline vtkInformationDoubleVectorKey* TextureTransformKey()
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return vtkProp::GENERAL_TEXTURE_TRANSFORM();
#else
  return vtkProp::GeneralTextureTransform();
#endif
}

/// Makes empty levels of grids (vtkOverlappingAMR), with that many grids each.
template <typename Grids>
void SetNumbersOfGrids(Grids* grids, const std::vector<unsigned int>& counts)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  grids->Initialize(counts);
#else
  const std::vector<int> numbers(counts.begin(), counts.end());
  grids->Initialize(static_cast<int>(numbers.size()), numbers.data());
#endif
}

/// Asks a running filter to stop.
inline void Abort(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  algorithm->SetAbortExecuteAndUpdateTime();
#else
  algorithm->SetAbortExecute(1);
#endif
}

/// Forgets that a filter was asked to stop, before work that VTK does not begin.
inline void ResetAbort(vtkAlgorithm* algorithm)
{
  algorithm->SetAbortExecute(0);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  algorithm->SetAbortOutput(false);
#endif
}

/// Whether the window shows visible vertices only on surfaces with visible edges. Newer versions
/// show them in any case.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 5, 0)
constexpr bool VerticesNeedEdges = false;
#else
constexpr bool VerticesNeedEdges = true;
#endif

/// Whether physically based shading takes the colours of scalars as sRGB; older versions take them
/// as linear.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
constexpr bool PhysicalScalarsAreEncoded = true;
#else
constexpr bool PhysicalScalarsAreEncoded = false;
#endif

/// Whether the window takes the colours of physically based surfaces as light also if no lights
/// shine on them: lines, points, and surfaces without lighting. Older versions show them as they
/// are, with the texture of the actor.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
constexpr bool UnlitPhysicalIsLight = true;
#else
constexpr bool UnlitPhysicalIsLight = false;
#endif
}

#endif
