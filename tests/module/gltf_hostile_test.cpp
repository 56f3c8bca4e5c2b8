// glTF files that were cut short or spoiled: they are refused in one line or read, and take little time either way.
#include "modules/brittle/mesh/gltf/gltf.h"
#include "tests/support/gltf_builder.h"

#include <gtest/gtest.h>

#include <random>

using namespace support;
using nlohmann::json;

namespace {

struct Outcome {
    bool is_read = false;
    std::string error;
};

Outcome outcomeOf(const std::string& bytes) {
    const auto read = brittle::readGltf(
        bytes, [](const std::string&) { return std::string(100, '\0'); }, 100'000);
    if (!read) return {false, read.error().message};
    for (const brittle::Index3& t : read->triangles)
        for (const uint32_t v : t)
            EXPECT_LT(v, read->positions.size());
    EXPECT_EQ(read->corner_normals.size(), 3 * read->triangles.size());
    EXPECT_EQ(read->corner_uvs.size(), 3 * read->triangles.size());
    return {true, ""};
}

TEST(GltfHostile, TheFileIsReadBeforeItIsSpoiled) { EXPECT_EQ(outcomeOf(richGltf().glb()).error, ""); }

TEST(GltfHostile, FilesCutShortAreRefused) {
    const std::string binary = richGltf().glb(), text = richGltf().gltf();
    for (size_t size = 0; size < binary.size(); ++size)
        EXPECT_FALSE(outcomeOf(binary.substr(0, size)).is_read) << size;
    for (size_t size = 0; size < text.size(); ++size)
        EXPECT_FALSE(outcomeOf(text.substr(0, size)).is_read) << size;
}

TEST(GltfHostile, SpoiledBytesDoNoHarm) {
    const std::string binary = richGltf().glb(), text = richGltf().gltf();
    std::mt19937 random(7);
    size_t read = 0;
    for (int round = 0; round < 6000; ++round) {
        std::string bytes = round % 2 == 0 ? binary : text;
        for (uint32_t change = 1 + random() % 4; change-- > 0;) {
            const size_t at = random() % bytes.size();
            if (random() % 4 == 0)
                bytes.erase(at, random() % 8);
            else
                bytes[at] = random() % 2 == 0 ? static_cast<char>(random()) : "0123456789-.e[]{}\","[random() % 19];
        }
        const Outcome outcome = outcomeOf(bytes);
        EXPECT_EQ(outcome.error.find('\n'), std::string::npos) << outcome.error;
        read += outcome.is_read ? 1 : 0;
    }
    EXPECT_GT(read, 300u);
}

// All values of the JSON, by their paths.
void collect(const json& value, const json::json_pointer& path, std::vector<json::json_pointer>& paths) {
    if (!path.empty()) paths.push_back(path);
    if (value.is_object())
        for (const auto& [key, member] : value.items())
            collect(member, path / key, paths);
    for (size_t k = 0; value.is_array() && k < value.size(); ++k)
        collect(value[k], path / k, paths);
}

// Every value of the file is replaced by values that readers stumble over, or removed.
TEST(GltfHostile, OddValuesDoNoHarm) {
    const GltfBuilder whole = richGltf();
    std::vector<json::json_pointer> paths;
    collect(whole.json, json::json_pointer(), paths);
    const json kOdd[] = {-1,   0,    1,      2,       255,           4294967295u,    9007199254740992u, 18446744073709551615u,
                         1e30, -0.5, "text", nullptr, json::array(), json::object(), {0, 1, 2, 3},      true};
    size_t read = 0, refused = 0;
    for (const json::json_pointer& path : paths)
        for (const json& odd : kOdd) {
            GltfBuilder builder = whole;
            builder.json[path] = odd;
            const Outcome outcome = outcomeOf(builder.glb());
            EXPECT_EQ(outcome.error.find("the reader failed"), std::string::npos) << path << " " << odd;
            EXPECT_EQ(outcome.error.find("memory"), std::string::npos) << path << " " << odd;
            ++(outcome.is_read ? read : refused);
        }
    EXPECT_GT(read, 200u);
    EXPECT_GT(refused, 500u);
}

TEST(GltfHostile, MissingMembersDoNoHarm) {
    const GltfBuilder whole = richGltf();
    std::vector<json::json_pointer> paths;
    collect(whole.json, json::json_pointer(), paths);
    for (const json::json_pointer& path : paths) {
        GltfBuilder builder = whole;
        json& parent = builder.json[path.parent_pointer()];
        if (parent.is_object())
            parent.erase(path.back());
        else
            parent.erase(std::stoul(path.back()));
        EXPECT_EQ(outcomeOf(builder.glb()).error.find("the reader failed"), std::string::npos) << path;
    }
}

} // namespace
