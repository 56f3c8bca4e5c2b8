#include "engine/reload/folder_watch.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <string_view>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

namespace engine {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t kTold =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
constexpr std::chrono::milliseconds kLookForLost{250};

// "No space left on device" is what the system calls too many watches.
std::string reasonOf(int error) {
    if (error == ENOSPC) return "the system watches no more folders; raise fs.inotify.max_user_watches";
    if (error == EMFILE || error == ENFILE) return "the system has no more notifications; raise fs.inotify.max_user_instances";
    return std::strerror(error);
}

// A file that is made by opening it is told once it is closed; a link is complete at once.
bool isLink(const fs::path& file) {
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(file, error))) return true;
    const auto links = fs::hard_link_count(file, error);
    return !error && links > 1;
}

} // namespace

struct FolderWatch::Event {
    int folder = -1;
    uint32_t mask = 0;
    std::string name;
    bool has(uint32_t bits) const { return (mask & bits) != 0; }
};

fs::path watchedName(const fs::path& file) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(file.parent_path().empty() ? "." : file.parent_path(), error);
    return (error ? file.parent_path() : folder) / file.filename();
}

Result<std::unique_ptr<FolderWatch>> FolderWatch::create() {
    const int notifications = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (notifications < 0) return Error{ErrorCode::BadInput, "files cannot be watched: " + reasonOf(errno)};
    const int wakeup = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (wakeup < 0) {
        close(notifications);
        return Error{ErrorCode::BadInput, "files cannot be watched: " + reasonOf(errno)};
    }
    return std::unique_ptr<FolderWatch>(new FolderWatch(notifications, wakeup));
}

FolderWatch::~FolderWatch() {
    close(notifications_);
    close(wakeup_);
}

Result<void> FolderWatch::addTree(const fs::path& root) {
    const std::lock_guard lock(mutex_);
    std::error_code error;
    const fs::path folder = fs::canonical(root, error);
    if (error || !fs::is_directory(folder, error)) return Error{ErrorCode::BadInput, root.string() + ": is no folder"};
    if (auto added = addTreeLocked(folder); !added) return added;
    roots_.insert(folder);
    return {};
}

Result<bool> FolderWatch::addFolder(const fs::path& folder) {
    const std::lock_guard lock(mutex_);
    std::error_code error;
    const fs::path found = fs::canonical(folder, error);
    if (error) return Error{ErrorCode::BadInput, folder.string() + ": is no folder"};
    return addLocked(found);
}

Result<bool> FolderWatch::addLocked(const fs::path& folder) {
    if (numbers_.contains(folder)) return false;
    const int number = inotify_add_watch(notifications_, folder.c_str(), kTold);
    if (number < 0) return Error{ErrorCode::BadInput, folder.string() + ": cannot be watched: " + reasonOf(errno)};
    folders_[number] = folder;
    numbers_[folder] = number;
    return true;
}

// The folder before what is in it: what is made meanwhile is told.
Result<void> FolderWatch::addTreeLocked(const fs::path& root) {
    if (auto added = addLocked(root); !added) return added.error();
    std::error_code error;
    for (fs::directory_iterator entry(root, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (!entry->is_directory(ignored) || entry->is_symlink(ignored)) continue;
        // One that has gone since is no trouble.
        if (auto added = addTreeLocked(entry->path()); !added && fs::exists(entry->path(), ignored)) return added;
    }
    return {};
}

FolderChanges FolderWatch::wait(std::chrono::milliseconds longest) {
    FolderChanges changes;
    const bool has_lost = !lost_.empty();
    if (poll(has_lost ? std::min(longest, kLookForLost) : longest)) readAll(changes);
    if (has_lost) findLost(changes);
    return changes;
}

void FolderWatch::wake() {
    const uint64_t one = 1;
    static_cast<void>(!write(wakeup_, &one, sizeof one));
}

bool FolderWatch::poll(std::chrono::milliseconds longest) {
    std::array<pollfd, 2> files = {pollfd{notifications_, POLLIN, 0}, pollfd{wakeup_, POLLIN, 0}};
    const int ready = ::poll(files.data(), files.size(), static_cast<int>(longest.count()));
    uint64_t count = 0;
    if (files[1].revents != 0) static_cast<void>(!read(wakeup_, &count, sizeof count));
    return ready > 0 && files[0].revents != 0;
}

void FolderWatch::readAll(FolderChanges& changes) {
    alignas(inotify_event) std::array<char, 16384> bytes;
    const std::lock_guard lock(mutex_);
    for (;;) {
        const ssize_t length = read(notifications_, bytes.data(), bytes.size());
        if (length <= 0) return;
        for (ssize_t at = 0; at < length;) {
            inotify_event head = {};
            std::memcpy(&head, bytes.data() + at, sizeof head);
            const char* name = bytes.data() + at + sizeof head;
            note({head.wd, head.mask, std::string(name, strnlen(name, head.len))}, changes);
            at += static_cast<ssize_t>(sizeof head + head.len);
        }
    }
}

void FolderWatch::note(const Event& event, FolderChanges& changes) {
    if (event.has(IN_Q_OVERFLOW)) {
        changes.everything = true;
        return;
    }
    const auto folder = folders_.find(event.folder);
    if (folder == folders_.end()) return;
    const fs::path where = folder->second, file = where / event.name;
    if (event.has(IN_IGNORED)) {
        numbers_.erase(where);
        folders_.erase(folder);
    } else if (event.has(IN_DELETE_SELF | IN_MOVE_SELF)) {
        lose(where, changes);
    } else if (event.has(IN_ISDIR)) {
        changes.everything = true;
        if (!event.has(IN_CREATE | IN_MOVED_TO)) return lose(file, changes);
        if (auto added = addTreeLocked(file); !added) changes.troubles.push_back(added.error().message);
    } else if (!event.has(IN_CREATE) || isLink(file)) {
        changes.files.insert(file);
    }
}

// All that was watched at and below a folder; the system goes on telling of what was moved, under a name that it has no more.
void FolderWatch::lose(const fs::path& folder, FolderChanges& changes) {
    const std::string below = folder.string() + "/";
    for (auto it = numbers_.begin(); it != numbers_.end();) {
        if (it->first != folder && !it->first.string().starts_with(below)) {
            ++it;
            continue;
        }
        inotify_rm_watch(notifications_, it->second);
        folders_.erase(it->second);
        it = numbers_.erase(it);
        changes.everything = true;
    }
    if (!roots_.contains(folder) || !lost_.insert(folder).second) return;
    changes.troubles.push_back(folder.string() + ": is gone; kernels stay as they are until it is back");
}

void FolderWatch::findLost(FolderChanges& changes) {
    const std::lock_guard lock(mutex_);
    std::erase_if(lost_, [&](const fs::path& root) {
        std::error_code error;
        if (!fs::is_directory(root, error) || !addTreeLocked(root)) return false;
        changes.everything = true;
        return true;
    });
}

} // namespace engine
