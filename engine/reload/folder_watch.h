// Tells which files have changed under folders, by the system's own notifications (inotify): written and closed, moved in or
// away, linked or deleted. A file that is still being written is not told before it is closed.
#pragma once

#include "engine/result.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace engine {

// As a change of it is told: the folder without links in its path, and the name in it.
std::filesystem::path watchedName(const std::filesystem::path& file);

struct FolderChanges {
    std::set<std::filesystem::path> files; // watchedName()
    bool everything = false;               // folders came or went, or more changed than the system could tell: look at all
    std::vector<std::string> troubles;     // for a person to read
    bool any() const { return everything || !files.empty() || !troubles.empty(); }
};

class FolderWatch {
public:
    static Result<std::unique_ptr<FolderWatch>> create();
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    // A folder and all below it, also those that are made later. Where the folder itself goes away it is waited for. Safe from
    // any thread, like addFolder. Errors: BadInput, where it is none or the system watches no more.
    Result<void> addTree(const std::filesystem::path& root);
    // A folder alone; whether it was not watched before.
    Result<bool> addFolder(const std::filesystem::path& folder);

    // Waits for a change, for wake(), or for so long. From one thread.
    FolderChanges wait(std::chrono::milliseconds longest);
    void wake();

private:
    FolderWatch(int notifications, int wakeup) : notifications_(notifications), wakeup_(wakeup) {}
    struct Event; // of the system, read
    bool poll(std::chrono::milliseconds longest);
    void readAll(FolderChanges& changes);
    void note(const Event& event, FolderChanges& changes);
    void lose(const std::filesystem::path& folder, FolderChanges& changes);
    void findLost(FolderChanges& changes);
    Result<bool> addLocked(const std::filesystem::path& folder);
    Result<void> addTreeLocked(const std::filesystem::path& root);

    int notifications_ = -1, wakeup_ = -1;
    std::mutex mutex_;
    std::map<int, std::filesystem::path> folders_; // by the system's number
    std::map<std::filesystem::path, int> numbers_;
    std::set<std::filesystem::path> roots_, lost_; // roots that are gone for now
};

} // namespace engine
