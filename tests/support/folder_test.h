// Tests that write files: each has a folder of its own, empty at first and gone in the end.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace support {

class FolderTest : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    const std::filesystem::path& folder() const { return folder_; }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
    static std::filesystem::path ownFolder() {
        const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
        return std::filesystem::path(testing::TempDir()) /
               (std::string("brittle_") + test.test_suite_name() + "_" + test.name());
    }
    const std::filesystem::path folder_ = ownFolder();
};

} // namespace support
