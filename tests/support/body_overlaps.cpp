#include "tests/support/body_overlaps.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>

namespace support {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator*;

Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

Double3 turnedBy(const brittle::Turn& q, const Double3& v) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const Double3 u = (1 / size) * Double3{q[0], q[1], q[2]}, t = 2.0 * brittle::cross(u, v);
    return v + (q[3] / size) * t + brittle::cross(u, t);
}

struct PlacedPiece {
    reference::Convex solid;
    reference::Bounds bounds;
    uint32_t body = 0;
    bool moves = false;
};

std::vector<PlacedPiece> placedPieces(const brittle::WorldContents& contents, std::span<const Pose> poses) {
    std::vector<PlacedPiece> pieces;
    for (size_t p = 0; p < contents.pieces.size(); ++p) {
        const uint32_t body = contents.pieces[p].ids.y;
        PlacedPiece piece = {pieceInWorld(contents, p, poses[body]), {}, body, contents.bodies[body].offset.w != 0};
        for (const reference::Point& v : piece.solid.vertices)
            piece.bounds.grow(v);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

bool mayOverlap(const PlacedPiece& a, const PlacedPiece& b) {
    if (a.body == b.body || (!a.moves && !b.moves)) return false;
    for (size_t k = 0; k < 3; ++k)
        if (a.bounds.lower[k] > b.bounds.upper[k] || b.bounds.lower[k] > a.bounds.upper[k]) return false;
    return true;
}

} // namespace

Pose poseOf(const gpu::BodyState& body) {
    const Double3 sector = {double{SECTOR_EDGE} * body.sector.x, double{SECTOR_EDGE} * body.sector.y,
                            double{SECTOR_EDGE} * body.sector.z};
    return {sector + xyz(body.offset), {body.turn.x, body.turn.y, body.turn.z, body.turn.w}};
}

reference::Convex pieceInWorld(const brittle::WorldContents& contents, size_t piece, const Pose& pose) {
    const gpu::HullRecord& hull = contents.hulls.records[contents.pieces[piece].ids.x];
    reference::Convex solid;
    for (uint32_t v = 0; v < hull.count.x; ++v)
        solid.vertices.push_back(pose.place + turnedBy(pose.turn, xyz(contents.hulls.vertices[hull.first.x + v])));
    for (uint32_t f = 0; f < hull.count.y; ++f) {
        const gpu::HullFace& face = contents.hulls.faces[hull.first.y + f];
        reference::ConvexFace out;
        out.normal = turnedBy(pose.turn, xyz(face.plane));
        for (uint32_t k = 0; k < face.loop.y; ++k)
            out.loop.push_back(contents.hulls.corners[face.loop.x + k]);
        out.height = double{face.plane.w} + brittle::dot(out.normal, pose.place);
        solid.faces.push_back(std::move(out));
    }
    return solid;
}

std::vector<double> overlapsOf(const brittle::WorldContents& contents, std::span<const Pose> poses) {
    std::vector<PlacedPiece> pieces = placedPieces(contents, poses);
    std::ranges::sort(pieces, {}, [](const PlacedPiece& p) { return p.bounds.lower[0]; });
    std::vector<double> depths;
    for (size_t p = 0; p < pieces.size(); ++p)
        for (size_t q = p + 1; q < pieces.size() && pieces[q].bounds.lower[0] <= pieces[p].bounds.upper[0]; ++q) {
            if (!mayOverlap(pieces[p], pieces[q])) continue;
            const double depth = reference::overlapOf(pieces[p].solid, pieces[q].solid);
            if (depth > 0) depths.push_back(depth);
        }
    std::ranges::sort(depths);
    return depths;
}

double percentile(const std::vector<double>& sorted, double share) {
    return sorted.empty() ? 0 : sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

} // namespace support
