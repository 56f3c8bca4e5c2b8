// No kernel reads or writes a buffer in the header of a loop.
//
// GPU-assisted validation puts a branch before each access of a buffer, and so splits the block of the access. The header of
// a loop is the block that ends in OpLoopMerge. Debian 12's layer moves OpLoopMerge to the last part of a split header, but
// the loop goes on to jump to the first part. This is not valid SPIR-V: drivers refuse it, and worlds are not created.
//
// The layer accepts an access in any other block: in the body, in a condition that has a block of its own, and in the block
// that goes back to the header. It does not check atomics, and an access in a function splits only blocks of the function.
//
// The compiler joins a condition to the header if the condition is one expression, such as `i < counts[0]`. To mend a
// kernel, read the bound into a variable before the loop.
#include "shaders-spirv/embedded.h"
#include "tests/engine/test_device.h"
#include "tests/kernel/lab.h"

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using Words = std::vector<uint32_t>;
constexpr size_t kHeaderWords = 5;

// Follows pointers of one module to the buffers that they lead to. The name of a buffer is that of its block.
class BufferPointers {
public:
    void see(std::span<const uint32_t> w) {
        const uint32_t op = w[0] & 0xffffu;
        if (op == spv::OpName) names_[w[1]] = reinterpret_cast<const char*>(&w[2]);
        if (op == spv::OpTypePointer) pointees_[w[1]] = w[3];
        const bool is_buffer =
            op == spv::OpVariable && (w[3] == spv::StorageClassStorageBuffer || w[3] == spv::StorageClassUniform);
        if (is_buffer) buffers_[w[2]] = names_[pointees_[w[1]]];
        if (op == spv::OpAccessChain && buffers_.contains(w[3])) places_[w[2]] = buffers_[w[3]];
    }
    // The buffer that an instruction reads or writes; empty if it does neither.
    std::string accessedBy(std::span<const uint32_t> w) const {
        const uint32_t op = w[0] & 0xffffu;
        if (op != spv::OpLoad && op != spv::OpStore) return {};
        const auto place = places_.find(op == spv::OpLoad ? w[3] : w[1]);
        return place == places_.end() ? std::string() : place->second;
    }

private:
    std::map<uint32_t, std::string> names_, buffers_, places_;
    std::map<uint32_t, uint32_t> pointees_;
};

// Names of the buffers that headers of loops access.
std::set<std::string> accessedInLoopHeaders(std::span<const uint32_t> words) {
    BufferPointers pointers;
    std::set<std::string> found, of_block;
    for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
        const auto instruction = words.subspan(at, words[at] >> 16);
        pointers.see(instruction);
        const uint32_t op = instruction[0] & 0xffffu;
        if (op == spv::OpLabel) of_block.clear();
        if (op == spv::OpLoopMerge) found.insert(of_block.begin(), of_block.end());
        const std::string accessed = pointers.accessedBy(instruction);
        if (!accessed.empty()) of_block.insert(accessed);
    }
    return found;
}

std::vector<shaders::Module> everyKernel() {
    std::vector<shaders::Module> kernels;
    for (const auto modules : {shaders::all(), shaders::engineTestKernels(), shaders::kernelTestKernels()})
        kernels.insert(kernels.end(), modules.begin(), modules.end());
    return kernels;
}

// ---- the layer's own rewriting --------------------------------------------------------------------------------------------

// Later versions of SPIRV-Tools leave this to the layer.
bool registerChecks(spvtools::Optimizer& optimizer) { return optimizer.RegisterPassFromFlag("--inst-buff-oob-check"); }

bool isRewritable() {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    optimizer.SetMessageConsumer([](auto...) {});
    return registerChecks(optimizer);
}

// Whether a kernel is valid after SPIRV-Tools has put a check before each access, as the layer has it do.
bool isValidWithChecks(std::span<const uint32_t> words) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_1);
    registerChecks(optimizer);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    Words rewritten;
    if (!optimizer.Run(words.data(), words.size(), &rewritten, options)) return false;
    return spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(rewritten);
}

// ---- a loop in assembly, with instructions put into its blocks ------------------------------------------------------------

struct Loop {
    std::string header, condition, body, continuing;
};

const std::string kRead = "%place = OpAccessChain %place_type %counts %zero %i\n%read = OpLoad %uint %place\n";
const std::string kWrite = "%place = OpAccessChain %place_type %counts %zero %i\nOpStore %place %ten\n";
const std::string kAdd = "%place = OpAccessChain %place_type %counts %zero %i\n"
                         "%old = OpAtomicIAdd %uint %place %one %zero %one\n";
const std::string kCall = "%called = OpFunctionCall %uint %reader\n";

std::string textOf(const Loop& loop) {
    return R"(OpCapability Shader
OpMemoryModel Logical GLSL450
OpEntryPoint GLCompute %main "main"
OpExecutionMode %main LocalSize 1 1 1
OpName %block "counts_block"
OpDecorate %words ArrayStride 4
OpMemberDecorate %block 0 Offset 0
OpDecorate %block Block
OpDecorate %counts DescriptorSet 0
OpDecorate %counts Binding 0
%void = OpTypeVoid
%bool = OpTypeBool
%uint = OpTypeInt 32 0
%zero = OpConstant %uint 0
%one = OpConstant %uint 1
%ten = OpConstant %uint 10
%words = OpTypeRuntimeArray %uint
%block = OpTypeStruct %words
%block_type = OpTypePointer StorageBuffer %block
%place_type = OpTypePointer StorageBuffer %uint
%counts = OpVariable %block_type StorageBuffer
%main_type = OpTypeFunction %void
%reader_type = OpTypeFunction %uint
%reader = OpFunction %uint None %reader_type
%reading = OpLabel
%read_place = OpAccessChain %place_type %counts %zero %zero
%result = OpLoad %uint %read_place
OpReturnValue %result
OpFunctionEnd
%main = OpFunction %void None %main_type
%entry = OpLabel
OpBranch %header
%header = OpLabel
%i = OpPhi %uint %zero %entry %next %continuing
)" + loop.header +
           "OpLoopMerge %after %continuing None\nOpBranch %condition\n%condition = OpLabel\n" + loop.condition +
           "%more = OpULessThan %bool %i %ten\nOpBranchConditional %more %body %after\n%body = OpLabel\n" + loop.body +
           "OpBranch %continuing\n%continuing = OpLabel\n" + loop.continuing +
           "%next = OpIAdd %uint %i %one\nOpBranch %header\n%after = OpLabel\nOpReturn\nOpFunctionEnd\n";
}

Words wordsOf(const Loop& loop) {
    const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    Words words;
    EXPECT_TRUE(tools.Assemble(textOf(loop), &words) && tools.Validate(words)) << textOf(loop);
    return words;
}

const std::vector<Loop> kTaken = {
    {}, {.condition = kRead}, {.body = kRead}, {.continuing = kRead}, {.header = kAdd}, {.header = kCall}};
const std::vector<Loop> kRefused = {{.header = kRead}, {.header = kWrite}};

} // namespace

TEST(LoopHeaders, OfAllKernelsAccessNoBuffer) {
    for (const shaders::Module& kernel : everyKernel())
        for (const std::string& buffer : accessedInLoopHeaders(kernel.words))
            ADD_FAILURE() << kernel.name << " (" << kernel.file << " " << kernel.defines << "): the condition of a loop reads "
                          << buffer << "; read it into a variable before the loop";
}

TEST(LoopHeaders, ThatAccessABufferAreFound) {
    for (const Loop& loop : kRefused)
        EXPECT_EQ(accessedInLoopHeaders(wordsOf(loop)), std::set<std::string>{"counts_block"}) << textOf(loop);
    for (const Loop& loop : kTaken)
        EXPECT_TRUE(accessedInLoopHeaders(wordsOf(loop)).empty()) << textOf(loop);
}

TEST(LoopHeaders, ThatAccessABufferAreAllThatTheLayerCannotRewrite) {
    if (!isRewritable()) GTEST_SKIP() << "this SPIRV-Tools does not rewrite kernels for the layer";
    for (const Loop& loop : kRefused)
        EXPECT_FALSE(isValidWithChecks(wordsOf(loop))) << textOf(loop);
    for (const Loop& loop : kTaken)
        EXPECT_TRUE(isValidWithChecks(wordsOf(loop))) << textOf(loop);
}

TEST(LoopHeaders, LeaveEveryKernelValidWithChecks) {
    if (!isRewritable()) GTEST_SKIP() << "this SPIRV-Tools does not rewrite kernels for the layer";
    for (const shaders::Module& kernel : everyKernel())
        EXPECT_TRUE(isValidWithChecks(kernel.words)) << kernel.name;
}
