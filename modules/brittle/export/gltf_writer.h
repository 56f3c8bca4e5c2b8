// What all GLB files of ours are put together from. Only mesh/export sees tinygltf, and only through this.
#pragma once

#include "engine/result.h"
#include "modules/brittle/fracture/fragments.h"

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace brittle {

class GltfWriter {
public:
    // One buffer with a view for each kind of data: 20,000 fragments need 80,000 accessors, but not as many views.
    enum View { kPositions, kNormals, kUvs, kIndices, kTimes, kPlaces, kTurns, kScales, kViewCount };

    GltfWriter();

    tinygltf::Model& model() { return model_; }
    int addMaterial(const char* name, std::array<double, 3> color);
    // Triangles, three corners each. Corners that are equal, bit for bit, become one vertex; normals become unit ones.
    tinygltf::Primitive addPrimitive(std::span<const FragmentVertex> corners, int material);
    // Numbers in rows of `width`; of one width 1 with their least and greatest.
    int addNumbers(View view, std::span<const float> numbers, int width);
    size_t bytes() const;
    // The file. `what` is in it, for the message: Capacity beyond the 4 GiB that the format can hold.
    engine::Result<std::string> finish(const char* what, const char* advice);

private:
    int addAccessor(View view, size_t offset, size_t count, int type, int component);
    void addBounds(const std::vector<FragmentVertex>& vertices, tinygltf::Accessor& accessor) const;
    void joinViews();

    tinygltf::Model model_;
    std::array<std::vector<unsigned char>, kViewCount> data_;
};

// Of a model's own surface, and of cut faces.
constexpr std::array<double, 3> kOuterColor = {0.72, 0.74, 0.78}, kInnerColor = {0.90, 0.38, 0.14};
constexpr size_t kMaxGlbBytes = 0xffff0000; // lengths in the file have 32 bits

// What the indices point at, one by one.
std::vector<FragmentVertex> cornersOf(std::span<const FragmentVertex> vertices, std::span<const uint32_t> indices);

} // namespace brittle
