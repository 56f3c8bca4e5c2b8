// Packed arrays: their elements lie in one block, which is copied at once.
#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/value.h"

namespace brittle_godot {
namespace {

template <class T>
struct Packed;
template <>
struct Packed<uint8_t> {
    static constexpr Type kType = Type::PackedByteArray;
    static void* first(void* array) { return host().packed_byte_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_byte_array_operator_index_const(array, 0); }
};
template <>
struct Packed<int32_t> {
    static constexpr Type kType = Type::PackedInt32Array;
    static void* first(void* array) { return host().packed_int32_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_int32_array_operator_index_const(array, 0); }
};
template <>
struct Packed<int64_t> {
    static constexpr Type kType = Type::PackedInt64Array;
    static void* first(void* array) { return host().packed_int64_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_int64_array_operator_index_const(array, 0); }
};
template <>
struct Packed<float> {
    static constexpr Type kType = Type::PackedFloat32Array;
    static void* first(void* array) { return host().packed_float32_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_float32_array_operator_index_const(array, 0); }
};
template <>
struct Packed<Vec2> {
    static constexpr Type kType = Type::PackedVector2Array;
    static void* first(void* array) { return host().packed_vector2_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_vector2_array_operator_index_const(array, 0); }
};
template <>
struct Packed<Vec3> {
    static constexpr Type kType = Type::PackedVector3Array;
    static void* first(void* array) { return host().packed_vector3_array_operator_index(array, 0); }
    static const void* first(const void* array) { return host().packed_vector3_array_operator_index_const(array, 0); }
};

} // namespace

template <class T>
Value Value::packed(std::span<const T> elements) {
    Value array = empty(Packed<T>::kType);
    if (elements.empty()) return array;
    array.call("resize", {static_cast<int64_t>(elements.size())});
    std::memcpy(Packed<T>::first(array.inside()), elements.data(), elements.size_bytes());
    return array;
}

template <class T>
std::vector<T> Value::asVector() const {
    if (type() != Packed<T>::kType) return {};
    std::vector<T> elements(static_cast<size_t>(call("size").asInt()));
    const void* array = inside();
    if (!elements.empty()) std::memcpy(elements.data(), Packed<T>::first(array), elements.size() * sizeof(T));
    return elements;
}

template Value Value::packed(std::span<const uint8_t>);
template Value Value::packed(std::span<const int32_t>);
template Value Value::packed(std::span<const int64_t>);
template Value Value::packed(std::span<const float>);
template Value Value::packed(std::span<const Vec2>);
template Value Value::packed(std::span<const Vec3>);
template std::vector<uint8_t> Value::asVector() const;
template std::vector<int32_t> Value::asVector() const;
template std::vector<int64_t> Value::asVector() const;
template std::vector<float> Value::asVector() const;
template std::vector<Vec2> Value::asVector() const;
template std::vector<Vec3> Value::asVector() const;

} // namespace brittle_godot
