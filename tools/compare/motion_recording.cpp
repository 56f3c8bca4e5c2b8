#include "tools/compare/motion_recording.h"

#include "modules/brittle/mesh/byte_hash.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>

namespace compare {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;
using nlohmann::json;

// A file is a CBOR map: the format, the content as CBOR bytes, and their FNV-1a hash.
constexpr const char* kFormat = "brittle motion 2";
constexpr std::string_view kAnyFormat = "brittle motion ";

template <class T>
json blobOf(const std::vector<T>& list) {
    const auto bytes = std::as_bytes(std::span(list));
    json::binary_t::container_type copy(bytes.size());
    if (!copy.empty()) std::memcpy(copy.data(), bytes.data(), bytes.size());
    return json::binary(std::move(copy));
}

// Throws what json throws if it is no blob.
template <class T>
std::vector<T> listOf(const json& blob) {
    const json::binary_t& bytes = blob.get_binary();
    std::vector<T> list(bytes.size() / sizeof(T));
    if (!list.empty()) std::memcpy(list.data(), bytes.data(), list.size() * sizeof(T));
    return list;
}

json toJson(const brittle::RecordedBuffer& buffer) {
    json object = {{"slot", buffer.slot},
                   {"buffer", buffer.buffer},
                   {"bytes", buffer.bytes},
                   {"hashes", {buffer.hashes.whole, buffer.hashes.changes, buffer.hashes.unordered}},
                   {"stable", buffer.is_stable}};
    if (buffer.has_words) object["words"] = {blobOf(buffer.places), blobOf(buffer.before), blobOf(buffer.after)};
    return object;
}

brittle::RecordedBuffer bufferOf(const json& object) {
    const json& hashes = object.at("hashes");
    brittle::RecordedBuffer buffer = {object.at("slot"),
                                      object.at("buffer"),
                                      object.at("bytes"),
                                      {hashes.at(0), hashes.at(1), hashes.at(2)},
                                      object.at("stable")};
    if (!object.contains("words")) return buffer;
    const json& words = object.at("words");
    buffer.has_words = true;
    buffer.places = listOf<uint32_t>(words.at(0));
    buffer.before = listOf<uint32_t>(words.at(1));
    buffer.after = listOf<uint32_t>(words.at(2));
    buffer.before.resize(buffer.places.size());
    buffer.after.resize(buffer.places.size());
    return buffer;
}

json toJson(const brittle::RecordedStep& step) {
    json passes = json::array();
    for (const brittle::RecordedPass& pass : step.passes) {
        json written = json::array();
        for (const brittle::RecordedBuffer& buffer : pass.written)
            written.push_back(toJson(buffer));
        passes.push_back({{"key", pass.key}, {"stage", pass.stage}, {"kernel", pass.kernel}, {"written", written}});
    }
    return {{"step", step.step}, {"state", blobOf(step.state)}, {"passes", passes}};
}

brittle::RecordedStep stepOf(const json& object) {
    brittle::RecordedStep step = {object.at("step"), listOf<std::byte>(object.at("state")), {}};
    for (const json& pass : object.at("passes")) {
        brittle::RecordedPass recorded = {pass.at("key"), pass.at("stage"), pass.at("kernel"), {}};
        for (const json& buffer : pass.at("written"))
            recorded.written.push_back(bufferOf(buffer));
        step.passes.push_back(std::move(recorded));
    }
    return step;
}

MotionRecording recordingOf(const json& object) {
    MotionRecording recording = {object.at("scene"),
                                 object.at("device"),
                                 object.at("driver"),
                                 object.at("scene_hash"),
                                 object.at("group_size"),
                                 object.at("dt"),
                                 {},
                                 {}};
    for (const json& bodies : object.at("steps"))
        recording.steps.push_back(listOf<gpu::BodyState>(bodies));
    if (object.contains("passes")) recording.passes = stepOf(object.at("passes"));
    return recording;
}

uint64_t hashOf(std::span<const uint8_t> bytes) {
    brittle::ByteHash hash;
    hash.add(std::as_bytes(bytes));
    return hash.value();
}

// Returns what is wrong with a recording, or an empty text.
std::string problemOf(const MotionRecording& recording) {
    if (!std::isfinite(recording.dt) || recording.dt <= 0) return "its step has no length";
    if (recording.steps.empty()) return "it has no steps";
    for (const auto& bodies : recording.steps)
        if (bodies.empty()) return "it has a step without bodies";
    if (!recording.passes) return "";
    if (recording.passes->step < 1 || recording.passes->step > recording.steps.size())
        return "it has passes of step " + std::to_string(recording.passes->step) + ", and only " +
               std::to_string(recording.steps.size()) + " steps";
    if (recording.passes->passes.empty() || recording.passes->state.empty()) return "it has a recorded step without passes";
    return "";
}

Error refused(const std::filesystem::path& path, const std::string& why) {
    return {ErrorCode::BadInput, path.string() + ": " + why};
}

// Throws what json throws if it is no recording.
Result<MotionRecording> openRecording(const std::filesystem::path& path, const json& file) {
    const std::string format = file.at("format");
    if (format.starts_with(kAnyFormat) && format != kFormat)
        return refused(path, "was recorded by another version of Brittle; record the motion again");
    if (format != kFormat) return refused(path, "is no recorded motion; give a file that --record has written");
    const std::vector<uint8_t>& content = file.at("content").get_binary();
    if (hashOf(content) != file.at("hash").get<uint64_t>())
        return refused(path, "is a damaged recording: its checksum is wrong; copy or record it again");
    MotionRecording recording = recordingOf(json::from_cbor(content));
    const std::string problem = problemOf(recording);
    if (!problem.empty()) return refused(path, "cannot be compared with: " + problem + "; record the motion again");
    return recording;
}

// A file cut short is no whole CBOR any more, but still begins like one of ours.
bool beginsLikeARecording(const std::vector<uint8_t>& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 256));
    return text.find(kAnyFormat) != std::string_view::npos || text.find("content") != std::string_view::npos;
}

} // namespace

Result<void> writeRecording(brittle::OutputFile& file, const MotionRecording& recording) {
    json object = {{"scene", recording.scene},   {"scene_hash", recording.scene_hash}, {"group_size", recording.group_size},
                   {"device", recording.device}, {"driver", recording.driver},         {"dt", recording.dt},
                   {"steps", json::array()}};
    for (const auto& bodies : recording.steps)
        object["steps"].push_back(blobOf(bodies));
    if (recording.passes) object["passes"] = toJson(*recording.passes);
    std::vector<uint8_t> content = json::to_cbor(object);
    const uint64_t hash = hashOf(content);
    const std::vector<uint8_t> bytes =
        json::to_cbor({{"format", kFormat}, {"hash", hash}, {"content", json::binary(std::move(content))}});
    if (auto written = file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); !written) return written;
    return file.commit();
}

Result<MotionRecording> readRecording(const std::filesystem::path& path) {
    std::error_code unknown;
    if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))
        return refused(path, "is a folder, a pipe or a device; give a file that --record has written");
    std::ifstream file(path, std::ios::binary);
    if (!file) return refused(path, "cannot be read; give a file that --record has written");
    const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    try {
        return openRecording(path, json::from_cbor(bytes));
    } catch (const json::exception&) { // said below
    }
    if (beginsLikeARecording(bytes)) return refused(path, "is a damaged recording; copy or record it again");
    return refused(path, "is no recorded motion; give a file that --record has written");
}

} // namespace compare
