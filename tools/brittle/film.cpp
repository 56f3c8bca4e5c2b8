#include "tools/brittle/film.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace cli {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

constexpr const char* kProgram = "ffmpeg";

Error noFfmpeg() {
    return {ErrorCode::BadInput, "a film is made by ffmpeg, which is not in the PATH; install the package ffmpeg, "
                                 "or write .glb or .png"};
}

// A film that stops reading must end in an error of ours, not in the end of this process.
class NoPipeSignal {
public:
    NoPipeSignal() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
    ~NoPipeSignal() { std::signal(SIGPIPE, before_); }
    NoPipeSignal(const NoPipeSignal&) = delete;
    NoPipeSignal& operator=(const NoPipeSignal&) = delete;

private:
    void (*before_)(int);
};

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    void close() {
        if (number_ >= 0) ::close(number_);
        number_ = -1;
    }

private:
    int number_;
};

std::vector<std::string> argumentsFor(const std::string& path, uint32_t width, uint32_t height, double fps) {
    std::array<char, 32> rate, size;
    std::snprintf(rate.data(), rate.size(), "%.9g", fps);
    std::snprintf(size.data(), size.size(), "%ux%u", width, height);
    // Sides of films are even: an odd one gets a row or column more. "file:" keeps a name from being taken for a protocol.
    return {kProgram,      "-v",
            "error",       "-nostdin",
            "-y",          "-f",
            "rawvideo",    "-pixel_format",
            "rgb24",       "-video_size",
            size.data(),   "-framerate",
            rate.data(),   "-i",
            "pipe:0",      "-an",
            "-vf",         "pad=ceil(iw/2)*2:ceil(ih/2)*2",
            "-c:v",        "libx264",
            "-crf",        "18",
            "-pix_fmt",    "yuv420p",
            "-movflags",   "+faststart",
            "-f",          "mp4",
            "file:" + path};
}

// With these as its standard input and error; nothing on its standard output.
Result<pid_t> spawn(std::vector<std::string> arguments, int input, int errors) {
    std::vector<char*> words(arguments.size() + 1, nullptr); // the last one ends them
    std::ranges::transform(arguments, words.begin(), [](std::string& argument) { return argument.data(); });
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
    posix_spawnattr_t settings;
    posix_spawnattr_init(&settings);
    sigset_t usual;
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    posix_spawnattr_setsigdefault(&settings, &usual);
    sigset_t none; // what the parent waits for in a thread of its own
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&settings, &none);
    posix_spawnattr_setflags(&settings, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    pid_t process = 0;
    const int failed = posix_spawnp(&process, kProgram, &files, &settings, words.data(), environ);
    posix_spawnattr_destroy(&settings);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) return noFfmpeg();
    return process;
}

class PipedFilm : public Film {
public:
    PipedFilm(int input, int errors) : input_(input), errors_(errors) {}
    ~PipedFilm() override {
        if (!process_) return;
        kill(*process_, SIGKILL);
        waitpid(*process_, nullptr, 0);
    }
    void belongTo(pid_t process) { process_ = process; }

    Result<void> add(const engine::Picture& picture) override {
        rows_.clear();
        for (size_t k = 0; k < picture.pixels.size(); k += 4)
            rows_.insert(rows_.end(), &picture.pixels[k], &picture.pixels[k] + 3);
        for (size_t done = 0; done < rows_.size();) {
            const ssize_t written = write(input_.number(), rows_.data() + done, rows_.size() - done);
            if (written < 0 && errno != EINTR) return stopped();
            if (written > 0) done += static_cast<size_t>(written);
        }
        return {};
    }

    Result<void> finish() override {
        if (!process_) return Error{ErrorCode::Internal, "the film has ended already"};
        input_.close();
        int status = 0;
        while (waitpid(*process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_.reset();
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
        return Error{ErrorCode::BadInput, "ffmpeg could not make the film: " + complaint(status)};
    }

private:
    // It reads no more: its own words say why, if it has any.
    Result<void> stopped() {
        if (auto ended = finish(); !ended) return ended;
        return Error{ErrorCode::BadInput, "ffmpeg ended before the film did"};
    }
    std::string complaint(int status) const {
        std::array<char, 400> text = {};
        const ssize_t length = pread(errors_.number(), text.data(), text.size() - 1, 0);
        if (length > 0) return std::string(text.data(), static_cast<size_t>(length));
        return WIFSIGNALED(status) ? "it was ended by signal " + std::to_string(WTERMSIG(status))
                                   : "it ended with status " + std::to_string(WEXITSTATUS(status));
    }

    NoPipeSignal no_signal_;
    Descriptor input_, errors_; // of ffmpeg
    std::optional<pid_t> process_;
    std::vector<uint8_t> rows_;
};

} // namespace

Result<void> Film::isPossible() {
    const char* path = std::getenv("PATH");
    const std::string folders = path != nullptr ? path : "";
    for (size_t from = 0; from <= folders.size();) {
        const size_t to = std::min(folders.find(':', from), folders.size());
        const std::string folder = folders.substr(from, to - from);
        if (!folder.empty() && access((folder + "/" + kProgram).c_str(), X_OK) == 0) return {};
        from = to + 1;
    }
    return noFfmpeg();
}

Result<std::unique_ptr<Film>> Film::start(const std::string& path, uint32_t width, uint32_t height, double fps) {
    int ends[2];
    const int errors = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (errors < 0 || pipe2(ends, O_CLOEXEC) != 0)
        return Error{ErrorCode::Internal, std::string("no pipe to ffmpeg: ") + std::strerror(errno)};
    const Descriptor read_end(ends[0]);
    auto film = std::make_unique<PipedFilm>(ends[1], errors);
    const auto process = spawn(argumentsFor(path, width, height, fps), read_end.number(), errors);
    if (!process) return process.error();
    film->belongTo(*process);
    return std::unique_ptr<Film>(std::move(film));
}

} // namespace cli
