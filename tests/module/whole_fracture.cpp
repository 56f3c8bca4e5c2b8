#include "tests/module/whole_fracture.h"

#include "modules/brittle/export/glb.h"
#include "modules/brittle/fracture/refracture.h"
#include "modules/brittle/fracture/verify.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/engine/test_device.h"
#include "tests/reference/contract.h"
#include "tests/reference/model_file.h"
#include "tests/support/shapes.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>

namespace whole {
namespace {

using brittle::FractureOptions;
using brittle::FractureResult;

// Goes before its device does.
class SharedFracture : public testing::Environment {
public:
    brittle::Fracture& get() {
        if (!fracture_) {
            auto made = brittle::Fracture::create(engine_test::device());
            if (!made) ADD_FAILURE() << made.error().message;
            fracture_ = std::move(*made);
        }
        return *fracture_;
    }
    void TearDown() override { fracture_.reset(); }

private:
    std::unique_ptr<brittle::Fracture> fracture_;
};
SharedFracture& shared_fracture = *static_cast<SharedFracture*>(testing::AddGlobalTestEnvironment(new SharedFracture));

// As a break of the model at hand, whatever was cut before.
reference::FragmentFile exported(brittle::FragmentSet fragments) {
    for (brittle::Fragment& fragment : fragments.fragments)
        fragment.earlier_index_count = 0;
    const auto bytes = brittle::encodeGlb(fragments);
    EXPECT_TRUE(bytes) << bytes.error().message;
    const std::string path = testing::TempDir() + "brittle_contract_" + std::to_string(getpid()) + ".glb";
    std::ofstream(path, std::ios::binary) << *bytes;
    auto file = reference::readFragmentFile(path);
    std::filesystem::remove(path);
    return file;
}

void expectCountsAddUp(const FractureResult& result) {
    const brittle::FractureCounts& c = result.counts;
    EXPECT_EQ(c.sites_used + c.sites_welded, c.sites_requested);
    EXPECT_EQ(c.cells_ok + c.cells_empty + c.cells_refused, c.sites_used);
    EXPECT_EQ(result.sites.size(), c.sites_used);
    EXPECT_GE(result.fragments.fragments.size(), c.cells_ok);
}

// A model that is inside out is taken for the solid that its surface encloses.
void turnOutward(reference::Triangles& triangles) {
    if (reference::volumeOf(triangles) < 0) triangles = support::turnedOver(triangles);
}

} // namespace

brittle::Fracture& fracture() { return shared_fracture.get(); }

Model modelFrom(const brittle::ImportedMesh& imported) {
    auto prepared = brittle::prepareMesh(imported);
    EXPECT_TRUE(prepared) << prepared.error().message;
    Model model{std::move(*prepared), {}};
    for (const brittle::Index3& t : imported.triangles)
        model.triangles.push_back({imported.positions[t[0]], imported.positions[t[1]], imported.positions[t[2]]});
    turnOutward(model.triangles);
    return model;
}

Model modelFrom(const std::string& name) {
    if (name.starts_with("builtin:")) {
        auto made = brittle::makeBuiltin(name.substr(8));
        EXPECT_TRUE(made) << made.error().message;
        return modelFrom(*made);
    }
    auto imported = brittle::importMesh(support::sharedMesh(name));
    EXPECT_TRUE(imported) << imported.error().message;
    Model model = modelFrom(*imported);
    model.triangles = reference::readModel(support::sharedMesh(name).string());
    turnOutward(model.triangles);
    return model;
}

brittle::ImportedMesh boxOf(const brittle::Double3& lower, const brittle::Double3& upper) {
    brittle::ImportedMesh box = brittle::makeCube();
    for (brittle::Double3& p : box.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] = p[k] < 0 ? lower[k] : upper[k];
    return box;
}

Model modelFrom(const brittle::FragmentSet& set, size_t fragment) {
    auto prepared = brittle::prepareFragment(set, fragment);
    EXPECT_TRUE(prepared) << prepared.error().message;
    Model model{std::move(*prepared), {}};
    const brittle::Fragment& f = set.fragments[fragment];
    for (uint32_t k = 0; k < f.outer_index_count + f.inner_index_count; k += 3) {
        reference::Triangle& triangle = model.triangles.emplace_back();
        for (uint32_t c = 0; c < 3; ++c)
            for (size_t axis = 0; axis < 3; ++axis)
                triangle[c][axis] =
                    set.center[axis] + set.vertices[f.first_vertex + set.indices[f.first_index + k + c]].position[axis];
    }
    return model;
}

void expectContract(const Model& model, const FractureOptions& options) {
    const auto result = fracture().shatter(model.prepared.mesh, model.prepared.topology, options);
    ASSERT_TRUE(result) << result.error().message;
    expectContract(model, *result);
}

void expectContract(const Model& model, const FractureResult& result) {
    expectCountsAddUp(result);
    const brittle::MeshMeasures measures = brittle::measureMesh(model.prepared.mesh);
    const auto own = brittle::verifyContract(model.prepared.mesh, measures, result.fragments, result.sites);
    EXPECT_TRUE(own.holds()) << own.violation();
    const reference::ContractReport report = reference::checkContract(exported(result.fragments), model.triangles);
    EXPECT_TRUE(report.holds()) << report.text();
}

void expectContractOf(const Model& model, std::initializer_list<uint32_t> site_counts) {
    for (const uint32_t count : site_counts) {
        SCOPED_TRACE(count);
        FractureOptions options;
        options.site_count = count;
        expectContract(model, options);
    }
}

void expectContractAt(const Model& model, const std::vector<brittle::Double3>& sites) {
    FractureOptions options;
    options.given_sites = sites;
    expectContract(model, options);
}

std::map<uint32_t, std::set<std::array<float, 3>>> placesByCell(const brittle::FractureResult& result) {
    std::map<uint32_t, std::set<std::array<float, 3>>> places;
    for (const brittle::Fragment& f : result.fragments.fragments)
        for (uint32_t k = 0; k < f.vertex_count; ++k) {
            const auto& p = result.fragments.vertices[f.first_vertex + k].position;
            places[f.cell].insert({p[0], p[1], p[2]});
        }
    return places;
}

} // namespace whole
