// What goes wrong is said, with the name of what it is about, and nothing is submitted.
#include "tests/engine/test_device.h"

#include <cstdlib>
#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;

namespace {

struct AddIndexPush {
    uint32_t count, factor;
};

void expectMessage(const Error& error, ErrorCode code, std::initializer_list<std::string_view> parts) {
    EXPECT_EQ(error.code, code);
    for (const std::string_view part : parts)
        EXPECT_NE(error.message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << error.message;
}

// What a recording says about one dispatch of add_index.
template <class Push>
Error mistake(const Push& push, std::vector<BufferView> buffers) {
    Commands commands(device());
    EXPECT_TRUE(commands.begin());
    commands.dispatch(testKernel(device(), "add_index"), 64, std::as_bytes(std::span(&push, 1)), buffers);
    const auto done = commands.submitAndWait();
    EXPECT_FALSE(done);
    return done ? Error{} : done.error();
}

class EnvironmentGuard {
public:
    explicit EnvironmentGuard(const char* value) {
        if (const char* before = std::getenv("BRITTLE_DEVICE")) before_ = before;
        setenv("BRITTLE_DEVICE", value, 1);
    }
    ~EnvironmentGuard() {
        if (before_.empty())
            unsetenv("BRITTLE_DEVICE");
        else
            setenv("BRITTLE_DEVICE", before_.c_str(), 1);
    }
    EnvironmentGuard(const EnvironmentGuard&) = delete;
    EnvironmentGuard& operator=(const EnvironmentGuard&) = delete;

private:
    std::string before_;
};

} // namespace

TEST(Errors, UnknownKernel) {
    KernelLibrary kernels(device(), shaders::engineTestKernels());
    const auto kernel = kernels.get("cut_cheese");
    ASSERT_FALSE(kernel);
    expectMessage(kernel.error(), ErrorCode::Internal, {"cut_cheese"});
    const KernelRequest requests[] = {{"increment", {}}, {"cut_cheese", {}}};
    EXPECT_FALSE(kernels.warm(requests));
    EXPECT_EQ(kernels.kernelCount(), 1u);
}

TEST(Errors, KernelsThatCannotBeDispatched) {
    KernelLibrary kernels(device(), shaders::engineTestKernels());
    expectMessage(kernels.get("passthrough.vert").error(), ErrorCode::Internal, {"passthrough.vert", "not a compute"});
    expectMessage(kernels.get("flat_workgroup").error(), ErrorCode::Internal, {"flat_workgroup", "dimension"});
    const uint32_t noise[] = {1, 2, 3, 4, 5, 6};
    const shaders::Module module{"noise", noise};
    KernelLibrary broken(device(), {&module, 1});
    expectMessage(broken.get("noise").error(), ErrorCode::Internal, {"noise", "SPIR-V"});
}

TEST(Errors, WrongNumberOfBuffers) {
    const Buffer words = scratch(device(), 64);
    expectMessage(mistake(AddIndexPush{64, 1}, {words}), ErrorCode::Internal, {"add_index", "1 buffers", "binds 2"});
}

TEST(Errors, WrongSizeOfThePushBlock) {
    const Buffer one = scratch(device(), 64), two = scratch(device(), 64);
    expectMessage(mistake(uint32_t{64}, {one, two}), ErrorCode::Internal, {"add_index", "4 bytes", "has 8"});
}

TEST(Errors, ViewsThatCannotBeBound) {
    const Buffer one = scratch(device(), 64), two = scratch(device(), 64);
    const AddIndexPush push{64, 1};
    expectMessage(mistake(push, {one, BufferView{}}), ErrorCode::Internal, {"add_index", "view 1", "Target", "empty"});
    expectMessage(mistake(push, {BufferView(one).sub(128, 16), two}), ErrorCode::Internal, {"view 0", "multiple of"});
    expectMessage(mistake(push, {one, BufferView(two).sub(0, 1024)}), ErrorCode::Internal,
                  {"view 1", "past its buffer", "scratch"});
}

TEST(Errors, ViewLargerThanABinding) {
    const VkDeviceSize most = device().limits().maxStorageBufferRange;
    if (most > (VkDeviceSize(1) << 30)) GTEST_SKIP() << "bindings of this device hold more than 1 GiB";
    auto large = Buffer::create(device(), most + 1024, BufferDomain::Device, 0, "large");
    ASSERT_TRUE(large);
    const Buffer one = scratch(device(), 64);
    expectMessage(mistake(AddIndexPush{64, 1}, {*large, one}), ErrorCode::Internal, {"view 0", "a binding holds"});
}

TEST(Errors, TheFirstMistakeIsKeptUntilTheNextRecording) {
    const Buffer words = upload(device(), {1, 2});
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.fill(BufferView(words).sub(1, 4), 0);
    commands.copy(words, BufferView(words).sub(0, 4));
    ASSERT_FALSE(commands.status());
    expectMessage(commands.status().error(), ErrorCode::Internal, {"fill"});
    EXPECT_FALSE(commands.submitAndWait());
    EXPECT_EQ(wordsOf(words), (std::vector<uint32_t>{1, 2}));
    ASSERT_TRUE(commands.begin());
    EXPECT_TRUE(commands.status());
    EXPECT_TRUE(commands.submitAndWait());
}

TEST(Errors, IndirectArgumentsThatAreNone) {
    const Buffer words = scratch(device(), 64);
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.dispatchIndirect(testKernel(device(), "increment"), BufferView(words).sub(0, 8), NoPush{}, {words});
    expectMessage(commands.submitAndWait().error(), ErrorCode::Internal, {"increment", "indirect"});
}

TEST(Errors, LabelsThatNestOrStayOpen) {
    Commands commands(device());
    ASSERT_TRUE(commands.begin());
    commands.beginLabel("outer");
    commands.beginLabel("inner");
    EXPECT_FALSE(commands.submitAndWait());
    ASSERT_TRUE(commands.begin());
    commands.beginLabel("never closed");
    EXPECT_FALSE(commands.submitAndWait());
}

TEST(Errors, NoSuchDevice) {
    const std::vector<DeviceInfo> devices = listDevices();
    ASSERT_FALSE(devices.empty());
    const auto made = [] {
        const EnvironmentGuard environment("a device that nobody has");
        return Device::create();
    }();
    ASSERT_FALSE(made);
    expectMessage(made.error(), ErrorCode::Device, {"a device that nobody has"});
    for (const DeviceInfo& d : devices)
        expectMessage(made.error(), ErrorCode::Device, {d.name, d.usable ? "usable" : d.why_not});
    DeviceOptions options;
    options.select = "99";
    EXPECT_FALSE(Device::create(options));
}
