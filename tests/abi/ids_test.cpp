// Ids: what one of them named is never something else.
#include "tests/abi/hosting.h"

#include <set>

namespace {

using namespace abi_test;

TEST(SmallAbiIds, OfBodiesAreOfOneWorldOnly) {
    const Hosting host;
    std::set<uint64_t> ids;
    BrittleWorld last = {0};
    BrittleBody body = {0};
    for (int k = 0; k < 600; ++k) {
        BrittleWorldDef def = brittleDefaultWorldDef();
        def.effects = BRITTLE_EFFECT_GRAVITY | BRITTLE_EFFECT_CONTACTS | BRITTLE_EFFECT_EVENTS;
        const BrittleBodyDef cube = brittleDefaultBodyDef();
        BrittleWorld world = {0};
        MUST(host, brittleCreateWorld(host, &def, &world));
        MUST(host, brittleAddBody(host, world, &cube, &body));
        EXPECT_TRUE(ids.insert(body.id).second) << "world " << k << " has a body of another one";
        if (k % 2 == 0 && last.id != 0) MUST(host, brittleDestroyWorld(host, last));
        last = world;
    }
    MUST(host, brittleStartWorld(host, last));
    BrittleBodyState state = {};
    for (const uint64_t id : ids)
        EXPECT_EQ(brittleGetBody(host, last, {id}, &state), id == body.id ? BRITTLE_OK : BRITTLE_WRONG_HANDLE);
}

// Though they may lie at the same place of memory.
TEST(SmallAbiIds, OfContextsThatAreGoneAreNoneOfTheNext) {
    const HostDevice device;
    const BrittleContextDef def = defOn(device);
    std::set<uint64_t> ids;
    for (int k = 0; k < 12; ++k) {
        BrittleContext* context = nullptr;
        ASSERT_EQ(brittleCreateContext(&def, &context), BRITTLE_OK);
        BrittleMaterial glass = {0};
        EXPECT_EQ(brittleFindMaterial(context, "glass", &glass), BRITTLE_OK);
        EXPECT_TRUE(ids.insert(glass.id).second);
        brittleDestroyContext(context);
    }
}

} // namespace
