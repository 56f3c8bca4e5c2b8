// shader_reload: runs a scene while its kernels are edited, or checks all of them once. A thin tool over engine/reload.
#include "tools/brittle/command.h"
#include "tools/brittle/driver_threads.h"
#include "tools/brittle/progress.h"
#include "tools/brittle/scene_source.h"
#include "tools/shader_reload/check_once.h"
#include "tools/shader_reload/live_scene.h"

#include <cstdio>

namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  shader_reload shaders-spirv\n"
    "  shader_reload --scene card_house shaders-spirv\n"
    "  shader_reload --scene house.toml --window shaders-spirv\n"
    "  shader_reload --once shaders-spirv\n"
    "\n"
    "Mistakes are printed as FILE:LINE:COLUMN: error: MESSAGE, without what the compiler does not tell. What is not fit leaves "
    "the last good version running.\n"
    "Exit codes: 0 done and, with --once, all sound; 2 bad usage, bad input or kernels that are not fit; 3 too large for a "
    "pool;\n"
    "4 no device; 1 a bug of ours.";

int fail(const engine::Error& error) {
    cli::clearProgress();
    std::fprintf(stderr, "shader_reload: %s\n", error.message.c_str());
    switch (error.code) {
    case engine::ErrorCode::BadInput: return cli::kBadInput;
    case engine::ErrorCode::Capacity: return cli::kCapacity;
    case engine::ErrorCode::Device:
    case engine::ErrorCode::Feature: return cli::kDeviceError;
    case engine::ErrorCode::Internal: break;
    }
    return cli::kInternalError;
}

int run(const shader_reload::Options& options) {
    if (options.once) {
        const auto sound = shader_reload::checkOnce(options);
        return !sound ? fail(sound.error()) : *sound ? cli::kOk : cli::kBadInput;
    }
    const auto done = shader_reload::runLive(options);
    return done ? cli::kOk : fail(done.error());
}

} // namespace

int main(int argc, char** argv) {
    cli::spreadDriverThreads();
    CLI::App app{
        "Runs a scene while its kernels are edited: what is saved is compiled, checked and put in place between two steps.",
        "shader_reload"};
    app.footer(kFooter);
    shader_reload::Options options;
    app.add_option("DIR", options.folder, "the folder with the kernels' sources, such as shaders-spirv")->required();
    auto* scene = app.add_option("--scene", options.scene, cli::kSceneHelp)->capture_default_str();
    auto* window = app.add_flag("--window", options.window, "show the scene in a window");
    auto* steps = app.add_option("--steps", options.steps, "end after so many; else the scene begins anew where it ends");
    auto* device = app.add_option("--device", options.device, "a part of its name, or its index; see brittle devices");
    app.add_option("-I,--include", options.include_folders, "where includes are looked for, instead of DIR")
        ->allow_extra_args(false);
    app.add_flag("--once", options.once, "compile and check every kernel of DIR, run nothing, and end")
        ->excludes(scene)
        ->excludes(window)
        ->excludes(steps)
        ->excludes(device);
    try {
        app.parse(argc, argv);
        const int code = run(options);
        if (std::fflush(stdout) != 0) return fail({engine::ErrorCode::BadInput, "the output cannot be written"});
        return code;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        return fail({engine::ErrorCode::BadInput, std::string(error.what()) + "; see shader_reload --help"});
    } catch (const std::exception& error) {
        return fail({engine::ErrorCode::Internal, error.what()});
    }
}
