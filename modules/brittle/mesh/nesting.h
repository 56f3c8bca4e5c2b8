// Finds whether the parts of a surface nest as the walls of solids do.
//
// Parts may touch, and where they do, the last digits of floats decide which surface lies above the other. So a part is judged where no
// other surface is within the depth of a touch (self_intersection.h): rays start on up to six of its triangles, each facing
// another way. A part that touches others all over, as a brick inside a wall does, is judged from half way through its own
// solid, or from that depth below its surface.
#pragma once

#include "modules/brittle/mesh/components.h"
#include "modules/brittle/mesh/triangle_tree.h"

namespace brittle {

class Nesting {
public:
    // All three stay the caller's and have to outlive it. `diagonal` is that of the mesh's box.
    Nesting(const Mesh& mesh, const TriangleTree& tree, const Components& components, double diagonal)
        : mesh_(mesh), tree_(tree), components_(components), diagonal_(diagonal) {}

    // How often the whole surface winds around the solid just below the component's surface, on the side that its normals
    // point away from. 1 wherever the surface bounds a solid, 2 inside a second solid, 0 behind a wall that faces the wrong
    // way. Also 1 where every ray grazes edges.
    int windingBelow(uint32_t component);

    // A ray may pass through every triangle, so a caller that asks for every part has to stop somewhere.
    bool isTooLong() const { return tests_ > kMaxTests; }

private:
    struct Hit {
        double distance = 0;
        int turn = 0; // +1 where the ray leaves a solid
        bool is_own = false;
    };
    struct Ray;
    struct Windings;

    Ray rayBelow(uint32_t triangle, int attempt) const;
    bool collectHits(const Ray& ray);
    Windings windings() const;

    static constexpr uint64_t kMaxTests = 100'000'000; // of rays with triangles

    const Mesh& mesh_;
    const TriangleTree& tree_;
    const Components& components_;
    double diagonal_;
    std::vector<Hit> hits_; // of the current ray
    uint64_t tests_ = 0;
};

} // namespace brittle
