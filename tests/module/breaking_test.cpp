// What breaks on the device, by one recording that knows no size of it, breaks as the host would have it.
#include "modules/brittle/breaking/break.h"
#include "modules/brittle/fracture/batch.h"
#include "modules/brittle/fracture/fetch.h"
#include "modules/brittle/fracture/readback.h"
#include "modules/brittle/fracture/scene_buffers.h"
#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_fragments.h"
#include "tests/module/whole_fracture.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using breaking_test::Breaking, breaking_test::breakingFragments;
using brittle::BreakingEvent, brittle::FractureResult;

engine::Device& device() { return engine_test::device(); }

brittle::BreakingRoom roomOf(const Breaking& breaking) {
    const auto objects = static_cast<uint32_t>(breaking.records.size());
    return {brittle::roomFor(objects + 1, breaking.corners / 3 + 100), breaking.sites + 10, breaking.records.front().sites.y};
}

BreakingEvent planFor(const Breaking& breaking, uint32_t collider = 0) {
    return brittle::planBreaking(device(), GROUP_SIZE, roomOf(breaking), collider);
}

struct Outcome {
    std::vector<uint32_t> status;
    FractureResult all;
    std::vector<uint32_t> site_objects;
};

// Records once, and breaks as much as it is asked for, as often as it is.
class BreakDevice {
public:
    BreakDevice(const Breaking& breaking, BreakingEvent event)
        : breaking_(breaking), event_(std::move(event)), kernels_(device(), shaders::all()), commands_(device()) {
        layOut();
        record();
    }

    Outcome run(uint32_t objects) {
        ask(objects);
        const auto submitted = again_ ? commands_.submitAgain() : commands_.submit();
        EXPECT_TRUE(submitted) << submitted.error().message;
        EXPECT_TRUE(commands_.wait());
        again_ = true;
        Outcome out;
        auto read = brittle::readBack(device(), {}, event_.grid, {}, event_.b, scene_->views(), out.all, out.site_objects);
        EXPECT_TRUE(read) << read.error().message;
        out.status = std::move(*read);
        if (out.status[STATUS_FAILED] == 0 && event_.capacity.collider_directions != 0)
            out.all.fragments.colliders = *brittle::readColliders(device(), out.status, event_.b, colliders_->views());
        return out;
    }

    // Workgroups of all dispatches whose number the device decides.
    uint64_t indirectGroups() const {
        uint64_t groups = 0;
        for (const engine::TracedCommand& command : commands_.trace()) {
            if (command.kind != engine::TracedCommand::Kind::Indirect) continue;
            std::array<uint32_t, 3> args{};
            const brittle::Fetch fetch[] = {{command.arguments, args.data(), sizeof args}};
            EXPECT_TRUE(brittle::fetch(device(), fetch));
            groups += uint64_t{args[0]} * args[1] * args[2];
        }
        return groups;
    }
    size_t indirectDispatches() const {
        return static_cast<size_t>(
            std::ranges::count(commands_.trace(), engine::TracedCommand::Kind::Indirect, &engine::TracedCommand::kind));
    }

private:
    static constexpr std::array<uint32_t, 4> kAsked = {COUNT_BREAKING, COUNT_SOUP_TRIANGLES, COUNT_SOUP_CORNERS,
                                                       COUNT_ASKED_SITES};

    void layOut() {
        auto plan = engine::ScratchArena::create(device(), 256, "plan");
        brittle::layOutBreaking(*plan, event_);
        arena_.emplace(std::move(*engine::ScratchArena::create(device(), plan->peak(), "breaking")));
        brittle::layOutBreaking(*arena_, event_);
        ASSERT_TRUE(arena_->status());
        scene_.emplace(*brittle::SceneBuffers::create(device(), event_.capacity.emitted, event_.capacity.fragments));
        colliders_.emplace(*brittle::ColliderBuffers::create(device(), event_.capacity));
        const auto upload = [](size_t bytes) {
            return *engine::Buffer::create(device(), bytes, engine::BufferDomain::Readback, 0, "breaking");
        };
        asked_.emplace(upload(4 * kAsked.size()));
        records_.emplace(upload(std::as_bytes(std::span(breaking_.records)).size()));
        vertices_.emplace(upload(std::as_bytes(std::span(breaking_.set.vertices)).size()));
        std::memcpy(records_->mapped(), breaking_.records.data(), records_->size());
        std::memcpy(vertices_->mapped(), breaking_.set.vertices.data(), vertices_->size());
    }

    void record() {
        ASSERT_TRUE(commands_.begin(engine::Commands::Reuse::Many));
        commands_.keepTrace();
        const brittle::EventBuffers& b = event_.b;
        // A pattern, so that no kernel leans on zeros that the recording has not written.
        commands_.fill(arena_->buffer(), 0xcdcdcdcd);
        brittle::Recorder recorder(commands_, kernels_, b.counts, b.args);
        recorder.clear({b.counts, b.args});
        for (size_t k = 0; k < kAsked.size(); ++k)
            commands_.copy(engine::BufferView(*asked_).sub(4 * k, 4), b.counts.sub(4 * kAsked[k], 4));
        for (const uint32_t count : kAsked)
            recorder.publish(count, NO_INDEX);
        brittle::recordBreaking(recorder, event_, *records_, engine::BufferView(*vertices_), scene_->views(),
                                colliders_->views());
        ASSERT_TRUE(recorder.status()) << recorder.status().error().message;
    }

    void ask(uint32_t objects) {
        uint32_t* asked = asked_->mappedAs<uint32_t>();
        const bool all = objects == breaking_.records.size();
        const uint32_t corners = all ? breaking_.corners : breaking_.records[objects].range.w;
        asked[0] = objects;
        asked[1] = corners / 3;
        asked[2] = corners;
        asked[3] = all ? breaking_.sites : breaking_.records[objects].sites.x;
    }

    const Breaking& breaking_;
    BreakingEvent event_;
    engine::KernelLibrary kernels_;
    std::optional<engine::ScratchArena> arena_;
    std::optional<brittle::SceneBuffers> scene_;
    std::optional<brittle::ColliderBuffers> colliders_;
    std::optional<engine::Buffer> asked_, records_, vertices_;
    engine::Commands commands_;
    bool again_ = false;
};

// Of each object, as the host hands them out.
std::vector<FractureResult> partsOf(const Breaking& breaking, const Outcome& out, uint32_t objects) {
    brittle::Batch batch;
    for (uint32_t k = 0; k < objects; ++k) {
        const gpu::BreakingRecord& r = breaking.records[k];
        batch.objects.push_back({breaking.prepared[k].mesh.center, 1 / double{r.center.w}, r.sites.x, r.sites.y});
    }
    return brittle::partResult(batch, out.all, out.site_objects);
}

// Each object's fragments keep their contract, and are those that the host makes of the same sites.
void expectAsTheHostBreaks(const Breaking& breaking, const Outcome& out, uint32_t objects) {
    ASSERT_EQ(out.status[STATUS_FAILED], 0u);
    const auto parts = partsOf(breaking, out, objects);
    std::vector<brittle::BreakingObject> same;
    for (uint32_t k = 0; k < objects; ++k)
        same.push_back({breaking.prepared[k].mesh, breaking.prepared[k].topology, parts[k].sites});
    const auto host = whole::fracture().shatterTogether(same, {});
    ASSERT_TRUE(host) << host.error().message;
    for (uint32_t k = 0; k < objects; ++k) {
        SCOPED_TRACE(k);
        FractureResult bare = parts[k];
        bare.fragments.colliders = {};
        whole::expectContract(whole::modelFrom(breaking.set, k), bare);
        EXPECT_EQ(parts[k].sites, (*host)[k].sites);
        EXPECT_EQ(parts[k].fragments.fragments.size(), (*host)[k].fragments.fragments.size());
        EXPECT_EQ(whole::placesByCell(parts[k]), whole::placesByCell((*host)[k]));
    }
}

Breaking fragmentsToBreak(const char* model, uint32_t fragments, uint32_t sites) {
    Breaking breaking = breakingFragments(model, fragments);
    breaking_test::hit(breaking, sites, 1 << 20, 5);
    return breaking;
}

TEST(DeviceBreaking, FragmentsBreakWithoutTheHostKnowingAnySize) {
    const Breaking breaking = fragmentsToBreak("builtin:ring", 3, 12);
    BreakDevice device(breaking, planFor(breaking));
    const auto objects = static_cast<uint32_t>(breaking.records.size());
    const Outcome out = device.run(objects);
    expectAsTheHostBreaks(breaking, out, objects);
    EXPECT_GE(out.status[COUNT_FRAGMENTS], breaking.sites);
}

TEST(DeviceBreaking, TheSameRecordingBreaksAsMuchAsItIsAskedFor) {
    const Breaking breaking = fragmentsToBreak("builtin:icosphere", 4, 8);
    BreakDevice device(breaking, planFor(breaking));
    for (const uint32_t objects : {4u, 1u, 0u, 3u}) {
        const Outcome out = device.run(objects);
        if (objects != 0) {
            expectAsTheHostBreaks(breaking, out, objects);
            continue;
        }
        EXPECT_EQ(out.status[STATUS_FAILED], 0u);
        EXPECT_EQ(out.status[COUNT_FRAGMENTS], 0u);
        EXPECT_EQ(out.status[COUNT_EMITTED], 0u);
        EXPECT_GT(device.indirectDispatches(), 100u);
        EXPECT_EQ(device.indirectGroups(), 0u);
    }
}

TEST(DeviceBreaking, EveryFragmentHasACollider) {
    const Breaking breaking = fragmentsToBreak("builtin:ring", 3, 10);
    BreakDevice device(breaking, planFor(breaking, 26));
    const Outcome out = device.run(3);
    ASSERT_EQ(out.status[STATUS_FAILED], 0u);
    EXPECT_EQ(out.all.fragments.colliders.pieces.size(), out.all.fragments.fragments.size());
    expectAsTheHostBreaks(breaking, out, 3);
}

void expectNothing(const Outcome& out, std::initializer_list<uint32_t> counts) {
    EXPECT_NE(out.status[STATUS_FAILED], 0u);
    for (const uint32_t count : counts)
        EXPECT_EQ(out.status[count], 0u) << count;
}

TEST(DeviceBreaking, WithoutRoomForTheMeshNothingBreaks) {
    const Breaking breaking = fragmentsToBreak("builtin:ring", 3, 12);
    brittle::BreakingRoom room = roomOf(breaking);
    room.mesh.edges = 20;
    const Outcome out = BreakDevice(breaking, brittle::planBreaking(device(), GROUP_SIZE, room)).run(3);
    size_t edges = 0;
    for (const brittle::PreparedMesh& object : breaking.prepared)
        edges += object.topology.edges.size();
    EXPECT_EQ(out.status[STATUS_NEEDED + COUNT_MESH_EDGES], edges);
    expectNothing(out, {COUNT_MESH_EDGES, COUNT_SITES, COUNT_NEIGHBORS, COUNT_POLYGONS, COUNT_FRAGMENTS, COUNT_EMITTED});
}

TEST(DeviceBreaking, WithoutRoomInAPoolOfTheEventNothingBreaks) {
    const Breaking breaking = fragmentsToBreak("builtin:ring", 3, 12);
    BreakingEvent event = planFor(breaking);
    event.capacity.crossings = 16;
    BreakDevice device(breaking, event);
    const Outcome out = device.run(3);
    EXPECT_GT(out.status[STATUS_NEEDED + COUNT_CROSSINGS], 16u);
    expectNothing(out, {COUNT_CROSSINGS, COUNT_POLYGONS, COUNT_FACES, COUNT_FRAGMENTS, COUNT_EMITTED});
    expectNothing(device.run(2), {COUNT_FRAGMENTS});
    EXPECT_EQ(device.run(0).status[STATUS_FAILED], 0u);
}

// The same as touching_islands_test.cpp has of models.
TEST(DeviceBreaking, NoFragmentHoldsPartsOfSolidsThatTouchAlongAnEdge) {
    using support::operator+;
    for (const double off : {0.0, 6e-8}) { // less than a step of the grid
        Breaking breaking =
            breaking_test::breakingSolid(brittle::makeCube() + support::moved(brittle::makeCube(), 1, {1 + off, 1, 0}));
        breaking_test::hit(breaking, 12, 1 << 20, 5);
        brittle::BreakingRoom room = roomOf(breaking);
        room.touching = true;
        const Outcome out = BreakDevice(breaking, brittle::planBreaking(device(), GROUP_SIZE, room)).run(1);
        expectAsTheHostBreaks(breaking, out, 1);
        uint32_t in_both = 0;
        for (const brittle::Fragment& fragment : out.all.fragments.fragments)
            in_both += fragment.lower[0] < 0.24f && fragment.upper[0] > 0.26f; // the edge lies at 0.25
        EXPECT_EQ(in_both, 0u);
        EXPECT_GT(out.all.fragments.fragments.size(), 12u);
    }
}

TEST(Breaking, ManyBreakAtOnce) {
    const Breaking breaking = fragmentsToBreak("builtin:bumpy:3", 20, 12);
    BreakDevice device(breaking, planFor(breaking));
    const auto objects = static_cast<uint32_t>(breaking.records.size());
    expectAsTheHostBreaks(breaking, device.run(objects), objects);
}

} // namespace
