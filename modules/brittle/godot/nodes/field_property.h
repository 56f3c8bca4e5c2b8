// Properties that are a field of what a node keeps.
#pragma once

#include "modules/brittle/godot/interface/class_record.h"

#include <algorithm>

namespace brittle_godot {

template <class Node>
void numberProperty(ClassRecord& record, const char* name, const char* range_text, double& (*field)(Node&)) {
    record.property(
        name, Type::Float, range(range_text),
        [field](Instance& i, const Value& v) { field(static_cast<Node&>(i)) = v.asFloat(); },
        [field](Instance& i) { return Value(field(static_cast<Node&>(i))); });
}

// Of counts, choices and flags; what is below 0 is 0.
template <class Node, class Field>
void countProperty(ClassRecord& record, const char* name, const Hint& hint, Field field) {
    record.property(
        name, Type::Int, hint,
        [field](Instance& i, const Value& v) {
            field(static_cast<Node&>(i)) =
                static_cast<uint32_t>(std::min<int64_t>(std::max<int64_t>(v.asInt(), 0), UINT32_MAX));
        },
        [field](Instance& i) { return Value(static_cast<int64_t>(field(static_cast<Node&>(i)))); });
}

template <class Node>
void switchProperty(ClassRecord& record, const char* name, bool& (*field)(Node&)) {
    record.property(
        name, Type::Bool, {}, [field](Instance& i, const Value& v) { field(static_cast<Node&>(i)) = v.asBool(); },
        [field](Instance& i) { return Value(field(static_cast<Node&>(i))); });
}

// An object of `class_name` or of a class that it is a parent of; anything else is refused by the engine, and so is nothing
// here.
template <class Node>
void resourceProperty(ClassRecord& record, const char* name, const char* class_name, Value& (*field)(Node&)) {
    record.property(
        name, Type::Object, {kHintResourceType, class_name},
        [field](Instance& i, const Value& v) { field(static_cast<Node&>(i)) = v; },
        [field](Instance& i) { return field(static_cast<Node&>(i)); });
}

} // namespace brittle_godot
