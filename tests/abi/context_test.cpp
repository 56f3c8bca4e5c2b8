// Contexts: versions, logs, and devices of hosts.
#include "tests/abi/hosting.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <thread>

namespace {

using namespace abi_test;

struct Heard {
    std::vector<std::pair<BrittleLogLevel, std::string>> lines;
    void listen(BrittleContextDef& def) {
        def.log_user = this;
        def.log = [](void* user, BrittleLogLevel level, const char* message) {
            static_cast<Heard*>(user)->lines.emplace_back(level, message);
        };
    }
};

TEST(SmallAbi, LogsLinesWhateverNamesHold) {
    Heard heard;
    BrittleContextDef def = brittleDefaultContextDef();
    heard.listen(def);
    def.vulkan.device_name = "no\nsuch\rdev\x1b[31m";
    BrittleContext* context = nullptr;
    EXPECT_NE(brittleCreateContext(&def, &context), BRITTLE_OK);
    ASSERT_FALSE(heard.lines.empty());
    for (const auto& [level, line] : heard.lines)
        EXPECT_EQ(line.find_first_of("\n\r\x1b"), std::string::npos) << line;
}

TEST(SmallAbi, NamesEveryResultAndItsVersion) {
    EXPECT_EQ(brittleVersion(), BRITTLE_VERSION);
    std::map<std::string, int> names;
    for (int k = 0; k <= BRITTLE_INTERNAL; ++k)
        ++names[brittleResultName(static_cast<BrittleResult>(k))];
    EXPECT_EQ(names.size(), BRITTLE_INTERNAL + 1u) << "each has a name of its own";
    EXPECT_EQ(names.count("BRITTLE_UNKNOWN_RESULT"), 0u);
    EXPECT_STREQ(brittleResultName(static_cast<BrittleResult>(15)), "BRITTLE_UNKNOWN_RESULT");
    EXPECT_STREQ(brittleResultName(BRITTLE_STALE_HANDLE), "BRITTLE_STALE_HANDLE");
}

TEST(SmallAbi, RefusesDefinitionsOfAnotherVersion) {
    const HostDevice device;
    BrittleContext* context = reinterpret_cast<BrittleContext*>(1);
    BrittleContextDef def = defOn(device);
    def.struct_size -= 8;
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_WRONG_VERSION);
    EXPECT_EQ(context, nullptr);
    def = defOn(device);
    def.version += 1u << 12; // the next minor version
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_WRONG_VERSION);
    def = defOn(device);
    def.vulkan.struct_size = 0;
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_WRONG_VERSION);
    def = defOn(device);
    def.version += 1; // another patch is as good
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
    brittleDestroyContext(context);
    EXPECT_EQ(brittleCreateContext(nullptr, &context), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleCreateContext(&def, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleLastError(nullptr), nullptr);
    brittleDestroyContext(nullptr);
}

TEST(SmallAbi, TellsTheLogWhyThereIsNoContext) {
    const HostDevice device;
    Heard heard;
    BrittleContextDef def = defOn(device);
    heard.listen(def);
    def.vulkan.queue_family = 77;
    BrittleContext* context = nullptr;
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_BAD_VALUE);
    ASSERT_EQ(heard.lines.size(), 1u);
    EXPECT_EQ(heard.lines[0].first, BRITTLE_LOG_ERROR);
    EXPECT_NE(heard.lines[0].second.find("77"), std::string::npos) << heard.lines[0].second;
}

TEST(SmallAbi, NamesWhatAHostsDeviceWasMadeWithout) {
    const auto refusalOf = [](const HostOptions& options) {
        const HostDevice device(options);
        Heard heard;
        BrittleContextDef def = defOn(device);
        heard.listen(def);
        BrittleContext* context = nullptr;
        EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_MISSING_FEATURE);
        EXPECT_EQ(context, nullptr);
        return heard.lines.empty() ? "" : heard.lines.back().second;
    };
    EXPECT_NE(refusalOf({.long_integers = false}).find("shaderInt64"), std::string::npos);
    EXPECT_NE(refusalOf({.one_dot_zero = true}).find("1.1"), std::string::npos);
}

TEST(SmallAbi, RefusesHalfOfADevice) {
    const HostDevice device;
    BrittleContext* context = nullptr;
    for (int left_out = 0; left_out < 4; ++left_out) {
        BrittleContextDef def = defOn(device);
        if (left_out == 0) def.vulkan.instance = nullptr;
        if (left_out == 1) def.vulkan.physical_device = nullptr;
        if (left_out == 2) def.vulkan.device = nullptr;
        if (left_out == 3) def.vulkan.queue = nullptr;
        EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_BAD_VALUE) << left_out;
    }
    BrittleContextDef def = defOn(device);
    def.vulkan.unlock_queue = nullptr;
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_BAD_VALUE);
    def = defOn(device);
    def.allocator.allocate = [](void*, size_t size, size_t) { return std::malloc(size); };
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_BAD_VALUE);
}

TEST(SmallAbi, SaysWhatItWorksOn) {
    const Hosting host;
    BrittleVulkan vulkan = {};
    EXPECT_EQ(brittleGetVulkan(host, &vulkan), BRITTLE_WRONG_VERSION);
    vulkan.struct_size = sizeof vulkan;
    MUST(host, brittleGetVulkan(host, &vulkan));
    EXPECT_EQ(vulkan.device, const_cast<Hosting&>(host).device().handle());
    EXPECT_EQ(vulkan.features & BRITTLE_FEATURE_SHADER_INT64, uint32_t{BRITTLE_FEATURE_SHADER_INT64});
    EXPECT_EQ(vulkan.features & BRITTLE_FEATURE_PUSH_DESCRIPTOR, 0u) << "the device was made without";
    EXPECT_NE(std::string(vulkan.device_name), "");
}

TEST(Abi, MakesADeviceOfItsOwnForHostsWithout) {
    BrittleContextDef def = brittleDefaultContextDef();
    BrittleContext* context = nullptr;
    ASSERT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
    BrittleVulkan vulkan = {};
    vulkan.struct_size = sizeof vulkan;
    MUST(context, brittleGetVulkan(context, &vulkan));
    EXPECT_NE(vulkan.device, nullptr);
    brittleDestroyContext(context);
    def.vulkan.device_name = "no such device";
    EXPECT_EQ(brittleCreateContext(&def, &context), BRITTLE_DEVICE_FAILED);
}

// Ids that are told from others: kinds, contexts, what is gone.
TEST(SmallAbi, KnowsStaleIdsFromWrongOnes) {
    const Hosting host, other;
    const HostMesh cube = cubeMesh();
    const BrittleMeshDef def = cube.def();
    BrittleMesh mesh, next;
    MUST(host, brittleCreateMesh(host, &def, &mesh));
    MUST(host, brittleDestroyMesh(host, mesh));
    EXPECT_EQ(brittleDestroyMesh(host, mesh), BRITTLE_STALE_HANDLE);
    MUST(host, brittleCreateMesh(host, &def, &next));
    EXPECT_NE(next.id, mesh.id);
    EXPECT_EQ(brittleDestroyMesh(host, mesh), BRITTLE_STALE_HANDLE) << "its place has another by now";
    EXPECT_EQ(brittleDestroyMesh(other, next), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleDestroyMesh(host, {0}), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleDestroyMesh(host, {~uint64_t{0}}), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleDestroyMaterial(host, {next.id}), BRITTLE_WRONG_HANDLE);
    EXPECT_EQ(brittleDestroyWorld(host, {next.id}), BRITTLE_WRONG_HANDLE);
    for (int bit = 0; bit < 64; ++bit)
        EXPECT_NE(brittleDestroyMesh(host, {next.id ^ uint64_t{1} << bit}), BRITTLE_OK) << bit;
    MUST(host, brittleDestroyMesh(host, next));
}

TEST(SmallAbi, ChecksMeshes) {
    const Hosting host;
    const HostMesh cube = cubeMesh();
    BrittleMesh mesh = {0};
    const auto made = [&](auto&& change) {
        BrittleMeshDef def = cube.def();
        change(def);
        return brittleCreateMesh(host, &def, &mesh);
    };
    EXPECT_EQ(made([](BrittleMeshDef&) {}), BRITTLE_OK) << host.error();
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.index_count -= 3; }), BRITTLE_BAD_MESH) << "it has a hole";
    EXPECT_NE(host.error(), "");
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.index_count -= 3, d.is_open = 1; }), BRITTLE_OK) << host.error();
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.index_count -= 1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.index_count = 0; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.index_count = 4'000'000'000; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.vertex_count = 7; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.vertex_count = 0; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.position_stride = 13; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.position_stride = 8; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.positions = nullptr; }), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.indices = nullptr; }), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(made([](BrittleMeshDef& d) { d.struct_size = 1; }), BRITTLE_WRONG_VERSION);
    HostMesh bad = cubeMesh();
    bad.positions[5] = std::nanf("");
    const BrittleMeshDef def = bad.def();
    EXPECT_EQ(brittleCreateMesh(host, &def, &mesh), BRITTLE_BAD_VALUE);
    EXPECT_EQ(brittleCreateMesh(host, nullptr, &mesh), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleCreateMesh(host, &def, nullptr), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(brittleCreateMesh(nullptr, &def, &mesh), BRITTLE_NULL_ARGUMENT);
}

// Strides as engines have them, normals and texture coordinates between.
TEST(SmallAbi, TakesInterleavedVertices) {
    const Hosting host;
    const HostMesh cube = cubeMesh();
    std::vector<float> vertices;
    for (size_t k = 0; k < 8; ++k) {
        vertices.insert(vertices.end(), &cube.positions[3 * k], &cube.positions[3 * k] + 3);
        vertices.insert(vertices.end(), {0, 1, 0, 0.5f, 0.5f});
    }
    BrittleMeshDef def = cube.def();
    def.positions = vertices.data();
    def.normals = vertices.data() + 3;
    def.uvs = vertices.data() + 6;
    def.position_stride = def.normal_stride = def.uv_stride = 32;
    BrittleMesh mesh;
    MUST(host, brittleCreateMesh(host, &def, &mesh));
}

TEST(SmallAbi, ChecksMaterials) {
    const Hosting host;
    BrittleMaterial material = {0};
    const auto made = [&](auto&& change) {
        BrittleMaterialDef def = brittleDefaultMaterialDef();
        change(def);
        return brittleCreateMaterial(host, &def, &material);
    };
    EXPECT_EQ(made([](BrittleMaterialDef&) {}), BRITTLE_OK) << host.error();
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.density = 3000, d.tensile_strength = 5e6; }), BRITTLE_OK) << host.error();
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.density = -1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.poisson_ratio = 0.7; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.youngs_modulus = std::nan(""); }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.like = "glas"; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.like = "gl\nass\t"; }), BRITTLE_BAD_VALUE);
    EXPECT_NE(host.error().find("gl ass "), std::string::npos) << "a message is one line: " << host.error();
    EXPECT_NE(host.error().find("glass"), std::string::npos) << "the nearest name there is: " << host.error();
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.like = nullptr; }), BRITTLE_NULL_ARGUMENT);
    EXPECT_EQ(made([](BrittleMaterialDef& d) { d.density = -1; }), BRITTLE_BAD_VALUE);
    EXPECT_EQ(host.error().find("own"), std::string::npos) << "a name that the caller never gave: " << host.error();
    EXPECT_EQ(brittleFindMaterial(host, "oak", &material), BRITTLE_BAD_VALUE);
    EXPECT_NE(host.error().find("name is \"oak\""), std::string::npos) << host.error();
    EXPECT_EQ(brittleFindMaterial(host, nullptr, &material), BRITTLE_NULL_ARGUMENT);
    MUST(host, brittleFindMaterial(host, "porcelain", &material));
    MUST(host, brittleDestroyMaterial(host, material));
    EXPECT_EQ(brittleDestroyMaterial(host, material), BRITTLE_STALE_HANDLE);
}

TEST(SmallAbi, LeavesNothingBehindInAHundredCycles) {
    const HostDevice device;
    const HostMesh cube = cubeMesh();
    for (int k = 0; k < 100; ++k) {
        BrittleContextDef def = defOn(device);
        BrittleContext* context = nullptr;
        ASSERT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
        const BrittleMeshDef mesh_def = cube.def();
        BrittleMesh mesh;
        MUST(context, brittleCreateMesh(context, &mesh_def, &mesh));
        const BrittleWorldDef world_def = brittleDefaultWorldDef();
        BrittleWorld world;
        MUST(context, brittleCreateWorld(context, &world_def, &world));
        brittleDestroyContext(context);
    }
    EXPECT_EQ(device.messages(), 0u);
}

} // namespace
