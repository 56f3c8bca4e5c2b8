// A world of a host's: first what has been added to it, then, once started, the world on the device.
#pragma once

#include "modules/brittle/abi/refusal.h"
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/scene/scene_description.h"

#include <memory>
#include <memory_resource>
#include <optional>
#include <unordered_map>
#include <vector>

namespace brittle::abi {

// Of a body, which says where its shape's frame is: that frame in the body's own.
struct ShapeFrame {
    Double3 place = {0, 0, 0};
    Turn turn = {0, 0, 0, 1};
};

class HostedWorld {
public:
    HostedWorld(SceneDescription described, const BrittleWorldDef& def, std::pmr::memory_resource* memory)
        : scene(std::move(described)), has_surfaces(def.has_surfaces != 0), seed(def.seed), breaks_(memory), impacts_(memory) {}
    void setNumber(uint64_t number) { number_ = number; }

    // Refuse what is not to be called now.
    void mustNotRun() const;
    World& running(); // and what was recorded has been finished
    World& recording();

    void start(engine::Device& device);
    bool isRunning() const { return world_ != nullptr; }
    void noteRecorded() { has_recorded_ = true; }
    void finish();

    // Slots are those of the world: bodies, then colliders, then fragments, which may have slots of bodies that broke as well.
    uint32_t bodyCount() const { return static_cast<uint32_t>(scene.bodies.size()); }
    uint32_t originalCount() const { return static_cast<uint32_t>(scene.bodies.size() + scene.colliders.size()); }
    // Ids of bodies: 1 bit kind, 17 the world's number, 22 number, 24 the step that a fragment was made in, which is as far as
    // the device counts them exactly. Colliders are numbered apart, since bodies may still come when one is added.
    BrittleBody bodyId(uint32_t slot, uint32_t born) const;
    BrittleBody colliderId(uint32_t index) const;
    struct Named {
        uint32_t slot = 0, born = 0;
    };
    Named named(BrittleBody body) const; // refuses what was never an id of this world

    // Events told by the device and not yet to the host; how many were lost. The device tells each once: what it has told waits
    // in `arrived` for as long as the host has no memory for it.
    template <class Event>
    struct Waiting {
        explicit Waiting(std::pmr::memory_resource* memory) : events(memory) {}
        std::pmr::vector<Event> events;
        std::vector<Event> arrived;
        uint32_t lost = 0;
    };
    void listen(); // takes what the device has to tell before newer events take its place
    Waiting<gpu::BreakEvent>& hearBreaks();
    Waiting<gpu::ImpactEvent>& hearImpacts();
    uint32_t breaksLost() const { return breaks_.lost; }
    uint32_t impactsLost() const { return impacts_.lost; }
    void countLost();    // as far as the device can still be asked
    void forgetEvents(); // also what the device has yet to tell

    // Of a body as it was added, by its slot; none, all zeros.
    BrittleMaterial materialOf(uint32_t slot) const;

    SceneDescription scene;
    std::unordered_map<uint64_t, std::string> material_names; // of the context's materials that bodies are of
    WorldSurfaces surfaces;                                   // of what there was at the start, where it has surfaces
    std::vector<ShapeFrame> frames;                           // of bodies and colliders
    bool has_surfaces = false;
    bool is_drawn = false; // draw buffers have been asked for
    uint64_t seed = 1;
    std::optional<std::vector<std::byte>> saved; // just now, to be copied by the next call

private:
    void listenForBreaks();
    void listenForImpacts();
    void findFrames(const std::vector<gpu::BodyState>& states);

    std::unique_ptr<World> world_;
    bool has_recorded_ = false;
    Waiting<gpu::BreakEvent> breaks_;
    Waiting<gpu::ImpactEvent> impacts_;
    uint64_t number_ = 0; // of this world among those of its context
};

} // namespace brittle::abi
