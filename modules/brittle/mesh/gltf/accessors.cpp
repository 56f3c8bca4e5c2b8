#include "modules/brittle/mesh/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace brittle::gltf {
namespace {

// Counts of accessors without data of their own may exceed the bytes of the file by this factor, or reach this number.
constexpr uint64_t kZerosPerByte = 16, kFewZeros = 65536;

template <class T>
double valueAt(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

struct Component {
    uint64_t type;
    uint64_t bytes;
    double largest; // 0 for floats
    bool is_unsigned;
    double (*value)(const char*);
};

template <class T>
constexpr Component component(uint64_t type) {
    using Limits = std::numeric_limits<T>;
    return {type, sizeof(T), Limits::is_integer ? static_cast<double>(Limits::max()) : 0, !Limits::is_signed, valueAt<T>};
}

constexpr Component kComponents[] = {component<int8_t>(5120),   component<uint8_t>(5121),  component<int16_t>(5122),
                                     component<uint16_t>(5123), component<uint32_t>(5125), component<float>(5126)};

const Component* findComponent(uint64_t type) {
    const auto* found = std::ranges::find(kComponents, type, &Component::type);
    return found == std::end(kComponents) ? nullptr : found;
}

const Component& componentOf(const Element& element, uint64_t type) {
    if (const Component* found = findComponent(type)) return *found;
    element.refuse("componentType is " + std::to_string(type) + ", must be 5120 to 5123, 5125 or 5126");
}

uint32_t componentsOf(const Element& accessor) {
    static constexpr std::pair<std::string_view, uint32_t> kTypes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                                       {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    const std::string type = accessor.text("type").value_or("");
    for (const auto& [name, components] : kTypes)
        if (type == name) return components;
    accessor.refuse("type must be SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
}

// Elements of one component type within a view, checked against its end.
struct Elements {
    const char* first = nullptr;
    uint64_t stride = 0;
    const Component* component = nullptr;
};

Elements elementsIn(const Element& place, const BufferView& view, uint64_t offset, const AccessorShape& shape) {
    const Component& component = componentOf(place, shape.component_type);
    const uint64_t size = component.bytes * shape.components;
    const uint64_t stride = view.stride.value_or(size), available = view.bytes.size();
    if (stride < size)
        place.refuse("byteStride of its buffer view is " + std::to_string(stride) + ", must be " + std::to_string(size) +
                     " or more");
    const bool fits = shape.count == 0 || (offset <= available && size <= available - offset &&
                                           shape.count - 1 <= (available - offset - size) / stride);
    if (!fits)
        place.refuse(std::to_string(shape.count) + " elements reach beyond its buffer view, which has " +
                     std::to_string(available) + " bytes");
    return {view.bytes.data() + (shape.count > 0 ? offset : 0), stride, &component};
}

void readElement(const Elements& elements, const AccessorShape& shape, uint64_t index, double* to) {
    const char* from = elements.first + index * elements.stride;
    const Component& component = *elements.component;
    for (uint32_t c = 0; c < shape.components; ++c) {
        const double value = component.value(from + c * component.bytes);
        to[c] = shape.is_normalized && component.largest > 0 ? std::max(value / component.largest, -1.0) : value;
    }
}

} // namespace

double largestOf(uint64_t component_type) {
    const Component* found = findComponent(component_type);
    return found ? found->largest : 0;
}

AccessorShape Accessors::shape(uint64_t index, const std::string& user) const {
    const Element accessor = document_.element("accessors", index, user);
    AccessorShape shape;
    shape.count = accessor.requiredInteger("count");
    shape.component_type = accessor.requiredInteger("componentType");
    componentOf(accessor, shape.component_type);
    shape.components = componentsOf(accessor);
    shape.is_normalized = accessor.flag("normalized");
    return shape;
}

std::vector<double> Accessors::numbers(uint64_t index, uint32_t components, const std::string& user) {
    const AccessorShape found = shape(index, user);
    const Element accessor = document_.element("accessors", index, user);
    if (found.components != components)
        refuse(user, "accessor " + std::to_string(index) + " is of type " + accessor.text("type").value_or("") +
                         ", must have " + std::to_string(components) + " components");
    return read(accessor, found);
}

std::vector<uint32_t> Accessors::indices(uint64_t index, const std::string& user) {
    const Element accessor = document_.element("accessors", index, user);
    if (!componentOf(accessor, accessor.requiredInteger("componentType")).is_unsigned)
        accessor.refuse("componentType of indices must be 5121, 5123 or 5125");
    AccessorShape found = shape(index, user);
    if (found.components != 1) accessor.refuse("type of indices must be SCALAR");
    found.is_normalized = false;
    const std::vector<double> values = read(accessor, found);
    std::vector<uint32_t> indices(values.size());
    std::ranges::transform(values, indices.begin(), [](double value) { return static_cast<uint32_t>(value); });
    return indices;
}

std::vector<double> Accessors::read(const Element& accessor, const AccessorShape& shape) {
    std::vector<double> values;
    if (const auto view_index = accessor.integer("bufferView")) {
        const BufferView view = buffers_.view(*view_index, accessor.where());
        const Elements elements = elementsIn(accessor, view, accessor.integer("byteOffset").value_or(0), shape);
        values.resize(shape.count * shape.components);
        for (uint64_t k = 0; k < shape.count; ++k)
            readElement(elements, shape, k, &values[k * shape.components]);
    } else {
        if (shape.count > std::max(kFewZeros, kZerosPerByte * buffers_.bytesRead()))
            accessor.refuse("count is " + std::to_string(shape.count) + ", too large for an accessor without a buffer view");
        values.resize(shape.count * shape.components);
    }
    if (accessor.has("sparse")) replaceSparse(accessor, shape, values);
    return values;
}

void Accessors::replaceSparse(const Element& accessor, const AccessorShape& shape, std::vector<double>& values) {
    const Element sparse = accessor.requiredObject("sparse");
    const Element indices = sparse.requiredObject("indices"), replacements = sparse.requiredObject("values");
    AccessorShape of_values = shape;
    of_values.count = sparse.requiredInteger("count");
    const AccessorShape of_indices{of_values.count, indices.requiredInteger("componentType"), 1, false};
    const auto within = [&](const Element& part, const AccessorShape& part_shape) {
        BufferView view = buffers_.view(part.requiredInteger("bufferView"), part.where());
        view.stride.reset(); // both lists are packed
        return elementsIn(part, view, part.integer("byteOffset").value_or(0), part_shape);
    };
    if (!componentOf(indices, of_indices.component_type).is_unsigned)
        indices.refuse("componentType of indices must be 5121, 5123 or 5125");
    const Elements places = within(indices, of_indices), elements = within(replacements, of_values);
    std::vector<bool> is_replaced(shape.count, false);
    for (uint64_t k = 0; k < of_values.count; ++k) {
        double place = 0;
        readElement(places, of_indices, k, &place);
        if (place >= static_cast<double>(shape.count))
            indices.refuse("index " + std::to_string(k) + " is beyond the " + std::to_string(shape.count) + " elements");
        const auto element = static_cast<uint64_t>(place);
        if (is_replaced[element]) indices.refuse("index " + std::to_string(k) + " is there twice");
        is_replaced[element] = true;
        readElement(elements, of_values, k, &values[element * shape.components]);
    }
}

} // namespace brittle::gltf
