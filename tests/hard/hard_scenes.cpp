#include "tests/hard/long_motions.h"
#include "tests/hard/moving_scenes.h"
#include "tests/hard/refusing_scenes.h"
#include "tests/hard/resting_scenes.h"

#include <algorithm>
#include <iterator>

namespace hard {
namespace {

constexpr bool kLong = true;

constexpr SceneCase kSceneCases[] = {
    {"hard_01_block_100", staysAtRest},
    {"hard_01_block_500", staysAtRest},
    {"hard_01_block_2000", staysAtRest, 0, kLong},
    {"hard_02_standing_block", standsOnOneCorner},
    {"hard_03_overlap_1cm", comesApartGently},
    {"hard_03_overlap_10cm", comesApartGently},
    {"hard_04_inflated_100um", grownCellsStaySlow},
    {"hard_04_inflated_1mm", grownCellsStaySlow},
    {"hard_04_inflated_10mm", grownCellsStaySlow},
    {"hard_05_stack_10", stackStands, 1e-3},
    {"hard_05_stack_20", stackStands, 5e-3},
    {"hard_05_stack_40", stackStands, 30e-3, kLong},
    {"hard_06_heavy_on_light_10", lightCarriesHeavy, 3e-3},
    {"hard_06_heavy_on_light_100", lightCarriesHeavy, 10e-3},
    {"hard_06_heavy_on_light_1000", lightCarriesHeavy, 20e-3},
    {"hard_07_card_house", cardsStand},
    {"hard_08_intermediate_axis", spinsFreely},
    {"hard_09_thin_rod", spinsFreely},
    {"hard_10_wall_300", stopsAtTheWall, 300},
    {"hard_10_wall_1000", stopsAtTheWall, 1000},
    {"hard_11_plate_300", pushesThePlate},
    {"hard_11_plate_1000", pushesThePlate},
    {"hard_12_spinning_rods", hitTheirPosts},
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
    {"hard_34_stack_8_of_1m", towerStands},
    {"hard_34_stack_10_of_10cm", towerStands, 0, kLong},
    {"hard_34_stack_10_of_5cm", towerStands, 0, kLong},
    {"hard_34_stack_5_of_5mm", towerStands, 0, kLong},
    {"hard_34_stack_5_of_2mm", towerStands},
    {"hard_34_stack_6_of_5cm_10g", towerStands},
    {"hard_34_stack_40_of_1m", towerStands, 0, kLong},
    {"hard_34_stack_40_of_2mm", towerStands, 0, kLong},
    {"hard_34_stack_20_of_10m_10g", towerStands, 0, kLong},
    {"hard_34_stack_4_of_5cm_10g", towerStands, 0, kLong},
    {"hard_34_stack_5_of_2mm_10g", towerStands},
    {"hard_34_stack_40_of_2mm_10g", towerStands, 0, kLong},
    {"hard_35_dropped_5", heavyStands, 0, kLong},
    {"hard_35_dropped_10", heavyStands},
    {"hard_35_dropped_30", heavyStands, 0, kLong},
    {"hard_35_dropped_60", heavyStands, 0, kLong},
    {"hard_35_dropped_100", heavyStands},
    {"hard_35_dropped_250", heavyStands, 0, kLong},
    {"hard_35_dropped_300", heavyStands},
    {"hard_35_dropped_1000_hard", heavyStands},
    {"hard_35_dropped_150_of_10cm", heavyStands},
    {"hard_35_dropped_150_of_10m", heavyStands},
    {"hard_35_dropped_cylinder_60", heavyStands},
    {"hard_35_placed_10", heavyStands, 0, kLong},
    {"hard_35_placed_100", heavyStands, 0, kLong},
    {"hard_35_placed_250", heavyStands, 0, kLong},
    {"hard_35_placed_300", heavyStands},
    {"hard_35_placed_1000", heavyStands},
    {"hard_36_slide_tiles_slow", keepsItsSpeed},
    {"hard_36_slide_tiles", keepsItsSpeed},
    {"hard_36_slide_tiles_1m_s", keepsItsSpeed},
    {"hard_36_slide_tiles_fast", keepsItsSpeed},
    {"hard_36_slide_tiles_1cm", keepsItsSpeed},
    {"hard_36_slide_steps", keepsItsSpeed},
    {"hard_36_slide_cells", keepsItsSpeed},
    {"hard_36_slide_triangles", keepsItsSpeed},
    {"hard_36_slide_sheet_slow", keepsItsSpeed},
    {"hard_36_slide_sheet", keepsItsSpeed},
    {"hard_36_slide_plane", keepsItsSpeed},
    {"hard_36_slide_wedge", keepsItsSpeed},
    {"hard_37_elastic_2", keepsItsTops, 2},
    {"hard_37_elastic_10", keepsItsTops, 10},
    {"hard_37_elastic_tilted", keepTheirEnergy},
    {"hard_37_elastic_tumbling_2", keepTheirEnergy},
    {"hard_37_elastic_tumbling_10", keepTheirEnergy},
    {"hard_38_cradle_touching", passTheBlowOn},
    {"hard_38_cradle_1mm", passTheBlowOn},
    {"hard_38_cradle_10mm", passTheBlowOn},
    {"hard_39_arch_9", archStands, 10e-3},
    {"hard_39_arch_21", archStands, 25e-3},
    {"hard_39_arch_21_for_a_minute", archStands, 25e-3, kLong},
    {"hard_40_compounds_10", stopWhereTheyTouch, 10},
    {"hard_40_compounds_100", stopWhereTheyTouch, 100},
    {"hard_40_compounds_300", stopWhereTheyTouch, 300},
    {"hard_40_compounds_1000", stopWhereTheyTouch, 1000},
    {"hard_41_slope_99", liesForMinutes, 0, kLong},
    {"hard_42_scales", movesAlikeAtEveryScale},
    {"hard_42_scales_of_cases", casesMoveAlikeAtEveryScale, 0, kLong},
    {"hard_43_tiny", tinyBodiesRest, 0, kLong},
};

constexpr decltype(SceneCase::measure) kJudgesOfMotion[] = {archStands,     heavyStands,    keepTheirEnergy, keepsItsSpeed,
                                                            keepsItsTops,   liesForMinutes, passTheBlowOn,   stopWhereTheyTouch,
                                                            tinyBodiesRest, towerStands};

} // namespace

bool judgesMotionAlone(const SceneCase& self) {
    return std::ranges::find(kJudgesOfMotion, self.measure) != std::end(kJudgesOfMotion);
}

std::span<const SceneCase> sceneCases() { return kSceneCases; }

} // namespace hard
