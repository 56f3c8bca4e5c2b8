#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/conversions.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <span>
#include <unordered_map>

namespace {

using namespace brittle::abi;
using brittle::BodyFragment;
using Named = HostedWorld::Named;
using brittle::operator+;

// Who is in which slot now.
class Inhabitants {
public:
    explicit Inhabitants(HostedWorld& world) : world_(world), states_(orRefuse(world.running().bodies())) {
        for (BodyFragment& fragment : orRefuse(world.running().fragments()))
            fragments_.emplace(fragment.slot, std::move(fragment));
    }

    std::vector<BrittleBodyState> all() const {
        std::vector<BrittleBodyState> list;
        for (uint32_t slot = 0; slot < states_.size(); ++slot)
            if (isInhabited(slot)) list.push_back(stateOf(slot));
        return list;
    }

    BrittleBodyState one(const Named& named) const {
        if (named.slot >= states_.size() && named.born == 0) throw Refusal(BRITTLE_WRONG_HANDLE, "there was never such a body");
        if (named.slot >= states_.size() || !isInhabited(named.slot) || bornIn(named.slot) != named.born)
            throw Refusal(BRITTLE_STALE_HANDLE, "this body has broken, or is gone");
        return stateOf(named.slot);
    }
    const BodyFragment* fragmentIn(uint32_t slot) const {
        const auto found = fragments_.find(slot);
        return found == fragments_.end() ? nullptr : &found->second;
    }

private:
    bool isInhabited(uint32_t slot) const { return (states_[slot].sector.w & BODY_ABSENT) == 0; }
    uint32_t bornIn(uint32_t slot) const { return fragmentIn(slot) != nullptr ? fragmentIn(slot)->step : 0; }

    BrittleBodyState stateOf(uint32_t slot) const {
        const gpu::BodyState& state = states_[slot];
        const BodyFragment* fragment = fragmentIn(slot);
        const brittle::Pose pose = brittle::poseOf(state);
        BrittleBodyState s = {};
        s.body = world_.bodyId(slot, bornIn(slot));
        s.origin = fragment != nullptr ? world_.bodyId(fragment->origin, 0) : s.body;
        s.position = vectorOf(pose.place);
        s.rotation = quatOf(pose.turn);
        setShapeFrame(s, pose, slot, fragment == nullptr);
        s.velocity = vectorOf(state.velocity);
        s.spin = vectorOf(state.spin);
        s.mass = state.offset.w > 0 ? 1.0 / double{state.offset.w} : 0;
        s.left = fragment != nullptr ? fragment->fade : 1;
        s.is_asleep = (state.sector.w & BODY_ASLEEP) != 0 ? 1 : 0;
        s.is_fragment = fragment != nullptr ? 1 : 0;
        s.is_collider = fragment == nullptr && slot >= world_.bodyCount() ? 1 : 0;
        s.made_in_step = bornIn(slot);
        return s;
    }

    // What was described with a shape of its own still has it; a fragment's shape is in its own frame.
    void setShapeFrame(BrittleBodyState& s, const brittle::Pose& pose, uint32_t slot, bool is_original) const {
        const ShapeFrame frame = is_original ? world_.frames[slot] : ShapeFrame{};
        s.shape_position = vectorOf(pose.place + brittle::turnedBy(pose.turn, frame.place));
        s.shape_rotation = quatOf(product(pose.turn, frame.turn));
    }
    static brittle::Turn product(const brittle::Turn& p, const brittle::Turn& q) {
        return {p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1], p[3] * q[1] - p[0] * q[2] + p[1] * q[3] + p[2] * q[0],
                p[3] * q[2] + p[0] * q[1] - p[1] * q[0] + p[2] * q[3], p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2]};
    }

    const HostedWorld& world_;
    std::vector<gpu::BodyState> states_;
    std::unordered_map<uint32_t, BodyFragment> fragments_;
};

// As many as there is room for; throws where there are more.
template <class T>
void handOver(const std::vector<T>& list, T* room, uint32_t capacity, uint32_t& count) {
    if (capacity > 0) needed(room, "the list");
    count = static_cast<uint32_t>(list.size());
    std::copy_n(list.begin(), std::min<size_t>(list.size(), capacity), room);
    if (list.size() > capacity)
        throw Refusal(BRITTLE_BUFFER_TOO_SMALL,
                      "there is room for " + std::to_string(capacity) + " of " + std::to_string(count));
}

// Of fragments all at once, since the device is asked for them.
std::vector<brittle::SurfaceMesh> surfacesIn(HostedWorld& world, const Inhabitants& inhabitants,
                                             const std::vector<Named>& named) {
    std::vector<BodyFragment> fragments;
    for (const Named& name : named)
        if (const BodyFragment* fragment = inhabitants.fragmentIn(name.slot)) fragments.push_back(*fragment);
    std::vector<brittle::SurfaceMesh> of_fragments, all;
    if (!fragments.empty()) of_fragments = orRefuse(world.running().surfacesOf(fragments));
    size_t next = 0;
    for (const Named& name : named)
        all.push_back(inhabitants.fragmentIn(name.slot) != nullptr
                          ? std::move(of_fragments[next++])
                          : world.surfaces.meshes[world.surfaces.bodies[name.slot].mesh]);
    return all;
}

// Of bodies that are there, in a world that has surfaces.
std::vector<brittle::SurfaceMesh> surfacesOf(HostedWorld& world, std::span<const BrittleBody> bodies) {
    static_cast<void>(world.running());
    std::vector<Named> named;
    for (const BrittleBody body : bodies)
        named.push_back(world.named(body));
    if (!world.has_surfaces) throw Refusal(BRITTLE_BAD_VALUE, "the world was made with has_surfaces = 0");
    const Inhabitants inhabitants(world);
    for (const Named& name : named)
        static_cast<void>(inhabitants.one(name));
    return surfacesIn(world, inhabitants, named);
}

std::vector<BrittleVertex> verticesOf(const brittle::SurfaceMesh& surface) {
    std::vector<BrittleVertex> vertices;
    for (const uint32_t index : surface.indices) {
        const brittle::FragmentVertex& from = surface.vertices[index];
        BrittleVertex& to = vertices.emplace_back();
        std::ranges::copy(from.position, to.position);
        std::ranges::copy(from.normal, to.normal);
        std::ranges::copy(from.uv, to.uv);
    }
    return vertices;
}

} // namespace

BrittleResult brittleGetBodies(BrittleContext* context, BrittleWorld world, BrittleBodyState* states, uint32_t capacity,
                               uint32_t* count) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint32_t& found = needed(count, "count");
        handOver(Inhabitants(w).all(), states, capacity, found);
    });
}

BrittleResult brittleGetBody(BrittleContext* context, BrittleWorld world, BrittleBody body, BrittleBodyState* state) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        BrittleBodyState& out = needed(state, "state");
        static_cast<void>(w.running());
        const Named named = w.named(body);
        out = Inhabitants(w).one(named);
    });
}

BrittleResult brittleGetCounts(BrittleContext* context, BrittleWorld world, BrittleCounts* counts) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        BrittleCounts& out = sized(counts, "counts");
        const brittle::WorldCounts n = orRefuse(w.running().counts());
        w.listen(); // what was lost is known then
        out = {sizeof out, n.bodies,    n.awake,   n.pairs,        n.contacts,
               n.broken,   n.fragments, n.expired, w.breaksLost(), w.impactsLost()};
    });
}

BrittleResult brittleNumberOf(BrittleContext* context, BrittleWorld world, BrittleBody body, uint32_t* number) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint32_t& out = needed(number, "number");
        static_cast<void>(w.recording());
        out = w.named(body).slot;
    });
}

BrittleResult brittleGetSurface(BrittleContext* context, BrittleWorld world, BrittleBody body, BrittleVertex* vertices,
                                uint32_t capacity, uint32_t* count, uint32_t* outer) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint32_t &all = needed(count, "count"), &own = needed(outer, "outer");
        const std::vector<brittle::SurfaceMesh> surfaces = surfacesOf(w, {&body, 1});
        own = surfaces[0].outer_index_count;
        handOver(verticesOf(surfaces[0]), vertices, capacity, all);
    });
}

BrittleResult brittleGetSurfaces(BrittleContext* context, BrittleWorld world, const BrittleBody* bodies, uint32_t body_count,
                                 BrittleVertex* vertices, uint32_t capacity, uint32_t* total, uint32_t* counts,
                                 uint32_t* outers) {
    return bounded(context, [&](BrittleContext& c) {
        HostedWorld& w = c.worlds.at(world.id);
        uint32_t& all = needed(total, "total");
        if (body_count > 0) {
            needed(bodies, "bodies");
            needed(counts, "counts");
            needed(outers, "outers");
        }
        const std::vector<brittle::SurfaceMesh> surfaces = surfacesOf(w, {bodies, body_count});
        std::vector<BrittleVertex> joined;
        for (uint32_t k = 0; k < body_count; ++k) {
            const std::vector<BrittleVertex> one = verticesOf(surfaces[k]);
            counts[k] = static_cast<uint32_t>(one.size());
            outers[k] = surfaces[k].outer_index_count;
            joined.insert(joined.end(), one.begin(), one.end());
        }
        handOver(joined, vertices, capacity, all);
    });
}
