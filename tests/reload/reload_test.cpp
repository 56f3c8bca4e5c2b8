#include "tests/engine/test_device.h"
#include "tests/reload/following.h"
#include "tests/reload/hostile_sources.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace engine_test;
using namespace reload_test;

namespace {

// Tests of this program see a pipeline go with the last that uses it.
[[maybe_unused]] const bool kPipelinesAreApart = (engine_test::keepPipelinesApart(), true);

// The kernel `increment` of the engine's tests, in a folder where it is edited while it runs.
class Reload : public SourceFolder {
protected:
    void SetUp() override {
        SourceFolder::SetUp();
        const fs::path root = BRITTLE_SOURCE_DIR;
        fs::copy(root / "tests/engine", folder(), fs::copy_options::recursive);
        fs::create_directories(folder() / "lib");
        fs::copy(root / "shaders-spirv/lib/dispatch.glsl", folder() / "lib");
        fs::copy(root / "shaders-spirv/shared", folder() / "shared", fs::copy_options::recursive);
        source_ = read("increment.comp");
        library_.emplace(device(), shaders::engineTestKernels());
        auto kernel = library_->get("increment");
        ASSERT_TRUE(kernel) << kernel.error().message;
        increment_ = *kernel;
        words_ = upload(device(), std::vector<uint32_t>(100, 0));
        follow();
    }
    void TearDown() override {
        following_.reset();
        SourceFolder::TearDown();
    }
    void follow() {
        auto started = ShaderReloader::start(device(), {.folder = folder(), .modules = shaders::engineTestKernels()});
        ASSERT_TRUE(started) << started.error().message;
        following_.emplace(std::move(*started));
        (*following_)->attach(*library_);
        following_->next(Kind::Checked); // all that does not run; what does comes before
    }

    void stopFollowing() { following_.reset(); }

    Following& reloader() { return *following_; }
    KernelLibrary& library() { return *library_; }
    const Kernel& increment() const { return *increment_; }
    const std::string& source() const { return source_; }

    // What the kernel adds now.
    uint32_t added() {
        const uint32_t before = wordsOf(words_)[50];
        Commands commands(device());
        EXPECT_TRUE(commands.begin());
        commands.dispatch(*increment_, 100, NoPush{}, {words_});
        finish(commands);
        return wordsOf(words_)[50] - before;
    }
    std::string adding(const std::string& number) const { return replaced(source_, "+= 1u", "+= " + number); }
    void save(const std::string& text) const { write("increment.comp", text); }

    // Refused as it should be, and the kernel runs on as it was.
    ReloadEvent expectRefused(const std::string& reason) {
        ReloadEvent event = reloader().next(Kind::Refused, "increment");
        EXPECT_NE(textOf(event.diagnostics).find(reason), std::string::npos) << textOf(event.diagnostics);
        EXPECT_NE(textOf(event.diagnostics).find(folder().string()), std::string::npos);
        EXPECT_EQ(added(), 1u);
        EXPECT_EQ(reloader()->stateOf("increment"), KernelState::Refused);
        return event;
    }
    void expectMended() {
        save(adding("9u"));
        reloader().next(Kind::Reloaded, "increment");
        EXPECT_EQ(added(), 9u);
        EXPECT_EQ(reloader()->stateOf("increment"), KernelState::Ready);
    }

private:
    std::optional<KernelLibrary> library_;
    const Kernel* increment_ = nullptr;
    Buffer words_;
    std::string source_;
    std::optional<Following> following_;
};

// What runs under the validation layers, too.
class SmallReload : public Reload {};

} // namespace

TEST_F(SmallReload, TakesOverASoundEdit) {
    EXPECT_EQ(added(), 1u);
    save(adding("2u"));
    const ReloadEvent event = reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 2u);
    EXPECT_EQ(event.kernels, std::vector<std::string>{"increment"});
    EXPECT_TRUE(event.runs && !event.at_start);
    EXPECT_GT(event.compiling_ms, 0);
    RecordProperty("ms_from_save_to_active", static_cast<int>(event.since_save_ms));
}

TEST_F(Reload, ChangesNothingBeforeItIsAskedTo) {
    save(adding("2u"));
    for (int k = 0; k < 100; ++k) {
        EXPECT_EQ(added(), 1u);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 2u);
}

TEST_F(Reload, KeepsTheLastGoodOneOnASyntaxError) {
    save(replaced(source(), "uint i = flatIndex();", "uint i = flatIndex()"));
    const ReloadEvent event = expectRefused("increment.comp:11: error: syntax error");
    EXPECT_EQ(event.kernels, std::vector<std::string>{"increment"});
    expectMended();
}

TEST_F(Reload, KeepsTheLastGoodOneWhereAnIncludeIsMissingAndTakesItOnceItIsThere) {
    save(replaced(adding("more()"), "#include \"lib/dispatch.glsl\"",
                  "#include \"lib/dispatch.glsl\"\n#include \"lib/more.glsl\""));
    expectRefused("lib/more.glsl");
    write("lib/more.glsl", "uint more() { return 5u; }\n");
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 5u);
}

TEST_F(Reload, RefusesOtherPushConstants) {
    save(replaced(adding("step"), "void main", "layout(push_constant) uniform Push { uint step; };\nvoid main"));
    expectRefused("increment.comp:9:1: error: kernel \"increment\": push constants: `step` is uint at byte 0");
    expectMended();
}

TEST_F(Reload, RefusesANewBinding) {
    save(replaced(adding("more[0]"), "void main", "layout(binding = 1, std430) buffer More { uint more[]; };\nvoid main"));
    expectRefused("increment.comp:9:1: error: kernel \"increment\": binding 1 of set 0 (More) is new");
    expectMended();
}

TEST_F(Reload, KeepsTheLastGoodOneOfADeletedFile) {
    fs::remove(folder() / "increment.comp");
    expectRefused("gone");
    expectMended();
}

TEST_F(Reload, RefusesAHalfWrittenFileAndTakesTheWhole) {
    const std::string whole = adding("3u");
    save(whole.substr(0, whole.size() / 2));
    expectRefused("increment.comp");
    save("");
    expectRefused("is empty");
    save(whole);
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 3u);
}

TEST_F(Reload, KeepsTheLastGoodOneOfWhatTheCompilerDiesOf) {
    save(source() + replaced(replaced(sumOfTerms(200'000), "void main", "void never"), "b[0] =", "uint b[2]; b[0] ="));
    expectRefused("the compiler dies of it");
    expectMended();
}

// Also where the reason lies in a file that the compiler had not yet told of.
TEST_F(Reload, FindsWhatWasMendedInAFileThatTheCompilerDiedOf) {
    const std::string deadly =
        replaced(replaced(sumOfTerms(200'000), "void main", "void never"), "b[0] =", "uint b[2]; b[0] =");
    write("lib/deadly.glsl", deadly);
    save(replaced(adding("4u"), "#include \"lib/dispatch.glsl\"",
                  "#include \"lib/dispatch.glsl\"\n#include \"lib/deadly.glsl\""));
    expectRefused("the compiler dies of it");
    write("lib/deadly.glsl", "// mended\n");
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 4u);
}

TEST_F(Reload, LeavesOffWhatNobodyWantsAnyMore) {
    save(replaced(source(), "void main", replaced(doublingMacros(40), "void main", "void never") + "void main"));
    while (!reloader()->isAwaited())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    writeAtomically(folder() / "increment.comp", adding("3u"));
    for (const ReloadEvent& event : reloader().settle())
        EXPECT_NE(event.kind, Kind::Refused) << textOf(event.diagnostics);
    EXPECT_EQ(added(), 3u);
    save(replaced(source(), "void main", replaced(doublingMacros(40), "void main", "void never") + "void main"));
    while (!reloader()->isAwaited())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto begun = std::chrono::steady_clock::now();
    stopFollowing();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(5)) << "its end waits for no compiler";
}

// What the driver would make of it nobody knows.
TEST_F(Reload, RefusesWhatTheDeviceHasNoMemoryFor) {
    save(replaced(replaced(source(), "void main", "shared uint heap[100000];\nvoid main"), "words[i] += 1u;",
                  "heap[words[i]] = 1u, words[i] += heap[words[0]];"));
    expectRefused("\"heap\" alone 400000");
    expectMended();
}

TEST_F(Reload, DoesNotLookAtAFileThatIsBeingWritten) {
    const std::string whole = adding("4u");
    std::ofstream stream(folder() / "increment.comp", std::ios::trunc);
    for (size_t at = 0; at < whole.size(); at += 40) {
        stream << whole.substr(at, 40) << std::flush;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        reloader().swap();
        EXPECT_EQ(added(), 1u);
    }
    stream.close();
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 4u);
}

TEST_F(Reload, FollowsEditorsThatReplaceTheFile) {
    writeAtomically(folder() / "increment.comp", adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 2u);
    // Others move the old one away first.
    fs::rename(folder() / "increment.comp", folder() / "increment.comp~");
    save(adding("3u"));
    fs::remove(folder() / "increment.comp~");
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 3u);
}

TEST_F(Reload, EndsWithTheLastOfAHundredSavesInASecond) {
    uint32_t last = 1;
    const auto begun = std::chrono::steady_clock::now();
    for (uint32_t k = 1; k <= 100; ++k) {
        save(k % 7 == 0 ? "half of" : adding(std::to_string(k) + "u"));
        reloader().swap();
        const uint32_t now = added(); // the program never stops
        EXPECT_GE(now, last);         // and never goes back to what was there before
        last = now;
        std::this_thread::sleep_until(begun + std::chrono::milliseconds(10 * k));
    }
    while (added() != 100u && std::chrono::steady_clock::now() - begun < kPatience)
        reloader().swap();
    EXPECT_EQ(added(), 100u);
    EXPECT_EQ(reloader()->stateOf("increment"), KernelState::Ready);
}

TEST_F(Reload, WakesWhoeverWaitsForAnOutcome) {
    reloader().settle();
    const auto wakes = [&](std::chrono::milliseconds longest) {
        return reloader()->waitUntil(std::chrono::steady_clock::now() + longest);
    };
    EXPECT_FALSE(wakes(std::chrono::milliseconds(1)));
    EXPECT_FALSE(reloader()->isAwaited());
    save(adding("7u"));
    EXPECT_TRUE(wakes(kPatience));
    reloader().next(Kind::Reloaded, "increment");
    save("no kernel");
    EXPECT_TRUE(wakes(kPatience));
    reloader().next(Kind::Refused, "increment");
    EXPECT_EQ(added(), 7u);
}

TEST_F(Reload, SaysThatASaveChangedNothing) {
    save(source() + "// a remark\n");
    reloader().next(Kind::Unchanged, "increment");
    EXPECT_EQ(added(), 1u);
}

TEST_F(Reload, GoesBackToWhatWasBuilt) {
    save(adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    save(source());
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 1u);
}

TEST_F(Reload, TakesBackWhatNobodyHasTakenOver) {
    save(adding("2u"));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    save(source());
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    reloader().settle();
    EXPECT_EQ(added(), 1u);
}

TEST_F(Reload, ReloadsWhatIncludesAFile) {
    ASSERT_TRUE(library().get("add_index"));
    const std::string dispatch = read("lib/dispatch.glsl");
    write("lib/dispatch.glsl", replaced(dispatch, "* gl_WorkGroupSize.x + gl_LocalInvocationID.x)",
                                        "* gl_WorkGroupSize.x + gl_LocalInvocationID.x + 51u)"));
    const ReloadEvent event = reloader().next(Kind::Reloaded, "increment");
    EXPECT_NE(std::ranges::find(event.kernels, "add_index"), event.kernels.end());
    EXPECT_EQ(added(), 0u); // the 50th word has no lane any more
}

TEST_F(Reload, TakesAnEditOverAsAWholeOrNotAtAll) {
    ASSERT_TRUE(library().get("add_index"));
    const std::string other = read("add_index.comp");
    write("add_index.comp", replaced(other, "void main() {", "void main() {\n    nonsense;\n"));
    reloader().next(Kind::Refused, "add_index");
    write("lib/dispatch.glsl", replaced(read("lib/dispatch.glsl"), "#define flatIndex() (", "#define flatIndex() (51u + "));
    const ReloadEvent refused = reloader().next(Kind::Refused, "add_index");
    EXPECT_EQ(refused.kernels, std::vector<std::string>{"add_index"});
    EXPECT_NE(std::ranges::find(refused.waiting, "increment"), refused.waiting.end());
    EXPECT_EQ(added(), 1u);
    write("add_index.comp", other);
    const ReloadEvent taken = reloader().next(Kind::Reloaded, "increment");
    EXPECT_NE(std::ranges::find(taken.kernels, "add_index"), taken.kernels.end());
    EXPECT_EQ(added(), 0u);
}

TEST_F(Reload, LeavesOtherKernelsOutOfATrouble) {
    ASSERT_TRUE(library().get("add_index"));
    write("add_index.comp", "#version 450\nnonsense");
    reloader().next(Kind::Refused, "add_index");
    save(adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 2u);
}

TEST_F(SmallReload, SpecializesAsBefore) {
    const auto biased = library().get("add_index", {5u});
    ASSERT_TRUE(biased);
    const VkPipeline before = (*biased)->pipeline->handle();
    const auto constants = (*biased)->constants;
    write("add_index.comp", read("add_index.comp") + "\nuint neverCalled() { return 3u; }\nvoid nor() { neverCalled(); }\n");
    write("add_index.comp",
          replaced(read("add_index.comp"), "void main() {",
                   "void main() {\n    uint renamed = 1u; if (renamed == gl_NumWorkGroups.z + 5u) return;\n"));
    reloader().next(Kind::Reloaded, "add_index");
    EXPECT_NE((*biased)->pipeline->handle(), before);
    EXPECT_EQ((*biased)->constants.size(), constants.size());
    EXPECT_EQ(library().specializationsOf("add_index").size(), 1u);
}

TEST_F(SmallReload, KeepsAPipelineAsLongAsARecordingHasIt) {
    const std::weak_ptr<const Pipeline> old = increment().pipeline;
    const Buffer words = upload(device(), std::vector<uint32_t>(100, 0));
    Commands commands(device());
    ASSERT_TRUE(commands.begin(Commands::Reuse::Many));
    commands.dispatch(increment(), 100, NoPush{}, {words});
    ASSERT_TRUE(commands.submit());
    save(adding("2u"));
    reloader().next(Kind::Reloaded, "increment"); // maybe in flight still
    EXPECT_FALSE(old.expired());
    ASSERT_TRUE(commands.wait());
    ASSERT_TRUE(commands.submitAgain()); // recorded with the old one
    ASSERT_TRUE(commands.wait());
    EXPECT_EQ(wordsOf(words)[0], 2u);
    ASSERT_TRUE(commands.begin(Commands::Reuse::Many));
    EXPECT_TRUE(old.expired());
    commands.dispatch(increment(), 100, NoPush{}, {words});
    finish(commands);
    EXPECT_EQ(wordsOf(words)[0], 4u);
}

TEST_F(SmallReload, ServesLibrariesThatComeAndGo) {
    save(adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    KernelLibrary late(device(), shaders::engineTestKernels());
    reloader()->attach(late);
    const auto kernel = late.get("increment"); // asked for after it was attached
    ASSERT_TRUE(kernel);
    const auto run = [&] {
        const Buffer words = upload(device(), {0});
        Commands commands(device());
        EXPECT_TRUE(commands.begin());
        commands.dispatch(**kernel, 1, NoPush{}, {words});
        finish(commands);
        return wordsOf(words)[0];
    };
    EXPECT_EQ(run(), 2u);
    save(adding("3u"));
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(run(), 3u);
    EXPECT_EQ(added(), 3u);
    reloader()->detach(late);
    save(adding("4u"));
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(run(), 3u);
    EXPECT_EQ(added(), 4u);
}

TEST_F(Reload, FollowsLinksToOtherFolders) {
    const fs::path elsewhere = folder().string() + "_elsewhere";
    writeFile(elsewhere / "real.comp", source());
    fs::remove(folder() / "increment.comp");
    fs::create_symlink(elsewhere / "real.comp", folder() / "increment.comp");
    reloader().settle();
    writeFile(elsewhere / "real.comp", adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    EXPECT_EQ(added(), 2u);
    fs::remove_all(elsewhere);
}

TEST_F(Reload, ChecksWhatNobodyRuns) {
    write("count_once.comp", "#version 450\nnonsense");
    const ReloadEvent event = reloader().next(Kind::Refused, "count_once");
    EXPECT_FALSE(event.runs);
    write("count_once.comp", readFile(fs::path(BRITTLE_SOURCE_DIR) / "tests/engine/count_once.comp"));
    reloader().next(Kind::Checked, "count_once");
}

TEST_F(Reload, BeginsWithTheFolderAsItIs) {
    save(adding("2u"));
    reloader().next(Kind::Reloaded, "increment");
    follow(); // another one, and another library would begin at 1
    KernelLibrary fresh(device(), shaders::engineTestKernels());
    auto started = ShaderReloader::start(device(), {.folder = folder(), .modules = shaders::engineTestKernels()});
    ASSERT_TRUE(started);
    Following second(std::move(*started));
    ASSERT_TRUE(fresh.get("increment"));
    EXPECT_EQ(second->stateOf("increment"), KernelState::Unchecked);
    second->attach(fresh);
    const ReloadEvent event = second.next(Kind::Reloaded, "increment");
    EXPECT_TRUE(event.at_start);
}

TEST_F(SmallReload, WorksWithPooledDescriptors) {
    KernelLibrary pooled(pooledDevice(), shaders::engineTestKernels());
    const auto kernel = pooled.get("increment");
    ASSERT_TRUE(kernel);
    auto started = ShaderReloader::start(pooledDevice(), {.folder = folder(), .modules = shaders::engineTestKernels()});
    ASSERT_TRUE(started);
    Following second(std::move(*started));
    second->attach(pooled);
    second.next(Kind::Unchanged, "increment");
    save(adding("2u"));
    second.next(Kind::Reloaded, "increment");
    const Buffer words = upload(pooledDevice(), {0});
    Commands commands(pooledDevice());
    ASSERT_TRUE(commands.begin());
    commands.dispatch(**kernel, 1, NoPush{}, {words});
    finish(commands);
    EXPECT_EQ(wordsOf(words)[0], 2u);
}

TEST_F(Reload, RefusesFoldersThatHaveNoneOfTheKernels) {
    const auto startIn = [](const fs::path& where) { return ShaderReloader::start(device(), {.folder = where}); };
    const auto none = startIn(folder() / "shared"), nowhere = startIn(folder() / "nowhere");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("none of the kernels"), std::string::npos);
    EXPECT_FALSE(nowhere);
}
