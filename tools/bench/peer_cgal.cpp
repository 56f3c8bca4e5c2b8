#include "tools/bench/peers.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace bench {
namespace {

// As peer_cgal_main.cpp prints it.
constexpr const char* kPeerFormat = "ms %lf fragments %u failures %u volume_error %lf";

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
    PeerShatter result;
    const int read =
        std::sscanf(output.c_str(), kPeerFormat, &result.ms, &result.fragments, &result.failures, &result.volume_error);
    if (read != 4) return std::nullopt;
    return result;
}

} // namespace bench
