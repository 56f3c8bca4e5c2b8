#include "tests/abi/hosting.h"

namespace abi_test {

BrittleContextDef defOn(const HostDevice& device) {
    BrittleContextDef def = brittleDefaultContextDef();
    def.vulkan = device.vulkan();
    return def;
}

Hosting::Hosting(const HostOptions& options, const BrittleAllocator& allocator) : device_(options) {
    BrittleContextDef def = defOn(device_);
    def.allocator = allocator;
    EXPECT_EQ(brittleCreateContext(&def, &context_), BRITTLE_OK);
}

Hosting::~Hosting() {
    brittleDestroyContext(context_);
    EXPECT_EQ(device_.messages(), 0u) << "messages from the validation layers";
}

BrittleMaterial Hosting::material(const char* name) const {
    BrittleMaterial material = {0};
    EXPECT_EQ(brittleFindMaterial(context_, name, &material), BRITTLE_OK) << error();
    return material;
}

BrittleBodyDef glassCube(const Hosting& host, double height) {
    BrittleBodyDef cube = brittleDefaultBodyDef();
    cube.material = host.material("glass");
    cube.shape.size = {0.2, 0.2, 0.2};
    cube.position.y = height;
    cube.rotation = {0.3, 0.1, 0.2, 1};
    return cube;
}

Scene makeScene(const Hosting& host, const std::vector<BrittleBodyDef>& bodies, const BrittleWorldDef& def, bool starts) {
    Scene scene;
    EXPECT_EQ(brittleCreateWorld(host, &def, &scene.world), BRITTLE_OK) << host.error();
    for (const BrittleBodyDef& body : bodies)
        EXPECT_EQ(brittleAddBody(host, scene.world, &body, &scene.bodies.emplace_back()), BRITTLE_OK) << host.error();
    const BrittleColliderDef ground = brittleDefaultColliderDef();
    EXPECT_EQ(brittleAddCollider(host, scene.world, &ground, &scene.ground), BRITTLE_OK) << host.error();
    if (starts) {
        EXPECT_EQ(brittleStartWorld(host, scene.world), BRITTLE_OK) << host.error();
    }
    return scene;
}

Scene makeScene(const Hosting& host, const std::vector<BrittleBodyDef>& bodies) {
    return makeScene(host, bodies, brittleDefaultWorldDef());
}

std::vector<BrittleBodyState> bodiesOf(const Hosting& host, BrittleWorld world) {
    uint32_t count = 0;
    brittleGetBodies(host, world, nullptr, 0, &count);
    std::vector<BrittleBodyState> states(count);
    EXPECT_EQ(brittleGetBodies(host, world, states.data(), count, &count), BRITTLE_OK) << host.error();
    return states;
}

std::vector<BrittleBreak> breaksOf(const Hosting& host, BrittleWorld world) {
    std::vector<BrittleBreak> breaks(4096);
    uint32_t count = 0;
    EXPECT_EQ(brittleGetBreaks(host, world, breaks.data(), static_cast<uint32_t>(breaks.size()), &count), BRITTLE_OK)
        << host.error();
    breaks.resize(count);
    return breaks;
}

BrittleCounts countsOf(const Hosting& host, BrittleWorld world) {
    BrittleCounts counts = {};
    counts.struct_size = sizeof counts;
    EXPECT_EQ(brittleGetCounts(host, world, &counts), BRITTLE_OK) << host.error();
    return counts;
}

std::vector<std::byte> savedOf(const Hosting& host, BrittleWorld world) {
    size_t size = 0;
    EXPECT_EQ(brittleSaveState(host, world, nullptr, 0, &size), BRITTLE_OK) << host.error();
    std::vector<std::byte> state(size);
    EXPECT_EQ(brittleSaveState(host, world, state.data(), size, &size), BRITTLE_OK) << host.error();
    return state;
}

uint64_t hashOf(const Hosting& host, BrittleWorld world) {
    uint64_t hash = 0;
    EXPECT_EQ(brittleHashState(host, world, &hash), BRITTLE_OK) << host.error();
    return hash;
}

BrittleMeshDef HostMesh::def() const {
    BrittleMeshDef def = brittleDefaultMeshDef();
    def.positions = positions.data();
    def.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    def.indices = indices.data();
    def.index_count = static_cast<uint32_t>(indices.size());
    return def;
}

HostMesh cubeMesh(double edge) {
    HostMesh mesh;
    const auto half = static_cast<float>(edge / 2);
    for (uint32_t k = 0; k < 8; ++k)
        for (uint32_t axis = 0; axis < 3; ++axis)
            mesh.positions.push_back((k >> axis & 1u) != 0 ? half : -half);
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return mesh;
}

} // namespace abi_test
