// prepare_contacts: what is remembered of a contact becomes what is solved. The oracle has whole matrices in double precision.
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <limits>

namespace kernel_test {
namespace {

constexpr double kSubstep = 1.0 / 240;
constexpr uint32_t kSubsteps = 4;
constexpr float kMostPush = 0.15F, kPushShare = 0.004F;
constexpr double kDoubt = 0.02; // of pressing together: speeds that points have by less than this share are noise

struct Scene {
    std::vector<RigidBody> bodies;
    std::vector<gpu::ContactMemory> memory;
    std::vector<uint32_t> pair_of, slots; // of each contact
    Vector gravity = {0, -9.81, 0};
};

std::vector<gpu::SolverContact> preparedOnDevice(const Scene& scene) {
    Counts counts;
    const auto count = static_cast<uint32_t>(scene.pair_of.size());
    counts[COUNT_CONTACTS] = count;
    gpu::PreparePush push{};
    push.substeps = kSubsteps;
    push.gravity = wordsOf(scene.gravity, kSubstep);
    push.most_push = kMostPush;
    push.push_share = kPushShare;
    const engine::Buffer pairs = bufferOf(scene.pair_of), slots = bufferOf(scene.slots), memory = bufferOf(scene.memory),
                         states = bufferOf(statesOf(scene.bodies)), solver_bodies = bufferOf(solverBodiesOf(scene.bodies)),
                         contacts = blankBuffer<gpu::SolverContact>(count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("prepare_contacts"), count, push,
                          {counts.words, pairs, slots, memory, states, solver_bodies, contacts});
    });
    return valuesOf<gpu::SolverContact>(contacts, count);
}

// Points about a common place, in a plane across the normal but for a little, as manifolds have them.
gpu::ContactMemory randomContact(Chance& chance, const std::vector<RigidBody>& bodies, uint32_t a, uint32_t b,
                                 uint32_t points) {
    gpu::ContactMemory memory{};
    const Vector normal = chance.direction(), u = normal.unitOrthogonal(), v = normal.cross(u);
    const Vector center_a = chance.inBox(0.6), center_b = chance.inBox(0.6);
    memory.ids = {a, b, points, 0};
    memory.normal = wordsOf(normal, 0.5);
    memory.tangent = wordsOf((u + chance.between(-1, 1) * v).normalized(), 0.3);
    memory.pace.x = 4 * chance.below(3);
    memory.rub = wordsOf(chance.inBox(2), chance.oneIn(2) ? ARMS_OF_A_FOLLOW : ARMS_OF_B_FOLLOW);
    // Found when the bodies stood a little otherwise.
    const Quaternion turn_a = turnOf(bodies[a].state.turn), turn_b = turnOf(bodies[b].state.turn);
    const Vector way_then = bodies[b].place() - bodies[a].place() + chance.inBox(0.05);
    memory.turn_a = wordsOf(turnBy(0.02, chance.direction()) * turn_a);
    memory.place = wordsOf(turnOf(memory.turn_a).inverse() * way_then);
    for (uint32_t k = 0; k < points; ++k) {
        const Vector spread =
            chance.between(-0.4, 0.4) * u + chance.between(-0.4, 0.4) * v + chance.between(-0.01, 0.01) * normal;
        memory.arm_a[k] = wordsOf(center_a + spread, normal.dot(way_then + center_b - center_a));
        memory.arm_b[k] = wordsOf(center_b + spread);
        memory.anchor_a[k] = wordsOf(turn_a.inverse() * (center_a + spread + chance.inBox(0.01)), chance.between(0, 3));
        memory.anchor_b[k] = wordsOf(turn_b.inverse() * (center_b + spread + chance.inBox(0.01)));
    }
    return memory;
}

Scene randomScene(uint32_t contacts, uint32_t seed) {
    Chance chance(seed);
    Scene scene;
    for (uint32_t b = 0; b < 20; ++b)
        scene.bodies.push_back(randomBody(chance, b % 5 != 0));
    scene.memory.resize(2 * contacts + 1);
    for (uint32_t c = 0; c < contacts; ++c) {
        const uint32_t a = chance.below(20), b = (a + 1 + chance.below(3)) % 20;
        scene.pair_of.push_back(2 * c + c % 2);
        scene.memory[scene.pair_of[c]] = randomContact(chance, scene.bodies, a, b, 1 + chance.below(4));
    }
    scene.slots = countUp(contacts);
    std::ranges::shuffle(scene.slots, chance.engine());
    return scene;
}

// ---- the oracle ----

using Mass = Eigen::Matrix<double, 6, 6>; // inverse: from impulse and twist to velocity and spin

Mass inverseMassOf(const RigidBody& body) {
    Mass m = Mass::Zero();
    m.topLeftCorner<3, 3>() = double{body.state.offset.w} * Matrix::Identity();
    m.bottomRightCorner<3, 3>() = body.inverseInertia();
    return m;
}

using Row = Eigen::Matrix<double, 1, 12>; // from the motion of both bodies to one speed

// Of B's point against A's, along u.
Row speedAlong(const Vector& u, const Vector& arm_a, const Vector& arm_b) {
    Row row;
    row << -u.transpose(), -arm_a.cross(u).transpose(), u.transpose(), arm_b.cross(u).transpose();
    return row;
}

struct Expected {
    const gpu::ContactMemory& memory;
    const RigidBody &a, &b;
    Vector gravity;
    Vector normal = xyz(memory.normal);
    Eigen::Matrix<double, 12, 12> inverse_mass = [&] {
        Eigen::Matrix<double, 12, 12> m = Eigen::Matrix<double, 12, 12>::Zero();
        m.topLeftCorner<6, 6>() = inverseMassOf(a);
        m.bottomRightCorner<6, 6>() = inverseMassOf(b);
        return m;
    }();

    uint32_t points() const { return memory.ids.z; }
    Vector meanArm(const gpu::vec4* arms) const {
        Vector sum = Vector::Zero();
        for (uint32_t k = 0; k < points(); ++k)
            sum += xyz(arms[k]) / points();
        return sum;
    }
    // Arms part as the bodies slide, but impulses are to meet both at one point: one body's arms follow the other's.
    Vector parted() const { return b.place() - a.place() + meanArm(memory.arm_b) - meanArm(memory.arm_a); }
    // Impulses are those of a substep: of the last step's, which may have been longer or shorter.
    double paceShare() const { return memory.pace.x == 0 ? 1 : memory.pace.x / double{kSubsteps}; }
    bool follows(float arms) const { return a.moves() && b.moves() && memory.rub.w == arms; }
    Vector reachOfA(const Vector& arm) const { return follows(ARMS_OF_A_FOLLOW) ? Vector(arm + parted()) : arm; }
    Vector reachOfB(const Vector& arm) const { return follows(ARMS_OF_B_FOLLOW) ? Vector(arm - parted()) : arm; }
    // Speeds along the normal of all points: rows of the motion.
    Eigen::MatrixXd pressing() const {
        Eigen::MatrixXd rows(points(), 12);
        for (uint32_t k = 0; k < points(); ++k)
            rows.row(k) = speedAlong(normal, reachOfA(xyz(memory.arm_a[k])), reachOfB(xyz(memory.arm_b[k])));
        return rows;
    }
    Eigen::MatrixXd rubbing() const {
        const Vector tangent = xyz(memory.tangent), center_b = reachOfB(meanArm(memory.arm_b));
        const Vector center_a = reachOfA(meanArm(memory.arm_a));
        Eigen::MatrixXd rows(2, 12);
        rows.row(0) = speedAlong(tangent, center_a, center_b);
        rows.row(1) = speedAlong(normal.cross(tangent), center_a, center_b);
        return rows;
    }
    Eigen::MatrixXd yieldOf(const Eigen::MatrixXd& rows) const { return rows * inverse_mass * rows.transpose(); }
    Eigen::VectorXd motion() const {
        Eigen::VectorXd m(12);
        m << xyz(a.state.velocity), xyz(a.state.spin), xyz(b.state.velocity), xyz(b.state.spin);
        return m;
    }
    double separation(uint32_t k) const {
        const Vector on_a = a.place() + turnOf(a.state.turn) * xyz(memory.anchor_a[k]);
        const Vector on_b = b.place() + turnOf(b.state.turn) * xyz(memory.anchor_b[k]);
        return normal.dot(on_b - on_a);
    }
    // Where one falls and the other does not, the way that is left makes it faster or slower, by energy. Speeds are half a
    // substep behind places.
    double meetingSpeed(uint32_t k, double speed) const {
        if (speed >= 0) return speed;
        const double toward = gravity.dot(normal) * ((a.moves() ? 1 : 0) - (b.moves() ? 1 : 0));
        const double now = speed - 0.5 * kSubstep * toward;
        return -std::sqrt(std::max(0.0, now * now + 2 * toward * std::max(0.0, separation(k))));
    }
};

Expected expectedOf(const Scene& scene, uint32_t c) {
    const gpu::ContactMemory& memory = scene.memory[scene.pair_of[c]];
    return {memory, scene.bodies[memory.ids.x], scene.bodies[memory.ids.y], scene.gravity};
}

// Its inverse as far as speeds that the points can have go: each way to move on its own, those that hardly are any left out.
Eigen::MatrixXd pressMass(const Eigen::MatrixXd& yield) {
    const double mean = yield.trace() / static_cast<double>(yield.rows());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ways(yield / mean);
    Eigen::VectorXd gain = ways.eigenvalues();
    for (double& g : gain)
        g = g / (g * g + kDoubt * kDoubt);
    return ways.eigenvectors() * gain.asDiagonal() * ways.eigenvectors().transpose() / mean;
}

Eigen::Matrix4d pressOf(const gpu::SolverContact& contact) {
    Eigen::Matrix4d press;
    for (int column = 0; column < 4; ++column)
        press.col(column) << xyz(contact.press[column]), double{contact.press[column].w};
    return press;
}

// A body that moves on one that does not: four points, from the body's middle.
Scene onAPlate(Chance& chance, const std::array<Vector, 4>& points) {
    Scene scene;
    scene.bodies = {randomBody(chance, false), randomBody(chance, true)};
    gpu::ContactMemory memory{};
    memory.ids = {0, 1, 4, 0};
    memory.normal = {0, 1, 0, 0};
    memory.tangent = {1, 0, 0, 0};
    for (uint32_t k = 0; k < 4; ++k)
        memory.arm_a[k] = memory.arm_b[k] = wordsOf(points[k]);
    scene.memory = {memory};
    scene.pair_of = scene.slots = {0};
    return scene;
}

template <class Check>
void forEach(const Scene& scene, Check&& check) {
    const std::vector<gpu::SolverContact> contacts = preparedOnDevice(scene);
    for (uint32_t c = 0; c < scene.pair_of.size(); ++c) {
        SCOPED_TRACE(c);
        check(expectedOf(scene, c), contacts[scene.slots[c]], c);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(SmallPrepareContacts, StandWhereTheirColorHasAPlaceForThem) {
    for (const uint32_t count : kSizes) {
        const Scene scene = randomScene(count, count);
        forEach(scene, [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t c) {
            EXPECT_EQ(got.ids.x, wanted.memory.ids.x);
            EXPECT_EQ(got.ids.y, wanted.memory.ids.y);
            EXPECT_EQ(got.ids.z, wanted.points());
            EXPECT_EQ(got.ids.w, scene.pair_of[c]);
            EXPECT_EQ(xyz(got.normal), wanted.normal);
            EXPECT_EQ(got.normal.w, 0.5f);
            EXPECT_EQ(got.tangent.w, 0.3f);
            EXPECT_LE((xyz(got.rub) - wanted.paceShare() * xyz(wanted.memory.rub)).norm(), 1e-6);
            EXPECT_EQ(got.pace.x, wanted.memory.pace.x);
            EXPECT_EQ(got.pace.y, kSubsteps);
            EXPECT_EQ(got.rub_mass.w, wanted.a.moves() && wanted.b.moves() ? wanted.memory.rub.w : ARMS_STAY);
        });
    }
}

TEST(SmallPrepareContacts, KnowHowFarPointsAreApartAndHowFastTheyMeet) {
    for (const Vector& gravity : {Vector(0, -9.81, 0), Vector(0, 0, 0), Vector(30, 50, -20)}) {
        Scene scene = randomScene(300, 11);
        scene.gravity = gravity;
        forEach(scene, [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t) {
            const Eigen::VectorXd speeds = wanted.pressing() * wanted.motion();
            for (uint32_t k = 0; k < wanted.points(); ++k) {
                EXPECT_NEAR(got.points[k].arm_a.w, wanted.separation(k), 1e-5);
                const Vector reach_a = wanted.reachOfA(xyz(wanted.memory.arm_a[k]));
                const Vector reach_b = wanted.reachOfB(xyz(wanted.memory.arm_b[k]));
                EXPECT_LE((xyz(got.points[k].arm_a) - reach_a).norm(), 1e-6 * (1 + reach_a.norm()));
                EXPECT_LE((xyz(got.points[k].arm_b) - reach_b).norm(), 1e-6 * (1 + reach_b.norm()));
                EXPECT_NEAR(got.points[k].pulse.x, wanted.paceShare() * double{wanted.memory.anchor_a[k].w}, 1e-5);
                EXPECT_EQ(got.points[k].pulse.y, 0);
                EXPECT_EQ(got.points[k].pulse.w, 0);
                if (std::fabs(speeds[k]) < 1e-4) continue; // rounding says whether they meet
                const double meeting = wanted.meetingSpeed(k, speeds[k]);
                // Rounding counts twice as many digits where little is left under the root.
                EXPECT_NEAR(got.points[k].pulse.z * std::fabs(got.points[k].pulse.z), meeting * std::fabs(meeting),
                            2e-4 * std::max(1.0, gravity.norm()));
            }
        });
    }
}

// A body above the ground that has a meter to fall comes in with the speed of the energy of that meter.
TEST(SmallPrepareContacts, OfABodyThatFallsCountTheWayThatIsLeft) {
    Chance chance(12);
    Scene scene;
    scene.bodies = {randomBody(chance, false), randomBody(chance, true)};
    for (RigidBody& body : scene.bodies) {
        body.state.turn = {0, 0, 0, 1};
        body.state.spin = {0, 0, 0, 0};
    }
    scene.bodies[0].state.offset = {0, 0, 0, 0};
    scene.bodies[1].state.offset = {0, 1.5f, 0, 1};
    scene.bodies[1].state.velocity = {0, -3, 0, 0};
    scene.memory.resize(1);
    scene.memory[0].ids = {0, 1, 1, 0};
    scene.memory[0].normal = {0, 1, 0, 0};
    scene.memory[0].tangent = {1, 0, 0, 0};
    scene.memory[0].anchor_b[0] = scene.memory[0].arm_b[0] = {0, -0.5f, 0, 0};
    scene.memory[0].arm_a[0].w = -0.5f; // where both stood at one place
    scene.pair_of = scene.slots = {0};
    const double now = 3 + 0.5 * kSubstep * 9.81;
    const gpu::SolverPoint point = preparedOnDevice(scene)[0].points[0];
    EXPECT_NEAR(point.arm_a.w, 1, 1e-6);
    EXPECT_NEAR(point.pulse.z, -std::sqrt(now * now + 2 * 9.81 * 1), 1e-4);
}

TEST(SmallPrepareContacts, HaveTheMassThatAnImpulseMeets) {
    forEach(randomScene(300, 13), [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t) {
        const Eigen::MatrixXd yield = wanted.yieldOf(wanted.pressing());
        for (uint32_t k = 0; k < wanted.points(); ++k)
            EXPECT_NEAR(got.points[k].arm_b.w * yield(k, k), yield(k, k) > 0 ? 1 : 0, 1e-4);
        const double twist = wanted.normal.dot((wanted.a.inverseInertia() + wanted.b.inverseInertia()) * wanted.normal);
        EXPECT_NEAR(got.center_a.w * twist, twist > 0 ? 1 : 0, 1e-4);
    });
}

TEST(SmallPrepareContacts, MayBePushedOutByAShareOfTheShorterArmInAStepOrAsFastAsTheWorldSays) {
    uint32_t wide = 0, all = 0;
    forEach(randomScene(300, 16), [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t) {
        double shorter = std::numeric_limits<double>::infinity();
        if (wanted.a.moves()) shorter = std::min(shorter, xyz(got.center_a).norm());
        if (wanted.b.moves()) shorter = std::min(shorter, xyz(got.center_b).norm());
        if (!std::isfinite(shorter)) return;
        const double of_arm = kPushShare * shorter / (kSubsteps * kSubstep);
        EXPECT_NEAR(got.rub.w, std::max(double{kMostPush}, of_arm), 1e-6);
        wide += of_arm > kMostPush ? 1 : 0;
        ++all;
    });
    EXPECT_GT(wide, 10u);
    EXPECT_GT(all - wide, 10u);
}

TEST(SmallPrepareContacts, RubAtTheMiddleOfTheirPoints) {
    forEach(randomScene(300, 14), [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t) {
        const Vector center_a = wanted.meanArm(wanted.memory.arm_a), center_b = wanted.meanArm(wanted.memory.arm_b);
        EXPECT_LE((xyz(got.center_a) - wanted.reachOfA(center_a)).norm(), 1e-5);
        EXPECT_LE((xyz(got.center_b) - wanted.reachOfB(center_b)).norm(), 1e-5);
        double reach = 0;
        for (uint32_t k = 0; k < wanted.points(); ++k)
            reach += (xyz(wanted.memory.arm_a[k]) - center_a).norm() / wanted.points();
        EXPECT_NEAR(got.center_b.w, reach, 1e-6);
        const Eigen::Matrix2d yield = wanted.yieldOf(wanted.rubbing());
        Eigen::Matrix2d mass;
        mass << double{got.rub_mass.x}, double{got.rub_mass.y}, double{got.rub_mass.y}, double{got.rub_mass.z};
        if (yield.norm() > 0)
            EXPECT_LE((mass * yield - Eigen::Matrix2d::Identity()).norm(), 2e-3);
        else
            EXPECT_EQ(mass.norm(), 0);
    });
}

TEST(SmallPrepareContacts, PressAllPointsAtOnce) {
    forEach(randomScene(300, 15), [&](const Expected& wanted, const gpu::SolverContact& got, uint32_t) {
        const auto n = static_cast<Eigen::Index>(wanted.points());
        const Eigen::MatrixXd yield = wanted.yieldOf(wanted.pressing());
        Eigen::Matrix4d press = pressOf(got);
        const Eigen::MatrixXd mass = yield.norm() > 0 ? pressMass(yield) : Eigen::MatrixXd::Zero(n, n);
        EXPECT_LE((press.topLeftCorner(n, n) - mass).norm(), 5e-3 * mass.norm());
        press.topLeftCorner(n, n).setZero();
        EXPECT_EQ(press.norm(), 0) << "points that are not there are pressed";
    });
}

// Four corners of a plate share three ways to move: a speed that they can have is taken out of all of them at once, and
// impulses do not fight each other over what they cannot have.
TEST(SmallPrepareContacts, TakeTheSpeedOutOfThePointsOfAPlateAtOnce) {
    Chance chance(16);
    const Scene scene =
        onAPlate(chance, {Vector(-0.5, -0.5, -0.5), Vector(0.5, -0.5, -0.5), Vector(0.5, -0.5, 0.5), Vector(-0.5, -0.5, 0.5)});
    const Expected wanted = expectedOf(scene, 0);
    const Eigen::Matrix4d press = pressOf(preparedOnDevice(scene)[0]);
    const Eigen::VectorXd speeds = wanted.pressing() * wanted.motion();
    const Eigen::VectorXd left = speeds - wanted.yieldOf(wanted.pressing()) * press * speeds;
    EXPECT_LE(left.norm(), 0.01 * speeds.norm());
    const Eigen::Vector4d noise(1, -1, 1, -1);
    EXPECT_LE((press * noise).norm(), 0.01 * press.norm());
}

// Points that lie close together share all but one of their ways to move, so that the rest is noise: it is left out and nothing
// is made of it.
TEST(SmallPrepareContacts, PressOnSmallFacesAsWellAsOnLargeOnes) {
    for (const double size : {1.0, 0.3, 0.1, 0.03, 0.01, 0.001}) {
        Chance chance(17);
        for (int round = 0; round < 20; ++round) {
            const Vector middle(chance.between(-0.2, 0.2), -0.5, chance.between(-0.2, 0.2));
            const auto near = [&]() -> Vector {
                return middle + size * Vector(chance.between(-0.5, 0.5), 0, chance.between(-0.5, 0.5));
            };
            const Scene scene = onAPlate(chance, {near(), near(), near(), near()});
            const Eigen::MatrixXd mass = pressMass(expectedOf(scene, 0).yieldOf(expectedOf(scene, 0).pressing()));
            EXPECT_LE((pressOf(preparedOnDevice(scene)[0]) - mass).norm(), 0.01 * mass.norm()) << size;
        }
    }
}

} // namespace
} // namespace kernel_test
