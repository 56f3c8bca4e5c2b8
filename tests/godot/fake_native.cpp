#include "tests/godot/fake_native.h"

#include <mutex>
#include <set>
#include <utility>

namespace godot_test {
namespace {

std::mutex ledger_mutex;
std::set<const void*> ledger;
std::vector<std::string> complaints;

} // namespace

void track(const void* block) {
    const std::scoped_lock lock(ledger_mutex);
    ledger.insert(block);
}

bool isTracked(const void* block) {
    const std::scoped_lock lock(ledger_mutex);
    return ledger.contains(block);
}

bool strike(const void* block, const char* what) {
    {
        const std::scoped_lock lock(ledger_mutex);
        if (ledger.erase(block) == 1) return true;
    }
    complain(std::string(what) + " is destroyed that is none, or is one no more");
    return false;
}

void complain(const std::string& what) {
    const std::scoped_lock lock(ledger_mutex);
    complaints.push_back(what);
}

std::vector<std::string> takeComplaints() {
    const std::scoped_lock lock(ledger_mutex);
    return std::exchange(complaints, {});
}

size_t liveBlocks() {
    const std::scoped_lock lock(ledger_mutex);
    return ledger.size();
}

size_t elementOf(Type type) {
    switch (type) {
    case Type::PackedByteArray: return 1;
    case Type::PackedInt32Array:
    case Type::PackedFloat32Array: return 4;
    case Type::PackedInt64Array:
    case Type::PackedVector2Array: return 8;
    case Type::PackedVector3Array: return 12;
    default: return 0;
    }
}

size_t bytesOf(Type type) {
    switch (type) {
    case Type::Bool: return 1;
    case Type::Vector3: return 12;
    case Type::Transform3d: return 48;
    case Type::Object:
    case Type::Callable: return 16;
    default: return elementOf(type) != 0 ? 16 : 8;
    }
}

static void disown(Node* node, const char* what) {
    if (!isTracked(node)) return complain(std::string(what) + " is used that is gone");
    if (--node->owners > 0) return;
    strike(node, what);
    if (node->release) node->release();
    delete node;
}

void makeNative(Type type, void* to) {
    std::memset(to, 0, bytesOf(type));
    if (type == Type::String || type == Type::StringName) *static_cast<NativeText*>(to) = {tracked(new std::string)};
    if (type == Type::Array) *static_cast<NativeArray*>(to) = {tracked(new Node)};
    if (elementOf(type) != 0) *static_cast<NativePacked*>(to) = {tracked(new std::vector<std::byte>), elementOf(type)};
}

void copyNative(Type type, void* to, const void* from) {
    std::memcpy(to, from, bytesOf(type));
    if (type == Type::String || type == Type::StringName) {
        const auto* text = static_cast<const NativeText*>(from)->text;
        if (!isTracked(text)) return complain("a string is read that is none");
        static_cast<NativeText*>(to)->text = tracked(new std::string(*text));
    }
    if (type == Type::Array || type == Type::Callable) ++(*static_cast<Node* const*>(from))->owners;
    if (elementOf(type) != 0)
        static_cast<NativePacked*>(to)->bytes =
            tracked(new std::vector<std::byte>(*static_cast<const NativePacked*>(from)->bytes));
    if (type == Type::Object && findObject(static_cast<const NativeObject*>(from)->id) != nullptr)
        reference(static_cast<const NativeObject*>(from)->object);
}

void destroyNative(Type type, void* at) {
    if (type == Type::String || type == Type::StringName) {
        auto* text = static_cast<NativeText*>(at)->text;
        if (strike(text, "a string")) delete text;
    }
    if (type == Type::Array || type == Type::Callable) disown(*static_cast<Node**>(at), "an array or callable");
    if (elementOf(type) != 0) {
        auto* bytes = static_cast<NativePacked*>(at)->bytes;
        if (strike(bytes, "a packed array")) delete bytes;
    }
    if (type == Type::Object)
        if (Object* object = findObject(static_cast<NativeObject*>(at)->id)) unreference(object);
}

Variant& variantAt(const void* at) {
    auto& v = *static_cast<Variant*>(const_cast<void*>(at));
    if (v.mark != kMark) complain("what is used as a Variant is none");
    return v;
}
Type typeAt(const void* at) { return static_cast<Type>(variantAt(at).type); }

void makeVariant(void* at, Type type) {
    *static_cast<Variant*>(at) = {static_cast<int32_t>(type), kMark, nullptr, 0};
    if (type != Type::Nil) static_cast<Variant*>(at)->value = tracked(new std::byte[bytesOf(type)]());
}

void newNil(void* at) { makeVariant(at, Type::Nil); }

void newCopy(void* at, const void* from) {
    const Variant& source = variantAt(from);
    const Type type = typeAt(from);
    makeVariant(at, type);
    if (type != Type::Nil) copyNative(type, static_cast<Variant*>(at)->value, source.value);
}

void destroyVariant(void* at) {
    Variant& v = variantAt(at);
    const Type type = typeAt(at);
    if (v.mark == kMark && type != Type::Nil && strike(v.value, "a Variant")) {
        destroyNative(type, v.value);
        delete[] static_cast<std::byte*>(v.value);
    }
    v = {};
}

void* insideOf(void* at) { return variantAt(at).value; }

void makeEmpty(void* at, Type type) {
    makeVariant(at, type);
    makeNative(type, insideOf(at));
}

uint64_t idInVariant(const void* at) {
    return typeAt(at) == Type::Object ? static_cast<NativeObject*>(variantAt(at).value)->id : 0;
}

} // namespace godot_test
