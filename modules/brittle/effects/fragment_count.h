// How many fragments a blow makes, by Griffith's balance: cracks cost fracture energy, and there is only so much
// (effects/material.h). Pure functions.
//
// There are two laws. In a solid, cells are as deep as they are wide. In a plate all cracks go through, and cells are as deep
// as the plate is thick, which is right as long as they are wider than that: the plate's law holds up to side^2 / thickness^2
// cells, and the solid's beyond. There the two are nearest to each other; the solid's is higher by (6 / 5.821)^3, a tenth. The
// solid's alone would not do for anything thin: it would find a pane in hundreds of pieces before it is hit.
//
// Bodies are seldom plates. So each is taken for the square plate that has its volume and its surface: a pane for itself,
// whatever its outline, a bowl for the plate it would be if it were rolled out, a cube for a cube. No box is asked, which would
// say nothing about a bowl. Balls have less surface than a plate can; they are solids from the start.
//
// Kernels do the same in 32 bits: nothing here subtracts what is nearly equal, but for crackAreaOf near its least.
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

// The solid's law: [(2 eta E / G_c + A0) / (5.821 V^(2/3))]^3, and the plate's: [(2 eta E / (G_c h) + P) / (4 sqrt(A))]^2. No
// whole numbers, and less than 1 where a body is rounder than cells are. Energies in J, at least 0; all else above 0.
double solidFragments(const Material& material, double joules, double volume, double surface);
double plateFragments(const Material& material, double joules, double area, double perimeter, double thickness);

// By the law that holds. At least 1, and grows with the energy.
double expectedFragments(const Material& material, const BodyForm& form, double joules);

// How many cells of the material's smallest size there is room for, at least 1; infinite where that size is 0.
double roomForFragments(const Material& material, const BodyForm& form);

// A whole number, rounded down, since what is not paid for does not break; at least 1, and at most the budget (if that is not
// 0) and what there is room for.
uint32_t fragmentCount(const Material& material, const BodyForm& form, double joules, uint32_t budget);

// m2 of crack that so many fragments have, each crack counted once; 0 for one. The count is at least 1.
double crackAreaOf(const BodyForm& form, double count);
// J: the least energy of which expectedFragments makes so many; infinite where eta is 0. The count is at least 1.
double energyForFragments(const Material& material, const BodyForm& form, double count);

} // namespace brittle
