#include "modules/brittle/breaking/adopt.h"

namespace brittle {

void recordAdoption(Recorder& record, const BrokenParts& parts, const BreakableWorld& world, const FragmentSettings& settings,
                    engine::BufferView adopted) {
    struct Push {
        uint32_t seed_low, seed_high;
        float hold, duration;
    } push = {static_cast<uint32_t>(settings.seed), static_cast<uint32_t>(settings.seed >> 32), settings.hold,
              settings.duration};
    const engine::BufferView groups = record.groupsOf(COUNT_FRAGMENTS);
    record.commands().beginLabel("adopt");
    record.clear({adopted});
    record.run("weigh_fragments", Length::counted(COUNT_FRAGMENTS), push,
               {record.counts(), parts.fragments, parts.sites, parts.colliders.records, parts.colliders.vertices,
                parts.breaking, parts.broken, parts.rooms, world.cards, world.steps, adopted, world.bodies, world.shapes,
                world.breakable, world.births});
    record.runGroups("adopt_hulls", groups, engine::NoPush{},
                     {record.counts(), parts.fragments, parts.sites, parts.breaking, parts.rooms, world.breakable,
                      parts.colliders.records, parts.colliders.faces, parts.colliders.vertices, parts.colliders.corners,
                      world.hulls.records, world.hulls.vertices, world.hulls.faces, world.hulls.corners, world.hulls.edges,
                      world.pieces, world.shapes});
    for (const SurfacePart& part : world.surfaces.parts()) {
        record.runGroups("adopt_surfaces", groups, part.range,
                         {record.counts(), parts.fragments, parts.sites, parts.breaking, parts.rooms, parts.vertices,
                          part.vertices, world.breakable});
    }
    record.commands().endLabel();
}

void recordRetirement(Recorder& record, const BrokenParts& parts, const BreakableWorld& world, engine::BufferView adopted,
                      engine::BufferView returned) {
    record.commands().beginLabel("retire");
    record.run("retire_bodies", Length::counted(COUNT_BREAKING), engine::NoPush{},
               {record.counts(), parts.broken, adopted, world.shapes, world.hulls.records, world.bodies, world.breakable,
                world.pieces, returned, world.steps});
    record.commands().endLabel();
}

} // namespace brittle
