// Objects that the host broke, as the device would have left them, and a world on the device that adopts their fragments.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/hull.h"
#include "shaders-spirv/shared/pool.h"
#include "tests/module/whole_fracture.h"

#include <random>

namespace adopting {

constexpr uint64_t kSeed = 0x123456789abcdef0;
constexpr float kHold = 0.25f;
constexpr uint32_t kSteps = 41;       // that the world has made
constexpr uint32_t kMostReturned = 8; // objects

// A body that broke: its mesh and fragments about `center` of the frame of its vertices.
struct Object {
    whole::Model model;
    brittle::FractureResult result;
    double unit = 1; // meters in half its grid's edge
    brittle::Double3 center = {0, 0, 0};
    gpu::BodyState state;
    gpu::BodyShape shape;
    gpu::BreakableBody body;
};

// One that the pattern breaks into so many cells, or that breaks about given sites.
struct ToBreak {
    whole::Model model;
    uint32_t sites = 1;
    std::vector<brittle::Double3> given;
};

// A fragment of an event, in which objects take turns.
struct Part {
    uint32_t object = 0, fragment = 0;
    gpu::uvec4 room;
};

struct Scene {
    std::vector<Object> objects;
    std::vector<Part> parts;
    gpu::uvec4 sizes; // of the world's pools, by ROOM_*
};

// Of the fragment with that number, in the tile of its object.
std::array<int32_t, 3> siteOf(uint32_t number);

// Breaks all at once; each body is somewhere far from the origin, moves and spins.
Scene breakTogether(std::vector<ToBreak> objects, uint64_t seed = 1);
// The object stays whole.
void refuse(Scene& scene, uint32_t object);

struct World {
    std::vector<gpu::BodyState> bodies;
    std::vector<gpu::BodyShape> shapes;
    std::vector<gpu::PieceRecord> pieces;
    std::vector<gpu::HullRecord> hulls;
    std::vector<gpu::vec4> hull_vertices;
    std::vector<gpu::HullFace> hull_faces;
    std::vector<uint32_t> hull_corners;
    std::vector<gpu::uvec4> hull_edges;
    std::vector<gpu::BreakableBody> breakable;
    std::vector<brittle::FragmentVertex> vertices;
    std::vector<uint32_t> adopted;
    std::vector<gpu::PoolShare> returned; // by object
};

// Before anything is adopted: bodies that broke, and bytes that nobody writes by chance.
World emptyWorld(const Scene& scene);
struct How {
    uint32_t group_size = 64;
    bool retire = false;
    bool failed = false; // the event
};
World adopt(const Scene& scene, const How& how = {});
// Of all but `adopted`.
bool sameBytes(const World& a, const World& b);

} // namespace adopting
