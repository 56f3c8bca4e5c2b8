#include "modules/brittle/scene/check_scene.h"

#include "modules/brittle/effects/effect_set.h"
#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/body_shape.h"
#include "modules/brittle/scene/nearest_name.h"
#include "modules/brittle/scene/scene_material.h"

#include <string>
#include <unordered_map>

namespace brittle {
namespace {

using Problem = std::optional<SceneProblem>;

// kg. Their inverses, and those of their inertia, are floats.
constexpr double kLightest = 1e-12, kHeaviest = 1e13;

struct Place {
    SectionId section;
    size_t index = 0;
    std::string who; // "body 'lid': ", "" for what there is one of
};

SceneProblem problemAt(const Place& place, std::string_view key, const std::string& message) {
    return {place.section, place.index, key, place.who + message};
}

Place placeOf(SectionId section, size_t index, const std::string& name) {
    return {section, index,
            std::string(sectionOf(section).name) + " " + (name.empty() ? std::to_string(index) : inQuotes(name)) + ": "};
}

// ---- what the table says --------------------------------------------------------------------------------------------------

Problem checkValues(const Place& place, void* owner) {
    const SceneSection& section = sectionOf(place.section);
    for (const SceneKey& key : section.keys)
        if (const std::string fault = faultOf(key.locate(owner), key.allowed); !fault.empty())
            return problemAt(place, key.name, inQuotes(key.name) + " " + fault + "; it has to be " + describeAllowed(key));
    return {};
}

// A value that was set and would be ignored is a mistake.
Problem checkShapeKeys(const Place& place, void* owner) {
    const ShapeDescription& shape = *shapeOf(owner, place.section);
    const SceneSection& section = sectionOf(place.section);
    for (const SceneKey& key : section.keys)
        if ((key.shapes & bitOf(shape.kind)) == 0 && !sameValue(key.locate(owner), defaultOf(section, key)))
            return problemAt(place, key.name,
                             inQuotes(key.name) + " means nothing to a " +
                                 std::string(shapeNames()[static_cast<size_t>(shape.kind)]) + "; leave it out");
    return {};
}

// ---- what values have to do with each other -------------------------------------------------------------------------------

Problem checkSource(const Place& place, const ShapeDescription& shape) {
    if (shape.kind == ShapeKind::Mesh && shape.file.empty() && !shape.model)
        return problemAt(place, "shape", "a mesh needs a 'file'");
    if (shape.kind != ShapeKind::Hull) return {};
    if (shape.file.empty() && shape.points.empty()) return problemAt(place, "shape", "a hull needs 'points' or a 'file'");
    if (!shape.file.empty() && !shape.points.empty())
        return problemAt(place, "points", "a hull has 'points' or a 'file', not both");
    return {};
}

Problem checkCells(const Place& place, const ShapeDescription& shape) {
    const CellsDescription& cells = shape.cells;
    if (cells.sites > 0) return {};
    if (shape.kind == ShapeKind::Mesh && place.section == SectionId::Body)
        return problemAt(place, "shape", "a mesh moves by its cells; give it 'sites' (1 where it is convex)");
    if (cells.broken) return problemAt(place, "broken", "'broken' needs 'sites', the number of its cells");
    if (cells.inflate > 0) return problemAt(place, "inflate", "'inflate' needs 'sites', the number of its cells");
    return {};
}

bool hasHullAtHand(const ShapeDescription& shape) {
    return shape.kind == ShapeKind::Box || shape.kind == ShapeKind::Ball ||
           (shape.kind == ShapeKind::Hull && shape.file.empty());
}

std::string_view keyOfForm(const ShapeDescription& shape) {
    if (shape.kind == ShapeKind::Box) return "size";
    return shape.kind == ShapeKind::Ball ? "radius" : "points";
}

Problem checkMass(const Place& place, const BodyDescription& body, double density, double volume) {
    const double mass = massOf(body, density, volume);
    if (mass >= kLightest && mass <= kHeaviest) return {};
    return problemAt(place,
                     body.mass      ? "mass"
                     : body.density ? "density"
                                    : keyOfForm(body.shape),
                     "weighs " + formatNumber(mass) + " kg; bodies weigh from " + formatNumber(kLightest) + " to " +
                         formatNumber(kHeaviest) + " kg");
}

// `body` is null for what does not move, and then `density` means nothing.
Problem checkSolid(const Place& place, const ShapeDescription& shape, const BodyDescription* body, double density) {
    if (!hasHullAtHand(shape)) return {};
    const auto made = hullOf(shape, {});
    if (!made) return problemAt(place, keyOfForm(shape), "is no solid: " + made.error().message);
    return body != nullptr ? checkMass(place, *body, density, made->measures.volume) : Problem();
}

Problem checkOneBody(BodyDescription& body, size_t index, std::span<const MaterialDescription> materials) {
    const Place place = placeOf(SectionId::Body, index, body.name);
    if (auto problem = checkValues(place, &body)) return problem;
    if (auto problem = checkShapeKeys(place, &body)) return problem;
    if (body.density && body.mass) return problemAt(place, "mass", "has a 'density' and a 'mass'; give one of them");
    if (body.fixed && (length(body.velocity) > 0 || length(body.spin) > 0))
        return problemAt(place, "fixed", "is 'fixed' and has a 'velocity' or a 'spin'; leave out either");
    if (auto problem = checkSource(place, body.shape)) return problem;
    if (auto problem = checkCells(place, body.shape)) return problem;
    const auto density = densityOf(body, materials);
    if (!density) return problemAt(place, "material", density.error().message);
    return checkSolid(place, body.shape, &body, *density);
}

Problem checkOneCollider(ColliderDescription& collider, size_t index) {
    const Place place = placeOf(SectionId::Collider, index, collider.name);
    if (auto problem = checkValues(place, &collider)) return problem;
    if (auto problem = checkShapeKeys(place, &collider)) return problem;
    if (collider.shape.cells != CellsDescription()) return problemAt(place, "shape", "what does not move has no cells");
    if (auto problem = checkSource(place, collider.shape)) return problem;
    return checkSolid(place, collider.shape, nullptr, 0);
}

Problem checkOneMaterial(MaterialDescription& material, size_t index) {
    const Place place = placeOf(SectionId::Material, index, material.name);
    if (auto problem = checkValues(place, &material)) return problem;
    if (material.name.empty()) return problemAt(place, "name", "needs a 'name', which bodies call it by");
    if (isTakenName(material.name))
        return problemAt(place, "name", inQuotes(material.name) + " is taken; give it another name");
    if (material.like.empty())
        return problemAt(place, "like",
                         "needs 'like', the built-in material that it is like; it has to be " +
                             describeAllowed(*findKey(sectionOf(SectionId::Material), "like")));
    return {};
}

template <class Items>
Problem checkNames(SectionId section, const Items& items) {
    std::unordered_map<std::string, size_t> seen;
    for (size_t k = 0; k < items.size(); ++k)
        if (const auto [entry, is_new] = seen.try_emplace(items[k].name, k); !is_new && !items[k].name.empty())
            return problemAt(placeOf(section, k, items[k].name), "name",
                             "another has this name, number " + std::to_string(entry->second) + " of them, counted from 0");
    return {};
}

// Fragments are called "vase/31.7".
template <class Items>
Problem checkBodyNames(SectionId section, const Items& items) {
    for (size_t k = 0; k < items.size(); ++k)
        if (items[k].name.find('/') != std::string::npos)
            return problemAt(placeOf(section, k, items[k].name), "name",
                             "has a '/' in its name, which only fragments have; take it out");
    return checkNames(section, items);
}

Problem checkBudgets(const SceneDescription& scene) {
    const Place place{SectionId::Budgets, 0, ""};
    const SceneCounts counts = countsOf(scene);
    const auto tooFew = [&](std::string_view key, uint32_t budget, uint64_t needed) -> Problem {
        if (budget == 0 || budget >= needed) return {};
        return problemAt(place, key,
                         inQuotes(key) + " is " + std::to_string(budget) + ", and the scene begins with " +
                             std::to_string(needed));
    };
    if (auto problem = tooFew("bodies", scene.budgets.bodies, counts.bodies)) return problem;
    return tooFew("pieces", scene.budgets.pieces, counts.pieces);
}

Problem checkCamera(const CameraDescription& camera) {
    const Place place{SectionId::Camera, 0, ""};
    const Double3 ahead = camera.target - camera.eye;
    if (!(length(ahead) > 0)) return problemAt(place, "target", "'target' and 'eye' are one place");
    if (!(length(cross(ahead, camera.up)) > 1e-6 * length(ahead) * length(camera.up)) || !(length(camera.up) > 0))
        return problemAt(place, "up", "'up' points along the line of sight, or nowhere");
    return {};
}

Problem checkEffects(const SceneDescription& scene) {
    for (const std::string& effect : scene.effects)
        if (const std::string refusal = refusalOf(effect); !refusal.empty())
            return problemAt({SectionId::Scene, 0, ""}, "effects", refusal);
    return {};
}

// Where there is one of each.
Problem checkSingles(SceneDescription& scene) {
    for (const SceneSection& section : sceneSections()) {
        if (section.is_repeated) continue;
        if (auto problem = checkValues({section.id, 0, ""}, ownerOf(scene, section.id, 0))) return problem;
    }
    if (scene.bodies.empty()) return problemAt({SectionId::Scene, 0, ""}, "", "nothing is in the scene; give it a [[body]]");
    if (auto problem = checkEffects(scene)) return problem;
    if (auto problem = checkBudgets(scene)) return problem;
    return checkCamera(scene.camera);
}

engine::Result<void> asResult(const Problem& problem) {
    if (!problem) return {};
    return engine::Error{engine::ErrorCode::BadInput, problem->message};
}

} // namespace

std::optional<SceneProblem> findProblem(const BodyDescription& body, size_t index,
                                        std::span<const MaterialDescription> materials) {
    BodyDescription copy = body; // the table's references are for writing too
    return checkOneBody(copy, index, materials);
}

std::optional<SceneProblem> findProblem(const SceneDescription& scene) {
    SceneDescription copy = scene;
    if (auto problem = checkSingles(copy)) return problem;
    if (auto problem = checkNames(SectionId::Material, copy.materials)) return problem;
    if (auto problem = checkBodyNames(SectionId::Body, copy.bodies)) return problem;
    if (auto problem = checkBodyNames(SectionId::Collider, copy.colliders)) return problem;
    for (size_t k = 0; k < copy.materials.size(); ++k)
        if (auto problem = checkOneMaterial(copy.materials[k], k)) return problem;
    for (size_t k = 0; k < copy.bodies.size(); ++k)
        if (auto problem = checkOneBody(copy.bodies[k], k, copy.materials)) return problem;
    for (size_t k = 0; k < copy.colliders.size(); ++k)
        if (auto problem = checkOneCollider(copy.colliders[k], k)) return problem;
    return {};
}

engine::Result<void> checkScene(const SceneDescription& scene) { return asResult(findProblem(scene)); }
engine::Result<void> checkBody(const BodyDescription& body, size_t index, std::span<const MaterialDescription> materials) {
    return asResult(findProblem(body, index, materials));
}

} // namespace brittle
