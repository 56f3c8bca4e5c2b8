// The device breaks what the host would break, into as many fragments: laws in 32 bits against those in double.
#include "modules/brittle/effects/blow.h"
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <cmath>

namespace kernel_test {
namespace {

struct Case {
    const brittle::Material* material = nullptr;
    float volume = 0, surface = 0, chance = 0, curvature = 0;
    float mass = 0, speed = 0, impedance = 0, modulus = 0;
    brittle::BodyForm form() const { return brittle::formOf(double{volume}, double{surface}); }
    brittle::Blow blow() const { return {double{mass}, double{speed}, double{impedance}}; }
    double strength() const { return brittle::strengthOf(*material, double{volume}, double{chance}); }
};

float magnitude(Chance& chance, double low, double high) {
    return static_cast<float>(std::exp(chance.between(std::log(low), std::log(high))));
}

// From chips to blocks, from panes to balls; from a tap to a shot.
Case randomCase(Chance& chance, uint32_t k) {
    const auto materials = brittle::builtinMaterials();
    Case c;
    c.material = &materials[k % materials.size()];
    const double edge = double{magnitude(chance, 0.01, 3)};
    c.volume = static_cast<float>(edge * edge * edge);
    c.surface = static_cast<float>(edge * edge * chance.between(4.9, chance.oneIn(3) ? 8 : 500));
    c.chance = static_cast<float>(chance.between(1e-4, 1 - 1e-4));
    c.curvature = magnitude(chance, 1e-3, 10);
    c.mass = magnitude(chance, 1e-3, 1e5);
    c.speed = magnitude(chance, 0.1, 300);
    c.impedance = chance.oneIn(2) ? static_cast<float>(RIGID_IMPEDANCE) : magnitude(chance, 1e5, 1e8);
    c.modulus = magnitude(chance, 1e8, 1e12);
    return c;
}

struct Laws {
    gpu::vec4 first, second;
};

std::vector<Laws> lawsOnDevice(const std::vector<Case>& cases) {
    std::vector<gpu::MaterialCard> cards;
    std::vector<gpu::vec4> bodies, blows;
    for (const Case& c : cases) {
        cards.push_back(brittle::cardOf(*c.material));
        bodies.push_back({c.volume, c.surface, c.chance, c.curvature});
        blows.push_back({c.mass, c.speed, c.impedance, c.modulus});
    }
    const auto count = static_cast<uint32_t>(cases.size());
    const engine::Buffer laws = blankBuffer<Laws>(count), card_buffer = bufferOf(cards), body_buffer = bufferOf(bodies),
                         blow_buffer = bufferOf(blows);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(testKernel("breaking_laws"), count, count, {card_buffer, body_buffer, blow_buffer, laws});
    });
    return valuesOf<Laws>(laws, count);
}

void expectClose(float found, double expected, double share, const char* what) {
    EXPECT_NEAR(double{found} / expected, 1, share) << what << " is to be " << expected;
}

constexpr double kDoubt = 1e-3;

// Where hardly more or less of stress or energy decides.
bool isOnTheEdge(const Case& c, double fragments) {
    const double stress = brittle::impactStress(*c.material, c.form(), c.blow()) / c.strength();
    return std::abs(stress - 1) < kDoubt || std::abs(fragments / 2 - 1) < kDoubt;
}

// What a plate's law says and what a solid's does differ by a tenth where one follows the other.
bool isAtTheSwitch(const Case& c, double joules) {
    const brittle::BodyForm form = c.form();
    const double all = 2 * c.material->eta * joules / c.material->fracture_energy + form.surface;
    return std::abs(all / (6 * form.side * form.side) - 1) < 1e-3 || std::abs(form.thickness / form.side - 1) < 1e-3;
}

TEST(SmallBreakingLaws, OfTheDeviceAreThoseOfTheHost) {
    Chance chance(1);
    std::vector<Case> cases;
    for (uint32_t k = 0; k < 20'000; ++k)
        cases.push_back(randomCase(chance, k));
    const std::vector<Laws> found = lawsOnDevice(cases);
    uint32_t broken = 0, whole = 0;
    for (size_t k = 0; k < cases.size(); ++k) {
        const Case& c = cases[k];
        const brittle::BodyForm form = c.form();
        const double joules = brittle::energyOf(c.blow());
        if (isAtTheSwitch(c, joules)) continue;
        const double fragments = brittle::expectedFragments(*c.material, form, joules);
        expectClose(found[k].first.x, fragments, kDoubt, "fragments");
        expectClose(found[k].first.y, brittle::roomForFragments(*c.material, form), kDoubt, "room");
        expectClose(found[k].first.z, brittle::impactStress(*c.material, form, c.blow()), kDoubt, "stress");
        expectClose(found[k].first.w, c.strength(), kDoubt, "strength");
        expectClose(found[k].second.x, brittle::crackImpulse(c.blow(), c.material->eta * joules), kDoubt, "impulse");
        expectClose(found[k].second.y, brittle::hertzRadiusOf(c.blow(), double{c.curvature}, double{c.modulus}), 1e-3,
                    "radius");
        const double room = brittle::roomForFragments(*c.material, form), paid = std::min({fragments, room, 1000.0});
        EXPECT_GE(found[k].second.z, std::floor(paid * (1 - kDoubt))) << k;
        EXPECT_LE(found[k].second.z, std::floor(paid * (1 + kDoubt))) << k;
        if (isOnTheEdge(c, paid)) continue;
        const bool breaks = brittle::breaks(*c.material, form, c.strength(), c.blow());
        EXPECT_EQ(found[k].second.w, breaks ? 1 : 0) << k;
        ++(breaks ? broken : whole);
    }
    EXPECT_GT(broken, 2000u);
    EXPECT_GT(whole, 2000u);
}

} // namespace
} // namespace kernel_test
