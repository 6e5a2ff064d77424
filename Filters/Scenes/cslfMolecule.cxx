// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfProceduralScene.h"

#if VTK_MODULE_ENABLE_VTK_DomainsChemistry

#include <vtkActor.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkMolecule.h>
#include <vtkMoleculeMapper.h>
#include <vtkNew.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// 20 helices of 25 residues of 10 atoms.
constexpr int Columns = 5;
constexpr int Rows = 4;
constexpr int Residues = 25;
constexpr double Distance = 12.5; // between axes, in angstroms

enum Element : unsigned short
{
  Hydrogen = 1,
  Carbon = 6,
  Nitrogen = 7,
  Oxygen = 8
};

struct Atom
{
  Element Number;
  glm::dvec3 Position;
};

/// An alpha helix of alanine, around Y.
struct Helix
{
  std::vector<Atom> Atoms;
  std::vector<std::pair<int, int>> Bonds;
  std::vector<std::pair<int, int>> DoubleBonds;
};

/// The atom at a distance from c, with the angle b-c-atom and the torsion a-b-c-atom in degrees.
glm::dvec3 Place(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double length,
  double angle, double torsion)
{
  const glm::dvec3 along = glm::normalize(c - b);
  const glm::dvec3 across = glm::normalize(glm::cross(b - a, along));
  const double sine = std::sin(glm::radians(angle));
  return c +
    length *
    (-std::cos(glm::radians(angle)) * along +
      sine * std::cos(glm::radians(torsion)) * glm::cross(across, along) +
      sine * std::sin(glm::radians(torsion)) * across);
}

/// Moves the middle to the origin, and turns the axis to Y.
void Align(std::vector<Atom>& atoms)
{
  const std::size_t half = atoms.size() / 2;
  glm::dvec3 ends[2] = { glm::dvec3(0.0), glm::dvec3(0.0) };
  for (std::size_t i = 0; i < atoms.size(); ++i)
  {
    ends[i < half ? 0 : 1] += atoms[i].Position / static_cast<double>(half);
  }
  const glm::dvec3 y = glm::normalize(ends[1] - ends[0]);
  const glm::dvec3 x = glm::normalize(glm::cross(y, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 z = glm::cross(x, y);
  for (Atom& atom : atoms)
  {
    const glm::dvec3 arm = atom.Position - 0.5 * (ends[0] + ends[1]);
    atom.Position = { glm::dot(arm, x), glm::dot(arm, y), glm::dot(arm, z) };
  }
}

Helix MakeHelix()
{
  // The usual lengths, angles and torsions of peptides.
  constexpr double phi = -57.0;
  constexpr double psi = -47.0;
  Helix helix;
  const auto add = [&helix](Element element, const glm::dvec3& position, int neighbour)
  {
    const int atom = static_cast<int>(helix.Atoms.size());
    helix.Atoms.push_back({ element, position });
    if (neighbour >= 0)
    {
      helix.Bonds.emplace_back(neighbour, atom);
    }
    return atom;
  };
  glm::dvec3 alpha(0.0, 1.0, 0.0); // of the residue before
  glm::dvec3 carbon(0.0);
  glm::dvec3 nitrogen(1.329, 0.0, 0.0);
  int before = -1;
  for (int residue = 0; residue < Residues; ++residue)
  {
    const glm::dvec3 nextAlpha = Place(alpha, carbon, nitrogen, 1.458, 121.7, 180.0);
    const glm::dvec3 nextCarbon = Place(carbon, nitrogen, nextAlpha, 1.525, 111.0, phi);
    const glm::dvec3 beta = Place(carbon, nitrogen, nextAlpha, 1.53, 110.5, phi - 122.0);
    const int n = add(Nitrogen, nitrogen, before);
    add(Hydrogen, Place(alpha, carbon, nitrogen, 1.01, 119.0, 0.0), n);
    const int a = add(Carbon, nextAlpha, n);
    add(Hydrogen, Place(carbon, nitrogen, nextAlpha, 1.09, 109.0, phi + 120.0), a);
    const int b = add(Carbon, beta, a);
    for (const double torsion : { 60.0, 180.0, 300.0 })
    {
      add(Hydrogen, Place(nitrogen, nextAlpha, beta, 1.09, 109.5, torsion), b);
    }
    before = add(Carbon, nextCarbon, a);
    const int oxygen =
      add(Oxygen, Place(nitrogen, nextAlpha, nextCarbon, 1.231, 120.5, psi + 180.0), -1);
    helix.DoubleBonds.emplace_back(before, oxygen);
    const glm::dvec3 nextNitrogen = Place(nitrogen, nextAlpha, nextCarbon, 1.329, 116.6, psi);
    alpha = nextAlpha;
    carbon = nextCarbon;
    nitrogen = nextNitrogen;
  }
  Align(helix.Atoms);
  return helix;
}

/// Adds a copy of a helix, turned around its axis, tilted and moved.
void AddHelix(
  const Helix& helix, const glm::dvec3& center, double turn, double tilt, vtkMolecule* molecule)
{
  const vtkIdType first = molecule->GetNumberOfAtoms();
  for (const Atom& atom : helix.Atoms)
  {
    const glm::dvec3& p = atom.Position;
    const glm::dvec3 turned(std::cos(turn) * p.x + std::sin(turn) * p.z, p.y,
      std::cos(turn) * p.z - std::sin(turn) * p.x);
    const glm::dvec3 place = center +
      glm::dvec3(std::cos(tilt) * turned.x - std::sin(tilt) * turned.y,
        std::sin(tilt) * turned.x + std::cos(tilt) * turned.y, turned.z);
    molecule->AppendAtom(atom.Number, place.x, place.y, place.z);
  }
  for (const auto& [a, b] : helix.Bonds)
  {
    molecule->AppendBond(first + a, first + b, 1);
  }
  for (const auto& [a, b] : helix.DoubleBonds)
  {
    molecule->AppendBond(first + a, first + b, 2);
  }
}
}

void AddMolecule(vtkRenderer* renderer)
{
  const Helix helix = MakeHelix();
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  vtkNew<vtkMolecule> molecule;
  for (int row = 0; row < Rows; ++row)
  {
    for (int column = 0; column < Columns; ++column)
    {
      const glm::dvec3 center(Distance * (column - 0.5 * (Columns - 1)),
        random->GetNextRangeValue(-4.0, 4.0), Distance * (row - 0.5 * (Rows - 1)));
      const double turn = random->GetNextRangeValue(0.0, glm::radians(360.0));
      const double upside = (row + column) % 2 == 0 ? 0.0 : 180.0;
      const double tilt = glm::radians(upside + random->GetNextRangeValue(-6.0, 6.0));
      AddHelix(helix, center, turn, tilt, molecule);
    }
  }
  vtkNew<vtkMoleculeMapper> mapper;
  mapper->SetInputData(molecule);
  mapper->UseBallAndStickSettings();
  AddActor(renderer, mapper);
}
}

#endif
