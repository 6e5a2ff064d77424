// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFlatUniforms.h"

#include "Lookup/cslfFaceSpace.h"
#include "cslfOpenGL.h"

#include <regex>
#include <string>

#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkShaderProgram.h>

namespace cslf
{
void GetFaceToCube(int face, vtkMatrix4x4* fccc)
{
  const glm::dvec3 originCC = FaceSpaceToCube(face, glm::dvec3(0.0));
  for (int column = 0; column < 4; ++column)
  {
    glm::dvec3 unit(0.0);
    if (column < 3)
    {
      unit[column] = 1.0;
    }
    const glm::dvec3 imageCC = column < 3 ? FaceSpaceToCube(face, unit) - originCC : originCC;
    for (int row = 0; row < 3; ++row)
    {
      fccc->SetElement(row, column, imageCC[row]);
    }
  }
}

void SetFaceUniforms(vtkShaderProgram* program, int face)
{
  vtkNew<vtkMatrix4x4> fccc;
  GetFaceToCube(face, fccc);
  fccc->Transpose(); // GLSL's matrices are stored by columns.
  program->SetUniformMatrix("FCCCMatrix", fccc);

  const auto frames = ListExitFrames(face);
  const auto setAxes = [&](const char* name, const ExitFrame& frame, int first, int second)
  {
    const float axes[4] = { static_cast<float>(frame.S[first]), static_cast<float>(frame.T[first]),
      static_cast<float>(frame.S[second]), static_cast<float>(frame.T[second]) };
    program->SetUniform4f(name, axes);
  };
  setAxes("OppositeAxes", frames[0], 0, 1);
  setAxes("SideXAxes", frames[1], 1, 2);
  setAxes("SideYAxes", frames[3], 0, 2);
  const auto setSides =
    [&](const std::string& name, const ExitFrame& positive, const ExitFrame& negative)
  {
    const float flip[2] = { positive.S == negative.S ? 1.0f : -1.0f,
      positive.T == negative.T ? 1.0f : -1.0f };
    program->SetUniform2f((name + "Flip").c_str(), flip);
  };
  setSides("SideX", frames[1], frames[2]);
  setSides("SideY", frames[3], frames[4]);
}

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
