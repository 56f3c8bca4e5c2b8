// The commands of README that break or examine a model work as they are written.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

class ReadmeCommands : public support::FolderTest {
protected:
    // `SUBCOMMAND ...` of each line that runs the program.
    static std::vector<std::vector<std::string>> commands() {
        constexpr const char* kProgram = "build/release/bin/brittle";
        std::ifstream readme(std::filesystem::path(BRITTLE_SOURCE_DIR) / "README.md");
        std::vector<std::vector<std::string>> found;
        for (std::string line; std::getline(readme, line);) {
            std::istringstream text(line);
            std::vector<std::string> words;
            for (std::string word; text >> word && word != "#";)
                words.push_back(word);
            if (!words.empty() && words[0] == kProgram) found.emplace_back(words.begin() + 1, words.end());
        }
        return found;
    }

    // Moves output files into the test's folder.
    std::vector<std::string> inOwnFolder(std::vector<std::string> words) const {
        for (size_t k = 1; k < words.size(); ++k)
            if (words[k - 1] == "-o" || words[k - 1] == "--picture") words[k] = path(words[k]);
        return words;
    }
};

TEST_F(ReadmeCommands, ThatShatterOrExamineWork) {
    size_t count = 0;
    for (const std::vector<std::string>& words : commands()) {
        if (words.empty() || (words[0] != "shatter" && words[0] != "doctor")) continue;
        const support::Outcome run = support::runProgram("brittle", inOwnFolder(words));
        std::string line;
        for (const std::string& word : words)
            line += ' ' + word;
        EXPECT_EQ(run.exit_code, 0) << "brittle" << line << "\n" << run.err;
        ++count;
    }
    EXPECT_GE(count, 10u);
}

} // namespace
