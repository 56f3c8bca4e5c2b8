#include "tests/support/browser.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace support {
namespace {

using nlohmann::json;

constexpr int kPatience = 120'000;     // ms: machines may be busy
constexpr int kReads = 3, kWrites = 4; // where the browser looks for its pipe

// Never returns.
void runBrowser(const std::string& program, const std::string& folder, int reads, int writes) {
    setpgid(0, 0); // a group for the browser and its children, so that all of them can be ended
    // Out of the way first: either may be where the other has to go.
    const int in = fcntl(reads, F_DUPFD, 10), out = fcntl(writes, F_DUPFD, 10);
    dup2(in, kReads);
    dup2(out, kWrites);
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int standard : {0, 1, 2})
        dup2(nowhere, standard);
    const std::string profile = "--user-data-dir=" + folder;
    execl(program.c_str(), program.c_str(), "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
          "--disable-background-networking", "--disable-component-update", "--disable-default-apps", "--disable-extensions",
          "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars", "--remote-debugging-pipe", profile.c_str(),
          "about:blank", nullptr);
    _exit(127);
}

// The browser's children outlive it for a moment and write into its folder, which the caller is about to remove.
void endGroup(pid_t group) {
    constexpr int kTries = 200;
    for (int k = 0; k < kTries && kill(-group, SIGKILL) == 0; ++k)
        usleep(10'000);
}

} // namespace

std::string fromBase64(const std::string& text) {
    const auto digit = [](char c) -> uint32_t {
        if (c >= 'A' && c <= 'Z') return static_cast<uint32_t>(c - 'A');
        if (c >= 'a' && c <= 'z') return static_cast<uint32_t>(c - 'a' + 26);
        if (c >= '0' && c <= '9') return static_cast<uint32_t>(c - '0' + 52);
        return c == '+' ? 62 : 63;
    };
    std::string bytes;
    uint32_t word = 0, bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        word = word << 6 | digit(c);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(word >> bits & 255);
    }
    return bytes;
}

std::string Browser::program() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (std::string program = folder + "/chromium"; access(program.c_str(), X_OK) == 0) return program;
    return "";
}

Browser::Browser(const std::filesystem::path& folder) {
    std::array<int, 2> there{}, back{};
    if (pipe(there.data()) != 0 || pipe(back.data()) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ == 0) runBrowser(program(), folder.string(), there[0], back[1]);
    close(there[0]);
    close(back[1]);
    to_ = there[1];
    from_ = back[0];
    std::signal(SIGPIPE, SIG_IGN); // a browser that is gone is an error, not the end
    const json target = call("Target.createTarget", {{"url", "about:blank"}});
    session_ = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
    for (const char* domain : {"Page", "Runtime", "Network", "Log"})
        call(std::string(domain) + ".enable");
}

Browser::~Browser() {
    if (to_ >= 0) close(to_);
    if (from_ >= 0) close(from_);
    if (process_ <= 0) return;
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    endGroup(process_);
}

// One message, which ends with a zero.
json Browser::read() {
    size_t end = 0;
    while ((end = unread_.find('\0')) == std::string::npos) {
        pollfd ready{from_, POLLIN, 0};
        std::array<char, 65536> part{};
        if (poll(&ready, 1, kPatience) != 1) throw std::runtime_error("the browser does not answer");
        const ssize_t size = ::read(from_, part.data(), part.size());
        if (size <= 0) throw std::runtime_error("the browser is gone");
        unread_.append(part.data(), static_cast<size_t>(size));
    }
    json message = json::parse(unread_.substr(0, end));
    unread_.erase(0, end + 1);
    return message;
}

void Browser::hear(const json& event) {
    const std::string method = event.value("method", "");
    events_.push_back(method);
    const json& parameters = event.value("params", json::object());
    if (method == "Network.requestWillBeSent") requests_.push_back(parameters["request"]["url"]);
    if (method == "Runtime.exceptionThrown") complaints_.push_back(parameters["exceptionDetails"].dump());
    if (method == "Log.entryAdded") complaints_.push_back(parameters["entry"].dump());
    if (method == "Runtime.consoleAPICalled" && parameters["type"] == "error") complaints_.push_back(parameters.dump());
}

json Browser::call(const std::string& method, const json& parameters) {
    json message = {{"id", ++last_call_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) message["sessionId"] = session_;
    const std::string text = message.dump() + '\0';
    for (size_t sent = 0; sent < text.size();) {
        const ssize_t size = write(to_, text.data() + sent, text.size() - sent);
        if (size <= 0) throw std::runtime_error("the browser is gone");
        sent += static_cast<size_t>(size);
    }
    for (;;) {
        json answer = read();
        if (answer.value("id", 0) != last_call_) {
            hear(answer);
            continue;
        }
        if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
        return answer["result"];
    }
}

void Browser::waitFor(const std::string& event) {
    while (std::ranges::find(events_, event) == events_.end())
        hear(read());
}

void Browser::open(const std::filesystem::path& page, const View& view, const std::string& fragment) {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", view.width}, {"height", view.height}, {"deviceScaleFactor", 1}, {"mobile", false}});
    const json feature = {{"name", "prefers-color-scheme"}, {"value", view.is_dark ? "dark" : "light"}};
    call("Emulation.setEmulatedMedia", {{"features", json::array({feature})}});
    call("Page.navigate", {{"url", "about:blank"}}); // another fragment of the same page is no new one
    requests_.clear();
    complaints_.clear();
    events_.clear();
    const std::string url = "file://" + std::filesystem::absolute(page).string();
    call("Page.navigate", {{"url", fragment.empty() ? url : url + "#" + fragment}});
    waitFor("Page.loadEventFired");
    for (int k = 0; k < 1000 && evaluate("document.readyState") != "complete"; ++k)
        usleep(10'000);
}

json Browser::evaluate(const std::string& expression) {
    const json answer = call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
    if (answer.contains("exceptionDetails")) throw std::runtime_error(answer["exceptionDetails"].dump());
    return answer["result"].value("value", json());
}

void Browser::press(const std::string& key) {
    const int code = key == "Tab" ? 9 : (key == "ArrowRight" ? 39 : 0);
    for (const char* type : {"rawKeyDown", "keyUp"})
        call("Input.dispatchKeyEvent", {{"type", type}, {"key", key}, {"code", key}, {"windowsVirtualKeyCode", code}});
}

std::string Browser::screenshot() {
    const json size = call("Page.getLayoutMetrics")["cssContentSize"];
    const json clip = {{"x", 0}, {"y", 0}, {"width", size["width"]}, {"height", size["height"]}, {"scale", 1}};
    return fromBase64(
        call("Page.captureScreenshot", {{"format", "png"}, {"captureBeyondViewport", true}, {"clip", clip}})["data"]);
}

} // namespace support
