// Bodies that other bodies of a world have broken into, as the host reads them: which there are, and what they look like.
#pragma once

#include "engine/buffer.h"
#include "engine/device.h"
#include "modules/brittle/dynamics/body_surface.h"

#include <optional>
#include <span>

namespace brittle {

struct BodyFragment {
    uint32_t slot = 0;       // of a body
    uint32_t step = 0;       // that it was made in, counted from 1: another fragment in the same slot has another
    uint32_t origin = 0;     // the slot of the first body that it was a part of, however often that has broken since
    uint32_t parent = 0;     // the slot of the body that broke into it; somebody else may have the slot by now
    uint32_t generation = 1; // 1: of a body that was whole from the beginning
    gpu::BreakableBody record{};
    float fade = 1; // how much is left of one that goes, down to 0: for whoever draws it
};

// Which fragments there are, read anew only where something has broken or gone since.
class FragmentList {
public:
    // Of the first so many slots, those that hold a fragment. `breakable`: BreakableBody, `births`: Birth, by slot; `changes`:
    // how many bodies have broken and fragments gone so far.
    engine::Result<std::vector<BodyFragment>> read(engine::Device& device, engine::BufferView breakable,
                                                   engine::BufferView births, uint32_t slots, uint32_t changes);
    void forget() { known_of_.reset(); }

private:
    std::vector<BodyFragment> known_; // when there were so many changes
    std::optional<uint32_t> known_of_ = 0;
};

// About their centers of mass, along their own axes; what follows the outer triangles are faces of cuts. `vertices`:
// SceneVertex, of all that `fragments` were read from and that has not broken since.
engine::Result<std::vector<SurfaceMesh>> readSurfaces(engine::Device& device, engine::BufferView vertices,
                                                      std::span<const BodyFragment> fragments);

} // namespace brittle
