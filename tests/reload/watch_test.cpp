#include "engine/reload/folder_watch.h"
#include "tests/reload/source_folder.h"

#include <gtest/gtest.h>

#include <thread>

using namespace engine;
using namespace reload_test;
using namespace std::chrono_literals;

namespace {

class Watching : public SourceFolder {
protected:
    void SetUp() override {
        SourceFolder::SetUp();
        write("old.glsl", "old");
        auto made = FolderWatch::create();
        ASSERT_TRUE(made) << made.error().message;
        watch_ = std::move(*made);
        ASSERT_TRUE(watch_->addTree(folder()));
    }
    FolderWatch& watch() { return *watch_; }

    // All that is told, until nothing is for a while.
    FolderChanges changes() {
        FolderChanges all;
        for (FolderChanges some = watch_->wait(2s); some.any(); some = watch_->wait(50ms)) {
            all.files.insert(some.files.begin(), some.files.end());
            all.troubles.insert(all.troubles.end(), some.troubles.begin(), some.troubles.end());
            all.everything = all.everything || some.everything;
        }
        return all;
    }
    std::set<fs::path> named(std::initializer_list<const char*> names) const {
        std::set<fs::path> files;
        for (const char* name : names)
            files.insert(watchedName(folder() / name));
        return files;
    }

private:
    std::unique_ptr<FolderWatch> watch_;
};

} // namespace

TEST_F(Watching, TellsWhatWasWrittenMovedAndDeleted) {
    write("old.glsl", "new");
    EXPECT_EQ(changes().files, named({"old.glsl"}));
    writeAtomically(folder() / "old.glsl", "newer");
    EXPECT_TRUE(changes().files.contains(*named({"old.glsl"}).begin()));
    fs::remove(folder() / "old.glsl");
    EXPECT_EQ(changes().files, named({"old.glsl"}));
    write("fresh.glsl", "fresh");
    EXPECT_EQ(changes().files, named({"fresh.glsl"}));
}

TEST_F(Watching, WaitsUntilAFileIsClosed) {
    std::ofstream stream(folder() / "old.glsl", std::ios::trunc);
    stream << "half of" << std::flush;
    EXPECT_FALSE(watch().wait(100ms).any());
    stream << " it";
    stream.close();
    EXPECT_EQ(changes().files, named({"old.glsl"}));
}

TEST_F(Watching, FollowsFoldersThatAreMadeLater) {
    fs::create_directories(folder() / "a/b");
    EXPECT_TRUE(changes().everything);
    write("a/b/deep.glsl", "deep");
    EXPECT_EQ(changes().files, named({"a/b/deep.glsl"}));
    fs::rename(folder() / "a", folder() / "c");
    EXPECT_TRUE(changes().everything);
    write("c/b/deep.glsl", "deeper");
    EXPECT_EQ(changes().files, named({"c/b/deep.glsl"}));
}

TEST_F(Watching, FindsAFolderAgainThatWasGone) {
    fs::remove_all(folder());
    const FolderChanges gone = changes();
    ASSERT_EQ(gone.troubles.size(), 1u);
    EXPECT_NE(gone.troubles[0].find("is gone"), std::string::npos);
    write("old.glsl", "back");
    EXPECT_TRUE(changes().everything);
    write("old.glsl", "again");
    EXPECT_TRUE(changes().files.contains(*named({"old.glsl"}).begin()));
}

TEST_F(Watching, TellsOfLinks) {
    write("target.glsl", "target");
    changes();
    fs::create_symlink("target.glsl", folder() / "link.glsl");
    EXPECT_EQ(changes().files, named({"link.glsl"}));
}

TEST_F(Watching, IsWokenByOthers) {
    std::jthread other([&] { watch().wake(); });
    EXPECT_FALSE(watch().wait(10min).any());
}

TEST_F(Watching, RefusesWhatIsNoFolder) {
    EXPECT_FALSE(watch().addTree(folder() / "old.glsl"));
    EXPECT_FALSE(watch().addTree(folder() / "nowhere"));
}
