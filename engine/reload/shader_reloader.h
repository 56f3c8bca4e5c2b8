// Kernels that follow their sources while a program runs.
//
// Threads of its own watch a folder and everything that is included from it, compile what was saved as the build would, check
// it, and make its pipelines ready (a CPU's driver is made to compile it as well), while the program goes on with what it has.
// The program asks once a frame, between two recordings, whether there is something to take over:
//
//     auto reloader = engine::ShaderReloader::start(device, {.folder = "shaders-spirv"});
//     (*reloader)->attach(world->kernels());
//     for (;;) {
//         const auto events = (*reloader)->swap();
//         if (engine::somethingRuns(events)) world->kernelsChanged(); // record anew
//         world->step();
//     }
//
// Recordings own the pipelines that they were made with, so what is replaced is destroyed when the last of them is begun anew
// or gone, and never while the device works on it.
#pragma once

#include "engine/device.h"
#include "engine/kernel.h"
#include "engine/reload/reload_event.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace engine {

struct ReloadOptions {
    std::filesystem::path folder;                              // where the rows of `modules` have their sources
    std::vector<std::filesystem::path> include_folders;        // empty: `folder`
    std::span<const shaders::Module> modules = shaders::all(); // the table that the program was built with
    uint32_t threads = 0;                                      // that compile side by side; 0: one a core
};

enum class KernelState {
    Unchecked, // nobody has looked at its source yet
    Ready,     // its source is sound, and runs or may
    Refused,   // its source is not; what runs was good, if anything does
};

class ShaderReloader {
public:
    // Errors: BadInput, for a folder that is none, cannot be watched or has none of the kernels.
    static Result<std::unique_ptr<ShaderReloader>> start(Device& device, ReloadOptions options);
    virtual ~ShaderReloader() = default; // waits for what is being compiled

    // Kernels of this library, which is of the same device and made with the same modules, follow their sources from now on,
    // beginning with the folder as it is. It has to be detached, or the reloader destroyed, before the library is.
    virtual void attach(KernelLibrary& library) = 0;
    virtual void detach(KernelLibrary& library) = 0;

    // Between two frames, while nobody records with kernels of what is attached: takes over what is ready, waits for nothing,
    // and tells what has happened since it was called last.
    virtual std::vector<ReloadEvent> swap() = 0;

    // For those who would sleep until the next frame: ends sooner where swap() has something to do or to tell. Whether it has.
    virtual bool waitUntil(std::chrono::steady_clock::time_point time) = 0;

    // Nothing that it knows of is still to be compiled or to be taken over.
    virtual bool isIdle() const = 0;
    // Something that runs is on its way. Who steps on the cores that compile it may leave it more of them meanwhile.
    virtual bool isAwaited() const = 0;
    virtual KernelState stateOf(std::string_view kernel) const = 0;
};

// Whether kernels that run have been replaced, so that recordings have to be made anew.
bool somethingRuns(std::span<const ReloadEvent> events);

} // namespace engine
