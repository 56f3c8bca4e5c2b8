// Bodies with more triangles than a device has room for.
#include "tests/abi/hosting.h"

#include <cmath>
#include <numbers>

namespace {

using namespace abi_test;

// A ball of rings, closed, with 2 * rings * around triangles.
struct FineBall {
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    FineBall(uint32_t rings, uint32_t around);
    BrittleMeshDef def() const;
};

FineBall::FineBall(uint32_t rings, uint32_t around) {
    const auto add = [&](double polar, double turn) {
        for (const double x : {std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)})
            positions.push_back(static_cast<float>(x));
    };
    for (uint32_t r = 1; r <= rings; ++r)
        for (uint32_t k = 0; k < around; ++k)
            add(std::numbers::pi * r / (rings + 1), 2 * std::numbers::pi * k / around);
    add(0, 0);
    add(std::numbers::pi, 0);
    const uint32_t top = rings * around, bottom = top + 1;
    const auto at = [&](uint32_t r, uint32_t k) { return r * around + k % around; };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) { indices.insert(indices.end(), {a, b, c}); };
    for (uint32_t k = 0; k < around; ++k) {
        triangle(top, at(0, k + 1), at(0, k));
        triangle(bottom, at(rings - 1, k), at(rings - 1, k + 1));
        for (uint32_t r = 0; r + 1 < rings; ++r) {
            triangle(at(r, k), at(r, k + 1), at(r + 1, k));
            triangle(at(r, k + 1), at(r + 1, k + 1), at(r + 1, k));
        }
    }
}

BrittleMeshDef FineBall::def() const {
    BrittleMeshDef def = brittleDefaultMeshDef();
    def.positions = positions.data();
    def.vertex_count = static_cast<uint32_t>(positions.size() / 3);
    def.indices = indices.data();
    def.index_count = static_cast<uint32_t>(indices.size());
    return def;
}

// Lavapipe can bind 128 MiB at once.
TEST(AbiWorld, RefusesABodyOfTooManyTrianglesWhenItIsAdded) {
    const Hosting host;
    BrittleWorld world;
    const BrittleWorldDef def = brittleDefaultWorldDef();
    MUST(host, brittleCreateWorld(host, &def, &world));
    BrittleBodyDef ball = brittleDefaultBodyDef();
    ball.shape.kind = BRITTLE_SHAPE_MESH;
    const FineBall fine(700, 1000);
    const BrittleMeshDef mesh = fine.def();
    MUST(host, brittleCreateMesh(host, &mesh, &ball.shape.mesh));
    BrittleBody body;
    ball.material = host.material("glass");
    EXPECT_EQ(brittleAddBody(host, world, &ball, &body), BRITTLE_CAPACITY);
    EXPECT_NE(host.error().find("body 0: a surface of 1400000 triangles"), std::string::npos) << host.error();
    ball.material = {};
    MUST(host, brittleAddBody(host, world, &ball, &body));
}

} // namespace
