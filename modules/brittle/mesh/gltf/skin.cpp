#include "modules/brittle/mesh/gltf/skin.h"

namespace brittle::gltf {
namespace {

constexpr double kMostJoints = 65535;

Transform affine(const double* m) { // column by column
    return {{Double3{m[0], m[4], m[8]}, Double3{m[1], m[5], m[9]}, Double3{m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
}

// Larger than the rounding of floats, smaller than a step of 8-bit weights.
constexpr double kWeightRounding = 1e-3;

// A vertex without weights follows its first joint.
void normalizeWeights(Influences& influences, uint64_t vertices) {
    for (uint64_t v = 0; v < vertices; ++v) {
        double* weights = &influences.weights[v * influences.per_vertex];
        double sum = 0;
        for (size_t k = 0; k < influences.per_vertex; ++k)
            sum += weights[k];
        const bool has_weights = std::isfinite(sum) && sum > 0;
        if (!has_weights)
            ++influences.weightless;
        else if (std::abs(sum - 1) > kWeightRounding)
            ++influences.scaled;
        for (size_t k = 0; k < influences.per_vertex; ++k)
            weights[k] = has_weights ? weights[k] / sum : (k == 0 ? 1 : 0);
    }
}

// Four more per vertex, behind those of earlier sets.
void interleave(Influences& influences, uint64_t vertices, const std::vector<double>& joints,
                const std::vector<double>& weights) {
    Influences wider;
    wider.per_vertex = influences.per_vertex + 4;
    wider.joints.reserve(vertices * wider.per_vertex);
    wider.weights.reserve(vertices * wider.per_vertex);
    for (uint64_t v = 0; v < vertices; ++v) {
        for (size_t k = 0; k < influences.per_vertex; ++k) {
            wider.joints.push_back(influences.joints[v * influences.per_vertex + k]);
            wider.weights.push_back(influences.weights[v * influences.per_vertex + k]);
        }
        for (size_t k = 0; k < 4; ++k) {
            wider.joints.push_back(static_cast<uint32_t>(joints[4 * v + k]));
            wider.weights.push_back(weights[4 * v + k]);
        }
    }
    influences = std::move(wider);
}

} // namespace

std::vector<Transform> jointMatrices(const Document& document, uint64_t skin, const std::string& user, const Scene& scene,
                                     Accessors& accessors) {
    const Element element = document.element("skins", skin, user);
    const auto nodes = element.integers("joints");
    if (!nodes || nodes->empty()) element.refuse("joints are missing");
    std::vector<double> inverse_binds;
    if (const auto index = element.integer("inverseBindMatrices"))
        inverse_binds = accessors.numbers(*index, 16, element.where() + ", inverseBindMatrices");
    if (element.has("inverseBindMatrices") && inverse_binds.size() / 16 < nodes->size())
        element.refuse("it has " + std::to_string(nodes->size()) + " joints but only " +
                       std::to_string(inverse_binds.size() / 16) + " inverse bind matrices");
    std::vector<Transform> joints;
    for (size_t k = 0; k < nodes->size(); ++k) {
        document.element("nodes", (*nodes)[k], element.where());
        const Transform inverse_bind = inverse_binds.empty() ? Transform() : affine(&inverse_binds[16 * k]);
        joints.push_back(scene.worlds[(*nodes)[k]] * inverse_bind);
    }
    return joints;
}

Influences readInfluences(const Element& attributes, uint64_t vertices, const AttributeSource& source) {
    Influences influences;
    for (size_t set = 0;; ++set) {
        const std::string joints_key = "JOINTS_" + std::to_string(set), weights_key = "WEIGHTS_" + std::to_string(set);
        const bool has_joints = attributes.has(joints_key.c_str()), has_weights = attributes.has(weights_key.c_str());
        if (!has_joints && !has_weights) break;
        if (!has_joints || !has_weights) attributes.refuse(joints_key + " and " + weights_key + " must both be there");
        const std::vector<double> joints = source(joints_key, 4), weights = source(weights_key, 4);
        for (const double joint : joints)
            if (!(joint >= 0 && joint <= kMostJoints && joint == std::floor(joint)))
                attributes.refuse(joints_key + " must be unsigned integers of 8 or 16 bits");
        interleave(influences, vertices, joints, weights);
    }
    if (!influences.isEmpty()) normalizeWeights(influences, vertices);
    return influences;
}

Transform blend(const Influences& influences, const std::vector<Transform>& joints, uint64_t vertex, const std::string& where) {
    Transform sum{{Double3{0, 0, 0}, Double3{0, 0, 0}, Double3{0, 0, 0}}, {0, 0, 0}};
    for (size_t k = 0; k < influences.per_vertex; ++k) {
        const double weight = influences.weights[vertex * influences.per_vertex + k];
        const uint32_t joint = influences.joints[vertex * influences.per_vertex + k];
        if (weight == 0) continue;
        if (joint >= joints.size())
            refuse(where, "vertex " + std::to_string(vertex) + " follows joint " + std::to_string(joint) + ", its skin has " +
                              std::to_string(joints.size()));
        for (size_t r = 0; r < 3; ++r)
            sum.rows[r] += weight * joints[joint].rows[r];
        sum.offset += weight * joints[joint].offset;
    }
    return sum;
}

} // namespace brittle::gltf
