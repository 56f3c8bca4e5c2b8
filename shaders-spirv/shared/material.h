// What kernels and the host agree on about materials and how they break. SI units. The laws and their sources stand in
// modules/brittle/effects/material.h.
#ifndef MATERIAL_H
#define MATERIAL_H

#include "gpu_types.h"

GPU_NAMESPACE_BEGIN

// Of a Voronoi diagram of random sites, one a cubic meter: the surface of a cell on average, (256 pi / 3)^(1/3) Gamma(5/3).
#define CELL_SURFACE 5.821
// The same in a plane, one site a square meter: the outline of a cell.
#define CELL_OUTLINE 4.0
// What cells at the rim of a body lack, of a square meter of its surface, for want of sites beyond it; in plates of one of the
// plate's rim. Measured (modules/brittle/effects/fragment_count.h).
#define SOLID_RIM 0.37
#define PLATE_RIM 0.4
// Cracks among sites that crowd about a blow, over those among as many that lie evenly: with the count n, FEW + MORE / root of
// n.
#define BLOW_IN_SOLID 0.85
#define BLOW_IN_SOLID_MORE 0.2
#define BLOW_IN_PLATE 0.86
#define BLOW_IN_PLATE_MORE 0.25
// The same among sites as the paper has them, where all are the nearest of eight candidates: FIRST over a power of the count,
// MOST at most.
#define PAPER_IN_SOLID 1.45
#define PAPER_IN_SOLID_FALLS 0.115
#define PAPER_IN_SOLID_MOST 0.97
#define PAPER_IN_PLATE 1.24
#define PAPER_IN_PLATE_FALLS 0.175
#define PAPER_IN_PLATE_MOST 1.0
// How sites lie: about the blow, evenly, or as the paper has them.
#define SPREAD_ABOUT_BLOW 0
#define SPREAD_EVEN 1
#define SPREAD_PAPER 2
// A body is thin, and breaks as a plate does, if its thickness is less than its side by this.
#define THIN 3.0

// Bending makes of the stress of a blow at most the root of this, in thin bodies.
#define BENDING_GAIN_SQUARED 3.0
// Of (mass * speed^2 / (modulus * radius^(1/2)))^(2/5), to the power of 5/2: how near two bodies come in a blow.
#define HERTZ_APPROACH 0.9375

// For what does not give way at all: so large that its inverse adds nothing, in 32 bits as well.
#define RIGID_IMPEDANCE 1e30 /* Pa s/m */
#define RIGID_MODULUS 1e30   /* Pa */

// A hash is a chance between 0 and 1: ((hash >> CHANCE_SHIFT) + 0.5) * CHANCE_STEP. Exact in 32 bits, and never 0 or 1.
#define CHANCE_SHIFT 9
#define CHANCE_STEP 1.1920928955078125e-07 /* 2^-23 */

struct MaterialCard {
    vec4 elastic; // density, Young's modulus / (1 - Poisson ratio^2), impedance, strength of a cubic meter that 37 of 100 have
    vec4 cracks;  // 1 / Weibull modulus, fracture energy, eta, size of the smallest cell
};

GPU_NAMESPACE_END

#ifdef __cplusplus
static_assert(sizeof(gpu::MaterialCard) == 32);
#endif
#endif
