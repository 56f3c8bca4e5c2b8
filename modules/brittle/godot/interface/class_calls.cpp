// How the engine's calls of our methods arrive.
#include "modules/brittle/godot/interface/class_record.h"
#include "modules/brittle/godot/interface/host.h"
#include "modules/brittle/godot/interface/messages.h"

namespace brittle_godot {
namespace {

// As scripts are used to: numbers for each other, and no object for an object.
bool fits(Type is, Type asked) {
    if (is == asked) return true;
    if (asked == Type::Object) return is == Type::Nil;
    if (asked == Type::Float) return is == Type::Int;
    return asked == Type::Int && is == Type::Float;
}

bool accepts(const std::vector<Parameter>& parameters, const void* const* variants, int64_t count, CallError& error) {
    const auto wanted = static_cast<int64_t>(parameters.size());
    error = {kCallOk, 0, static_cast<int32_t>(wanted)};
    if (count != wanted) error.error = count < wanted ? kCallTooFewArguments : kCallTooManyArguments;
    for (int32_t k = 0; error.error == kCallOk && k < wanted; ++k)
        if (const Type asked = parameters[static_cast<size_t>(k)].type;
            !fits(static_cast<Type>(host().variant_get_type(variants[k])), asked))
            error = {kCallInvalidArgument, k, static_cast<int32_t>(asked)};
    return error.error == kCallOk;
}

// Objects are handed over as their addresses; those that count references as a Ref, which takes part in the counting.
void giveObject(const Value& value, bool is_counted, void* result) {
    if (is_counted)
        host().ref_set_object(result, value.asObject());
    else
        *static_cast<void**>(result) = value.asObject();
}

} // namespace

Value ClassRecord::run(const Method& method, void* instance, Arguments arguments) {
    try {
        return method.body(*static_cast<Instance*>(instance), arguments);
    } catch (const std::exception& e) {
        tellError(method.name + ": " + e.what());
        return method.result.type == Type::Nil || method.result.type == Type::Object ? Value()
                                                                                     : Value::empty(method.result.type);
    }
}

void ClassRecord::call(void* user, void* instance, const void* const* variants, int64_t count, void* result, CallError* error) {
    const Method& method = *static_cast<Method*>(user);
    if (!accepts(method.parameters, variants, count, *error)) return;
    std::vector<Value> arguments;
    for (int64_t k = 0; k < count; ++k)
        arguments.push_back(Value::copyOf(variants[k]));
    run(method, instance, arguments).giveTo(result);
}

void ClassRecord::callPlain(void* user, void* instance, const void* const* values, void* result) {
    const Method& method = *static_cast<Method*>(user);
    std::vector<Value> arguments;
    for (size_t k = 0; k < method.parameters.size(); ++k)
        arguments.push_back(Value::ofType(method.parameters[k].type, values[k]));
    const Value value = run(method, instance, arguments);
    if (method.result.type == Type::Nil) return;
    if (method.result.type == Type::Object)
        giveObject(value, method.result.is_counted, result);
    else
        value.giveTo(method.result.type, result);
}

} // namespace brittle_godot
