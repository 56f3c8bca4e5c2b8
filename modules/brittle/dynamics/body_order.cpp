#include "modules/brittle/dynamics/body_order.h"

#include "modules/brittle/breaking/breakable.h"

#include <algorithm>
#include <numeric>

namespace brittle {

BodyOrder orderById(const WorldContents& contents) {
    BodyOrder order;
    order.body_at.resize(contents.bodies.size());
    std::iota(order.body_at.begin(), order.body_at.end(), 0);
    std::ranges::stable_sort(order.body_at, {}, [&](uint32_t body) { return contents.ids[body]; });
    for (const uint32_t body : order.body_at)
        for (uint32_t k = 0; k < contents.shapes[body].pieces.y; k++)
            order.piece_at.push_back(contents.shapes[body].pieces.x + k);
    return order;
}

WorldContents inOrder(const WorldContents& contents, const BodyOrder& order) {
    WorldContents sorted;
    sorted.hulls = contents.hulls;
    sorted.siblings = contents.siblings;
    sorted.cards = contents.cards;
    sorted.surface_vertices = contents.surface_vertices;
    sorted.some_surface_may_touch_itself = contents.some_surface_may_touch_itself;
    std::vector<uint32_t> piece_now(contents.pieces.size());
    for (uint32_t k = 0; k < order.piece_at.size(); k++)
        piece_now[order.piece_at[k]] = k;
    for (SiblingContact& s : sorted.siblings) {
        s.piece_a = piece_now[s.piece_a];
        s.piece_b = piece_now[s.piece_b];
    }
    for (const uint32_t body : order.body_at) {
        gpu::BodyShape shape = contents.shapes[body];
        const auto first = static_cast<uint32_t>(sorted.pieces.size()), index = static_cast<uint32_t>(sorted.bodies.size());
        for (uint32_t k = 0; k < shape.pieces.y; k++) {
            const gpu::PieceRecord& piece = contents.pieces[shape.pieces.x + k];
            sorted.pieces.push_back({{piece.ids.x, index, piece.ids.z, 0}});
        }
        shape.pieces.x = first;
        sorted.shapes.push_back(shape);
        sorted.bodies.push_back(contents.bodies[body]);
        sorted.ids.push_back(contents.ids[body]);
        sorted.names.push_back(contents.names[body]);
        sorted.materials.push_back(contents.materials[body]);
        if (!contents.looks.empty())
            sorted.looks.push_back(body < contents.looks.size() ? contents.looks[body] : gpu::BodyLook{});
        if (!contents.breakable.empty())
            sorted.breakable.push_back(body < contents.breakable.size() ? contents.breakable[body] : unbreakable());
    }
    return sorted;
}

} // namespace brittle
