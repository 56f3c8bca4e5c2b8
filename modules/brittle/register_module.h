// Brittle as a module of the engine: worlds that are stepped with every frame. Here alone it meets the engine's registry.
#pragma once

#include "engine/module.h"
#include "modules/brittle/dynamics/world.h"

#include <memory>

namespace brittle {

// What the module offers by this name, once it has started.
constexpr const char* kWorldsService = "brittle.worlds/1";
class Worlds {
public:
    virtual ~Worlds() = default;
    // From the next frame on it is stepped with the others: in every frame by as many steps of its own length as the frame's
    // time has room for, what is left over goes into the next. The module owns it, up to its shutdown. Between frames it may be
    // asked whatever a world may be asked; where it made no steps for lack of room it makes them then. Errors: those of
    // World::create.
    virtual engine::Result<World*> add(const WorldContents& contents, const StepSettings& settings = {},
                                       const WorldBudget& budget = {}) = 0;
};

std::unique_ptr<engine::Module> makeBrittleModule();

} // namespace brittle
