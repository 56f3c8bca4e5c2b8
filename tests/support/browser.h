// Headless Chromium, told what to do through its debugging pipe (the Chrome DevTools Protocol): no network, no driver program.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace support {

struct View {
    int width = 1280, height = 900;
    bool is_dark = false;
};

class Browser {
public:
    static std::string program(); // where it is; empty where there is none
    // Keeps what it keeps in the folder. Throws std::runtime_error where it does not answer; so do all of these.
    explicit Browser(const std::filesystem::path& folder);
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    // Of a file, and waits until it has loaded; `fragment` is what stands behind #.
    void open(const std::filesystem::path& page, const View& view = {}, const std::string& fragment = "");
    // The value of a JavaScript expression, as JSON.
    nlohmann::json evaluate(const std::string& expression);
    void press(const std::string& key); // "Tab", "ArrowRight"
    // The whole page as it is laid out, as a PNG file.
    std::string screenshot();

    // Since the page was opened: all that it has asked for, and what it has complained about.
    const std::vector<std::string>& requests() const { return requests_; }
    const std::vector<std::string>& complaints() const { return complaints_; }

private:
    nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
    nlohmann::json read();
    void hear(const nlohmann::json& event);
    void waitFor(const std::string& event);

    pid_t process_ = -1;
    int to_ = -1, from_ = -1;
    int last_call_ = 0;
    std::string session_, unread_;
    std::vector<std::string> requests_, complaints_, events_;
};

// Whose bytes were encoded so.
std::string fromBase64(const std::string& text);

} // namespace support
