// The folder that a check works from: programs, meshes, scenes and what they should give.
//
//     bin/        brittle and the test programs
//     source/     files that tests and scenes read, laid out as in the source tree
//     modules/    modules that the engine's tests load
//     meshes/     models that are broken; meshes.txt lists them
//     recordings/ motion of scenes on a known device
//     expected.json   fingerprints of their fragments, and states of scenes, on a device that is known
//     layer/      the validation layer, if it was packed
#pragma once

#include "tools/device_check/child_process.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace device_check {

using Json = nlohmann::ordered_json;

class Kit {
public:
    // `launcher`: words that go before each program's path, such as a dynamic loader and its options; may be empty.
    // `cache`: a folder for the compiled kernels that drivers keep; may be empty.
    Kit(std::filesystem::path folder, std::vector<std::string> launcher, std::string device, std::filesystem::path cache = {})
        : folder_(std::move(folder)), launcher_(std::move(launcher)), device_(std::move(device)), cache_(std::move(cache)) {}

    bool hasProgram(const std::string& name) const { return std::filesystem::exists(folder_ / "bin" / name); }
    // A program of bin/ with these arguments, on the device that was asked for.
    ChildCommand command(const std::string& program, const std::vector<std::string>& arguments, Clock::time_point until) const;

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    // The folder of the example scenes, and one of them by its name.
    std::filesystem::path examples() const { return folder_ / "source/modules/brittle/scene/examples"; }
    std::filesystem::path example(const std::string& scene) const { return examples() / (scene + ".toml"); }
    // Names of the models in meshes.txt, and their paths or builtin:NAME. Files may be missing.
    std::vector<std::pair<std::string, std::string>> models() const;
    // Recordings of motion on a known device, SCENE.motion (brittle compare --record).
    std::vector<std::filesystem::path> recordings() const;
    // Names in scenes.txt, one per line; empty if there is no such file: all scenes.
    std::vector<std::string> scenes() const;
    // Returns the outcome on a known device. If the file is missing or damaged, returns null and says so in `problem`.
    Json expected(std::string& problem) const;

private:
    std::filesystem::path folder_;
    std::vector<std::string> launcher_;
    std::string device_;
    std::filesystem::path cache_;
};

} // namespace device_check
