#include "engine/reload/kernel_check.h"
#include "tests/reload/source_folder.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace reload_test;

namespace {

// A kernel that was built into a host, and another version of it.
class Interface : public SourceFolder {
protected:
    const std::string kSource = "#version 450\n"
                                "#extension GL_GOOGLE_include_directive : require\n"
                                "#include \"body.h\"\n"
                                "layout(local_size_x = 64) in;\n"
                                "layout(constant_id = 3) const uint kMode = 1u;\n"
                                "layout(binding = 0, std430) readonly buffer A { Body bodies[]; };\n"
                                "layout(binding = 1, std430)\n"
                                "    buffer B { uint sums[]; };\n"
                                "layout(push_constant) uniform Push { uint count; float factor; };\n"
                                "void main() { sums[0] = count + kMode + uint(bodies[0].place.x * factor); }\n";
    const std::string kBody = "struct Body {\n    vec4 place;\n    uvec2 ids;\n};\n";

    void SetUp() override {
        SourceFolder::SetUp();
        write("body.h", kBody);
        write("kernel.comp", kSource);
        built_ = compileGlsl(source(), {folder()});
        ASSERT_TRUE(built_.good()) << textOf(built_.diagnostics);
    }
    KernelSource source() const { return {"kernel", folder() / "kernel.comp", {}}; }

    // What is said of the kernel as it stands now, without the folder's name.
    std::string verdict() const {
        const shaders::Module host{"kernel", built_.words, "kernel.comp", ""};
        const CheckedKernel checked = checkKernel(source(), &host, {folder()});
        EXPECT_EQ(checked.good(), checked.diagnostics.empty());
        std::string text = textOf(checked.diagnostics);
        for (size_t at; (at = text.find(folder().string() + "/")) != std::string::npos;)
            text.erase(at, folder().string().size() + 1);
        return text;
    }
    std::string verdictOf(const std::string& what, const std::string& by) const {
        write("kernel.comp", replaced(kSource, what, by));
        return verdict();
    }
    static void expectAll(const std::string& text, std::initializer_list<std::string> parts) {
        for (const std::string& part : parts)
            EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in: " << text;
    }

private:
    CompiledKernel built_;
};

} // namespace

TEST_F(Interface, OfTheSameSourceIsTheSame) { EXPECT_EQ(verdict(), ""); }

TEST_F(Interface, DoesNotHangOnNamesOrOnWhatIsComputed) {
    EXPECT_EQ(verdictOf("sums[0] = count", "sums[1] = 2u * count"), "");
    EXPECT_EQ(verdictOf("buffer B { uint sums[]; };\n", "buffer Other { uint others[]; };\n#define sums others\n"), "");
}

TEST_F(Interface, MayLeaveWhatTheHostGivesUnused) {
    EXPECT_EQ(verdictOf("count + kMode + uint(bodies[0].place.x * factor)", "7u"), "");
}

TEST_F(Interface, RefusesABindingThatIsNew) {
    expectAll(
        verdictOf("void main() {", "layout(binding = 2, std430) buffer C { uint more[]; };\nvoid main() { more[0] = 1u; "),
        {"kernel.comp:10:1: error: ", "binding 2 of set 0 (C) is new"});
}

TEST_F(Interface, RefusesABindingThatIsGone) {
    write("kernel.comp", replaced(replaced(kSource, "layout(binding = 0, std430) readonly buffer A { Body bodies[]; };\n", ""),
                                  "uint(bodies[0].place.x * factor)", "uint(factor)"));
    expectAll(verdict(), {"kernel.comp:", "binding 0 of set 0 (A) is gone"});
}

TEST_F(Interface, RefusesABufferThatIsWrittenWhereTheHostHasItRead) {
    expectAll(verdictOf("readonly buffer A", "buffer A"), {"kernel.comp:6:1: error: ", "read and written now", "it is read"});
}

TEST_F(Interface, RefusesOtherElements) {
    expectAll(verdictOf("uint sums[]", "uvec2 pairs[]; };\n#define sums(k) pairs[k].x\n#if 0\n buffer D { uint x"),
              {"error: "});
    expectAll(verdictOf("buffer B { uint sums[]; };", "buffer B { float floats[]; };\nuint sums[1];"),
              {"kernel.comp:7:1: error: ", "`floats[]` is float", "the host has uint"});
}

TEST_F(Interface, SaysWhichStructHasOtherMembers) {
    write("body.h", replaced(kBody, "    uvec2 ids;", "    vec3 spin;\n    uvec2 ids;"));
    expectAll(verdict(), {"body.h:1:1: error: ", "kernel \"kernel\"", "binding 0", "48 bytes each", "32 bytes each"});
}

TEST_F(Interface, RefusesOtherPushConstants) {
    expectAll(verdictOf("float factor;", "float factor; uint more;"), {"kernel.comp:9:1: error: ", "`more` is uint at byte 8"});
    expectAll(verdictOf("uint count; float factor;", "float factor; uint count;"),
              {"push constants", "`factor` is float at byte 0"});
}

TEST_F(Interface, RefusesOtherConstants) {
    expectAll(verdictOf("constant_id = 3", "constant_id = 4"),
              {"kernel.comp:5:1: error: ", "constant_id 4 (kMode) is new", "constant_id 3 (kMode) is gone"});
}

TEST_F(Interface, RefusesWorkgroupsOfAnotherSize) {
    expectAll(verdictOf("local_size_x = 64", "local_size_x = 32"), {"kernel.comp:4:1: error: ", "32 lanes", "counts on 64"});
    expectAll(verdictOf("local_size_x = 64", "local_size_x = 64, local_size_x_id = 9"), {"kernel.comp:4:1: error: "});
}

TEST_F(Interface, IsFoundWhereMacrosDeclareIt) {
    write("kernel.comp",
          "#define WRITES(slot, name) layout(binding = slot, std430) writeonly buffer name##_block { uint name[]; }\n" +
              kSource);
    EXPECT_NE(verdict(), ""); // #version comes first
    write("kernel.comp",
          replaced(replaced(kSource, "void main() {", "WRITES(2, more);\nvoid main() { more[0] = 1u; "), "#include",
                   "#define WRITES(slot, name) layout(binding = slot, std430) writeonly buffer name##_block { uint name[]; "
                   "}\n#include"));
    expectAll(verdict(), {"kernel.comp:11:1: error: ", "binding 2 of set 0 (more_block) is new"});
}
