#include "modules/brittle/scene/scene_keys.h"

#include "modules/brittle/effects/effect_set.h"

#include <algorithm>
#include <type_traits>

namespace brittle {
namespace {

// ---- where a key's value is -----------------------------------------------------------------------------------------------

template <class>
struct OwnerOfMember;
template <class Owner, class Value>
struct OwnerOfMember<Value Owner::*> {
    using Type = Owner;
};

template <class Value>
ValueRef refTo(Value& value) {
    // Enumerations of scenes are bytes, which may be read and written as such.
    if constexpr (std::is_enum_v<Value>)
        return ChoiceRef{reinterpret_cast<uint8_t*>(&value)};
    else
        return &value;
}

// The member, or the member of a member and so on, of whatever owns the first.
template <auto First, auto... Rest>
ValueRef at(void* owner) {
    auto& object = *static_cast<typename OwnerOfMember<decltype(First)>::Type*>(owner);
    return refTo(((object.*First).*....*Rest));
}

template <size_t... Sizes>
constexpr auto joined(const std::array<SceneKey, Sizes>&... parts) {
    std::array<SceneKey, (Sizes + ...)> all{};
    size_t next = 0;
    const auto append = [&](const auto& part) {
        for (const SceneKey& key : part)
            all[next++] = key;
    };
    (append(parts), ...);
    return all;
}

// ---- what values may be ---------------------------------------------------------------------------------------------------

constexpr std::string_view kShapes[] = {"box", "ball", "hull", "mesh", "plane"};
constexpr std::string_view kBodyShapes[] = {"box", "ball", "hull", "mesh"};
constexpr std::string_view kPatterns[] = {"uniform", "impact", "paper", "radial"};
constexpr std::string_view kBreakPatterns[] = {"impact", "uniform", "radial", "paper"};
constexpr std::string_view kSolvers[] = {"soft", "hard"};
constexpr std::string_view kAxes[] = {"all", "fixed"};
constexpr std::string_view kMaterials[] = {"glass", "porcelain", "concrete", "brick", "ice", "stone"};
constexpr uint32_t kDirections[] = {6, 14, 26, 62};

constexpr Allowed kAnything;
constexpr double kEndOfWorld = 1e6, kFastest = 1e4, kLargest = 1e5, kMostElements = 10'000'000;

constexpr Allowed from(double lower, double upper) { return {.lower = lower, .upper = upper}; }
constexpr Allowed above(double lower, double upper) { return {.lower = lower, .upper = upper, .above_lower = true}; }
constexpr Allowed oneOf(std::span<const std::string_view> names) { return {.names = names}; }
constexpr Allowed oneOfOrOwn(std::span<const std::string_view> names) { return {.names = names, .has_own_names = true}; }

constexpr ShapeBits kBox = bitOf(ShapeKind::Box), kBall = bitOf(ShapeKind::Ball), kHull = bitOf(ShapeKind::Hull),
                    kMesh = bitOf(ShapeKind::Mesh);

// ---- the keys -------------------------------------------------------------------------------------------------------------

constexpr SceneKey kSceneKeys[] = {
    {"name", at<&SceneDescription::name>, kAnything, "", "what the scene is called"},
    {"comment", at<&SceneDescription::comment>, kAnything, "", "what it is about; the first line is shown in lists"},
    {"gravity", at<&SceneDescription::gravity>, from(-1e4, 1e4), "m/s2", "acts where `effects` has gravity"},
    {"effects", at<&SceneDescription::effects>, oneOf(kEffectNames), "",
     "what the scene calls for; what is neither in the list nor needed by what is costs nothing; bonds and stress are not "
     "there yet"},
    {"air_density", at<&SceneDescription::air_density>, from(0, 1e4), "kg/m3", "acts where `effects` has drag, and on dust"},
    {"drag_coefficient", at<&SceneDescription::drag_coefficient>, from(0, 100), "",
     "of the ball around a body that air slows it as; acts where `effects` has drag"},
};

constexpr SceneKey kStepKeys[] = {
    {"dt", at<&StepDescription::dt>, from(1e-6, 0.5), "s", "of one step"},
    {"steps", at<&StepDescription::steps>, from(0, 1e9), "", "how many are simulated"},
    {"substeps", at<&StepDescription::substeps>, from(1, 64), "", "of one step, in which contacts are solved"},
    {"most_substeps", at<&StepDescription::most_substeps>, from(1, 2000), "",
     "that bodies in touch take if their loads, sizes and height need more than `substeps`"},
    {"iterations", at<&StepDescription::iterations>, from(1, 64), "", "over all contacts in a substep"},
    {"solver", at<&StepDescription::solver>, oneOf(kSolvers), "",
     "soft: heaps take only as many substeps as are cheap; hard, for great mass ratios and loads: four times `substeps` at the "
     "least, heaps as many as their loads need, and twice as many for the same load"},
    {"contact_hertz", at<&StepDescription::contact_hertz>, from(0, 1e4), "1/s",
     "frequency of soft contacts, at most an eighth of the substeps a second; 0: as much as that"},
    {"contact_damping", at<&StepDescription::contact_damping>, from(0, 1e3), "", "damping ratio of soft contacts"},
    {"push_out", at<&StepDescription::push_out>, from(0, 1e3), "m/s",
     "the most that overlap is undone with; 0: what gravity gives in 18 steps, or per step a 250th of the way from a contact "
     "to the nearer center of mass if that is more"},
    {"bounce_speed", at<&StepDescription::bounce_speed>, from(0, 1e4), "m/s",
     "what meets more slowly does not bounce; acts where `effects` has restitution"},
    {"margin", at<&StepDescription::margin>, from(0, 1), "m",
     "contacts are looked for at this distance already, and at a tenth of the smaller piece's radius at most; 0: 2 cm at 60 "
     "steps a second, less for shorter steps, by the square of the step"},
    {"recycling", at<&StepDescription::recycling>, kAnything, "", "contacts at rest keep their anchors from step to step"},
    {"axes", at<&StepDescription::axes>, oneOf(kAxes), "",
     "separating axes: all of two hulls, or a fixed set, which is looser and cheaper"},
};

constexpr SceneKey kBreakingKeys[] = {
    {"smallest_piece", at<&BreakingDescription::smallest_piece>, from(0, 100), "m",
     "a cell whose volume is less than that of a cube of this edge is no body: it is gone, or dust, where `effects` has dust; "
     "0: "
     "every cell is a body"},
};

constexpr SceneKey kDustKeys[] = {
    {"lifetime", at<&DustDescription::lifetime>, from(0, 1e6), "s", "after which a particle settles and is not drawn any more"},
};

constexpr SceneKey kDebrisKeys[] = {
    {"below", at<&DebrisDescription::below>, from(0, 1e3), "m",
     "fragments whose volume is less than that of a cube of this edge are debris"},
    {"after", at<&DebrisDescription::after>, from(0, 1e6), "s", "of rest, before they begin to fade"},
    {"fade", at<&DebrisDescription::fade>, from(0, 1e6), "s", "that they take to shrink to nothing; then they are gone"},
};

constexpr SceneKey kEventsKeys[] = {
    {"impact_speed", at<&EventsDescription::impact_speed>, from(1e-3, 1e4), "m/s",
     "what meets more slowly is no impact to tell of"},
};

constexpr SceneKey kBudgetKeys[] = {
    {"bodies", at<&BudgetDescription::bodies>, from(0, kMostElements), "",
     "that the scene begins with, at most; 0: what it needs"},
    {"pieces", at<&BudgetDescription::pieces>, from(0, kMostElements), "",
     "convex ones that it begins with, at most; 0: what it needs"},
    {"pairs", at<&BudgetDescription::pairs>, from(0, kMostElements), "", "of pieces that are near, at most; 0: what is needed"},
    {"contacts", at<&BudgetDescription::contacts>, from(0, kMostElements), "", "pairs that touch, at most; 0: what is needed"},
    {"fragments", at<&BudgetDescription::fragments>, from(0, kMostElements), "", "that there are at a time; 0: 4 for each body that can break, from 1024 to 8192"},
    {"fragment_faces", at<&BudgetDescription::fragment_faces>, from(0, kMostElements), "",
     "of the hulls of all of them; 0: 24 for each"},
    {"fragment_triangles", at<&BudgetDescription::fragment_triangles>, from(0, kMostElements), "",
     "of the surfaces of all of them; 0: 96 for each, or what the largest bodies need"},
    {"most_fragments", at<&BudgetDescription::most_fragments>, from(0, kMostElements), "",
     "of one body, of which there are never more than breaking_sites; 0: 256"},
    {"breaking_bodies", at<&BudgetDescription::breaking_bodies>, from(0, 256), "",
     "that break in one step, the others wait; 0: 16"},
    {"breaking_sites", at<&BudgetDescription::breaking_sites>, from(0, kMostElements), "", "of all of them together; 0: 512"},
    {"breaking_triangles", at<&BudgetDescription::breaking_triangles>, from(0, kMostElements), "",
     "of their surfaces together, and a body with more never breaks; 0: 8192, or what the largest surface needs"},
    {"dust", at<&BudgetDescription::dust>, from(1, 1'000'000), "",
     "particles that fly at a time, rounded up to a power of two; where there are more, the oldest make room, and are counted"},
};

constexpr SceneKey kCameraKeys[] = {
    {"eye", at<&CameraDescription::eye>, from(-kEndOfWorld, kEndOfWorld), "m", "where pictures are taken from"},
    {"target", at<&CameraDescription::target>, from(-kEndOfWorld, kEndOfWorld), "m", "what is in their middle"},
    {"up", at<&CameraDescription::up>, from(-1e3, 1e3), "", "a direction"},
    {"field_of_view", at<&CameraDescription::field_of_view>, from(1, 170), "degrees", "from the top to the bottom"},
    {"width", at<&CameraDescription::width>, from(16, 8192), "pixels", "of pictures"},
    {"height", at<&CameraDescription::height>, from(16, 8192), "pixels", "of pictures"},
};

constexpr double kLightestMatter = 1e-3, kHardest = 1e13;

constexpr SceneKey kMaterialKeys[] = {
    {"name", at<&MaterialDescription::name>, kAnything, "", "what bodies call it; none of the built-in names"},
    {"like", at<&MaterialDescription::like>, oneOf(kMaterials), "", "has the values that are not given here"},
    {"density", at<&MaterialDescription::density>, from(kLightestMatter, 1e6), "kg/m3",
     "of bodies that have none of their own"},
    {"youngs_modulus", at<&MaterialDescription::youngs_modulus>, from(1, kHardest), "Pa", "how stiff it is"},
    {"poisson_ratio", at<&MaterialDescription::poisson_ratio>, from(0, 0.499), "", "how much it gives way sideways"},
    {"fracture_energy", at<&MaterialDescription::fracture_energy>, from(1e-6, 1e9), "J/m2",
     "that a crack costs; the less, the more fragments"},
    {"tensile_strength", at<&MaterialDescription::tensile_strength>, from(1, kHardest), "Pa",
     "that 37 of 100 bodies of the reference volume have"},
    {"weibull_modulus", at<&MaterialDescription::weibull_modulus>, from(1, 1000), "", "how alike bodies are in strength"},
    {"reference_volume", at<&MaterialDescription::reference_volume>, from(1e-12, 1e6), "m3",
     "that the strength belongs to; larger bodies are weaker"},
    {"eta", at<&MaterialDescription::eta>, from(0, 1), "",
     "share of a blow's energy that goes into cracks: the dial for how many fragments there are; 0: none breaks"},
    {"smallest_cell", at<&MaterialDescription::smallest_cell>, from(0, 1e3), "m", "smaller fragments are not made"},
};

template <class Owner, auto Member>
constexpr auto kInShape = at<&Owner::shape, Member>;
template <auto Member>
constexpr auto kInCells = at<&BodyDescription::shape, &ShapeDescription::cells, Member>;

// What bodies and colliders have in common: a form and a place.
template <class Owner>
constexpr auto kPlacedKeys = std::to_array<SceneKey>({
    {"size", kInShape<Owner, &ShapeDescription::size>, above(0, kLargest), "m", "its edges", kBox},
    {"radius", kInShape<Owner, &ShapeDescription::radius>, above(0, kLargest), "m", "its radius", kBall},
    {"corners", kInShape<Owner, &ShapeDescription::corners>, from(4, kMaxBallCorners), "",
     "points spread over the ball, whose hull it is", kBall},
    {"points", kInShape<Owner, &ShapeDescription::points>, from(-kLargest, kLargest), "m",
     "whose hull it is; one of more than 64 faces is replaced by a looser one that holds it", kHull},
    {"file", kInShape<Owner, &ShapeDescription::file>, kAnything, "",
     "a model, from the scene file's folder, or builtin:NAME; for a hull only its vertices count", kHull | kMesh},
    {"scale", kInShape<Owner, &ShapeDescription::scale>, above(0, kLargest), "", "makes the model larger, along its own axes",
     kHull | kMesh},
    {"place", at<&Owner::place>, from(-kEndOfWorld, kEndOfWorld), "m", "of the shape's own origin"},
    {"turn", at<&Owner::turn>, from(-1e3, 1e3), "", "a quaternion [x, y, z, w], or { axis = [x, y, z], degrees = d }"},
    {"friction", at<&Owner::surface, &SurfaceDescription::friction>, from(0, 10), "", "coefficient of Coulomb friction"},
    {"restitution", at<&Owner::surface, &SurfaceDescription::restitution>, from(0, 1), "",
     "speed after a bounce over speed before; acts where `effects` has restitution"},
});

// Cells in which a body is broken, or will break.
constexpr auto kCellKeys = std::to_array<SceneKey>({
    {"sites", kInCells<&CellsDescription::sites>, from(0, 1'000'000), "",
     "cells that a body consists of, without a gap; 0: one piece, which a model cannot be", kBox | kMesh},
    {"seed", kInCells<&CellsDescription::seed>, from(0, 1e15), "", "of the sites' places", kBox | kMesh},
    {"pattern", kInCells<&CellsDescription::pattern>, oneOf(kPatterns), "", "how sites are placed", kBox | kMesh},
    {"at", kInCells<&CellsDescription::at>, from(-kLargest, kLargest), "m",
     "of the blow that sites crowd about, in the body's frame", kBox | kMesh},
    {"strength", kInCells<&CellsDescription::strength>, above(0, 1e12), "J", "of that blow", kBox | kMesh},
    {"directions",
     kInCells<&CellsDescription::directions>,
     {.numbers = kDirections},
     "",
     "in which the piece of a cell is made tight",
     kBox | kMesh},
    {"broken", kInCells<&CellsDescription::broken>, kAnything, "",
     "every cell is a body of its own from the start, at rest against its neighbors", kBox | kMesh},
    {"inflate", kInCells<&CellsDescription::inflate>, from(0, 1), "m",
     "pieces are made larger by this on all sides, so that neighbors overlap", kBox | kMesh},
});

constexpr auto kBodyKeys = joined(
    std::to_array<SceneKey>({
        {"name", at<&BodyDescription::name>, kAnything, "", "for messages; bodies of one scene have different ones"},
        {"shape", kInShape<BodyDescription, &ShapeDescription::kind>, oneOf(kBodyShapes), "",
         "a box, a ball of flat faces, a convex hull, a closed model"},
    }),
    kPlacedKeys<BodyDescription>,
    std::to_array<SceneKey>({
        {"velocity", at<&BodyDescription::velocity>, from(-kFastest, kFastest), "m/s", "of the center of mass"},
        {"spin", at<&BodyDescription::spin>, from(-kFastest, kFastest), "rad/s", "angular velocity"},
        {"density", at<&BodyDescription::density>, above(0, 1e6), "kg/m3",
         "the material's, or 1000, if it and mass are left out"},
        {"mass", at<&BodyDescription::mass>, above(0, 1e13), "kg", "instead of density"},
        {"material", at<&BodyDescription::material>, oneOfOrOwn(kMaterials), "", "that it breaks as; without one it does not"},
        {"break_pattern", at<&BodyDescription::break_pattern>, oneOf(kBreakPatterns), "",
         "how its fragments lie: about the blow; evenly; of what is thin and flat, in spokes and rings about the blow; or as "
         "the "
         "paper has them, about the middle and drawn towards the blow"},
        {"fixed", at<&BodyDescription::fixed>, kAnything, "",
         "it does not move, as a pane in its frame; it breaks as others do, and its fragments move"},
    }),
    kCellKeys);

constexpr auto kColliderKeys =
    joined(std::to_array<SceneKey>({
               {"name", at<&ColliderDescription::name>, kAnything, "", "for messages"},
               {"shape", kInShape<ColliderDescription, &ShapeDescription::kind>, oneOf(kShapes), "",
                "a plane is endless and bounds what is up to 10 m below it, where its frame's y axis "
                "is up; a mesh is taken as the triangles it is"},
           }),
           kPlacedKeys<ColliderDescription>);

constexpr SceneSection kSections[] = {
    {SectionId::Scene, "", false, kSceneKeys, "At the top of the file."},
    {SectionId::Step, "step", false, kStepKeys, "How time goes on and contacts are solved."},
    {SectionId::Breaking, "breaking", false, kBreakingKeys, "Acts where `effects` has impact_fracture."},
    {SectionId::Dust, "dust", false, kDustKeys, "Acts where `effects` has dust."},
    {SectionId::Debris, "debris", false, kDebrisKeys, "Acts where `effects` has debris_lifetime."},
    {SectionId::Events, "events", false, kEventsKeys, "Acts where `effects` has events."},
    {SectionId::Budgets, "budgets", false, kBudgetKeys, "Room on the device. What does not fit is reported, never dropped."},
    {SectionId::Camera, "camera", false, kCameraKeys, "For pictures and films."},
    {SectionId::Material, "material", true, kMaterialKeys,
     "Materials of the scene's own, each like a built-in one but for what is given; as many as are wanted."},
    {SectionId::Body, "body", true, kBodyKeys, "What moves; as many as are wanted."},
    {SectionId::Collider, "collider", true, kColliderKeys, "What does not move; as many as are wanted."},
};

} // namespace

std::span<const SceneSection> sceneSections() { return kSections; }
const SceneSection& sectionOf(SectionId id) { return kSections[static_cast<size_t>(id)]; }
std::span<const std::string_view> shapeNames() { return kShapes; }
std::span<const std::string_view> materialNames() { return kMaterials; }

const SceneKey* findKey(const SceneSection& section, std::string_view name) {
    const auto found =
        std::find_if(section.keys.begin(), section.keys.end(), [&](const SceneKey& k) { return k.name == name; });
    return found == section.keys.end() ? nullptr : &*found;
}

std::string headingOf(const SceneSection& section) {
    if (section.name.empty()) return "the scene";
    const std::string name = "[" + std::string(section.name) + "]";
    return section.is_repeated ? "[" + name + "]" : name;
}

void* ownerOf(SceneDescription& scene, SectionId id, size_t index) {
    switch (id) {
    case SectionId::Scene: return &scene;
    case SectionId::Step: return &scene.step;
    case SectionId::Breaking: return &scene.breaking;
    case SectionId::Dust: return &scene.dust;
    case SectionId::Debris: return &scene.debris;
    case SectionId::Events: return &scene.events;
    case SectionId::Budgets: return &scene.budgets;
    case SectionId::Camera: return &scene.camera;
    case SectionId::Material: return &scene.materials[index];
    case SectionId::Body: return &scene.bodies[index];
    case SectionId::Collider: return &scene.colliders[index];
    }
    return nullptr;
}

size_t countOf(const SceneDescription& scene, SectionId id) {
    if (id == SectionId::Material) return scene.materials.size();
    if (id == SectionId::Body) return scene.bodies.size();
    return id == SectionId::Collider ? scene.colliders.size() : 1;
}

void addOwner(SceneDescription& scene, SectionId id) {
    if (id == SectionId::Material) scene.materials.emplace_back();
    if (id == SectionId::Body) scene.bodies.emplace_back();
    if (id == SectionId::Collider) scene.colliders.emplace_back();
}

const ShapeDescription* shapeOf(const void* owner, SectionId id) {
    if (id == SectionId::Body) return &static_cast<const BodyDescription*>(owner)->shape;
    return id == SectionId::Collider ? &static_cast<const ColliderDescription*>(owner)->shape : nullptr;
}

ValueRef defaultOf(const SceneSection& section, const SceneKey& key) {
    static SceneDescription usual = [] {
        SceneDescription scene;
        for (const SceneSection& each : kSections)
            addOwner(scene, each.id);
        return scene;
    }();
    return key.locate(ownerOf(usual, section.id, 0));
}

SceneCounts countsOf(const SceneDescription& scene) {
    SceneCounts counts;
    for (const BodyDescription& body : scene.bodies) {
        const uint64_t pieces = std::max<uint32_t>(1, body.shape.cells.sites);
        counts.pieces += pieces;
        counts.bodies += body.shape.cells.broken ? pieces : 1;
    }
    counts.colliders = scene.colliders.size();
    return counts;
}

} // namespace brittle
