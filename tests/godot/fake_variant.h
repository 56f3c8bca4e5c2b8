// Values as a fake engine has them: each type as the C interface lays it out, and Variants of them. Every block of memory is on
// a ledger, so that what is destroyed twice, or never, is found.
#pragma once

#include "modules/brittle/godot/interface/gdextension.h"

#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace godot_test {

using brittle_godot::Type;

struct Object;

// What the plugin did that no engine would take. Tests expect none.
void complain(const std::string& what);
std::vector<std::string> takeComplaints();
size_t liveBlocks();

// A Variant of our own.
class Any {
public:
    Any();
    Any(bool value);
    Any(int value) : Any(static_cast<int64_t>(value)) {}
    Any(int64_t value);
    Any(double value);
    Any(const char* text) : Any(std::string(text)) {}
    Any(const std::string& text);
    Any(Object* object);
    static Any vector3(float x, float y, float z);
    static Any transform(const std::array<float, 12>& rows); // of the basis, then the origin
    static Any rid(uint64_t id);
    static Any array(const std::vector<Any>& elements);
    static Any packed(Type type, const void* elements, size_t count);
    static Any callable(std::function<void()> function);
    static Any copyOf(const void* variant);
    Any(const Any& other) { other.writeTo(bytes_); }
    Any& operator=(Any other) noexcept;
    ~Any();

    Type type() const;
    bool isNull() const;
    bool asBool() const;
    int64_t asInt() const;
    double asFloat() const;
    std::string asText() const;
    std::array<float, 3> asVector3() const;
    std::array<float, 12> asTransform() const;
    uint64_t asRid() const;
    Object* asObject() const; // NULL where it is gone
    std::vector<Any> asArray() const;
    size_t size() const;          // of arrays
    const void* elements() const; // of packed ones
    void resize(size_t count);
    void call() const; // a callable
    void* raw() { return bytes_; }
    const void* raw() const { return bytes_; }
    void writeTo(void* fresh_variant) const;

private:
    alignas(8) std::byte bytes_[brittle_godot::kVariantBytes];
};

// The functions of the C interface about values, by name; NULL where it is none of them.
brittle_godot::AnyFunction valueFunction(const std::string& name);

// Of objects, by the engine: looks one up by its id, and counts the references that Variants hold.
Object* findObject(uint64_t id);
uint64_t idOf(const Object* object);
void reference(Object* object);
void unreference(Object* object);

} // namespace godot_test
