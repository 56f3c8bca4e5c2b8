#include "tools/brittle/picture.h"

#include "engine/renderer.h"
#include "modules/brittle/mesh/vector_math.h"
#include "shaders-spirv/shared/scene.h"
#include "tools/brittle/drawn_buffer.h"

#include <cstring>

namespace cli {
namespace {

using brittle::Double3;
using brittle::Fragment;
using brittle::FragmentSet;
using brittle::operator+; // of arrays, which argument-dependent lookup does not find
using brittle::operator*;

// Moves the fragments apart and the whole to unit size: cameras and depth buffers work best there.
class Stage {
public:
    Stage(const FragmentSet& set, double explode) : set_(set), explode_(explode) {
        brittle::Box box;
        for (const Fragment& f : set.fragments)
            grow(box, f, 1);
        scale_ = 1 / box.diagonal();
        for (const Fragment& f : set.fragments)
            grow(bounds_, f, scale_);
    }
    const brittle::Box& bounds() const { return bounds_; }

    std::vector<gpu::ObjectMatrix> matrices() const {
        std::vector<gpu::ObjectMatrix> matrices;
        for (const Fragment& f : set_.fragments) {
            const brittle::Float3 moved = brittle::toFloat((scale_ * explode_) * f.centroid);
            const auto s = static_cast<float>(scale_);
            // By columns.
            const std::array<float, 16> numbers = {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, moved[0], moved[1], moved[2], 1};
            static_assert(sizeof numbers == sizeof(gpu::ObjectMatrix));
            std::memcpy(&matrices.emplace_back(), numbers.data(), sizeof numbers);
        }
        return matrices;
    }

private:
    void grow(brittle::Box& box, const Fragment& f, double scale) const {
        const Double3 moved = explode_ * f.centroid;
        box.grow(scale * (brittle::toDouble(f.lower) + moved));
        box.grow(scale * (brittle::toDouble(f.upper) + moved));
    }
    const FragmentSet& set_;
    double explode_;
    double scale_ = 1;
    brittle::Box bounds_;
};

std::vector<gpu::DrawCommand> drawCommands(const FragmentSet& set) {
    std::vector<gpu::DrawCommand> commands;
    for (const Fragment& f : set.fragments) {
        const auto instance = static_cast<uint32_t>(commands.size());
        const auto first_vertex = static_cast<int32_t>(f.first_vertex);
        const uint32_t own = f.outer_index_count - f.earlier_index_count, cut = f.inner_index_count + f.earlier_index_count;
        commands.push_back({own, 1, f.first_index, first_vertex, instance});
        commands.push_back({cut, 1, f.first_index + own, first_vertex, instance + 1});
    }
    return commands;
}

engine::Result<engine::Picture> draw(engine::Device& device, const FragmentSet& set, const Stage& stage,
                                     const PictureSize& size) {
    const auto vertices = drawnBuffer(device, set.vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    const auto indices = drawnBuffer(device, set.indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    const std::vector<gpu::DrawCommand> draws = drawCommands(set);
    const auto commands = drawnBuffer(device, draws, 0);
    const auto matrices = drawnBuffer(device, stage.matrices(), 0);
    for (const auto* buffer : {&vertices, &indices, &commands, &matrices})
        if (!*buffer) return buffer->error();
    auto renderer = engine::Renderer::create(device, size.width, size.height);
    if (!renderer) return renderer.error();
    const auto camera = engine::frameBounds(brittle::toFloat(stage.bounds().lower), brittle::toFloat(stage.bounds().upper),
                                            static_cast<float>(size.width) / static_cast<float>(size.height));
    return (*renderer)->draw({*vertices, *indices, *commands, *matrices, static_cast<uint32_t>(draws.size())}, camera);
}

} // namespace

engine::Result<engine::Picture> pictureOf(engine::Device& device, const FragmentSet& fragments, double explode,
                                          const PictureSize& size) {
    return draw(device, fragments, Stage(fragments, explode), size);
}

engine::Result<void> drawFragments(engine::Device& device, const FragmentSet& fragments, double explode,
                                   const std::filesystem::path& path) {
    const auto picture = pictureOf(device, fragments, explode);
    if (!picture) return picture.error();
    return engine::writePng(*picture, path.string());
}

} // namespace cli
