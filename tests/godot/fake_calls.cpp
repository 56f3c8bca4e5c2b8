// How objects of the fake engine are called: by scripts, and by the plugin.
#include "tests/godot/fake_engine.h"

namespace godot_test {
namespace {

using namespace brittle_godot;

bool takes(Type asked, const Any& given) {
    if (asked == Type::Nil) return true; // anything
    if (asked == Type::Object) return given.type() == Type::Object || given.type() == Type::Nil;
    return given.type() == asked;
}

const EngineMethod* engineMethod(const FakeEngine& e, const Object& object, const std::string& method) {
    for (std::string name = object.class_name; !name.empty();) {
        if (const auto found = engineMethods().find(std::string(name).append(".").append(method));
            found != engineMethods().end())
            return &found->second;
        const auto extension = e.classes.find(name);
        name = extension != e.classes.end() ? extension->second->parent : parentOf(name);
    }
    return nullptr;
}

Called callExtension(Object& object, const AnnouncedMethod& method, const std::vector<Any>& arguments) {
    std::vector<const void*> variants;
    variants.reserve(arguments.size());
    for (const Any& argument : arguments)
        variants.push_back(argument.raw());
    Called called;
    method.info.call(method.info.user, object.instance, variants.data(), static_cast<int64_t>(variants.size()),
                     called.result.raw(), &called.error);
    return called;
}

} // namespace

Called FakeEngine::callMethod(Object* object, const std::string& method, const std::vector<Any>& arguments) {
    Called called;
    called.error.error = kCallInvalidMethod;
    if (method == lacks_method) return called;
    if (object->extension != nullptr)
        if (const auto own = object->extension->methods.find(method); own != object->extension->methods.end())
            return callExtension(*object, own->second, arguments);
    const EngineMethod* found = engineMethod(*this, *object, method);
    if (found == nullptr) {
        complain("there is no method " + object->class_name + "." + method);
        return called;
    }
    bool is_right = arguments.size() == found->arguments.size() || (method == "emit_signal" && !arguments.empty());
    for (size_t k = 0; is_right && k < found->arguments.size(); ++k)
        is_right = takes(found->arguments[k], arguments[k]);
    if (!is_right) complain(object->class_name + "." + method + " is called with wrong arguments");
    called.error.error = is_right ? kCallOk : kCallInvalidArgument;
    if (is_right) called.result = found->body(*this, *object, arguments);
    return called;
}

Called FakeEngine::call(Object* object, const std::string& method, const std::vector<Any>& arguments) {
    return callMethod(object, method, arguments);
}

// Plain calls hand over values of the announced types, and a result that is there already.
Any FakeEngine::get(Object* object, const std::string& property) {
    const AnnouncedMethod& getter = object->extension->methods.at(object->extension->properties.at(property).getter);
    const Type type = getter.result.type;
    alignas(8) std::byte value[64] = {};
    const auto construct =
        reinterpret_cast<void (*)(int32_t, void*, const void* const*, int32_t, CallError*)>(valueFunction("variant_construct"));
    CallError error = {};
    Any empty;
    if (type != Type::Object) {
        construct(static_cast<int32_t>(type), empty.raw(), nullptr, 0, &error);
        reinterpret_cast<TypeConstructor (*)(int32_t)>(valueFunction("get_variant_to_type_constructor"))(
            static_cast<int32_t>(type))(value, empty.raw());
    }
    getter.info.ptrcall(getter.info.user, object->instance, nullptr, value);
    Any result;
    if (type == Type::Object) {
        auto* held = *reinterpret_cast<Object**>(value);
        result = Any(held);
        if (held != nullptr) unreference(held); // what the getter has added
        return result;
    }
    reinterpret_cast<TypeConstructor (*)(int32_t)>(valueFunction("get_variant_from_type_constructor"))(
        static_cast<int32_t>(type))(result.raw(), value);
    if (const auto destroy =
            reinterpret_cast<Destructor (*)(int32_t)>(valueFunction("variant_get_ptr_destructor"))(static_cast<int32_t>(type)))
        destroy(value);
    return result;
}

void FakeEngine::set(Object* object, const std::string& property, const Any& value) {
    const AnnouncedMethod& setter = object->extension->methods.at(object->extension->properties.at(property).setter);
    Object* held = value.asObject();
    const void* plain = setter.arguments[0].type == Type::Object
                            ? &held
                            : reinterpret_cast<InternalGetter (*)(int32_t)>(valueFunction("variant_get_ptr_internal_getter"))(
                                  0)(const_cast<void*>(value.raw()));
    setter.info.ptrcall(setter.info.user, object->instance, &plain, nullptr);
}

} // namespace godot_test
