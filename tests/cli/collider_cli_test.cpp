// Colliders as users of the program meet them: only where asked for, reported, in the file, drawn.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace {

using support::fileBytes;
using support::runProgram;

class ColliderCli : public support::FolderTest {
protected:
    support::Outcome shatter(const std::string& output, std::vector<std::string> more,
                             const std::vector<std::string>& environment = {}) {
        std::vector<std::string> arguments = {"shatter", "builtin:ring", "-o", path(output), "--sites", "30", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram("brittle", arguments, environment);
    }
    // The document of a GLB: behind the file's header and the chunk's.
    nlohmann::json document(const std::string& name) const {
        const std::string bytes = fileBytes(path(name));
        EXPECT_GT(bytes.size(), 20u);
        uint32_t length = 0;
        std::copy_n(bytes.data() + 12, 4, reinterpret_cast<char*>(&length));
        return nlohmann::json::parse(bytes.substr(20, length));
    }
};

TEST_F(ColliderCli, ReportsWhatItMade) {
    const auto run = shatter("a.glb", {"--collider", "26"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    const nlohmann::json& colliders = report["colliders"];
    EXPECT_EQ(colliders["pieces"], report["fragments"]);
    EXPECT_GE(colliders["planes"].get<int>(), 4 * report["fragments"].get<int>());
    EXPECT_GT(colliders["volume_excess"].get<double>(), 0);
    EXPECT_LT(colliders["volume_excess"].get<double>(), 1);
    EXPECT_EQ(colliders["overlapping_pairs"], nlohmann::json::array());
    EXPECT_EQ(colliders["may_reach_out"], 0);
}

TEST_F(ColliderCli, MakesNoneUnlessAsked) {
    ASSERT_EQ(shatter("plain.glb", {}).exit_code, 0);
    const auto run = shatter("none.glb", {"--collider", "none"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_FALSE(nlohmann::json::parse(run.out).contains("colliders"));
    EXPECT_EQ(fileBytes(path("plain.glb")), fileBytes(path("none.glb")));
    EXPECT_EQ(fileBytes(path("plain.glb")).find("collider"), std::string::npos);
}

TEST_F(ColliderCli, WritesEachAsAChildOfItsFragment) {
    ASSERT_EQ(shatter("a.glb", {"--collider", "14"}).exit_code, 0);
    const nlohmann::json glb = document("a.glb");
    const size_t fragments = glb["scenes"][0]["nodes"].size();
    ASSERT_EQ(glb["nodes"].size(), 2 * fragments);
    for (size_t f = 0; f < fragments; ++f) {
        ASSERT_EQ(glb["nodes"][f]["children"].size(), 1u);
        const nlohmann::json& child = glb["nodes"][glb["nodes"][f]["children"][0].get<size_t>()];
        EXPECT_EQ(child["extras"]["collider"], f);
        EXPECT_GE(child["extras"]["volume"].get<double>(), .999999 * glb["nodes"][f]["extras"]["volume"].get<double>());
        const nlohmann::json& primitive = glb["meshes"][child["mesh"].get<size_t>()]["primitives"][0];
        EXPECT_EQ(glb["materials"][primitive["material"].get<size_t>()]["name"], "collider");
    }
}

TEST_F(ColliderCli, AreTheSameForAnyNumberOfThreads) {
    for (const char* threads : {"0", "1", "2"})
        ASSERT_EQ(shatter(threads, {"--collider", "62"}, {std::string("LP_NUM_THREADS=") + threads}).exit_code, 0);
    EXPECT_EQ(fileBytes(path("0")), fileBytes(path("2")));
    EXPECT_EQ(fileBytes(path("1")), fileBytes(path("2")));
}

TEST_F(ColliderCli, AreDrawnIntoAFileOfTheirOwn) {
    ASSERT_EQ(shatter("a.glb", {"--collider", "6", "--collider-picture", path("a.png")}).exit_code, 0);
    EXPECT_EQ(fileBytes(path("a.png")).substr(1, 3), "PNG");
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--collider-picture", path("b.png")},
                                                  {"--collider", "none", "--collider-picture", path("b.png")},
                                                  {"--collider", "7"}}) {
        const auto run = shatter("b.glb", wrong);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(path("b.glb")));
        EXPECT_FALSE(std::filesystem::exists(path("b.png")));
    }
}

} // namespace
