// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What differs between the versions of VTK, in one place.
 */
#ifndef cslfVTKCompatibility_h
#define cslfVTKCompatibility_h

#include <vtkAlgorithm.h>
#include <vtkMapper.h>
#include <vtkVersionMacros.h>

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include <vtkCompositePolyDataMapper.h>
#else
#include <vtkCompositePolyDataMapper2.h>
#endif

namespace cslf
{
/// Whether a filter has been asked to stop.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
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

/// Asks a filter that is at work to stop.
inline void Abort(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  algorithm->SetAbortExecuteAndUpdateTime();
#else
  algorithm->SetAbortExecute(1);
#endif
}

/// Whether physically based shading takes the colours of scalars as sRGB; older versions take them
/// as linear.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
constexpr bool PhysicalScalarsAreEncoded = true;
#else
constexpr bool PhysicalScalarsAreEncoded = false;
#endif
}

#endif
