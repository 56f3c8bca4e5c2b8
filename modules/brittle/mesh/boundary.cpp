#include "modules/brittle/mesh/boundary.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace brittle {
namespace {

constexpr uint32_t kNone = 0xffffffff;

// An end of an open edge is 2k at the start and 2k + 1 at the end of the k-th open half-edge.
class BoundaryTracer {
public:
    BoundaryTracer(const Mesh& mesh, const EdgeUses& uses) : mesh_(mesh), uses_(uses) {}
    Boundary run();

private:
    void collectOpen();
    uint32_t endBeyondSheet(uint32_t k, bool at_end) const;
    void linkSheets();
    void linkAcrossGaps();
    void linkGaps(std::span<const uint32_t> ends);
    uint32_t vertexAt(uint32_t end) const {
        const uint32_t h = open_[end / 2];
        return end % 2 == 0 ? startOf(mesh_, h) : endOf(mesh_, h);
    }
    void traceFrom(uint32_t first, std::vector<char>& is_taken, Boundary& boundary) const;
    void addLoops(const std::vector<uint32_t>& path, bool is_closed, Boundary& boundary) const;
    void numberRims(Boundary& boundary) const;

    const Mesh& mesh_;
    const EdgeUses& uses_;
    std::vector<uint32_t> open_;                      // half-edges
    std::unordered_map<uint32_t, uint32_t> place_of_; // half-edge -> index in open_
    std::vector<uint32_t> sheet_link_, loop_link_;    // end -> the end that follows, kNone where that is not certain
    std::unordered_set<uint32_t> tangled_;            // vertices where more than two sheets meet
};

Boundary BoundaryTracer::run() {
    collectOpen();
    linkSheets();
    linkAcrossGaps();
    Boundary boundary;
    std::vector<char> is_taken(open_.size(), 0);
    // Paths that end somewhere first, from their ends, so that none is cut in two.
    for (uint32_t end = 0; end < loop_link_.size(); ++end)
        if (loop_link_[end] == kNone && !is_taken[end / 2]) traceFrom(end, is_taken, boundary);
    for (uint32_t k = 0; k < open_.size(); ++k)
        if (!is_taken[k]) traceFrom(2 * k, is_taken, boundary);
    numberRims(boundary);
    return boundary;
}

void BoundaryTracer::collectOpen() {
    for (uint32_t h = 0; h < 3 * mesh_.triangles.size(); ++h)
        if (uses_.isOpen(h)) {
            place_of_.emplace(h, static_cast<uint32_t>(open_.size()));
            open_.push_back(h);
        }
}

// Turns around the vertex, from triangle to triangle, until the sheet ends at its other open edge.
uint32_t BoundaryTracer::endBeyondSheet(uint32_t k, bool at_end) const {
    uint32_t h = open_[k];
    const uint32_t vertex = at_end ? endOf(mesh_, h) : startOf(mesh_, h);
    for (size_t turns = 0; turns <= mesh_.triangles.size(); ++turns) {
        // The other edge of this triangle at the vertex.
        h = startOf(mesh_, h) == vertex ? previousHalfEdge(h) : nextHalfEdge(h);
        if (uses_.isOpen(h)) return 2 * place_of_.at(h) + (endOf(mesh_, h) == vertex ? 1 : 0);
        const uint32_t other = uses_.across(h);
        if (other == h) return kNone;
        h = other;
    }
    return kNone;
}

void BoundaryTracer::linkSheets() {
    sheet_link_.assign(2 * open_.size(), kNone);
    for (uint32_t k = 0; k < open_.size(); ++k)
        for (const bool at_end : {false, true})
            if (sheet_link_[2 * k + at_end] == kNone) {
                const uint32_t other = endBeyondSheet(k, at_end);
                sheet_link_[2 * k + at_end] = other;
                if (other != kNone) sheet_link_[other] = 2 * k + at_end;
            }
}

void BoundaryTracer::linkAcrossGaps() {
    loop_link_ = sheet_link_;
    std::vector<std::pair<uint32_t, uint32_t>> ends; // by vertex
    for (uint32_t end = 0; end < 2 * open_.size(); ++end)
        ends.emplace_back(vertexAt(end), end);
    std::sort(ends.begin(), ends.end());
    std::vector<uint32_t> here;
    for (size_t k = 0; k < ends.size(); ++k) {
        here.push_back(ends[k].second);
        if (k + 1 < ends.size() && ends[k + 1].first == ends[k].first) continue;
        if (here.size() == 4) linkGaps(here);
        if (here.size() > 4 || here.size() % 2 != 0) tangled_.insert(ends[k].first);
        here.clear();
    }
}

// Of two sheets, the end where one comes in goes with the end where the other goes out.
void BoundaryTracer::linkGaps(std::span<const uint32_t> ends) {
    const uint32_t a = ends[0], b = sheet_link_[a];
    const bool is_certain = std::all_of(ends.begin(), ends.end(),
                                        [&](uint32_t end) { return sheet_link_[end] != kNone && sheet_link_[end] != end; });
    if (!is_certain) return;
    std::vector<uint32_t> others;
    std::copy_if(ends.begin(), ends.end(), std::back_inserter(others), [&](uint32_t end) { return end != a && end != b; });
    if (others.size() != 2 || a % 2 == b % 2 || others[0] % 2 == others[1] % 2) return;
    const uint32_t against_a = others[0] % 2 != a % 2 ? others[0] : others[1], against_b = others[0] + others[1] - against_a;
    loop_link_[a] = against_a;
    loop_link_[against_a] = a;
    loop_link_[b] = against_b;
    loop_link_[against_b] = b;
}

void BoundaryTracer::traceFrom(uint32_t first, std::vector<char>& is_taken, Boundary& boundary) const {
    std::vector<uint32_t> path; // ends at which the edges are entered
    uint32_t end = first;
    while (end != kNone && !is_taken[end / 2]) {
        is_taken[end / 2] = 1;
        path.push_back(end);
        end = loop_link_[end ^ 1u];
    }
    addLoops(path, end == first, boundary);
}

// A path that passes a vertex twice is cut there: every part is a loop of its own.
void BoundaryTracer::addLoops(const std::vector<uint32_t>& path, bool is_closed, Boundary& boundary) const {
    std::vector<uint32_t> waiting;
    std::unordered_map<uint32_t, size_t> passed; // vertex -> how many edges were waiting when it was passed
    bool is_clean = is_closed;
    const auto addLoop = [&](size_t from) {
        BoundaryLoop& loop = boundary.loops.emplace_back();
        for (size_t k = from; k < waiting.size(); ++k) {
            is_clean = is_clean && !tangled_.contains(vertexAt(waiting[k]));
            loop.half_edges.push_back(open_[waiting[k] / 2]);
            passed.erase(vertexAt(waiting[k]));
        }
        loop.is_simple = is_clean && loop.half_edges.size() >= 3;
        is_clean = is_closed;
        waiting.resize(from);
    };
    for (const uint32_t end : path) {
        passed.emplace(vertexAt(end), waiting.size());
        waiting.push_back(end);
        if (const auto found = passed.find(vertexAt(end ^ 1u)); found != passed.end() && is_closed) addLoop(found->second);
    }
    if (!waiting.empty()) addLoop(0);
}

void BoundaryTracer::numberRims(Boundary& boundary) const {
    std::vector<uint32_t> rim_of(open_.size(), kNone);
    uint32_t count = 0;
    for (uint32_t k = 0; k < open_.size(); ++k) {
        if (rim_of[k] != kNone) continue;
        for (uint32_t end = 2 * k; end != kNone && rim_of[end / 2] == kNone; end = sheet_link_[end ^ 1u])
            rim_of[end / 2] = count;
        // And the other way, where the first did not come back.
        for (uint32_t end = sheet_link_[2 * k]; end != kNone && rim_of[end / 2] == kNone; end = sheet_link_[end ^ 1u])
            rim_of[end / 2] = count;
        ++count;
    }
    for (const BoundaryLoop& loop : boundary.loops)
        for (const uint32_t h : loop.half_edges)
            boundary.rims.push_back(rim_of[place_of_.at(h)]);
}

} // namespace

Boundary findBoundary(const Mesh& mesh, const EdgeUses& uses) { return BoundaryTracer(mesh, uses).run(); }

} // namespace brittle
