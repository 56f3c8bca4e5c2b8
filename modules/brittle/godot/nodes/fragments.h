// Fragments as the engine draws them: an instance each of the rendering server's, with a mesh of its own, and no nodes, so that
// a thousand cost a thousand instances and nothing else.
#pragma once

#include "modules/brittle/godot/nodes/brittle_body.h"
#include "modules/brittle/godot/simulation/running_world.h"

#include <unordered_map>

namespace brittle_godot {

struct DrawnFragment {
    size_t link = kNone; // the body that it broke off of, however often that broke
    Value mesh;          // ArrayMesh
    Value instance;      // RID, of the rendering server's
    Transform place;
    bool is_asleep = false, is_seen = false;
};

class Fragments {
public:
    Fragments();
    ~Fragments() { clear(); }
    Fragments(const Fragments&) = delete;
    Fragments& operator=(const Fragments&) = delete;

    void clear();
    void setVisible(bool is_visible);
    // Looks as `origin` does: its materials, layers and shadows.
    void add(const FragmentSurface& surface, size_t link, const BodyNode& origin);
    // Between these every fragment that is still there is placed once; those that are not go.
    void beginPlacing();
    void place(const BrittleBodyState& state);
    void endPlacing();

    const DrawnFragment* find(uint64_t id) const;
    std::vector<int64_t> ids() const; // sorted
    size_t count() const { return drawn_.size(); }

private:
    Value server_;
    bool is_visible_ = true;
    std::unordered_map<uint64_t, DrawnFragment> drawn_;
};

} // namespace brittle_godot
