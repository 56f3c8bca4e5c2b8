// How the fake engine lays out its values in memory, and the ledger that every block of theirs is on.
#pragma once

#include "tests/godot/fake_variant.h"

#include <atomic>

namespace godot_test {

// On the ledger from here on.
void track(const void* block);
template <class T>
T* tracked(T* block) {
    track(block);
    return block;
}
bool isTracked(const void* block);
bool strike(const void* block, const char* what); // false, and a complaint, where the block was never made or is gone

// The types as the plugin has them in its memory.
struct NativeText {
    std::string* text;
};
struct Node { // of arrays and callables, shared
    std::atomic<int> owners = 1;
    std::vector<Any> elements;
    std::function<void()> function;
    std::function<void()> release;
};
struct NativeArray {
    Node* node;
};
struct NativeCallable {
    Node* node;
    void* unused;
};
struct NativePacked {
    std::vector<std::byte>* bytes;
    size_t element;
};
struct NativeObject {
    Object* object;
    uint64_t id;
};
static_assert(sizeof(NativeText) == brittle_godot::kStringBytes && sizeof(NativeCallable) == brittle_godot::kCallableBytes);

size_t elementOf(Type type); // bytes, of packed arrays; else 0
size_t bytesOf(Type type);
// To memory that holds nothing; of what was made or copied.
void makeNative(Type type, void* to);
void copyNative(Type type, void* to, const void* from);
void destroyNative(Type type, void* at);

// A Variant: the type, a mark that it is one, and a block with the value.
struct Variant {
    int32_t type;
    uint32_t mark;
    void* value;
    uint64_t unused;
};
static_assert(sizeof(Variant) == brittle_godot::kVariantBytes);
constexpr uint32_t kMark = 0x7a31a27;

Variant& variantAt(const void* at); // complains where there is none
Type typeAt(const void* at);
void* insideOf(void* variant);
void makeVariant(void* at, Type type); // with a block of zeros
void makeEmpty(void* at, Type type);   // with an empty array, text and so on
uint64_t idInVariant(const void* at);  // of the object in it, 0 where there is none
void newNil(void* at);
void newCopy(void* at, const void* from);
void destroyVariant(void* at);

template <Type kType>
void variantFromType(void* at, void* from) {
    makeVariant(at, kType);
    void* value = static_cast<Variant*>(at)->value;
    if (kType == Type::Object) {
        Object* object = *static_cast<Object**>(from);
        const NativeObject native = {object, idOf(object)};
        copyNative(kType, value, &native);
    } else
        copyNative(kType, value, from);
}

} // namespace godot_test
