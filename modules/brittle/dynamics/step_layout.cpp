// What a step needs in between: a row for every list, with who asks for it and how long it is.
#include "modules/brittle/dynamics/step_layout.h"

#include "shaders-spirv/shared/narrow_phase.h"

#include <algorithm>

namespace brittle {
namespace {

enum class Per : uint8_t { Step, Body, BodyAndOne, Piece, Pair, PairAndOne, Contact, Side, Member, Block, Color };

struct Row {
    engine::BufferView StepBuffers::*view;
    const char* name;
    std::optional<Effect> asked_by;
    Per per;
    uint32_t bytes;
};

using S = StepBuffers;
constexpr Effect kContactEffect = Effect::Contacts;

constexpr Row kRows[] = {
    {&S::box_low, "box_low", kContactEffect, Per::Piece, 16},
    {&S::box_high, "box_high", kContactEffect, Per::Piece, 16},
    {&S::recalled, "recalled", kContactEffect, Per::Pair, 4},
    {&S::fresh, "fresh", kContactEffect, Per::Pair, 4},
    {&S::touches, "touches", kContactEffect, Per::Pair, 4},
    {&S::contact_pairs, "contact_pairs", kContactEffect, Per::Contact, 4},
    {&S::contact_slots, "contact_slots", kContactEffect, Per::Contact, 4},
    {&S::fresh_slots, "fresh_slots", kContactEffect, Per::PairAndOne, 4},
    {&S::contact_offsets, "contact_offsets", kContactEffect, Per::PairAndOne, 4},
    {&S::sums, "sums", kContactEffect, Per::Block, 4},
    {&S::fresh_pairs, "fresh_pairs", kContactEffect, Per::Pair, 8},
    {&S::manifolds, "manifolds", kContactEffect, Per::Pair, sizeof(gpu::Manifold)},
    {&S::axes, "axes", kContactEffect, Per::Pair, sizeof(gpu::AxisRecord)},
    {&S::first_hits, "first_hits", kContactEffect, Per::Body, sizeof(gpu::FirstHits)},
    {&S::narrow_arguments, "narrow_arguments", kContactEffect, Per::Step, kNarrowPhaseArgumentBytes},
    {&S::solver_bodies, "solver_bodies", std::nullopt, Per::Body, sizeof(gpu::SolverBody)},
    {&S::spins, "spins", std::nullopt, Per::Body, 16},
    {&S::shares, "shares", Effect::Ccd, Per::Body, 8},
    {&S::solver_contacts, "solver_contacts", kContactEffect, Per::Contact, sizeof(gpu::SolverContact)},
    {&S::hits, "hits", Effect::Events, Per::Contact, 4},
    {&S::parents, "parents", kContactEffect, Per::Body, 4},
    {&S::islands, "islands", kContactEffect, Per::Body, 4},
    {&S::rests, "rests", Effect::Sleeping, Per::Body, 4},
    {&S::island_contacts, "island_contacts", kContactEffect, Per::Body, 4},
    {&S::island_ranges, "island_ranges", kContactEffect, Per::Body, 8},
    {&S::listed, "listed", kContactEffect, Per::Contact, 4},
    {&S::color_ends, "color_ends", kContactEffect, Per::Contact, 4},
    {&S::heights, "heights", kContactEffect, Per::Body, 4},
    {&S::members, "members", kContactEffect, Per::Member, 4},
    {&S::body_colors, "body_colors", kContactEffect, Per::Body, 16},
    {&S::bids, "bids", kContactEffect, Per::Body, 4},
    {&S::waiting, "waiting", kContactEffect, Per::Contact, 8},
    {&S::color_start, "color_start", kContactEffect, Per::Color, 4},
    {&S::adjacency_counts, "adjacency_counts", kContactEffect, Per::Body, 4},
    {&S::adjacency_cursors, "adjacency_cursors", kContactEffect, Per::Body, 4},
    {&S::adjacency_start, "adjacency_start", kContactEffect, Per::BodyAndOne, 4},
    {&S::loose_adjacency, "loose_adjacency", kContactEffect, Per::Side, 4},
    {&S::adjacency, "adjacency", kContactEffect, Per::Side, 4},
};

uint64_t countOf(Per per, const WorldSizes& n) {
    switch (per) {
    case Per::Step: return 1;
    case Per::Body: return n.bodies;
    case Per::BodyAndOne: return n.bodies + 1ull;
    case Per::Piece: return n.pieces;
    case Per::Pair: return n.pairs;
    case Per::PairAndOne: return n.pairs + 1ull;
    case Per::Contact: return n.contacts;
    case Per::Side: return 2ull * n.contacts;
    case Per::Member: return 4ull * n.contacts;
    case Per::Block: return (std::max(n.pairs, n.bodies) + SCAN_BLOCK - 1ull) / SCAN_BLOCK;
    case Per::Color: return COLOR_WORDS;
    }
    return 0;
}

struct ScratchName {
    engine::BufferView BroadPhaseScratch::*view;
    const char* name;
};

using B = BroadPhaseScratch;
constexpr ScratchName kBroadPhase[] = {{&B::extent, "extent"},
                                       {&B::key_low, "key_low"},
                                       {&B::key_high, "key_high"},
                                       {&B::order, "order"},
                                       {&B::nodes, "nodes"},
                                       {&B::pair_counts, "pair_counts"},
                                       {&B::pair_offsets, "pair_offsets"},
                                       {&B::sums, "tree_sums"},
                                       {&B::found_pairs, "found_pairs"},
                                       {&B::loose_pairs, "loose_pairs"},
                                       {&B::long_lists, "long_lists"},
                                       {&B::sort_keys, "sort_keys"},
                                       {&B::other_keys, "other_keys"},
                                       {&B::other_order, "other_order"},
                                       {&B::histogram, "histogram"},
                                       {&B::digit_offsets, "digit_offsets"}};
static_assert(sizeof(StepBuffers) == std::size(kRows) * sizeof(engine::BufferView) + sizeof(BroadPhaseScratch));
static_assert(sizeof(BroadPhaseScratch) == std::size(kBroadPhase) * sizeof(engine::BufferView));

engine::Result<void> layOutTree(engine::ScratchArena& arena, WorldBuffers& b) {
    auto scratch = layOutBroadPhase(arena, b.broad_phase);
    if (!scratch) return scratch.error();
    b.step.broad_phase = *scratch;
    for (const ScratchName& name : kBroadPhase)
        if (const engine::BufferView& view = b.step.broad_phase.*name.view; view.buffer != nullptr)
            b.named.push_back({name.name, view, view.size, Effect::Contacts});
    return {};
}

} // namespace

engine::Result<void> layOutStep(engine::ScratchArena& arena, const engine::BufferView& dummy, WorldBuffers& b) {
    for (const Row& row : kRows) {
        const bool wanted = !row.asked_by || b.sizes.effects.has(*row.asked_by);
        const engine::BufferView view = wanted ? arena.take(countOf(row.per, b.sizes) * row.bytes) : dummy;
        b.step.*row.view = view;
        b.named.push_back({row.name, view, wanted ? view.size : 0, row.asked_by});
    }
    if (!b.sizes.effects.has(Effect::Contacts)) return arena.status();
    if (auto laid_out = layOutTree(arena, b); !laid_out) return laid_out;
    return arena.status();
}

} // namespace brittle
