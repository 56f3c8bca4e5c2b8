// Host and device agree on which body is how strong: on chances bit for bit, on strengths as far as 32 bits go.
#include "modules/brittle/effects/blow.h"
#include "tests/kernel/lab.h"

namespace kernel_test {
namespace {

TEST(SmallBodyStrengths, OfTheDeviceAreThoseOfTheHost) {
    constexpr uint32_t kBodies = 5000;
    constexpr uint64_t kSeed = 0x123456789abcdef0;
    for (const brittle::Material& material : brittle::builtinMaterials()) {
        const engine::Buffer cards = bufferOf(std::vector<gpu::MaterialCard>{brittle::cardOf(material)});
        const engine::Buffer strengths = blankBuffer<gpu::vec2>(kBodies);
        struct {
            uint32_t length = kBodies, seed_low = static_cast<uint32_t>(kSeed), seed_high = kSeed >> 32;
            float volume = 0.02f;
        } push;
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(testKernel("body_strengths"), kBodies, push, {cards, strengths});
        });
        const auto found = valuesOf<gpu::vec2>(strengths, kBodies);
        for (uint32_t k = 0; k < kBodies; ++k) {
            const double chance = brittle::chanceOf(kSeed, k), strength = brittle::strengthOf(material, 0.02f, chance);
            ASSERT_EQ(static_cast<double>(found[k].x), chance) << k;
            ASSERT_NEAR(found[k].y / strength, 1, 1e-4) << material.name << " " << k;
        }
    }
}

} // namespace
} // namespace kernel_test
