#include "modules/brittle/godot/interface/class_record.h"

#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/interface/names.h"

namespace brittle_godot {
namespace {

constexpr BindingCallbacks kNoCallbacks = {nullptr, nullptr, nullptr};

// The engine leaves this to those who make an object, and it cannot go through a Variant: the first Variant of an object that
// counts references would be the last as well.
void notifyMade(void* object) {
    constexpr int64_t kHashOfNotification = 4023243586, kNotificationPostInitialize = 0;
    const void* method = host().classdb_get_method_bind(Name("Object").raw(), Name("notification").raw(), kHashOfNotification);
    if (method == nullptr) return;
    const int64_t what = kNotificationPostInitialize;
    const uint8_t is_reversed = 0;
    const void* const arguments[] = {&what, &is_reversed};
    host().object_method_bind_ptrcall(method, object, arguments, nullptr);
}

} // namespace

Hint range(const char* text) { return {kHintRange, text}; }

Instance* instanceBehind(void* object) {
    if (object == nullptr) return nullptr;
    return static_cast<Instance*>(host().object_get_instance_binding(object, host().library, nullptr));
}

ClassRecord::ClassRecord(const char* name, const char* parent, std::unique_ptr<Instance> (*make)())
    : name_(name), parent_(parent), make_(make) {}

void ClassRecord::method(const char* name, std::vector<Parameter> parameters, Parameter result, Body body) {
    methods_.push_back({name, std::move(parameters), std::move(result), std::move(body)});
}

void ClassRecord::property(const char* name, Type type, Hint hint, std::function<void(Instance&, const Value&)> set,
                           std::function<Value(Instance&)> get) {
    const bool is_resource = hint.kind == kHintResourceType;
    Parameter value = {"value", type, is_resource ? hint.text : "", is_resource};
    properties_.push_back({name, type, std::move(hint), "", ""});
    method(("set_" + std::string(name)).c_str(), {value}, {}, [set = std::move(set)](Instance& instance, Arguments arguments) {
        set(instance, arguments[0]);
        return Value();
    });
    method(("get_" + std::string(name)).c_str(), {}, value,
           [get = std::move(get)](Instance& instance, Arguments) { return get(instance); });
}

void ClassRecord::group(const char* title, const char* prefix) { properties_.push_back({"", Type::Nil, {}, title, prefix}); }

void ClassRecord::signal(const char* name, std::vector<Parameter> parameters) {
    signals_.push_back({name, std::move(parameters)});
}

void ClassRecord::constant(const char* enumeration, const char* name, int64_t value, bool is_flag) {
    constants_.push_back({enumeration, name, value, is_flag});
}

void* ClassRecord::create(void* record, uint8_t notifies) {
    const ClassRecord& made = *static_cast<ClassRecord*>(record);
    void* object = host().classdb_construct_object2(Name(made.parent_).raw());
    if (object == nullptr) return nullptr;
    Instance* instance = made.make_().release();
    instance->object_ = object;
    host().object_set_instance(object, Name(made.name_).raw(), instance);
    host().object_set_instance_binding(object, host().library, instance, &kNoCallbacks);
    if (notifies != 0) notifyMade(object);
    return object;
}

void ClassRecord::release(void*, void* instance) { delete static_cast<Instance*>(instance); }

void ClassRecord::notify(void* instance, int32_t what, uint8_t) {
    try {
        static_cast<Instance*>(instance)->notice(what);
    } catch (const std::exception& e) {
        tellError(e.what());
    }
}

} // namespace brittle_godot
