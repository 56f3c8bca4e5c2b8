// brittle scenes: the built-in scenes, the keys of scene files, and whether a scene file is sound.
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/scene_file.h"
#include "modules/brittle/scene/scene_keys.h"
#include "tools/brittle/command.h"
#include "tools/brittle/example_files.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/scene_files.h"
#include "tools/brittle/scene_source.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace cli {
namespace {

struct ScenesOptions {
    std::string scene, output;
    bool keys = false;
    bool as_json = false;
};

std::string summaryOf(const brittle::SceneDescription& scene) { return scene.comment.substr(0, scene.comment.find('\n')); }

nlohmann::ordered_json jsonOf(const brittle::SceneDescription& scene) {
    const brittle::SceneCounts counts = brittle::countsOf(scene);
    return {{"name", scene.name},        {"bodies", counts.bodies},  {"pieces", counts.pieces}, {"colliders", counts.colliders},
            {"steps", scene.step.steps}, {"effects", scene.effects}, {"comment", scene.comment}};
}

void printRow(const brittle::SceneDescription& scene) {
    const brittle::SceneCounts counts = brittle::countsOf(scene);
    std::printf("%-28s %6llu %9llu %6u  %s\n", scene.name.c_str(), static_cast<unsigned long long>(counts.bodies),
                static_cast<unsigned long long>(counts.colliders), scene.step.steps, summaryOf(scene).c_str());
}

// Examples first: their names are what people look for.
std::vector<brittle::SceneDescription> allScenes() {
    std::vector<brittle::SceneDescription> scenes;
    for (const std::filesystem::path& file : exampleFiles(".toml"))
        if (auto scene = brittle::readScene(file)) scenes.push_back(std::move(*scene));
    for (const brittle::SceneEntry& entry : brittle::builtinScenes())
        if (auto scene = brittle::makeBuiltinScene(entry.name)) scenes.push_back(std::move(*scene));
    return scenes;
}

void printList(bool as_json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    if (!as_json) std::printf("%-28s %6s %9s %6s\n", "name", "bodies", "colliders", "steps");
    for (const brittle::SceneDescription& scene : allScenes())
        if (as_json)
            list.push_back(jsonOf(scene));
        else
            printRow(scene);
    if (as_json)
        std::printf("%s\n", list.dump(2).c_str());
    else
        std::printf("\nAlso hull_pile_N and stack_N, N up to 100000 and to 1000. brittle scenes NAME prints one as a file.\n");
}

engine::Result<void> write(const std::string& path, const std::string& text) {
    auto file = createOutput(path);
    if (!file) return file.error();
    if (auto written = file->write(text); !written) return written;
    return file->commit();
}

bool hasNoFile(const brittle::ShapeDescription& shape) { return shape.model != nullptr && shape.file.empty(); }

// A scene file names models by their files, and some built-in scenes make theirs.
engine::Result<void> checkHasFiles(const brittle::SceneDescription& scene) {
    const auto refused = [&](const std::string& what, const std::string& name) {
        return engine::Error{engine::ErrorCode::BadInput,
                             scene.name + ": the mesh of " + what + " '" + name +
                                 "' is made by the program, so a scene file cannot hold it; --json describes the scene"};
    };
    for (const brittle::BodyDescription& body : scene.bodies)
        if (hasNoFile(body.shape)) return refused("body", body.name);
    for (const brittle::ColliderDescription& collider : scene.colliders)
        if (hasNoFile(collider.shape)) return refused("collider", collider.name);
    return {};
}

int showScene(const ScenesOptions& options) {
    const auto scene = readSceneOrBuiltin(options.scene);
    if (!scene) return fail(scene.error());
    if (auto held = checkHasFiles(*scene); !held && !options.as_json) return fail(held.error());
    const std::string text = options.as_json ? jsonOf(*scene).dump(2) + "\n" : brittle::writeScene(*scene);
    if (options.output.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return kOk;
    }
    if (auto apart = checkIsNoInput(options.output, filesOfScene(options.scene, *scene)); !apart) return fail(apart.error());
    const auto written = write(options.output, text);
    return written ? kOk : fail(written.error());
}

int runScenes(const ScenesOptions& options) {
    if (options.keys) {
        std::printf("%s", brittle::sceneKeyHelp().c_str());
        return kOk;
    }
    if (!options.scene.empty()) return showScene(options);
    if (!options.output.empty())
        return fail({engine::ErrorCode::BadInput, "--output needs a scene to write; brittle scenes lists them"});
    printList(options.as_json);
    return kOk;
}

} // namespace

void addScenes(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("scenes", "List the scenes that come with the program, check a scene file, explain its keys.");
    command->footer("Examples:\n  brittle scenes\n  brittle scenes card_house -o house.toml\n  brittle scenes house.toml\n"
                    "  brittle scenes --keys");
    auto options = std::make_shared<ScenesOptions>();
    command->add_option("SCENE", options->scene, "a built-in scene, an example, or a .toml file to check; printed as TOML");
    command->add_option("-o,--output", options->output, "write it to this file instead");
    command->add_flag("--keys", options->keys, "explain every key of scene files");
    command->add_flag("--json", options->as_json, "print JSON: names, comments and counts");
    command->callback([options, &exit_code] { exit_code = runScenes(*options); });
}

} // namespace cli
