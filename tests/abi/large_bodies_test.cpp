// Bodies with more triangles than a device has room for.
#include "tests/abi/hosting.h"

#include <cmath>
#include <numbers>

namespace {

using namespace abi_test;

// A ball of rings, closed, with 2 * rings * around triangles.
HostMesh fineBall(uint32_t rings, uint32_t around) {
    HostMesh ball;
    const auto add = [&](double polar, double turn) {
        for (const double x : {std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)})
            ball.positions.push_back(static_cast<float>(x));
    };
    for (uint32_t r = 1; r <= rings; ++r)
        for (uint32_t k = 0; k < around; ++k)
            add(std::numbers::pi * r / (rings + 1), 2 * std::numbers::pi * k / around);
    add(0, 0);
    add(std::numbers::pi, 0);
    const uint32_t top = rings * around, bottom = top + 1;
    const auto at = [&](uint32_t r, uint32_t k) { return r * around + k % around; };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) { ball.indices.insert(ball.indices.end(), {a, b, c}); };
    for (uint32_t k = 0; k < around; ++k) {
        triangle(top, at(0, k + 1), at(0, k));
        triangle(bottom, at(rings - 1, k), at(rings - 1, k + 1));
        for (uint32_t r = 0; r + 1 < rings; ++r) {
            triangle(at(r, k), at(r, k + 1), at(r + 1, k));
            triangle(at(r, k + 1), at(r + 1, k + 1), at(r + 1, k));
        }
    }
    return ball;
}

// Lavapipe can bind 128 MiB at once.
TEST(AbiWorld, RefusesABodyOfTooManyTrianglesWhenItIsAdded) {
    const Hosting host;
    BrittleWorld world;
    const BrittleWorldDef def = brittleDefaultWorldDef();
    MUST(host, brittleCreateWorld(host, &def, &world));
    BrittleBodyDef ball = brittleDefaultBodyDef();
    ball.shape.kind = BRITTLE_SHAPE_MESH;
    const HostMesh fine = fineBall(700, 1000);
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
