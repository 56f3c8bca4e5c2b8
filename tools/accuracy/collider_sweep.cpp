// Colliders: how much larger than their fragments they are, by how many directions.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/reference/convex.h"
#include "tests/support/fragment_file.h"
#include "tools/accuracy/fracture_run.h"
#include "tools/accuracy/fracture_truth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace accuracy {
namespace {

using brittle::ColliderPiece;
using brittle::ColliderSet;
using brittle::Fragment;
using brittle::FragmentSet;
using engine::Result;
using reference::Point;

const ErrorKind kExcess = {"excess", "volume of colliders beyond their fragments", "share of the fragments",
                           "the fragments' own, in double precision"};
const ErrorKind kReach = {"reach", "corner of a collider off its fragment, 99 of 100 are nearer", "share of the diagonal",
                          "nearest point of the fragment's surface, in double precision"};

constexpr double kResolution = 1e-9, kMost = 0.99;
constexpr std::array<std::string_view, 3> kStages = {"support_heights", "part_islands", "collider"};

reference::Triangles surfaceOf(const FragmentSet& set, const Fragment& fragment) {
    reference::Triangles surface;
    const uint32_t end = fragment.first_index + fragment.outer_index_count + fragment.inner_index_count;
    for (uint32_t i = fragment.first_index; i < end; i += 3) {
        reference::Triangle& triangle = surface.emplace_back();
        for (uint32_t k = 0; k < 3; ++k)
            triangle[k] = positionOf(set.vertices[fragment.first_vertex + set.indices[i + k]]);
    }
    return surface;
}

reference::Convex convexOf(const ColliderSet& set, const ColliderPiece& piece) {
    reference::Convex solid;
    for (uint32_t v = 0; v < piece.vertex_count; ++v)
        solid.vertices.push_back(brittle::toDouble(set.vertices[piece.first_vertex + v]));
    for (uint32_t f = 0; f < piece.face_count; ++f) {
        const brittle::ColliderFace& face = set.faces[piece.first_face + f];
        reference::ConvexFace& out = solid.faces.emplace_back();
        out.normal = brittle::toDouble(face.normal);
        out.height = face.height;
        for (uint32_t k = 0; k < face.corner_count; ++k)
            out.loop.push_back(set.corners[face.first_corner + k]);
    }
    return solid;
}

void addReaches(const reference::Convex& piece, const reference::Triangles& surface, std::vector<double>& reaches) {
    for (const Point& p : piece.vertices) {
        double nearest = 1e300;
        for (const reference::Triangle& t : surface)
            nearest = std::min(nearest, reference::distanceTo(t, p));
        reaches.push_back(nearest);
    }
}

std::vector<MeasuredError> colliderErrors(const FragmentSet& set, double diagonal) {
    double fragments = 0, pieces = 0;
    std::vector<double> reaches;
    for (size_t k = 0; k < set.fragments.size(); ++k) {
        const reference::Triangles surface = surfaceOf(set, set.fragments[k]);
        const reference::Convex piece = convexOf(set.colliders, set.colliders.pieces[k]);
        fragments += reference::volumeOf(surface);
        pieces += reference::volumeOf(piece);
        addReaches(piece, surface, reaches);
    }
    std::ranges::sort(reaches);
    const double reach = reaches[static_cast<size_t>(kMost * static_cast<double>(reaches.size() - 1))];
    return {{kExcess.name, std::fabs(pieces / fragments - 1), kResolution}, {kReach.name, reach / diagonal, kResolution}};
}

double timeOfColliders(const brittle::FractureResult& result) {
    double ms = 0;
    for (const engine::Timing& timing : result.timings)
        if (std::ranges::find(kStages, timing.name) != kStages.end()) ms += timing.ms;
    return ms;
}

struct ColliderWorkload {
    const char *name, *model, *what;
};
constexpr ColliderWorkload kColliderWorkloads[] = {
    {"bumpy_20480_colliders", "builtin:bumpy:5", "100 fragments of the ball with bumps and hollows, 20480 triangles"},
    {"ring_colliders", "builtin:ring", "100 fragments of the twisted ring, which has a hole and bends"},
};

} // namespace

Result<void> sweepColliders(Sweep& sweep) {
    addKind(sweep.results, kExcess);
    addKind(sweep.results, kReach);
    double before = 0;
    for (const ColliderWorkload& workload : kColliderWorkloads) {
        auto model = soundModel(workload.model);
        if (!model) return model.error();
        FractureCase one;
        one.workload = {workload.name,
                        "colliders",
                        workload.what,
                        "a break's colliders, on the device",
                        "on the device, of a break with colliders",
                        {kExcess.name, kReach.name}};
        one.model = std::move(*model);
        one.settings = colliderSettings();
        one.before = before;
        one.share = 1.0 / std::size(kColliderWorkloads);
        before += one.share;
        const double diagonal = reference::boundsOf(support::trianglesOf(one.model.mesh)).diagonal();
        FractureMeasures measures;
        measures.errors = [&](const brittle::FractureResult& r, const brittle::FractureOptions&) {
            return colliderErrors(r.fragments, diagonal);
        };
        measures.time = timeOfColliders;
        if (auto done = measureCase(sweep, one, measures); !done) return done;
    }
    return {};
}

} // namespace accuracy
