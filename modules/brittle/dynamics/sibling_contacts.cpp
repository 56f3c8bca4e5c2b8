#include "modules/brittle/dynamics/sibling_contacts.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace brittle {
namespace {

using Polygon = std::vector<Double3>;

Polygon polygonOf(const ColliderSet& set, const ColliderPiece& piece, const ColliderFace& face) {
    Polygon polygon;
    for (uint32_t k = 0; k < face.corner_count; k++)
        polygon.push_back(toDouble(set.vertices[piece.first_vertex + set.corners[face.first_corner + k]]));
    return polygon;
}

// What of a polygon lies behind a plane (Sutherland and Hodgman 1974).
Polygon cutBehind(const Polygon& polygon, const Double3& out, double height) {
    Polygon kept;
    for (size_t k = 0; k < polygon.size(); k++) {
        const Double3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double a = dot(out, p) - height, b = dot(out, q) - height;
        if (a <= 0) kept.push_back(p);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) kept.push_back(p + (a / (a - b)) * (q - p));
    }
    return kept;
}

// Of two polygons in one plane; `normal` is that of the first, which is counter-clockwise about it, as the other is about its
// opposite.
Polygon common(Polygon polygon, const Polygon& other, const Double3& normal) {
    for (size_t k = 0; k < other.size() && !polygon.empty(); k++) {
        const Double3 &p = other[(k + 1) % other.size()], &q = other[k];
        const Double3 out = cross(q - p, normal);
        polygon = cutBehind(polygon, out, dot(out, p));
    }
    return polygon;
}

// Four corners that hold as well as all: the two furthest from each other, and on each side of their line the one furthest from
// it.
Polygon fourOf(const Polygon& polygon, const Double3& normal) {
    if (polygon.size() <= MANIFOLD_POINTS) return polygon;
    size_t first = 0, second = 0, above = 0, below = 0;
    double most = -1, highest = -1, lowest = -1;
    const auto raise = [](double& best, double value, size_t& at, size_t k) {
        if (value > best) at = k;
        best = std::max(best, value);
    };
    for (size_t i = 0; i < polygon.size(); i++)
        for (size_t j = i + 1; j < polygon.size(); j++) {
            const Double3 d = polygon[j] - polygon[i];
            if (dot(d, d) > most) first = i;
            raise(most, dot(d, d), second, j);
        }
    for (size_t k = 0; k < polygon.size(); k++) {
        const double side = dot(normal, cross(polygon[second] - polygon[first], polygon[k] - polygon[first]));
        raise(highest, side, above, k);
        raise(lowest, -side, below, k);
    }
    std::vector<size_t> chosen = {first, second, above, below};
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    Polygon four;
    for (const size_t k : chosen)
        four.push_back(polygon[k]);
    return four;
}

// The only fragment of each cell, or none.
std::vector<uint32_t> onlyFragments(const FragmentSet& set) {
    std::vector<uint32_t> only;
    for (uint32_t k = 0; k < set.colliders.pieces.size(); k++) {
        const uint32_t cell = set.colliders.pieces[k].cell;
        if (cell >= only.size()) only.resize(cell + 1, NO_INDEX);
        only[cell] = only[cell] == NO_INDEX ? k : NO_INDEX - 1;
    }
    return only;
}

const ColliderFace* faceTowards(const ColliderSet& set, const ColliderPiece& piece, uint32_t cell) {
    for (uint32_t f = piece.first_face; f < piece.first_face + piece.face_count; f++)
        if (set.faces[f].kind == ColliderFaceKind::OfCell && set.faces[f].neighbor == cell) return &set.faces[f];
    return nullptr;
}

gpu::vec4 wordsOf(const Double3& v, float w = 0) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), w};
}

Double3 anyTangent(const Double3& normal) {
    const Double3 axis = std::fabs(normal[0]) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    return normalized(cross(normal, axis), axis);
}

gpu::ContactMemory memoryOf(const WorldContents& contents, const SiblingContact& sibling, uint32_t a, uint32_t b) {
    const gpu::BodyShape &shape_a = contents.shapes[a], &shape_b = contents.shapes[b];
    const Pose pose_a = poseOf(contents.bodies[a]), pose_b = poseOf(contents.bodies[b]);
    gpu::ContactMemory memory{};
    memory.ids = {a, b, static_cast<uint32_t>(sibling.points.size()), NO_INDEX};
    memory.normal = wordsOf(sibling.normal, std::sqrt(shape_a.inverse_inertia[0].w * shape_b.inverse_inertia[0].w));
    memory.tangent = wordsOf(anyTangent(sibling.normal), std::max(shape_a.inverse_inertia[1].w, shape_b.inverse_inertia[1].w));
    memory.rub.w = shape_a.inverse_inertia[2].w < shape_b.inverse_inertia[2].w ? ARMS_OF_B_FOLLOW : ARMS_OF_A_FOLLOW;
    memory.turn_a = contents.bodies[a].turn;
    memory.turn_b = contents.bodies[b].turn;
    memory.place = wordsOf(turnedBack(pose_a.turn, pose_b.place - pose_a.place));
    for (uint32_t k = 0; k < sibling.points.size(); k++) {
        const Double3 arm_a = sibling.points[k] - pose_a.place, arm_b = sibling.points[k] - pose_b.place;
        memory.arm_a[k] = wordsOf(arm_a);
        memory.arm_b[k] = wordsOf(arm_b);
        memory.anchor_a[k] = wordsOf(turnedBack(pose_a.turn, arm_a));
        memory.anchor_b[k] = wordsOf(turnedBack(pose_b.turn, arm_b), std::bit_cast<float>(k)); // no feature has so small a name
    }
    return memory;
}

} // namespace

std::vector<SharedFace> sharedFaces(const FragmentSet& set) {
    const std::vector<uint32_t> only = onlyFragments(set);
    const ColliderSet& colliders = set.colliders;
    std::vector<SharedFace> shared;
    for (uint32_t a = 0; a < colliders.pieces.size(); a++) {
        const ColliderPiece& piece = colliders.pieces[a];
        for (uint32_t f = piece.first_face; f < piece.first_face + piece.face_count; f++) {
            const ColliderFace& face = colliders.faces[f];
            const uint32_t b = face.neighbor < only.size() ? only[face.neighbor] : NO_INDEX;
            if (face.kind != ColliderFaceKind::OfCell || only[piece.cell] != a || b >= colliders.pieces.size() || b < a)
                continue;
            const ColliderFace* back = faceTowards(colliders, colliders.pieces[b], piece.cell);
            if (back == nullptr) continue;
            const Double3 normal = toDouble(face.normal);
            const Polygon touching =
                common(polygonOf(colliders, piece, face), polygonOf(colliders, colliders.pieces[b], *back), normal);
            if (touching.size() >= 3) shared.push_back({a, b, normal, fourOf(touching, normal)});
        }
    }
    return shared;
}

FirstContacts firstContacts(const WorldContents& contents) {
    std::vector<SiblingContact> siblings = contents.siblings;
    for (SiblingContact& s : siblings) {
        if (s.piece_a < s.piece_b) continue;
        std::swap(s.piece_a, s.piece_b);
        s.normal = -1.0 * s.normal;
    }
    std::ranges::sort(siblings, {}, [](const SiblingContact& s) { return std::array{s.piece_a, s.piece_b}; });
    FirstContacts first;
    for (const SiblingContact& s : siblings) {
        first.pairs.push_back({s.piece_a, s.piece_b});
        first.contacts.push_back(memoryOf(contents, s, contents.pieces[s.piece_a].ids.y, contents.pieces[s.piece_b].ids.y));
    }
    return first;
}

} // namespace brittle
