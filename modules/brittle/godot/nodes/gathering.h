// Finds the bodies below a world's node and plans the world that is made of them.
#pragma once

#include "modules/brittle/godot/conversion/placement.h"
#include "modules/brittle/godot/nodes/brittle_body.h"
#include "modules/brittle/godot/simulation/world_plan.h"

#include <map>

namespace brittle_godot {

// Which node, or copy of it, a body of the plan is, and how the one's transform follows from the other's.
struct Link {
    BodyNode* node = nullptr;
    size_t copy = 0;
    Transform from_body; // of the node, in the frame of the body's shape
};

struct Gathered {
    WorldPlan plan;
    std::vector<Link> links; // as the plan's bodies
};

// Of all BrittleBody3D below `world`, in the order of the tree, but for those below another BrittleWorld3D. Throws Failure,
// which names the node.
Gathered gather(const Value& world, const BrittleWorldDef& def);

} // namespace brittle_godot
