// How many fragments a blow makes, by Griffith's balance: cracks cost fracture energy, and there is only so much
// (effects/material.h). Pure functions.
//
// How much crack so many cells have follows from the density n of their sites. Where n hardly changes from one cell to the
// next, a cubic meter has 5.821 / 2 n^(1/3) of it (material.h), and a square meter of a plate that cracks go through 2 n^(1/2)
// times its thickness. Sites are drawn from one distribution, of the density p to be at a place, and so of N of them n = N p:
// all crack is 5.821 / 2 N^(1/3) times the integral of p^(1/3) over the body, or 2 N^(1/2) that of p^(1/2). By Hoelder's
// inequality these are largest where sites lie evenly, V^(2/3) and A^(1/2): what crowds about the blow makes less crack, and
// more of it is needed. How much less is a factor, since
// - in a solid half of the sites lie evenly and half as r^-4 about the blow: the factor is no less than the cube root of a
// half,
//   0.79, for the even half alone, and near 1 where the contact is as wide as the body;
// - in a plate all lie as r^(-4/3) about the blow: in a disk that is hit in its middle it is sqrt(3)/2, 0.87.
// Two things are left. Cells at the rim have no neighbors beyond it, and lack cracks in a layer as wide as a cell: as much for
// a square meter of rim, whatever N is. And one cell has none. So, with S the surface and P the outline,
//   crack of a solid = f 5.821/2 V^(2/3) (N^(1/3) - 1/N) - 0.37 S (1 - 1/N),   f = 0.85 + 0.2 N^(-1/2)
//   crack of a plate = f 2 sqrt(A) h (N^(1/2) - 1/N)      - 0.4 P h (1 - 1/N), f = 0.86 + 0.25 N^(-1/2)
// where S counts as no less than a cube has, which a ball's is: few cells do not see how round it is; and f is 1 if sites lie
// evenly. Factors and rims were fitted to diagrams cut by Voro++ (cubes and balls hit on a face, an
// edge or a corner, contacts of a thirtieth to a fifth of their size; plates hit in the middle, at an edge and a corner; 2 to
// 1280 sites): the means are within 15 % of it, most within 8 %, and of even sites in a cube within 2 %.
//
// The paper's sites (fracture/pattern.h) lie about the center of the box and, as often as the strength of the blow says, near
// the blow, as the nearest of eight. What that leaves of cracks falls with the count, since far from the blow there are next to
// none: where all are the nearest of eight, f = 1.45 N^(-0.115) in a solid, 0.97 at most, and f = 1.24 N^(-0.175) in a plate, 1
// at most. Measured in worlds, hit in the middle, 3 to 1000 cells; beside it kernels take plates for less crowded.
//
// A body is taken for a plate where it is thinner than a third of its side. The plate's law holds as long as cells are wider
// than that, up to side^2 / thickness^2 of them, and the solid's beyond.
//
// Bodies are seldom plates. So each is taken for the square plate that has its volume and its surface: a pane for itself,
// whatever its outline, a bowl for the plate it would be if it were rolled out, a cube for a cube. No box is asked, which would
// say nothing about a bowl. Balls have less surface than a plate can; they are solids from the start.
//
// Kernels do the same in 32 bits. Of flat bodies they know the edges as well, and take the outline of an oblong one for what it is and
// cracks for as much fewer as sites are more crowded in it (lib/plate_shape.glsl).
#pragma once

#include "modules/brittle/effects/material.h"

#include <cstdint>

namespace brittle {

struct BodyForm {
    double volume = 0;    // m3
    double surface = 0;   // m2
    double side = 0;      // m, of the square plate that has both
    double thickness = 0; // m, at most the side
};

// Volume and surface above 0.
BodyForm formOf(double volume, double surface);

// Whether plates' laws are its own.
bool isThin(const BodyForm& form);

// How sites lie: about the blow, as above, or evenly.
// Or as the paper has them (fracture/pattern.h).
enum class Spread : uint8_t { AboutBlow, Even, Paper };

// m2 of crack that so many fragments have on average, each crack counted once; 0 for one, and grows with the count, which is at
// least 1. `favor`, 0 to 1: how often the paper's pattern takes the candidate nearest to the blow.
double crackAreaOf(const BodyForm& form, double count, Spread spread = Spread::AboutBlow, double favor = 1);
// Of so much crack as eta E pays for; no whole number, at least 1, at most 2^24.
double expectedFragments(const Material& material, const BodyForm& form, double joules, Spread spread = Spread::AboutBlow);

// How many cells of the material's smallest size there is room for, at least 1; infinite where that size is 0.
double roomForFragments(const Material& material, const BodyForm& form);

// The whole number below or above: above where the chance, from 0 to 1, is more than what is missing. So over many blows cracks
// take what is theirs, though a blow may spend a little more. At most the budget (if that is not 0) and what there is room for.
uint32_t fragmentCount(const Material& material, const BodyForm& form, double joules, uint32_t budget, double chance = 0,
                       Spread spread = Spread::AboutBlow);

// J: the least energy of which expectedFragments makes so many; infinite where eta is 0. The count is at least 1.
double energyForFragments(const Material& material, const BodyForm& form, double count, Spread spread = Spread::AboutBlow);

} // namespace brittle
