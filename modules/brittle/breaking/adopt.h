// The last thing that becomes of objects that break: their fragments become bodies of the world that goes on, each as heavy, in
// the place and in the motion that it had as a part; and the bodies that they were parts of leave it. All on the device.
#pragma once

#include "modules/brittle/breaking/surface_list.h"
#include "modules/brittle/dynamics/narrow_phase.h"
#include "modules/brittle/fracture/collider_pools.h"
#include "modules/brittle/fracture/recorder.h"
#include "shaders-spirv/shared/breaking.h"

namespace brittle {

// What an event leaves, with counts that Recorder::counts() holds: COUNT_FRAGMENTS published, and COUNT_BREAKING.
struct BrokenParts {
    engine::BufferView fragments; // FragmentRecord
    engine::BufferView sites;     // ivec4, in the tiles of their objects
    engine::BufferView vertices;  // SceneVertex, three a triangle; so many as can be bound at once
    ColliderPools colliders;
    engine::BufferView breaking; // BreakingRecord, by object: centers and units
    engine::BufferView broken;   // BrokenBody, by object: which body it is
    engine::BufferView rooms;    // uvec4, by fragment, ROOM_*; ROOM_BODY is NO_INDEX for what stays a part of its body
};

struct BreakableWorld {
    engine::BufferView bodies, shapes, pieces;
    HullPools hulls;              // vertices, edges and corners as many times a hull's first face as shared/breaking.h says
    engine::BufferView breakable; // BreakableBody, by slot of a body
    SurfaceList surfaces;
    engine::BufferView cards;  // MaterialCard
    engine::BufferView steps;  // STEPS_*
    engine::BufferView births; // Birth, by slot of a body
};

// How strong fragments are is drawn by this seed; for so long no blow breaks them.
struct FragmentSettings {
    uint64_t seed = 0;
    float hold = 0;     // s
    float duration = 0; // of a step, s
};

// Writes all of a body to the slots that its room names, and nothing else. `adopted`: a word an object, not 0 for those whose
// fragments have become bodies.
void recordAdoption(Recorder& record, const BrokenParts& parts, const BreakableWorld& world, const FragmentSettings& settings,
                    engine::BufferView adopted);

// After that, for the same objects: their bodies are absent, with no mass, no motion and no pieces, and cannot break.
// `returned`: a PoolShare an object, what it had of the pools, nothing for those that stay whole.
void recordRetirement(Recorder& record, const BrokenParts& parts, const BreakableWorld& world, engine::BufferView adopted,
                      engine::BufferView returned);

} // namespace brittle
