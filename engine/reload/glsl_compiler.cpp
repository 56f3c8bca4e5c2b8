#include "engine/reload/glsl_compiler.h"

#include "engine/reload/include_finder.h"
#include "engine/reload/version_line.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <optional>

namespace engine {
namespace {

constexpr int kDefaultVersion = 110; // of a source that does not say, as glslangValidator has it
constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

// Once for the process, however many compile.
void startCompiler() {
    struct Process {
        Process() { glslang::InitializeProcess(); }
        ~Process() { glslang::FinalizeProcess(); }
    };
    static const Process kProcess;
}

std::optional<EShLanguage> stageOf(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".comp") return EShLangCompute;
    if (extension == ".vert") return EShLangVertex;
    if (extension == ".frag") return EShLangFragment;
    return std::nullopt;
}

std::string preambleOf(const KernelSource& source) {
    std::string preamble;
    for (std::string define : source.defines) {
        if (const size_t value = define.find('='); value != std::string::npos) define[value] = ' ';
        preamble += "#define " + define + "\n";
    }
    return preamble;
}

// A source and all that glslang wants to outlive its parsing.
class Parsing {
public:
    Parsing(const KernelSource& source, EShLanguage stage, std::string text)
        : text_(std::move(text)), name_(source.file.string()), preamble_(preambleOf(source)), shader_(stage) {
        const char* texts[] = {text_.c_str()};
        const char* names[] = {name_.c_str()};
        const int lengths[] = {static_cast<int>(text_.size())};
        std::ranges::copy(texts, texts_);
        std::ranges::copy(names, names_);
        std::ranges::copy(lengths, lengths_);
        shader_.setStringsWithLengthsAndNames(texts_, lengths_, names_, 1);
        shader_.setPreamble(preamble_.c_str());
        shader_.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
        shader_.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
        shader_.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    }
    glslang::TShader& shader() { return shader_; }

private:
    std::string text_, name_, preamble_;
    const char* texts_[1] = {};
    const char* names_[1] = {};
    int lengths_[1] = {};
    glslang::TShader shader_;
};

Diagnostic ofWhole(const KernelSource& source, std::string message) {
    return {Severity::Error, source.file.string(), 0, 0, std::move(message)};
}

// SPIR-V as glslang makes it; empty, with the reason, where it cannot.
std::vector<uint32_t> translate(const KernelSource& source, Parsing& parsing, IncludeFinder& includes,
                                std::vector<Diagnostic>& diagnostics) {
    glslang::TShader& shader = parsing.shader();
    const auto note = [&](const char* log) {
        const auto read = readCompilerLog(log, source.file.string());
        diagnostics.insert(diagnostics.end(), read.begin(), read.end());
    };
    const bool parsed = shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages, includes);
    note(shader.getInfoLog());
    if (!parsed) return {};
    glslang::TProgram program;
    program.addShader(&shader);
    const bool linked = program.link(kMessages);
    note(program.getInfoLog());
    if (!linked) return {};
    std::vector<uint32_t> words;
    glslang::SpvOptions options;
    glslang::GlslangToSpv(*program.getIntermediate(shader.getStage()), words, nullptr, &options);
    return words;
}

// What SPIRV-Tools says about a module is about it as a whole: it knows no lines.
spvtools::MessageConsumer into(const KernelSource& source, std::vector<Diagnostic>& diagnostics) {
    return [&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
        if (level <= SPV_MSG_ERROR) diagnostics.push_back(ofWhole(source, message));
    };
}

// As spirv-opt -O --preserve-bindings --preserve-spec-constants, then spirv-val --target-env vulkan1.1.
std::vector<uint32_t> finish(const KernelSource& source, const std::vector<uint32_t>& raw,
                             std::vector<Diagnostic>& diagnostics) {
    std::vector<uint32_t> words;
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_6);
    optimizer.SetMessageConsumer(into(source, diagnostics));
    optimizer.RegisterPerformancePasses();
    spvtools::OptimizerOptions options;
    options.set_preserve_bindings(true);
    options.set_preserve_spec_constants(true);
    options.set_run_validator(false); // what comes out is validated
    if (!optimizer.Run(raw.data(), raw.size(), &words, options)) return {};
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer(into(source, diagnostics));
    if (!tools.Validate(words)) return {};
    return words;
}

// What a kernel that was refused without a word is told.
void explain(const KernelSource& source, std::vector<Diagnostic>& diagnostics) {
    if (!hasErrors(diagnostics))
        diagnostics.push_back(ofWhole(source, "cannot be compiled, and the compiler does not say why"));
}

} // namespace

void prepareCompiler() {
    startCompiler();
    static const bool kIsPrepared = [] {
        const KernelSource nothing = {"nothing", "nothing.comp", {}};
        std::vector<Diagnostic> diagnostics;
        IncludeFinder includes(nothing.file, {});
        Parsing parsing(nothing, EShLangCompute, "#version 450\nvoid main() {}\n");
        const std::vector<uint32_t> raw = translate(nothing, parsing, includes, diagnostics);
        return !raw.empty() && !finish(nothing, raw, diagnostics).empty();
    }();
    static_cast<void>(kIsPrepared);
}

CompiledKernel compileGlsl(const KernelSource& source, const std::vector<std::filesystem::path>& include_folders) {
    startCompiler();
    CompiledKernel result;
    IncludeFinder includes(source.file, include_folders);
    const auto stage = stageOf(source.file);
    const auto text = readSource(source.file);
    if (!stage)
        result.diagnostics.push_back(ofWhole(source, "is no kernel; the name has to end in .comp, .vert or .frag"));
    else if (!text)
        result.diagnostics.push_back(ofWhole(source, "cannot be read: it is gone, or may not be"));
    else if (const auto trouble = versionTrouble(*text))
        result.diagnostics.push_back({Severity::Error, source.file.string(), 1, 1, *trouble});
    else {
        Parsing parsing(source, *stage, *text);
        const std::vector<uint32_t> raw = translate(source, parsing, includes, result.diagnostics);
        if (!raw.empty()) result.words = finish(source, raw, result.diagnostics);
    }
    if (!result.good()) explain(source, result.diagnostics);
    result.files = includes.files();
    return result;
}

std::string preprocessGlsl(const KernelSource& source, const std::vector<std::filesystem::path>& include_folders) {
    startCompiler();
    IncludeFinder includes(source.file, include_folders);
    const auto stage = stageOf(source.file);
    const auto text = readSource(source.file);
    if (!stage || !text || versionTrouble(*text)) return {};
    Parsing parsing(source, *stage, *text);
    std::string output;
    if (!parsing.shader().preprocess(GetDefaultResources(), kDefaultVersion, ENoProfile, false, false, kMessages, &output,
                                     includes))
        return {};
    return output;
}

} // namespace engine
