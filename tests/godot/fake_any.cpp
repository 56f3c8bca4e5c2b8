#include "tests/godot/fake_native.h"

#include <algorithm>

namespace godot_test {

Any::Any() { newNil(bytes_); }
Any::Any(bool value) {
    const uint8_t byte = value ? 1 : 0;
    variantFromType<Type::Bool>(bytes_, const_cast<uint8_t*>(&byte));
}
Any::Any(int64_t value) { variantFromType<Type::Int>(bytes_, &value); }
Any::Any(double value) { variantFromType<Type::Float>(bytes_, &value); }
Any::Any(const std::string& text) {
    makeVariant(bytes_, Type::String);
    *static_cast<NativeText*>(insideOf(bytes_)) = {tracked(new std::string(text))};
}
Any::Any(Object* object) {
    if (object == nullptr)
        newNil(bytes_);
    else
        variantFromType<Type::Object>(bytes_, &object);
}

Any Any::vector3(float x, float y, float z) {
    float v[3] = {x, y, z};
    Any a;
    variantFromType<Type::Vector3>(a.bytes_, v);
    return a;
}

Any Any::transform(const std::array<float, 12>& rows) {
    Any a;
    variantFromType<Type::Transform3d>(a.bytes_, const_cast<float*>(rows.data()));
    return a;
}

Any Any::rid(uint64_t id) {
    Any a;
    variantFromType<Type::Rid>(a.bytes_, &id);
    return a;
}

Any Any::array(const std::vector<Any>& elements) {
    Any a;
    makeEmpty(a.bytes_, Type::Array);
    static_cast<NativeArray*>(insideOf(a.bytes_))->node->elements = elements;
    return a;
}

Any Any::packed(Type type, const void* elements, size_t count) {
    Any a;
    makeEmpty(a.bytes_, type);
    a.resize(count);
    if (count > 0) std::memcpy(const_cast<void*>(a.elements()), elements, count * elementOf(type));
    return a;
}

Any Any::callable(std::function<void()> function) {
    NativeCallable native = {tracked(new Node), nullptr};
    native.node->function = std::move(function);
    Any a;
    variantFromType<Type::Callable>(a.bytes_, &native);
    destroyNative(Type::Callable, &native);
    return a;
}

Any Any::copyOf(const void* variant) {
    Any a;
    newCopy(a.bytes_, variant);
    return a;
}

Any& Any::operator=(Any other) noexcept {
    std::swap_ranges(bytes_, bytes_ + sizeof bytes_, other.bytes_);
    return *this;
}

Any::~Any() { destroyVariant(bytes_); }

Type Any::type() const { return typeAt(bytes_); }
bool Any::isNull() const { return type() == Type::Nil || (type() == Type::Object && asObject() == nullptr); }

template <class T>
T read(const void* variant, Type type) {
    T value = {};
    if (typeAt(variant) == type) std::memcpy(&value, variantAt(variant).value, sizeof value);
    return value;
}

bool Any::asBool() const { return read<uint8_t>(bytes_, Type::Bool) != 0; }
int64_t Any::asInt() const { return read<int64_t>(bytes_, Type::Int); }
double Any::asFloat() const { return read<double>(bytes_, Type::Float); }
std::string Any::asText() const {
    return type() == Type::String ? *static_cast<NativeText*>(variantAt(bytes_).value)->text : "";
}
std::array<float, 3> Any::asVector3() const { return read<std::array<float, 3>>(bytes_, Type::Vector3); }
std::array<float, 12> Any::asTransform() const { return read<std::array<float, 12>>(bytes_, Type::Transform3d); }
uint64_t Any::asRid() const { return read<uint64_t>(bytes_, Type::Rid); }
Object* Any::asObject() const { return findObject(idInVariant(bytes_)); }

std::vector<Any> Any::asArray() const {
    return type() == Type::Array ? static_cast<NativeArray*>(variantAt(bytes_).value)->node->elements : std::vector<Any>();
}

size_t Any::size() const {
    if (type() == Type::Array) return static_cast<NativeArray*>(variantAt(bytes_).value)->node->elements.size();
    if (elementOf(type()) == 0) return 0;
    return static_cast<NativePacked*>(variantAt(bytes_).value)->bytes->size() / elementOf(type());
}

const void* Any::elements() const {
    return elementOf(type()) == 0 ? nullptr : static_cast<NativePacked*>(variantAt(bytes_).value)->bytes->data();
}

void Any::resize(size_t count) {
    if (type() == Type::Array)
        static_cast<NativeArray*>(variantAt(bytes_).value)->node->elements.resize(count);
    else
        static_cast<NativePacked*>(variantAt(bytes_).value)->bytes->resize(count * elementOf(type()));
}

void Any::call() const { static_cast<NativeCallable*>(variantAt(bytes_).value)->node->function(); }
void Any::writeTo(void* fresh_variant) const { newCopy(fresh_variant, bytes_); }

} // namespace godot_test
