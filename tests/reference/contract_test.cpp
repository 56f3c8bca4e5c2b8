// The checker's own test: a sound fracture passes, and every planted fault is caught.
#include "tests/reference/contract.h"

#include "tests/reference/model_file.h"
#include "tests/support/glb_writer.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace reference {
namespace {

std::string scratchPath(const std::string& name) { return testing::TempDir() + "brittle_contract_" + name; }

class Contract : public testing::Test {
protected:
    ContractReport check() const { return checkContract(broken_.file, broken_.model); }
    Piece& piece(size_t k) { return broken_.file.pieces[k]; }
    support::BrokenBox broken_ = support::brokenBox();
};

TEST_F(Contract, HoldsForASoundFracture) {
    const ContractReport report = check();
    EXPECT_TRUE(report.holds()) << report.text();
    EXPECT_GT(report.points_tested, 300u);
}

TEST_F(Contract, SeesAMissingOuterTriangle) {
    piece(0).outer.pop_back();
    const ContractReport report = check();
    EXPECT_EQ(report.open_edges, 3u);
    EXPECT_GT(report.area_error, 1e-3);
    EXPECT_GT(report.volume_error, 1e-3);
}

TEST_F(Contract, SeesAMissingInnerTriangle) {
    piece(0).inner.pop_back();
    EXPECT_EQ(check().open_edges, 3u);
    EXPECT_EQ(check().unpaired_inner, 1u);
}

TEST_F(Contract, SeesATurnedTriangle) {
    std::swap(piece(1).outer[0][1], piece(1).outer[0][2]);
    EXPECT_EQ(check().open_edges, 3u);
}

TEST_F(Contract, SeesACapThatIsOnOneSideOnly) {
    // Both triangles of one cap gone over to the other diagonal: closed, right in volume, but not the mirror image.
    Triangles& cap = piece(1).inner;
    const Point a = cap[0][0], b = cap[0][1], c = cap[0][2], d = cap[1][1];
    cap = {{a, d, c}, {d, b, c}};
    const ContractReport report = check();
    EXPECT_EQ(report.open_edges, 0u) << report.text();
    EXPECT_EQ(report.unpaired_inner, 4u);
}

TEST_F(Contract, SeesAFragmentPairedWithItself) {
    piece(0).inner =
        support::joined(piece(0).inner, support::joined({piece(0).outer[0]}, support::turnedOver({piece(0).outer[0]})));
    EXPECT_EQ(check().open_edges, 0u);
    EXPECT_EQ(check().unpaired_inner, 2u);
}

TEST_F(Contract, SeesAShiftedVertex) {
    // The same vertex everywhere in one fragment: closed, but no longer the model.
    const Point corner = {0, 0, 0};
    for (Triangle& t : piece(0).outer)
        for (Point& p : t)
            if (p == corner) p[0] -= 1e-3;
    const ContractReport report = check();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_GT(report.volume_error, 1e-5);
    EXPECT_FALSE(report.holds());
}

TEST_F(Contract, SeesAVertexBeyondItsCell) {
    for (size_t k = 0; k < 2; ++k)
        for (Triangles* side : {&piece(k).outer, &piece(k).inner})
            for (Triangle& t : *side)
                for (Point& p : t)
                    if (p == Point{1, 1, 1}) p[0] += 1e-3;
    const ContractReport report = check();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_EQ(report.unpaired_inner, 0u);
    EXPECT_NEAR(report.outside_cell, 1e-3 / std::sqrt(6.0), 1e-6);
}

TEST_F(Contract, SeesSwappedSites) {
    std::swap(piece(0).site, piece(1).site);
    const ContractReport report = check();
    EXPECT_GT(report.points_misplaced, 10u);
    EXPECT_GT(report.outside_cell, 0.1);
}

TEST_F(Contract, SeesALostFragment) {
    broken_.file.pieces.pop_back();
    const ContractReport report = check();
    EXPECT_NEAR(report.volume_error, .5, 1e-9);
    EXPECT_GT(report.points_wrong, 100u);
    EXPECT_EQ(report.unpaired_inner, 2u);
}

TEST_F(Contract, SeesADoubledFragment) {
    broken_.file.pieces.push_back(piece(0));
    EXPECT_GT(check().points_wrong, 50u);
    EXPECT_NEAR(check().volume_error, .5, 1e-9);
}

TEST_F(Contract, SeesAnInsideOutFragment) {
    piece(0).outer = support::turnedOver(piece(0).outer);
    piece(0).inner = support::turnedOver(piece(0).inner);
    const ContractReport report = check();
    EXPECT_EQ(report.open_edges, 0u);
    EXPECT_EQ(report.not_positive, 1u);
    EXPECT_EQ(report.not_connected, 1u);
}

TEST_F(Contract, SeesTwoSolidsInOneFragment) {
    piece(0).outer = support::joined(piece(0).outer, support::boxTriangles({0, 0, 5}, {.1, .1, 5.1}));
    EXPECT_EQ(check().not_connected, 1u);
}

// Walls of a cavity that has collapsed, and whose walls have passed through each other by so much.
TEST_F(Contract, AllowsCollapsedCavitiesButNoFlatSolids) {
    const Triangles outer = piece(0).outer;
    for (const double thickness : {0.0, 1e-7, 1e-6, 1e-5}) {
        piece(0).outer = support::joined(outer, support::boxTriangles({.2, .2, .2}, {.8, .8, .2 + thickness}));
        EXPECT_EQ(check().not_connected, thickness > 2e-6 ? 1u : 0u) << thickness;
    }
}

TEST_F(Contract, AllowsACavity) {
    const Triangles cavity = support::turnedOver(support::boxTriangles({.2, .2, .2}, {.4, .4, .4}));
    piece(0).outer = support::joined(piece(0).outer, cavity);
    piece(0).volume -= .008;
    Triangles in_model = cavity;
    for (Triangle& t : in_model)
        for (Point& p : t)
            p = p + piece(0).translation;
    broken_.model = support::joined(broken_.model, in_model);
    EXPECT_TRUE(check().holds()) << check().text();
}

TEST_F(Contract, SeesAWrongClaimAndMixedFrames) {
    piece(0).volume = 1.01;
    EXPECT_EQ(check().claimed_volume_off, 1u);
    piece(1).translation[0] += 1;
    EXPECT_EQ(check().mixed_frames, 1u);
    piece(1).cell = 0;
    EXPECT_EQ(check().mixed_sites, 1u);
}

TEST_F(Contract, IgnoresCollapsedTriangles) {
    const Triangle& t = piece(0).outer[0];
    piece(0).outer.push_back({t[0], t[0], t[1]});
    EXPECT_TRUE(check().holds()) << check().text();
}

TEST_F(Contract, ReadsBackWhatWasWritten) {
    const std::string path = scratchPath("sound.glb");
    support::writeFragmentFile(path, broken_.file);
    broken_.file = readFragmentFile(path);
    EXPECT_TRUE(broken_.file.faults.empty());
    EXPECT_EQ(broken_.file.pieces.size(), 2u);
    EXPECT_EQ(piece(1).cell, 1u);
    EXPECT_TRUE(check().holds()) << check().text();
}

TEST_F(Contract, ReaderSeesFaultsOfForm) {
    const auto faultsAfter = [&](auto change) {
        const std::string path = scratchPath("spoiled.glb");
        support::writeFragmentFile(path, broken_.file, change);
        return readFragmentFile(path).faults.size();
    };
    using nlohmann::json;
    EXPECT_EQ(faultsAfter([](json&) {}), 0u);
    EXPECT_EQ(faultsAfter([](json& j) { j["nodes"][1]["name"] = "fragment_7"; }), 1u);
    EXPECT_EQ(faultsAfter([](json& j) { j["nodes"][0]["scale"] = {1, 2, 1}; }), 1u);
    EXPECT_EQ(faultsAfter([](json& j) { j["accessors"][0]["max"] = {9, 9, 9}; }), 1u);
    const auto positionsAsNormals = [](json& j) {
        json& attributes = j["meshes"][0]["primitives"][0]["attributes"];
        attributes["NORMAL"] = attributes["POSITION"];
    };
    EXPECT_EQ(faultsAfter(positionsAsNormals), 1u);
    const auto normalsOfTheOtherSide = [](json& j) {
        j["meshes"][0]["primitives"][1]["attributes"]["NORMAL"] = j["meshes"][1]["primitives"][1]["attributes"]["NORMAL"];
    };
    EXPECT_EQ(faultsAfter(normalsOfTheOtherSide), 1u);
}

TEST_F(Contract, ReaderRefusesWhatItCannotRead) {
    const auto refuses = [&](auto change) {
        const std::string path = scratchPath("broken.glb");
        support::writeFragmentFile(path, broken_.file, change);
        EXPECT_THROW(readFragmentFile(path), std::exception);
    };
    using nlohmann::json;
    refuses([](json& j) { j["nodes"] = json::array(); });
    refuses([](json& j) { j["nodes"][0]["extras"].erase("site"); });
    refuses([](json& j) { j["materials"][0]["name"] = "shell"; });
    refuses([](json& j) { j["bufferViews"][0]["byteOffset"] = 1 << 20; });
    const std::string path = scratchPath("cut.glb");
    support::writeFragmentFile(path, broken_.file);
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_THROW(readFragmentFile(path), std::exception);
}

TEST(ModelFile, ReadsTheSameBoxFromEveryFormat) {
    const std::string obj = scratchPath("box.obj"), off = scratchPath("box.off"), stl = scratchPath("box.stl");
    std::ofstream(obj)
        << "# quads, one by negative indices\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
           "v 0 1 1\nf 4 3 2 1\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1 2 6 5\nf 3//2 4//2 8//2 7//2\nf -7 -6 -2 -3\nf 1 5 8 4\n";
    std::ofstream(off) << "OFF\n8 6 0\n# comment\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                          "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4 255 0 0\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
    std::ofstream text(stl);
    text << "solid box\n";
    for (const Triangle& t : support::boxTriangles({0, 0, 0}, {1, 1, 1})) {
        text << "facet normal 0 0 0\nouter loop\n";
        for (const Point& p : t)
            text << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
        text << "endloop\nendfacet\n";
    }
    text.close();
    for (const std::string& path : {obj, off, stl}) {
        const Triangles box = readModel(path);
        EXPECT_EQ(box.size(), 12u) << path;
        EXPECT_NEAR(volumeOf(box), 1, 1e-12) << path;
        EXPECT_NEAR(areaOf(box), 6, 1e-12) << path;
    }
}

} // namespace
} // namespace reference
