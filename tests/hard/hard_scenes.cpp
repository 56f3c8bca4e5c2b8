#include "tests/hard/moving_scenes.h"
#include "tests/hard/refusing_scenes.h"
#include "tests/hard/resting_scenes.h"

namespace hard {
namespace {

constexpr bool kLong = true;

constexpr SceneCase kCases[] = {
    {"hard_01_block_100", staysAtRest},
    {"hard_01_block_500", staysAtRest},
    {"hard_01_block_2000", staysAtRest, 0, kLong},
    {"hard_02_standing_block", standsOnOneCorner},
    {"hard_03_overlap_1cm", comesApartGently},
    {"hard_03_overlap_10cm", comesApartGently},
    {"hard_04_inflated_100um", grownCellsStaySlow},
    {"hard_04_inflated_1mm", grownCellsStaySlow},
    {"hard_04_inflated_10mm", grownCellsStaySlow, 1},
    {"hard_05_stack_10", stackStands, 1e-3},
    {"hard_05_stack_20", stackStands, 5e-3},
    {"hard_05_stack_40", stackStands, 30e-3, kLong},
    {"hard_06_heavy_on_light_10", lightCarriesHeavy, 3e-3},
    {"hard_06_heavy_on_light_100", lightCarriesHeavy, 10e-3},
    {"hard_07_card_house", cardsStand},
    {"hard_08_intermediate_axis", spinsFreely},
    {"hard_09_thin_rod", spinsFreely},
    {"hard_10_wall_300", stopsAtTheWall, 300},
    {"hard_10_wall_1000", stopsAtTheWall, 1000},
    {"hard_11_plate_300", pushesThePlate},
    {"hard_11_plate_1000", pushesThePlate},
    {"hard_13_head_on", bouncesBack},
    {"hard_14_flat_plate_20mm", liesFlat, 0.02},
    {"hard_14_flat_plate_2mm", liesFlat, 0.002},
    {"hard_15_slivers_20mm", sliversRest, 0.02},
    {"hard_15_slivers_1mm", sliversRest, 0.001},
    {"hard_16_slope_55", holdsOnTheSlope},
    {"hard_16_slope_45", slidesDownTheSlope},
    {"hard_17_bounce_100", bounces, 2},
    {"hard_17_bounce_50", bounces, 0.5},
    {"hard_18_implosion", implodes},
    {"hard_19_far_100km", movesAlikeFarAway},
    {"hard_20_pile_1000", pileSettles},
    {"hard_20_piles_of_1000", pilesComeToRest, 0, kLong},
    {"hard_20_pile_5000", largePileSettles, 0, kLong},
    {"hard_22_far_body", findsAllPairs},
    {"hard_23_crowded_slab", slabHoldsAll},
    {"hard_24_overflow", overflowLosesNothing},
    {"hard_25", isRefused},
    {"hard_26", isRefused},
    {"hard_29_determinism", isTheSameHoweverMade, 0, kLong},
    {"hard_30_reference", movesAsTheReference},
    {"hard_31_weights", weighsAlike},
    {"hard_31_sizes", scalesAlike},
    {"hard_32_sleep", allSleep},
    {"hard_33_rest", hardlyCreeps, 0, kLong},
};

} // namespace

std::span<const SceneCase> sceneCases() { return kCases; }

} // namespace hard
