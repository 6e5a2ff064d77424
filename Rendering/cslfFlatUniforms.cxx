// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFlatUniforms.h"

#include "cslfOpenGL.h"

#include <regex>

namespace cslf
{
bool ReadsUniformsByLane()
{
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer && std::string(renderer).find("llvmpipe") != std::string::npos;
}

void HandUniformsOn(std::string& vertex, std::string& fragment)
{
  static const std::regex uniform(
    R"((^|\n)uniform (float|int|vec[234]|mat[34]) (\w+);)", std::regex::optimize);
  static const std::string begin = "void main()\n{\n";
  const std::size_t main = vertex.find(begin);
  if (main == std::string::npos)
  {
    return;
  }
  std::string declarations;
  std::string assignments;
  for (std::sregex_iterator found(fragment.begin(), fragment.end(), uniform), end; found != end;
       ++found)
  {
    const std::string type = (*found)[2];
    const std::string name = (*found)[3];
    if (vertex.find("uniform " + type + " " + name + ";") == std::string::npos)
    {
      declarations += "uniform " + type + " " + name + ";\n";
    }
    declarations += "flat out " + type + " " + name + "Flat;\n";
    assignments += "  " + name + "Flat = " + name + ";\n";
  }
  vertex.replace(main, begin.size(), declarations + begin + assignments);
  fragment = std::regex_replace(fragment, uniform, "$1flat in $2 $3Flat;\n#define $3 $3Flat");
}
}
