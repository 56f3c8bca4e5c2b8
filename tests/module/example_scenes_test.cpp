// The scenes in modules/brittle/scene/examples: each says which effects it calls for, and breaks what it says, with nothing
// lost and nothing flying off.
#include "modules/brittle/scene/scene_file.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;

constexpr uint32_t kSecond = 60; // steps

fs::path examplesFolder() { return support::sourceFolder() / "modules" / "brittle" / "scene" / "examples"; }

std::vector<fs::path> examples() {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(examplesFolder()))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

// The names in the comment that a file begins with, each in a line "#   NAME  why"; one without a reason does not count.
std::vector<std::string> effectsInHeader(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::vector<std::string> names;
    if (!std::getline(lines, line) || line != "# Effects:") return names;
    while (std::getline(lines, line) && line.starts_with("#   ")) {
        std::istringstream words(line.substr(1));
        std::string name, why;
        if (words >> name >> why) names.push_back(name);
    }
    return names;
}

// With its models found from anywhere.
brittle::SceneDescription example(const fs::path& file) {
    auto scene = brittle::readScene(file);
    if (!scene) ADD_FAILURE() << scene.error().message;
    if (!scene) return {};
    for (brittle::BodyDescription& body : scene->bodies)
        if (!body.shape.file.empty()) body.shape.file = (file.parent_path() / body.shape.file).string();
    return *scene;
}

bool isAbsent(const gpu::BodyState& body) { return (body.sector.w & BODY_ABSENT) != 0; }

// kg, of cells that were too small to be bodies, since this was last asked for.
double dustOf(support::SceneRun& run) {
    const auto breaks = run.world().breaks();
    if (!breaks) ADD_FAILURE() << breaks.error().message;
    double mass = 0;
    for (const gpu::BreakEvent& event : breaks->events)
        mass += event.offset.w;
    return mass;
}

// What happened to a scene, watched step by step.
struct Story {
    std::set<std::string> broken; // bodies of the scene that are no more
    std::set<uint32_t> when;      // steps in which they broke
    size_t bodies = 0;            // that move, in the end
    double mass_error = 0;        // the worst, relative
    double before = 0, since = 0; // m/s, the fastest until something broke, and after that
};

double massOf(const support::SceneRun& run) {
    double mass = 0;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        if (run.moves(b) && !isAbsent(run.state(b))) mass += 1.0 / run.state(b).offset.w;
    return mass;
}

void lookForBroken(const support::SceneRun& run, uint32_t step, Story& story) {
    const auto& bodies = run.scene().bodies;
    for (size_t b = 0; b < bodies.size(); ++b)
        if (isAbsent(run.state(b)) && story.broken.insert(bodies[b].name).second) story.when.insert(step);
}

Story watch(brittle::SceneDescription scene, uint32_t steps) {
    if (std::ranges::count(scene.effects, "events") == 0) scene.effects.emplace_back("events");
    support::SceneRun run(scene);
    Story story;
    run.step(1);
    const double mass = massOf(run);
    double dust = 0;
    for (uint32_t step = 2; step <= steps; ++step) {
        run.step(1);
        lookForBroken(run, step, story);
        dust += dustOf(run);
        const bool is_all_there = run.world().counts()->expired == 0;
        if (is_all_there) story.mass_error = std::max(story.mass_error, std::abs((massOf(run) + dust) / mass - 1));
        double& fastest = story.broken.empty() ? story.before : story.since;
        fastest = std::max(fastest, run.fastest());
    }
    for (size_t b = 0; b < run.bodyCount(); ++b)
        story.bodies += run.moves(b) && !isAbsent(run.state(b)) ? 1 : 0;
    EXPECT_TRUE(run.isFinite());
    return story;
}

TEST(SmallExampleScenes, EachSaysWhichEffectsItCallsForAndWhy) {
    const std::string readme = support::fileBytes((support::sourceFolder() / "README.md").string());
    ASSERT_GE(examples().size(), 6u);
    for (const fs::path& file : examples()) {
        SCOPED_TRACE(file.filename());
        const brittle::SceneDescription scene = example(file);
        EXPECT_EQ(scene.name, file.stem());
        EXPECT_FALSE(scene.comment.empty());
        EXPECT_EQ(effectsInHeader(support::fileBytes(file.string())), scene.effects);
        EXPECT_NE(readme.find("| `" + file.stem().string() + "` |"), std::string::npos) << "is not in README.md";
    }
}

TEST(SmallExampleScenes, AnEffectWithoutAReasonIsNotSaid) {
    const std::vector<std::string> said = {"gravity", "contacts"};
    EXPECT_EQ(effectsInHeader("# Effects:\n#   gravity  falls\n#   contacts  meets\nname = \"a\"\n"), said);
    EXPECT_NE(effectsInHeader("# Effects:\n#   gravity  falls\n#   contacts\nname = \"a\"\n"), said);
    EXPECT_TRUE(effectsInHeader("name = \"a\"\n#   gravity  falls\n").empty());
}

struct Promise {
    std::string scene;
    std::set<std::string> broken;
    size_t least = 0, most = 0; // bodies that move in the end
    size_t steps = 1;           // in which something breaks, where anything does
};

const std::vector<Promise>& promises() {
    static const std::vector<Promise> kPromises = {
        {"window_pane", {"pane"}, 60, 140},
        {"dropped_vase", {"vase"}, 40, 140},
        {"wrecking_ball", {"block"}, 15, 80},
        {"ice_block", {"block"}, 25, 100},
        {"ten_at_once",
         {"tile of glass", "plate of porcelain", "tile of porcelain", "brick", "half brick", "ball of brick", "ball of stone",
          "cube of stone", "cube of concrete", "ball of concrete"},
         150,
         400},
        {"quiet_shelf", {}, 8, 8},
        {"crumbling_wall", {"left block", "middle block", "right block"}, 0, 200, 3},
    };
    return kPromises;
}

void expectKept(const Promise& promise, const Story& story) {
    EXPECT_EQ(story.broken, promise.broken);
    EXPECT_EQ(story.when.size(), promise.broken.empty() ? 0u : promise.steps);
    EXPECT_GE(story.bodies, promise.least);
    EXPECT_LE(story.bodies, promise.most);
    EXPECT_LT(story.mass_error, 1e-6);
}

TEST(QuickExampleScenes, BreakWhatTheySayInTheirFirstSecond) {
    ASSERT_EQ(promises().size(), examples().size());
    for (const Promise& promise : promises()) {
        SCOPED_TRACE(promise.scene);
        const Story story = watch(example(examplesFolder() / (promise.scene + ".toml")), kSecond);
        expectKept(promise, story);
        EXPECT_LE(story.since, 2 * story.before);
    }
}

TEST(LongExampleScenes, KeepTheirPromisesToTheEnd) {
    for (const Promise& promise : promises()) {
        SCOPED_TRACE(promise.scene);
        const auto scene = example(examplesFolder() / (promise.scene + ".toml"));
        const Story story = watch(scene, scene.step.steps);
        expectKept(promise, story);
        EXPECT_LE(story.since, 2 * story.before) << "speed of the fastest splinter";
    }
}

} // namespace
