// Caps of vast faces: those of more sides than a workgroup can hold (lib/vast_face.glsl).
#include "modules/brittle/fracture/event.h"

#include <bit>

namespace brittle {
namespace {

constexpr uint32_t kNameBits = 32, kFaceBits = 12, kPlaceBits = 32;
enum VastKey : uint32_t { kFace = 0, kX = 1, kY = 2 };

void sortBy(const Event& e, uint32_t bits) {
    const auto& b = e.b;
    e.record.sort(COUNT_VAST_SIDES, bits, {b.vast_keys, b.vast_other_keys}, {b.vast_values, b.vast_other_values},
                  {b.vast_histogram, b.vast_digit_offsets, b.sums});
}

void sortByKey(const Event& e, VastKey key, uint32_t bits, engine::BufferView sides) {
    const auto& b = e.b;
    Recorder& r = e.record;
    r.run("vast_keys", Length::counted(COUNT_VAST_SIDES), engine::NoPush{},
          {r.counts(), sides, b.vast_chords, b.vast_keys, b.vast_values}, key);
    sortBy(e, bits);
}

// In the order of faces and names, chained into loops.
void recordVastSides(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    const Length sides = Length::counted(COUNT_VAST_SIDES);
    r.run("vast_list", sides, engine::NoPush{},
          {r.counts(), b.faces, b.face_offsets, b.segments, b.welded, b.vast_faces, b.vast_listed, b.vast_keys, b.vast_values});
    sortBy(e, kNameBits);
    sortByKey(e, kFace, kFaceBits, b.vast_listed);
    r.run("vast_sides", sides, engine::NoPush{},
          {r.counts(), b.sites, b.faces, b.neighbors, b.face_cells, b.points, b.vast_faces, b.vast_listed, b.vast_values,
           b.vast_ends, b.vast_chords, b.vast_diagonals, b.vast_heads, b.vast_flags});
    r.run("vast_cancel", sides, engine::NoPush{},
          {r.counts(), b.vast_faces, b.vast_ends, b.vast_rings, b.vast_heads, b.vast_links});
    r.run("vast_chain", sides, engine::NoPush{},
          {r.counts(), b.vast_faces, b.vast_ends, b.vast_chords, b.vast_rings, b.vast_heads, b.vast_links});
}

// Corners by height, and the sides that pass each height.
void recordVastRanks(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    const Length sides = Length::counted(COUNT_VAST_SIDES);
    const uint32_t leaves = e.capacity.vastLeaves();
    sortByKey(e, kX, kPlaceBits, b.vast_ends);
    sortByKey(e, kY, kPlaceBits, b.vast_ends);
    sortByKey(e, kFace, kFaceBits, b.vast_ends);
    r.run("vast_ranks", sides, engine::NoPush{}, {r.counts(), b.vast_ends, b.vast_rings, b.vast_values, b.vast_heads});
    for (const uint32_t is_fill : {0u, 1u}) {
        r.clear({b.vast_span_counts});
        r.run("vast_spans", sides, leaves,
              {r.counts(), b.vast_ends, b.vast_rings, b.vast_span_counts, b.vast_span_offsets, b.vast_spans}, is_fill);
        if (is_fill == 0)
            r.scan(Length::of(2 * leaves), b.vast_span_counts, b.sums, b.vast_span_offsets,
                   {{COUNT_VAST_SPANS, NO_INDEX, NO_INDEX, NO_INDEX}, {e.capacity.vast_spans, 0, 0, 0}});
    }
}

// A part has at most as many half-edges as its face, so that many doublings find the lowest of each.
void recordVastParts(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    const Length halves = Length::counted(COUNT_VAST_HALVES);
    for (uint32_t round = 0; round < VAST_ROUNDS; ++round)
        for (const uint32_t is_cut : {0u, 1u})
            r.run("vast_ears", halves, engine::NoPush{},
                  {r.counts(), b.vast_ends, b.vast_chords, b.vast_diagonals, b.vast_halves, b.vast_marks, b.vast_flags,
                   b.vast_caps},
                  is_cut);
    const uint32_t doublings = 2 + static_cast<uint32_t>(std::bit_width(VAST_HALVES * e.capacity.vast_sides)) / 2 * 2;
    for (uint32_t round = 0; round < doublings; ++round) {
        const auto& from = round % 2 == 0 ? b.vast_labels : b.vast_other_labels;
        const auto& to = round % 2 == 0 ? b.vast_other_labels : b.vast_labels;
        r.run("vast_labels", halves, engine::NoPush{}, {r.counts(), b.vast_halves, from, to}, round == 0 ? 1 : 0);
    }
    r.run("vast_finish", halves, engine::NoPush{},
          {r.counts(), b.vast_ends, b.vast_chords, b.vast_diagonals, b.vast_halves, b.vast_labels, b.vast_flags, b.vast_caps});
}

} // namespace

void recordVastCaps(const Event& e) {
    const auto& b = e.b;
    Recorder& r = e.record;
    const Length sides = Length::counted(COUNT_VAST_SIDES), halves = Length::counted(COUNT_VAST_HALVES);
    r.publish(COUNT_VAST_FACES, static_cast<uint32_t>(b.vast_faces.size / (4 * sizeof(uint32_t))));
    r.publish(COUNT_VAST_SIDES, e.capacity.vast_sides);
    r.publishSum(COUNT_VAST_HALVES, NO_INDEX, {{COUNT_VAST_SIDES, VAST_HALVES}});
    recordVastSides(e);
    recordVastRanks(e);
    r.run("vast_diagonals", sides, e.capacity.vastLeaves(),
          {r.counts(), b.vast_ends, b.vast_chords, b.vast_rings, b.vast_values, b.vast_span_offsets, b.vast_spans,
           b.vast_diagonals, b.vast_heads, b.vast_links});
    r.run("vast_cycles", halves, engine::NoPush{},
          {r.counts(), b.vast_ends, b.vast_chords, b.vast_rings, b.vast_diagonals, b.vast_heads, b.vast_links, b.vast_halves});
    recordVastParts(e);
    r.scan(halves, b.vast_flags, b.sums, b.vast_offsets, {});
    r.run("vast_count", Length::counted(COUNT_VAST_FACES), engine::NoPush{},
          {r.counts(), b.vast_faces, b.vast_offsets, b.cap_counts});
}

} // namespace brittle
