#include "modules/brittle/abi/hosted_world.h"

#include "modules/brittle/abi/field_names.h"
#include "modules/brittle/abi/id_table.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/check_scene.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace brittle::abi {
namespace {

constexpr uint32_t kWorldBits = 17, kNumberBits = 22, kBornBits = 24,
                   kColliders = 1u << (kNumberBits - 1); // colliders' numbers begin there
constexpr size_t kMostWaiting = 1u << 16;                // events kept for a host

uint64_t bodyBits(uint64_t world, uint64_t number, uint64_t born) {
    return static_cast<uint64_t>(Kind::Body) << 60 | (world & ((1u << kWorldBits) - 1)) << (kNumberBits + kBornBits) |
           (number & ((1u << kNumberBits) - 1)) << kBornBits | (born & ((1u << kBornBits) - 1));
}

Eigen::Quaterniond quaternion(const Turn& t) { return Eigen::Quaterniond(t[3], t[0], t[1], t[2]).normalized(); }

// The frame `outer`, as seen from the body at `pose`.
ShapeFrame frameIn(const Pose& pose, const Double3& place, const Turn& turn) {
    const Eigen::Quaterniond relative = quaternion(pose.turn).conjugate() * quaternion(turn);
    return {turnedBack(pose.turn, place - pose.place), {relative.x(), relative.y(), relative.z(), relative.w()}};
}

// More than so many are lost, the newest of them.
template <class Event>
void listenTo(HeardEvents<Event> told, HostedWorld::Waiting<Event>& waiting) {
    const size_t waits = waiting.events.size() + waiting.arrived.size();
    const size_t kept = std::min(told.events.size(), kMostWaiting - waits);
    waiting.arrived.insert(waiting.arrived.end(), told.events.begin(), told.events.begin() + static_cast<ptrdiff_t>(kept));
    waiting.lost += told.lost + static_cast<uint32_t>(told.events.size() - kept);
}

// Into the host's memory. Where it has none, they go on waiting.
template <class Event>
HostedWorld::Waiting<Event>& withArrived(HostedWorld::Waiting<Event>& waiting) {
    waiting.events.insert(waiting.events.end(), waiting.arrived.begin(), waiting.arrived.end());
    waiting.arrived.clear();
    return waiting;
}

template <class Event>
void forget(HostedWorld::Waiting<Event>& waiting) {
    waiting.events.clear();
    waiting.arrived.clear();
}

} // namespace

void HostedWorld::mustNotRun() const {
    if (world_) throw Refusal(BRITTLE_WRONG_ORDER, "the world has been started; all it is made of has to be added before");
}

World& HostedWorld::recording() {
    if (!world_) throw Refusal(BRITTLE_WRONG_ORDER, "the world has not been started; call brittleStartWorld first");
    saved.reset();
    return *world_;
}

World& HostedWorld::running() {
    if (has_recorded_)
        throw Refusal(BRITTLE_WRONG_ORDER,
                      "steps have been recorded; call brittleFinishSteps once the device has finished them");
    if (!world_) return recording();
    return *world_;
}

void HostedWorld::start(engine::Device& device) {
    mustNotRun();
    orRefuseFields(checkScene(scene));
    constexpr uint64_t kMostUsualFragments = 8192;
    if (originalCount() + std::max<uint64_t>(scene.budgets.fragments, kMostUsualFragments) >= kColliders)
        throw Refusal(BRITTLE_CAPACITY, "a world has at most 2 million bodies, colliders and fragments together");
    const auto fracture = orRefuse(fractureFor(scene, device));
    surfaces = {};
    auto contents = orRefuse(contentsOf(scene, {}, fracture.get(), has_surfaces ? &surfaces : nullptr));
    if (has_surfaces) addLooks(contents, surfaces);
    auto settings = orRefuse(settingsOf(scene));
    settings.breaking_seed = seed;
    auto world = orRefuse(World::create(device, contents, settings, budgetOf(scene)));
    findFrames(orRefuse(world->bodies()));
    world_ = std::move(world);
}

void HostedWorld::findFrames(const std::vector<gpu::BodyState>& states) {
    frames.clear();
    for (size_t k = 0; k < scene.bodies.size(); ++k)
        frames.push_back(frameIn(poseOf(states[k]), scene.bodies[k].place, scene.bodies[k].turn));
    for (size_t k = 0; k < scene.colliders.size(); ++k)
        frames.push_back(frameIn(poseOf(states[frames.size()]), scene.colliders[k].place, scene.colliders[k].turn));
}

void HostedWorld::finish() {
    recording();
    const bool had = std::exchange(has_recorded_, false);
    if (had) orRefuse(world_->step(0));
}

BrittleBody HostedWorld::colliderId(uint32_t index) const { return {bodyBits(number_, kColliders + index, 0)}; }

BrittleBody HostedWorld::bodyId(uint32_t slot, uint32_t born) const {
    const bool is_collider = born == 0 && slot >= bodyCount() && slot < originalCount();
    return is_collider ? colliderId(slot - bodyCount()) : BrittleBody{bodyBits(number_, slot, born)};
}

HostedWorld::Named HostedWorld::named(BrittleBody body) const {
    const auto born = static_cast<uint32_t>(body.id & ((1u << kBornBits) - 1));
    const auto number = static_cast<uint32_t>(body.id >> kBornBits & ((1u << kNumberBits) - 1));
    const bool is_collider = number >= kColliders;
    const uint32_t slot = is_collider ? bodyCount() + number - kColliders : number;
    const bool is_original = is_collider ? slot < originalCount() : number < bodyCount();
    if (body.id != bodyBits(number_, number, born) || (born == 0 ? !is_original : is_collider))
        throw Refusal(BRITTLE_WRONG_HANDLE, "this id was never one of a body of this world");
    return {slot, born};
}

void HostedWorld::listenForBreaks() { listenTo(orRefuse(running().breaks()), breaks_); }

void HostedWorld::listenForImpacts() { listenTo(orRefuse(running().impacts()), impacts_); }

void HostedWorld::listen() {
    listenForBreaks();
    listenForImpacts();
}

HostedWorld::Waiting<gpu::BreakEvent>& HostedWorld::hearBreaks() {
    listenForBreaks();
    return withArrived(breaks_);
}

HostedWorld::Waiting<gpu::ImpactEvent>& HostedWorld::hearImpacts() {
    listenForImpacts();
    return withArrived(impacts_);
}

void HostedWorld::countLost() {
    try {
        listen();
    } catch (const Refusal&) { // a step has failed, and the world is still to be restored
    }
}

void HostedWorld::forgetEvents() {
    const uint32_t breaks_lost = breaks_.lost, impacts_lost = impacts_.lost;
    listen();
    forget(breaks_);
    forget(impacts_);
    breaks_.lost = breaks_lost;
    impacts_.lost = impacts_lost;
}

BrittleMaterial HostedWorld::materialOf(uint32_t slot) const {
    if (slot >= bodyCount()) return {};
    for (const auto& [id, name] : material_names)
        if (name == scene.bodies[slot].material) return {id};
    return {};
}

} // namespace brittle::abi
