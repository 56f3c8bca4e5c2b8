// The host's allocator: all comes from it and goes back to it, and where it has none to give nothing is lost.
#include "tests/abi/heap.h"
#include "tests/abi/hosting.h"

namespace {

using namespace abi_test;

TEST(SmallAbiMemory, GivesBackAllThatItTookFromTheHostsAllocator) {
    const HostDevice device;
    Heap heap;
    BrittleContextDef def = defOn(device);
    def.allocator = heap.allocator();
    BrittleContext* context = nullptr;
    ASSERT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
    const size_t at_first = heap.allocations;
    EXPECT_GT(at_first, 0u);
    const HostMesh cube = cubeMesh();
    const BrittleMeshDef mesh_def = cube.def();
    BrittleMesh mesh;
    MUST(context, brittleCreateMesh(context, &mesh_def, &mesh));
    EXPECT_GT(heap.allocations, at_first);
    brittleDestroyContext(context);
    EXPECT_TRUE(heap.blocks.empty());
    EXPECT_FALSE(heap.mixed_up);
}

TEST(SmallAbiMemory, SurvivesAnAllocatorThatRunsOut) {
    const HostDevice device;
    const HostMesh cube = cubeMesh();
    const BrittleMeshDef mesh_def = cube.def();
    bool was_enough = false;
    for (size_t most = 0; !was_enough && most < 50; ++most) {
        Heap heap;
        heap.most = most;
        BrittleContextDef def = defOn(device);
        def.allocator = heap.allocator();
        BrittleContext* context = nullptr;
        const BrittleResult made = brittleCreateContext(&def, &context);
        BrittleMesh mesh = {0};
        const BrittleResult added = made == BRITTLE_OK ? brittleCreateMesh(context, &mesh_def, &mesh) : made;
        was_enough = added == BRITTLE_OK;
        EXPECT_TRUE(was_enough || added == BRITTLE_OUT_OF_MEMORY) << brittleResultName(added);
        EXPECT_EQ(mesh.id != 0, was_enough);
        brittleDestroyContext(context);
        EXPECT_TRUE(heap.blocks.empty()) << "with " << most << " allocations";
    }
    EXPECT_TRUE(was_enough);
}

// The device tells of each once; a host without memory for it asks again.
TEST(AbiMemory, ThatRunsOutLosesNoEvents) {
    Heap heap;
    {
        const Hosting host({}, heap.allocator());
        const Scene scene = makeScene(host, {glassCube(host, 0.2), glassCube(host, 1.5)});
        MUST(host, brittleStep(host, scene.world, 60));
        BrittleBreak breaks[8];
        BrittleImpact impacts[64];
        uint32_t count = 1;
        heap.most = heap.allocations;
        EXPECT_EQ(brittleGetBreaks(host, scene.world, breaks, 8, &count), BRITTLE_OUT_OF_MEMORY);
        EXPECT_EQ(count, 0u);
        EXPECT_EQ(brittleGetImpacts(host, scene.world, impacts, 64, &count), BRITTLE_OUT_OF_MEMORY);
        EXPECT_EQ(brittleGetImpacts(host, scene.world, impacts, 64, &count), BRITTLE_OUT_OF_MEMORY) << "and again";
        heap.most = ~size_t{0};
        MUST(host, brittleGetBreaks(host, scene.world, breaks, 8, &count));
        const BrittleCounts counts = countsOf(host, scene.world);
        EXPECT_GE(count, 1u);
        EXPECT_EQ(count, counts.broken);
        MUST(host, brittleGetImpacts(host, scene.world, impacts, 64, &count));
        EXPECT_GE(count, 1u);
        EXPECT_EQ(counts.breaks_lost + counts.impacts_lost, 0u);
        MUST(host, brittleGetBreaks(host, scene.world, breaks, 8, &count));
        EXPECT_EQ(count, 0u) << "each is told once";
    }
    EXPECT_TRUE(heap.blocks.empty());
}

} // namespace
