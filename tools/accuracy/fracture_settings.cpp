#include "tools/accuracy/fracture_settings.h"

namespace accuracy {
namespace {

using brittle::Caps;
using brittle::CellMapping;
using brittle::FractureOptions;
using brittle::Pattern;
using brittle::Precision;
using brittle::Search;

constexpr const char* kSameBytes = "Nothing: the fragments are the same to the byte.";
constexpr const char* kFloats =
    "Decides by rounded numbers: where sites or faces tie, cells contradict each other and there is no result.";
constexpr const char* kFans = "Cut faces are fans: where the model is not convex they reach outside of it or fold over.";

constexpr FractureSetting kFracture[] = {
    {"default", "exact, caps exact, search auto, cells lanes", "Nothing: exact decisions, cut faces right for any solid.",
     [](FractureOptions&) {}},
    {"precision", "double", kFloats, [](FractureOptions& o) { o.precision = Precision::Double; }},
    {"precision", "fast", kFloats, [](FractureOptions& o) { o.precision = Precision::Fast; }},
    {"caps", "convex", kFans, [](FractureOptions& o) { o.caps = Caps::Convex; }},
    {"search", "sphere_tree", kSameBytes, [](FractureOptions& o) { o.search = Search::SphereTree; }},
    {"search", "linear", "Nothing but time, which grows with the square of the sites: the same bytes.",
     [](FractureOptions& o) { o.search = Search::Linear; }},
    {"cells", "edges", kSameBytes, [](FractureOptions& o) { o.cells = CellMapping::Edges; }},
    {"precision and caps", "fast, convex", "Both: no result where something ties, folded cut faces where it is not convex.",
     [](FractureOptions& o) {
         o.precision = Precision::Fast;
         o.caps = Caps::Convex;
     }},
    {"precision and search", "fast, linear", kFloats,
     [](FractureOptions& o) {
         o.precision = Precision::Fast;
         o.search = Search::Linear;
     }},
    {"precision and cells", "fast, edges", kFloats,
     [](FractureOptions& o) {
         o.precision = Precision::Fast;
         o.cells = CellMapping::Edges;
     }},
};

constexpr FractureSetting kColliders[] = {
    {"default", "26 directions", "Nothing: it is what colliders usually have.", [](FractureOptions& o) { o.collider = 26; }},
    {"directions", "6", "Boxes along the axes: fragments come to rest on air, by the corners of their boxes.",
     [](FractureOptions& o) { o.collider = 6; }},
    {"directions", "14", "Corners are cut off the boxes; edges still stand out.", [](FractureOptions& o) { o.collider = 14; }},
    {"directions", "62", "Nothing: the closest fit.", [](FractureOptions& o) { o.collider = 62; }},
};

constexpr FractureSetting kPatterns[] = {
    {"default", "uniform", "Nothing: sites lie evenly, pieces are about alike.", [](FractureOptions&) {}},
    {"relax", "1 round", "Splinters: pieces become more alike than those of any real break.",
     [](FractureOptions& o) { o.relax = 1; }},
    {"relax", "4 rounds", "Splinters: pieces are nearly all of one size.", [](FractureOptions& o) { o.relax = 4; }},
    {"pattern", "impact", "Nothing: small pieces where it is hit, which is what it is for.",
     [](FractureOptions& o) { o.pattern = Pattern::Impact; }},
    {"pattern", "paper", "Even density: sites crowd about the middle of the model.",
     [](FractureOptions& o) { o.pattern = Pattern::Paper; }},
};

template <uint32_t Candidates>
void asPaper(FractureOptions& o) {
    o.pattern = Pattern::Paper;
    o.impact.candidates = Candidates;
}

constexpr FractureSetting kCrowding[] = {
    {"default", "impact", "Nothing: drawn by the law itself.", [](FractureOptions&) {}},
    {"candidates", "paper, 1 a site", "The hit: sites lie as they would without one.", asPaper<1>},
    {"candidates", "paper, 8 a site",
     "The law of a hit: sites crowd about it no more than eight times as densely as without one.", asPaper<8>},
    {"candidates", "paper, 64 a site", "The law of a hit, and all pieces but the smallest: hardly a site lies far from it.",
     asPaper<64>},
};

} // namespace

std::span<const FractureSetting> fractureSettings() { return kFracture; }
std::span<const FractureSetting> colliderSettings() { return kColliders; }
std::span<const FractureSetting> patternSettings() { return kPatterns; }
std::span<const FractureSetting> crowdingSettings() { return kCrowding; }

} // namespace accuracy
