#include "tools/compare/motion_recording.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <span>

namespace compare {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;
using nlohmann::json;

constexpr const char* kFormat = "brittle motion 1"; // CBOR

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
    MotionRecording recording = {object.at("scene"), object.at("device"), object.at("driver"), object.at("dt"), {}, {}};
    for (const json& bodies : object.at("steps"))
        recording.steps.push_back(listOf<gpu::BodyState>(bodies));
    if (object.contains("passes")) recording.passes = stepOf(object.at("passes"));
    return recording;
}

} // namespace

Result<void> writeRecording(brittle::OutputFile& file, const MotionRecording& recording) {
    json object = {{"format", kFormat},          {"scene", recording.scene}, {"device", recording.device},
                   {"driver", recording.driver}, {"dt", recording.dt},       {"steps", json::array()}};
    for (const auto& bodies : recording.steps)
        object["steps"].push_back(blobOf(bodies));
    if (recording.passes) object["passes"] = toJson(*recording.passes);
    const std::vector<uint8_t> bytes = json::to_cbor(object);
    if (auto written = file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()}); !written) return written;
    return file.commit();
}

Result<MotionRecording> readRecording(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{ErrorCode::BadInput, path.string() + ": cannot be read; give a file that --record has written"};
    const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    try {
        const json object = json::from_cbor(bytes);
        if (object.at("format") == kFormat) return recordingOf(object);
    } catch (const json::exception&) { // said below
    }
    return Error{ErrorCode::BadInput, path.string() + ": is no recorded motion; give a file that --record has written"};
}

} // namespace compare
