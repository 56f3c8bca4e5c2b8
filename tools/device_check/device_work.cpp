#include "tools/device_check/device_work.h"

#include "modules/brittle/fracture/fingerprint.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tools/brittle/model.h"
#include "tools/brittle/scene_source.h"
#include "tools/brittle/simulation.h"
#include "tools/device_check/results.h"

#include <algorithm>
#include <cstdio>

namespace device_check {
namespace {

// Piles of thousands are the bench's.
constexpr size_t kMostBodies = 300;
constexpr double kIdleSeconds = 2;

void print(const Json& line) {
    std::printf("%s\n", textOf(line).c_str());
    std::fflush(stdout);
}

struct CheckedModel {
    brittle::PreparedMesh mesh;
    brittle::MeshReport report;
};

engine::Result<CheckedModel> readModel(const std::string& path) {
    auto model = cli::loadModel(path, /*repair=*/false);
    if (!model) return model.error();
    brittle::MeshReport report = brittle::inspectMesh(model->model.mesh, model->model.topology);
    if (!report.isSound()) return engine::Error{engine::ErrorCode::BadInput, report.problems.front()};
    return CheckedModel{std::move(model->model), std::move(report)};
}

engine::Result<Json> breakModel(brittle::Fracture& fracture, const CheckedModel& model, uint32_t sites) {
    brittle::FractureOptions options;
    options.site_count = sites;
    const auto broken = fracture.shatter(model.mesh.mesh, model.mesh.topology, options);
    if (!broken) return broken.error();
    const brittle::Fingerprint print = brittle::fingerprintOf(broken->fragments);
    const auto contract = brittle::verifyContract(model.mesh.mesh, model.report.measures, broken->fragments, broken->sites);
    return Json{{"fragments", broken->fragments.fragments.size()},
                {"topology", cli::hexOf(print.topology)},
                {"positions", cli::hexOf(print.positions)},
                {"attributes", cli::hexOf(print.attributes)},
                {"masses", cli::hexOf(print.masses)},
                {"violation", contract.violation()},
                {"ms", broken->total_ms}};
}

void fingerprintModel(brittle::Fracture& fracture, const std::string& name, const std::string& path) {
    const auto model = readModel(path);
    for (const uint32_t sites : kSiteCounts) {
        Json line = {{"model", name}, {"sites", sites}};
        const auto broken = model ? breakModel(fracture, *model, sites) : engine::Result<Json>(model.error());
        if (broken)
            line.update(*broken);
        else
            line["error"] = broken.error().message;
        print(line);
    }
}

std::vector<std::string> sceneNames(const Kit& kit) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(kit.examples(), none))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().string());
    std::ranges::sort(names);
    for (const brittle::SceneEntry& entry : brittle::builtinScenes())
        names.push_back(entry.name);
    if (const auto wanted = kit.scenes(); !wanted.empty())
        std::erase_if(names, [&](const std::string& name) {
            return std::ranges::find(wanted, std::filesystem::path(name).stem().string()) == wanted.end();
        });
    return names;
}

engine::Result<cli::SimulationReport> simulateOnce(engine::Device& device, const brittle::SceneDescription& scene,
                                                   const std::string& name, double seconds) {
    auto staged = cli::stageScene(device, scene, {.source = name});
    if (!staged) return staged.error();
    return cli::simulate(device, *staged, seconds, 0, nullptr);
}

Json toJson(const std::string& name, double seconds, const cli::SimulationReport& first, const cli::SimulationReport& second) {
    return {{"scene", name},
            {"seconds", seconds},
            {"hashes", {cli::hexOf(first.state_hash), cli::hexOf(second.state_hash)}},
            {"bodies", first.movers},
            {"fragments", first.counts.fragments},
            {"kinetic_energy", first.kinetic_energy},
            {"median_ms", second.median_ms},
            {"p99_ms", second.p99_ms}};
}

Json sceneLine(engine::Device& device, const std::string& name, const brittle::SceneDescription& scene, double seconds,
               bool once) {
    const std::string shown = std::filesystem::path(name).stem().string();
    const auto first = simulateOnce(device, scene, name, seconds);
    const auto second = first && !once ? simulateOnce(device, scene, name, seconds) : first;
    return second ? toJson(shown, seconds, *first, *second) : Json{{"scene", shown}, {"error", second.error().message}};
}

void keepWhole(brittle::SceneDescription& scene) {
    std::erase_if(scene.effects,
                  [](const std::string& effect) { return effect == "impact_fracture" || effect == "refracture"; });
}

Json idleLine(bool breaks, const cli::SimulationReport& report) {
    Json stages = Json::object();
    for (const auto& [stage, share] : report.shares)
        stages[stage] = share;
    return {{"breaking", breaks},
            {"median_ms", report.median_ms},
            {"p99_ms", report.p99_ms},
            {"dispatches", report.dispatches},
            {"stages", stages}};
}

} // namespace

void fingerprintModels(engine::Device& device, const Kit& kit) {
    auto fracture = brittle::Fracture::create(device);
    if (!fracture) return print({{"error", fracture.error().message}});
    print({{"of", kit.models().size() * std::size(kSiteCounts)}});
    for (const auto& [name, path] : kit.models())
        fingerprintModel(**fracture, name, path);
}

void simulateScenes(engine::Device& device, const Kit& kit, double seconds, bool once) {
    std::vector<std::pair<std::string, engine::Result<brittle::SceneDescription>>> scenes;
    for (const std::string& name : sceneNames(kit)) {
        auto scene = cli::readSceneOrBuiltin(name);
        if (!scene || scene->bodies.size() <= kMostBodies) scenes.emplace_back(name, std::move(scene));
    }
    print({{"of", scenes.size()}});
    for (const auto& [name, scene] : scenes) {
        if (scene)
            print(sceneLine(device, name, *scene, seconds, once));
        else
            print({{"scene", name}, {"error", scene.error().message}});
    }
}

void measureIdleSteps(engine::Device& device, const Kit& kit) {
    const std::string name = kit.example("quiet_shelf").string();
    print({{"of", 2}});
    for (const bool breaks : {true, false}) {
        auto scene = cli::readSceneOrBuiltin(name);
        if (!scene) return print({{"error", scene.error().message}});
        if (!breaks) keepWhole(*scene);
        const auto report = simulateOnce(device, *scene, name, kIdleSeconds);
        print(report ? idleLine(breaks, *report) : Json{{"breaking", breaks}, {"error", report.error().message}});
    }
}

} // namespace device_check
