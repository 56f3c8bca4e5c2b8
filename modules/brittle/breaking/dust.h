// Dust: what of a body that breaks is too small for a body flies on as particles, as the body moved there, until it settles. It
// touches nothing but planes, and nothing feels it: bodies are where they would be without it, bit for bit.
//
// Particles fall through air by the drag of a ball: L. Schiller, A. Naumann, "Ueber die grundlegenden Berechnungen bei der
// Schwerkraftaufbereitung" (1933).
#pragma once

#include "modules/brittle/breaking/adopt.h"
#include "modules/brittle/breaking/dust_state.h"
#include "modules/brittle/dynamics/step.h"

#include <memory>

namespace brittle {

class DustRing {
public:
    // `contents`: whose planes dust lies on; `particles`: that fly at a time, rounded up to a power of two; `fragments`: of an
    // event, at most. Errors: Capacity, Device.
    static engine::Result<std::unique_ptr<DustRing>> create(engine::Device& device, const WorldContents& contents,
                                                            uint32_t particles, uint32_t fragments);

    // Of what was made in earlier steps.
    void recordFlight(const Step& step) const;
    // Of an event, once its cracks are paid for and while bodies that broke are still there. `order`, `owners`: of fragments,
    // by object.
    struct Event {
        const BrokenParts& parts;
        const BreakableWorld& world;
        engine::BufferView counts, lanes; // dispatch arguments of a lane a fragment
        engine::BufferView order, owners;
    };
    void recordEmission(const Step& step, const Event& event) const;

    engine::Result<Dust> read() const;
    std::vector<engine::BufferView> stateViews() const { return {state_, ring_}; }
    std::vector<NamedBuffer> named() const;

private:
    explicit DustRing(engine::Device& device) : device_(device) {}
    engine::Result<void> make(const std::vector<gpu::DustPlane>& planes, uint32_t fragments);

    engine::Device& device_;
    uint32_t capacity_ = 0, plane_count_ = 0;
    engine::Buffer state_, ring_, planes_, offsets_;
};

} // namespace brittle
