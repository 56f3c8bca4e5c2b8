#include "modules/brittle/scene/hull/qhull_faces.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/vector_math.h"

#include <libqhull_r/libqhull_r.h>

#include <cstdio>
#include <cstdlib>
#include <map>

namespace brittle {
namespace {

// Qhull reports in words, to a file.
class Report {
public:
    Report() : file_(open_memstream(&text_, &size_)) {}
    ~Report() {
        if (file_ != nullptr) std::fclose(file_);
        std::free(text_);
    }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;
    FILE* file() const { return file_; }
    std::string firstLine() {
        if (file_ == nullptr) return "";
        std::fflush(file_);
        const std::string all(text_, size_);
        return all.substr(0, all.find('\n'));
    }

private:
    char* text_ = nullptr;
    size_t size_ = 0;
    FILE* file_;
};

class Qhull {
public:
    Qhull() { qh_zero(&state_, report_.file()); }
    ~Qhull() {
        qh_freeqhull(&state_, !qh_ALL);
        int still_used = 0, pieces = 0;
        qh_memfreeshort(&state_, &still_used, &pieces);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    engine::Result<std::vector<PointFace>> run(std::vector<coordT> coordinates, double flatness);

private:
    PointFace faceFrom(const facetT& facet) const;
    uint32_t idOf(const vertexT& vertex) const {
        return static_cast<uint32_t>((vertex.point - state_.first_point) / state_.hull_dim);
    }

    Report report_;
    qhT state_;
};

template <class Item, class Do>
void forEach(const setT* set, const Do& act) {
    if (set == nullptr) return;
    for (const setelemT* entry = set->e; entry->p != nullptr; ++entry)
        act(*static_cast<const Item*>(entry->p));
}

// Once around, from neighbor to neighbor. Empty where the edges are no single ring.
std::vector<uint32_t> ringOf(const std::map<uint32_t, std::vector<uint32_t>>& neighbors) {
    for (const auto& [vertex, others] : neighbors)
        if (others.size() != 2) return {};
    std::vector<uint32_t> ring;
    uint32_t before = 0xffffffff, here = neighbors.begin()->first;
    do {
        ring.push_back(here);
        const std::vector<uint32_t>& others = neighbors.at(here);
        const uint32_t next = others[0] == before ? others[1] : others[0];
        before = here;
        here = next;
    } while (here != ring.front() && ring.size() <= neighbors.size());
    return ring.size() == neighbors.size() ? ring : std::vector<uint32_t>();
}

// A triangle has its vertices, a merged facet has ridges: edges with a neighbor each.
PointFace Qhull::faceFrom(const facetT& facet) const {
    PointFace face;
    face.normal = {facet.normal[0], facet.normal[1], facet.normal[2]};
    if (facet.simplicial) {
        forEach<vertexT>(facet.vertices, [&](const vertexT& vertex) { face.loop.push_back(idOf(vertex)); });
        return face;
    }
    std::map<uint32_t, std::vector<uint32_t>> neighbors;
    forEach<ridgeT>(facet.ridges, [&](const ridgeT& ridge) {
        const uint32_t a = idOf(*static_cast<const vertexT*>(ridge.vertices->e[0].p));
        const uint32_t b = idOf(*static_cast<const vertexT*>(ridge.vertices->e[1].p));
        neighbors[a].push_back(b);
        neighbors[b].push_back(a);
    });
    if (!neighbors.empty()) face.loop = ringOf(neighbors);
    return face;
}

engine::Result<std::vector<PointFace>> Qhull::run(std::vector<coordT> coordinates, double flatness) {
    // C-n merges what is flatter than n, Pp leaves out advice about precision.
    std::string command = "qhull C-" + formatNumber(flatness) + " Pp";
    const int failed = qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), False,
                                    command.data(), nullptr, report_.file());
    if (failed != 0) return engine::Error{engine::ErrorCode::Internal, "no hull of these points: " + report_.firstLine()};
    std::vector<PointFace> faces;
    for (const facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next)
        faces.push_back(faceFrom(*facet));
    return faces;
}

} // namespace

engine::Result<std::vector<PointFace>> facesOfHull(const CleanPoints& clean, double flatness) {
    // About the middle and of size 1, so that tolerances are the same for all.
    std::vector<coordT> coordinates;
    for (const Double3& p : clean.points)
        for (size_t c = 0; c < 3; ++c)
            coordinates.push_back((p[c] - clean.middle[c]) / clean.size);
    return Qhull().run(std::move(coordinates), flatness);
}

} // namespace brittle
