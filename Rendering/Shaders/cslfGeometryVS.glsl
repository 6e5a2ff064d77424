//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
// Draws a field's geometry, from CC.

// Options:
//   BACK_COLORS  its back has other colours
//   COLOR_MAPS   some points have light instead of a colour, and a place on a map
//CSLF::Options::Dec

in vec3 vertexCC;
in vec4 vertexColor;
#ifdef BACK_COLORS
in vec4 vertexBackColor;
out vec4 backColorVSOutput;
#endif
#ifdef COLOR_MAPS
in vec3 vertexPlace; // ShownMaps::ListPlaces
out vec2 placeVSOutput;
flat out float mapVSOutput; // its number; negative without one
#endif
out vec3 pointCCVSOutput;
out vec4 colorVSOutput;

uniform mat4 CCDCMatrix;

void main()
{
  pointCCVSOutput = vertexCC;
  colorVSOutput = vertexColor;
#ifdef BACK_COLORS
  backColorVSOutput = vertexBackColor;
#endif
#ifdef COLOR_MAPS
  mapVSOutput = vertexPlace.z;
  placeVSOutput = vertexPlace.xy;
#endif
  gl_Position = CCDCMatrix * vec4(vertexCC, 1.0);
}
