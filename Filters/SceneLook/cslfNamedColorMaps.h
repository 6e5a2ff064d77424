// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colour maps that have names: the values of the option ColorMap.
 */
#ifndef cslfNamedColorMaps_h
#define cslfNamedColorMaps_h

class vtkLookupTable;

namespace cslf
{
/// Gives a lookup table the colours of a map, whose number is a value of the option; cool to warm
/// if it is automatic. Values that are not numbers become gray. The table keeps its range and its
/// scale. Returns the map's name.
const char* SetUpLookupTable(int map, vtkLookupTable* table);
}

#endif
