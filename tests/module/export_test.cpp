#include "modules/brittle/export/glb.h"
#include "modules/brittle/export/output_file.h"
#include "tests/reference/contract.h"
#include "tests/support/fragment_sets.h"
#include "tests/support/shapes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

using namespace brittle;

namespace {

class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("brittle_export_test_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    size_t fileCount() const {
        return static_cast<size_t>(
            std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path path_;
};

reference::FragmentFile writtenAndRead(const FragmentSet& set) {
    const Folder folder;
    const auto bytes = encodeGlb(set);
    if (!bytes) throw std::runtime_error(bytes.error().message);
    std::ofstream(folder / "a.glb", std::ios::binary) << *bytes;
    return reference::readFragmentFile(folder / "a.glb");
}

nlohmann::json jsonOf(const std::string& glb) {
    uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    return nlohmann::json::parse(glb.substr(20, size));
}

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST(Glb, ReadsBackAsTheFragmentsItIsMadeOf) {
    FragmentSet set = support::cubeInTwo().set;
    set.center = {1000000.5, -2, 3};
    for (Fragment& f : set.fragments)
        f.site[0] += 1000000.5, f.site[1] -= 2, f.site[2] += 3;
    const reference::FragmentFile file = writtenAndRead(set);
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    ASSERT_EQ(file.pieces.size(), 2u);
    EXPECT_EQ(file.pieces[1].name, "fragment_0001");
    EXPECT_EQ(file.pieces[1].translation, (reference::Point{1000000.5, -2, 3}));
    EXPECT_EQ(file.pieces[1].site, (reference::Point{1000001, -2, 3}));
    EXPECT_EQ(file.pieces[1].cell, 1u);
    EXPECT_EQ(file.pieces[1].volume, 0.375);
    EXPECT_EQ(file.pieces[1].outer.size(), 10u);
    EXPECT_EQ(file.pieces[1].inner.size(), 2u);
    const auto model = support::boxTriangles({1000000, -2.5, 2.5}, {1000001, -1.5, 3.5});
    const reference::ContractReport report = reference::checkContract(file, model);
    EXPECT_TRUE(report.holds()) << report.text();
}

TEST(Glb, KeepsAVertexOnceAndAttributesApart) {
    const nlohmann::json json = jsonOf(*encodeGlb(support::cubeInTwo().set));
    // Five faces of four corners each and one of four: no corner of a face twice, none joined across sharp edges.
    EXPECT_EQ(json["accessors"][0]["count"], 20);
    EXPECT_EQ(json["accessors"][3]["count"], 30);
    EXPECT_EQ(json["accessors"][4]["count"], 4);
    EXPECT_EQ(json["accessors"][0]["max"], nlohmann::json({0.125, 0.5, 0.5}));
    EXPECT_EQ(json["materials"][0]["name"], "outer");
    EXPECT_EQ(json["materials"][1]["name"], "inner");
    EXPECT_NE(json["materials"][0]["pbrMetallicRoughness"], json["materials"][1]["pbrMetallicRoughness"]);
    EXPECT_EQ(json["scenes"][0]["nodes"], nlohmann::json({0, 1}));
}

TEST(Glb, SameFragmentsSameBytes) { EXPECT_EQ(*encodeGlb(support::cubeInTwo().set), *encodeGlb(support::cubeInTwo().set)); }

TEST(Glb, FragmentsWithoutOneOfTheSides) {
    FragmentSet set = support::cubeInTwo().set;
    set.fragments[0].inner_index_count = 0;
    set.fragments[1].outer_index_count = 0;
    const nlohmann::json json = jsonOf(*encodeGlb(set));
    EXPECT_EQ(json["meshes"][0]["primitives"].size(), 1u);
    EXPECT_EQ(json["meshes"][0]["primitives"][0]["material"], 0);
    EXPECT_EQ(json["meshes"][1]["primitives"][0]["material"], 1);
}

TEST(Glb, FacesOfEarlierCutsAreInner) {
    FragmentSet set = support::cubeInTwo().set;
    const uint32_t outer = set.fragments[0].outer_index_count, inner = set.fragments[0].inner_index_count;
    set.fragments[0].earlier_index_count = 6;
    const nlohmann::json json = jsonOf(*encodeGlb(set));
    const nlohmann::json primitives = json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    EXPECT_EQ(primitives[0]["material"], 0);
    EXPECT_EQ(json["accessors"][primitives[0]["indices"].get<size_t>()]["count"], outer - 6);
    EXPECT_EQ(primitives[1]["material"], 1);
    EXPECT_EQ(json["accessors"][primitives[1]["indices"].get<size_t>()]["count"], inner + 6);
}

// The reader counts normals that are not of unit length as faults.
TEST(Glb, NormalsThatAreNone) {
    FragmentSet set = support::cubeInTwo().set;
    for (float& x : set.vertices[0].normal)
        x = 0;
    for (float& x : set.vertices[1].normal)
        x = std::nanf("");
    for (float& x : set.vertices[2].normal)
        x *= 0.7f;
    EXPECT_TRUE(writtenAndRead(set).faults.empty());
}

TEST(Glb, NoFragmentsNoFile) { EXPECT_FALSE(encodeGlb(FragmentSet{})); }

TEST(OutputFile, IsThereWholeOrNotAtAll) {
    const Folder folder;
    {
        auto file = OutputFile::create(folder / "a.glb");
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->write("half"));
        EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
    }
    EXPECT_EQ(folder.fileCount(), 0u);
    {
        auto file = OutputFile::create(folder / "a.glb");
        ASSERT_TRUE(file && file->write("whole") && file->commit());
    }
    EXPECT_EQ(contentOf(folder / "a.glb"), "whole");
    EXPECT_EQ(folder.fileCount(), 1u);
    {
        auto file = OutputFile::create(folder / "a.glb");
        ASSERT_TRUE(file && file->write("abandoned"));
    }
    EXPECT_EQ(contentOf(folder / "a.glb"), "whole"); // what was there before stays
}

// The number of a process that has ended.
pid_t endedProcess() {
    const pid_t process = fork();
    if (process == 0) _exit(0);
    waitpid(process, nullptr, 0);
    return process;
}

TEST(OutputFile, RemovesWhatAKilledProcessLeft) {
    const Folder folder;
    const std::string ended = std::to_string(endedProcess());
    const auto left = [&](const std::string& name) {
        std::ofstream(folder / name) << "left";
        return folder / name;
    };
    const auto stale = left("a.glb.part" + ended), of_another = left("b.glb.part" + ended);
    const auto of_a_running = left("a.glb.part" + std::to_string(getppid())), no_number = left("a.glb.part1x");
    auto file = OutputFile::create(folder / "a.glb");
    ASSERT_TRUE(file && file->write("whole") && file->commit());
    EXPECT_FALSE(std::filesystem::exists(stale));
    for (const auto& kept : {of_another, of_a_running, no_number})
        EXPECT_EQ(contentOf(kept), "left") << kept;
}

// The number of a killed process may be that of another by then.
TEST(OutputFile, RemovesWhatNobodyHasWrittenToForMinutes) {
    const Folder folder;
    const auto partial = folder / ("a.glb.part" + std::to_string(getppid()));
    std::ofstream(partial) << "left";
    std::filesystem::last_write_time(partial, std::filesystem::file_time_type::clock::now() - std::chrono::minutes(5));
    ASSERT_TRUE(OutputFile::create(folder / "a.glb"));
    EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST(OutputFile, LeavesWhatAnotherMachineIsWriting) {
    const Folder folder;
    const auto partial = folder / ("a.glb.part" + std::to_string(endedProcess()));
    std::ofstream(partial) << "half";
    const int held = open(partial.c_str(), O_RDWR);
    ASSERT_EQ(flock(held, LOCK_SH), 0);
    ASSERT_TRUE(OutputFile::create(folder / "a.glb"));
    EXPECT_EQ(contentOf(partial), "half");
    close(held);
    ASSERT_TRUE(OutputFile::create(folder / "a.glb"));
    EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST(OutputFile, ReplacesWhatALinkLeadsTo) {
    const Folder folder;
    std::ofstream(folder / "a.glb") << "before";
    std::filesystem::create_symlink(folder / "a.glb", folder / "link.glb");
    auto file = OutputFile::create(folder / "link.glb");
    ASSERT_TRUE(file && file->write("after") && file->commit());
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.glb"));
    EXPECT_EQ(contentOf(folder / "a.glb"), "after");
}

TEST(OutputFile, SaysAtOnceWhereNothingCanBeWritten) {
    const Folder folder;
    EXPECT_FALSE(OutputFile::create(folder / "no/such/folder.glb"));
    EXPECT_FALSE(OutputFile::create(folder / "."));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(OutputFile::create(folder / "pipe"));
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
    EXPECT_FALSE(OutputFile::create(""));
}
