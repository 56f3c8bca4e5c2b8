// What the plugin tells the engine of its classes, and how it is called.
#include "tests/godot/plugin_fixture.h"

namespace godot_test {
namespace {

using brittle_godot::CallError;

const char* const kFunctions[] = {
#define NAME(name, type) #name,
    BRITTLE_GODOT_FUNCTIONS(NAME)
#undef NAME
};

TEST_F(GodotPlugin, RefusesAnEngineThatLacksAnyFunction) {
    for (const char* name : kFunctions) {
        made->lacks_function = name;
        testing::internal::CaptureStderr();
        EXPECT_FALSE(made->load()) << name;
        EXPECT_NE(testing::internal::GetCapturedStderr().find(name), std::string::npos);
        EXPECT_TRUE(made->classes.empty());
    }
}

TEST_F(GodotPlugin, ComesAndGoesAnyNumberOfTimes) {
    for (int k = 0; k < 10; ++k) {
        load();
        EXPECT_EQ(made->classes.size(), 3u);
        made->free(made->make("BrittleWorld3D"));
        made->unload();
        EXPECT_TRUE(made->classes.empty());
    }
}

TEST_F(GodotPlugin, AnnouncesItsClassesWithHints) {
    load();
    EXPECT_EQ(made->classes.at("BrittleWorld3D")->parent, "Node3D");
    EXPECT_EQ(made->classes.at("BrittleBody3D")->parent, "MeshInstance3D");
    EXPECT_EQ(made->classes.at("BrittleMaterial")->parent, "Resource");
    const auto& effects = made->classes.at("BrittleWorld3D")->properties.at("effects");
    EXPECT_EQ(effects.hint, brittle_godot::kHintFlags);
    EXPECT_NE(effects.hint_string.find("Impact fracture:64"), std::string::npos);
    const auto& shape = made->classes.at("BrittleBody3D")->properties.at("shape");
    EXPECT_EQ(shape.hint, brittle_godot::kHintEnum);
    const auto& material = made->classes.at("BrittleBody3D")->properties.at("brittle_material");
    EXPECT_EQ(material.class_name, "BrittleMaterial");
    EXPECT_NE(made->classes.at("BrittleMaterial")->properties.at("density").hint_string.find("kg/m³"), std::string::npos);
    for (const char* name : {"fractured", "impact"}) {
        EXPECT_TRUE(made->classes.at("BrittleWorld3D")->signals.contains(name));
        EXPECT_TRUE(made->classes.at("BrittleBody3D")->signals.contains(name));
    }
}

std::vector<Any> rightArguments(const AnnouncedMethod& method) {
    std::vector<Any> arguments;
    for (const Announced& argument : method.arguments) {
        Any value;
        if (argument.type == Type::Int) value = Any(1);
        if (argument.type == Type::Float) value = Any(1.0);
        if (argument.type == Type::Bool) value = Any(true);
        if (argument.type == Type::String) value = Any("ice");
        if (argument.type == Type::Vector3) value = Any::vector3(1, 2, 3);
        if (argument.type == Type::PackedByteArray) value = Any::packed(argument.type, "abc", 3);
        arguments.push_back(value);
    }
    return arguments;
}

// Of each property the value that it begins with, and another, by both ways to call.
TEST_F(GodotPlugin, KeepsWhatItsPropertiesAreSetTo) {
    load();
    for (const auto& [name, announced] : made->classes) {
        Object* object = fresh(name.c_str());
        for (const auto& [property, described] : announced->properties) {
            if (described.type == Type::Object) continue;
            const Any before = made->get(object, property);
            EXPECT_EQ(before.type(), described.type) << property;
            const Any value = rightArguments(announced->methods.at(described.setter))[0];
            made->set(object, property, value);
            for (const Any& kept : {made->get(object, property), result(object, described.getter.c_str())}) {
                EXPECT_EQ(kept.asInt(), value.asInt()) << property;
                EXPECT_EQ(kept.asFloat(), value.asFloat()) << property;
                EXPECT_EQ(kept.asBool(), value.asBool()) << property;
                EXPECT_EQ(kept.asText(), value.asText()) << property;
                EXPECT_EQ(kept.asVector3(), value.asVector3()) << property;
            }
        }
    }
}

TEST_F(GodotPlugin, HoldsResourcesAsLongAsItsPropertiesDo) {
    load();
    Object* node = fresh("BrittleBody3D");
    uint64_t id = 0;
    {
        const Any material(made->make("BrittleMaterial"));
        id = material.asObject()->id;
        made->set(node, "brittle_material", material);
    }
    ASSERT_NE(made->find(id), nullptr);
    EXPECT_EQ(made->get(node, "brittle_material").asObject(), made->find(id));
    EXPECT_EQ(result(node, "get_brittle_material").asObject(), made->find(id));
    made->set(node, "brittle_material", Any());
    EXPECT_EQ(made->find(id), nullptr);
    EXPECT_TRUE(made->get(node, "brittle_material").isNull());
}

TEST_F(GodotPlugin, TakesNumbersForEachOther) {
    load();
    Object* node = fresh("BrittleBody3D");
    result(node, "set_mass", {Any(3)});
    EXPECT_EQ(result(node, "get_mass").asFloat(), 3);
    result(node, "set_cells", {Any(7.0)});
    EXPECT_EQ(result(node, "get_cells").asInt(), 7);
    result(node, "set_cells", {Any(-7)});
    EXPECT_EQ(result(node, "get_cells").asInt(), 0);
}

TEST_F(GodotPlugin, RefusesWrongArgumentsOfEveryMethod) {
    load();
    for (const auto& [name, announced] : made->classes) {
        Object* object = fresh(name.c_str());
        for (const auto& [method, described] : announced->methods) {
            const auto count = static_cast<int32_t>(described.arguments.size());
            const CallError many = made->call(object, method, std::vector<Any>(described.arguments.size() + 1)).error;
            EXPECT_EQ(many.error, brittle_godot::kCallTooManyArguments) << method;
            EXPECT_EQ(many.expected, count);
            if (count == 0) continue;
            EXPECT_EQ(made->call(object, method).error.error, brittle_godot::kCallTooFewArguments) << method;
            for (int32_t k = 0; k < count; ++k) {
                std::vector<Any> arguments = rightArguments(described);
                arguments[static_cast<size_t>(k)] = Any::rid(1);
                const CallError wrong = made->call(object, method, arguments).error;
                EXPECT_EQ(wrong.error, brittle_godot::kCallInvalidArgument) << method;
                EXPECT_EQ(wrong.argument, k);
                EXPECT_EQ(wrong.expected, static_cast<int32_t>(described.arguments[static_cast<size_t>(k)].type));
            }
        }
    }
}

TEST_F(GodotPlugin, GivesNoObjectWhereTheEngineMakesNone) {
    load();
    made->makes_nothing = true;
    EXPECT_EQ(made->make("BrittleWorld3D"), nullptr);
    EXPECT_EQ(made->make("BrittleMaterial"), nullptr);
}

TEST_F(GodotPlugin, DoesNothingInTheEditor) {
    load();
    made->is_editor = true;
    Object* node = world();
    body(node, boxMesh(*made, 1, 1, 1), 1);
    EXPECT_FALSE(node->fields.contains("processes"));
    EXPECT_FALSE(result(node, "is_started").asBool());
}

} // namespace
} // namespace godot_test
