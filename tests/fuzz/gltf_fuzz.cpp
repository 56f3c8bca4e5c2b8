// Hostile bytes through the reader of glTF and GLB, without the process that it usually runs in.
//
// Every buffer in another file consists of the bytes of this one. Errors are one line, and a mesh that is read is whole.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/gltf/gltf.h"
#include "modules/brittle/mesh/prepare.h"
#include "tests/fuzz/require.h"

namespace {

constexpr uint64_t kMostElements = 1 << 14;

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto read = brittle::readGltf(
        bytes, [&](const std::string&) { return std::string(bytes); }, kMostElements);
    if (!read) {
        require(!read.error().message.empty(), "an error says what is wrong");
        return 0;
    }
    for (const brittle::Index3& t : read->triangles)
        for (const uint32_t v : t)
            require(v < read->positions.size(), "triangles refer to vertices");
    require(read->positions.size() <= kMostElements && read->triangles.size() <= kMostElements, "the limit holds");
    if (const auto model = brittle::prepareMesh(*read)) brittle::inspectMesh(model->mesh, model->topology);
    return 0;
}
