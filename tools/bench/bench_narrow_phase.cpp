// The narrow phase on its own: the points of pairs of hulls that touch or nearly do.
#include "modules/brittle/dynamics/narrow_phase.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "shaders-spirv/shared/contact.h"
#include "shaders-spirv/shared/fracture.h"
#include "shaders-spirv/shared/narrow_phase.h"
#include "tools/bench/phase_run.h"

#include <algorithm>
#include <array>

namespace bench {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*;
using brittle::turnedBy;
using engine::Buffer;
using engine::Result;

constexpr double kDepth = 0.01; // m, and as much apart

struct Pairs {
    std::vector<gpu::BodyState> bodies;
    std::vector<gpu::PieceRecord> pieces;
    std::vector<std::array<uint32_t, 2>> pairs;
};

gpu::BodyState bodyAt(const Double3& place, const brittle::Turn& turn) {
    gpu::BodyState body{};
    body.offset = wordsOf(place, 1);
    body.turn = {static_cast<float>(turn[0]), static_cast<float>(turn[1]), static_cast<float>(turn[2]),
                 static_cast<float>(turn[3])};
    return body;
}

// The middle of a face, by its corners.
Double3 middleOf(const brittle::HullSet& hulls, const gpu::HullRecord& hull, const gpu::HullFace& face) {
    Double3 middle = {0, 0, 0};
    for (uint32_t k = 0; k < face.loop.y; ++k)
        middle = middle + (1.0 / face.loop.y) * xyz(hulls.vertices[hull.first.x + hulls.corners[face.loop.x + k]]);
    return middle;
}

// Where the hull reaches furthest that way.
Double3 furthest(const brittle::HullSet& hulls, const gpu::HullRecord& hull, const brittle::Turn& turn, const Double3& way) {
    Double3 best = {0, 0, 0};
    double most = -1e300;
    for (uint32_t v = 0; v < hull.count.x; ++v) {
        const Double3 p = turnedBy(turn, xyz(hulls.vertices[hull.first.x + v]));
        if (brittle::dot(p, way) <= most) continue;
        most = brittle::dot(p, way);
        best = p;
    }
    return best;
}

Pairs pairsOf(const brittle::HullSet& hulls, const std::vector<uint32_t>& ids, uint32_t count, uint64_t seed) {
    Dice dice(seed);
    Pairs made;
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t a = ids[dice.below(ids.size())], b = ids[dice.below(ids.size())];
        const gpu::HullRecord &hull = hulls.records[a], &other = hulls.records[b];
        const gpu::HullFace& face = hulls.faces[hull.first.y + dice.below(hull.count.y)];
        const brittle::Turn turn = dice.turn(), other_turn = dice.turn();
        const Double3 normal = turnedBy(turn, xyz(face.plane)), touched = turnedBy(turn, middleOf(hulls, hull, face));
        const Double3 corner = furthest(hulls, other, other_turn, -1.0 * normal);
        made.bodies.push_back(bodyAt({0, 0, 0}, turn));
        made.bodies.push_back(bodyAt(touched + dice.between(-kDepth, kDepth) * normal - corner, other_turn));
        made.pieces.push_back({{a, 2 * k, 0, 0}});
        made.pieces.push_back({{b, 2 * k + 1, 0, 0}});
        made.pairs.push_back({2 * k, 2 * k + 1});
    }
    return made;
}

class OurPairs {
public:
    OurPairs(engine::Device& device, uint32_t lanes)
        : device_(device), kernels_(device, shaders::all(), {{FLAT_SIZE_ID, lanes}}) {}

    Result<void> prepare(const brittle::HullSet& hulls, const Pairs& pairs) {
        const std::vector<uint32_t> count = {static_cast<uint32_t>(pairs.pairs.size())};
        capacity_ = count[0];
        Buffers buffers(device_);
        brittle::Upload upload;
        const auto put = [&](Buffer& buffer, const auto& values, const char* name) {
            buffer = buffers.make(std::span(values).size_bytes(), name);
            upload.add(std::span(values), buffer);
        };
        put(records_, hulls.records, "hulls");
        put(vertices_, hulls.vertices, "hull vertices");
        put(faces_, hulls.faces, "hull faces");
        put(corners_, hulls.corners, "hull corners");
        put(edges_, hulls.edges, "hull edges");
        put(pieces_, pairs.pieces, "pieces");
        put(bodies_, pairs.bodies, "bodies");
        put(pairs_, pairs.pairs, "pairs");
        put(count_, count, "pair count");
        manifolds_ = buffers.make(sizeof(gpu::Manifold) * uint64_t{capacity_}, "manifolds");
        axes_ = buffers.make(sizeof(gpu::AxisRecord) * uint64_t{capacity_}, "axes");
        arguments_ = buffers.make(brittle::kNarrowPhaseArgumentBytes, "arguments");
        if (auto made = buffers.status(); !made) return made;
        return upload.send(device_);
    }

    // Milliseconds of device time.
    Result<double> find() {
        engine::Commands commands(device_);
        if (auto begun = commands.begin(); !begun) return begun.error();
        commands.beginLabel("narrow_phase");
        brittle::NarrowPhaseOptions options;
        options.duration = 0; // nothing moves
        const brittle::NarrowPhaseInput input = {.hulls = {records_, vertices_, faces_, corners_, edges_},
                                                 .pieces = pieces_,
                                                 .bodies = bodies_,
                                                 .pairs = pairs_,
                                                 .counts = count_,
                                                 .capacity = capacity_};
        auto recorded = brittle::recordNarrowPhase(commands, kernels_, input, options, {manifolds_, axes_, arguments_},
                                                   brittle::hasManyLanes(device_));
        if (!recorded) return recorded.error();
        commands.endLabel();
        if (auto done = commands.submitAndWait(); !done) return done.error();
        return labelMs(commands, "narrow_phase");
    }

    Result<uint32_t> touching() {
        std::vector<gpu::Manifold> manifolds(capacity_);
        const brittle::Fetch wanted[] = {{manifolds_, manifolds.data(), manifolds.size() * sizeof(gpu::Manifold)}};
        if (auto read = brittle::fetch(device_, wanted); !read) return read.error();
        return static_cast<uint32_t>(std::ranges::count_if(manifolds, [](const gpu::Manifold& m) { return m.info.x != 0; }));
    }

private:
    engine::Device& device_;
    engine::KernelLibrary kernels_;
    uint32_t capacity_ = 0;
    Buffer records_, vertices_, faces_, corners_, edges_, pieces_, bodies_, pairs_, count_, manifolds_, axes_, arguments_;
};

// Those of the pile.
Result<brittle::WorldContents> hullsOfPile() {
    const auto scene = brittle::makeBuiltinScene("hull_pile_200");
    if (!scene) return scene.error();
    return brittle::contentsOf(*scene, ".", nullptr);
}

std::vector<uint32_t> hullsThatMove(const brittle::WorldContents& contents) {
    std::vector<uint32_t> ids;
    for (const gpu::PieceRecord& piece : contents.pieces)
        if (contents.bodies[piece.ids.y].offset.w != 0) ids.push_back(piece.ids.x);
    return ids;
}

Result<NarrowPhaseRow> benchPairs(engine::Device& device, const brittle::WorldContents& pile, uint32_t count,
                                  const BenchOptions& options) {
    OurPairs ours(device, lanesOf(options));
    if (auto prepared = ours.prepare(pile.hulls, pairsOf(pile.hulls, hullsThatMove(pile), count, options.seed)); !prepared)
        return prepared.error();
    std::vector<double> ms;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
        const auto took = ours.find();
        if (!took) return took.error();
        if (round > 0) ms.push_back(*took); // the first warms up
    }
    const auto touching = ours.touching();
    if (!touching) return touching.error();
    return NarrowPhaseRow{count, *touching, median(ms)};
}

} // namespace

Result<std::vector<NarrowPhaseRow>> benchNarrowPhase(engine::Device& device, const BenchOptions& options,
                                                     const Progress& progress) {
    std::vector<NarrowPhaseRow> rows;
    if (options.pair_counts.empty()) return rows;
    const auto pile = hullsOfPile();
    if (!pile) return pile.error();
    for (const uint32_t count : options.pair_counts) {
        progress("narrow phase of " + std::to_string(count) + " pairs");
        const auto row = benchPairs(device, *pile, count, options);
        if (!row) return row.error();
        rows.push_back(*row);
    }
    return rows;
}

} // namespace bench
