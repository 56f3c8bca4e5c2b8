// What a world is made of, on the host: bodies, the pieces that they collide by, and the hulls of these, packed as the kernels
// read them. SI units.
#pragma once

#include "engine/result.h"
#include "modules/brittle/dynamics/hull_set.h"
#include "modules/brittle/fracture/fragments.h"
#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/drawing.h"
#include "shaders-spirv/shared/material.h"

#include <array>
#include <string>
#include <vector>

namespace brittle {

// A convex piece, in meters, about its body's center of mass and along its axes: faces as loops of vertices, counterclockwise
// seen from outside. A triangle of a static surface is a piece of three vertices and two opposite faces.
struct PieceShape {
    std::vector<Float3> vertices;
    std::vector<std::vector<uint32_t>> loops;
    std::vector<Float3> normals; // of the faces, outward, unit, where they are known; else they follow from the loops
    uint32_t hidden_sides = 0;   // of a triangle, as in gpu::HullFace
    bool is_plane = false;       // a box whose top goes on for ever, at y = 0 of a body that does not move
};

using Turn = std::array<double, 4>; // a quaternion x, y, z, w of any length but 0: own frame to world

struct BodyDefinition {
    std::string name;     // for messages
    std::string material; // likewise, of what it is made; empty for what says nothing of that
    uint64_t id = 0; // a world is the same, bit for bit, in whatever order its bodies are added, if these are all different
    std::vector<PieceShape> pieces;
    bool is_round = false;     // a ball, of which its pieces are a rough likeness: blows go to its center
    Double3 place = {0, 0, 0}; // of the center of mass
    Turn turn = {0, 0, 0, 1};
    Double3 velocity = {0, 0, 0};
    Double3 spin = {0, 0, 0};                           // rad/s, world axes
    double mass = 0;                                    // kg; 0: it does not move
    std::array<double, 6> inertia = {0, 0, 0, 0, 0, 0}; // kg m2, about the center of mass: xx, yy, zz, xy, xz, yz
    double friction = 0.6;
    double restitution = 0;
};

// Two pieces that are known to touch before the first step, without a gap.
struct SiblingContact {
    uint32_t piece_a = 0, piece_b = 0;
    Double3 normal = {0, 0, 0};  // from A to B, world, unit
    std::vector<Double3> points; // world, one to four
};

struct WorldContents {
    HullSet hulls;
    std::vector<gpu::PieceRecord> pieces;
    std::vector<gpu::BodyState> bodies;
    std::vector<gpu::BodyShape> shapes;
    std::vector<uint64_t> ids;                 // of bodies
    std::vector<std::string> names, materials; // of bodies, for messages
    std::vector<SiblingContact> siblings;      // a pair once, of different bodies
    // What breaks (breaking/breakable.h), by body; those behind the last do not.
    std::vector<gpu::BreakableBody> breakable;
    std::vector<gpu::MaterialCard> cards;
    std::vector<FragmentVertex> surface_vertices; // three a triangle
    bool some_surface_may_touch_itself = false;   // along an edge
    std::vector<std::string> reader_notes; // what readers of models left out, each once, with the file's name
    // Of what does not break, by body, to be drawn by (drawing/drawing.h); none where nobody draws.
    std::vector<gpu::BodyLook> looks;
};

// Adds a body and returns its index. Where it fails the contents are as they were. Errors, with the body's name: BadInput for
// numbers that are none, places beyond 1e6 m, speeds beyond 1e4 m/s, a negative mass, an inertia that is not that of a solid,
// a turn of length 0, no pieces, pieces that are not convex solids (dynamics/hull_set.h); Capacity.
engine::Result<uint32_t> addBody(WorldContents& contents, const BodyDefinition& body);

// Its principal axes, as a turn from them into the frame it is described in: what a body's turn in the world begins with is
// `body.turn` after this.
Turn axesOf(const BodyDefinition& body);

} // namespace brittle
