// Output of the program about glTF files.
#include "tests/support/folder_test.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/process.h"

#include <algorithm>
#include <fstream>

namespace {

using support::Outcome;
using support::runProgram;

class GltfCli : public support::FolderTest {
protected:
    // A cube, and a mesh that no node uses.
    std::string cubeWithANote() const {
        support::GltfBuilder builder = support::cubeFile();
        builder.addMesh(builder.json["meshes"][0]["primitives"][0]);
        std::ofstream(path("cube.glb"), std::ios::binary) << builder.glb();
        return path("cube.glb");
    }
    const std::string note_ = "1 mesh is left out: no node uses it";
};

TEST_F(GltfCli, DoctorPrintsNotesOfTheReader) {
    const std::string file = cubeWithANote();
    const Outcome text = runProgram("brittle", {"doctor", file});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_NE(text.out.find("note         " + note_), std::string::npos) << text.out;
    const Outcome run = runProgram("brittle", {"doctor", file, "--json"});
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["reader_notes"], nlohmann::json({note_}));
    EXPECT_EQ(report["volume"], 8);
}

TEST_F(GltfCli, ShatterPrintsNotesOfTheReaderOnStandardError) {
    const Outcome run = runProgram("brittle", {"shatter", cubeWithANote(), "-o", path("out.glb"), "--sites", "4", "--verify"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("cube.glb: note: " + note_ + "\n"), std::string::npos) << run.err;
}

// A scene that has the model as a mesh, as a hull and as a collider.
TEST_F(GltfCli, ScenesPrintNotesOfTheReaderOnce) {
    cubeWithANote();
    for (const std::string kind : {"mesh", "hull"}) {
        const std::string shape = "shape = \"" + kind + "\"\nfile = \"cube.glb\"\n",
                          body = shape + (kind == "mesh" ? "sites = 4\n" : "");
        std::ofstream(path("scene.toml")) << "[[body]]\nplace = [0, 3, 0]\n"
                                          << body << "[[body]]\nplace = [9, 3, 0]\n"
                                          << body << "[[collider]]\n"
                                          << shape;
        const Outcome run = runProgram("brittle", {"plan", path("scene.toml")});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err, "brittle: cube.glb: note: " + note_ + "\n") << kind;
    }
}

TEST_F(GltfCli, AnExtensionThatIsNotReadIsRefusedInOneLine) {
    support::GltfBuilder builder = support::cubeFile();
    builder.json["extensionsRequired"] = {"ACME_curved_triangles"};
    std::ofstream(path("curved.gltf")) << builder.gltf();
    const Outcome run = runProgram("brittle", {"doctor", path("curved.gltf")});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find("requires the extension ACME_curved_triangles, which is not read"), std::string::npos) << run.err;
}

} // namespace
