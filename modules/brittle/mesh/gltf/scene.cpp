#include "modules/brittle/mesh/gltf/scene.h"

#include <algorithm>
#include <limits>

namespace brittle::gltf {
namespace {

constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();

// ---- the transform of one node ----------------------------------------------------------------------------------------------

Transform fromMatrix(const Element& node, const std::vector<double>& m) { // column by column
    constexpr double kRounding = 1e-6;
    const double excess = std::max({std::abs(m[3]), std::abs(m[7]), std::abs(m[11]), std::abs(m[15] - 1)});
    if (excess > kRounding) node.refuse("matrix must end in the row 0, 0, 0, 1");
    return {{Double3{m[0], m[4], m[8]}, Double3{m[1], m[5], m[9]}, Double3{m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
}

// A quaternion of any length but 0, x y z w.
Transform rotationOf(const Element& place, std::array<double, 4> q) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0) || !std::isfinite(size)) place.refuse("a rotation is no quaternion of length 1");
    for (double& part : q)
        part /= size;
    const auto [x, y, z, w] = q;
    return {{Double3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             Double3{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             Double3{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
            {0, 0, 0}};
}

Transform compose(const Double3& translation, const Transform& rotation, const Double3& scale) {
    Transform composed = rotation;
    for (Double3& row : composed.rows)
        row = {row[0] * scale[0], row[1] * scale[1], row[2] * scale[2]};
    composed.offset = translation;
    return composed;
}

Double3 tripleOf(const Element& node, const char* key, const Double3& without) {
    const auto numbers = node.numbers(key, 3);
    return numbers ? Double3{(*numbers)[0], (*numbers)[1], (*numbers)[2]} : without;
}

Transform composedOf(const Element& node, Notes& notes) {
    constexpr double kRounding = 1e-3;
    const auto q = node.numbers("rotation", 4);
    const Transform rotation = q ? rotationOf(node, {(*q)[0], (*q)[1], (*q)[2], (*q)[3]}) : Transform();
    const double squared = q ? (*q)[0] * (*q)[0] + (*q)[1] * (*q)[1] + (*q)[2] * (*q)[2] + (*q)[3] * (*q)[3] : 1;
    if (std::abs(squared - 1) > kRounding)
        notes.count("rotation of another length than 1 is scaled to length 1",
                    "rotations of another length than 1 are scaled to length 1");
    return compose(tripleOf(node, "translation", {0, 0, 0}), rotation, tripleOf(node, "scale", {1, 1, 1}));
}

bool isSame(const Transform& a, const Transform& b) {
    constexpr double kRounding = 1e-5; // of the larger
    const auto differs = [](const Double3& x, const Double3& y) {
        return length(x - y) > kRounding * std::max({1.0, length(x), length(y)});
    };
    if (differs(a.offset, b.offset)) return false;
    return !differs(a.rows[0], b.rows[0]) && !differs(a.rows[1], b.rows[1]) && !differs(a.rows[2], b.rows[2]);
}

// The specification allows a matrix or the three parts, not both. Both are read if they agree.
Transform localOf(const Element& node, Notes& notes) {
    const bool has_parts = node.has("translation") || node.has("rotation") || node.has("scale");
    const auto matrix = node.numbers("matrix", 16);
    if (!matrix) return composedOf(node, notes);
    const Transform local = fromMatrix(node, *matrix);
    if (!has_parts) return local;
    if (!isSame(local, composedOf(node, notes)))
        node.refuse("it has a matrix and a translation, rotation or scale that differs from it", "remove one of them");
    notes.leaveOut("translation, rotation or scale", "translations, rotations or scales",
                   "the matrix of the node says the same");
    return local;
}

// ---- the tree ---------------------------------------------------------------------------------------------------------------

struct Tree {
    std::vector<std::vector<uint64_t>> children;
    std::vector<uint64_t> parents; // kNone for roots
};

Tree readTree(const Document& document) {
    const uint64_t count = document.size("nodes");
    Tree tree{std::vector<std::vector<uint64_t>>(count), std::vector<uint64_t>(count, kNone)};
    for (uint64_t n = 0; n < count; ++n) {
        const Element node = document.element("nodes", n, "the file");
        tree.children[n] = node.integers("children").value_or(std::vector<uint64_t>());
        for (const uint64_t child : tree.children[n]) {
            const Element there = document.element("nodes", child, node.where());
            uint64_t& parent = tree.parents[child];
            if (parent != kNone)
                there.refuse("it is a child of node " + std::to_string(parent) + " and again of node " + std::to_string(n));
            parent = n;
        }
    }
    return tree;
}

// Calls visit(node) for the roots and all nodes below them, parents first.
template <class Visit>
void walk(const Tree& tree, const std::vector<uint64_t>& roots, const Visit& visit) {
    std::vector<uint64_t> waiting(roots.rbegin(), roots.rend());
    while (!waiting.empty()) {
        const uint64_t node = waiting.back();
        waiting.pop_back();
        visit(node);
        waiting.insert(waiting.end(), tree.children[node].rbegin(), tree.children[node].rend());
    }
}

std::vector<uint64_t> rootsOf(const Tree& tree) {
    std::vector<uint64_t> roots;
    for (uint64_t n = 0; n < tree.parents.size(); ++n)
        if (tree.parents[n] == kNone) roots.push_back(n);
    return roots;
}

struct Worlds {
    std::vector<Transform> transforms;
    std::vector<bool> are_flat; // by a scale of 0, of the node or above it
};

Worlds worldsOf(const Document& document, const Tree& tree, Notes& notes) {
    Worlds worlds{std::vector<Transform>(tree.parents.size()), std::vector<bool>(tree.parents.size(), false)};
    std::vector<bool> reached(tree.parents.size(), false);
    walk(tree, rootsOf(tree), [&](uint64_t n) {
        const Transform local = localOf(document.element("nodes", n, "the file"), notes);
        const uint64_t parent = tree.parents[n];
        worlds.transforms[n] = parent == kNone ? local : worlds.transforms[parent] * local;
        worlds.are_flat[n] = local.isFlat() || (parent != kNone && worlds.are_flat[parent]);
        reached[n] = true;
    });
    const auto lost = std::ranges::find(reached, false);
    if (lost != reached.end()) refuse("node " + std::to_string(lost - reached.begin()), "it lies within itself");
    return worlds;
}

// ---- scenes -----------------------------------------------------------------------------------------------------------------

std::vector<uint64_t> rootsOfScene(const Document& document, const Tree& tree, uint64_t index) {
    const Element scene = document.element("scenes", index, "the file");
    std::vector<uint64_t> roots = scene.integers("nodes").value_or(std::vector<uint64_t>());
    std::vector<bool> listed(tree.parents.size(), false);
    for (const uint64_t root : roots) {
        const Element node = document.element("nodes", root, scene.where());
        if (tree.parents[root] != kNone)
            node.refuse(scene.where() + " lists it, yet it is a child of node " + std::to_string(tree.parents[root]));
        if (listed[root]) node.refuse(scene.where() + " lists it twice");
        listed[root] = true;
    }
    return roots;
}

std::vector<uint64_t> chooseRoots(const Document& document, const Tree& tree, Notes& notes) {
    const auto given = document.root().integer("scene");
    const uint64_t count = document.size("scenes"), chosen = given.value_or(0);
    if (count == 0 && !given) {
        if (document.size("nodes") > 0) notes.add("the file has no scene: all its nodes are read");
        return rootsOf(tree);
    }
    const std::vector<uint64_t> roots = rootsOfScene(document, tree, chosen);
    if (count > 1) {
        const std::string why = "scene " + std::to_string(chosen) + (given ? " is the default" : " is the first");
        notes.leaveOut("other scene", "other scenes", why.c_str(), count - 1);
    }
    return roots;
}

} // namespace

Scene readScene(const Document& document, Notes& notes) {
    const Tree tree = readTree(document);
    const Worlds worlds = worldsOf(document, tree, notes);
    Scene scene{worlds.transforms, {}};
    uint64_t all = 0, flat = 0;
    std::vector<bool> is_used(document.size("meshes"), false);
    for (uint64_t n = 0; n < tree.parents.size(); ++n)
        if (const auto mesh = document.element("nodes", n, "the file").integer("mesh")) {
            ++all;
            if (*mesh < is_used.size()) is_used[*mesh] = true;
        }
    walk(tree, chooseRoots(document, tree, notes), [&](uint64_t n) {
        const Element node = document.element("nodes", n, "the file");
        if (!node.has("mesh")) return;
        const bool is_left_out = worlds.are_flat[n] && !node.has("skin"); // joints place the mesh of a skin
        if (!is_left_out) scene.mesh_nodes.push_back(n);
        flat += is_left_out ? 1 : 0;
    });
    notes.leaveOut("node with a mesh", "nodes with meshes", "a scale of 0 makes them flat", flat);
    notes.leaveOut("node with a mesh", "nodes with meshes", "the scene does not hold them",
                   all - scene.mesh_nodes.size() - flat);
    notes.leaveOut("mesh", "meshes", "no node uses them", static_cast<uint64_t>(std::ranges::count(is_used, false)));
    return scene;
}

std::vector<Transform> instancesOf(const Element& node, Accessors& accessors) {
    const auto extension = node.extension(kInstancing);
    if (!extension) return {Transform()};
    const Element attributes = extension->requiredObject("attributes");
    std::optional<uint64_t> count;
    const auto read = [&](const char* key, uint32_t components) {
        const auto index = attributes.integer(key);
        if (!index) return std::vector<double>();
        std::vector<double> values = accessors.numbers(*index, components, attributes.where() + ", " + key);
        const uint64_t found = values.size() / components;
        if (count.value_or(found) != found) attributes.refuse("its attributes have different counts");
        count = found;
        return values;
    };
    const std::vector<double> t = read("TRANSLATION", 3), q = read("ROTATION", 4), s = read("SCALE", 3);
    std::vector<Transform> instances(count.value_or(1));
    for (size_t k = 0; k < instances.size(); ++k) {
        const auto triple = [&](const std::vector<double>& from, double without) {
            return from.empty() ? Double3{without, without, without} : Double3{from[3 * k], from[3 * k + 1], from[3 * k + 2]};
        };
        const auto rotation =
            q.empty() ? Transform() : rotationOf(attributes, {q[4 * k], q[4 * k + 1], q[4 * k + 2], q[4 * k + 3]});
        instances[k] = compose(triple(t, 0), rotation, triple(s, 1));
    }
    return instances;
}

} // namespace brittle::gltf
