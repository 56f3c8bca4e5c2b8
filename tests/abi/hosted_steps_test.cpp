// Steps in a host's own command buffers, blows by hand, draws, and several hosts at a time.
#include "tests/abi/hosting.h"

#include <atomic>
#include <cmath>
#include <cstring>
#include <set>
#include <thread>

namespace {

using namespace abi_test;

void recordInto(Hosting& host, BrittleWorld world, uint32_t steps) {
    host.device().submit([&](VkCommandBuffer commands) {
        EXPECT_EQ(brittleRecordSteps(host, world, commands, steps), BRITTLE_OK) << host.error();
    });
}

TEST(AbiHostedSteps, AreTheSameAsThoseThatBrittleSubmits) {
    Hosting host;
    const std::vector<BrittleBodyDef> cubes = {glassCube(host, 1)};
    const Scene own = makeScene(host, cubes), hosted = makeScene(host, cubes);
    MUST(host, brittleStep(host, own.world, 45));
    for (int k = 0; k < 3; ++k) {
        recordInto(host, hosted.world, 7);
        recordInto(host, hosted.world, 8); // in flight one after the other, before they are finished
        MUST(host, brittleFinishSteps(host, hosted.world));
    }
    EXPECT_EQ(hashOf(host, own.world), hashOf(host, hosted.world));
    EXPECT_EQ(breaksOf(host, hosted.world).size(), 1u);
    EXPECT_GT(host.device().locked(), 0u) << "the host is asked before its queue is used";
}

// Where pairs grow the steps after that one idle, and are made up for.
TEST(AbiHostedSteps, ThatFoundTooLittleRoomAreMadeOnceThereIsMore) {
    Hosting host;
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS;
    std::vector<BrittleBodyDef> crowd(48, brittleDefaultBodyDef()); // all in one place: 1128 pairs and those with the ground
    for (BrittleBodyDef& body : crowd)
        body.position.y = 0.45;
    const Scene own = makeScene(host, crowd, def), hosted = makeScene(host, crowd, def);
    MUST(host, brittleStep(host, own.world, 6));
    recordInto(host, hosted.world, 6);
    MUST(host, brittleFinishSteps(host, hosted.world));
    EXPECT_EQ(hashOf(host, own.world), hashOf(host, hosted.world));
}

TEST(AbiHostedSteps, ThatWereNeverSubmittedAreMadeAtTheEnd) {
    Hosting host;
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = BRITTLE_EFFECT_GRAVITY;
    BrittleBodyDef body = brittleDefaultBodyDef();
    body.position.y = 50;
    const Scene own = makeScene(host, {body}, def), hosted = makeScene(host, {body}, def);
    MUST(host, brittleStep(host, own.world, 3));
    BrittleVulkan vulkan = host.device().vulkan();
    const VolkDeviceTable& vk = host.device().vk();
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool pool = VK_NULL_HANDLE;
    vk.vkCreateCommandPool(vulkan.device, &pool_info, nullptr, &pool);
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vk.vkAllocateCommandBuffers(vulkan.device, &allocate, &commands);
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    vk.vkBeginCommandBuffer(commands, &begin);
    EXPECT_EQ(brittleRecordSteps(host, hosted.world, commands, 3), BRITTLE_OK) << host.error();
    vk.vkEndCommandBuffer(commands);
    vk.vkDestroyCommandPool(vulkan.device, pool, nullptr);
    MUST(host, brittleFinishSteps(host, hosted.world));
    EXPECT_EQ(hashOf(host, own.world), hashOf(host, hosted.world));
}

TEST(AbiSteps, ThatFailedForABudgetOfPairsAreMadeAfterItIsRaised) {
    Hosting host;
    std::vector<BrittleBodyDef> cubes;
    for (int k = 0; k < 6; ++k) {
        cubes.push_back(glassCube(host, 0.3 + 0.2 * k));
        cubes.back().velocity = {0, 0, 0};
    }
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.budget.pairs = 2;
    const Scene scene = makeScene(host, cubes, def);
    ASSERT_EQ(brittleStep(host, scene.world, 1), BRITTLE_CAPACITY);
    EXPECT_EQ(brittleSetBudget(host, scene.world, 1, 0), BRITTLE_BAD_VALUE);
    EXPECT_EQ(brittleSetBudget(host, scene.world, 20'000'000, 0), BRITTLE_BAD_VALUE);
    EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_CAPACITY);
    MUST(host, brittleSetBudget(host, scene.world, 1000, 0));
    MUST(host, brittleStep(host, scene.world, 5));
    EXPECT_GT(countsOf(host, scene.world).pairs, 2u);
}

// ---- blows by hand ---------------------------------------------------------------------------------------------------------

// Glass that lies apart on a ledge that does not move, where nothing else happens.
BrittleBodyDef restingCube(const Hosting& host, double x) {
    BrittleBodyDef cube = glassCube(host, 0.1);
    cube.rotation = {0, 0, 0, 1};
    cube.position.x = x;
    return cube;
}

TEST(AbiDamage, BreaksWhatIsWithinReachAndNothingElse) {
    Hosting host;
    const Scene scene = makeScene(host, {restingCube(host, 0), restingCube(host, 1)});
    MUST(host, brittleStep(host, scene.world, 60));
    EXPECT_TRUE(breaksOf(host, scene.world).empty());
    MUST(host, brittleDamage(host, scene.world, {0, 0.2, 0}, 0.05, 30));
    MUST(host, brittleStep(host, scene.world, 1));
    const auto breaks = breaksOf(host, scene.world);
    ASSERT_EQ(breaks.size(), 1u);
    EXPECT_EQ(breaks[0].body.id, scene.bodies[0].id);
    EXPECT_EQ(breaks[0].hit_by.id, 0u) << "nothing hit it";
    EXPECT_GE(breaks[0].fragments, 2u);
    EXPECT_NEAR(breaks[0].position.y, 0.2, 0.01);
    EXPECT_LE(breaks[0].crack_energy, 30);
    EXPECT_NEAR(breaks[0].energy_before, breaks[0].energy_after, 1e-9) << "cracks are paid for by the hand";
    BrittleBodyState state;
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[1], &state));
    MUST(host, brittleStep(host, scene.world, 1));
    EXPECT_TRUE(breaksOf(host, scene.world).empty()) << "it struck once";
}

TEST(AbiDamage, IsJudgedByItsEnergy) {
    Hosting host;
    const Scene scene = makeScene(host, {restingCube(host, 0)});
    for (const double weak : {1e-9, 1e-2}) {
        MUST(host, brittleDamage(host, scene.world, {0, 0.2, 0}, 0.05, weak));
        MUST(host, brittleStep(host, scene.world, 1));
        EXPECT_TRUE(breaksOf(host, scene.world).empty()) << weak << " J";
    }
    MUST(host, brittleDamage(host, scene.world, {0, 0.3, 0}, 0.05, 500));
    MUST(host, brittleStep(host, scene.world, 1));
    EXPECT_TRUE(breaksOf(host, scene.world).empty()) << "10 cm above it, and reaching 5";
    MUST(host, brittleDamage(host, scene.world, {0, 0.3, 0}, 0.15, 500));
    MUST(host, brittleStep(host, scene.world, 1));
    EXPECT_EQ(breaksOf(host, scene.world).size(), 1u);
}

// Two of one kind, each as far: half of it for each, so that as much in all makes less of each than of one alone.
TEST(AbiDamage, IsSharedAmongAllThatItReaches) {
    Hosting host;
    const Scene alone = makeScene(host, {restingCube(host, -0.3)}),
                both = makeScene(host, {restingCube(host, -0.3), restingCube(host, 0.3)});
    const auto cracksOf = [&](const Scene& scene, double energy) {
        EXPECT_EQ(brittleDamage(host, scene.world, {0, 0.1, 0}, 0.25, energy), BRITTLE_OK) << host.error();
        EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_OK) << host.error();
        return breaksOf(host, scene.world);
    };
    const auto one = cracksOf(alone, 400), two = cracksOf(both, 800);
    ASSERT_EQ(one.size(), 1u);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0].speed, one[0].speed) << "400 J for each";
    EXPECT_EQ(two[0].fragments, one[0].fragments);
}

TEST(AbiDamage, WakesWhatSleepsAndWhatLiesOnIt) {
    Hosting host;
    BrittleBodyDef upper = brittleDefaultBodyDef();
    upper.shape.size = {0.2, 0.2, 0.2};
    upper.position.y = 0.3;
    const Scene scene = makeScene(host, {restingCube(host, 0), upper});
    BrittleBodyState state;
    for (int k = 0; k < 10; ++k) {
        MUST(host, brittleStep(host, scene.world, 30));
        MUST(host, brittleGetBody(host, scene.world, scene.bodies[1], &state));
        if (state.is_asleep) break;
    }
    ASSERT_EQ(state.is_asleep, 1u);
    MUST(host, brittleStep(host, scene.world, 5)); // the world as a whole idles by now
    MUST(host, brittleDamage(host, scene.world, {0.1, 0.1, 0}, 0.05, 60));
    recordInto(host, scene.world, 1);
    MUST(host, brittleFinishSteps(host, scene.world));
    EXPECT_EQ(breaksOf(host, scene.world).size(), 1u);
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[1], &state));
    EXPECT_EQ(state.is_asleep, 0u);
    MUST(host, brittleStep(host, scene.world, 60));
    MUST(host, brittleGetBody(host, scene.world, scene.bodies[1], &state));
    EXPECT_LT(state.position.y, 0.299) << "what it lay on has gone to pieces";
}

TEST(AbiDamage, RefusesWhatIsNoBlow) {
    Hosting host;
    const Scene scene = makeScene(host, {restingCube(host, 0)});
    const double nan = std::nan(""), inf = HUGE_VAL;
    for (const BrittleVec3 point : {BrittleVec3{nan, 0, 0}, BrittleVec3{0, inf, 0}, BrittleVec3{0, 0, 2e6}})
        EXPECT_EQ(brittleDamage(host, scene.world, point, 1, 1), BRITTLE_BAD_VALUE);
    for (const double number : {nan, inf, 0.0, -1.0}) {
        EXPECT_EQ(brittleDamage(host, scene.world, {0, 0, 0}, number, 1), BRITTLE_BAD_VALUE);
        EXPECT_EQ(brittleDamage(host, scene.world, {0, 0, 0}, 1, number), BRITTLE_BAD_VALUE);
    }
    for (int k = 0; k < 32; ++k)
        MUST(host, brittleDamage(host, scene.world, {0, 100, 0}, 1, 1));
    EXPECT_EQ(brittleDamage(host, scene.world, {0, 100, 0}, 1, 1), BRITTLE_CAPACITY);
    MUST(host, brittleStep(host, scene.world, 1));
    MUST(host, brittleDamage(host, scene.world, {0, 100, 0}, 1, 1));
}

// ---- draws -----------------------------------------------------------------------------------------------------------------

struct Drawn {
    std::vector<BrittleVertex> vertices; // by index, where they are in the world
    std::set<uint32_t> bodies;           // numbers of those that have instances
};

struct Command {
    uint32_t index_count, instance_count, first_index;
    int32_t vertex_offset;
    uint32_t first_instance;
};

template <class T>
std::vector<T> readAll(HostDevice& device, VkBuffer buffer, uint64_t offset, uint64_t bytes) {
    const auto raw = device.read(buffer, offset, bytes / sizeof(T) * sizeof(T));
    std::vector<T> list(raw.size() / sizeof(T));
    std::memcpy(list.data(), raw.data(), raw.size());
    return list;
}

// What a GPU would make of the one indirect draw.
std::vector<std::array<double, 3>> drawnCorners(HostDevice& device, const BrittleDrawBuffers& b, std::set<uint32_t>& bodies) {
    const auto vertices = readAll<BrittleVertex>(device, b.vertex_buffer, b.vertex_offset, b.vertex_bytes);
    const auto indices = readAll<uint32_t>(device, b.index_buffer, b.index_offset, b.index_bytes);
    const auto commands = readAll<Command>(device, b.draw_buffer, b.draw_offset, uint64_t{b.draw_count} * b.draw_stride);
    const auto matrices = readAll<std::array<float, 16>>(device, b.matrix_buffer, b.matrix_offset, b.matrix_bytes);
    const auto owners = readAll<BrittleDrawnBody>(device, b.body_buffer, b.body_offset, b.body_bytes);
    std::vector<std::array<double, 3>> corners;
    for (const Command& c : commands) {
        if (c.instance_count == 0 || c.index_count == 0) continue;
        const auto& m = matrices[c.first_instance / 2];
        bodies.insert(owners[c.first_instance / 2].body);
        for (uint32_t k = 0; k < c.index_count; ++k) {
            const float* p = vertices[indices[c.first_index + k] + static_cast<uint32_t>(c.vertex_offset)].position;
            std::array<double, 3> at;
            for (size_t x = 0; x < 3; ++x)
                at[x] = double{m[x]} * p[0] + double{m[4 + x]} * p[1] + double{m[8 + x]} * p[2] + double{m[12 + x]};
            corners.push_back(at);
        }
    }
    return corners;
}

std::array<double, 3> turned(const BrittleQuat& q, const float* v) {
    const double t[3] = {2 * (q.y * v[2] - q.z * v[1]), 2 * (q.z * v[0] - q.x * v[2]), 2 * (q.x * v[1] - q.y * v[0])};
    return {v[0] + q.w * t[0] + q.y * t[2] - q.z * t[1], v[1] + q.w * t[1] + q.z * t[0] - q.x * t[2],
            v[2] + q.w * t[2] + q.x * t[1] - q.y * t[0]};
}

// The same from surfaces in memory and states of bodies.
std::vector<std::array<double, 3>> expectedCorners(const Hosting& host, BrittleWorld world, const BrittleVec3& origin,
                                                   std::set<uint32_t>& numbers) {
    std::vector<std::array<double, 3>> corners;
    for (const BrittleBodyState& s : bodiesOf(host, world)) {
        uint32_t count = 0, outer = 0, number = 0;
        brittleGetSurface(host, world, s.body, nullptr, 0, &count, &outer);
        std::vector<BrittleVertex> surface(count);
        EXPECT_EQ(brittleGetSurface(host, world, s.body, surface.data(), count, &count, &outer), BRITTLE_OK) << host.error();
        EXPECT_EQ(brittleNumberOf(host, world, s.body, &number), BRITTLE_OK);
        numbers.insert(number);
        for (const BrittleVertex& v : surface) {
            const auto p = turned(s.rotation, v.position);
            corners.push_back({s.position.x + p[0] - origin.x, s.position.y + p[1] - origin.y, s.position.z + p[2] - origin.z});
        }
    }
    return corners;
}

void expectDrawn(Hosting& host, BrittleWorld world, const BrittleDrawBuffers& buffers, const BrittleVec3& origin) {
    std::set<uint32_t> drawn_bodies, bodies;
    auto drawn = drawnCorners(host.device(), buffers, drawn_bodies), expected = expectedCorners(host, world, origin, bodies);
    EXPECT_EQ(drawn_bodies, bodies);
    ASSERT_EQ(drawn.size(), expected.size());
    double furthest = 0;
    for (size_t k = 0; k < drawn.size(); ++k)
        for (size_t x = 0; x < 3; ++x)
            furthest = std::max(furthest, std::abs(drawn[k][x] - expected[k][x]));
    EXPECT_LT(furthest, 2e-4); // of a plane of a kilometer at most
}

TEST(AbiDraws, AreWhatThereIs) {
    Hosting host;
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.budget.pairs = 20000; // so that buffers stay where they are
    BrittleBodyDef plain = brittleDefaultBodyDef();
    plain.position = {3, 0.7, 0};
    plain.rotation = {0.1, 0.2, 0.3, 1};
    const Scene scene = makeScene(host, {glassCube(host, 1), plain}, def);
    BrittleDrawBuffers buffers = {};
    buffers.struct_size = sizeof buffers;
    MUST(host, brittleGetDrawBuffers(host, scene.world, &buffers));
    EXPECT_EQ(buffers.draw_stride, 20u);
    MUST(host, brittleUpdateDraws(host, scene.world, {0, 0, 0}));
    expectDrawn(host, scene.world, buffers, {0, 0, 0});
    const BrittleVec3 origin = {100, -50, 25.5};
    host.device().submit([&](VkCommandBuffer commands) {
        EXPECT_EQ(brittleRecordSteps(host, scene.world, commands, 40), BRITTLE_OK) << host.error();
        EXPECT_EQ(brittleRecordDraws(host, scene.world, commands, origin), BRITTLE_OK) << host.error();
    });
    MUST(host, brittleFinishSteps(host, scene.world));
    EXPECT_EQ(breaksOf(host, scene.world).size(), 1u);
    expectDrawn(host, scene.world, buffers, origin);
}

TEST(AbiDraws, AreInOtherBuffersOnceTheWorldHasMadeRoom) {
    Hosting host;
    const Scene scene = makeScene(host, {glassCube(host, 1.5)});
    BrittleDrawBuffers first = {}, second = {};
    first.struct_size = second.struct_size = sizeof first;
    MUST(host, brittleGetDrawBuffers(host, scene.world, &first));
    MUST(host, brittleStep(host, scene.world, 60)); // some 250 fragments have more pairs than a cube
    MUST(host, brittleGetDrawBuffers(host, scene.world, &second));
    EXPECT_NE(second.generation, first.generation);
    MUST(host, brittleUpdateDraws(host, scene.world, {0, 0, 0}));
    expectDrawn(host, scene.world, second, {0, 0, 0});
}

TEST(SmallAbiDraws, OfWorldsInWhichNothingBreaksAreThereAsWell) {
    Hosting host;
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS;
    BrittleBodyDef body = brittleDefaultBodyDef();
    body.rotation = {0.1, 0.2, 0.3, 1};
    body.position.y = 2;
    const Scene scene = makeScene(host, {body, body}, def);
    BrittleDrawBuffers buffers = {};
    buffers.struct_size = sizeof buffers;
    MUST(host, brittleGetDrawBuffers(host, scene.world, &buffers));
    MUST(host, brittleStep(host, scene.world, 3));
    MUST(host, brittleUpdateDraws(host, scene.world, {0, 0, 0}));
    expectDrawn(host, scene.world, buffers, {0, 0, 0});
    def.has_surfaces = 0;
    const Scene bare = makeScene(host, {body}, def);
    EXPECT_EQ(brittleGetDrawBuffers(host, bare.world, &buffers), BRITTLE_BAD_VALUE);
    uint32_t count = 0, outer = 0;
    EXPECT_EQ(brittleGetSurface(host, bare.world, bare.bodies[0], nullptr, 0, &count, &outer), BRITTLE_BAD_VALUE);
}

// ---- several at a time -----------------------------------------------------------------------------------------------------

// Another thread of the host uses the queue all the while, under the host's own lock.
TEST(SmallAbiHosts, UseTheirQueueWhileBrittleSteps) {
    Hosting host;
    BrittleWorldDef def = brittleDefaultWorldDef();
    def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS | BRITTLE_EFFECT_FRICTION;
    BrittleBodyDef body = brittleDefaultBodyDef();
    body.position.y = 0.7;
    const Scene scene = makeScene(host, {body}, def), alone = makeScene(host, {body}, def);
    std::atomic<bool> done = false;
    std::atomic<uint32_t> submitted = 0;
    std::thread other([&] {
        while (!done) {
            host.device().submit([&](VkCommandBuffer commands) {
                const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
                host.device().vk().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                                        VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &barrier, 0, nullptr, 0,
                                                        nullptr);
            });
            ++submitted;
        }
    });
    for (int k = 0; k < 20; ++k)
        EXPECT_EQ(brittleStep(host, scene.world, 1), BRITTLE_OK) << host.error();
    done = true;
    other.join();
    EXPECT_GT(submitted, 0u);
    MUST(host, brittleStep(host, alone.world, 20));
    EXPECT_EQ(hashOf(host, scene.world), hashOf(host, alone.world));
}

TEST(SmallAbiHosts, HaveWorldsOnTwoDevicesInTwoThreads) {
    uint64_t hashes[2] = {};
    const auto run = [&](size_t k) {
        Hosting host;
        BrittleWorldDef def = brittleDefaultWorldDef();
        def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS;
        BrittleBodyDef body = brittleDefaultBodyDef();
        body.position.y = 0.55;
        const Scene scene = makeScene(host, {body}, def);
        EXPECT_EQ(brittleStep(host, scene.world, 30), BRITTLE_OK) << host.error();
        hashes[k] = hashOf(host, scene.world);
    };
    std::thread first(run, 0), second(run, 1);
    first.join();
    second.join();
    EXPECT_NE(hashes[0], 0u);
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(AbiHosts, LeaveNothingBehindInAHundredCyclesOfStartedWorlds) {
    const HostDevice device;
    uint64_t first = 0;
    for (int k = 0; k < 100; ++k) {
        BrittleContextDef def = brittleDefaultContextDef();
        def.vulkan = device.vulkan();
        BrittleContext* context = nullptr;
        ASSERT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
        BrittleWorldDef world_def = brittleDefaultWorldDef();
        world_def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS;
        const BrittleBodyDef body_def = brittleDefaultBodyDef();
        BrittleWorld world;
        BrittleBody body;
        MUST(context, brittleCreateWorld(context, &world_def, &world));
        MUST(context, brittleAddBody(context, world, &body_def, &body));
        MUST(context, brittleStartWorld(context, world));
        MUST(context, brittleStep(context, world, 2));
        uint64_t hash = 0;
        MUST(context, brittleHashState(context, world, &hash));
        first = k == 0 ? hash : first;
        EXPECT_EQ(hash, first);
        if (k % 2 == 0) { // or the context does
            MUST(context, brittleDestroyWorld(context, world));
        }
        brittleDestroyContext(context);
    }
    EXPECT_EQ(device.messages(), 0u);
}

// With and without what is used where it is present: the same bits.
TEST(AbiHosts, GetTheSameFromPoorDevicesAsFromRichOnes) {
    const auto hashOn = [](const HostOptions& options) {
        Hosting host(options);
        const Scene scene = makeScene(host, {glassCube(host, 1)});
        EXPECT_EQ(brittleStep(host, scene.world, 40), BRITTLE_OK) << host.error();
        EXPECT_EQ(breaksOf(host, scene.world).size(), 1u);
        return hashOf(host, scene.world);
    };
    EXPECT_EQ(hashOn({}), hashOn({.push_descriptors = true}));
}

} // namespace
