// Materials in scenes: what bodies weigh by them, cards derived from built-in ones, written and read again, and what is
// refused.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/scene_file.h"
#include "modules/brittle/scene/scene_material.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

using namespace brittle;

namespace {

const std::string kThin = R"([[material]]
name = "thin ice"
like = "ice"
density = 900
fracture_energy = 2.5
eta = 0.25
)";

std::string refusalOf(const std::string& text) {
    const auto scene = readScene(text, "scene.toml");
    EXPECT_FALSE(scene) << text;
    return scene ? "" : scene.error().message;
}

double weightOf(const std::string& text) {
    const auto scene = readScene(text, "scene.toml");
    EXPECT_TRUE(scene) << scene.error().message;
    if (!scene) return 0;
    const auto contents = contentsOf(*scene, {}, nullptr);
    EXPECT_TRUE(contents);
    return contents ? 1.0 / static_cast<double>(contents->bodies[0].offset.w) : 0;
}

TEST(SmallSceneMaterial, SaysWhatABodyWeighsThatDoesNotSayIt) {
    EXPECT_NEAR(weightOf("[[body]]\n"), 1000, 1e-3);
    EXPECT_NEAR(weightOf("[[body]]\nmaterial = \"glass\"\n"), 2500, 1e-3);
    EXPECT_NEAR(weightOf("[[body]]\nmaterial = \"glass\"\ndensity = 2600\n"), 2600, 1e-3);
    EXPECT_NEAR(weightOf("[[body]]\nmaterial = \"glass\"\nmass = 7\n"), 7, 1e-5);
    EXPECT_NEAR(weightOf("[[body]]\nmaterial = \"thin ice\"\n" + kThin), 900, 1e-3);
}

TEST(SmallSceneMaterial, IsLikeTheBuiltInOneButForWhatItSays) {
    const auto scene = readScene(kThin + "[[body]]\nmaterial = \"thin ice\"\n", "scene.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto card = materialOf("thin ice", scene->materials);
    ASSERT_TRUE(card) << card.error().message;
    Material expected = *findMaterial("ice");
    expected.name = "thin ice";
    expected.density = 900;
    expected.fracture_energy = 2.5;
    expected.eta = 0.25;
    EXPECT_EQ(*card, expected);
}

TEST(SmallSceneMaterial, EveryValueIsTaken) {
    const MaterialDescription described = {"own", "stone", 1, 2, 0.3, 4, 5, 6, 7, 0.8, 9};
    const auto card = derivedMaterial(described);
    ASSERT_TRUE(card);
    EXPECT_EQ(*card, (Material{"own", 1, 2, 0.3, 4, 5, 6, 7, 0.8, 9}));
}

TEST(SmallSceneMaterial, EveryBuiltInNameHasACard) {
    for (const std::string_view name : materialNames())
        EXPECT_TRUE(materialOf(name, {})) << name;
    EXPECT_EQ(materialNames().size(), builtinMaterials().size());
}

TEST(SmallSceneMaterial, RefusesNamesThatNobodyHasWithTheNearestOne) {
    const std::string body = "[[body]]\nmaterial = ";
    EXPECT_EQ(refusalOf(body + "\"procelain\"\n"),
              "scene.toml:2: body 0: unknown 'procelain' in 'material', did you mean 'porcelain'?");
    EXPECT_EQ(refusalOf(body + "\"thinice\"\n" + kThin),
              "scene.toml:2: body 0: unknown 'thinice' in 'material', did you mean 'thin ice'?");
    EXPECT_EQ(
        refusalOf(body + "\"rubber\"\n" + kThin),
        "scene.toml:2: body 0: unknown 'rubber' in 'material'; it has to be one of glass, porcelain, concrete, brick, ice, "
        "stone, thin ice");
    EXPECT_EQ(refusalOf("[[material]]\nname = \"a\"\nlike = \"brik\"\n[[body]]\n"),
              "scene.toml:3: unknown 'brik' in 'like', did you mean 'brick'?");
    EXPECT_EQ(refusalOf(body + "\"\"\n").find("scene.toml:2: 'material' is empty; leave it out, or name one"), 0u);
    EXPECT_EQ(refusalOf(body + "\"tempered_glass\"\n").find("scene.toml:2: body 0: 'tempered_glass' breaks by the stress"), 0u);
}

TEST(SmallSceneMaterial, RefusesCardsThatCannotBe) {
    struct Wrong {
        const char* text;
        const char* refusal;
    };
    for (const auto& [text, refusal] : std::vector<Wrong>{
             {"[[material]]\nlike = \"ice\"\n", "scene.toml:1: material 0: needs a 'name'"},
             {"[[material]]\nname = \"a\"\n", "scene.toml:1: material 'a': needs 'like'"},
             {"[[material]]\nlike = \"ice\"\nname = \"glass\"\n", "scene.toml:3: material 'glass': 'glass' is taken"},
             {"[[material]]\nlike = \"ice\"\nname = \"tempered_glass\"\n", "scene.toml:3: material 'tempered_glass': "},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\n[[material]]\nlike = \"ice\"\nname = \"a\"\n",
              "scene.toml:6: material 'a': another has this name"},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\neta = 1.5\n",
              "scene.toml:4: material 'a': 'eta' is 1.5; it has to be a number from 0 to 1"},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\npoisson_ratio = 0.5\n",
              "scene.toml:4: material 'a': 'poisson_ratio'"},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\nfracture_energy = 0\n", "scene.toml:4: material 'a': 'fracture_"},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\nweibull_modulus = nan\n", "scene.toml:4: material 'a': 'weibull_"},
             {"[[material]]\nlike = \"ice\"\nname = \"a\"\ntoughness = 1\n", "scene.toml:4: unknown key 'toughness'"},
             {"[material]\nname = \"a\"\n", "scene.toml:1: 'material' is a table; write it as a table that begins with [[mat"},
         }) {
        SCOPED_TRACE(text);
        EXPECT_EQ(refusalOf(std::string(text) + "[[body]]\n").find(refusal), 0u) << refusalOf(std::string(text) + "[[body]]\n");
    }
}

TEST(SmallSceneMaterial, AWorldIsNotMadeOfWhatNobodyKnows) {
    SceneDescription scene;
    scene.bodies.emplace_back().material = "rubber";
    EXPECT_FALSE(checkBody(scene.bodies[0], 0));
    const auto contents = contentsOf(scene, {}, nullptr);
    ASSERT_FALSE(contents);
    EXPECT_NE(contents.error().message.find("unknown 'rubber'"), std::string::npos);
    scene.materials.push_back({.name = "rubber", .like = "brick"});
    EXPECT_TRUE(checkBody(scene.bodies[0], 0, scene.materials));
    EXPECT_TRUE(contentsOf(scene, {}, nullptr));
}

TEST(SmallSceneMaterial, WrittenIsReadAsTheSame) {
    EXPECT_TRUE(rc::check([] {
        SceneDescription scene;
        const auto any = [](double lower, double upper) -> std::optional<double> {
            if (*rc::gen::arbitrary<bool>()) return {};
            return lower + (upper - lower) * (*rc::gen::inRange(0, 1'000'001)) / 1e6;
        };
        const int count = *rc::gen::inRange(0, 4);
        for (int k = 0; k < count; ++k)
            scene.materials.push_back({"own " + std::to_string(k), *rc::gen::element<std::string>("glass", "brick", "stone"),
                                       any(1, 1e4), any(1, 1e12), any(0, 0.499), any(0.1, 1e4), any(1, 1e9), any(1, 100),
                                       any(1e-9, 1), any(0, 1), any(0, 1)});
        scene.bodies.emplace_back().material = count > 0 ? "own 0" : "ice";
        const auto again = readScene(writeScene(scene), "again.toml");
        RC_ASSERT(again.has_value());
        RC_ASSERT(*again == scene);
    }));
}

} // namespace
