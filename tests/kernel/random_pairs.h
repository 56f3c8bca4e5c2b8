// Pairs of hulls of many forms and sizes, near each other.
#pragma once

#include "tests/kernel/hull_scene.h"

namespace kernel_test {

// Hulls of 4 to some 60 faces, some of them boxes and slivers, of radius 1 and less.
void addForms(HullScene& scene, std::mt19937& random, uint32_t count);
// Every other pair is turned against each other by no more than a hundredth, half of these the same hull twice. The lengths of
// both go from a millimeter to ten meters, within ten times of each other. They lie deep in each other, touch, or are apart.
// Hulls are copied to scale them, so a pair has two hulls of its own.
void addRandomPairs(HullScene& scene, std::mt19937& random, uint32_t forms, uint32_t count);

} // namespace kernel_test
