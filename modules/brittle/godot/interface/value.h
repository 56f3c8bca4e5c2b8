// A Variant of the engine's, which owns what it holds: numbers, strings, arrays, objects. Objects that count references stay as
// long as a Value holds them; others may go, and calls on them then fail with a message instead of touching freed memory.
#pragma once

#include "modules/brittle/godot/interface/gdextension.h"

#include <cstring>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brittle_godot {

struct Vec2 {
    float x = 0, y = 0;
};
struct Vec3 {
    float x = 0, y = 0, z = 0;
};
// Rows of the basis, then the origin, as in the engine.
struct Transform {
    float basis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3 origin;
};

class Value {
public:
    Value();
    Value(bool value);
    Value(int value) : Value(static_cast<int64_t>(value)) {}
    Value(int64_t value);
    Value(double value);
    Value(const char* utf8) : Value(std::string_view(utf8)) {}
    Value(std::string_view utf8);
    Value(const Vec3& value);
    Value(const Transform& value);
    static Value object(void* object); // the engine's; NULL is null
    static Value callable(std::function<void()> function);
    static Value empty(Type type); // an empty array, a zero
    // PackedByteArray, -Int32-, -Int64-, -Float32-, -Vector2-, -Vector3Array of uint8_t, int32_t, int64_t, float, Vec2, Vec3.
    template <class T>
    static Value packed(std::span<const T> elements);

    Value(const Value& other) : Value(copyOf(other.bytes_)) {}
    Value(Value&& other) noexcept;
    Value& operator=(Value other) noexcept;
    ~Value();

    // Between Values and what the engine hands over: Variants, and values of a type it has named.
    static Value copyOf(const void* variant);
    static Value ofType(Type type, const void* value);
    void giveTo(void* variant) const;          // that holds something
    void giveTo(Type type, void* value) const; // of that type, which holds something; Value has to be of that type

    Type type() const;
    bool isNull() const; // nil or no object
    bool asBool() const;
    int64_t asInt() const;  // also of a float
    double asFloat() const; // also of an int
    std::string asString() const;
    Vec3 asVec3() const;
    Transform asTransform() const;
    void* asObject() const; // NULL: none
    template <class T>
    std::vector<T> asVector() const; // of a packed array; empty of anything else

    // Of objects, strings and arrays. A call that fails says so to the user and gives nil.
    Value call(const char* method, std::initializer_list<Value> arguments = {}) const {
        return call(method, std::span<const Value>(arguments.begin(), arguments.size()));
    }
    Value call(const char* method, std::span<const Value> arguments) const;
    Value at(int64_t index) const; // nil where there is none
    void setAt(int64_t index, const Value& element);

    void* raw() { return bytes_; }
    const void* raw() const { return bytes_; }

private:
    struct Unmade {};
    explicit Value(Unmade) {}
    void takeFrom(Type type, const void* value);
    void* inside() const; // what the Variant holds
    template <class T>
    T read() const;

    alignas(8) std::byte bytes_[kVariantBytes];
};

// Of what there is one of in the engine, as RenderingServer and Engine.
Value singleton(const char* name);
// A new object of a class of the engine's that counts references.
Value newObject(const char* class_name);

} // namespace brittle_godot
