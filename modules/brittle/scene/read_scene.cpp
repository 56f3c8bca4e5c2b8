#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/nearest_name.h"
#include "modules/brittle/scene/scene_file.h"
#include "modules/brittle/scene/scene_keys.h"

#include <toml++/toml.h>

#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>

namespace brittle {
namespace {

// Of the first thing that is wrong. Thrown within this file only: the library throws as well.
struct Refusal {
    size_t line = 0;
    std::string message;
};

std::string kindOf(const toml::node& node) {
    if (node.is_string()) return "a text";
    if (node.is_integer()) return "a whole number";
    if (node.is_floating_point()) return "a number";
    if (node.is_boolean()) return "true or false";
    if (node.is_array()) return "a list";
    return node.is_table() ? "a table" : "a date or time";
}

// One value, by what the key's member is.
class ReadValue {
public:
    ReadValue(const toml::node& node, const SceneKey& key) : node_(node), key_(key) {}

    void operator()(double* x) const { *x = number(node_); }
    void operator()(std::optional<double>* x) const { *x = number(node_); }
    void operator()(uint32_t* x) const { *x = static_cast<uint32_t>(whole(0xffffffff)); }
    void operator()(uint64_t* x) const { *x = static_cast<uint64_t>(whole(std::numeric_limits<int64_t>::max())); }
    void operator()(bool* x) const {
        if (!node_.is_boolean()) wrongType(node_);
        *x = node_.as_boolean()->get();
    }
    void operator()(std::string* x) const {
        *x = text(node_);
        if (key_.allowed.names.empty()) return;
        if (x->empty()) wrong(node_, "is empty; leave it out, or name one");
        if (!key_.allowed.has_own_names) known(*x, node_);
    }
    void operator()(const ChoiceRef& x) const { *x.number = known(text(node_), node_); }
    void operator()(Double3* x) const { *x = numbers<3>(node_); }
    void operator()(Quaternion* x) const { *x = node_.is_table() ? turnOf(*node_.as_table()) : numbers<4>(node_); }
    void operator()(std::vector<Double3>* x) const {
        x->clear();
        for (const toml::node& entry : list(node_))
            x->push_back(numbers<3>(entry));
    }
    void operator()(std::vector<std::string>* x) const {
        x->clear();
        for (const toml::node& entry : list(node_)) {
            x->push_back(text(entry));
            known(x->back(), entry);
        }
    }

private:
    [[noreturn]] void wrong(const toml::node& node, const std::string& what) const {
        throw Refusal{node.source().begin.line, inQuotes(key_.name) + " " + what + "; it has to be " + describeAllowed(key_)};
    }
    [[noreturn]] void wrongType(const toml::node& node) const {
        wrong(node, (&node == &node_ ? "is " : "holds ") + kindOf(node));
    }
    double number(const toml::node& node) const {
        if (node.is_integer()) return static_cast<double>(node.as_integer()->get());
        if (!node.is_floating_point()) wrongType(node);
        return node.as_floating_point()->get();
    }
    int64_t whole(int64_t most) const {
        if (!node_.is_integer()) wrongType(node_);
        const int64_t value = node_.as_integer()->get();
        if (value < 0 || value > most) wrong(node_, "is " + std::to_string(value));
        return value;
    }
    std::string text(const toml::node& node) const {
        if (!node.is_string()) wrongType(node);
        return node.as_string()->get();
    }
    const toml::array& list(const toml::node& node) const {
        if (!node.is_array()) wrongType(node);
        return *node.as_array();
    }
    template <size_t Count>
    std::array<double, Count> numbers(const toml::node& node) const {
        const toml::array& entries = list(node);
        if (entries.size() != Count) wrong(node, "has a list of " + std::to_string(entries.size()));
        std::array<double, Count> values;
        for (size_t k = 0; k < Count; ++k)
            values[k] = number(entries[k]);
        return values;
    }
    // The number of the name.
    uint8_t known(const std::string& name, const toml::node& node) const {
        const std::span<const std::string_view> names = key_.allowed.names;
        for (size_t k = 0; k < names.size(); ++k)
            if (names[k] == name) return static_cast<uint8_t>(k);
        const std::string list = "; it has to be " + describeAllowed(key_);
        throw Refusal{node.source().begin.line,
                      "unknown " + inQuotes(name) + " in " + inQuotes(key_.name) + didYouMean(name, names, list)};
    }
    Quaternion turnOf(const toml::table& table) const {
        const toml::node *axis = table.get("axis"), *degrees = table.get("degrees");
        if (axis == nullptr || degrees == nullptr || table.size() != 2) wrong(node_, "is a table of something else");
        const Double3 direction = numbers<3>(*axis);
        const double half = number(*degrees) * std::numbers::pi / 360, size = length(direction);
        if (!(size > 1e-12 && std::isfinite(size)) || !std::isfinite(half)) wrong(node_, "has no axis or no angle");
        const Double3 part = std::sin(half) / size * direction;
        return {part[0], part[1], part[2], std::cos(half)};
    }

    const toml::node& node_;
    const SceneKey& key_;
};

class SceneReader {
public:
    SceneDescription read(const toml::table& file);
    // Of a key, of the table it would be in where it was not given, else of the first line.
    size_t lineOf(const SceneProblem& problem) const;

private:
    void readSection(const SceneSection& section, const toml::node& node);
    void readTable(const SceneSection& section, size_t index, const toml::table& table);
    void refuseUnknown(const SceneSection& section, const toml::key& name) const;
    void refuseForeign(const SceneSection& section, size_t index, const toml::table& table);

    SceneDescription scene_;
    std::map<std::tuple<SectionId, size_t, std::string_view>, size_t> lines_; // "" for the table itself
};

const SceneSection* findSection(std::string_view name) {
    for (const SceneSection& section : sceneSections())
        if (!section.name.empty() && section.name == name) return &section;
    return nullptr;
}

void SceneReader::refuseUnknown(const SceneSection& section, const toml::key& name) const {
    std::vector<std::string_view> names;
    for (const SceneKey& key : section.keys)
        names.push_back(key.name);
    if (section.id == SectionId::Scene)
        for (const SceneSection& other : sceneSections())
            if (!other.name.empty()) names.push_back(other.name);
    std::string list;
    for (const std::string_view known : names)
        list += (list.empty() ? "" : ", ") + std::string(known);
    throw Refusal{name.source().begin.line, "unknown key " + inQuotes(name.str()) +
                                                didYouMean(name.str(), names, "; " + headingOf(section) + " has " + list)};
}

void SceneReader::readTable(const SceneSection& section, size_t index, const toml::table& table) {
    lines_[{section.id, index, ""}] = table.source().begin.line;
    for (const auto& [name, node] : table) {
        if (const SceneSection* inner = findSection(name.str()); inner != nullptr && section.id == SectionId::Scene) {
            readSection(*inner, node);
            continue;
        }
        const SceneKey* key = findKey(section, name.str());
        if (key == nullptr) refuseUnknown(section, name);
        std::visit(ReadValue(node, *key), key->locate(ownerOf(scene_, section.id, index)));
        lines_[{section.id, index, key->name}] = node.source().begin.line;
    }
    if (section.is_repeated) refuseForeign(section, index, table);
}

// Keys of other shapes, also where they say what would be so anyway.
void SceneReader::refuseForeign(const SceneSection& section, size_t index, const toml::table& table) {
    const ShapeDescription* shape = shapeOf(ownerOf(scene_, section.id, index), section.id);
    if (shape == nullptr) return;
    const std::string_view shape_name = shapeNames()[static_cast<size_t>(shape->kind)];
    for (const auto& [name, node] : table)
        if (const SceneKey* key = findKey(section, name.str()); (key->shapes & bitOf(shape->kind)) == 0)
            throw Refusal{name.source().begin.line,
                          inQuotes(key->name) + " means nothing to a " + std::string(shape_name) + "; leave it out"};
}

void SceneReader::readSection(const SceneSection& section, const toml::node& node) {
    const auto misplaced = [&](const toml::node& where) {
        throw Refusal{where.source().begin.line, inQuotes(section.name) + " is " + kindOf(where) +
                                                     "; write it as a table that begins with " + headingOf(section)};
    };
    if (!section.is_repeated) {
        if (!node.is_table()) misplaced(node);
        return readTable(section, 0, *node.as_table());
    }
    if (!node.is_array()) misplaced(node);
    for (const toml::node& entry : *node.as_array()) {
        if (!entry.is_table()) misplaced(entry);
        const size_t index = countOf(scene_, section.id);
        addOwner(scene_, section.id);
        readTable(section, index, *entry.as_table());
    }
}

SceneDescription SceneReader::read(const toml::table& file) {
    readTable(sectionOf(SectionId::Scene), 0, file);
    return scene_;
}

size_t SceneReader::lineOf(const SceneProblem& problem) const {
    for (const std::string_view key : {problem.key, std::string_view()})
        if (const auto line = lines_.find({problem.section, problem.index, key}); line != lines_.end()) return line->second;
    return 1;
}

// One line, whatever was in the file.
engine::Error errorAt(const std::string& name, size_t line, std::string message) {
    for (char& c : message)
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    return {engine::ErrorCode::BadInput, name + ":" + std::to_string(line) + ": " + message};
}

} // namespace

engine::Result<SceneDescription> readScene(std::string_view text, const std::string& name) {
    try {
        SceneReader reader;
        SceneDescription scene = reader.read(toml::parse(text));
        if (const auto problem = findProblem(scene)) return errorAt(name, reader.lineOf(*problem), problem->message);
        return scene;
    } catch (const Refusal& refusal) {
        return errorAt(name, refusal.line, refusal.message);
    } catch (const toml::parse_error& error) {
        return errorAt(name, error.source().begin.line, "is no TOML: " + std::string(error.description()));
    }
}

engine::Result<SceneDescription> readScene(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& why) {
        return engine::Error{engine::ErrorCode::BadInput, path.string() + ": " + why};
    };
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        const bool is_missing = !error || error == std::errc::no_such_file_or_directory;
        return refuse(is_missing ? "no such file" : "cannot be reached: " + error.message());
    }
    if (std::filesystem::file_size(path, error) > kMaxSceneBytes || error) return refuse("too large for a scene");
    if (std::filesystem::file_size(path, error) == 0) return refuse("the file is empty; a scene has at least one body");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file || !text) return refuse("cannot be read");
    return readScene(text.str(), path.string());
}

} // namespace brittle
