// Checked access to the JSON of a glTF file. Every number, index and name is checked when it is read, and every error says
// which element of the file is wrong.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace brittle::gltf {

using Json = nlohmann::json;

// Thrown within the reader; readGltf turns it into an Error.
struct Refusal {
    std::string message;
};

constexpr const char* kExportAgain = "export the file again";

// Throws "where: what; advice", or "where: what" if the advice is empty.
[[noreturn]] void refuse(const std::string& where, const std::string& what, const std::string& advice = kExportAgain);

// One JSON object and its place, such as "mesh 2, primitive 0".
class Element {
public:
    Element(const Json& json, std::string where);

    const std::string& where() const { return where_; }
    const Json& json() const { return *json_; }
    bool has(const char* key) const { return json_->contains(key); }
    [[noreturn]] void refuse(const std::string& what, const std::string& advice = kExportAgain) const;

    // The members are optional: nullopt if they are missing, a Refusal if they have the wrong type.
    std::optional<uint64_t> integer(const char* key) const; // at most 2^53
    std::optional<std::string> text(const char* key) const;
    std::optional<std::vector<double>> numbers(const char* key) const;
    std::optional<std::vector<double>> numbers(const char* key, size_t size) const;
    std::optional<std::vector<uint64_t>> integers(const char* key) const;
    std::optional<double> number(const char* key) const;
    std::optional<Element> object(const char* key) const;
    std::optional<Element> extension(const char* name) const;
    bool flag(const char* key) const;
    // nullptr if it is missing.
    const Json* list(const char* key) const;

    // A Refusal if they are missing.
    uint64_t requiredInteger(const char* key) const;
    Element requiredObject(const char* key) const;

private:
    const Json* find(const char* key) const;

    const Json* json_;
    std::string where_;
};

// The parsed file with its lists of elements.
class Document {
public:
    explicit Document(std::string_view text);

    Element root() const { return {json_, "the file"}; }
    // Number of elements of a list of the file, such as "accessors".
    uint64_t size(const char* list) const;
    // Element of a list; `user` is the place that refers to it.
    Element element(const char* list, uint64_t index, const std::string& user) const;

private:
    Json json_;
};

} // namespace brittle::gltf
