// brittle scenes as its users meet it: the list, a scene as a file and back, a bad file refused in one line.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

using support::fileBytes;
using support::Outcome;
using support::runProgram;

class ScenesCli : public support::FolderTest {
protected:
    static void expectOneLine(const Outcome& run, const std::string& holds) {
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
    }
};

TEST_F(ScenesCli, ListsWhatThereIsWithCounts) {
    const Outcome text = runProgram("brittle", {"scenes"});
    ASSERT_EQ(text.exit_code, 0) << text.err;
    const Outcome json = runProgram("brittle", {"scenes", "--json"});
    ASSERT_EQ(json.exit_code, 0) << json.err;
    const nlohmann::json list = nlohmann::json::parse(json.out);
    ASSERT_GT(list.size(), 50u);
    for (const nlohmann::json& scene : list)
        EXPECT_NE(text.out.find(scene["name"].get<std::string>()), std::string::npos) << scene["name"];
    const auto block =
        std::find_if(list.begin(), list.end(), [](const auto& scene) { return scene["name"] == "hard_01_block_500"; });
    ASSERT_NE(block, list.end());
    EXPECT_EQ((*block)["bodies"], 500);
    EXPECT_EQ((*block)["steps"], 300);
}

TEST_F(ScenesCli, ASceneIsAFileAndBack) {
    ASSERT_EQ(runProgram("brittle", {"scenes", "card_house", "-o", path("house.toml")}).exit_code, 0);
    const Outcome again = runProgram("brittle", {"scenes", path("house.toml")});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, fileBytes(path("house.toml")));
    EXPECT_NE(again.out.find("[[body]]"), std::string::npos);
}

TEST_F(ScenesCli, RefusesWhatIsWrongInOneLine) {
    std::ofstream(path("bad.toml")) << "[[body]]\nfricton = 1\n";
    expectOneLine(runProgram("brittle", {"scenes", path("bad.toml")}),
                  "bad.toml:2: unknown key 'fricton', did you mean 'friction'?");
    expectOneLine(runProgram("brittle", {"scenes", "card_hous"}), "did you mean 'card_house'?");
    expectOneLine(runProgram("brittle", {"scenes", path("none.toml")}), "none.toml: no such file");
    expectOneLine(runProgram("brittle", {"scenes", "-o", path("a.toml")}), "--output needs a scene");
    EXPECT_FALSE(std::filesystem::exists(path("a.toml")));
}

TEST_F(ScenesCli, RefusesASceneThatAFileCannotHold) {
    expectOneLine(runProgram("brittle", {"scenes", "hard_36_slide_sheet", "-o", path("a.toml")}),
                  "a scene file cannot hold it");
    EXPECT_FALSE(std::filesystem::exists(path("a.toml")));
    EXPECT_EQ(runProgram("brittle", {"scenes", "hard_36_slide_sheet", "--json"}).exit_code, 0);
}

TEST_F(ScenesCli, DoesNotWriteOverWhatItReads) {
    ASSERT_EQ(runProgram("brittle", {"scenes", "bounce", "-o", path("b.toml")}).exit_code, 0);
    const std::string before = fileBytes(path("b.toml"));
    expectOneLine(runProgram("brittle", {"scenes", path("b.toml"), "-o", path("b.toml")}), "would be overwritten");
    EXPECT_EQ(fileBytes(path("b.toml")), before);
}

TEST_F(ScenesCli, ExplainsEveryKey) {
    const Outcome run = runProgram("brittle", {"scenes", "--keys"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* key : {"gravity", "substeps", "pairs", "field_of_view", "restitution", "sites", "[[collider]]"})
        EXPECT_NE(run.out.find(key), std::string::npos) << key;
}

} // namespace
