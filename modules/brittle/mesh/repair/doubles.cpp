#include "modules/brittle/mesh/repair/doubles.h"

#include "modules/brittle/mesh/half_edge.h"
#include "modules/brittle/mesh/repair/mesh_edit.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <numeric>
#include <set>

namespace brittle {
namespace {

constexpr uint32_t kSingle = 0xffffffff;

// Patches are what hangs together by edges at which there are doubled triangles only.
class DoubleDropper {
public:
    explicit DoubleDropper(Mesh& mesh) : mesh_(mesh), stack_of_(mesh.triangles.size(), kSingle) {}
    std::vector<Double3> run();

private:
    // The triangles with the same corners, the lowest first.
    using Stack = std::vector<uint32_t>;
    enum class Fate { Undecided, KeepOne, DropAll, Leave };

    void findStacks();
    bool facesBothWays(const Stack& stack) const;
    void joinPatches(const EdgeUses& uses);
    void judgeRims(const EdgeUses& uses);
    void judgeEdge(const EdgeUses& uses, uint32_t edge);
    uint32_t root(uint32_t stack);

    Mesh& mesh_;
    std::vector<Stack> stacks_;
    std::vector<uint32_t> stack_of_; // of every triangle
    std::vector<uint32_t> parent_;   // of every stack: union-find
    std::vector<Fate> fates_;        // of every root
};

std::vector<Double3> DoubleDropper::run() {
    findStacks();
    if (stacks_.empty()) return {};
    const MeshTopology topology = buildTopology(mesh_);
    const EdgeUses uses(topology);
    joinPatches(uses);
    judgeRims(uses);
    std::vector<Double3> dropped;
    std::vector<char> keep(mesh_.triangles.size(), 1);
    for (uint32_t s = 0; s < stacks_.size(); ++s) {
        const Fate fate = facesBothWays(stacks_[s]) ? fates_[root(s)] : Fate::KeepOne;
        if (fate == Fate::Leave) continue;
        for (size_t k = fate == Fate::DropAll ? 0 : 1; k < stacks_[s].size(); ++k) {
            keep[stacks_[s][k]] = 0;
            dropped.push_back(middleOf(cornersOf(mesh_, stacks_[s][k])));
        }
    }
    keepTriangles(mesh_, keep);
    return dropped;
}

void DoubleDropper::findStacks() {
    std::vector<std::pair<Index3, uint32_t>> sorted;
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        Index3 corners = mesh_.triangles[t];
        std::sort(corners.begin(), corners.end());
        sorted.emplace_back(corners, t);
    }
    std::sort(sorted.begin(), sorted.end());
    for (size_t first = 0, last = 0; first < sorted.size(); first = last) {
        while (last < sorted.size() && sorted[last].first == sorted[first].first)
            ++last;
        if (last - first < 2) continue;
        Stack& stack = stacks_.emplace_back();
        for (size_t k = first; k < last; ++k) {
            stack.push_back(sorted[k].second);
            stack_of_[sorted[k].second] = static_cast<uint32_t>(stacks_.size() - 1);
        }
    }
}

bool DoubleDropper::facesBothWays(const Stack& stack) const {
    const auto isTurn = [](const Index3& a, const Index3& b) {
        return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[2]) || (a[0] == b[2] && a[1] == b[0]);
    };
    return std::any_of(stack.begin(), stack.end(),
                       [&](uint32_t t) { return !isTurn(mesh_.triangles[t], mesh_.triangles[stack.front()]); });
}

uint32_t DoubleDropper::root(uint32_t stack) {
    while (parent_[stack] != stack)
        stack = parent_[stack] = parent_[parent_[stack]];
    return stack;
}

void DoubleDropper::joinPatches(const EdgeUses& uses) {
    parent_.resize(stacks_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (uint32_t edge = 0; edge < uses.edgeCount(); ++edge) {
        uint32_t first = kSingle;
        for (const uint32_t h : uses.along(edge)) {
            const uint32_t stack = stack_of_[h / 3];
            if (stack == kSingle) continue;
            if (first == kSingle) first = stack;
            const uint32_t a = root(first), b = root(stack);
            parent_[std::max(a, b)] = std::min(a, b);
        }
    }
}

// An edge at which single triangles end in pairs is closed without the patch; one where one ends alone needs one layer of it.
void DoubleDropper::judgeEdge(const EdgeUses& uses, uint32_t edge) {
    std::set<uint32_t> stacks;
    size_t singles = 0;
    for (const uint32_t h : uses.along(edge)) {
        if (stack_of_[h / 3] == kSingle)
            ++singles;
        else
            stacks.insert(stack_of_[h / 3]);
    }
    if (stacks.empty()) return;
    Fate& fate = fates_[root(*stacks.begin())];
    const bool fits_one = (singles + stacks.size()) % 2 == 0, fits_none = singles % 2 == 0;
    if (fits_one && fits_none) { // the inside of the patch: any layer fits, also none
        if (singles > 0) fate = Fate::Leave;
        return;
    }
    const Fate wanted = fits_one ? Fate::KeepOne : fits_none && singles > 0 ? Fate::DropAll : Fate::Leave;
    fate = fate == Fate::Undecided || fate == wanted ? wanted : Fate::Leave;
}

void DoubleDropper::judgeRims(const EdgeUses& uses) {
    fates_.assign(stacks_.size(), Fate::Undecided);
    for (uint32_t edge = 0; edge < uses.edgeCount(); ++edge)
        judgeEdge(uses, edge);
    for (Fate& fate : fates_)
        if (fate == Fate::Undecided) fate = Fate::KeepOne; // no rim: a closed surface in two layers
}

} // namespace

std::vector<Double3> dropDoubles(Mesh& mesh) { return DoubleDropper(mesh).run(); }

} // namespace brittle
