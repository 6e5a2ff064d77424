// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which uniforms a vertex shader passes on, and which stay.
#include "cslfFlatUniforms.h"
#include "cslfTesting.h"

#include <string>

namespace
{
bool Has(const std::string& source, const std::string& part)
{
  return source.find(part) != std::string::npos;
}
}

int TestCSLFFlatUniforms(int, char*[])
{
  std::string vertex = "uniform mat4 Shared;\n\nvoid main()\n{\n  gl_Position = vec4(0.0);\n}\n";
  std::string fragment = "uniform mat4 Shared; // of both\nuniform float One;\nuniform vec3 Two;\n"
                         "#ifdef NEVER\nuniform int Three;\n#endif\n"
                         "uniform sampler2D Texture;\nuniform bool Flag;\nuniform vec4 List[3];\n"
                         "// uniform vec2 Comment;\n";
  cslf::HandUniformsOn(vertex, fragment);
  CSLF_CHECK(Has(fragment, "flat in mat4 SharedFlat;\n#define Shared SharedFlat // of both\n"));
  CSLF_CHECK(Has(fragment, "flat in float OneFlat;\n#define One OneFlat\nflat in vec3 TwoFlat;"));
  CSLF_CHECK(
    Has(fragment, "#ifdef NEVER\nflat in int ThreeFlat;\n#define Three ThreeFlat\n#endif"));
  CSLF_CHECK(
    Has(fragment, "uniform sampler2D Texture;\nuniform bool Flag;\nuniform vec4 List[3];\n"));
  CSLF_CHECK(Has(fragment, "// uniform vec2 Comment;"));
  CSLF_CHECK(vertex.find("uniform mat4 Shared;") == vertex.rfind("uniform mat4 Shared;"));
  CSLF_CHECK(Has(vertex, "uniform float One;\nflat out float OneFlat;\n"));
  CSLF_CHECK(Has(vertex, "{\n  SharedFlat = Shared;\n  OneFlat = One;\n  TwoFlat = Two;\n"));
  CSLF_CHECK(Has(vertex, "  ThreeFlat = Three;\n  gl_Position"));

  // If there is no place for them, nothing changes.
  std::string other = "void main() {}\n";
  std::string kept = "uniform float One;\n";
  cslf::HandUniformsOn(other, kept);
  CSLF_CHECK(other == "void main() {}\n" && kept == "uniform float One;\n");
  return cslf::testing::Result();
}
