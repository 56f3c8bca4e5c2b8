// Sources that the compiler does not survive, and kernels that no device could run, checked in a process of their own.
#include "engine/reload/checking_process.h"
#include "tests/reload/hostile_sources.h"
#include "tests/reload/source_folder.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace reload_test;

namespace {

class HostileSources : public SourceFolder {
protected:
    CheckedKernel check(const std::string& text) {
        write("kernel.comp", text);
        return process_.check({"kernel", folder() / "kernel.comp", {}}, nullptr, {folder()});
    }
    // Of the one error that there is.
    std::string errorOf(const std::string& text) {
        const CheckedKernel checked = check(text);
        EXPECT_FALSE(checked.good());
        EXPECT_EQ(checked.diagnostics.size(), 1u) << textOf(checked.diagnostics);
        return checked.diagnostics.empty() ? "" : textOf(checked.diagnostics[0]);
    }
    static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
    const std::string kHead =
        "#version 450\nlayout(local_size_x = 64) in;\nlayout(binding = 0, std430) buffer B { uint b[]; };\n";

private:
    CheckingProcess process_;
};

} // namespace

TEST_F(HostileSources, ThatAreSoundGiveTheWordsThatTheCompilerGives) {
    const std::string text = kHead + "#include \"add.glsl\"\nvoid main() { b[0] = add(b[1], UP); }\n";
    write("add.glsl", "uint add(uint x, uint y) { return x + y; }\n");
    write("kernel.comp", text);
    const KernelSource source = {"kernel", folder() / "kernel.comp", {"UP=3u"}};
    const CompiledKernel here = compileGlsl(source, {folder()});
    EXPECT_FALSE(here.good()) << "an extension is missing";
    CheckingProcess process;
    EXPECT_EQ(textOf(process.check(source, nullptr, {folder()}).diagnostics), textOf(here.diagnostics));
    write("kernel.comp", replaced(text, "450\n", "450\n#extension GL_GOOGLE_include_directive : require\n"));
    const CompiledKernel good = compileGlsl(source, {folder()});
    const CheckedKernel apart = process.check(source, nullptr, {folder()});
    ASSERT_TRUE(good.good() && apart.good()) << textOf(apart.diagnostics);
    EXPECT_EQ(*apart.words, good.words);
    EXPECT_EQ(apart.files, good.files);
    EXPECT_TRUE(apart.knows_files);
}

TEST_F(HostileSources, ThatOverflowTheCompilersStackAreErrors) {
    for (int k = 0; k < 2; ++k) {
        EXPECT_TRUE(has(errorOf(kHead + sumOfTerms(200'000)), "the compiler dies of it"));
        EXPECT_TRUE(check(kHead + sumOfTerms(100)).good()) << "and the next one is compiled";
    }
    EXPECT_FALSE(check(kHead + sumOfTerms(200'000)).knows_files) << "it may be in a file that is included";
}

TEST_F(HostileSources, ThatEatAllMemoryAreErrors) {
    if (!isolationLimitsMemory()) GTEST_SKIP() << "the address sanitizer reserves terabytes of addresses";
    const std::string error = errorOf(kHead + doublingMacros(40));
    EXPECT_TRUE(has(error, "takes more than 2 GiB") || has(error, "takes longer than 30 s")) << error;
}

TEST_F(HostileSources, ThatShareMoreThanDevicesHaveAreErrors) {
    const auto sharing = [&](const std::string& length) {
        return kHead + "shared uint few[4];\nshared uint many[" + length +
               "];\nvoid main() { many[b[0]] = few[b[2]] = b[1]; barrier(); b[3] = many[b[4]] + few[b[5]]; }\n";
    };
    EXPECT_TRUE(check(sharing("8188")).good());
    const std::string error = errorOf(sharing("8189"));
    EXPECT_TRUE(has(error, "keeps 32772 bytes in memory that its groups share, \"many\" alone 32756; the most is 32768"))
        << error;
    EXPECT_TRUE(has(errorOf(sharing("0x40000000")), "groups share"));
}

TEST_F(HostileSources, ThatKeepTooMuchForEveryLaneAreErrors) {
    const auto keeping = [&](const std::string& length) {
        return kHead + "void main() { uint own[" + length +
               "]; for (uint k = 0u; k < b[0]; ++k) own[b[k]] = k; b[gl_GlobalInvocationID.x] = own[b[1]]; }\n";
    };
    EXPECT_TRUE(check(keeping("1000")).good());
    EXPECT_TRUE(has(errorOf(keeping("1000000")), "for every lane, \"own\" alone 4000000; the most is 65536"));
}

TEST_F(HostileSources, AreNotWaitedForWhereNobodyWantsThem) {
    write("kernel.comp", kHead + doublingMacros(40));
    CheckingProcess process;
    const CheckedKernel checked = process.check({"kernel", folder() / "kernel.comp", {}}, nullptr, {folder()},
                                                [calls = 0]() mutable { return ++calls > 3; });
    EXPECT_FALSE(checked.good());
    EXPECT_LT(checked.ms, 5000) << "it would take half a minute, or all memory";
}
