// What --repair mends, and what it leaves alone.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace brittle;
using namespace support;

namespace {

// Without the triangles for which `drop` holds, given their corners.
template <class Drop>
ImportedMesh without(const ImportedMesh& mesh, const Drop& drop) {
    ImportedMesh rest = mesh;
    rest.triangles.clear();
    for (const Index3& t : mesh.triangles)
        if (!drop(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]])) rest.triangles.push_back(t);
    rest.corner_normals.assign(3 * rest.triangles.size(), {0, 0, 0});
    rest.corner_uvs.assign(3 * rest.triangles.size(), {0, 0});
    return rest;
}

ImportedMesh openBox() {
    return without(makeCube(),
                   [](const Double3& a, const Double3& b, const Double3& c) { return a[2] > 0 && b[2] > 0 && c[2] > 0; });
}

// Every triangle with corners of its own, each moved by up to `by`.
ImportedMesh shakenSoup(const ImportedMesh& mesh, double by) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shake(-by, by);
    ImportedMesh soup;
    for (const Index3& t : mesh.triangles) {
        const auto first = static_cast<uint32_t>(soup.positions.size());
        for (const uint32_t v : t)
            soup.positions.push_back(mesh.positions[v] + Double3{shake(random), shake(random), shake(random)});
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    soup.corner_normals.resize(3 * soup.triangles.size());
    soup.corner_uvs.resize(3 * soup.triangles.size());
    return soup;
}

RepairedMesh mended(const ImportedMesh& imported) {
    auto repaired = repairMesh(imported);
    if (!repaired) throw std::runtime_error(repaired.error().message);
    const auto checked = checkMesh(repaired->model.mesh, repaired->model.topology);
    EXPECT_TRUE(checked) << checked.error().message;
    return std::move(*repaired);
}

double volumeOf(const RepairedMesh& repaired) {
    return checkMesh(repaired.model.mesh, repaired.model.topology)->measures.volume;
}

std::string refusalOf(const ImportedMesh& imported) {
    const auto repaired = repairMesh(imported);
    return repaired ? "" : repaired.error().message;
}

} // namespace

TEST(Repair, LeavesSoundModelsAsTheyAre) {
    const ImportedMesh hollow = makeIcosphere(2) + turnedOver(moved(makeIcosphere(2), 0.5, {0, 0, 0}));
    for (const ImportedMesh& sound : {makeCube(), makeTwistedRing(), hollow}) {
        const auto prepared = prepareMesh(sound);
        const RepairedMesh repaired = mended(sound);
        EXPECT_EQ(repaired.notes.text(), "");
        EXPECT_EQ(repaired.model.mesh.positions, prepared->mesh.positions);
        EXPECT_EQ(repaired.model.mesh.triangles, prepared->mesh.triangles);
        EXPECT_EQ(repaired.model.mesh.corner_normals, prepared->mesh.corner_normals);
    }
}

TEST(Repair, TurnsTrianglesOfAnyShare) {
    for (const uint32_t share : {2u, 3u, 10u}) {
        ImportedMesh mixed = makeBumpySphere(2);
        std::mt19937 random(share);
        uint32_t turned = 0;
        for (Index3& t : mixed.triangles)
            if (random() % share == 0) std::swap(t[0], t[1]), ++turned;
        const auto whole = static_cast<uint32_t>(mixed.triangles.size());
        const RepairedMesh repaired = mended(mixed);
        EXPECT_EQ(repaired.notes.turned_triangles.size(), std::min(turned, whole - turned));
        EXPECT_NEAR(volumeOf(repaired), volumeOf(mended(makeBumpySphere(2))), 1e-6);
    }
}

TEST(Repair, APartInsideAnotherBecomesAHollow) {
    const ImportedMesh cube = makeCube(), ball = makeIcosphere(2);
    const RepairedMesh hollow = mended(cube + moved(ball, 0.4, {0, 0, 0}));
    EXPECT_EQ(hollow.notes.turned_hollows.size(), 1u);
    EXPECT_LT(volumeOf(hollow), 0.8);
    // A solid in the hollow, all three facing outward.
    const RepairedMesh nested = mended(cube + moved(ball, 0.4, {0, 0, 0}) + moved(cube, 0.2, {0, 0, 0}));
    EXPECT_EQ(nested.notes.turned_hollows.size(), 1u);
    EXPECT_NEAR(volumeOf(nested), volumeOf(hollow) + 0.008, 1e-6);
    // A wall of a hollow where there is nothing around it.
    const RepairedMesh outside = mended(cube + turnedOver(moved(ball, 0.2, {3, 0, 0})));
    EXPECT_EQ(outside.notes.turned_parts.size(), 1u);
    EXPECT_EQ(outside.notes.turned_hollows.size(), 0u);
}

// Two bars of one section that overlap by half of their length: the ends of each lie within the other.
TEST(Repair, SaysThatPartsOverlapWhereThatIsWhatIsWrong) {
    const std::string refusal = refusalOf(makeCube() + moved(makeCube(), 1, {0.5, 0, 0}));
    EXPECT_NE(refusal.find("in another part"), std::string::npos) << refusal;
}

TEST(Repair, TouchingSolidsStayOutside) {
    const RepairedMesh repaired = mended(turnedOver(makeCube()) + moved(makeCube(), 1, {1, 0.5, 0.25}) +
                                         moved(makeIcosphere(2), 0.1, {5, 0, 0}) + turnedOver(moved(makeCube(), 1, {3, 0, 0})));
    EXPECT_EQ(repaired.notes.turned_parts.size(), 2u);
    EXPECT_EQ(repaired.notes.turned_hollows.size(), 0u);
}

TEST(Repair, OfDoubledTrianglesOneStays) {
    const ImportedMesh ball = makeIcosphere(2);
    for (const ImportedMesh& twice : {ball + ball, ball + turnedOver(ball), ball + ball + turnedOver(ball)}) {
        const RepairedMesh repaired = mended(twice);
        EXPECT_EQ(repaired.model.mesh.triangles.size(), ball.triangles.size());
        EXPECT_EQ(repaired.notes.dropped_doubles.size(), twice.triangles.size() - ball.triangles.size());
        EXPECT_NEAR(volumeOf(repaired), volumeOf(mended(ball)), 1e-6);
    }
}

// The same diagonal on both sides: the one cube is the other in a mirror. One face is turned over, or nothing would be mended.
TEST(Repair, ADoubledWallBetweenSolidsGoes) {
    ImportedMesh mirrored = turnedOver(makeCube());
    for (Double3& p : mirrored.positions)
        p[0] = 1 - p[0];
    ImportedMesh both = makeCube() + mirrored;
    const auto at_the_back = [&](const Index3& t) {
        return std::all_of(t.begin(), t.end(), [&](uint32_t v) { return both.positions[v][0] < 0; });
    };
    Index3& turned = *std::find_if(both.triangles.begin(), both.triangles.end(), at_the_back);
    std::swap(turned[0], turned[1]);
    const RepairedMesh repaired = mended(both);
    EXPECT_EQ(repaired.notes.dropped_doubles.size(), 4u);
    EXPECT_EQ(repaired.model.mesh.triangles.size(), 20u);
    EXPECT_NEAR(volumeOf(repaired), 2, 1e-6);
}

TEST(Repair, ASheetInTwoLayersIsNoSolid) {
    const ImportedMesh sheet = without(
        makeCube(), [](const Double3& a, const Double3& b, const Double3& c) { return a[2] < 0 || b[2] < 0 || c[2] < 0; });
    EXPECT_NE(refusalOf(sheet + turnedOver(sheet)).find("doubled triangles"), std::string::npos);
}

TEST(Repair, JoinsSeamsThatDifferByRounding) {
    const ImportedMesh ball = makeIcosphere(3);
    const RepairedMesh repaired = mended(shakenSoup(ball, 1e-6));
    EXPECT_EQ(repaired.model.mesh.positions.size(), ball.positions.size());
    EXPECT_GT(repaired.notes.joined_vertices.size(), ball.positions.size());
    EXPECT_NEAR(volumeOf(repaired), volumeOf(mended(ball)), 1e-4);
    EXPECT_NE(refusalOf(shakenSoup(ball, 1e-3)), "") << "a gap, not rounding";
}

TEST(Repair, SplitsEdgesThatOthersEndOn) {
    const ImportedMesh cube = makeCube();
    ImportedMesh split = cube;
    for (size_t t = 0; t < 4; ++t) { // at two places of one side each, their neighbors not
        const Index3 old = split.triangles[t];
        Index3 corners = old;
        for (const double at : {0.25, 0.7}) {
            split.positions.push_back(split.positions[old[0]] + at * (split.positions[old[1]] - split.positions[old[0]]));
            const auto middle = static_cast<uint32_t>(split.positions.size() - 1);
            split.triangles.push_back({corners[0], middle, corners[2]});
            corners[0] = middle;
        }
        split.triangles[t] = corners;
    }
    split.corner_normals.assign(3 * split.triangles.size(), {0, 0, 0});
    split.corner_uvs.assign(3 * split.triangles.size(), {0, 0});
    const RepairedMesh repaired = mended(split);
    EXPECT_FALSE(repaired.notes.split_edges.empty());
    EXPECT_TRUE(repaired.notes.closed_holes.empty());
    EXPECT_NEAR(volumeOf(repaired), 1, 1e-6);
}

TEST(Repair, ClosesSmallHolesFlatWhereTheyAreFlat) {
    const RepairedMesh box = mended(openBox());
    ASSERT_EQ(box.notes.closed_holes.size(), 1u);
    EXPECT_EQ(box.notes.closed_holes[0].edges, 4u);
    EXPECT_NEAR(box.notes.closed_holes[0].diameter, std::numbers::sqrt2, 1e-6);
    EXPECT_NEAR(box.notes.closed_holes[0].where[2], 0.5, 1e-6);
    EXPECT_NEAR(volumeOf(box), 1, 1e-6);
    // Several, in a rounded surface: each vertex taken out with the triangles around it.
    const ImportedMesh ball = makeIcosphere(3);
    const ImportedMesh holed = without(ball, [&](const Double3& a, const Double3& b, const Double3& c) {
        const auto is_pole = [](const Double3& p) { return std::abs(p[0]) > 0.98 || std::abs(p[2]) > 0.98; };
        return is_pole(a) || is_pole(b) || is_pole(c);
    });
    const RepairedMesh closed = mended(holed);
    EXPECT_EQ(closed.notes.closed_holes.size(), 4u);
    EXPECT_NEAR(volumeOf(closed), volumeOf(mended(ball)), 0.02 * volumeOf(closed));
}

// A comb: a fan over its rim would fold.
TEST(Repair, ClosesAHoleWithAConcaveOutlineInItsPlane) {
    const std::vector<std::array<double, 2>> outline = {{0, 0}, {5, 0}, {5, 4}, {4, 1}, {3, 4}, {2, 1}, {1, 4}};
    ImportedMesh prism;
    const auto count = static_cast<uint32_t>(outline.size());
    for (const double z : {0.0, 1.0})
        for (const auto& p : outline)
            prism.positions.push_back({p[0], p[1], z});
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t next = (k + 1) % count;
        prism.triangles.push_back({k, next, next + count});
        prism.triangles.push_back({k, next + count, k + count});
    }
    prism.corner_normals.resize(3 * prism.triangles.size());
    prism.corner_uvs.resize(3 * prism.triangles.size());
    const RepairedMesh closed = mended(prism);
    EXPECT_EQ(closed.notes.closed_holes.size(), 2u);
    double area = 0;
    for (size_t k = 0; k < outline.size(); ++k) {
        const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    EXPECT_NEAR(volumeOf(closed), area, 1e-5);
}

TEST(Repair, HolesThatMeetInAVertexAreClosedEach) {
    ImportedMesh ball = makeIcosphere(0);
    const Index3 first = ball.triangles.front();
    for (size_t t = 1; t < ball.triangles.size(); ++t) {
        int shared = 0;
        for (const uint32_t v : ball.triangles[t])
            shared += v == first[0] || v == first[1] || v == first[2] ? 1 : 0;
        if (shared != 1) continue;
        ball.triangles.erase(ball.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        break;
    }
    ball.triangles.erase(ball.triangles.begin());
    ball.corner_normals.resize(3 * ball.triangles.size());
    ball.corner_uvs.resize(3 * ball.triangles.size());
    const RepairedMesh closed = mended(ball);
    EXPECT_EQ(closed.notes.closed_holes.size(), 2u);
    EXPECT_NEAR(volumeOf(closed), volumeOf(mended(makeIcosphere(0))), 1e-6);
}

TEST(Repair, LargeHolesAreNotGuessedAt) {
    const ImportedMesh cup =
        without(makeIcosphere(3), [](const Double3& a, const Double3& b, const Double3& c) { return a[2] + b[2] + c[2] > 1; });
    const std::string refusal = refusalOf(cup);
    EXPECT_NE(refusal.find("1 hole left open"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("too large"), std::string::npos) << refusal;
}

// Closing its rim would make a lens of a leaf.
TEST(Repair, SheetsAreNotTakenForSolidsWithAHole) {
    for (const double bend : {0.0, 0.3}) {
        ImportedMesh leaf;
        leaf.positions = {{3, 0, 0}, {4, 0, bend}, {4, 1, 0}, {3, 1, bend}};
        leaf.triangles = {{0, 1, 2}, {0, 2, 3}};
        leaf.corner_normals.resize(6);
        leaf.corner_uvs.resize(6);
        const std::string refusal = refusalOf(makeCube() + leaf);
        EXPECT_NE(refusal.find("is the rim of a sheet"), std::string::npos) << refusal;
    }
}

TEST(Repair, RefusesWhatHasNoInside) {
    // Five triangles in a ring with a half turn.
    ImportedMesh strip;
    for (int k = 0; k < 5; ++k) {
        const double angle = 2 * std::numbers::pi * k / 5;
        strip.positions.push_back({std::cos(angle), std::sin(angle), 0.2 * k});
    }
    for (uint32_t k = 0; k < 5; ++k)
        strip.triangles.push_back({k, (k + 1) % 5, (k + 2) % 5});
    strip.corner_normals.resize(15);
    strip.corner_uvs.resize(15);
    EXPECT_NE(refusalOf(strip).find("one side only"), std::string::npos) << refusalOf(strip);
    ImportedMesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    triangle.corner_normals.resize(3);
    triangle.corner_uvs.resize(3);
    EXPECT_NE(refusalOf(triangle).find("doubling"), std::string::npos) << refusalOf(triangle);
}

TEST(Repair, RefusesWhatCrossesItself) {
    ImportedMesh crossing = makeCube() + moved(makeIcosphere(2), 0.5, {0.5, 0.1, 0.2});
    EXPECT_NE(refusalOf(crossing).find("cross"), std::string::npos);
    std::swap(crossing.triangles[0][0], crossing.triangles[0][1]);
    EXPECT_NE(refusalOf(crossing).find("cross"), std::string::npos) << "also where something else was mended";
}

TEST(Repair, SaysWhatItDidAndWhereInTheModelsCoordinates) {
    const RepairedMesh repaired = mended(moved(openBox(), 2, {10, 20, 30}));
    EXPECT_EQ(repaired.notes.text(), "1 hole closed at (10, 20, 31)");
}

TEST(Repair, KeepsTextureCoordinatesAndMakesNormals) {
    ImportedMesh box = openBox();
    for (size_t corner = 0; corner < box.corner_uvs.size(); ++corner)
        box.corner_uvs[corner] = {static_cast<float>(box.triangles[corner / 3][corner % 3]), 7};
    const RepairedMesh repaired = mended(box);
    for (size_t corner = 0; corner < repaired.model.mesh.corner_uvs.size(); ++corner) {
        EXPECT_EQ(repaired.model.mesh.corner_uvs[corner][1], 7);
        EXPECT_NEAR(length(toDouble(repaired.model.mesh.corner_normals[corner])), 1, 1e-6);
    }
}
