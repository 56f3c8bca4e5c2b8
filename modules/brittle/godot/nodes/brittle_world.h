// The node BrittleWorld3D: makes a world of the BrittleBody3D below it in the first physics frame, steps it in each, moves the
// nodes, draws the fragments, and tells what happened by signals.
#pragma once

#include "modules/brittle/godot/nodes/fragments.h"
#include "modules/brittle/godot/nodes/gathering.h"

#include <mutex>

namespace brittle_godot {

class WorldNode final : public Instance {
public:
    static void describe(ClassRecord& record);
    WorldNode() = default;
    ~WorldNode() override;
    void notice(int what) override;

    // What the next start makes.
    BrittleWorldDef def = madeToBeDrawn();
    uint32_t device = static_cast<uint32_t>(DeviceChoice::Engine);
    bool is_active = true; // steps by itself

    bool start(); // false, and an error has been told, where that cannot be
    void stop();
    bool restart();
    bool isStarted() const { return world_ != nullptr; }
    void forget(const BodyNode& body);

    // All of these tell an error and give nothing where they cannot.
    bool step(int64_t steps);
    bool damage(const Vec3& point, double radius, double energy);
    std::vector<uint8_t> save();
    bool restore(const std::vector<uint8_t>& bytes);
    int64_t hash();

    const Fragments* fragments() const { return fragments_.get(); }
    Value bodyOf(const DrawnFragment& fragment) const;
    const SharedContext* sharedContext() const { return shared_.get(); }

private:
    // Between the main thread and the device's.
    struct Mail {
        std::mutex mutex;
        std::vector<Report> reports;
        bool is_busy = false;
    };
    // A signal that waits until the report it stands in has been taken in whole: those who hear it may do anything.
    struct Emission {
        Value body;
        const char* name;
        std::vector<Value> arguments; // of the body's own signal; the world's has the body before
        bool is_the_worlds = true;    // its signal as well
    };

    static BrittleWorldDef madeToBeDrawn();
    void frame(double seconds);
    void postSteps();
    void collect();
    bool takeIn(const Report& report); // false where whoever heard of it has ended the world
    void placeBodies(const std::vector<BrittleBodyState>& states);
    void addFragments(const Report& report);
    void placeBody(size_t link, const BrittleBodyState& state);
    void hideBroken(const std::vector<bool>& is_there);
    std::vector<Emission> emissionsOf(const Report& report);
    void addEmissions(const BrittleBreak& event, std::vector<Emission>& emissions);
    void addEmissions(const BrittleImpact& event, std::vector<Emission>& emissions);
    int64_t copyOf(size_t link) const;
    bool emit(const std::vector<Emission>& emissions);
    void warnOfWhole(const BrittleBreak& event);
    size_t linkOf(uint64_t id) const;
    Value nodeOf(size_t link) const;
    bool attempt(const char* what, const std::function<void()>& job);
    void fail(const std::string& message);
    void joinAll(Gathered gathered);

    std::shared_ptr<SharedContext> shared_;
    std::unique_ptr<RunningWorld> world_; // used on the context's thread
    std::unique_ptr<Fragments> fragments_;
    std::shared_ptr<Mail> mail_;
    std::vector<Link> links_;
    std::vector<bool> is_resting_; // of each link: it slept when it was last placed
    std::unordered_map<uint64_t, size_t> link_of_;
    double owed_seconds_ = 0;
    bool has_failed_ = false; // and has said so; only a restart helps
    uint32_t told_outcomes_ = 0;
    std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);
    uint64_t generation_ = 0; // of starts and stops
};

} // namespace brittle_godot
