#include "modules/brittle/godot/nodes/brittle_world.h"

#include "modules/brittle/godot/interface/messages.h"

#include <algorithm>

namespace brittle_godot {
namespace {

constexpr int kNotificationEnterTree = 10, kNotificationExitTree = 11, kNotificationInternalPhysicsProcess = 26,
              kNotificationVisibilityChanged = 43;

} // namespace

BrittleWorldDef WorldNode::madeToBeDrawn() {
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.has_surfaces = 1;
    return def;
}

WorldNode::~WorldNode() {
    *is_alive_ = false;
    stop();
}

// In the editor nothing moves.
void WorldNode::notice(int what) {
    switch (what) {
    case kNotificationEnterTree:
        has_failed_ = false;
        if (!singleton("Engine").call("is_editor_hint").asBool()) self().call("set_physics_process_internal", {true});
        return;
    case kNotificationExitTree: stop(); return;
    case kNotificationInternalPhysicsProcess: frame(self().call("get_physics_process_delta_time").asFloat()); return;
    case kNotificationVisibilityChanged:
        if (fragments_ != nullptr) fragments_->setVisible(self().call("is_visible_in_tree").asBool());
        return;
    default: return;
    }
}

void WorldNode::fail(const std::string& message) {
    has_failed_ = true;
    tellError(self().call("to_string").asString() + ": " + message);
}

bool WorldNode::start() {
    if (isStarted()) return true;
    try {
        Gathered gathered = gather(self(), def);
        if (gathered.links.empty()) throw Failure("there is no BrittleBody3D below it");
        auto shared = SharedContext::open(static_cast<DeviceChoice>(std::min<uint32_t>(device, 1)));
        shared->thread().run([&] { world_ = std::make_unique<RunningWorld>(shared, gathered.plan); });
        shared_ = std::move(shared);
        joinAll(std::move(gathered));
    } catch (const std::exception& e) {
        fail(e.what());
        return false;
    }
    const auto is_alive = is_alive_;
    self().call("emit_signal", {"started"});
    return *is_alive && isStarted();
}

void WorldNode::joinAll(Gathered gathered) {
    ++generation_;
    links_ = std::move(gathered.links);
    is_resting_.assign(links_.size(), false);
    for (size_t k = 0; k < links_.size(); ++k)
        link_of_[world_->ids()[k]] = k;
    fragments_ = std::make_unique<Fragments>();
    fragments_->setVisible(self().call("is_visible_in_tree").asBool());
    mail_ = std::make_shared<Mail>();
    owed_seconds_ = 0;
    told_outcomes_ = 0;
    for (const Link& link : links_)
        if (link.copy == 0) link.node->join(this);
}

void WorldNode::stop() {
    ++generation_;
    for (const Link& link : links_)
        if (link.node != nullptr && link.copy == 0) link.node->join(nullptr);
    links_.clear();
    link_of_.clear();
    fragments_.reset();
    mail_.reset();
    if (world_ != nullptr) shared_->thread().run([this] { world_.reset(); });
    shared_.reset();
}

bool WorldNode::restart() {
    const auto kept_for_the_next = shared_;
    for (const Link& link : links_)
        if (link.node != nullptr && link.copy == 0) link.node->returnToStart();
    stop();
    has_failed_ = false;
    return start();
}

void WorldNode::forget(const BodyNode& body) {
    for (Link& link : links_)
        if (link.node == &body) link.node = nullptr;
}

// Steps are as long as the world says, whatever a physics frame is; what does not fit waits for the next frame.
void WorldNode::frame(double seconds) {
    constexpr double kMostOwed = 8; // steps: a machine that is too slow for more shows less than real time
    if (!is_active || has_failed_) return;
    if (!isStarted() && !start()) return;
    owed_seconds_ = std::min(owed_seconds_ + seconds, kMostOwed * def.dt);
    postSteps();
    collect();
}

void WorldNode::postSteps() {
    constexpr double kRounding = 1e-9; // s, so that sixty frames of a sixtieth are sixty steps
    const auto steps = static_cast<int>((owed_seconds_ + kRounding) / def.dt);
    if (steps == 0) return;
    {
        const std::scoped_lock lock(mail_->mutex);
        if (mail_->is_busy) return;
        mail_->is_busy = true;
    }
    owed_seconds_ -= steps * def.dt;
    shared_->thread().post([world = world_.get(), mail = mail_, steps] {
        std::vector<Report> reports;
        for (int k = 0; k < steps && (reports.empty() || reports.back().failure.empty()); ++k)
            reports.push_back(world->step());
        const std::scoped_lock lock(mail->mutex);
        std::ranges::move(reports, std::back_inserter(mail->reports));
        mail->is_busy = false;
    });
}

void WorldNode::collect() {
    const auto is_alive = is_alive_;
    const uint64_t generation = generation_;
    std::vector<Report> reports;
    {
        const std::scoped_lock lock(mail_->mutex);
        reports.swap(mail_->reports);
    }
    for (const Report& report : reports)
        if (!*is_alive || generation_ != generation || !takeIn(report)) return;
}

bool WorldNode::attempt(const char* what, const std::function<void()>& job) {
    try {
        if (!isStarted()) throw Failure("the world has not been started");
        shared_->thread().run(job);
        return true;
    } catch (const std::exception& e) {
        tellError(self().call("to_string").asString() + ": " + what + ": " + e.what());
        return false;
    }
}

bool WorldNode::step(int64_t steps) {
    if (has_failed_ || (!isStarted() && !start())) return false;
    const auto is_alive = is_alive_;
    const uint64_t generation = generation_;
    for (int64_t k = 0; k < steps; ++k) {
        Report report;
        if (!attempt("step", [&] { report = world_->step(); })) return false;
        collect();
        if (!*is_alive || generation_ != generation || !takeIn(report)) return false;
    }
    return true;
}

bool WorldNode::damage(const Vec3& point, double radius, double energy) {
    return attempt("damage", [&] { world_->damage(toBrittle(point), radius, energy); });
}

std::vector<uint8_t> WorldNode::save() {
    std::vector<uint8_t> bytes;
    attempt("save_state", [&] { bytes = world_->save(); });
    return bytes;
}

bool WorldNode::restore(const std::vector<uint8_t>& bytes) {
    Report report;
    const bool is_restored = attempt("restore_state", [&] {
        world_->restore(bytes);
        report = world_->look();
    });
    if (!is_restored) return false;
    {
        const std::scoped_lock lock(mail_->mutex);
        mail_->reports.clear(); // of what now never was
    }
    is_resting_.assign(is_resting_.size(), false);
    has_failed_ = false;
    return takeIn(report);
}

int64_t WorldNode::hash() {
    uint64_t hash = 0;
    attempt("hash_state", [&] { hash = world_->hash(); });
    return static_cast<int64_t>(hash);
}

} // namespace brittle_godot
