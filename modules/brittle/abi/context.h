// What a context holds. The C ABI's functions, files by subject beside this one, find what they work on here.
#pragma once

#include "engine/device.h"
#include "modules/brittle/abi/host_memory.h"
#include "modules/brittle/abi/hosted_world.h"
#include "modules/brittle/abi/id_table.h"
#include "modules/brittle/mesh/imported_mesh.h"
#include "modules/brittle/scene/scene_description.h"

#include <array>
#include <memory>
#include <string>

namespace brittle::abi {

struct HostedMesh {
    std::shared_ptr<const ImportedMesh> model;
    bool is_open = false;
};

} // namespace brittle::abi

struct BrittleContext {
    BrittleContext(const BrittleContextDef& def, std::unique_ptr<engine::Device> opened);
    ~BrittleContext();
    BrittleContext(const BrittleContext&) = delete;
    BrittleContext& operator=(const BrittleContext&) = delete;

    // Keeps the message, tells the log, and returns the code. Never throws.
    BrittleResult fail(BrittleResult code, const char* message) noexcept;

    brittle::abi::HostMemory memory;
    BrittleLog log;
    void* log_user;
    std::unique_ptr<engine::Device> device;
    uint64_t tag; // in all ids
    brittle::abi::IdTable<brittle::abi::HostedMesh> meshes;
    brittle::abi::IdTable<brittle::MaterialDescription> materials;
    brittle::abi::IdTable<brittle::abi::HostedWorld> worlds;
    uint64_t next_world; // a number for each, in the ids of its bodies
    std::array<char, 1024> last_error = {};
};
