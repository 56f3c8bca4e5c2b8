// Fragments that are broken again, and their fragments in turn.
#include "modules/brittle/fracture/refracture.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using brittle::FractureOptions;
using brittle::Fragment;
using namespace whole;

enum class Choice : uint8_t { Largest, Random };

struct Descent {
    const char* model;
    Choice choice = Choice::Largest;
    uint64_t seed = 1;
};

std::string nameOf(const testing::TestParamInfo<Descent>& info) {
    std::string name = std::string(info.param.model) + (info.param.choice == Choice::Largest ? "_largest" : "_random") +
                       "_seed" + std::to_string(info.param.seed);
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

constexpr uint32_t kDepth = 8;

size_t chosen(const brittle::FragmentSet& set, Choice choice, std::mt19937& random) {
    if (choice == Choice::Random) return random() % set.fragments.size();
    const auto smaller = [](const Fragment& a, const Fragment& b) { return a.volume < b.volume; };
    return static_cast<size_t>(std::ranges::max_element(set.fragments, smaller) - set.fragments.begin());
}

class Refracture : public testing::TestWithParam<Descent> {};

TEST_P(Refracture, KeepsTheContractAtEveryDepth) {
    const Descent& descent = GetParam();
    if (!std::string(descent.model).starts_with("builtin:")) SKIP_WITHOUT_MESHES();
    std::mt19937 random(static_cast<uint32_t>(descent.seed));
    Model model = modelFrom(descent.model);
    for (uint32_t depth = 0; depth <= kDepth; ++depth) {
        SCOPED_TRACE("depth " + std::to_string(depth));
        FractureOptions options;
        options.site_count = 2 + static_cast<uint32_t>(random() % 19);
        options.seed = descent.seed + depth;
        const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
        ASSERT_TRUE(result) << result.error().message;
        expectContract(model, *result);
        if (HasFailure()) return;
        model = modelFrom(result->fragments, chosen(result->fragments, descent.choice, random));
    }
}

std::vector<Descent> descents(std::initializer_list<const char*> models, uint64_t first_seed, uint64_t last_seed) {
    std::vector<Descent> all;
    for (const char* model : models)
        for (const Choice choice : {Choice::Largest, Choice::Random})
            for (uint64_t seed = first_seed; seed <= last_seed; ++seed)
                all.push_back({model, choice, seed});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Small, Refracture, testing::ValuesIn(descents({"builtin:cube"}, 1, 1)), nameOf);
INSTANTIATE_TEST_SUITE_P(Quick, Refracture,
                         testing::ValuesIn(descents({"builtin:ring", "builtin:bumpy:3", "spot_low_resolution.obj",
                                                     "gearwheel.bin.stl", "cheese.off"},
                                                    1, 1)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Long, Refracture,
                         testing::ValuesIn(descents({"builtin:cube", "builtin:ring", "builtin:bumpy:4",
                                                     "spot_low_resolution.obj", "gearwheel.bin.stl", "cheese.off",
                                                     "fandisk.off", "utah_teapot.stl"},
                                                    2, 9)),
                         nameOf);

} // namespace
