#include "modules/brittle/mesh/repair/orientation.h"

#include "modules/brittle/mesh/components.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/nesting.h"
#include "modules/brittle/mesh/repair/mesh_edit.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <map>

namespace brittle {
namespace {

constexpr uint32_t kNone = 0xffffffff;

bool runsUp(const Mesh& mesh, uint32_t h) { return startOf(mesh, h) < endOf(mesh, h); }

// From triangle to triangle over edges of two.
class Propagation {
public:
    Propagation(const Mesh& mesh, const EdgeUses& uses) : mesh_(mesh), uses_(uses) {}
    Orientation run();

private:
    void spreadFrom(uint32_t triangle);
    void visit(uint32_t h);
    void preferMajority(uint32_t first_member);

    const Mesh& mesh_;
    const EdgeUses& uses_;
    Orientation found_;
    std::vector<uint32_t> members_; // triangles of all parts so far, also the queue
};

Orientation Propagation::run() {
    found_.part.assign(mesh_.triangles.size(), kNone);
    found_.turn.assign(mesh_.triangles.size(), 0);
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        if (found_.part[t] == kNone) spreadFrom(t);
    return std::move(found_);
}

void Propagation::spreadFrom(uint32_t triangle) {
    const auto first = static_cast<uint32_t>(members_.size());
    found_.part[triangle] = found_.part_count;
    members_.push_back(triangle);
    for (size_t next = first; next < members_.size(); ++next)
        for (uint32_t k = 0; k < 3; ++k)
            visit(3 * members_[next] + k);
    preferMajority(first);
    ++found_.part_count;
}

void Propagation::visit(uint32_t h) {
    const uint32_t other = uses_.across(h);
    if (other == h) return;
    const bool agree = runsUp(mesh_, h) != runsUp(mesh_, other);
    const char turn = agree ? found_.turn[h / 3] : static_cast<char>(1 - found_.turn[h / 3]);
    if (found_.part[other / 3] == kNone) {
        found_.part[other / 3] = found_.part_count;
        found_.turn[other / 3] = turn;
        members_.push_back(other / 3);
    } else if (found_.turn[other / 3] != turn && h < other) {
        found_.torn.push_back(uses_.edgeOf(h));
    }
}

void Propagation::preferMajority(uint32_t first_member) {
    size_t turned = 0;
    for (size_t k = first_member; k < members_.size(); ++k)
        turned += static_cast<size_t>(found_.turn[members_[k]]);
    if (2 * turned <= members_.size() - first_member) return;
    for (size_t k = first_member; k < members_.size(); ++k)
        found_.turn[members_[k]] = static_cast<char>(1 - found_.turn[members_[k]]);
}

// Joins the parts that meet at an edge of more than two triangles, if there is one of them that does not close there alone.
void joinUnbalanced(const Mesh& mesh, const EdgeUses& uses, Orientation& found) {
    std::vector<uint32_t> parent(found.part_count);
    for (uint32_t p = 0; p < parent.size(); ++p)
        parent[p] = p;
    const auto root = [&](uint32_t p) {
        while (parent[p] != p)
            p = parent[p] = parent[parent[p]];
        return p;
    };
    for (uint32_t edge = 0; edge < uses.edgeCount(); ++edge) {
        if (uses.along(edge).size() <= 2) continue;
        std::map<uint32_t, int> balance;
        for (const uint32_t h : uses.along(edge))
            balance[found.part[h / 3]] += runsUp(mesh, h) != (found.turn[h / 3] != 0) ? 1 : -1;
        uint32_t first = kNone;
        for (const auto& [part, sum] : balance) {
            if (sum == 0) continue;
            first = first == kNone ? root(part) : first;
            const uint32_t a = root(first), b = root(part);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::vector<uint32_t> number(parent.size(), kNone);
    uint32_t count = 0;
    for (uint32_t p = 0; p < parent.size(); ++p) {
        uint32_t& its_number = number[root(p)];
        if (its_number == kNone) its_number = count++;
    }
    for (uint32_t& p : found.part)
        p = number[root(p)];
    found.part_count = count;
}

void turnParts(Mesh& mesh, const Orientation& found, const std::vector<char>& turn) {
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        if (turn[found.part[t]]) turnTriangle(mesh, t);
}

} // namespace

Orientation findOrientation(const Mesh& mesh, const EdgeUses& uses) {
    Orientation found = Propagation(mesh, uses).run();
    joinUnbalanced(mesh, uses, found);
    return found;
}

// All outward first: then a point just below a part's surface is wound around once by the part itself and once more by each
// part that holds it.
std::vector<TurnedPart> turnOutward(Mesh& mesh) {
    const MeshTopology topology = buildTopology(mesh);
    const Orientation found = findOrientation(mesh, EdgeUses(topology));
    const Components before = measureComponents(mesh, found.part, found.part_count);
    const size_t count = before.all.size();
    std::vector<char> turn(count, 0), is_hollow(count, 0);
    for (size_t p = 0; p < count; ++p)
        turn[p] = before.all[p].volume < 0 ? 1 : 0;
    turnParts(mesh, found, turn);
    const Components parts = measureComponents(mesh, found.part, found.part_count);
    const TriangleTree tree(mesh);
    Nesting nesting(mesh, tree, parts, measureMesh(mesh).diagonal);
    for (uint32_t p = 0; p < count && !nesting.isTooLong(); ++p) // the check refuses what takes longer
        is_hollow[p] = nesting.windingBelow(p) % 2 == 0 ? 1 : 0;
    turnParts(mesh, found, is_hollow);
    std::vector<TurnedPart> turned;
    for (size_t p = 0; p < count; ++p)
        if (turn[p] != is_hollow[p])
            turned.push_back(
                {middleOf(cornersOf(mesh, parts.all[p].largest_triangle)), is_hollow[p] != 0, -2 * before.all[p].volume});
    return turned;
}

} // namespace brittle
