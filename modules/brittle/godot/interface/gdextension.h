// Godot's C interface for extensions as far as the plugin uses it: layouts, numbers and signatures, all of them there since
// Godot 4.4. Values of Godot's own types are passed by address; what a function makes goes to memory that holds nothing yet.
// The test godot_interface holds each line to the header and the list of classes that the engine itself dumps.
#pragma once

#include <cstddef>
#include <cstdint>

namespace brittle_godot {

// Of what a Variant may hold, those that the plugin meets.
enum class Type : int32_t {
    Nil = 0,
    Bool = 1,
    Int = 2,
    Float = 3,
    String = 4,
    Vector3 = 9,
    Transform3d = 18,
    StringName = 21,
    Rid = 23,
    Object = 24,
    Callable = 25,
    Array = 28,
    PackedByteArray = 29,
    PackedInt32Array = 30,
    PackedInt64Array = 31,
    PackedFloat32Array = 32,
    PackedVector2Array = 35,
    PackedVector3Array = 36
};

constexpr size_t kVariantBytes = 24, kStringBytes = 8, kStringNameBytes = 8, kCallableBytes = 16;

enum CallOutcome : int32_t {
    kCallOk = 0,
    kCallInvalidMethod = 1,
    kCallInvalidArgument = 2,
    kCallTooManyArguments = 3,
    kCallTooFewArguments = 4,
    kCallInstanceIsNull = 5
};

struct CallError {
    int32_t error;
    int32_t argument; // which, of a wrong one
    int32_t expected; // the type, or how many
};

enum PropertyHint : uint32_t { kHintNone = 0, kHintRange = 1, kHintEnum = 2, kHintFlags = 6, kHintResourceType = 17 };
enum PropertyUsage : uint32_t { kUsageNone = 0, kUsageStored = 2, kUsageShown = 4 };
enum MethodFlag : uint32_t { kMethodNormal = 1 };

struct PropertyInfo {
    Type type;
    void* name;       // StringName
    void* class_name; // StringName
    uint32_t hint;
    void* hint_string; // String
    uint32_t usage;
};

// Classes. An instance is ours, the object that it belongs to is the engine's.
using CreateInstance = void* (*)(void* class_user, uint8_t notifies); // the object
using FreeInstance = void (*)(void* class_user, void* instance);
using Notify = void (*)(void* instance, int32_t what, uint8_t reversed);
using AnyFunction = void (*)(); // of those we leave out

struct ClassInfo {
    uint8_t is_virtual, is_abstract, is_exposed, is_runtime;
    const void* icon_path; // String
    AnyFunction set, get, get_property_list, free_property_list, property_can_revert, property_get_revert, validate_property;
    Notify notification;
    AnyFunction to_string, reference, unreference;
    CreateInstance create_instance;
    FreeInstance free_instance;
    AnyFunction recreate_instance, get_virtual, get_virtual_call_data, call_virtual_with_data;
    void* class_user;
};

using MethodCall = void (*)(void* user, void* instance, const void* const* variants, int64_t count, void* result, CallError*);
using MethodPtrCall = void (*)(void* user, void* instance, const void* const* values, void* result);

struct MethodInfo {
    void* name; // StringName
    void* user;
    MethodCall call;
    MethodPtrCall ptrcall;
    uint32_t flags;
    uint8_t has_result;
    PropertyInfo* result;
    int32_t result_metadata;
    uint32_t argument_count;
    PropertyInfo* arguments;
    int32_t* argument_metadata;
    uint32_t default_count;
    void** defaults; // Variants
};

// What a Callable of ours is.
struct CallableInfo {
    void* user;
    void* token;
    uint64_t object_id;
    void (*call)(void* user, const void* const* variants, int64_t count, void* result, CallError*);
    AnyFunction is_valid;
    void (*release)(void* user);
    AnyFunction hash, equal, less_than, to_string, get_argument_count;
};

struct BindingCallbacks {
    void* (*create)(void* token, void* object);
    void (*release)(void* token, void* object, void* binding);
    uint8_t (*reference)(void* token, void* binding, uint8_t adds);
};

using TypeConstructor = void (*)(void* fresh, void* from); // of a Variant from a type, or the other way
using InternalGetter = void* (*)(void* variant);
using Destructor = void (*)(void* value);

enum Level : int32_t { kLevelCore = 0, kLevelServers = 1, kLevelScene = 2, kLevelEditor = 3 };

struct Initialization {
    int32_t first_level;
    void* user;
    void (*initialize)(void* user, int32_t level);
    void (*deinitialize)(void* user, int32_t level);
};

using GetProcAddress = AnyFunction (*)(const char* name);

// Every function of the engine's that the plugin calls: X(name, type).
#define BRITTLE_GODOT_FUNCTIONS(X)                                                                                             \
    X(print_error_with_message, void(const char*, const char*, const char*, const char*, int32_t, uint8_t))                    \
    X(print_warning_with_message, void(const char*, const char*, const char*, const char*, int32_t, uint8_t))                  \
    X(string_name_new_with_latin1_chars, void(void*, const char*, uint8_t))                                                    \
    X(string_new_with_utf8_chars_and_len, void(void*, const char*, int64_t))                                                   \
    X(string_to_utf8_chars, int64_t(const void*, char*, int64_t))                                                              \
    X(variant_new_nil, void(void*))                                                                                            \
    X(variant_new_copy, void(void*, const void*))                                                                              \
    X(variant_destroy, void(void*))                                                                                            \
    X(variant_get_type, int32_t(const void*))                                                                                  \
    X(variant_call, void(void*, const void*, const void* const*, int64_t, void*, CallError*))                                  \
    X(variant_construct, void(int32_t, void*, const void* const*, int32_t, CallError*))                                        \
    X(variant_get_object_instance_id, uint64_t(const void*))                                                                   \
    X(variant_get_indexed, void(const void*, int64_t, void*, uint8_t*, uint8_t*))                                              \
    X(variant_set_indexed, void(void*, int64_t, const void*, uint8_t*, uint8_t*))                                              \
    X(get_variant_from_type_constructor, TypeConstructor(int32_t))                                                             \
    X(get_variant_to_type_constructor, TypeConstructor(int32_t))                                                               \
    X(variant_get_ptr_internal_getter, InternalGetter(int32_t))                                                                \
    X(variant_get_ptr_destructor, Destructor(int32_t))                                                                         \
    X(packed_byte_array_operator_index, uint8_t*(void*, int64_t))                                                              \
    X(packed_byte_array_operator_index_const, const uint8_t*(const void*, int64_t))                                            \
    X(packed_int32_array_operator_index, int32_t*(void*, int64_t))                                                             \
    X(packed_int32_array_operator_index_const, const int32_t*(const void*, int64_t))                                           \
    X(packed_int64_array_operator_index, int64_t*(void*, int64_t))                                                             \
    X(packed_int64_array_operator_index_const, const int64_t*(const void*, int64_t))                                           \
    X(packed_float32_array_operator_index, float*(void*, int64_t))                                                             \
    X(packed_float32_array_operator_index_const, const float*(const void*, int64_t))                                           \
    X(packed_vector2_array_operator_index, void*(void*, int64_t))                                                              \
    X(packed_vector2_array_operator_index_const, void*(const void*, int64_t))                                                  \
    X(packed_vector3_array_operator_index, void*(void*, int64_t))                                                              \
    X(packed_vector3_array_operator_index_const, void*(const void*, int64_t))                                                  \
    X(global_get_singleton, void*(const void*))                                                                                \
    X(classdb_construct_object2, void*(const void*))                                                                           \
    X(classdb_get_method_bind, const void*(const void*, const void*, int64_t))                                                 \
    X(object_method_bind_ptrcall, void(const void*, void*, const void* const*, void*))                                         \
    X(object_get_instance_from_id, void*(uint64_t))                                                                            \
    X(object_set_instance, void(void*, const void*, void*))                                                                    \
    X(object_get_instance_binding, void*(void*, void*, const BindingCallbacks*))                                               \
    X(object_set_instance_binding, void(void*, void*, void*, const BindingCallbacks*))                                         \
    X(ref_set_object, void(void*, void*))                                                                                      \
    X(callable_custom_create2, void(void*, CallableInfo*))                                                                     \
    X(classdb_register_extension_class4, void(void*, const void*, const void*, const ClassInfo*))                              \
    X(classdb_register_extension_class_method, void(void*, const void*, const MethodInfo*))                                    \
    X(classdb_register_extension_class_integer_constant, void(void*, const void*, const void*, const void*, int64_t, uint8_t)) \
    X(classdb_register_extension_class_property, void(void*, const void*, const PropertyInfo*, const void*, const void*))      \
    X(classdb_register_extension_class_property_group, void(void*, const void*, const void*, const void*))                     \
    X(classdb_register_extension_class_signal, void(void*, const void*, const void*, const PropertyInfo*, int64_t))            \
    X(classdb_unregister_extension_class, void(void*, const void*))

} // namespace brittle_godot
