#include "modules/brittle/dynamics/world_contents.h"

#include "modules/brittle/dynamics/sector_place.h"

#include <Eigen/Dense>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr double kFurthest = 1e6, kFastest = 1e4;

gpu::vec4 packed(const Double3& v, double w) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(w)};
}

bool isWithin(const Double3& v, double most) {
    return std::ranges::all_of(v, [&](double x) { return std::fabs(x) <= most; });
}

Eigen::Matrix3d tensor(const std::array<double, 6>& i) {
    Eigen::Matrix3d m;
    m << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
    return m;
}

// Of a solid each principal moment is less than the sum of the other two; a thousandth is left for rounding.
bool isInertia(const Eigen::Matrix3d& inertia) {
    if (!inertia.allFinite()) return false;
    const Eigen::Vector3d moments = inertia.selfadjointView<Eigen::Lower>().eigenvalues();
    return moments[0] > 0 && moments[2] <= (moments[0] + moments[1]) * 1.001;
}

Result<void> check(const BodyDefinition& body) {
    const auto refuse = [&](const std::string& why) {
        return Error{ErrorCode::BadInput, "body \"" + body.name + "\": " + why};
    };
    if (!isWithin(body.place, kFurthest))
        return refuse("its place is no number or beyond 1e6 m from the origin; move it closer");
    if (!isWithin(body.velocity, kFastest) || !isWithin(body.spin, kFastest))
        return refuse("its speed is no number or beyond 1e4 m/s or rad/s; slow it down");
    const double length = std::hypot(std::hypot(body.turn[0], body.turn[1]), std::hypot(body.turn[2], body.turn[3]));
    if (!std::isfinite(length) || length < 1e-6) return refuse("its turn has no length; give a quaternion x, y, z, w");
    if (!std::isfinite(body.mass) || body.mass < 0)
        return refuse("its mass is no number or negative; give 0 for what does not move");
    if (body.mass > 0 && !isInertia(tensor(body.inertia)))
        return refuse("its inertia is that of no solid; give one of positive moments about the center of mass");
    if (!(body.friction >= 0 && body.friction <= 100) || !(body.restitution >= 0 && body.restitution <= 1))
        return refuse("its friction is not in [0, 100] or its restitution not in [0, 1]");
    if (body.pieces.empty()) return refuse("it has no pieces; give it at least one convex piece");
    return {};
}

// The sector and the place in it, from the middle of the sector.
void setPlace(gpu::BodyState& state, const Double3& place, double inverse_mass) {
    const SectorPlace at = inSectors(place);
    state.sector = at.sector;
    state.offset = packed(toDouble(at.offset), inverse_mass);
}

// The principal axes in the body's own frame, as a turn, and the moments about them. A tensor that is a diagonal keeps its
// axes.
struct Principal {
    Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
    Eigen::Vector3d moments = {0, 0, 0};
};

Principal principalOf(const BodyDefinition& body) {
    Principal p;
    if (body.mass == 0) return p;
    const Eigen::Matrix3d inertia = tensor(body.inertia);
    p.moments = inertia.diagonal();
    const double off = std::abs(inertia(0, 1)) + std::abs(inertia(0, 2)) + std::abs(inertia(1, 2));
    if (off <= 1e-7 * p.moments.minCoeff()) return p;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
    Eigen::Matrix3d axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) *= -1;
    p.axes = Eigen::Quaterniond(axes).normalized();
    p.moments = solver.eigenvalues();
    return p;
}

gpu::BodyState stateOf(const BodyDefinition& body, const Principal& principal) {
    gpu::BodyState state{};
    const bool moves = body.mass > 0;
    setPlace(state, body.place, moves ? 1 / body.mass : 0);
    if (body.is_round) state.sector.w |= BODY_ROUND;
    const Eigen::Quaterniond given = Eigen::Quaterniond(body.turn[3], body.turn[0], body.turn[1], body.turn[2]).normalized();
    const Eigen::Quaterniond turn = (given * principal.axes).normalized();
    state.turn = packed({turn.x(), turn.y(), turn.z()}, turn.w());
    if (!moves) return state;
    const Eigen::Vector3d spin(body.spin[0], body.spin[1], body.spin[2]);
    const Eigen::Vector3d momentum = given * (tensor(body.inertia) * (given.inverse() * spin));
    state.velocity = packed(body.velocity, 0);
    state.spin = packed(body.spin, 0);
    state.momentum = packed({momentum.x(), momentum.y(), momentum.z()}, 0);
    return state;
}

// Places or directions.
std::vector<Float3> alongAxes(const std::vector<Float3>& vertices, const Principal& principal) {
    if (principal.axes.isApprox(Eigen::Quaterniond::Identity(), 0)) return vertices;
    std::vector<Float3> own;
    for (const Float3& v : vertices) {
        const Eigen::Vector3d r = principal.axes.inverse() * Eigen::Vector3d(v[0], v[1], v[2]);
        own.push_back({static_cast<float>(r.x()), static_cast<float>(r.y()), static_cast<float>(r.z())});
    }
    return own;
}

using HullSizes = std::array<size_t, 5>;

HullSizes sizesOf(const HullSet& hulls) {
    return {hulls.records.size(), hulls.vertices.size(), hulls.faces.size(), hulls.corners.size(), hulls.edges.size()};
}

void cutBack(HullSet& hulls, const HullSizes& sizes) {
    hulls.records.resize(sizes[0]);
    hulls.vertices.resize(sizes[1]);
    hulls.faces.resize(sizes[2]);
    hulls.corners.resize(sizes[3]);
    hulls.edges.resize(sizes[4]);
}

double reachOf(const BodyDefinition& body) {
    double reach = 0;
    for (const PieceShape& piece : body.pieces)
        for (const Float3& v : piece.vertices)
            reach = std::max(reach, std::hypot(double{v[0]}, double{v[1]}, double{v[2]}));
    return reach;
}

// Of the thinnest piece, from its center to the nearest face.
float halfThickness(const WorldContents& contents, uint32_t first_piece) {
    float half = std::numeric_limits<float>::max();
    for (size_t p = first_piece; p < contents.pieces.size(); p++) {
        const gpu::HullRecord& hull = contents.hulls.records[contents.pieces[p].ids.x];
        for (uint32_t f = 0; f < hull.count.y; f++) {
            const gpu::vec4& plane = contents.hulls.faces[hull.first.y + f].plane;
            half = std::min(half, plane.w - plane.x * hull.center.x - plane.y * hull.center.y - plane.z * hull.center.z);
        }
    }
    return std::max(half, 0.0f);
}

gpu::BodyShape shapeOf(const WorldContents& contents, const BodyDefinition& body, const Principal& principal,
                       uint32_t first_piece) {
    gpu::BodyShape shape{};
    shape.pieces = {first_piece, static_cast<uint32_t>(body.pieces.size()),
                    std::bit_cast<uint32_t>(halfThickness(contents, first_piece)), 0};
    const double reach = reachOf(body);
    const double last[3] = {body.friction, body.restitution, reach};
    for (size_t row = 0; row < 3; row++) {
        Double3 inverse = {0, 0, 0};
        const double moment = principal.moments[static_cast<Eigen::Index>(row)];
        if (moment > 0) inverse[row] = 1 / moment;
        shape.inverse_inertia[row] = packed(inverse, last[row]);
    }
    return shape;
}

} // namespace

Turn axesOf(const BodyDefinition& body) {
    const Eigen::Quaterniond axes = principalOf(body).axes;
    return {axes.x(), axes.y(), axes.z(), axes.w()};
}

Result<uint32_t> addBody(WorldContents& contents, const BodyDefinition& body) {
    if (auto sound = check(body); !sound) return sound.error();
    const auto index = static_cast<uint32_t>(contents.bodies.size()), first = static_cast<uint32_t>(contents.pieces.size());
    const HullSizes before = sizesOf(contents.hulls);
    const Principal principal = principalOf(body);
    for (const PieceShape& piece : body.pieces) {
        const auto hull = addHull(contents.hulls, alongAxes(piece.vertices, principal), piece.loops,
                                  alongAxes(piece.normals, principal), piece.hidden_sides);
        if (!hull) {
            cutBack(contents.hulls, before);
            contents.pieces.resize(first);
            return Error{hull.error().code, "body \"" + body.name + "\": " + hull.error().message};
        }
        contents.pieces.push_back({{*hull, index, piece.is_plane ? uint32_t{PIECE_PLANE} : 0, 0}});
    }
    contents.bodies.push_back(stateOf(body, principal));
    contents.shapes.push_back(shapeOf(contents, body, principal, first));
    contents.ids.push_back(body.id);
    contents.names.push_back(body.name);
    contents.materials.push_back(body.material);
    return index;
}

} // namespace brittle
