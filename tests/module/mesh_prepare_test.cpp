#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace brittle;

namespace {

// Every triangle with corners of its own, as STL has them.
ImportedMesh soupOf(const ImportedMesh& mesh) {
    MeshBuilder soup;
    for (const Index3& t : mesh.triangles) {
        std::array<PolygonCorner, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k].position = static_cast<uint32_t>(soup.vertexCount());
            soup.addVertex(mesh.positions[t[k]]);
        }
        soup.addPolygon(corners);
    }
    return soup.take();
}

// And a triangle of two corners `between` apart and one far away.
ImportedMesh withSpike(ImportedMesh mesh, double between, double far) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {between, 0, 0}, {far, far, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    return mesh;
}

ImportedMesh moved(ImportedMesh mesh, double scale, const Double3& by) {
    for (Double3& p : mesh.positions)
        p = scale * p + by;
    return mesh;
}

} // namespace

TEST(Prepare, WeldsTrianglesThatShareNothing) {
    const ImportedMesh sphere = makeIcosphere(3);
    const auto model = prepareMesh(soupOf(sphere));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->mesh.positions.size(), sphere.positions.size());
    EXPECT_EQ(model->notes.welded, 3 * sphere.triangles.size() - sphere.positions.size());
    EXPECT_EQ(model->notes.vertices_in, 3 * sphere.triangles.size());
}

TEST(Prepare, MinusZeroIsZero) {
    ImportedMesh cube = moved(makeCube(), 1, {0.5, 0.5, 0.5});
    cube = moved(soupOf(cube), 1, {-0.5, -0.5, -0.5});
    MeshBuilder builder;
    for (const Double3& p : {Double3{-1, -1, 0}, Double3{1, 1, 0.0}, Double3{1, -1, -0.0}, Double3{1, -1, 0.0}})
        builder.addVertex(p);
    const auto corner = [](uint32_t v) { return PolygonCorner{v, {0, 0, 0}, {0, 0}}; };
    builder.addPolygon(std::vector{corner(0), corner(1), corner(2)});
    builder.addPolygon(std::vector{corner(0), corner(3), corner(1)});
    const auto model = prepareMesh(builder.take());
    ASSERT_TRUE(model);
    EXPECT_EQ(model->mesh.positions.size(), 3u);
}

TEST(Prepare, CenterIsThatOfTheBoxAndStrayVerticesDoNotCount) {
    ImportedMesh mesh = moved(makeCube(), 2, {1e6, -2e6, 3e6});
    mesh.positions.push_back({1e9, 1e9, 1e9});
    const auto model = prepareMesh(mesh);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->mesh.center, (Double3{1e6, -2e6, 3e6}));
    EXPECT_EQ(model->notes.unused, 1u);
    EXPECT_EQ(model->mesh.positions.size(), 8u);
    for (const Float3& p : model->mesh.positions)
        for (const float x : p)
            EXPECT_EQ(std::abs(x), 1.0f);
}

TEST(Prepare, KeepsItsBitsFarFromTheOrigin) {
    const auto near = prepareMesh(makeIcosphere(3));
    const auto far = prepareMesh(moved(makeIcosphere(3), 1, {1e6, -2e6, 3e6}));
    ASSERT_TRUE(near && far);
    const MeshMeasures a = measureMesh(near->mesh), b = measureMesh(far->mesh);
    EXPECT_NEAR(a.volume, b.volume, 1e-7 * a.volume);
    EXPECT_EQ(near->mesh.positions.size(), far->mesh.positions.size());
}

TEST(Prepare, TurnsAnInsideOutModel) {
    ImportedMesh mesh = makeBumpySphere(2);
    for (Index3& t : mesh.triangles)
        std::swap(t[0], t[1]);
    const auto model = prepareMesh(mesh);
    ASSERT_TRUE(model);
    EXPECT_TRUE(model->notes.turned_inside_out);
    EXPECT_GT(measureMesh(model->mesh).volume, 0);
}

TEST(Prepare, DropsCollapsedTrianglesAndTheirVertices) {
    ImportedMesh mesh = makeCube();
    mesh.positions.push_back({0.1, 0.2, 0.3});
    mesh.triangles.push_back({0, 8, 0});
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    const auto model = prepareMesh(mesh);
    ASSERT_TRUE(model);
    EXPECT_EQ(model->notes.collapsed, 1u);
    EXPECT_EQ(model->mesh.positions.size(), 8u);
    EXPECT_EQ(model->mesh.triangles.size(), 12u);
}

// A corner of a triangle that is no more does not count, whether two others are at one place in the file or only as floats.
TEST(Prepare, IsAsLargeAsWhatHasNotCollapsed) {
    for (const double between : {0.0, 1e-9}) {
        const auto prepared = prepareMesh(withSpike(makeCube(), between, 100));
        ASSERT_TRUE(prepared) << prepared.error().message;
        EXPECT_EQ(prepared->mesh.center, (Double3{0, 0, 0}));
        EXPECT_EQ(prepared->mesh.positions.size(), 8u);
        EXPECT_EQ(prepared->notes.collapsed, 1u);
    }
    EXPECT_FALSE(prepareMesh(withSpike(moved(makeCube(), 1e-12, {0, 0, 0}), 0, 100))) << "too small to be worked with";
}

TEST(Prepare, RefusesWhatFloatsCannotHold) {
    ImportedMesh bad = makeCube();
    bad.positions[3][1] = std::nan("");
    EXPECT_FALSE(prepareMesh(bad));
    EXPECT_FALSE(prepareMesh(moved(makeCube(), 1e12, {0, 0, 0})));
    EXPECT_FALSE(prepareMesh(moved(makeCube(), 1e-12, {0, 0, 0})));
    EXPECT_FALSE(prepareMesh(moved(makeCube(), 0, {1, 2, 3})));
    EXPECT_FALSE(prepareMesh(ImportedMesh{}));
    EXPECT_TRUE(prepareMesh(moved(makeCube(), 1e7, {0, 0, 0})));
    EXPECT_TRUE(prepareMesh(moved(makeCube(), 1e-6, {0, 0, 0})));
}

TEST(Normals, SmoothOnASphereSharpOnACube) {
    const auto sphere = prepareMesh(makeIcosphere(4));
    ASSERT_TRUE(sphere);
    for (size_t corner = 0; corner < sphere->mesh.corner_normals.size(); ++corner) {
        const Double3 p = toDouble(sphere->mesh.positions[sphere->mesh.triangles[corner / 3][corner % 3]]);
        EXPECT_GT(dot(toDouble(sphere->mesh.corner_normals[corner]), p) / length(p), 0.9995);
    }
    const auto cube = prepareMesh(makeCube());
    ASSERT_TRUE(cube);
    for (const Float3& normal : cube->mesh.corner_normals)
        EXPECT_EQ(std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]), 1.0f);
}

TEST(Normals, ThoseOfTheFileAreKeptAndPointOutward) {
    ImportedMesh mesh = makeCube();
    for (size_t corner = 0; corner < mesh.corner_normals.size(); ++corner) {
        const Double3 inward = -3.0 * mesh.positions[mesh.triangles[corner / 3][corner % 3]]; // of any length
        mesh.corner_normals[corner] = toFloat(inward);
    }
    const auto model = prepareMesh(mesh);
    ASSERT_TRUE(model);
    for (size_t corner = 0; corner < model->mesh.corner_normals.size(); ++corner) {
        const Double3 n = toDouble(model->mesh.corner_normals[corner]);
        EXPECT_NEAR(length(n), 1, 1e-6);
        EXPECT_GT(dot(n, toDouble(model->mesh.positions[model->mesh.triangles[corner / 3][corner % 3]])), 0.8);
    }
}

TEST(Measures, OfACubeOffCenter) {
    const auto model = prepareMesh(moved(makeCube(), 2, {5, 6, 7}));
    ASSERT_TRUE(model);
    const MeshMeasures m = measureMesh(model->mesh);
    EXPECT_DOUBLE_EQ(m.volume, 8);
    EXPECT_DOUBLE_EQ(m.area, 24);
    EXPECT_DOUBLE_EQ(m.diagonal, std::sqrt(12.0));
    EXPECT_NEAR(length(m.centroid), 0, 1e-12);
}

TEST(Primitives, AreWhatTheyAreSaidToBe) {
    const auto euler = [](const PreparedMesh& model) {
        return static_cast<int64_t>(model.mesh.positions.size() + model.mesh.triangles.size()) -
               static_cast<int64_t>(model.topology.edges.size());
    };
    const auto ring = prepareMesh(makeTwistedRing()), bumpy = prepareMesh(makeBumpySphere(5));
    ASSERT_TRUE(ring && bumpy);
    EXPECT_EQ(euler(*ring), 0); // a hole through it
    EXPECT_EQ(euler(*bumpy), 2);
    EXPECT_EQ(bumpy->mesh.triangles.size(), 20'480u);
    EXPECT_FALSE(ring->notes.turned_inside_out);
    EXPECT_FALSE(makeBuiltin("icosphere:9"));
    EXPECT_FALSE(makeBuiltin("cube:1"));
    EXPECT_FALSE(makeBuiltin(""));
    EXPECT_TRUE(makeBuiltin("icosphere:0"));
}
