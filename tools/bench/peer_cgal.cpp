#include "tools/bench/peers.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace bench {
namespace {

// What the command prints; empty where it fails.
std::string outputOf(const std::string& command) {
    struct Close {
        void operator()(FILE* pipe) const { pclose(pipe); }
    };
    const std::unique_ptr<FILE, Close> pipe(popen(command.c_str(), "r"));
    std::string output;
    std::array<char, 256> part;
    while (pipe && std::fgets(part.data(), static_cast<int>(part.size()), pipe.get()))
        output += part.data();
    return output;
}

} // namespace

std::optional<PeerShatter> cgalShatter(uint32_t level, uint32_t site_count, uint64_t seed) {
    std::error_code unreadable;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unreadable);
    const std::filesystem::path peer = self.parent_path() / "brittle_peer_cgal";
    if (unreadable || !std::filesystem::exists(peer)) return std::nullopt;
    const std::string output = outputOf('"' + peer.string() + "\" " + std::to_string(level) + " " + std::to_string(site_count) +
                                        " " + std::to_string(seed));
    const nlohmann::json json = nlohmann::json::parse(output, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    return PeerShatter{json.value("ms", 0.0), json.value("fragments", 0u), json.value("failures", 0u),
                       json.value("volume_error", 0.0)};
}

} // namespace bench
