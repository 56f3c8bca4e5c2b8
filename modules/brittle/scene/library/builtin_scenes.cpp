#include "modules/brittle/scene/library/builtin_scenes.h"

#include "modules/brittle/scene/library/hard_scenes.h"
#include "modules/brittle/scene/library/long_motions.h"
#include "modules/brittle/scene/library/long_stacks.h"
#include "modules/brittle/scene/nearest_name.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace brittle {
namespace {

using namespace library;

// A name with a number of its own choice at the end.
struct Family {
    std::string_view prefix;
    SceneDescription (*make)(uint32_t parameter);
    uint32_t most;
};
constexpr Family kFamilies[] = {{"hull_pile_", hullPile, 100'000}, {"stack_", stack, 1'000}};

std::optional<uint32_t> numberAfter(std::string_view prefix, std::string_view name, uint32_t most) {
    if (!name.starts_with(prefix)) return {};
    const std::string_view digits = name.substr(prefix.size());
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool is_number = error == std::errc() && end == digits.data() + digits.size() && !digits.starts_with('0');
    return is_number && number >= 1 && number <= most ? std::optional(number) : std::nullopt;
}

SceneDescription named(SceneDescription scene, std::string_view name) {
    scene.name = name;
    return scene;
}

engine::Error noScene(std::string_view name) {
    std::vector<std::string_view> names;
    for (const SceneEntry& entry : builtinScenes())
        names.push_back(entry.name);
    return {engine::ErrorCode::BadInput,
            "no built-in scene " + inQuotes(name) + didYouMean(name, names, "; brittle scenes lists them")};
}

} // namespace

// 21 waits for fracture in the world; 25 and 26 are refusedScenes(); 27 and 28 compare pairs of hulls and need no world.
const std::vector<SceneEntry>& builtinScenes() {
    static const std::vector<SceneEntry> kScenes = {
        {"hull_pile_100", hullPile, 100},
        {"hull_pile_1000", hullPile, 1000},
        {"hull_pile_5000", hullPile, 5000},
        {"stack_10", stack, 10},
        {"stack_40", stack, 40},
        {"bounce", bounce, 50},
        {"slope", slope, 45},
        {"card_house", cardHouse, 3},
        {"hard_01_block_100", weightlessBlock, 100},
        {"hard_01_block_500", weightlessBlock, 500},
        {"hard_01_block_2000", weightlessBlock, 2000},
        {"hard_02_standing_block", standingBlock, 500},
        {"hard_03_overlap_1cm", overlappingCubes, 10},
        {"hard_03_overlap_10cm", overlappingCubes, 100},
        {"hard_04_inflated_100um", inflatedBlock, 100},
        {"hard_04_inflated_1mm", inflatedBlock, 1000},
        {"hard_04_inflated_10mm", inflatedBlock, 10'000},
        {"hard_05_stack_10", stack, 10},
        {"hard_05_stack_20", stack, 20},
        {"hard_05_stack_40", stack, 40},
        {"hard_06_heavy_on_light_10", heavyOnLight, 10},
        {"hard_06_heavy_on_light_100", heavyOnLight, 100},
        {"hard_06_heavy_on_light_1000", heavyOnLight, 1000},
        {"hard_07_card_house", cardHouse, 3},
        {"hard_08_intermediate_axis", intermediateAxis},
        {"hard_09_thin_rod", thinRod},
        {"hard_10_wall_300", cubeAtWall, 300},
        {"hard_10_wall_1000", cubeAtWall, 1000},
        {"hard_11_plate_300", cubeAtPlate, 300},
        {"hard_11_plate_1000", cubeAtPlate, 1000},
        {"hard_12_spinning_rods", spinningRods, 24},
        {"hard_13_head_on", cubesHeadOn, 120},
        {"hard_14_flat_plate_20mm", flatPlate, 20},
        {"hard_14_flat_plate_2mm", flatPlate, 2},
        {"hard_15_slivers_20mm", slivers, 20},
        {"hard_15_slivers_1mm", slivers, 1},
        {"hard_16_slope_55", slope, 55},
        {"hard_16_slope_45", slope, 45},
        {"hard_17_bounce_100", bounce, 100},
        {"hard_17_bounce_50", bounce, 50},
        {"hard_18_implosion", implosion, 200},
        {"hard_19_far_0km", farStack, 0},
        {"hard_19_far_10km", farStack, 10},
        {"hard_19_far_100km", farStack, 100},
        {"hard_20_pile_1000", hullPile, 1000},
        {"hard_20_pile_5000", hullPile, 5000},
        {"hard_22_far_body", farBody, 10'000},
        {"hard_23_crowded_slab", crowdedSlab, 1000},
        {"hard_24_overflow", overflow, 100},
        {"hard_29_determinism", longPile, 1000},
        {"hard_30_reference", shortStack, 10},
        {"hard_31_edge_10mm", scaledStack, 10},
        {"hard_31_edge_100mm", scaledStack, 100},
        {"hard_31_edge_1m", scaledStack, 1000},
        {"hard_31_edge_10m", scaledStack, 10'000},
        {"hard_31_edge_100m", scaledStack, 100'000},
        {"hard_31_density_10", weighedStack, 10},
        {"hard_31_density_10000", weighedStack, 10'000},
        {"hard_32_sleep", sleepyPile, 1000},
        {"hard_33_rest", restingBlock, 100'000},
        {"hard_34_stack_8_of_1m", tallStack, 0},
        {"hard_34_stack_10_of_10cm", tallStack, 1},
        {"hard_34_stack_10_of_5cm", tallStack, 2},
        {"hard_34_stack_5_of_5mm", tallStack, 3},
        {"hard_34_stack_5_of_2mm", tallStack, 4},
        {"hard_34_stack_6_of_5cm_10g", tallStack, 5},
        {"hard_34_stack_40_of_1m", tallStack, 6},
        {"hard_34_stack_40_of_2mm", tallStack, 7},
        {"hard_34_stack_20_of_10m_10g", tallStack, 8},
        {"hard_34_stack_4_of_5cm_10g", tallStack, 9},
        {"hard_34_stack_5_of_2mm_10g", tallStack, 10},
        {"hard_34_stack_40_of_2mm_10g", tallStack, 11},
        {"hard_35_dropped_5", heavyDropped, 5},
        {"hard_35_dropped_10", heavyDropped, 10},
        {"hard_35_dropped_30", heavyDropped, 30},
        {"hard_35_dropped_60", heavyDropped, 60},
        {"hard_35_dropped_100", heavyDropped, 100},
        {"hard_35_dropped_250", heavyDropped, 250},
        {"hard_35_dropped_300", heavyDropped, 300},
        {"hard_35_dropped_1000_hard", heavyDroppedHard, 1000},
        {"hard_35_dropped_150_of_10cm", smallHeavyDropped, 150},
        {"hard_35_dropped_150_of_10m", largeHeavyDropped, 150},
        {"hard_35_dropped_cylinder_60", heavyCylinderDropped, 60},
        {"hard_35_placed_10", heavyPlaced, 10},
        {"hard_35_placed_100", heavyPlaced, 100},
        {"hard_35_placed_250", heavyPlaced, 250},
        {"hard_35_placed_300", heavyPlaced, 300},
        {"hard_35_placed_1000", heavyPlaced, 1000},
        {"hard_36_slide_tiles_slow", slider, 0},
        {"hard_36_slide_tiles", slider, 1},
        {"hard_36_slide_tiles_1m_s", slider, 11},
        {"hard_36_slide_tiles_fast", slider, 2},
        {"hard_36_slide_tiles_1cm", slider, 3},
        {"hard_36_slide_steps", slider, 4},
        {"hard_36_slide_cells", slider, 5},
        {"hard_36_slide_triangles", slider, 6},
        {"hard_36_slide_sheet_slow", slider, 7},
        {"hard_36_slide_sheet", slider, 8},
        {"hard_36_slide_plane", slider, 9},
        {"hard_36_slide_wedge", slider, 10},
        {"hard_37_elastic_2", elasticDrop, 2},
        {"hard_37_elastic_10", elasticDrop, 10},
        {"hard_37_elastic_tilted", elasticTilted, 100},
        {"hard_37_elastic_tumbling_2", elasticTumbling, 2},
        {"hard_37_elastic_tumbling_10", elasticTumbling, 10},
        {"hard_38_cradle_touching", cradle, 0},
        {"hard_38_cradle_1mm", cradle, 1},
        {"hard_38_cradle_10mm", cradle, 10},
        {"hard_39_arch_9", arch, 9},
        {"hard_39_arch_21", arch, 21},
        {"hard_39_arch_21_for_a_minute", longArch, 21},
        {"hard_40_compounds_10", compoundsAtWall, 10},
        {"hard_40_compounds_100", compoundsAtWall, 100},
        {"hard_40_compounds_300", compoundsAtWall, 300},
        {"hard_40_compounds_1000", compoundsAtWall, 1000},
        {"hard_41_slope_99", steepSlope, 99},
        {"hard_43_tiny", tinyBodies},
    };
    return kScenes;
}

engine::Result<SceneDescription> makeBuiltinScene(std::string_view name) {
    for (const SceneEntry& entry : builtinScenes())
        if (entry.name == name) return named(entry.make(entry.parameter), name);
    for (const Family& family : kFamilies)
        if (const auto number = numberAfter(family.prefix, name, family.most)) return named(family.make(*number), name);
    return noScene(name);
}

} // namespace brittle
