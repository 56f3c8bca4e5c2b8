#include "modules/brittle/godot/interface/value.h"

#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/interface/names.h"

#include <array>

namespace brittle_godot {
namespace {

int32_t number(Type type) { return static_cast<int32_t>(type); }

void callFunction(void* user, const void* const*, int64_t, void*, CallError* error) {
    error->error = kCallOk;
    try {
        (*static_cast<std::function<void()>*>(user))();
    } catch (const std::exception& e) {
        tellError(e.what());
    }
}

void releaseFunction(void* user) { delete static_cast<std::function<void()>*>(user); }

// The message of a call on `what` that came to nothing.
std::string failureOf(const char* method, const CallError& error) {
    const std::string name = "'" + std::string(method) + "'";
    switch (error.error) {
    case kCallInvalidMethod: return "the engine has no method " + name;
    case kCallInstanceIsNull: return "the object that " + name + " was to be called on is gone";
    case kCallInvalidArgument: return name + " does not take what argument " + std::to_string(error.argument) + " is";
    default: return name + " could not be called, error " + std::to_string(error.error);
    }
}

} // namespace

Value::Value() { host().variant_new_nil(bytes_); }

Value::Value(bool value) {
    const uint8_t byte = value ? 1 : 0;
    takeFrom(Type::Bool, &byte);
}

Value::Value(int64_t value) { takeFrom(Type::Int, &value); }
Value::Value(double value) { takeFrom(Type::Float, &value); }
Value::Value(std::string_view utf8) { takeFrom(Type::String, Text(utf8).raw()); }
Value::Value(const Vec3& value) { takeFrom(Type::Vector3, &value); }
Value::Value(const Transform& value) { takeFrom(Type::Transform3d, &value); }

void Value::takeFrom(Type type, const void* value) {
    host().get_variant_from_type_constructor(number(type))(bytes_, const_cast<void*>(value));
}

Value Value::ofType(Type type, const void* value) {
    Value v{Unmade()};
    v.takeFrom(type, value);
    return v;
}

Value Value::copyOf(const void* variant) {
    Value v{Unmade()};
    host().variant_new_copy(v.bytes_, variant);
    return v;
}

Value Value::object(void* object) { return object == nullptr ? Value() : ofType(Type::Object, &object); }

Value Value::callable(std::function<void()> function) {
    alignas(8) std::byte bytes[kCallableBytes];
    CallableInfo info = {};
    info.user = new std::function<void()>(std::move(function));
    info.token = host().library;
    info.call = callFunction;
    info.release = releaseFunction;
    host().callable_custom_create2(bytes, &info);
    Value v = ofType(Type::Callable, bytes);
    host().variant_get_ptr_destructor(number(Type::Callable))(bytes);
    return v;
}

Value Value::empty(Type type) {
    Value v{Unmade()};
    CallError error = {};
    host().variant_construct(number(type), v.bytes_, nullptr, 0, &error);
    return v;
}

// The engine moves Variants by their bytes itself.
Value::Value(Value&& other) noexcept {
    std::memcpy(bytes_, other.bytes_, sizeof bytes_);
    host().variant_new_nil(other.bytes_);
}

Value& Value::operator=(Value other) noexcept {
    std::array<std::byte, kVariantBytes> kept;
    std::memcpy(kept.data(), bytes_, sizeof bytes_);
    std::memcpy(bytes_, other.bytes_, sizeof bytes_);
    std::memcpy(other.bytes_, kept.data(), sizeof bytes_);
    return *this;
}

Value::~Value() { host().variant_destroy(bytes_); }

void Value::giveTo(void* variant) const {
    host().variant_destroy(variant);
    host().variant_new_copy(variant, bytes_);
}

void Value::giveTo(Type type, void* value) const {
    if (const Destructor destroy = host().variant_get_ptr_destructor(number(type))) destroy(value);
    host().get_variant_to_type_constructor(number(type))(value, const_cast<std::byte*>(bytes_));
}

Type Value::type() const { return static_cast<Type>(host().variant_get_type(bytes_)); }

bool Value::isNull() const {
    const Type t = type();
    return t == Type::Nil || (t == Type::Object && asObject() == nullptr);
}

void* Value::inside() const { return host().variant_get_ptr_internal_getter(number(type()))(const_cast<std::byte*>(bytes_)); }

template <class T>
T Value::read() const {
    T value;
    std::memcpy(&value, inside(), sizeof value);
    return value;
}

bool Value::asBool() const { return type() == Type::Bool ? read<uint8_t>() != 0 : asInt() != 0; }

int64_t Value::asInt() const {
    switch (type()) {
    case Type::Int: return read<int64_t>();
    case Type::Bool: return read<uint8_t>();
    case Type::Float: return static_cast<int64_t>(read<double>());
    default: return 0;
    }
}

double Value::asFloat() const { return type() == Type::Float ? read<double>() : static_cast<double>(asInt()); }

std::string Value::asString() const {
    if (type() != Type::String) return "";
    const void* string = inside();
    std::string text(static_cast<size_t>(host().string_to_utf8_chars(string, nullptr, 0)), '\0');
    host().string_to_utf8_chars(string, text.data(), static_cast<int64_t>(text.size()));
    return text;
}

Vec3 Value::asVec3() const { return type() == Type::Vector3 ? read<Vec3>() : Vec3(); }
Transform Value::asTransform() const { return type() == Type::Transform3d ? read<Transform>() : Transform(); }

// By its id, since the pointer in a Variant stays when the object goes.
void* Value::asObject() const {
    return type() == Type::Object ? host().object_get_instance_from_id(host().variant_get_object_instance_id(bytes_)) : nullptr;
}

Value Value::call(const char* method, std::span<const Value> arguments) const {
    constexpr size_t kMostArguments = 12;
    std::array<const void*, kMostArguments> pointers = {};
    size_t count = 0;
    for (const Value& argument : arguments)
        pointers.at(count++) = argument.raw();
    Value result{Unmade()};
    CallError error = {};
    host().variant_call(const_cast<std::byte*>(bytes_), Name(method).raw(), pointers.data(), static_cast<int64_t>(count),
                        result.bytes_, &error);
    if (error.error != kCallOk) tellError(failureOf(method, error));
    return result;
}

Value Value::at(int64_t index) const {
    Value element{Unmade()};
    uint8_t is_valid = 0, is_outside = 0;
    host().variant_get_indexed(bytes_, index, element.bytes_, &is_valid, &is_outside);
    return element;
}

void Value::setAt(int64_t index, const Value& element) {
    uint8_t is_valid = 0, is_outside = 0;
    host().variant_set_indexed(bytes_, index, element.bytes_, &is_valid, &is_outside);
}

Value singleton(const char* name) { return Value::object(host().global_get_singleton(Name(name).raw())); }
Value newObject(const char* class_name) { return Value::object(host().classdb_construct_object2(Name(class_name).raw())); }

} // namespace brittle_godot
