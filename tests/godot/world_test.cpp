// Worlds of the plugin's in the fake engine: on a device of their own and on the engine's.
#include "tests/abi/host_device.h"
#include "tests/godot/plugin_fixture.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace godot_test {
namespace {

constexpr double kFrame = 1.0 / 60;

TEST_F(GodotWorld, StartsInTheFirstFrameAndMovesItsNodes) {
    const Scene s = scene();
    EXPECT_TRUE(s.world->fields.at("processes").asBool());
    made->frame(s.world, kFrame);
    EXPECT_TRUE(result(s.world, "is_started").asBool());
    EXPECT_FALSE(result(s.world, "is_on_engine_device").asBool());
    EXPECT_FALSE(result(s.world, "get_device_name").asText().empty());
    for (int k = 0; k < 9; ++k)
        made->frame(s.world, kFrame);
    const double fallen = 9.81 / 2 * std::pow(10 * kFrame, 2);
    EXPECT_NEAR(heightOf(s.cube), 0.5 - fallen, 0.1 * fallen);
    EXPECT_EQ(emitted(s.world, "started"), 1u);
}

TEST_F(GodotWorld, MakesStepsAsLongAsItSaysWhateverAFrameIs) {
    const Scene s = scene();
    for (int k = 0; k < 6; ++k)
        made->frame(s.world, kFrame);
    const auto hash = result(s.world, "hash_state").asInt();
    EXPECT_TRUE(result(s.world, "restart").asBool());
    for (int k = 0; k < 12; ++k)
        made->frame(s.world, kFrame / 2);
    EXPECT_EQ(result(s.world, "hash_state").asInt(), hash);
    EXPECT_TRUE(result(s.world, "restart").asBool());
    for (int k = 0; k < 2; ++k)
        made->frame(s.world, 3 * kFrame);
    EXPECT_EQ(result(s.world, "hash_state").asInt(), hash);
    made->set(s.world, "active", false);
    made->frame(s.world, 1);
    EXPECT_EQ(result(s.world, "hash_state").asInt(), hash);
}

TEST_F(GodotWorld, DrawsFragmentsAndTellsWhatBroke) {
    const Scene s = scene();
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->frame(s.world, kFrame);
    EXPECT_EQ(emitted(s.cube, "fractured"), 1u);
    EXPECT_EQ(emitted(s.world, "fractured"), 1u);
    EXPECT_GE(emitted(s.cube, "impact"), 1u) << "a blow that breaks is one";
    EXPECT_FALSE(result(s.cube, "is_whole", {0}).asBool());
    EXPECT_EQ(s.cube->fields.at("base").asRid(), 0u) << "the node still draws its mesh";
    const auto count = static_cast<size_t>(fragmentsOf(s.world));
    EXPECT_GT(count, 1u);
    EXPECT_EQ(made->instances.size(), count);
    const Any ids = result(s.world, "get_fragments");
    ASSERT_EQ(ids.size(), count);
    for (size_t k = 0; k < count; ++k) {
        const Any id(static_cast<const int64_t*>(ids.elements())[k]);
        const auto place = result(s.world, "get_fragment_transform", {id}).asTransform();
        EXPECT_LT(std::fabs(place[9]) + std::fabs(place[10] - 0.5f) + std::fabs(place[11]), 0.8f);
        EXPECT_EQ(result(s.world, "get_fragment_body", {id}).asObject(), s.cube);
        EXPECT_GT(result(s.world, "get_fragment_mesh", {id}).asObject()->fields.at("surfaces").size(), 0u);
    }
}

// A cube that falls onto a plane, which is a node as well.
TEST_F(GodotWorld, TellsOfWhatWasHitAndDidNotBreak) {
    Scene s = {};
    s.world = world();
    s.floor = floor(s.world);
    s.cube = body(s.world, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f);
    for (int k = 0; k < 40; ++k)
        made->frame(s.world, kFrame);
    ASSERT_EQ(emitted(s.cube, "fractured"), 0u);
    EXPECT_GE(emitted(s.cube, "impact"), 1u);
    EXPECT_EQ(emitted(s.world, "impact"), emitted(s.cube, "impact")) << "once, however many nodes were in it";
}

TEST_F(GodotWorld, GoesBackToStatesAndToTheStart) {
    const Scene s = scene();
    EXPECT_TRUE(result(s.world, "step", {5}).asBool());
    const Any state = result(s.world, "save_state");
    const auto hash = result(s.world, "hash_state").asInt();
    const float height = heightOf(s.cube);
    strike(s.world, 0.2f, 0.5f, 0);
    result(s.world, "step", {3});
    EXPECT_GT(fragmentsOf(s.world), 0);
    EXPECT_TRUE(result(s.world, "restore_state", {state}).asBool());
    EXPECT_EQ(result(s.world, "hash_state").asInt(), hash);
    EXPECT_EQ(fragmentsOf(s.world), 0);
    EXPECT_TRUE(made->instances.empty());
    EXPECT_TRUE(result(s.cube, "is_whole", {0}).asBool());
    EXPECT_EQ(heightOf(s.cube), height);
    EXPECT_TRUE(result(s.world, "restart").asBool());
    EXPECT_EQ(heightOf(s.cube), 0.5f);
    EXPECT_FALSE(result(s.world, "restore_state", {Any::packed(Type::PackedByteArray, "abc", 3)}).asBool());
    EXPECT_TRUE(told(made->errors, "restore_state"));
}

TEST_F(GodotWorld, MakesABodyOfEachInstanceOfAMultiMesh) {
    Scene s = scene();
    Object* copies = fresh("MultiMesh");
    const float places[] = {1, 0, 0, 2, 0, 1, 0, .2f, 0, 0, 1, 0, /**/ 1, 0, 0, 4, 0, 1, 0, .2f, 0, 0, 1, 0};
    copies->fields["mesh"] = Any(boxMesh(*made, 0.4f, 0.4f, 0.4f));
    copies->fields["count"] = 2;
    copies->fields["buffer"] = Any::packed(Type::PackedFloat32Array, places, 24);
    Object* node = body(s.world, nullptr, 0, "glass");
    made->set(node, "copies", copies);
    ASSERT_TRUE(result(s.world, "step", {1}).asBool()) << (made->errors.empty() ? "" : made->errors[0]);
    strike(s.world, 4.2f, 0.2f, 0);
    result(s.world, "step", {1});
    EXPECT_TRUE(result(node, "is_whole", {0}).asBool());
    EXPECT_FALSE(result(node, "is_whole", {1}).asBool());
    EXPECT_EQ(emitted(node, "fractured"), 1u);
    EXPECT_EQ(made->emissions.back().arguments.back().asInt(), 1) << "it was the other copy";
    const auto* kept = static_cast<const float*>(copies->fields.at("buffer").elements());
    EXPECT_TRUE(std::equal(std::begin(places), std::end(places), kept)) << "what was given has been changed";
}

TEST_F(GodotWorld, SaysWhatCannotStart) {
    const struct {
        const char* property;
        Any value;
        const char* message;
    } wrongs[] = {{"density", Any(-1.0), "'density' is -1"},
                  {"shape", Any(4), "a plane does not move"},
                  {"restitution", Any(2.0), "restitution"},
                  {"pattern", Any(9), "'pattern'"}};
    for (const auto& wrong : wrongs) {
        const Scene s = scene();
        made->set(s.cube, wrong.property, wrong.value);
        EXPECT_FALSE(result(s.world, "start").asBool());
        EXPECT_TRUE(told(made->errors, wrong.message)) << wrong.message;
        const size_t errors = made->errors.size();
        made->frame(s.world, kFrame);
        EXPECT_EQ(made->errors.size(), errors) << "it says so in every frame";
    }
    EXPECT_FALSE(result(world(), "start").asBool());
    EXPECT_TRUE(told(made->errors, "there is no BrittleBody3D below it"));
    Object* empty = world();
    body(empty, nullptr, 1);
    EXPECT_FALSE(result(empty, "start").asBool());
    EXPECT_TRUE(told(made->errors, "its mesh has no triangles"));
}

TEST_F(GodotWorld, RefusesMeshesWhoseIndicesLeadNowhere) {
    Object* mesh = boxMesh(*made, 1, 1, 1);
    const int32_t indices[] = {0, 1, -5, 0, 1, 800};
    auto arrays = mesh->fields.at("surfaces").asArray()[0].asArray();
    arrays[12] = Any::packed(Type::PackedInt32Array, indices, 6);
    mesh->fields["surfaces"] = Any::array({Any::array(arrays)});
    Object* node = world();
    body(node, mesh, 1);
    EXPECT_FALSE(result(node, "start").asBool());
    EXPECT_TRUE(told(made->errors, "an index beyond its vertices"));
}

TEST_F(GodotWorld, RefusesCallsBeforeTheStartWithAMessage) {
    const Scene s = scene();
    EXPECT_FALSE(result(s.world, "damage", {Any::vector3(0, 0, 0), 1.0, 1.0}).asBool());
    EXPECT_EQ(result(s.world, "save_state").size(), 0u);
    EXPECT_EQ(result(s.world, "hash_state").asInt(), 0);
    EXPECT_TRUE(result(s.world, "get_fragment_mesh", {5}).isNull());
    EXPECT_TRUE(told(made->errors, "the world has not been started"));
    EXPECT_TRUE(told(made->errors, "there is no fragment 5"));
}

// Nodes go, also while they are told of.
TEST_F(GodotWorld, OutlivesItsBodies) {
    const Scene s = scene();
    Object* other = body(s.world, boxMesh(*made, 0.4f, 0.4f, 0.4f), 3, "glass");
    result(s.world, "step", {1});
    made->free(s.cube);
    EXPECT_TRUE(result(s.world, "step", {1}).asBool());
    strike(s.world, 0.2f, 0.5f, 0);
    EXPECT_TRUE(result(s.world, "step", {1}).asBool());
    EXPECT_EQ(fragmentsOf(s.world), 0) << "fragments of what has no node look like nothing";
    made->free(other);
    EXPECT_TRUE(result(s.world, "step", {1}).asBool());
}

TEST_F(GodotWorld, MayBeFreedByWhoeverHearsOfABreak) {
    const Scene s = scene();
    const uint64_t world_id = s.world->id;
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->listener = [&](const Emission& e) {
        if (e.name != "impact" || made->find(world_id) == nullptr) return;
        forget(s.world);
        made->free(s.world);
    };
    made->frame(s.world, kFrame);
    EXPECT_EQ(made->find(world_id), nullptr);
    made->listener = nullptr;
}

TEST_F(GodotWorld, MayBeFreedByWhoeverHearsThatItHasStarted) {
    const Scene s = scene();
    const uint64_t world_id = s.world->id;
    made->listener = [&](const Emission& e) {
        if (e.name != "started") return;
        forget(s.world);
        made->free(s.world);
    };
    made->frame(s.world, kFrame);
    made->listener = nullptr;
    EXPECT_EQ(made->find(world_id), nullptr);
}

TEST_F(GodotWorld, MayBeginAnewWhileItTells) {
    const Scene s = scene();
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->listener = [&](const Emission& e) {
        if (e.name == "fractured" && e.object == s.world->id) result(s.world, "restart");
    };
    made->frame(s.world, kFrame);
    EXPECT_TRUE(result(s.world, "is_started").asBool());
    EXPECT_EQ(fragmentsOf(s.world), 0);
    strike(s.world, 0.2f, 0.5f, 0);
    EXPECT_FALSE(result(s.world, "step", {5}).asBool()) << "these are steps of a world that is no more";
    made->listener = nullptr;
    EXPECT_EQ(fragmentsOf(s.world), 0);
    EXPECT_TRUE(result(s.cube, "is_whole", {0}).asBool());
}

TEST_F(GodotWorld, EndsWhenItLeavesTheTree) {
    const Scene s = scene();
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->frame(s.world, kFrame);
    EXPECT_FALSE(made->instances.empty());
    made->removeFromTree(s.world);
    EXPECT_FALSE(result(s.world, "is_started").asBool());
    EXPECT_TRUE(made->instances.empty());
}

TEST_F(GodotWorld, HidesFragmentsWithItsNode) {
    constexpr int kVisibilityChanged = 43;
    const Scene s = scene();
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->frame(s.world, kFrame);
    s.world->fields["visible"] = false;
    made->notify(s.world, kVisibilityChanged);
    for (const auto& [id, instance] : made->instances)
        EXPECT_FALSE(instance.is_visible);
}

TEST_F(GodotWorld, SaysWhichMethodAnEngineLacks) {
    made->lacks_method = "instance_create2";
    const Scene s = scene();
    made->frame(s.world, kFrame);
    strike(s.world, 0.2f, 0.5f, 0);
    made->frame(s.world, kFrame);
    EXPECT_TRUE(told(made->errors, "the engine has no method 'instance_create2'"));
    EXPECT_EQ(fragmentsOf(s.world), 0);
}

class GodotDevice : public GodotPlugin {
protected:
    // Once the engine is gone, and with it its render thread.
    ~GodotDevice() override { EXPECT_EQ(device_ ? device_->messages() : 0, 0u) << "messages from the validation layers"; }
    void offerDevice() {
        const BrittleVulkan v = device_.emplace().vulkan();
        made->driver_resources = {reinterpret_cast<uint64_t>(v.device), reinterpret_cast<uint64_t>(v.physical_device),
                                  reinterpret_cast<uint64_t>(v.instance), reinterpret_cast<uint64_t>(v.queue), v.queue_family};
    }
    int64_t hashOfBreak(bool on_own_device) {
        Object* node = world();
        floor(node);
        body(node, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f, "glass");
        if (on_own_device) made->set(node, "device", 1);
        result(node, "step", {2});
        EXPECT_NE(result(node, "is_on_engine_device").asBool(), on_own_device);
        strike(node, 0.2f, 0.5f, 0);
        result(node, "step", {8});
        EXPECT_GT(fragmentsOf(node), 1);
        const int64_t hash = result(node, "hash_state").asInt();
        forget(node);
        made->free(node);
        return hash;
    }

private:
    std::optional<abi_test::HostDevice> device_;
};

using SmallGodotDevice = GodotDevice;

TEST_F(GodotDevice, IsTheEnginesAndComesToTheSameThere) {
    offerDevice();
    load();
    EXPECT_EQ(hashOfBreak(false), hashOfBreak(true));
}

TEST_F(GodotDevice, IsUsedOnTheEnginesRenderThreadAlone) {
    offerDevice();
    made->draws_on_own_thread = true;
    load();
    hashOfBreak(false);
}

// What breaks takes too long under the layers.
TEST_F(SmallGodotDevice, IsUsedOnTheRenderThreadAsVulkanWantsIt) {
    offerDevice();
    made->draws_on_own_thread = true;
    load();
    Object* node = world();
    constexpr int kGravityContactsFriction = 7;
    made->set(node, "effects", kGravityContactsFriction);
    floor(node);
    Object* cube = body(node, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f);
    constexpr int kBox = 2; // a mesh would be cut into cells
    made->set(cube, "shape", kBox);
    for (int k = 0; k < 4; ++k)
        made->frame(node, kFrame);
    EXPECT_TRUE(result(node, "is_on_engine_device").asBool());
    EXPECT_TRUE(result(node, "step", {6}).asBool());
    EXPECT_LT(heightOf(cube), 0.49f);
    forget(node);
    made->free(node);
}

// There a frame posts its steps and takes in those before.
TEST_F(GodotDevice, LosesNoStepWhereTheRenderThreadIsLate) {
    offerDevice();
    load();
    Object* node = world();
    floor(node);
    body(node, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f, "glass");
    for (int k = 0; k < 20; ++k)
        made->frame(node, kFrame);
    const auto hash = result(node, "hash_state").asInt();
    forget(node);
    made->free(node);
    made->draws_on_own_thread = true;
    node = world();
    floor(node);
    Object* cube = body(node, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f, "glass");
    ASSERT_TRUE(result(node, "start").asBool());
    for (int k = 0; k < 20; ++k) {
        made->frame(node, kFrame);
        result(node, "hash_state"); // waits for what was posted
    }
    EXPECT_EQ(result(node, "hash_state").asInt(), hash);
    made->frame(node, 0);
    EXPECT_LT(heightOf(cube), 0.5f);
}

TEST_F(GodotDevice, IsOfItsOwnWhereTheEngineGivesNone) {
    made->driver_resources = {0, 0, 0, 0, 0};
    load();
    hashOfBreak(true);
    Object* node = world();
    body(node, boxMesh(*made, 1, 1, 1), 1);
    EXPECT_TRUE(result(node, "start").asBool());
    EXPECT_FALSE(result(node, "is_on_engine_device").asBool());
    EXPECT_TRUE(told(made->warnings, "Brittle works on a Vulkan device of its own"));
}

TEST_F(GodotDevice, IsOfItsOwnWhereTheEngineDrawsOtherwise) {
    made->driver_resources = {1, 2, 3, 4, 0};
    made->driver = "d3d12";
    load();
    Object* node = world();
    body(node, boxMesh(*made, 1, 1, 1), 1);
    EXPECT_TRUE(result(node, "start").asBool());
    EXPECT_TRUE(told(made->warnings, "the engine draws by d3d12"));
}

} // namespace
} // namespace godot_test
