#include "tests/module/adopted_bodies.h"

#include "modules/brittle/dynamics/piece_shape.h"
#include "modules/brittle/mesh/measures.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace adopting {

using brittle::Double3, brittle::Fragment;

Vector3d placeOf(const gpu::BodyState& s) {
    return double{SECTOR_EDGE} * Vector3d(s.sector.x, s.sector.y, s.sector.z) + vec(s.offset);
}

const Fragment& fragmentOf(const Scene& scene, const Part& part) {
    return scene.objects[part.object].result.fragments.fragments[part.fragment];
}
double wholeMass(const Object& o) { return 1 / double{o.state.offset.w}; }
double densityOf(const Object& o) { return wholeMass(o) / double{o.body.form.x}; }
Quaterniond frameOf(const Object& o) { return rotation(o.state.turn) * rotation(o.body.turn); }
Vector3d wayTo(const Object& o, const Double3& p) { return frameOf(o) * (vec(p) + vec(o.center) - vec(o.body.balance)); }

Vector3d momentsOf(const gpu::BodyShape& s) {
    return {1 / double{s.inverse_inertia[0].x}, 1 / double{s.inverse_inertia[1].y}, 1 / double{s.inverse_inertia[2].z}};
}

namespace {

Matrix3d inertiaOf(const gpu::BodyState& state, const gpu::BodyShape& shape) {
    const Matrix3d axes = rotation(state.turn).toRotationMatrix();
    return axes * momentsOf(shape).asDiagonal() * axes.transpose();
}

// The same bodies as the host makes them for a scene that begins broken.
brittle::BodyDefinition definitionOf(const Scene& scene, const Part& part) {
    const Object& o = scene.objects[part.object];
    const Fragment& f = fragmentOf(scene, part);
    const Vector3d way = wayTo(o, f.centroid), spin = vec(o.state.spin);
    const Quaterniond frame = frameOf(o);
    brittle::BodyDefinition body;
    body.pieces = {pieceOf(o.result.fragments.colliders, o.result.fragments.colliders.pieces[part.fragment], f.centroid)};
    body.place = triple(placeOf(o.state) + way);
    body.turn = {frame.x(), frame.y(), frame.z(), frame.w()};
    body.velocity = triple(vec(o.state.velocity) + spin.cross(way));
    body.spin = triple(spin);
    body.mass = densityOf(o) * f.volume;
    for (size_t k = 0; k < 6; k++)
        body.inertia[k] = densityOf(o) * f.inertia[k];
    body.friction = double{o.shape.inverse_inertia[0].w};
    body.restitution = double{o.shape.inverse_inertia[1].w};
    return body;
}

// One body of the host next to one of the device.
struct Pair {
    const brittle::WorldContents& host;
    uint32_t number;
    const World& world;
    gpu::uvec4 room;
    const Object& whole;

    const gpu::BodyState& wanted() const { return host.bodies[number]; }
    const gpu::BodyState& state() const { return world.bodies[room.x]; }
    const gpu::BodyShape& wantedShape() const { return host.shapes[number]; }
    const gpu::BodyShape& shape() const { return world.shapes[room.x]; }
    const gpu::HullRecord& wantedHull() const { return host.hulls.records[number]; }
    const gpu::HullRecord& hull() const { return world.hulls[room.y]; }
    double reach() const { return double{wantedShape().inverse_inertia[2].w}; }
    const gpu::vec4& vertex(uint32_t v) const { return world.hull_vertices[hull().first.x + v]; }
    const gpu::HullFace& face(uint32_t f) const { return world.hull_faces[hull().first.y + f]; }
    uint32_t corner(const gpu::HullFace& f, uint32_t c) const { return world.hull_corners[f.loop.x + c % f.loop.y]; }
};

void expectMotion(const Pair& p) {
    EXPECT_NEAR(p.state().offset.w, p.wanted().offset.w, 1e-6f * p.wanted().offset.w);
    EXPECT_LE((placeOf(p.state()) - placeOf(p.wanted())).norm(), 1e-6 + 1e-6 * p.reach());
    for (const float x : {p.state().offset.x, p.state().offset.y, p.state().offset.z})
        EXPECT_TRUE(x >= -8 && x < 8);
    // The rim of a spinning body hundreds of meters wide moves at kilometers a second; floats hold that to 0.5 mm/s.
    const double diagonal = brittle::measureMesh(p.whole.model.prepared.mesh).diagonal,
                 rim = vec(p.wanted().spin).norm() * diagonal;
    EXPECT_LE((vec(p.state().velocity) - vec(p.wanted().velocity)).norm(), std::max(1e-4, 1e-7 * rim));
    EXPECT_EQ(vec(p.state().spin), vec(p.wanted().spin));
    // Rounding is a share of the largest moment times the spin. A rod that spins about its length has far less momentum than
    // that.
    const double most = inertiaOf(p.wanted(), p.wantedShape()).norm() * vec(p.wanted().spin).norm();
    EXPECT_LE((vec(p.state().momentum) - vec(p.wanted().momentum)).norm(), 1e-6 * most);
    EXPECT_NEAR(vec(p.state().turn).squaredNorm() + std::pow(double{p.state().turn.w}, 2), 1, 1e-6);
    EXPECT_EQ(p.state().velocity.w, 0);
    EXPECT_EQ(p.state().sector.w & BODY_ASLEEP, 0);
}

void expectInertia(const Pair& p) {
    const Matrix3d is = inertiaOf(p.state(), p.shape()), wanted = inertiaOf(p.wanted(), p.wantedShape());
    EXPECT_LE((is - wanted).norm(), 3e-6 * wanted.norm());
    // A rod that spins about its length has little momentum for its largest moment, of which the error is a part.
    const Vector3d spin = vec(p.state().spin);
    EXPECT_LE((vec(p.state().momentum) - is * spin).norm(), 1.5e-6 * is.norm() * spin.norm());
    Vector3d moments = momentsOf(p.shape()), others = momentsOf(p.wantedShape());
    std::ranges::sort(moments);
    std::ranges::sort(others);
    for (int k = 0; k < 3; k++)
        EXPECT_NEAR(moments[k], others[k], 1e-5 * others[k]) << k;
    EXPECT_LE(moments[2], (moments[0] + moments[1]) * (1 + 1e-6));
}

void expectShape(const Pair& p) {
    const gpu::BodyShape &is = p.shape(), &wanted = p.wantedShape();
    EXPECT_EQ(is.pieces.x, p.room.y);
    EXPECT_EQ(is.pieces.y, 1u);
    EXPECT_EQ(is.pieces.w, 0u);
    EXPECT_NEAR(std::bit_cast<float>(is.pieces.z), std::bit_cast<float>(wanted.pieces.z), 1e-5 * p.reach());
    EXPECT_EQ(is.inverse_inertia[0].w, wanted.inverse_inertia[0].w);
    EXPECT_EQ(is.inverse_inertia[1].w, wanted.inverse_inertia[1].w);
    EXPECT_NEAR(is.inverse_inertia[2].w, wanted.inverse_inertia[2].w, 3e-6 * p.reach());
    for (size_t row = 0; row < 3; row++)
        for (size_t k = 0; k < 3; k++)
            EXPECT_TRUE(row == k || (&is.inverse_inertia[row].x)[k] == 0);
    const gpu::uvec4& ids = p.world.pieces[p.room.y].ids;
    EXPECT_EQ((std::array{ids.x, ids.y, ids.z, ids.w}), (std::array{p.room.y, p.room.x, 0u, 0u}));
}

// The same vertices in the same places of the world, and a ball that holds them.
void expectVertices(const Pair& p) {
    ASSERT_EQ(p.hull().count.x, p.wantedHull().count.x);
    EXPECT_EQ(p.hull().first.x, VERTICES_A_FACE * p.room.z);
    const Quaterniond is = rotation(p.state().turn), wanted = rotation(p.wanted().turn);
    for (uint32_t v = 0; v < p.hull().count.x; v++) {
        const Vector3d other = vec(p.host.hulls.vertices[p.wantedHull().first.x + v]), own = vec(p.vertex(v));
        ASSERT_LE((is * own - wanted * other).norm(), 2e-6 * p.reach()) << v;
        EXPECT_LE(own.norm(), double{p.shape().inverse_inertia[2].w});
        EXPECT_LE((own - vec(p.hull().center)).norm(), double{p.hull().center.w});
    }
    EXPECT_LE((is * vec(p.hull().center) - wanted * vec(p.wantedHull().center)).norm(), 2e-6 * p.reach());
    EXPECT_NEAR(p.hull().center.w, p.wantedHull().center.w, 5e-6 * p.reach());
}

// Unit normals that are those of the cut, through the corners, with nothing beyond.
void expectFaces(const Pair& p, const Object& o, const brittle::ColliderPiece& piece) {
    ASSERT_EQ(p.hull().count.y, p.wantedHull().count.y);
    EXPECT_EQ(p.hull().first.y, p.room.z);
    const Quaterniond is = rotation(p.state().turn);
    for (uint32_t f = 0; f < p.hull().count.y; f++) {
        const gpu::HullFace& face = p.face(f);
        const Vector3d normal = vec(face.plane);
        const Vector3d cut =
            frameOf(o) * vec(brittle::toDouble(o.result.fragments.colliders.faces[piece.first_face + f].normal));
        EXPECT_LE((is * normal - cut).norm(), 2e-6);
        for (uint32_t v = 0; v < p.hull().count.x; v++)
            EXPECT_LE(normal.dot(vec(p.vertex(v))) - double{face.plane.w}, 1e-5 * p.reach());
        for (uint32_t c = 0; c < face.loop.y; c++)
            EXPECT_NEAR(normal.dot(vec(p.vertex(p.corner(face, c)))), double{face.plane.w}, 1e-5 * p.reach());
    }
}

using Edge = std::array<uint32_t, 4>;

std::set<Edge> edgesFrom(const gpu::uvec4* first, uint32_t count) {
    std::set<Edge> edges;
    for (uint32_t e = 0; e < count; e++)
        edges.insert({first[e].x, first[e].y, first[e].z, first[e].w});
    return edges;
}

// Loops are the host's, number by number, and so are edges but for their order.
void expectEdges(const Pair& p) {
    const gpu::HullRecord &is = p.hull(), &wanted = p.wantedHull();
    ASSERT_EQ(is.count.z, wanted.count.z);
    ASSERT_EQ(is.count.w, wanted.count.w);
    EXPECT_EQ(is.first.z, CORNERS_A_FACE * p.room.z);
    EXPECT_EQ(is.first.w, EDGES_A_FACE * p.room.z);
    for (uint32_t c = 0; c < is.count.z; c++)
        EXPECT_EQ(p.world.hull_corners[is.first.z + c], p.host.hulls.corners[wanted.first.z + c]);
    EXPECT_EQ(edgesFrom(&p.world.hull_edges[is.first.w], is.count.w),
              edgesFrom(&p.host.hulls.edges[wanted.first.w], wanted.count.w));
}

// Every side of every face is a side of one edge, on the face that the edge says.
void expectClosed(const Pair& p) {
    std::set<std::array<uint32_t, 3>> sides, of_edges;
    for (uint32_t f = 0; f < p.hull().count.y; f++)
        for (uint32_t c = 0; c < p.face(f).loop.y; c++)
            EXPECT_TRUE(sides.insert({p.corner(p.face(f), c), p.corner(p.face(f), c + 1), f}).second);
    for (uint32_t e = 0; e < p.hull().count.w; e++) {
        const gpu::uvec4& edge = p.world.hull_edges[p.hull().first.w + e];
        of_edges.insert({edge.x, edge.y, edge.z});
        of_edges.insert({edge.y, edge.x, edge.w});
    }
    EXPECT_EQ(sides, of_edges);
    EXPECT_EQ(p.hull().count.x + p.hull().count.y, p.hull().count.w + 2);
}

} // namespace

void expectBodies(const Scene& scene, const World& world) {
    brittle::WorldContents host;
    for (uint32_t k = 0; k < scene.parts.size(); k++) {
        SCOPED_TRACE("part " + std::to_string(k));
        const Part& part = scene.parts[k];
        const auto added = addBody(host, definitionOf(scene, part));
        ASSERT_TRUE(added) << added.error().message;
        const Object& o = scene.objects[part.object];
        const Pair pair = {host, k, world, part.room, o};
        expectMotion(pair);
        expectInertia(pair);
        expectShape(pair);
        expectVertices(pair);
        expectFaces(pair, o, o.result.fragments.colliders.pieces[part.fragment]);
        expectEdges(pair);
        expectClosed(pair);
    }
}

} // namespace adopting
