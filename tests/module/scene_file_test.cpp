// Scene files: every key read and written, nothing unknown or out of range taken, and every refusal with its line.
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/nearest_name.h"
#include "modules/brittle/scene/scene_file.h"
#include "modules/brittle/scene/scene_keys.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <fstream>

using namespace brittle;

namespace {

const std::string kBody = "[[body]]\nshape = \"box\"\n";

SceneDescription readWell(const std::string& text) {
    const auto scene = readScene(text, "scene.toml");
    EXPECT_TRUE(scene) << scene.error().message << "\n" << text;
    return scene ? *scene : SceneDescription();
}

std::string refusalOf(const std::string& text) {
    const auto scene = readScene(text, "scene.toml");
    EXPECT_FALSE(scene) << text;
    if (scene) return "";
    EXPECT_EQ(scene.error().code, engine::ErrorCode::BadInput);
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
    return scene.error().message;
}

TEST(SmallSceneFile, SaysWhatItHolds) {
    const SceneDescription scene = readWell(R"(
name = "tower"
comment = "two\nlines"
gravity = [0, -1.62, 0]
effects = ["gravity", "contacts", "restitution"]

[step]
dt = 0.01
steps = 12
substeps = 8
solver = "hard"
recycling = false

[budgets]
pairs = 99

[camera]
eye = [1, 2, 3]
width = 640

[[body]]
name = "foot"
shape = "box"
size = [2, 1, 2]
place = [0, 0.5, 0]
turn = { axis = [0, 2, 0], degrees = 90 }
mass = 7
friction = 0.3

[[body]]
name = "head"
shape = "hull"
points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
velocity = [0, -1, 0]
spin = [1, 2, 3]
density = 2500
material = "glass"

[[body]]
shape = "mesh"
file = "vase.stl"
scale = [0.01, 0.01, 0.01]
sites = 64
seed = 7
pattern = "impact"
at = [0, 0.1, 0]
strength = 5
broken = true

[[body]]
shape = "ball"
radius = 0.25
corners = 12

[[collider]]
name = "ground"
shape = "plane"
restitution = 0.5
)");
    EXPECT_EQ(scene.name, "tower");
    EXPECT_EQ(scene.comment, "two\nlines");
    EXPECT_EQ(scene.gravity, (Double3{0, -1.62, 0}));
    EXPECT_EQ(scene.effects, (std::vector<std::string>{"gravity", "contacts", "restitution"}));
    EXPECT_EQ(scene.step.dt, 0.01);
    EXPECT_EQ(scene.step.steps, 12u);
    EXPECT_EQ(scene.step.solver, SolverKind::Hard);
    EXPECT_FALSE(scene.step.recycling);
    EXPECT_EQ(scene.budgets.pairs, 99u);
    EXPECT_EQ(scene.camera.eye, (Double3{1, 2, 3}));
    ASSERT_EQ(scene.bodies.size(), 4u);
    EXPECT_EQ(scene.bodies[0].mass, 7);
    EXPECT_FALSE(scene.bodies[0].density);
    EXPECT_NEAR(scene.bodies[0].turn[1], std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(scene.bodies[0].turn[3], std::sqrt(0.5), 1e-15);
    EXPECT_EQ(scene.bodies[1].shape.points.size(), 4u);
    EXPECT_EQ(scene.bodies[1].spin, (Double3{1, 2, 3}));
    EXPECT_EQ(scene.bodies[1].material, "glass");
    EXPECT_EQ(scene.bodies[2].shape.cells.sites, 64u);
    EXPECT_EQ(scene.bodies[2].shape.cells.pattern, Pattern::Impact);
    EXPECT_TRUE(scene.bodies[2].shape.cells.broken);
    EXPECT_EQ(scene.bodies[3].shape.corners, 12u);
    ASSERT_EQ(scene.colliders.size(), 1u);
    EXPECT_EQ(scene.colliders[0].surface.restitution, 0.5);
    EXPECT_EQ(countsOf(scene).bodies, 67u);
    EXPECT_EQ(countsOf(scene).pieces, 67u);
}

TEST(SmallSceneFile, RefusesUnknownKeysWithTheNearestOne) {
    EXPECT_EQ(refusalOf(kBody + "fricton = 1\n"), "scene.toml:3: unknown key 'fricton', did you mean 'friction'?");
    EXPECT_EQ(refusalOf("gravty = [0, 0, 0]\n" + kBody), "scene.toml:1: unknown key 'gravty', did you mean 'gravity'?");
    EXPECT_EQ(refusalOf("[stepp]\ndt = 0.1\n" + kBody), "scene.toml:1: unknown key 'stepp', did you mean 'step'?");
    EXPECT_EQ(refusalOf("[step]\nsubstep = 2\n" + kBody), "scene.toml:2: unknown key 'substep', did you mean 'substeps'?");
    EXPECT_EQ(refusalOf("[budgets]\nxyzzy = 2\n" + kBody),
              "scene.toml:2: unknown key 'xyzzy'; [budgets] has bodies, pieces, pairs, contacts, fragments, "
              "fragment_faces, fragment_triangles, most_fragments, breaking_bodies, breaking_sites, breaking_triangles, dust");
}

TEST(SmallSceneFile, RefusesUnknownNamesWithTheNearestOne) {
    EXPECT_EQ(refusalOf("[[body]]\nshape = \"bx\"\n"), "scene.toml:2: unknown 'bx' in 'shape', did you mean 'box'?");
    EXPECT_EQ(refusalOf("[[body]]\nshape = \"plane\"\n"),
              "scene.toml:2: unknown 'plane' in 'shape'; it has to be one of box, ball, hull, mesh");
    EXPECT_EQ(refusalOf("effects = [\"gravity\",\n  \"sleping\"]\n" + kBody),
              "scene.toml:2: unknown 'sleping' in 'effects', did you mean 'sleeping'?");
    EXPECT_EQ(refusalOf(kBody + "material = \"glas\"\n"),
              "scene.toml:3: body 0: unknown 'glas' in 'material', did you mean 'glass'?");
    EXPECT_NE(refusalOf("effects = [\"dust\", \"dust\"]\n" + kBody).find("scene.toml:1: 'effects' holds 'dust' twice"),
              std::string::npos);
}

struct Wrong {
    const char* line;
    const char* refusal;
};

TEST(SmallSceneFile, RefusesOtherTypesAndRangesAndSaysWhatIsAllowed) {
    for (const auto& [line, refusal] : std::vector<Wrong>{
             {"mass = \"heavy\"", "'mass' is a text; it has to be a number above 0 and at most 1e+13 (kg)"},
             {"friction = -0.5", "body 0: 'friction' is -0.5; it has to be a number from 0 to 10"},
             {"restitution = 1.5", "body 0: 'restitution' is 1.5; it has to be a number from 0 to 1"},
             {"restitution = nan", "body 0: 'restitution' is nan; it has to be a number from 0 to 1"},
             {"mass = 0", "body 0: 'mass' is 0; it has to be a number above 0 and at most 1e+13 (kg)"},
             {"mass = inf", "body 0: 'mass' is inf; it has to be"},
             {"place = [0, 1]", "'place' has a list of 2; it has to be three numbers"},
             {"place = 3", "'place' is a whole number; it has to be three numbers"},
             {"place = [0, inf, 0]", "body 0: 'place' holds inf; it has to be three numbers"},
             {"velocity = [1, \"x\", 0]", "'velocity' holds a text; it has to be three numbers"},
             {"turn = [0, 0, 0, 0]", "body 0: 'turn' is no turn, since its numbers are all 0"},
             {"turn = [0, 0, 1]", "'turn' has a list of 3; it has to be four numbers"},
             {"turn = { axis = [0, 0, 0], degrees = 3 }", "'turn' has no axis or no angle"},
             {"turn = { axis = [0, 1, 0] }", "'turn' is a table of something else"},
             {"size = [1, 0, 1]", "body 0: 'size' holds 0; it has to be three numbers, each above 0"},
             {"sites = 1.5", "'sites' is a number; it has to be a whole number from 0 to 1e+06"},
             {"sites = -1", "'sites' is -1; it has to be a whole number"},
             {"sites = 99999999", "body 0: 'sites' is 99999999; it has to be a whole number"},
             {"directions = 7", "body 0: 'directions' is 7; it has to be one of 6, 14, 26, 62"},
             {"broken = 1", "'broken' is a whole number; it has to be true or false"},
             {"broken = true", "body 0: 'broken' needs 'sites'"},
             {"inflate = 0.01", "body 0: 'inflate' needs 'sites'"},
             {"radius = 0.5", "'radius' means nothing to a box; leave it out"},
             {"name = 1979-05-27", "'name' is a date or time; it has to be a text"},
         }) {
        SCOPED_TRACE(line);
        EXPECT_EQ(refusalOf(kBody + line + "\n").find(std::string("scene.toml:3: ") + refusal), 0u) << refusalOf(kBody + line);
    }
}

TEST(SmallSceneFile, RefusesBodiesThatCannotBe) {
    for (const auto& [text, refusal] : std::vector<Wrong>{
             {"", "scene.toml:1: nothing is in the scene; give it a [[body]]"},
             {"[[body]]\nname = \"a\"\nmass = 1\ndensity = 1\n", "scene.toml:3: body 'a': has a 'density' and a 'mass'"},
             {"[[body]]\nshape = \"hull\"\n", "scene.toml:2: body 0: a hull needs 'points' or a 'file'"},
             {"[[body]]\nshape = \"mesh\"\nsites = 3\n", "scene.toml:2: body 0: a mesh needs a 'file'"},
             {"[[body]]\nshape = \"mesh\"\nfile = \"a.obj\"\n", "scene.toml:2: body 0: a mesh moves by its cells"},
             {"[[body]]\nname = \"a\"\n[[body]]\nname = \"a\"\n", "scene.toml:4: body 'a': another has this name"},
             {"[[body]]\nname = \"a/1.7\"\n", "scene.toml:2: body 'a/1.7': has a '/' in its name"},
             {"[[body]]\nname = \"lid\"\nshape = \"hull\"\npoints = [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]\n",
              "scene.toml:4: body 'lid': is no solid: coplanar points"},
             {"[[body]]\nsize = [1e-5, 1e-5, 1e-5]\ndensity = 1e-5\n", "scene.toml:3: body 0: weighs 1e-20 kg"},
             {"[[body]]\nsize = [1, 1, 1e-7]\n", "scene.toml:2: body 0: is no solid: coplanar points"},
             {"[body]\nshape = \"box\"\n", "scene.toml:1: 'body' is a table; write it as a table that begins with [[body]]"},
             {"step = 3\n[[body]]\n", "scene.toml:1: 'step' is a whole number; write it as a table that begins with [step]"},
             {"[budgets]\nbodies = 3\n[[body]]\nsites = 9\nbroken = true\n",
              "scene.toml:2: 'bodies' is 3, and the scene begins with 9"},
             {"[camera]\neye = [1, 1, 1]\ntarget = [1, 1, 1]\n[[body]]\n", "scene.toml:3: 'target' and 'eye' are one place"},
             {"[[body]]\n[[collider]]\nname = \"wall\"\nshape = \"box\"\nsize = [1, -1, 1]\n",
              "scene.toml:5: collider 'wall': 'size' holds -1"},
         }) {
        SCOPED_TRACE(text);
        EXPECT_EQ(refusalOf(text).find(refusal), 0u) << refusalOf(text);
    }
}

TEST(SmallSceneFile, RefusesWhatIsNoToml) {
    EXPECT_EQ(refusalOf("name = \"a\"\nbody = = 3\n").find("scene.toml:2: is no TOML: "), 0u);
    EXPECT_EQ(refusalOf("name = \"a\"\nname = \"b\"\n").find("scene.toml:2: is no TOML: "), 0u);
    EXPECT_EQ(refusalOf(std::string("\0\xff\xfe", 3)).find("scene.toml:1: is no TOML: "), 0u);
    refusalOf("a = " + std::string(5000, '[') + std::string(5000, ']'));
    EXPECT_NE(readScene(std::filesystem::path("/no/such/scene.toml")).error().message.find("no such file"), std::string::npos);
}

// ---- the table ------------------------------------------------------------------------------------------------------------

// A value of each kind that is allowed and not the default; false where a key has no other.
struct SetOther {
    const Allowed& allowed;
    double inRange() const {
        const double lower = std::isfinite(allowed.lower) ? allowed.lower : -1,
                     upper = std::isfinite(allowed.upper) ? allowed.upper : 1;
        return lower + 0.375 * (upper - lower);
    }
    bool operator()(double* x) const { return *x = inRange(), true; }
    bool operator()(std::optional<double>* x) const { return *x = inRange(), true; }
    bool operator()(uint32_t* x) const {
        return *x = allowed.numbers.empty() ? static_cast<uint32_t>(inRange()) : allowed.numbers.back(), true;
    }
    bool operator()(uint64_t* x) const { return *x = static_cast<uint64_t>(inRange()), true; }
    bool operator()(bool* x) const { return *x = !*x, true; }
    bool operator()(std::string* x) const {
        return *x = allowed.names.empty() ? "a \"b\" \\ \t\x01\x7f \n \xc3\xa9" : std::string(allowed.names.back()), true;
    }
    bool operator()(const ChoiceRef& x) const {
        return *x.number = static_cast<uint8_t>(*x.number == 0 ? allowed.names.size() - 1 : 0), true;
    }
    bool operator()(Double3* x) const { return *x = {inRange(), inRange() / 3, inRange() / 7}, true; }
    bool operator()(Quaternion* x) const { return *x = {0.1, -0.2, 1.0 / 3, 5}, true; }
    bool operator()(std::vector<Double3>* x) const { return *x = {{0, 0, 0}, {1, 0, 0}, {0, 1.0 / 3, 0}, {0, 0, 1e-3}}, true; }
    bool operator()(std::vector<std::string>* x) const { return *x = {std::string(allowed.names.back())}, true; }
};

// As written, whether or not the scene as a whole makes sense.
TEST(SmallSceneTable, EveryKeyIsWrittenWhereItIsNotUsual) {
    for (const SceneSection& section : sceneSections())
        for (const SceneKey& key : section.keys) {
            SCOPED_TRACE(headingOf(section) + " " + std::string(key.name));
            SceneDescription scene;
            for (const SceneSection& each : sceneSections())
                addOwner(scene, each.id);
            const std::string before = writeScene(scene);
            const ValueRef value = key.locate(ownerOf(scene, section.id, 0));
            ASSERT_TRUE(std::visit(SetOther{key.allowed}, value));
            EXPECT_FALSE(sameValue(value, defaultOf(section, key)));
            EXPECT_EQ(faultOf(value, key.allowed), "");
            const std::string after = writeScene(scene);
            EXPECT_NE(after, before);
            EXPECT_NE(after.find(std::string(key.name) + " = "), std::string::npos);
        }
}

TEST(SmallSceneTable, EveryKeySaysWhatItIs) {
    for (const SceneSection& section : sceneSections())
        for (const SceneKey& key : section.keys) {
            EXPECT_FALSE(key.meaning.empty()) << key.name;
            EXPECT_FALSE(describeAllowed(key).empty()) << key.name;
            EXPECT_EQ(faultOf(defaultOf(section, key), key.allowed), "") << key.name;
            EXPECT_EQ(findKey(section, key.name), &key) << "two keys are called " << key.name;
        }
}

TEST(SmallSceneTable, IsTheReferenceInTheReadme) {
    const std::string readme = support::fileBytes((support::sourceFolder() / "modules/brittle/scene/README.md").string());
    EXPECT_NE(readme.find(sceneKeyReference()), std::string::npos) << "put this into modules/brittle/scene/README.md:\n"
                                                                   << sceneKeyReference();
}

// ---- there and back again -------------------------------------------------------------------------------------------------

double anyDouble() {
    return *rc::gen::map(rc::gen::inRange(-1'000'000'000, 1'000'000'000), [](int x) { return x / 7.0e5; });
}
Double3 anyPoint() { return {anyDouble(), anyDouble(), anyDouble()}; }
double anyAbove(double lower, double upper) {
    return lower + (upper - lower) * (*rc::gen::inRange(1, 1'000'000)) / 1'000'000.0;
}

BodyDescription anyBody() {
    BodyDescription body;
    body.place = anyPoint();
    body.velocity = anyPoint();
    body.spin = anyPoint();
    body.turn = {anyAbove(0, 1), anyDouble() / 1e4, 0, anyAbove(0, 1)};
    body.surface = {anyAbove(0, 10), anyAbove(0, 1)};
    if (*rc::gen::arbitrary<bool>()) body.mass = anyAbove(0, 1e6);
    if (!body.mass && *rc::gen::arbitrary<bool>()) body.density = anyAbove(0, 1e4);
    body.material = *rc::gen::element<std::string>("", "glass", "ice");
    switch (*rc::gen::inRange(0, 3)) {
    case 0:
        body.shape.size = {anyAbove(0.1, 2), anyAbove(0.1, 2), anyAbove(0.1, 2)};
        body.shape.cells.sites = *rc::gen::inRange<uint32_t>(0, 1000);
        body.shape.cells.seed = *rc::gen::inRange<uint64_t>(0, 1ull << 53);
        body.shape.cells.broken = body.shape.cells.sites > 0;
        break;
    case 1:
        body.shape.kind = ShapeKind::Ball;
        body.shape.radius = anyAbove(0.1, 2);
        body.shape.corners = *rc::gen::inRange<uint32_t>(4, kMaxBallCorners + 1);
        break;
    default:
        body.shape.kind = ShapeKind::Hull;
        body.shape.points = {{0, 0, 0}, {anyAbove(0.1, 2), 0, 0}, {0, anyAbove(0.1, 2), 0}, {anyDouble(), 0, anyAbove(0.1, 2)}};
    }
    return body;
}

TEST(SmallSceneFile, WrittenIsReadAsTheSame) {
    EXPECT_TRUE(rc::check([] {
        SceneDescription scene;
        scene.name = *rc::gen::string<std::string>();
        std::erase_if(scene.name, [](char c) { return static_cast<unsigned char>(c) > 0x7f; });
        scene.gravity = {0, anyDouble(), 0};
        scene.step.dt = anyAbove(1e-6, 0.5);
        scene.step.steps = *rc::gen::inRange<uint32_t>(0, 1'000'000'000);
        scene.step.axes = *rc::gen::element(AxisKind::All, AxisKind::Fixed);
        const int bodies = *rc::gen::inRange(1, 5);
        for (int k = 0; k < bodies; ++k)
            scene.bodies.push_back(anyBody());
        RC_PRE(checkScene(scene).has_value());
        const auto again = readScene(writeScene(scene), "again.toml");
        RC_ASSERT(again.has_value());
        RC_ASSERT(*again == scene);
    }));
}

TEST(SmallSceneFile, NumbersKeepAllTheirBits) {
    SceneDescription scene;
    BodyDescription& body = scene.bodies.emplace_back();
    for (const double x : {1.0 / 3, 1e-300, 123456.789, -0.0, 5e-324, 9007199254740993.0 / 1e11, 1e6, 0.1 + 0.2}) {
        body.place = {x, -x / 3, 0};
        const auto again = readScene(writeScene(scene), "again.toml");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->bodies[0].place, body.place);
        EXPECT_EQ(std::signbit(again->bodies[0].place[0]), std::signbit(x)) << x;
    }
}

TEST(SmallSceneFile, ComesFromAFileAsFromText) {
    const std::string path = testing::TempDir() + "/brittle_scene_file.toml";
    std::ofstream(path) << kBody << "friction = 11\n";
    const auto scene = readScene(std::filesystem::path(path));
    std::filesystem::remove(path);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().message.find(path + ":3: body 0: 'friction' is 11"), 0u) << scene.error().message;
}

TEST(SmallNearestName, IsFewestLettersAway) {
    const std::string_view known[] = {"friction", "restitution", "spin", "size", "sites"};
    EXPECT_EQ(nearestName("fricton", known), "friction");
    EXPECT_EQ(nearestName("sptn", known), "spin");
    EXPECT_EQ(nearestName("spni", known), "spin");
    EXPECT_EQ(nearestName("sise", known), "size");
    EXPECT_EQ(nearestName("", known), "");
    EXPECT_EQ(nearestName("elephant", known), "");
    EXPECT_EQ(nearestName(std::string(1000, 'x'), known), "");
}

} // namespace
