// Checks what the kernels require of a device, and that a device without an optional feature gets other kernels.
#include "engine/device_features.h"
#include "modules/brittle/fracture/deciding_kernels.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

#include <array>
#include <cstdlib>
#include <string>

namespace {

using engine::ErrorCode;
using engine::OptionalFeatures;

const OptionalFeatures kNone;
const OptionalFeatures kAll = {true, true, true, true, true, true, true};

engine::Reflection reflectionOf(const shaders::Module& module) {
    auto reflection = engine::reflect(module.words);
    EXPECT_TRUE(reflection) << module.name;
    return reflection ? *reflection : engine::Reflection{};
}

// Sets BRITTLE_DEVICE_WITHOUT for as long as it lives.
class Without {
public:
    explicit Without(const char* list) { setenv("BRITTLE_DEVICE_WITHOUT", list, 1); }
    ~Without() { unsetenv("BRITTLE_DEVICE_WITHOUT"); }
    Without(const Without&) = delete;
    Without& operator=(const Without&) = delete;
};

TEST(Capabilities, OfEveryShaderAreRequiredOfDevicesOrOptional) {
    for (const shaders::Module& module : shaders::all()) {
        const engine::Reflection reflection = reflectionOf(module);
        EXPECT_FALSE(reflection.capabilities.empty()) << module.name;
        EXPECT_EQ(engine::lackingCapability(reflection.capabilities, kAll), "") << module.name;
    }
}

// Every kernel that needs an optional feature has a variant that a device without any can load, or is itself the variant in
// doubles, which is loaded for precision double alone.
TEST(Capabilities, ThatAreOptionalHaveAKernelWithoutThem) {
    size_t optional = 0;
    for (const shaders::Module& module : shaders::all()) {
        const std::string name(module.name);
        if (engine::lackingCapability(reflectionOf(module).capabilities, kNone).empty() || name.ends_with("_double")) continue;
        optional++;
        const shaders::Module* variant = shaders::find(name + "_no_vote");
        ASSERT_NE(variant, nullptr) << name;
        EXPECT_EQ(engine::lackingCapability(reflectionOf(*variant).capabilities, kNone), "") << name;
    }
    EXPECT_EQ(optional, 3u); // the searches of cut_cells
}

TEST(Capabilities, ThatNoDeviceIsAskedForAreNamed) {
    const std::array<uint32_t, 2> half = {spv::CapabilityShader, spv::CapabilityFloat16};
    EXPECT_EQ(engine::lackingCapability(half, kAll), "SPIR-V capability 9");
    const std::array<uint32_t, 2> doubles = {spv::CapabilityShader, spv::CapabilityFloat64};
    EXPECT_EQ(engine::lackingCapability(doubles, kAll), "");
    EXPECT_EQ(engine::lackingCapability(doubles, kNone), "64-bit floats in shaders");
}

TEST(Capabilities, ThatADeviceLacksKeepAKernelFromBeingLoaded) {
    engine::KernelLibrary kernels(engine_test::minimalDevice());
    for (const char* name : {"cut_cells", "clip_triangles_double"}) {
        const auto refused = kernels.get(name);
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().code, ErrorCode::Feature);
        EXPECT_NE(refused.error().message.find("which llvmpipe"), std::string::npos) << refused.error().message;
    }
    EXPECT_TRUE(kernels.get("cut_cells_no_vote"));
}

TEST(Capabilities, OfTheDeviceDecideWhichKernelCutsCells) {
    if (!engine_test::device().features().subgroup_vote) GTEST_SKIP() << "the device has no subgroup votes";
    engine::KernelLibrary lesser(engine_test::minimalDevice()), full(engine_test::device());
    const auto nameIn = [](engine::KernelLibrary& kernels, brittle::Precision precision) {
        const auto kernel = brittle::kernelFor(kernels, "cut_cells", 0, precision);
        return kernel ? (*kernel)->name : kernel.error().message;
    };
    EXPECT_EQ(nameIn(full, brittle::Precision::Exact), "cut_cells");
    EXPECT_EQ(nameIn(lesser, brittle::Precision::Exact), "cut_cells_no_vote");
    EXPECT_EQ(nameIn(lesser, brittle::Precision::Fast), "cut_cells_no_vote");
}

// Barriers are those of Vulkan 1.1, descriptors can be pooled: nothing that a kernel or a recording uses is an extension.
TEST(MinimalDevice, IsOpenedWithoutAnyExtension) {
    EXPECT_TRUE(engine_test::minimalDevice().extensions().empty());
    const OptionalFeatures& f = engine_test::minimalDevice().features();
    EXPECT_FALSE(f.push_descriptors || f.multi_draw_indirect || f.draw_indirect_first_instance || f.driver_properties ||
                 f.doubles || f.shader_stores || f.subgroup_vote);
}

TEST(DeviceWithout, LacksTheListedFeaturesAndNoOther) {
    const OptionalFeatures usual = engine_test::device().features();
    const Without set("doubles,subgroup_vote");
    const auto device = engine::Device::create();
    ASSERT_TRUE(device) << device.error().message;
    const OptionalFeatures& f = (*device)->features();
    EXPECT_FALSE(f.doubles || f.subgroup_vote);
    EXPECT_EQ(f.push_descriptors, usual.push_descriptors);
    EXPECT_EQ(f.multi_draw_indirect, usual.multi_draw_indirect);
}

TEST(DeviceWithout, AllIsOpenedWithoutAnyExtension) {
    const Without set("all");
    const auto device = engine::Device::create();
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_TRUE((*device)->extensions().empty());
    EXPECT_FALSE((*device)->features().subgroup_vote);
}

TEST(DeviceWithout, AnUnknownFeatureIsRefusedWithTheKnownOnes) {
    const Without set("doubles,dobules");
    const auto device = engine::Device::create();
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().code, ErrorCode::BadInput);
    EXPECT_EQ(
        device.error().message,
        "BRITTLE_DEVICE_WITHOUT: \"dobules\" is no optional feature of a device; known are push_descriptors, "
        "multi_draw_indirect, draw_indirect_first_instance, driver_properties, doubles, shader_stores, subgroup_vote, all, "
        "separated by commas");
}

} // namespace
