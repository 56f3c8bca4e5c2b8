#include "tests/reference/motion_file.h"

#include "tests/reference/glb_chunks.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace reference {
namespace {

using Json = nlohmann::json;

Quaternion quaternionOf(const Json& list) {
    requireGlb(list.is_array() && list.size() == 4, "four numbers expected");
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>(), list[3].get<double>()};
}

double sizeOf(const Quaternion& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

class Reader {
public:
    explicit Reader(GlbChunks chunks) : glb_(std::move(chunks)) {}
    MotionFile read();

private:
    void fault(const std::string& where, const std::string& what) { file_.faults.push_back(where + ": " + what); }
    void readNode(size_t index);
    void readCamera(const Json& node);
    void readBody(size_t index, const Json& node);
    void readPrimitive(const Json& primitive, MovingBody& body);
    void readTimes(const Json& animation);
    void readChannel(const Json& animation, const Json& channel);
    void checkTimes(const std::vector<double>& times, const Json& accessor);
    struct Keys {
        std::vector<double> times, values;
    };
    std::vector<size_t> keysAt(const std::vector<double>& times) const;
    void readMotion(const Keys& keys, bool is_turn, MovingBody& body);
    void readScales(const Keys& keys, MovingBody& body);
    void checkTurns(const MovingBody& body);

    GlbChunks glb_;
    MotionFile file_;
    std::vector<int> body_of_node_;
};

MotionFile Reader::read() {
    const Json& json = glb_.json;
    const Json& roots = json.at("scenes").at(json.at("scene").get<size_t>()).at("nodes");
    requireGlb(roots.size() == 1, "one root expected");
    const Json& world = json.at("nodes").at(roots[0].get<size_t>());
    if (world.value("name", "") != "world") fault("root", "is not named world");
    if (world.contains("translation")) file_.origin = pointOf(world["translation"]);
    file_.meshes = json.at("meshes").size();
    body_of_node_.assign(json["nodes"].size(), -1);
    const bool is_animated = json.contains("animations");
    file_.times = {0};
    if (is_animated) readTimes(json["animations"].at(0));
    for (const Json& child : world.at("children"))
        readNode(child.get<size_t>());
    if (is_animated)
        for (const Json& channel : json["animations"][0].at("channels"))
            readChannel(json["animations"][0], channel);
    std::set<std::string> names;
    for (const MovingBody& body : file_.bodies) {
        checkTurns(body);
        if (!names.insert(body.name).second) fault(body.name, "is there twice");
    }
    return std::move(file_);
}

void Reader::readNode(size_t index) {
    const Json& node = glb_.json["nodes"].at(index);
    if (node.contains("camera")) return readCamera(node);
    if (node.contains("mesh")) return readBody(index, node);
    fault(node.value("name", ""), "neither body nor camera");
}

void Reader::readCamera(const Json& node) {
    const Json& camera = glb_.json.at("cameras").at(node["camera"].get<size_t>());
    if (camera.value("type", "") != "perspective") fault("camera", "is not in perspective");
    if (!(camera.at("perspective").at("yfov").get<double>() > 0)) fault("camera", "sees nothing");
    file_.eye = pointOf(node.at("translation"));
    file_.view = quaternionOf(node.at("rotation"));
}

void Reader::readBody(size_t index, const Json& node) {
    body_of_node_[index] = static_cast<int>(file_.bodies.size());
    MovingBody& body = file_.bodies.emplace_back();
    body.name = node.value("name", "");
    body.mesh = node["mesh"].get<size_t>();
    body.places.assign(file_.times.size(), pointOf(node.at("translation")));
    body.turns.assign(file_.times.size(), quaternionOf(node.at("rotation")));
    body.there.assign(file_.times.size(), !node.contains("scale") || pointOf(node["scale"])[0] != 0);
    for (const Json& primitive : glb_.json.at("meshes").at(body.mesh).at("primitives"))
        readPrimitive(primitive, body);
}

void Reader::readPrimitive(const Json& primitive, MovingBody& body) {
    const std::string material = glb_.json.at("materials").at(primitive.at("material").get<size_t>()).value("name", "");
    const std::vector<double> positions = readAccessor(glb_, primitive.at("attributes").at("POSITION"));
    const std::vector<double> normals = readAccessor(glb_, primitive.at("attributes").at("NORMAL"));
    if (normals.size() != positions.size()) fault(body.name, "has not as many normals as positions");
    for (size_t k = 0; k < normals.size() / 3; ++k)
        if (std::abs(length(row(normals, k)) - 1) > 1e-3) fault(body.name, "has a normal that is not of unit length");
    const std::vector<double> indices = readAccessor(glb_, primitive.at("indices"));
    Triangles& triangles = material == "outer" ? body.outer : material == "inner" ? body.inner : body.still;
    if (material != "outer" && material != "inner" && material != "still") fault(body.name, "has a material " + material);
    for (size_t k = 0; k + 2 < indices.size(); k += 3)
        triangles.push_back({row(positions, static_cast<size_t>(indices[k])),
                             row(positions, static_cast<size_t>(indices[k + 1])),
                             row(positions, static_cast<size_t>(indices[k + 2]))});
}

void Reader::readTimes(const Json& animation) {
    std::set<double> all;
    std::set<size_t> inputs;
    for (const Json& sampler : animation.at("samplers"))
        inputs.insert(sampler.at("input").get<size_t>());
    for (const size_t input : inputs) {
        const std::vector<double> times = readAccessor(glb_, input);
        checkTimes(times, glb_.json["accessors"][input]);
        all.insert(times.begin(), times.end());
    }
    file_.times.assign(all.begin(), all.end());
}

void Reader::checkTimes(const std::vector<double>& times, const Json& accessor) {
    for (size_t k = 1; k < times.size(); ++k)
        if (!(times[k] > times[k - 1])) fault("times", "do not increase");
    if (times.front() < 0) fault("times", "begin before 0");
    if (accessor.at("min") != Json::array({times.front()}) || accessor.at("max") != Json::array({times.back()}))
        fault("times", "min and max are not theirs");
}

// The key that holds at each of the file's times: the last one, or the first where there is none yet.
std::vector<size_t> Reader::keysAt(const std::vector<double>& times) const {
    std::vector<size_t> keys;
    for (const double time : file_.times) {
        const auto later = std::ranges::upper_bound(times, time);
        keys.push_back(later == times.begin() ? 0 : static_cast<size_t>(later - times.begin()) - 1);
    }
    return keys;
}

void Reader::readChannel(const Json& animation, const Json& channel) {
    const int index = body_of_node_.at(channel.at("target").at("node").get<size_t>());
    requireGlb(index >= 0, "a channel moves what is no body");
    MovingBody& body = file_.bodies[static_cast<size_t>(index)];
    const Json& sampler = animation.at("samplers").at(channel.at("sampler").get<size_t>());
    const Keys keys = {readAccessor(glb_, sampler.at("input")), readAccessor(glb_, sampler.at("output"))};
    const std::string path = channel["target"].at("path");
    if (sampler.value("interpolation", "LINEAR") != (path == "scale" ? "STEP" : "LINEAR"))
        fault(body.name, "has keys of " + path + " that are to be read otherwise");
    requireGlb(keys.values.size() == keys.times.size() * (path == "rotation" ? 4u : 3u),
               "another number of keys than of times");
    if (path == "scale") return readScales(keys, body);
    body.moves = true;
    readMotion(keys, path == "rotation", body);
}

void Reader::readMotion(const Keys& keys, bool is_turn, MovingBody& body) {
    const std::vector<size_t> at = keysAt(keys.times);
    const Point place = body.places[0];
    const Quaternion turn = body.turns[0];
    for (size_t k = 0; k < file_.times.size(); ++k)
        if (is_turn)
            std::copy_n(&keys.values[4 * at[k]], 4, body.turns[k].begin());
        else
            body.places[k] = row(keys.values, at[k]);
    if (body.places[0] != place || body.turns[0] != turn) fault(body.name, "its node stands elsewhere than its first key");
}

void Reader::readScales(const Keys& keys, MovingBody& body) {
    const bool was_there = body.there[0];
    const std::vector<size_t> at = keysAt(keys.times);
    for (size_t k = 0; k < file_.times.size(); ++k) {
        const Point scale = row(keys.values, at[k]);
        if (scale != Point{0, 0, 0} && scale != Point{1, 1, 1}) fault(body.name, "has a scale that is neither 0 nor 1");
        body.there[k] = scale[0] != 0;
    }
    if (body.there[0] != was_there) fault(body.name, "its node is as large as at another time");
}

void Reader::checkTurns(const MovingBody& body) {
    for (size_t k = 0; k < body.turns.size(); ++k) {
        const Quaternion& q = body.turns[k];
        if (std::abs(sizeOf(q) - 1) > 1e-6) fault(body.name, "a turn is not of unit length");
        if (k == 0) continue;
        const Quaternion& p = body.turns[k - 1];
        if (p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3] < 0) fault(body.name, "a turn goes the long way round");
    }
}

} // namespace

size_t MovingBody::firstSeen() const { return static_cast<size_t>(std::ranges::find(there, true) - there.begin()); }

size_t MovingBody::timesSeen() const { return static_cast<size_t>(std::ranges::count(there, true)); }

const MovingBody& MotionFile::body(const std::string& name) const {
    for (const MovingBody& body : bodies)
        if (body.name == name) return body;
    throw std::runtime_error("no body " + name);
}

Point turnedBy(const Quaternion& q, const Point& p) {
    const Point u = {q[0], q[1], q[2]}, t = 2.0 * cross(u, p);
    return p + q[3] * t + cross(u, t);
}

Triangles placed(const Triangles& triangles, const MovingBody& body, size_t time) {
    Triangles result = triangles;
    for (Triangle& triangle : result)
        for (Point& p : triangle)
            p = body.places[time] + turnedBy(body.turns[time], p);
    return result;
}

MotionFile readMotionFile(const std::string& path) { return Reader(readGlbChunks(path)).read(); }

} // namespace reference
