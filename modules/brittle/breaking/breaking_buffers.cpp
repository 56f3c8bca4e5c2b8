#include "modules/brittle/breaking/breaking_buffers.h"

#include "shaders-spirv/shared/breaking.h"

#include <algorithm>

namespace brittle {
namespace {

using engine::BufferView;
using engine::ScratchArena;

template <class Buffers>
struct ViewName {
    BufferView Buffers::*view;
    const char* name;
    Effect asked_by = Effect::ImpactFracture;
};

using L = LastingBuffers;
constexpr ViewName<L> kLasting[] = {{&L::breakable, "breakable"},
                                    {&L::cards, "material cards"},
                                    {&L::surface_vertices, "surface vertices"},
                                    {&L::told, "events told", Effect::Events},
                                    {&L::ring, "events", Effect::Events}};

using P = PassingBuffers;
constexpr ViewName<P> kPassing[] = {{&P::blows, "blows"},
                                    {&P::soonest, "first blows"},
                                    {&P::hardest, "hardest blows"},
                                    {&P::chosen, "chosen blows"},
                                    {&P::breaking, "breaking"},
                                    {&P::broken, "broken"},
                                    {&P::reach_sums, "reach sums"},
                                    {&P::cracks, "cracks"},
                                    {&P::size_shares, "size shares"},
                                    {&P::ledger, "crack ledger"},
                                    {&P::adopted, "adopted"},
                                    {&P::returned, "returned ranges"},
                                    {&P::owners, "owners"},
                                    {&P::order, "owned fragments"},
                                    {&P::other_owners, "other owners"},
                                    {&P::other_order, "other owned fragments"},
                                    {&P::sizes, "wanted sizes"},
                                    {&P::begins, "range begins"},
                                    {&P::rooms, "rooms"},
                                    {&P::owner_start, "owner start"},
                                    {&P::lacking, "lacking"},
                                    {&P::histogram, "owner histogram"},
                                    {&P::digit_offsets, "owner digit offsets"},
                                    {&P::sums, "owner sums"},
                                    {&P::turning, "turning blows"},
                                    {&P::posed_bodies, "posed bodies"},
                                    {&P::posed_pieces, "posed pieces"},
                                    {&P::posed_pairs, "posed pairs"}};

constexpr ViewName<PoolBuffers> kPools[] = {{&PoolBuffers::headers, "pool headers"},
                                            {&PoolBuffers::free_ranges, "free ranges"},
                                            {&PoolBuffers::order, "returned order"},
                                            {&PoolBuffers::sorted, "returned sorted"},
                                            {&PoolBuffers::taken_from, "taken from"}};

using S = ScenePools;
constexpr ViewName<S> kScene[] = {{&S::vertices, "fragment vertices"},   {&S::indices, "fragment indices"},
                                  {&S::draw_commands, "fragment draws"}, {&S::objects, "fragment objects"},
                                  {&S::matrices, "fragment matrices"},   {&S::bounds, "fragment bounds"},
                                  {&S::fragments, "fragments"}};

using C = ColliderPools;
constexpr ViewName<C> kColliders[] = {{&C::records, "fragment hulls"},
                                      {&C::faces, "fragment hull faces"},
                                      {&C::vertices, "fragment hull vertices"},
                                      {&C::corners, "fragment hull corners"}};

static_assert(sizeof(L) == std::size(kLasting) * sizeof(BufferView) && sizeof(P) == std::size(kPassing) * sizeof(BufferView));
static_assert(sizeof(S) == std::size(kScene) * sizeof(BufferView) && sizeof(C) == std::size(kColliders) * sizeof(BufferView));

template <class Buffers, size_t n>
void addNames(std::vector<NamedBuffer>& named, const Buffers& buffers, const ViewName<Buffers> (&names)[n]) {
    for (const ViewName<Buffers>& name : names) {
        const BufferView& view = buffers.*name.view;
        named.push_back({name.name, view, view.size, name.asked_by});
    }
}

uint64_t tilesOf(uint64_t n) { return (n + RADIX_TILE - 1) / RADIX_TILE; }

} // namespace

LastingBuffers layOutLasting(ScratchArena& arena, const WorldContents& c, EffectSet effects) {
    LastingBuffers l;
    l.breakable = arena.take(c.breakable.size() * sizeof(gpu::BreakableBody));
    l.cards = arena.take(c.cards.size() * sizeof(gpu::MaterialCard));
    l.surface_vertices = arena.takeInParts(c.surface_vertices.size() * sizeof(FragmentVertex));
    if (!effects.has(Effect::Events)) return l;
    l.told = arena.take(4);
    l.ring = arena.take(BREAK_EVENTS * sizeof(gpu::BreakEvent));
    return l;
}

PassingBuffers layOutPassing(ScratchArena& arena, const BreakingSizes& n) {
    const auto words = [&](uint64_t count) { return arena.take(4 * std::max<uint64_t>(count, 4)); };
    PassingBuffers p;
    p.blows = arena.take(n.pairs * sizeof(gpu::BlowRecord));
    p.soonest = words(n.bodies);
    p.hardest = words(n.bodies);
    p.chosen = words(n.bodies);
    p.breaking = arena.take(MOST_BREAKING * sizeof(gpu::BreakingRecord));
    p.broken = arena.take(MOST_BREAKING * sizeof(gpu::BrokenBody));
    p.reach_sums = words(MOST_BREAKING);
    p.cracks = words(MOST_BREAKING);
    p.size_shares = arena.take(MOST_BREAKING * sizeof(gpu::SizeShare));
    p.ledger = arena.take(MOST_BREAKING * sizeof(gpu::CrackLedger));
    p.adopted = words(MOST_BREAKING);
    p.returned = arena.take(MOST_BREAKING * sizeof(gpu::PoolShare));
    for (BufferView* list : {&p.owners, &p.order, &p.other_owners, &p.other_order})
        *list = words(n.fragments);
    for (BufferView* list : {&p.sizes, &p.begins, &p.rooms})
        *list = words(uint64_t{POOLS} * n.fragments);
    p.owner_start = words(MOST_BREAKING + 1);
    p.lacking = words(uint64_t{POOLS} * MOST_BREAKING);
    const uint64_t histogram = tilesOf(n.fragments) << RADIX_BITS;
    p.histogram = words(histogram);
    p.digit_offsets = words(histogram + 1);
    p.sums = words(histogram / SCAN_BLOCK + 2);
    p.turning = arena.take(n.pairs * sizeof(gpu::TurningBlow));
    p.posed_bodies = arena.take(2 * n.pairs * sizeof(gpu::BodyState));
    p.posed_pieces = arena.take(2 * n.pairs * sizeof(gpu::PieceRecord));
    p.posed_pairs = words(2 * n.pairs);
    return p;
}

std::vector<NamedBuffer> namedBuffers(const LastingBuffers& lasting, const PassingBuffers& passing, const PoolBuffers& pools) {
    std::vector<NamedBuffer> named;
    addNames(named, lasting, kLasting);
    addNames(named, passing, kPassing);
    addNames(named, pools, kPools);
    return named;
}

std::vector<NamedBuffer> namedBuffers(const EventBuffers& event, const NamedBuffer& range) {
    NamedBuffer rest = range;
    rest.bytes -= event.counts.size + event.args.size;
    return {{"fracture counts", event.counts, event.counts.size, Effect::ImpactFracture},
            {"fracture arguments", event.args, event.args.size, Effect::ImpactFracture},
            rest};
}

std::vector<NamedBuffer> namedBuffers(const ScenePools& scene, const ColliderPools& colliders) {
    std::vector<NamedBuffer> named;
    addNames(named, scene, kScene);
    addNames(named, colliders, kColliders);
    return named;
}

} // namespace brittle
