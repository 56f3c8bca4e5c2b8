// How work is spread over the device is no part of the result: workgroups of any size give the same bytes.
#include "modules/brittle/export/glb.h"
#include "tests/engine/test_device.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/rough_block.h"

#include <gtest/gtest.h>

#include <map>

namespace {

using brittle::Double3;
using brittle::FractureOptions;

// Pipelines of one size for all tests of it; they go before the device does.
class Fractures : public testing::Environment {
public:
    brittle::Fracture& of(uint32_t group_size) {
        auto& fracture = made_[group_size];
        if (!fracture) {
            auto created = brittle::Fracture::create(engine_test::device(), group_size);
            if (!created) ADD_FAILURE() << created.error().message;
            fracture = std::move(*created);
        }
        return *fracture;
    }
    void TearDown() override { made_.clear(); }

private:
    std::map<uint32_t, std::unique_ptr<brittle::Fracture>> made_;
};
Fractures& fractures = *static_cast<Fractures*>(testing::AddGlobalTestEnvironment(new Fractures));

struct Broken {
    std::string bytes;
    uint32_t done_exactly = 0; // cells
};

Broken broken(uint32_t group_size, const whole::Model& model, const FractureOptions& options) {
    const auto result = fractures.of(group_size).shatter(model.prepared.mesh, model.prepared.topology, options);
    EXPECT_TRUE(result) << result.error().message;
    const auto bytes = brittle::encodeGlb(result->fragments);
    EXPECT_TRUE(bytes) << bytes.error().message;
    return {*bytes, result->counts.exact_redone};
}

uint32_t expectTheSameForEverySize(const whole::Model& model, const FractureOptions& options) {
    const Broken usual = broken(64, model, options);
    EXPECT_FALSE(usual.bytes.empty());
    for (const uint32_t size : {8u, 32u, 128u})
        EXPECT_TRUE(broken(size, model, options).bytes == usual.bytes) << "workgroups of " << size << " lanes";
    return usual.done_exactly;
}

uint32_t expectTheSameForEverySize(const std::string& name, const FractureOptions& options) {
    SCOPED_TRACE(name);
    return expectTheSameForEverySize(whole::modelFrom(name), options);
}

FractureOptions sites(uint32_t count) {
    FractureOptions options;
    options.site_count = count;
    return options;
}

// Ties everywhere: the filter can decide next to nothing.
FractureOptions lattice() {
    FractureOptions options;
    for (double x : {-.375, -.125, .125, .375})
        for (double y : {-.375, -.125, .125, .375})
            for (double z : {-.375, -.125, .125, .375})
                options.given_sites.push_back(Double3{x, y, z});
    return options;
}

TEST(GroupSize, DoesNotShowInFacesOfThousandsOfSides) {
    FractureOptions options;
    options.given_sites = {{0.5, 0.302, 0.5}, {0.5, 0.317, 0.5}, {0.2, 0.1, 0.7}};
    expectTheSameForEverySize(whole::modelFrom(support::roughBlock(60)), options);
}

TEST(GroupSize, DoesNotShowInFragments) {
    expectTheSameForEverySize("builtin:ring", sites(300));
    expectTheSameForEverySize("builtin:bumpy:4", sites(100));
}

TEST(GroupSize, DoesNotShowInCellsThatAreDoneExactly) { EXPECT_GT(expectTheSameForEverySize("builtin:cube", lattice()), 0u); }

TEST(GroupSize, DoesNotShowInPatterns) {
    FractureOptions hit = sites(150);
    hit.impact = {{0, 0, .5}, brittle::contactRadiusOf(3), brittle::favorOf(3)};
    for (const brittle::Pattern pattern : {brittle::Pattern::Impact, brittle::Pattern::Paper}) {
        hit.pattern = pattern;
        expectTheSameForEverySize("builtin:bumpy:3", hit);
    }
}

TEST(GroupSize, DoesNotShowInAnySearch) {
    FractureOptions options = sites(300);
    for (const brittle::Search search : {brittle::Search::Linear, brittle::Search::SphereTree}) {
        options.search = search;
        expectTheSameForEverySize("builtin:bumpy:3", options);
    }
}

TEST(GroupSize, IsAPowerOfTwoThatTheDeviceTakes) {
    for (const uint32_t size : {1u, 4u, 48u, 512u, 1u << 31}) {
        const auto refused = brittle::Fracture::create(engine_test::device(), size);
        ASSERT_FALSE(refused) << size;
        EXPECT_EQ(refused.error().code, engine::ErrorCode::BadInput);
        EXPECT_NE(refused.error().message.find("power of two from 8 to "), std::string::npos) << refused.error().message;
    }
}

} // namespace
