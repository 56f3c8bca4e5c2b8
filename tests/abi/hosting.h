// A host that keeps what it makes: a context on a device of its own, and worlds in it.
#pragma once

#include "tests/abi/host_device.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace abi_test {

// Good, or the test fails with the context's last error.
#define MUST(context, call)                                                                                                    \
    do {                                                                                                                       \
        const BrittleResult must_result = (call);                                                                              \
        ASSERT_EQ(must_result, BRITTLE_OK) << brittleResultName(must_result) << ": " << brittleLastError(context);             \
    } while (false)

BrittleContextDef defOn(const HostDevice& device);

class Hosting {
public:
    explicit Hosting(const HostOptions& options = {}, const BrittleAllocator& allocator = {});
    // The layers must not have said anything.
    ~Hosting();
    HostDevice& device() { return device_; }
    BrittleContext* context() const { return context_; }
    operator BrittleContext*() const { return context_; }
    std::string error() const { return brittleLastError(context_); }
    BrittleMaterial material(const char* name) const;

private:
    HostDevice device_;
    BrittleContext* context_ = nullptr;
};

// Above the ground, a glass cube of 20 cm that turns as it falls.
BrittleBodyDef glassCube(const Hosting& host, double height);

struct Scene {
    BrittleWorld world = {0};
    BrittleBody ground = {0};
    std::vector<BrittleBody> bodies;
};
// Started, unless it is not to be.
Scene makeScene(const Hosting& host, const std::vector<BrittleBodyDef>& bodies, const BrittleWorldDef& def, bool starts = true);
Scene makeScene(const Hosting& host, const std::vector<BrittleBodyDef>& bodies);

std::vector<BrittleBodyState> bodiesOf(const Hosting& host, BrittleWorld world);
std::vector<BrittleBreak> breaksOf(const Hosting& host, BrittleWorld world);
BrittleCounts countsOf(const Hosting& host, BrittleWorld world);
std::vector<std::byte> savedOf(const Hosting& host, BrittleWorld world);
uint64_t hashOf(const Hosting& host, BrittleWorld world);

struct HostMesh {
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    BrittleMeshDef def() const;
};
// A cube about the origin.
HostMesh cubeMesh(double edge = 2);

} // namespace abi_test
