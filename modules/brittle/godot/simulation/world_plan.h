// What a world is to be made of, in memory of its own, so that it can be gathered on one thread and made on another.
#pragma once

#include "modules/brittle/brittle.h"

#include <string>
#include <vector>

namespace brittle_godot {

// Triangles, counterclockwise seen from outside.
struct Triangles {
    std::vector<float> positions, normals, uvs; // 3, 3 and 2 a vertex; the last two may be empty
    std::vector<uint32_t> indices;
    size_t vertexCount() const { return positions.size() / 3; }
};

struct MeshPlan {
    Triangles triangles;
    bool is_open = false; // for colliders
};

struct MaterialPlan {
    BrittleMaterialDef def; // but for `like`
    std::string like;
};

constexpr size_t kNone = ~size_t{0};

struct BodyPlan {
    std::string who; // for messages
    bool is_collider = false;
    BrittleBodyDef def;                    // of a collider what colliders have
    size_t mesh = kNone, material = kNone; // of the plan's
    std::vector<BrittleVec3> hull;         // points, of a hull
};

struct WorldPlan {
    BrittleWorldDef def;
    std::vector<MeshPlan> meshes;
    std::vector<MaterialPlan> materials;
    std::vector<BodyPlan> bodies;
};

} // namespace brittle_godot
