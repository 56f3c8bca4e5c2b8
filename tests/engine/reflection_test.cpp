#include "tests/engine/test_device.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace engine;

namespace {

Reflection reflected(std::string_view name) {
    const auto modules = shaders::engineTestKernels();
    const auto module = std::ranges::find(modules, name, &shaders::Module::name);
    EXPECT_NE(module, modules.end());
    auto result = reflect(module->words);
    EXPECT_TRUE(result);
    return *result;
}

const ReflectedStruct* structNamed(const Reflection& reflection, std::string_view name) {
    const auto found = std::ranges::find(reflection.structs, name, &ReflectedStruct::name);
    return found == reflection.structs.end() ? nullptr : &*found;
}

} // namespace

TEST(Reflection, KnowsWhichBuffersAreReadAndWritten) {
    const Reflection r = reflected("reflected");
    ASSERT_EQ(r.bindings.size(), 4u);
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(r.bindings[i].set, 0u);
        EXPECT_EQ(r.bindings[i].binding, i);
        EXPECT_TRUE(r.bindings[i].storage_buffer);
    }
    EXPECT_TRUE(r.bindings[0].readonly && !r.bindings[0].writeonly);
    EXPECT_TRUE(!r.bindings[1].readonly && !r.bindings[1].writeonly); // unused, but still there
    EXPECT_TRUE(!r.bindings[2].readonly && r.bindings[2].writeonly);
    EXPECT_TRUE(!r.bindings[3].readonly && !r.bindings[3].writeonly); // one of two members is readonly
    EXPECT_EQ(r.bindings[0].name, "Vertices");
}

TEST(Reflection, KnowsSizesAndConstants) {
    const Reflection r = reflected("reflected");
    EXPECT_EQ(r.stage, ShaderStage::Compute);
    EXPECT_EQ(r.local_size, (std::array<uint32_t, 3>{96, 1, 1}));
    EXPECT_EQ(r.push_size, 28u); // 8 + 4 + 3 * 4 + 4
    EXPECT_EQ(r.spec_ids, (std::vector<uint32_t>{1, 4}));
    EXPECT_EQ(reflected("increment").push_size, 0u);
    EXPECT_EQ(reflected("flat_workgroup").local_size, (std::array<uint32_t, 3>{8, 8, 1}));
    EXPECT_FALSE(r.local_size_ids[0]);
    const Reflection sized = reflected("sized_workgroup");
    EXPECT_EQ(sized.local_size, (std::array<uint32_t, 3>{64, 1, 1}));
    EXPECT_EQ(sized.local_size_ids[0], 100u);
    EXPECT_FALSE(sized.local_size_ids[1]);
    EXPECT_EQ(sized.spec_ids, (std::vector<uint32_t>{3, 100}));
    EXPECT_EQ(reflected("passthrough.vert").stage, ShaderStage::Vertex);
}

TEST(Reflection, KnowsTheLayoutOfStructs) {
    const Reflection r = reflected("reflected");
    const ReflectedStruct* vertex = structNamed(r, "SceneVertex");
    ASSERT_NE(vertex, nullptr);
    EXPECT_EQ(vertex->array_stride, 32u);
    ASSERT_EQ(vertex->members.size(), 3u);
    EXPECT_EQ(vertex->members[1].name, "normal");
    EXPECT_EQ(vertex->members[1].offset, 12u);
    const ReflectedStruct* push = structNamed(r, "Push");
    ASSERT_NE(push, nullptr);
    ASSERT_EQ(push->members.size(), 4u);
    EXPECT_EQ(push->members[3].name, "last");
    EXPECT_EQ(push->members[3].offset, 24u);
}

TEST(Reflection, RefusesWhatIsNoModule) {
    EXPECT_FALSE(reflect({}));
    const uint32_t noise[] = {1, 2, 3, 4, 5, 6};
    EXPECT_FALSE(reflect(noise));
    const auto words = shaders::engineTestKernels()[0].words;
    std::vector<uint32_t> cut_short(words.begin(), words.end());
    cut_short.push_back(3u << 16); // an instruction of three words
    EXPECT_FALSE(reflect(cut_short));
    std::vector<uint32_t> endless(words.begin(), words.end());
    endless[5] = 0; // an instruction of no words
    EXPECT_FALSE(reflect(endless));
}
