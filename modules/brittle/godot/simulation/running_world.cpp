#include "modules/brittle/godot/simulation/running_world.h"

#include <algorithm>

namespace brittle_godot {
namespace {

BrittleMeshDef defOf(const MeshPlan& plan) {
    const Triangles& t = plan.triangles;
    BrittleMeshDef def = brittleDefaultMeshDef();
    def.vertex_count = static_cast<uint32_t>(t.vertexCount());
    def.positions = t.positions.data();
    def.normals = t.normals.empty() ? nullptr : t.normals.data();
    def.uvs = t.uvs.empty() ? nullptr : t.uvs.data();
    def.index_count = static_cast<uint32_t>(t.indices.size());
    def.indices = t.indices.data();
    def.is_open = plan.is_open ? 1 : 0;
    return def;
}

BrittleColliderDef colliderOf(const BrittleBodyDef& body) {
    BrittleColliderDef def = brittleDefaultColliderDef();
    def.shape = body.shape;
    def.position = body.position;
    def.rotation = body.rotation;
    def.friction = body.friction;
    def.restitution = body.restitution;
    return def;
}

} // namespace

RunningWorld::RunningWorld(std::shared_ptr<SharedContext> shared, const WorldPlan& plan) : shared_(std::move(shared)) {
    hears_ = (plan.def.effects & BRITTLE_EFFECT_EVENTS) != 0;
    shared_->must(brittleCreateWorld(shared_->context(), &plan.def, &world_));
    try {
        fill(plan);
        shared_->must(brittleStartWorld(shared_->context(), world_));
    } catch (...) {
        brittleDestroyWorld(shared_->context(), world_);
        throw;
    }
}

RunningWorld::~RunningWorld() { brittleDestroyWorld(shared_->context(), world_); }

// Meshes and materials are needed until the bodies have been added.
void RunningWorld::fill(const WorldPlan& plan) {
    BrittleContext* context = shared_->context();
    std::vector<BrittleMesh> meshes;
    std::vector<BrittleMaterial> materials;
    const auto release = [&] {
        for (const BrittleMesh mesh : meshes)
            brittleDestroyMesh(context, mesh);
        for (const BrittleMaterial material : materials)
            brittleDestroyMaterial(context, material);
    };
    try {
        for (const MaterialPlan& material : plan.materials) {
            BrittleMaterialDef def = material.def;
            def.like = material.like.c_str();
            shared_->must(brittleCreateMaterial(context, &def, &materials.emplace_back()));
        }
        meshes.resize(plan.meshes.size());
        for (const BodyPlan& body : plan.bodies) {
            if (body.mesh != kNone && meshes[body.mesh].id == 0) {
                const BrittleMeshDef def = defOf(plan.meshes[body.mesh]);
                if (brittleCreateMesh(context, &def, &meshes[body.mesh]) != BRITTLE_OK)
                    throw Failure(body.who + ": " + brittleLastError(context));
            }
            add(body, meshes, materials);
        }
    } catch (...) {
        release();
        throw;
    }
    release();
}

void RunningWorld::add(const BodyPlan& plan, const std::vector<BrittleMesh>& meshes,
                       const std::vector<BrittleMaterial>& materials) {
    BrittleBodyDef def = plan.def;
    if (plan.mesh != kNone) def.shape.mesh = meshes[plan.mesh];
    if (plan.material != kNone) def.material = materials[plan.material];
    def.shape.points = plan.hull.data();
    def.shape.point_count = static_cast<uint32_t>(plan.hull.size());
    const BrittleColliderDef collider = colliderOf(def);
    BrittleBody body = {0};
    const BrittleResult result = plan.is_collider ? brittleAddCollider(shared_->context(), world_, &collider, &body)
                                                  : brittleAddBody(shared_->context(), world_, &def, &body);
    if (result != BRITTLE_OK) throw Failure(plan.who + ": " + brittleLastError(shared_->context()));
    ids_.push_back(body.id);
}

// BAD_VALUE: a body that outgrew its numbers was stopped, and the step was made.
Report RunningWorld::step() {
    const BrittleResult result = brittleStep(shared_->context(), world_, 1);
    const std::string trouble = result == BRITTLE_OK ? "" : brittleLastError(shared_->context());
    const bool is_made = result == BRITTLE_OK || result == BRITTLE_BAD_VALUE;
    Report report = is_made ? told() : Report();
    if (is_made)
        report.warning = trouble;
    else
        report.failure = trouble;
    return report;
}

Report RunningWorld::look() { return told(); }

Report RunningWorld::told() {
    Report report;
    try {
        report.breaks = heard(brittleGetBreaks);
        report.impacts = heard(brittleGetImpacts);
        report.bodies = bodies();
        report.surfaces = newSurfaces(report.bodies);
    } catch (const Failure& failure) {
        report = {};
        report.failure = failure.what();
    }
    return report;
}

std::vector<BrittleBodyState> RunningWorld::bodies() {
    std::vector<BrittleBodyState> states(ids_.size() + known_fragments_.size());
    uint32_t count = 0;
    BrittleResult result = BRITTLE_BUFFER_TOO_SMALL;
    while (result == BRITTLE_BUFFER_TOO_SMALL) {
        result = brittleGetBodies(shared_->context(), world_, states.data(), static_cast<uint32_t>(states.size()), &count);
        states.resize(count);
    }
    shared_->must(result);
    return states;
}

template <class Event>
std::vector<Event> RunningWorld::heard(BrittleResult (*get)(BrittleContext*, BrittleWorld, Event*, uint32_t, uint32_t*)) {
    constexpr uint32_t kAtATime = 64;
    std::vector<Event> all;
    uint32_t told = hears_ ? kAtATime : 0;
    while (told == kAtATime) {
        const size_t before = all.size();
        all.resize(before + kAtATime);
        shared_->must(get(shared_->context(), world_, all.data() + before, kAtATime, &told));
        all.resize(before + told);
    }
    return all;
}

std::vector<FragmentSurface> RunningWorld::newSurfaces(const std::vector<BrittleBodyState>& states) {
    std::vector<BrittleBody> fresh;
    std::unordered_set<uint64_t> there;
    for (const BrittleBodyState& state : states) {
        if (state.is_fragment == 0) continue;
        there.insert(state.body.id);
        if (!known_fragments_.contains(state.body.id)) fresh.push_back(state.body);
    }
    known_fragments_ = std::move(there);
    return fresh.empty() ? std::vector<FragmentSurface>() : surfacesOf(fresh);
}

std::vector<FragmentSurface> RunningWorld::surfacesOf(const std::vector<BrittleBody>& fragments) {
    constexpr size_t kUsual = 600; // vertices of a fragment: a second reading is rare
    const auto number = static_cast<uint32_t>(fragments.size());
    std::vector<BrittleVertex> vertices(kUsual * number);
    std::vector<uint32_t> counts(number), outers(number);
    uint32_t total = 0;
    BrittleResult result = BRITTLE_BUFFER_TOO_SMALL;
    while (result == BRITTLE_BUFFER_TOO_SMALL) {
        vertices.resize(std::max<size_t>(vertices.size(), total));
        result = brittleGetSurfaces(shared_->context(), world_, fragments.data(), number, vertices.data(),
                                    static_cast<uint32_t>(vertices.size()), &total, counts.data(), outers.data());
    }
    shared_->must(result);
    std::vector<FragmentSurface> surfaces;
    auto next = vertices.begin();
    for (uint32_t k = 0; k < number; ++k) {
        surfaces.push_back({fragments[k].id, {next, next + counts[k]}, outers[k]});
        next += counts[k];
    }
    return surfaces;
}

void RunningWorld::damage(const BrittleVec3& point, double radius, double energy) {
    shared_->must(brittleDamage(shared_->context(), world_, point, radius, energy));
}

std::vector<uint8_t> RunningWorld::save() {
    size_t size = 0;
    shared_->must(brittleSaveState(shared_->context(), world_, nullptr, 0, &size));
    std::vector<uint8_t> bytes(size);
    shared_->must(brittleSaveState(shared_->context(), world_, bytes.data(), bytes.size(), &size));
    return bytes;
}

void RunningWorld::restore(const std::vector<uint8_t>& bytes) {
    shared_->must(brittleRestoreState(shared_->context(), world_, bytes.data(), bytes.size()));
}

uint64_t RunningWorld::hash() {
    uint64_t hash = 0;
    shared_->must(brittleHashState(shared_->context(), world_, &hash));
    return hash;
}

} // namespace brittle_godot
