#include "modules/brittle/mesh/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace brittle::gltf {
namespace {

// The library asserts what the extension demands, so all of it is checked here.
struct Layout {
    uint64_t count = 0, stride = 0;
    std::string mode, filter;
    uint64_t bytes() const { return count * stride; }
};

bool isAttributes(const Layout& layout) { return layout.mode == "ATTRIBUTES"; }

void checkStride(const Element& extension, const Layout& layout) {
    const uint64_t stride = layout.stride;
    const auto mustBe = [&](bool holds, const char* what) {
        if (!holds) extension.refuse("byteStride is " + std::to_string(stride) + ", must be " + what);
    };
    if (isAttributes(layout))
        mustBe(stride > 0 && stride <= 256 && stride % 4 == 0, "a multiple of 4 up to 256");
    else
        mustBe(stride == 2 || stride == 4, "2 or 4 for indices");
    if (layout.filter == "OCTAHEDRAL") mustBe(stride == 4 || stride == 8, "4 or 8 for the filter OCTAHEDRAL");
    if (layout.filter == "QUATERNION") mustBe(stride == 8, "8 for the filter QUATERNION");
}

// The least that the codec can take; more elements than that are refused before memory is set aside for them.
uint64_t mostElements(const Layout& layout, uint64_t compressed) {
    if (layout.mode == "TRIANGLES") return 3 * compressed;    // one byte per triangle
    if (layout.mode == "INDICES") return compressed;          // one byte per index
    return (64 * compressed + layout.stride) / layout.stride; // two bits per 16 equal bytes
}

Layout layoutOf(const Element& extension, uint64_t compressed) {
    Layout layout{extension.requiredInteger("count"), extension.requiredInteger("byteStride"),
                  extension.text("mode").value_or(""), extension.text("filter").value_or("NONE")};
    if (!isAttributes(layout) && layout.mode != "TRIANGLES" && layout.mode != "INDICES")
        extension.refuse("mode must be ATTRIBUTES, TRIANGLES or INDICES");
    const bool is_known = layout.filter == "OCTAHEDRAL" || layout.filter == "QUATERNION" || layout.filter == "EXPONENTIAL";
    if (!is_known && layout.filter != "NONE") extension.refuse("its filter \"" + layout.filter + "\" is not known");
    if (is_known && !isAttributes(layout)) extension.refuse("indices must have no filter");
    checkStride(extension, layout);
    if (layout.count > mostElements(layout, compressed))
        extension.refuse("count is " + std::to_string(layout.count) + ", too large for its data");
    if (layout.mode == "TRIANGLES" && layout.count % 3 != 0) extension.refuse("count must be a multiple of 3 for TRIANGLES");
    return layout;
}

void applyFilter(const Layout& layout, void* bytes) {
    if (layout.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes, layout.count, layout.stride);
    if (layout.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes, layout.count, layout.stride);
    if (layout.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes, layout.count, layout.stride);
}

} // namespace

std::string decodeMeshopt(const Element& extension, std::string_view compressed) {
    const Layout layout = layoutOf(extension, compressed.size());
    const auto* data = reinterpret_cast<const unsigned char*>(compressed.data());
    std::string bytes(layout.bytes(), '\0');
    int failed = 0;
    if (isAttributes(layout))
        failed = meshopt_decodeVertexBuffer(bytes.data(), layout.count, layout.stride, data, compressed.size());
    else if (layout.mode == "TRIANGLES")
        failed = meshopt_decodeIndexBuffer(bytes.data(), layout.count, layout.stride, data, compressed.size());
    else
        failed = meshopt_decodeIndexSequence(bytes.data(), layout.count, layout.stride, data, compressed.size());
    if (failed != 0) extension.refuse("its data is damaged or of a newer version");
    applyFilter(layout, bytes.data());
    return bytes;
}

} // namespace brittle::gltf
