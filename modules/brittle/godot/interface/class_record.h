// What the engine is told of a class of ours: methods, properties, signals and constants, each said once. The engine calls them
// with Variants or with plain values; both come here as Values, checked for number and type.
#pragma once

#include "modules/brittle/godot/interface/value.h"

#include <deque>
#include <memory>

namespace brittle_godot {

// What is behind an object of a class of ours. Lives as long as the object, which the engine frees.
class Instance {
public:
    virtual ~Instance() = default;
    Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    virtual void notice(int /*what*/) {} // the engine's NOTIFICATION_...
    // The object, once it has one: not in the constructor. Of an object that counts references only while it is held.
    Value self() const { return Value::object(object_); }
    void* object() const { return object_; }

private:
    friend class ClassRecord;
    void* object_ = nullptr;
};

// The instance behind an object, NULL where it is not one of ours.
Instance* instanceBehind(void* object);
template <class T>
T* instanceOf(const Value& object) {
    return dynamic_cast<T*>(instanceBehind(object.asObject()));
}

struct Parameter {
    std::string name;
    Type type = Type::Nil;
    std::string class_name;  // of objects
    bool is_counted = false; // an object that counts references
};

// How a property is shown: a range with its unit, names to choose from, flags, the class of a resource.
struct Hint {
    PropertyHint kind = kHintNone;
    std::string text;
};
Hint range(const char* text);

using Arguments = std::span<const Value>;

class ClassRecord {
public:
    using Body = std::function<Value(Instance&, Arguments)>;

    ClassRecord(const char* name, const char* parent, std::unique_ptr<Instance> (*make)());
    ClassRecord(const ClassRecord&) = delete;
    ClassRecord& operator=(const ClassRecord&) = delete;

    void method(const char* name, std::vector<Parameter> parameters, Parameter result, Body body);
    // As set_NAME and get_NAME, which are methods as well.
    void property(const char* name, Type type, Hint hint, std::function<void(Instance&, const Value&)> set,
                  std::function<Value(Instance&)> get);
    void group(const char* title, const char* prefix = ""); // of the properties that follow
    void signal(const char* name, std::vector<Parameter> parameters);
    void constant(const char* enumeration, const char* name, int64_t value, bool is_flag = false);

    // At the engine's. The record stays until the class has been withdrawn.
    void announce();
    void withdraw();
    const char* name() const { return name_; }

private:
    struct Method {
        std::string name;
        std::vector<Parameter> parameters;
        Parameter result;
        Body body;
    };
    struct Property {
        std::string name;
        Type type;
        Hint hint;
        std::string title, prefix; // of a group, which has no name
    };
    struct Signal {
        const char* name;
        std::vector<Parameter> parameters;
    };
    struct Constant {
        const char *enumeration, *name;
        int64_t value;
        bool is_flag;
    };

    static void* create(void* record, uint8_t notifies);
    static void release(void* record, void* instance);
    static void notify(void* instance, int32_t what, uint8_t reversed);
    static void call(void* method, void* instance, const void* const* variants, int64_t count, void* result, CallError* error);
    static void callPlain(void* method, void* instance, const void* const* values, void* result);
    static Value run(const Method& method, void* instance, Arguments arguments);
    void announceMethod(Method& method) const;
    void announceProperty(const Property& property) const;
    void announceSignal(const Signal& signal) const;
    void announceConstant(const Constant& constant) const;

    const char *name_, *parent_;
    std::unique_ptr<Instance> (*make_)();
    std::deque<Method> methods_; // stay where they are: the engine has their addresses
    std::vector<Property> properties_;
    std::vector<Signal> signals_;
    std::vector<Constant> constants_;
};

} // namespace brittle_godot
