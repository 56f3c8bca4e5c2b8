// brittle compare as its users meet it.
#include "modules/brittle/mesh/byte_hash.h"
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string_view>

namespace {

using nlohmann::json;
using support::Outcome;
using support::runProgram;

class CompareCli : public support::FolderTest {
protected:
    static Outcome compare(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "compare");
        return runProgram("brittle", arguments);
    }
    static void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& holds) {
        const Outcome run = compare(arguments);
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
    }
    // A box that falls onto the ground.
    std::string fallingBox(double height = 1.5) const {
        std::ofstream(path("box.toml")) << "name = \"box\"\n[[body]]\nname = \"box\"\nplace = [0, " << height
                                        << ", 0]\nspin = [1, 2, 3]\n[[collider]]\nname = \"ground\"\n";
        return path("box.toml");
    }
    // A tetrahedron whose vertices lie in wedge.bin; `lean` moves one of them.
    std::string sceneOfAWedge(float lean) const {
        const float places[] = {0, 0, 0, 1, 0, 0, 0, 1 + lean, 0, 0, 0, 1};
        const uint16_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        std::ofstream buffer(path("wedge.bin"), std::ios::binary);
        buffer.write(reinterpret_cast<const char*>(places), sizeof places);
        buffer.write(reinterpret_cast<const char*>(corners), sizeof corners);
        std::ofstream(path("wedge.gltf"))
            << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"wedge.bin","byteLength":72}],"bufferViews":[)"
            << R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],"accessors":[)"
            << R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,)" << 1 + lean
            << R"(,1]},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"meshes":[{"primitives":[)"
            << R"({"attributes":{"POSITION":0},"indices":1}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
        std::ofstream(path("wedge.toml"))
            << "name = \"wedge\"\n[[body]]\nname = \"wedge\"\nshape = \"mesh\"\nfile = \"wedge.gltf\"\nsites = 1\n"
               "place = [0, 2, 0]\n[[collider]]\nname = \"ground\"\n";
        return path("wedge.toml");
    }
    static json parsed(const Outcome& run) {
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return json::parse(run.out, nullptr, false);
    }
    // Changes the content of a recording, and its checksum.
    static void change(const std::string& file, const std::function<void(json&)>& how) {
        const std::string bytes = support::fileBytes(file);
        json outer = json::from_cbor(bytes), content = json::from_cbor(outer["content"].get_binary());
        how(content);
        std::vector<uint8_t> changed = json::to_cbor(content);
        brittle::ByteHash hash;
        hash.add(std::as_bytes(std::span(changed)));
        outer["hash"] = hash.value();
        outer["content"] = json::binary(std::move(changed));
        const std::vector<uint8_t> written = json::to_cbor(outer);
        write(file, {reinterpret_cast<const char*>(written.data()), written.size()});
    }
    static void write(const std::string& file, std::string_view bytes) {
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    // Takes a bit of a body's velocity after a step, as another driver might.
    static void spoil(const std::string& file, size_t step) {
        change(file, [step](json& recording) {
            for (size_t k = step - 1; k < recording["steps"].size(); ++k)
                recording["steps"][k].get_binary().at(3 * 16) ^= 1; // the lowest bit of velocity.x of the first body
        });
    }
    std::string recorded(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments = {"--device", "0", fallingBox(), "--steps", "3", "--record", path("box.motion")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome run = compare(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return path("box.motion");
    }
};

TEST_F(CompareCli, ADeviceAgreesWithItself) {
    const Outcome run = compare({"--device", "0", "--device", "0", fallingBox(), "--steps", "30"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("are the same bit for bit after each of 30 steps"), std::string::npos) << run.out;
    const json report = parsed(compare({"--device", "0", "--device", "0", fallingBox(), "--seconds", "0.2", "--json"}));
    EXPECT_EQ(report["agree"], true);
    EXPECT_EQ(report["steps"], 12);
    EXPECT_EQ(report["device_a"], report["device_b"]);
    EXPECT_TRUE(report["first_difference"].is_null());
    EXPECT_TRUE(report["passes"].is_null());
    EXPECT_EQ(report["motion"]["position_m"], 0);
    EXPECT_EQ(report["motion"]["bodies"], 2);
}

TEST_F(CompareCli, ADeviceAgreesWithItselfWhereAPaneBreaks) {
    const std::string pane = std::string(BRITTLE_SOURCE_DIR) + "/modules/brittle/scene/examples/window_pane.toml";
    const json report = parsed(compare({"--device", "0", "--device", "0", pane, "--json", "--fail-on-difference"}));
    EXPECT_EQ(report["agree"], true) << report;
    EXPECT_GT(report["motion"]["bodies"], 5); // fragments among them
}

TEST_F(CompareCli, AgreesWithItsOwnRecording) {
    const std::string file = path("box.motion");
    const Outcome run = compare({"--device", "0", fallingBox(), "--steps", "20", "--record", file, "--passes-of", "5"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("20 steps of box"), std::string::npos) << run.out;
    const json report = parsed(compare({"--device", "0", fallingBox(), "--against", file, "--json"}));
    EXPECT_EQ(report["agree"], true) << report;
    EXPECT_EQ(report["steps"], 20);
    EXPECT_EQ(report["passes"]["step"], 5);
    EXPECT_EQ(report["passes"]["aligned"], report["passes"]["passes_a"]);
    EXPECT_GT(report["passes"]["passes_a"], 10);
    EXPECT_TRUE(report["passes"]["rows"].empty()) << report["passes"]["rows"];
}

TEST_F(CompareCli, SaysWhereAMotionLeavesARecording) {
    const std::string file = path("box.motion");
    ASSERT_EQ(compare({"--device", "0", fallingBox(), "--steps", "12", "--record", file}).exit_code, 0);
    spoil(file, 7);
    const json report = parsed(compare({"--device", "0", fallingBox(), "--against", file, "--json"}));
    EXPECT_EQ(report["agree"], false);
    EXPECT_EQ(report["steps"], 7);
    EXPECT_EQ(report["first_difference"]["step"], 7);
    EXPECT_EQ(report["first_difference"]["name"], "box");
    EXPECT_EQ(report["first_difference"]["member"], "velocity.x");
    EXPECT_GT(report["motion"]["linear_velocity"], 0);
    EXPECT_EQ(parsed(compare({"--device", "0", fallingBox(), "--against", file, "--whole", "--json"}))["steps"], 12);
    const Outcome strict = compare({"--device", "0", fallingBox(), "--against", file, "--fail-on-difference"});
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_NE(strict.out.find("differ after step 7: body 0 \"box\", velocity.x"), std::string::npos) << strict.out;
}

TEST_F(CompareCli, WantsTwoDevicesThatAreThere) {
    expectRefused({"--device", "0", fallingBox()}, 2, "--device is given 1 times, must be given twice");
    expectRefused({fallingBox()}, 2, "--device");
    expectRefused({"--device", "0", "--device", "0", "--device", "0", fallingBox()}, 2, "--device is given 3 times");
    expectRefused({"--device", "0", "--device", "no such card", fallingBox()}, 4, "no usable device matches \"no such card\"");
    expectRefused({"--device", "0", "--device", "99", fallingBox()}, 4, "no usable device matches \"99\"");
}

TEST_F(CompareCli, RefusesBadScenesAndFiles) {
    expectRefused({"--device", "0", "--device", "0", "no_such_scene"}, 2, "no_such_scene");
    expectRefused({"--device", "0", "--device", "0", path("none.toml")}, 2, "none.toml");
    expectRefused({"--device", "0", "stack_10", "--against", path("none.motion")}, 2, "none.motion: cannot be read");
    std::ofstream(path("bad.motion")) << "no motion";
    expectRefused({"--device", "0", "stack_10", "--against", path("bad.motion")}, 2, "bad.motion: is no recorded motion");
    expectRefused({"--device", "0", fallingBox(), "--steps", "3", "--record", path("box.motion"), "--passes-of", "4"}, 2,
                  "only 3 steps are recorded");
    EXPECT_FALSE(std::filesystem::exists(path("box.motion")));
}

TEST_F(CompareCli, RefusesTheRecordingOfAnotherScene) {
    const std::string file = path("box.motion");
    ASSERT_EQ(compare({"--device", "0", fallingBox(), "--steps", "3", "--record", file}).exit_code, 0);
    expectRefused({"--device", "0", "stack_10", "--against", file}, 2, "is a recording of the scene \"box\"");
    expectRefused({"--device", "0", fallingBox(), "--against", file, "--steps", "4"}, 2, "the recording has 3 steps");
}

TEST_F(CompareCli, RefusesADamagedRecording) {
    const std::string file = recorded({"--passes-of", "2"}), whole = support::fileBytes(file);
    const auto expectDamaged = [&](const std::string& bytes, const std::string& words) {
        write(file, bytes);
        expectRefused({"--device", "0", fallingBox(), "--against", file}, 2, words);
    };
    expectDamaged(whole.substr(0, whole.size() / 2), "damaged recording");
    std::string flipped = whole;
    flipped[whole.size() / 2] ^= 1;
    expectDamaged(flipped, "its checksum is wrong");
    expectRefused({"--device", "0", fallingBox(), "--against", path("")}, 2, "is a folder");
    expectRefused({"--device", "0", fallingBox(), "--against", "/dev/zero"}, 2, "is a folder, a pipe or a device");
    for (const char* list : {"steps", "passes"}) {
        write(file, whole);
        change(file, [list](json& recording) {
            (recording[list].is_array() ? recording[list] : recording[list]["passes"]) = json::array();
        });
        expectRefused({"--device", "0", fallingBox(), "--against", file}, 2, "cannot be compared with");
    }
    write(file, whole);
    change(file, [](json& recording) { recording["passes"]["step"] = -7; });
    expectRefused({"--device", "0", fallingBox(), "--against", file}, 2, "it has passes of step");
}

TEST_F(CompareCli, RefusesTheRecordingOfAChangedSceneOrGroupSize) {
    const std::string file = recorded();
    expectRefused({"--device", "0", fallingBox(), "--against", file, "--group-size", "128"}, 2, "workgroups of 64 lanes");
    expectRefused({"--device", "0", fallingBox(1.25), "--against", file}, 2, "another scene with the name \"box\"");
    EXPECT_EQ(compare({"--device", "0", fallingBox(), "--against", file, "--group-size", "64"}).exit_code, 0);
}

TEST_F(CompareCli, DoesNotWriteOverWhatItReads) {
    const std::string scene = sceneOfAWedge(0);
    for (const char* input : {"wedge.toml", "wedge.gltf", "wedge.bin"}) {
        const std::string before = support::fileBytes(path(input));
        expectRefused({"--device", "0", scene, "--record", path(input)}, 2, "would be overwritten");
        EXPECT_EQ(support::fileBytes(path(input)), before) << input;
    }
}

TEST_F(CompareCli, KnowsASceneByTheBuffersOfItsModels) {
    const std::string file = path("wedge.motion");
    ASSERT_EQ(compare({"--device", "0", sceneOfAWedge(0), "--steps", "2", "--record", file}).exit_code, 0);
    EXPECT_EQ(compare({"--device", "0", sceneOfAWedge(0), "--against", file}).exit_code, 0);
    expectRefused({"--device", "0", sceneOfAWedge(0.25F), "--against", file}, 2, "another scene with the name \"wedge\"");
}

TEST_F(CompareCli, RefusesOptionsThatWouldDoNothing) {
    for (const char* flag : {"--whole", "--json", "--fail-on-difference"})
        expectRefused({"--device", "0", fallingBox(), "--record", path("box.motion"), flag}, 2, "excludes");
    expectRefused({"--device", "0", "--device", "0", fallingBox(), "--seconds", "0"}, 2, "must be above 0");
}

} // namespace
