// brittle plan as its users meet it: exactly the effects that a scene calls for, and what they cost.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>

namespace {

using nlohmann::json;
using support::Outcome;
using support::runProgram;

class PlanCli : public support::FolderTest {
protected:
    std::string scene(const std::string& effects) {
        std::ofstream(path("scene.toml")) << "name = \"two\"\neffects = " << effects
                                          << "\n[[body]]\nplace = [0, 1, 0]\nrestitution = 0.5\n[[collider]]\n";
        return path("scene.toml");
    }
    json planOf(const std::string& effects, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"plan", scene(effects), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return json::parse(run.out);
    }
    static std::set<std::string> namesOf(const json& effects) {
        std::set<std::string> names;
        for (const json& effect : effects)
            names.insert(effect["name"].get<std::string>());
        return names;
    }
    static bool hasPass(const json& plan, const std::string& kernel) {
        return std::ranges::any_of(plan["passes"], [&](const json& pass) { return pass["kernel"] == kernel; });
    }
};

TEST_F(PlanCli, ListsExactlyWhatTheSceneCallsForAndWhatThatNeeds) {
    const json plan = planOf(R"(["gravity", "friction"])");
    EXPECT_EQ(namesOf(plan["effects"]), (std::set<std::string>{"gravity", "friction", "contacts", "ccd"}));
    EXPECT_EQ(plan["effects"][2], (json{{"name", "contacts"}, {"called_by", "friction"}}));
    EXPECT_EQ(plan["effects"][3], (json{{"name", "ccd"}, {"called_by", "contacts"}}));
    for (const json& buffer : plan["buffers"]) {
        const std::string asked_by = buffer["asked_by"];
        const bool is_on = asked_by == "every world" || namesOf(plan["effects"]).contains(asked_by);
        EXPECT_EQ(buffer["bytes"] != 0, is_on) << buffer;
    }
    EXPECT_TRUE(hasPass(plan, "hold_back"));
    EXPECT_FALSE(hasPass(plan, "time_rest"));
}

TEST_F(PlanCli, WhatIsOffIsNotThere) {
    const json flying = planOf(R"(["gravity"])");
    EXPECT_EQ(flying["kernels"], (json{"begin_step", "end_step", "move_bodies", "open_step", "push_bodies"}));
    const json bouncing = planOf(R"(["restitution"])"), sleeping = planOf(R"(["sleeping"])");
    const auto bounces = [](const json& plan) { return plan["kernels"].dump().find("bounce_") != std::string::npos; };
    EXPECT_TRUE(bounces(bouncing));
    EXPECT_FALSE(bounces(sleeping));
    EXPECT_TRUE(hasPass(sleeping, "time_rest"));
    EXPECT_EQ(bouncing["bytes"]["restitution"], 0);
    EXPECT_GT(sleeping["bytes"]["sleeping"], 0);
}

TEST_F(PlanCli, ConstantsAndPassesSayHowTheyAreDispatched) {
    const json plan = planOf(R"(["contacts", "drag"])");
    const json& first = plan["passes"][1];
    EXPECT_EQ(first["kernel"], "open_step");
    EXPECT_EQ(first["size"], "groups");
    EXPECT_EQ(first["count"], 1);
    const json& begin = plan["passes"][2];
    EXPECT_EQ(begin["stage"], "boxes");
    EXPECT_EQ(begin["size"], "a lane each");
    EXPECT_EQ(begin["counted_by"], "bodies");
    EXPECT_EQ(begin["constants"]["kCcd"], 1);
    EXPECT_NE(begin["constants"]["kDrag"], 0);
    EXPECT_EQ(begin["constants"]["group_size"], 64);
    EXPECT_EQ(begin["buffers"][1], (json{{"slot", "bodies"}, {"buffer", "bodies"}, {"access", "reads"}}));
    const json still = planOf(R"(["gravity"])");
    EXPECT_EQ(still["passes"][2]["constants"]["kDrag"], 0);
    EXPECT_EQ(still["passes"][2]["constants"]["kCcd"], 0);
}

TEST_F(PlanCli, IsTheSameTwiceAndAddsUp) {
    const json plan = planOf(R"(["gravity", "contacts", "friction", "sleeping"])");
    EXPECT_EQ(plan, planOf(R"(["gravity", "contacts", "friction", "sleeping"])"));
    uint64_t sum = 0, of_effects = 0;
    for (const json& buffer : plan["buffers"])
        sum += buffer["bytes"].get<uint64_t>();
    for (const auto& [name, bytes] : plan["bytes"].items())
        of_effects += name == "sum" ? 0 : bytes.get<uint64_t>();
    EXPECT_EQ(plan["bytes"]["sum"], sum);
    EXPECT_EQ(of_effects, sum);
}

TEST_F(PlanCli, MeasuresWhereItIsAskedTo) {
    const json plain = planOf(R"(["gravity", "contacts"])"), measured = planOf(R"(["gravity", "contacts"])", {"--measure"});
    for (const json& pass : plain["passes"])
        EXPECT_FALSE(pass.contains("us"));
    for (const json& pass : measured["passes"])
        EXPECT_EQ(pass.contains("us"), pass["kernel"] != "fill" && pass["kernel"] != "copy") << pass;
}

json without(const std::string& kernel, json plan) {
    std::erase_if(plan["passes"].get_ref<json::array_t&>(), [&](const json& pass) { return pass["kernel"] == kernel; });
    std::erase(plan["kernels"].get_ref<json::array_t&>(), json(kernel));
    return plan;
}

TEST_F(PlanCli, HasTheSamePassesWhateverThePatternThatBodiesBreakIn) {
    std::vector<json> plans;
    for (const char* pattern : {"impact", "paper", "radial"}) {
        std::ofstream(path("pattern.toml")) << "name = \"pane\"\neffects = [\"impact_fracture\"]\n[[body]]\nshape = \"box\"\n"
                                               "size = [1, 1, 0.01]\nmaterial = \"glass\"\nbreak_pattern = \""
                                            << pattern << "\"\n";
        const Outcome run = runProgram("brittle", {"plan", path("pattern.toml"), "--json"});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        plans.push_back(json::parse(run.out));
    }
    EXPECT_TRUE(hasPass(plans[0], "place_breaking"));
    EXPECT_EQ(plans[1], plans[0]);
    EXPECT_FALSE(hasPass(plans[0], "measure_reach"));
    EXPECT_TRUE(hasPass(plans[2], "measure_reach")) << "how far it is to the rim, along rays";
    EXPECT_EQ(without("measure_reach", plans[2]), plans[0]);
}

TEST_F(PlanCli, TellsPeopleTheSame) {
    const Outcome run = runProgram("brittle", {"plan", scene(R"(["friction", "dust"])"), "--measure"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    for (const char* line : {"contacts (called for by friction)", "impact_fracture (called for by dust)", "push_bodies",
                             "solver_bodies", " us\n", "in all"})
        EXPECT_NE(run.out.find(line), std::string::npos) << line << "\n" << run.out;
}

TEST_F(PlanCli, RefusesWhatIsNotThereYetAndWhatIsNone) {
    for (const auto& [effects, why] : std::vector<std::pair<std::string, std::string>>{
             {R"(["bonds"])", "the effect 'bonds' has a place and is not there yet; leave it out"},
             {R"(["frction"])", "did you mean 'friction'?"}}) {
        const Outcome run = runProgram("brittle", {"plan", scene(effects)});
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

} // namespace
