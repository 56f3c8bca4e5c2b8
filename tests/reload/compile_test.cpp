#include "engine/reload/kernel_check.h"
#include "tests/engine/test_device.h"
#include "tests/reload/source_folder.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace reload_test;

namespace {

// Kernels that the compiled words of the program are compared with.
void expectSameWords(std::span<const shaders::Module> modules, const std::string& folder) {
    const std::filesystem::path root = BRITTLE_SOURCE_DIR;
    for (const shaders::Module& module : modules) {
        const CompiledKernel made = compileGlsl(sourceOf(module, root / folder), {root / "shaders-spirv"});
        ASSERT_TRUE(made.good()) << textOf(made.diagnostics);
        EXPECT_TRUE(std::ranges::equal(made.words, module.words)) << module.name;
    }
}

class Compiling : public SourceFolder {
protected:
    CompiledKernel compile(const std::string& text, std::vector<std::string> defines = {}) {
        write("kernel.comp", text);
        return compileGlsl({"kernel", folder() / "kernel.comp", std::move(defines)}, {folder()});
    }
    // The first error of a text, as editors read it.
    std::string errorOf(const std::string& text) {
        const CompiledKernel made = compile(text);
        EXPECT_FALSE(made.good());
        if (made.diagnostics.empty()) return "";
        const std::string error = textOf(made.diagnostics.front());
        return error.starts_with(folder().string()) ? error.substr(folder().string().size() + 1) : error;
    }
    const std::string kHead = "#version 450\n#extension GL_GOOGLE_include_directive : require\nlayout(local_size_x = 64) in;\n";
};

} // namespace

TEST_F(Compiling, GivesTheWordsOfTheBuild) {
    expectSameWords(shaders::engineTestKernels(), "tests/engine");
    std::vector<shaders::Module> some;
    for (const shaders::Module& module : shaders::all())
        if (module.words.size() < 1500) some.push_back(module);
    EXPECT_GT(some.size(), 50u);
    expectSameWords(some, "shaders-spirv");
}

TEST(LongCompiling, GivesTheWordsOfTheBuildForEveryKernel) { expectSameWords(shaders::all(), "shaders-spirv"); }

TEST_F(Compiling, TakesDefinesWithAndWithoutValues) {
    const std::string text =
        kHead + "layout(binding = 0) buffer B { uint b[]; };\nvoid main() {\n#ifdef PLAIN\n    b[0] = VALUE;\n#endif\n}\n";
    EXPECT_TRUE(compile(text, {"PLAIN", "VALUE=7u"}).good());
    EXPECT_TRUE(compile(text).good());
    EXPECT_FALSE(compile(text, {"PLAIN"}).good());
}

TEST_F(Compiling, KnowsWhatASourceIsMadeOf) {
    write("near/first.glsl", "#include \"second.glsl\"\n");
    write("near/second.glsl", "uint two() { return 2u; }\n");
    const CompiledKernel made = compile(kHead + "#include \"near/first.glsl\"\nvoid main() { two(); }\n");
    ASSERT_TRUE(made.good()) << textOf(made.diagnostics);
    const std::set<std::filesystem::path> files = {folder() / "kernel.comp", folder() / "near/first.glsl",
                                                   folder() / "near/second.glsl"};
    EXPECT_EQ(made.files, files);
}

TEST_F(Compiling, LooksForAMissingIncludeWhereItMayAppear) {
    const CompiledKernel made = compile(kHead + "#include \"absent.glsl\"\nvoid main() {}\n");
    EXPECT_FALSE(made.good());
    EXPECT_TRUE(made.files.contains(folder() / "absent.glsl"));
}

TEST_F(Compiling, SaysWhereAMistakeIs) {
    EXPECT_EQ(errorOf(kHead + "void main() {\n    uint a = lane;\n}\n"),
              "kernel.comp:5:14: error: 'lane' : undeclared identifier");
    EXPECT_EQ(errorOf(kHead + "#include \"absent.glsl\"\nvoid main() {}\n"),
              "kernel.comp:4:1: error: '#include' : Could not process include directive for header name: absent.glsl");
    write("wrong.glsl", "uint f() {\n  return nothing;\n}\n");
    EXPECT_EQ(errorOf(kHead + "#include \"wrong.glsl\"\nvoid main() { f(); }\n"),
              "wrong.glsl:2:10: error: 'nothing' : undeclared identifier");
}

TEST_F(Compiling, RefusesWhatIsNoKernelYet) {
    EXPECT_EQ(errorOf(""), "kernel.comp:1:1: error: is empty");
    EXPECT_EQ(errorOf("// only\n/* comments */\n"), "kernel.comp:1:1: error: is empty");
    EXPECT_NE(errorOf("layout(local_size_x = 64) in;\nvoid main() {}\n").find("#version 450"), std::string::npos);
    EXPECT_NE(errorOf("#version 330\nvoid main() {}\n").find("\"330\""), std::string::npos);
    EXPECT_NE(errorOf(kHead).find("Missing entry point"), std::string::npos);
    EXPECT_TRUE(compile("/* told first */ # version  460 core // so\nlayout(local_size_x = 1) in;\nvoid main() {}\n").good());
}

TEST_F(Compiling, EndsWhereFilesIncludeThemselves) {
    write("loop.glsl", "#include \"loop.glsl\"\n");
    const CompiledKernel made = compile(kHead + "#include \"loop.glsl\"\nvoid main() {}\n");
    EXPECT_FALSE(made.good());
    EXPECT_NE(textOf(made.diagnostics).find("too deep"), std::string::npos) << textOf(made.diagnostics);
}

TEST_F(Compiling, RefusesFilesThatAreGoneOrNoKernels) {
    EXPECT_NE(textOf(compileGlsl({"x", folder() / "x.comp", {}}, {}).diagnostics).find("gone"), std::string::npos);
    write("x.glsl", kHead);
    EXPECT_NE(textOf(compileGlsl({"x", folder() / "x.glsl", {}}, {}).diagnostics).find(".comp"), std::string::npos);
}

TEST_F(Compiling, RefusesWordsThatVulkanDoesNotTake) {
    // A workgroup's barrier in what only some of its lanes run is sound GLSL; a block without a binding is not.
    EXPECT_NE(errorOf(kHead + "buffer B { uint b[]; };\nvoid main() { b[0] = 1u; }\n").find("inding"), std::string::npos);
}
