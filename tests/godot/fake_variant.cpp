// The functions of the C interface about values.
#include "tests/godot/fake_native.h"

#include <algorithm>

namespace godot_test {
namespace {

using brittle_godot::AnyFunction;
using brittle_godot::CallableInfo;
using brittle_godot::CallError;

int32_t typeOfVariant(const void* at) { return variantAt(at).type; }
brittle_godot::InternalGetter internalGetter(int32_t) { return insideOf; }

template <Type kType>
void typeFromVariant(void* to, void* from) {
    if (typeAt(from) != kType) return complain("a Variant is taken for another type than it is of");
    if (kType == Type::Object)
        *static_cast<Object**>(to) = static_cast<NativeObject*>(insideOf(from))->object;
    else
        copyNative(kType, to, insideOf(from));
}

template <Type kType>
void destroyType(void* at) {
    destroyNative(kType, at);
}

template <class Function, template <Type> class Of>
Function forType(int32_t number) {
    switch (static_cast<Type>(number)) {
#define CASE(name)                                                                                                             \
    case Type::name: return Of<Type::name>::function();
        CASE(Bool)
        CASE(Int)
        CASE(Float)
        CASE(String)
        CASE(Vector3)
        CASE(Transform3d)
        CASE(StringName)
        CASE(Rid)
        CASE(Object)
        CASE(Callable)
        CASE(Array)
        CASE(PackedByteArray)
        CASE(PackedInt32Array)
        CASE(PackedInt64Array)
        CASE(PackedFloat32Array)
        CASE(PackedVector2Array)
        CASE(PackedVector3Array)
#undef CASE
    default: complain("there is no type " + std::to_string(number)); return nullptr;
    }
}

template <Type kType>
struct FromType {
    static brittle_godot::TypeConstructor function() { return variantFromType<kType>; }
};
template <Type kType>
struct ToType {
    static brittle_godot::TypeConstructor function() { return typeFromVariant<kType>; }
};
template <Type kType>
struct Destroying { // none for what owns nothing
    static brittle_godot::Destructor function() {
        const bool owns = kType == Type::String || kType == Type::StringName || kType == Type::Array ||
                          kType == Type::Callable || elementOf(kType) != 0;
        return owns ? destroyType<kType> : nullptr;
    }
};

brittle_godot::TypeConstructor fromTypeConstructor(int32_t type) {
    return forType<brittle_godot::TypeConstructor, FromType>(type);
}
brittle_godot::TypeConstructor toTypeConstructor(int32_t type) { return forType<brittle_godot::TypeConstructor, ToType>(type); }
brittle_godot::Destructor destructorOf(int32_t type) { return forType<brittle_godot::Destructor, Destroying>(type); }

void newName(void* at, const char* latin1, uint8_t) { *static_cast<NativeText*>(at) = {tracked(new std::string(latin1))}; }
void newText(void* at, const char* utf8, int64_t size) {
    *static_cast<NativeText*>(at) = {tracked(new std::string(utf8, static_cast<size_t>(size)))};
}
int64_t readText(const void* at, char* to, int64_t room) {
    const std::string& text = *static_cast<const NativeText*>(at)->text;
    if (to != nullptr) text.copy(to, static_cast<size_t>(room));
    return static_cast<int64_t>(text.size());
}

void constructVariant(int32_t type, void* at, const void* const*, int32_t count, CallError* error) {
    if (count != 0) complain("this engine constructs empty values only");
    makeEmpty(at, static_cast<Type>(type));
    error->error = brittle_godot::kCallOk;
}

void getIndexed(const void* at, int64_t index, void* to, uint8_t* is_valid, uint8_t* is_outside) {
    const Variant& v = variantAt(at);
    *is_valid = typeAt(at) == Type::Array ? 1 : 0;
    *is_outside = 1;
    newNil(to);
    if (*is_valid == 0) return;
    const auto& elements = static_cast<NativeArray*>(v.value)->node->elements;
    *is_outside = index < 0 || static_cast<size_t>(index) >= elements.size() ? 1 : 0;
    if (*is_outside == 0) elements[static_cast<size_t>(index)].writeTo(to);
}

void setIndexed(void* at, int64_t index, const void* element, uint8_t* is_valid, uint8_t* is_outside) {
    const Variant& v = variantAt(at);
    *is_valid = typeAt(at) == Type::Array ? 1 : 0;
    auto* elements = *is_valid != 0 ? &static_cast<NativeArray*>(v.value)->node->elements : nullptr;
    *is_outside = elements == nullptr || index < 0 || static_cast<size_t>(index) >= elements->size() ? 1 : 0;
    if (*is_outside == 0)
        (*elements)[static_cast<size_t>(index)] = Any::copyOf(element);
    else
        complain("an element is set outside of an array");
}

template <size_t kElement, class Element = void, class Array = void>
Element* elementAt(Array* array, int64_t index) {
    const auto& packed = *static_cast<const NativePacked*>(array);
    if (!isTracked(packed.bytes) || packed.element != kElement) {
        complain("what is indexed as a packed array is none of that type");
        return nullptr;
    }
    if (index < 0 || static_cast<size_t>(index) * kElement >= packed.bytes->size()) {
        complain("a packed array is indexed outside of it");
        return nullptr;
    }
    return reinterpret_cast<Element*>(packed.bytes->data() + static_cast<size_t>(index) * kElement);
}

// The info is read now; what it says is released goes when the last Callable does.
void createCallable(void* at, CallableInfo* info) {
    Node* node = tracked(new Node);
    const CallableInfo kept = *info;
    node->function = [kept] {
        Any result;
        CallError error = {};
        kept.call(kept.user, nullptr, 0, result.raw(), &error);
        if (error.error != brittle_godot::kCallOk) complain("a callable says that it could not be called");
    };
    node->release = [kept] { kept.release(kept.user); };
    *static_cast<NativeCallable*>(at) = {node, nullptr};
}

template <class Function>
AnyFunction any(Function* function) {
    return reinterpret_cast<AnyFunction>(function);
}

} // namespace

AnyFunction valueFunction(const std::string& name) {
    static const std::pair<const char*, AnyFunction> functions[] = {
        {"string_name_new_with_latin1_chars", any(newName)},
        {"string_new_with_utf8_chars_and_len", any(newText)},
        {"string_to_utf8_chars", any(readText)},
        {"variant_new_nil", any(newNil)},
        {"variant_new_copy", any(newCopy)},
        {"variant_destroy", any(destroyVariant)},
        {"variant_get_type", any(typeOfVariant)},
        {"variant_construct", any(constructVariant)},
        {"variant_get_indexed", any(getIndexed)},
        {"variant_set_indexed", any(setIndexed)},
        {"variant_get_object_instance_id", any(idInVariant)},
        {"get_variant_from_type_constructor", any(fromTypeConstructor)},
        {"get_variant_to_type_constructor", any(toTypeConstructor)},
        {"variant_get_ptr_internal_getter", any(internalGetter)},
        {"variant_get_ptr_destructor", any(destructorOf)},
        {"packed_byte_array_operator_index", any(elementAt<1, uint8_t>)},
        {"packed_byte_array_operator_index_const", any(elementAt<1, const uint8_t, const void>)},
        {"packed_int32_array_operator_index", any(elementAt<4, int32_t>)},
        {"packed_int32_array_operator_index_const", any(elementAt<4, const int32_t, const void>)},
        {"packed_float32_array_operator_index", any(elementAt<4, float>)},
        {"packed_float32_array_operator_index_const", any(elementAt<4, const float, const void>)},
        {"packed_int64_array_operator_index", any(elementAt<8, int64_t>)},
        {"packed_int64_array_operator_index_const", any(elementAt<8, const int64_t, const void>)},
        {"packed_vector2_array_operator_index", any(elementAt<8>)},
        {"packed_vector2_array_operator_index_const", any(elementAt<8, void, const void>)},
        {"packed_vector3_array_operator_index", any(elementAt<12>)},
        {"packed_vector3_array_operator_index_const", any(elementAt<12, void, const void>)},
        {"callable_custom_create2", any(createCallable)}};
    for (const auto& [known, function] : functions)
        if (name == known) return function;
    return nullptr;
}

} // namespace godot_test
