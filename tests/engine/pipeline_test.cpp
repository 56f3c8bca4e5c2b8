// Pipelines that libraries have in common, and kernels that are compiled before they are met.
#include "engine/kernels_ahead.h"
#include "tests/engine/test_device.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <thread>

using namespace engine;
using namespace engine_test;

namespace {

std::unique_ptr<Device> sharingDevice() {
    auto made = Device::create({.share_pipelines = true});
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

VkPipeline pipelineOf(KernelLibrary& library, std::string_view name, std::initializer_list<uint32_t> spec = {}) {
    const auto kernel = library.get(name, spec);
    EXPECT_TRUE(kernel) << kernel.error().message;
    return (*kernel)->pipeline->handle();
}

// One more than `start`.
uint32_t incremented(Device& device, const Kernel& kernel, uint32_t start) {
    const Buffer words = upload(device, {start});
    Commands commands(device);
    EXPECT_TRUE(commands.begin());
    commands.dispatch(kernel, 1, NoPush{}, {words});
    finish(commands);
    return wordsOf(words)[0];
}

} // namespace

TEST(SharedPipelines, AreMadeOnceForAllLibrariesThatAskForTheSame) {
    const auto device = sharingDevice();
    KernelLibrary one(*device, shaders::engineTestKernels()), two(*device, shaders::engineTestKernels());
    const VkPipeline plain = pipelineOf(one, "increment"), biased = pipelineOf(one, "add_index", {5u});
    EXPECT_EQ(pipelineOf(two, "increment"), plain);
    EXPECT_EQ(pipelineOf(two, "add_index", {5u}), biased);
    EXPECT_GT(one.creationMs(), 0);
    EXPECT_EQ(two.creationMs(), 0);
    EXPECT_NE(pipelineOf(two, "add_index", {6u}), biased);
    EXPECT_EQ(two.kernelCount(), 3u);
}

TEST(SharedPipelines, DifferByWhatAllKernelsOfALibraryHaveInCommon) {
    const auto device = sharingDevice();
    KernelLibrary small(*device, shaders::engineTestKernels(), {{100, 32}}),
        large(*device, shaders::engineTestKernels(), {{100, 64}});
    EXPECT_NE(pipelineOf(small, "sized_workgroup"), pipelineOf(large, "sized_workgroup"));
    EXPECT_EQ(pipelineOf(small, "increment"), pipelineOf(large, "increment")); // which does not declare it
    EXPECT_TRUE(small.isShared("sized_workgroup"));
    KernelLibrary other(*device, shaders::engineTestKernels(), {{100, 16}});
    EXPECT_FALSE(other.isShared("sized_workgroup"));
    EXPECT_TRUE(other.isShared("increment"));
    EXPECT_FALSE(other.isShared("no kernel of ours"));
}

TEST(SharedPipelines, OutliveTheLibraryThatAskedFirst) {
    const auto device = sharingDevice();
    auto first = std::make_unique<KernelLibrary>(*device, shaders::engineTestKernels());
    const VkPipeline made = pipelineOf(*first, "increment");
    first.reset();
    KernelLibrary late(*device, shaders::engineTestKernels());
    EXPECT_EQ(pipelineOf(late, "increment"), made);
    EXPECT_EQ(late.creationMs(), 0);
    EXPECT_EQ(incremented(*device, **late.get("increment"), 41), 42u);
}

TEST(SharedPipelines, AreOneHoweverManyThreadsAskAtATime) {
    const auto device = sharingDevice();
    KernelLibrary one(*device, shaders::engineTestKernels()), two(*device, shaders::engineTestKernels());
    std::vector<KernelRequest> requests;
    for (uint32_t bias = 0; bias < 20; ++bias)
        requests.push_back({"add_index", {bias}});
    {
        const std::jthread other([&] { EXPECT_TRUE(two.warm(requests)); });
        EXPECT_TRUE(one.warm(requests));
    }
    for (uint32_t bias = 0; bias < 20; ++bias)
        EXPECT_EQ(pipelineOf(one, "add_index", {bias}), pipelineOf(two, "add_index", {bias})) << bias;
}

TEST(SharedPipelines, AreLeftAloneByAnotherVersionOfAKernel) {
    const auto device = sharingDevice();
    KernelLibrary one(*device, shaders::engineTestKernels()), two(*device, shaders::engineTestKernels());
    const VkPipeline shared = pipelineOf(one, "increment");
    const auto module = std::ranges::find(one.modules(), "increment", &shaders::Module::name);
    std::vector<uint32_t> words(module->words.begin(), module->words.end());
    words[2] ^= 1; // the mark of who made it, which is no part of the code
    std::vector<KernelReplacement> replacements;
    auto replacement = one.prepare("increment", std::make_shared<const std::vector<uint32_t>>(words));
    ASSERT_TRUE(replacement) << replacement.error().message;
    replacements.push_back(std::move(*replacement));
    ASSERT_TRUE(one.adopt(replacements));
    EXPECT_NE(pipelineOf(one, "increment"), shared);
    EXPECT_EQ(pipelineOf(two, "increment"), shared);
    EXPECT_EQ(incremented(*device, **one.get("increment"), 41), 42u);
    EXPECT_EQ(incremented(*device, **two.get("increment"), 41), 42u);
}

TEST(SharedPipelines, AreNoneWhereNobodyAskedForThem) {
    const auto made = Device::create();
    ASSERT_TRUE(made) << made.error().message;
    KernelLibrary one(**made, shaders::engineTestKernels()), two(**made, shaders::engineTestKernels());
    EXPECT_NE(pipelineOf(one, "increment"), pipelineOf(two, "increment"));
    EXPECT_FALSE(two.isShared("increment"));
}

TEST(KernelsAhead, AreAsUsableAsOthersAndNamesThatAreNoneDoNoHarm) {
    const std::vector<KernelAhead> kernels = {
        {"increment", {}}, {"no kernel of ours", {}}, {"add_index", {{0, 5}}}, {"sized_workgroup", {{100, 32}}}};
    std::vector<size_t> shown;
    compileAhead(device(), shaders::engineTestKernels(), kernels, [&](size_t begun) { shown.push_back(begun); });
    EXPECT_TRUE(std::ranges::is_sorted(shown));
    for (const size_t begun : shown)
        EXPECT_LT(begun, kernels.size());
    EXPECT_EQ(incremented(device(), testKernel(device(), "increment"), 41), 42u);
}

TEST(KernelsAhead, AreNotCompiledForACacheThatIsOff) {
    const char* before = std::getenv("MESA_SHADER_CACHE_DISABLE");
    const std::string value = before == nullptr ? "" : before;
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    const std::vector<KernelAhead> kernels = {{"increment", {}}};
    compileAhead(device(), shaders::engineTestKernels(), kernels, [](size_t) { ADD_FAILURE() << "for nothing"; });
    before == nullptr ? unsetenv("MESA_SHADER_CACHE_DISABLE") : setenv("MESA_SHADER_CACHE_DISABLE", value.c_str(), 1);
}
