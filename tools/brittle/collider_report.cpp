#include "tools/brittle/collider_report.h"

#include "modules/brittle/mesh/format.h"

#include <algorithm>
#include <cstdio>

namespace cli {
namespace {

struct Summary {
    double volume_excess = 0; // of all colliders over all fragments, as a part of these
    size_t looser = 0;        // pieces that had to do without planes that would only have made them tighter
    size_t reaching = 0;      // pieces that may reach out of their cell or into another island
};

Summary summaryOf(const brittle::FragmentSet& set) {
    Summary summary;
    double fragments = 0, pieces = 0;
    for (const brittle::Fragment& fragment : set.fragments)
        fragments += fragment.volume;
    for (const brittle::ColliderPiece& piece : set.colliders.pieces) {
        pieces += volumeOf(set.colliders, piece);
        const bool reaches = (piece.lacks & (brittle::kLacksCell | brittle::kLacksPartings)) != 0;
        summary.reaching += reaches ? 1 : 0;
        summary.looser += piece.lacks != 0 && !reaches ? 1 : 0;
    }
    summary.volume_excess = pieces / fragments - 1;
    return summary;
}

} // namespace

nlohmann::ordered_json collidersJson(const brittle::FragmentSet& fragments) {
    const Summary summary = summaryOf(fragments);
    const brittle::ColliderSet& set = fragments.colliders;
    return {{"pieces", set.pieces.size()},          {"planes", set.faces.size()},
            {"vertices", set.vertices.size()},      {"volume_excess", summary.volume_excess},
            {"overlapping_pairs", set.overlapping}, {"lack_planes", summary.looser},
            {"may_reach_out", summary.reaching}};
}

void printColliders(const brittle::FragmentSet& fragments) {
    const Summary summary = summaryOf(fragments);
    const brittle::ColliderSet& set = fragments.colliders;
    std::printf("colliders  %zu with %zu planes, %.3g %% larger than the fragments, %s\n", set.pieces.size(), set.faces.size(),
                100 * summary.volume_excess, brittle::formatCount(set.overlapping.size(), "overlapping pair").c_str());
}

} // namespace cli
