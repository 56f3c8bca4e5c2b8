// Holds what the plugin declares of the engine's C interface to the header that the engine dumps: layouts, numbers, signatures.
// Compiles or does not; there is nothing to run.
#include "gdextension_interface.h"
#include "modules/brittle/godot/interface/gdextension.h"

#include <type_traits>

namespace bg = brittle_godot;

// One argument or result as another: pointers for pointers, that may write where the other may; numbers of one size.
template <class A, class B>
constexpr bool alike() {
    if constexpr (std::is_pointer_v<A> && std::is_pointer_v<B>) {
        using To = std::remove_pointer_t<A>;
        using From = std::remove_pointer_t<B>;
        return std::is_function_v<To> == std::is_function_v<From> && std::is_const_v<To> == std::is_const_v<From>;
    } else {
        return std::is_pointer_v<A> == std::is_pointer_v<B> && std::is_void_v<A> == std::is_void_v<B> &&
               std::is_floating_point_v<A> == std::is_floating_point_v<B>;
    }
}
template <class A, class B>
constexpr bool asLarge() {
    if constexpr (std::is_void_v<A> || std::is_void_v<B>)
        return true;
    else
        return sizeof(A) == sizeof(B);
}

template <class Ours, class Engines>
struct Same : std::false_type {};
template <class R, class... A, class S, class... B>
struct Same<R (*)(A...), S (*)(B...)> {
    static constexpr bool areAlike() {
        if constexpr (sizeof...(A) != sizeof...(B))
            return false;
        else
            return alike<R, S>() && asLarge<R, S>() && (... && (alike<A, B>() && asLarge<A, B>()));
    }
    static constexpr bool value = areAlike();
};

namespace brittle_godot {
struct Declared {
#define FIELD(name, type) std::add_pointer_t<type> name;
    BRITTLE_GODOT_FUNCTIONS(FIELD)
#undef FIELD
};
} // namespace brittle_godot
using brittle_godot::Declared;

#define FUNCTION(name, theirs)                                                                                                 \
    static_assert(Same<decltype(Declared::name), GDExtensionInterface##theirs>::value, #name " is declared otherwise");
FUNCTION(print_error_with_message, PrintErrorWithMessage)
FUNCTION(print_warning_with_message, PrintWarningWithMessage)
FUNCTION(string_name_new_with_latin1_chars, StringNameNewWithLatin1Chars)
FUNCTION(string_new_with_utf8_chars_and_len, StringNewWithUtf8CharsAndLen)
FUNCTION(string_to_utf8_chars, StringToUtf8Chars)
FUNCTION(variant_new_nil, VariantNewNil)
FUNCTION(variant_new_copy, VariantNewCopy)
FUNCTION(variant_destroy, VariantDestroy)
FUNCTION(variant_get_type, VariantGetType)
FUNCTION(variant_call, VariantCall)
FUNCTION(variant_construct, VariantConstruct)
FUNCTION(variant_get_object_instance_id, VariantGetObjectInstanceId)
FUNCTION(variant_get_indexed, VariantGetIndexed)
FUNCTION(variant_set_indexed, VariantSetIndexed)
FUNCTION(get_variant_from_type_constructor, GetVariantFromTypeConstructor)
FUNCTION(get_variant_to_type_constructor, GetVariantToTypeConstructor)
FUNCTION(variant_get_ptr_internal_getter, GetVariantGetInternalPtrFunc)
FUNCTION(variant_get_ptr_destructor, VariantGetPtrDestructor)
FUNCTION(packed_byte_array_operator_index, PackedByteArrayOperatorIndex)
FUNCTION(packed_byte_array_operator_index_const, PackedByteArrayOperatorIndexConst)
FUNCTION(packed_int32_array_operator_index, PackedInt32ArrayOperatorIndex)
FUNCTION(packed_int32_array_operator_index_const, PackedInt32ArrayOperatorIndexConst)
FUNCTION(packed_int64_array_operator_index, PackedInt64ArrayOperatorIndex)
FUNCTION(packed_int64_array_operator_index_const, PackedInt64ArrayOperatorIndexConst)
FUNCTION(packed_float32_array_operator_index, PackedFloat32ArrayOperatorIndex)
FUNCTION(packed_float32_array_operator_index_const, PackedFloat32ArrayOperatorIndexConst)
FUNCTION(packed_vector2_array_operator_index, PackedVector2ArrayOperatorIndex)
FUNCTION(packed_vector2_array_operator_index_const, PackedVector2ArrayOperatorIndexConst)
FUNCTION(packed_vector3_array_operator_index, PackedVector3ArrayOperatorIndex)
FUNCTION(packed_vector3_array_operator_index_const, PackedVector3ArrayOperatorIndexConst)
FUNCTION(global_get_singleton, GlobalGetSingleton)
FUNCTION(classdb_construct_object2, ClassdbConstructObject2)
FUNCTION(classdb_get_method_bind, ClassdbGetMethodBind)
FUNCTION(object_method_bind_ptrcall, ObjectMethodBindPtrcall)
FUNCTION(object_get_instance_from_id, ObjectGetInstanceFromId)
FUNCTION(object_set_instance, ObjectSetInstance)
FUNCTION(object_get_instance_binding, ObjectGetInstanceBinding)
FUNCTION(object_set_instance_binding, ObjectSetInstanceBinding)
FUNCTION(ref_set_object, RefSetObject)
FUNCTION(callable_custom_create2, CallableCustomCreate2)
FUNCTION(classdb_register_extension_class4, ClassdbRegisterExtensionClass4)
FUNCTION(classdb_register_extension_class_method, ClassdbRegisterExtensionClassMethod)
FUNCTION(classdb_register_extension_class_integer_constant, ClassdbRegisterExtensionClassIntegerConstant)
FUNCTION(classdb_register_extension_class_property, ClassdbRegisterExtensionClassProperty)
FUNCTION(classdb_register_extension_class_property_group, ClassdbRegisterExtensionClassPropertyGroup)
FUNCTION(classdb_register_extension_class_signal, ClassdbRegisterExtensionClassSignal)
FUNCTION(classdb_unregister_extension_class, ClassdbUnregisterExtensionClass)
static_assert(sizeof(Declared) == 47 * sizeof(void (*)()), "a function is declared that is not held to anything above");

#define LAYOUT(ours, theirs) static_assert(sizeof(bg::ours) == sizeof(theirs) && alignof(bg::ours) == alignof(theirs));
#define FIELD_AT(ours, field, theirs, their_field)                                                                             \
    static_assert(offsetof(bg::ours, field) == offsetof(theirs, their_field), #ours "::" #field " lies elsewhere");
LAYOUT(CallError, GDExtensionCallError)
FIELD_AT(CallError, error, GDExtensionCallError, error)
FIELD_AT(CallError, argument, GDExtensionCallError, argument)
FIELD_AT(CallError, expected, GDExtensionCallError, expected)
LAYOUT(PropertyInfo, GDExtensionPropertyInfo)
FIELD_AT(PropertyInfo, type, GDExtensionPropertyInfo, type)
FIELD_AT(PropertyInfo, name, GDExtensionPropertyInfo, name)
FIELD_AT(PropertyInfo, class_name, GDExtensionPropertyInfo, class_name)
FIELD_AT(PropertyInfo, hint, GDExtensionPropertyInfo, hint)
FIELD_AT(PropertyInfo, hint_string, GDExtensionPropertyInfo, hint_string)
FIELD_AT(PropertyInfo, usage, GDExtensionPropertyInfo, usage)
LAYOUT(ClassInfo, GDExtensionClassCreationInfo4)
FIELD_AT(ClassInfo, is_exposed, GDExtensionClassCreationInfo4, is_exposed)
FIELD_AT(ClassInfo, is_runtime, GDExtensionClassCreationInfo4, is_runtime)
FIELD_AT(ClassInfo, notification, GDExtensionClassCreationInfo4, notification_func)
FIELD_AT(ClassInfo, create_instance, GDExtensionClassCreationInfo4, create_instance_func)
FIELD_AT(ClassInfo, free_instance, GDExtensionClassCreationInfo4, free_instance_func)
FIELD_AT(ClassInfo, class_user, GDExtensionClassCreationInfo4, class_userdata)
LAYOUT(MethodInfo, GDExtensionClassMethodInfo)
FIELD_AT(MethodInfo, name, GDExtensionClassMethodInfo, name)
FIELD_AT(MethodInfo, user, GDExtensionClassMethodInfo, method_userdata)
FIELD_AT(MethodInfo, call, GDExtensionClassMethodInfo, call_func)
FIELD_AT(MethodInfo, ptrcall, GDExtensionClassMethodInfo, ptrcall_func)
FIELD_AT(MethodInfo, flags, GDExtensionClassMethodInfo, method_flags)
FIELD_AT(MethodInfo, has_result, GDExtensionClassMethodInfo, has_return_value)
FIELD_AT(MethodInfo, result, GDExtensionClassMethodInfo, return_value_info)
FIELD_AT(MethodInfo, argument_count, GDExtensionClassMethodInfo, argument_count)
FIELD_AT(MethodInfo, arguments, GDExtensionClassMethodInfo, arguments_info)
FIELD_AT(MethodInfo, argument_metadata, GDExtensionClassMethodInfo, arguments_metadata)
FIELD_AT(MethodInfo, default_count, GDExtensionClassMethodInfo, default_argument_count)
LAYOUT(CallableInfo, GDExtensionCallableCustomInfo2)
FIELD_AT(CallableInfo, user, GDExtensionCallableCustomInfo2, callable_userdata)
FIELD_AT(CallableInfo, token, GDExtensionCallableCustomInfo2, token)
FIELD_AT(CallableInfo, object_id, GDExtensionCallableCustomInfo2, object_id)
FIELD_AT(CallableInfo, call, GDExtensionCallableCustomInfo2, call_func)
FIELD_AT(CallableInfo, release, GDExtensionCallableCustomInfo2, free_func)
LAYOUT(BindingCallbacks, GDExtensionInstanceBindingCallbacks)
FIELD_AT(BindingCallbacks, create, GDExtensionInstanceBindingCallbacks, create_callback)
FIELD_AT(BindingCallbacks, release, GDExtensionInstanceBindingCallbacks, free_callback)
FIELD_AT(BindingCallbacks, reference, GDExtensionInstanceBindingCallbacks, reference_callback)
LAYOUT(Initialization, GDExtensionInitialization)
FIELD_AT(Initialization, first_level, GDExtensionInitialization, minimum_initialization_level)
FIELD_AT(Initialization, initialize, GDExtensionInitialization, initialize)
FIELD_AT(Initialization, deinitialize, GDExtensionInitialization, deinitialize)
static_assert(Same<bg::MethodCall, GDExtensionClassMethodCall>::value &&
              Same<bg::MethodPtrCall, GDExtensionClassMethodPtrCall>::value);
static_assert(Same<bg::CreateInstance, GDExtensionClassCreateInstance2>::value);
static_assert(Same<bg::FreeInstance, GDExtensionClassFreeInstance>::value &&
              Same<bg::Notify, GDExtensionClassNotification2>::value);
static_assert(Same<decltype(bg::CallableInfo::call), GDExtensionCallableCustomCall>::value);
static_assert(Same<decltype(bg::CallableInfo::release), GDExtensionCallableCustomFree>::value);
static_assert(Same<bg::Destructor, GDExtensionPtrDestructor>::value);
static_assert(Same<bg::TypeConstructor, GDExtensionVariantFromTypeConstructorFunc>::value);
static_assert(Same<bg::InternalGetter, GDExtensionVariantGetInternalPtrFunc>::value);

#define TYPE(ours, theirs) static_assert(static_cast<int>(bg::Type::ours) == GDEXTENSION_VARIANT_TYPE_##theirs);
TYPE(Nil, NIL)
TYPE(Bool, BOOL)
TYPE(Int, INT)
TYPE(Float, FLOAT)
TYPE(String, STRING)
TYPE(Vector3, VECTOR3)
TYPE(Transform3d, TRANSFORM3D)
TYPE(StringName, STRING_NAME)
TYPE(Rid, RID)
TYPE(Object, OBJECT)
TYPE(Callable, CALLABLE)
TYPE(Array, ARRAY)
TYPE(PackedByteArray, PACKED_BYTE_ARRAY)
TYPE(PackedInt32Array, PACKED_INT32_ARRAY)
TYPE(PackedInt64Array, PACKED_INT64_ARRAY)
TYPE(PackedFloat32Array, PACKED_FLOAT32_ARRAY)
TYPE(PackedVector2Array, PACKED_VECTOR2_ARRAY)
TYPE(PackedVector3Array, PACKED_VECTOR3_ARRAY)

#define NUMBER(ours, theirs) static_assert(static_cast<int>(bg::ours) == static_cast<int>(theirs));
NUMBER(kCallOk, GDEXTENSION_CALL_OK)
NUMBER(kCallInvalidMethod, GDEXTENSION_CALL_ERROR_INVALID_METHOD)
NUMBER(kCallInvalidArgument, GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT)
NUMBER(kCallTooManyArguments, GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS)
NUMBER(kCallTooFewArguments, GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS)
NUMBER(kCallInstanceIsNull, GDEXTENSION_CALL_ERROR_INSTANCE_IS_NULL)
NUMBER(kMethodNormal, GDEXTENSION_METHOD_FLAG_NORMAL)
NUMBER(kLevelScene, GDEXTENSION_INITIALIZATION_SCENE)
