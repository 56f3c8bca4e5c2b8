// Models whose cut faces have thousands of sides: fine surfaces in few pieces.
#include "tests/module/whole_fracture.h"
#include "tests/support/rough_block.h"

#include <gtest/gtest.h>

using namespace whole;

// The cut passes through the tops of the field: an outline of thousands of sides, with islands and holes.
TEST(VastFaces, OfARoughFieldHoldTheContract) {
    const Model model = modelFrom(support::roughBlock(90));
    brittle::FractureOptions options;
    options.given_sites = {{0.5, 0.302, 0.5}, {0.5, 0.317, 0.5}};
    expectContract(model, options);
}
