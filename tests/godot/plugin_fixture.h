// What tests of the plugin in the fake engine begin with.
#pragma once

#include "tests/godot/fake_engine.h"

#include <gtest/gtest.h>

namespace godot_test {

// An engine with the plugin in it, after which nothing is left and nothing was wrong.
class GodotPlugin : public testing::Test {
protected:
    GodotPlugin() {
        engineMethods();
        blocks_before_ = liveBlocks();
        takeComplaints();
        made = std::make_unique<FakeEngine>();
    }
    void load() { ASSERT_TRUE(made->load()); }

    void TearDown() override {
        for (Object* node : nodes_)
            made->free(node);
        kept_.clear();
        EXPECT_TRUE(made->instances.empty()) << "instances of the rendering server's are left";
        if (!made->classes.empty()) made->unload();
        EXPECT_TRUE(made->classes.empty()) << "classes are left";
        made.reset();
        EXPECT_EQ(liveBlocks(), blocks_before_) << "values are left";
        EXPECT_EQ(takeComplaints(), std::vector<std::string>());
    }

    // What is made here stays until the end.
    Object* fresh(const char* class_name) {
        Object* object = made->make(class_name);
        if (made->isA(*object, "RefCounted"))
            kept_.emplace_back(object);
        else
            nodes_.push_back(object);
        return object;
    }
    Object* world() {
        Object* node = fresh("BrittleWorld3D");
        made->addToTree(node);
        return node;
    }
    void forget(Object* node) { std::erase(nodes_, node); }

    Object* body(Object* world, Object* mesh, float height, const char* material = nullptr) {
        Object* node = made->make("BrittleBody3D");
        node->fields["mesh"] = Any(mesh);
        node->fields["transform"] = at(0, height, 0);
        if (material != nullptr) {
            const Any resource(made->make("BrittleMaterial"));
            made->set(resource.asObject(), "like", material);
            made->set(node, "brittle_material", resource);
        }
        made->addToTree(node, world);
        return node;
    }
    Object* floor(Object* world) {
        Object* node = made->make("BrittleBody3D");
        made->set(node, "kind", 2);
        made->set(node, "shape", 4);
        made->addToTree(node, world);
        return node;
    }
    static Any at(float x, float y, float z) { return Any::transform({1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z}); }
    static float heightOf(Object* node) { return node->fields.at("transform").asTransform()[10]; }
    Any result(Object* object, const char* method, const std::vector<Any>& arguments = {}) {
        const Called called = made->call(object, method, arguments);
        EXPECT_EQ(called.error.error, 0) << method;
        return called.result;
    }
    void strike(Object* world, float x, float y, float z) {
        EXPECT_TRUE(result(world, "damage", {Any::vector3(x, y, z), 0.1, 1e4}).asBool());
    }
    int64_t fragmentsOf(Object* world) { return result(world, "get_fragment_count").asInt(); }
    size_t emitted(const Object* object, const char* name) const {
        size_t count = 0;
        for (const Emission& e : made->emissions)
            count += e.object == object->id && e.name == name ? 1 : 0;
        return count;
    }
    bool told(const std::vector<std::string>& messages, const char* part) const {
        for (const std::string& message : messages)
            if (message.find(part) != std::string::npos) return true;
        return false;
    }

    std::unique_ptr<FakeEngine> made;

private:
    size_t blocks_before_ = 0;
    std::vector<Object*> nodes_;
    std::vector<Any> kept_;
};

// A thing on the floor, and one that can break above it.
struct Scene {
    Object *world, *floor, *cube;
};

class GodotWorld : public GodotPlugin {
protected:
    void SetUp() override { load(); }
    Scene scene() {
        Scene s = {};
        s.world = world();
        s.floor = floor(s.world);
        s.cube = body(s.world, boxMesh(*made, 0.4f, 0.4f, 0.4f), 0.5f, "glass");
        return s;
    }
};

} // namespace godot_test
