#include "engine/reload/declarations.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>

namespace engine {
namespace {

struct Place {
    std::string file;
    uint32_t line = 0;
};

struct Token {
    std::string text;
    Place place;
};

// Reads what is left of a source once its macros are put in: code, and "#line NUMBER "FILE"" where the file changes. A macro
// stands in the line that used it, so that declarations made by macros are found where somebody wrote them.
class Tokens {
public:
    Tokens(std::string_view text, const std::string& file) : here_{file, 1} {
        while (!text.empty()) {
            const size_t end = std::min(text.find('\n'), text.size());
            addLine(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }
    const std::vector<Token>& all() const { return tokens_; }

private:
    void addLine(std::string_view line) {
        constexpr std::string_view kLine = "#line ";
        if (line.starts_with(kLine)) return follow(line.substr(kLine.size()));
        if (!line.starts_with("#")) addTokens(line);
        ++here_.line;
    }

    void follow(std::string_view line) {
        here_.line = 0;
        for (; !line.empty() && std::isdigit(static_cast<unsigned char>(line.front())) != 0; line.remove_prefix(1))
            here_.line = 10 * here_.line + static_cast<uint32_t>(line.front() - '0');
        const size_t open = line.find('"'), close = line.rfind('"');
        if (open < close && close != std::string_view::npos) here_.file = line.substr(open + 1, close - open - 1);
    }

    void addTokens(std::string_view line) {
        const auto isName = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
        for (size_t at = 0; at < line.size();) {
            size_t end = at + 1;
            if (isName(static_cast<unsigned char>(line[at])))
                while (end < line.size() && isName(static_cast<unsigned char>(line[end])))
                    ++end;
            if (std::isspace(static_cast<unsigned char>(line[at])) == 0)
                tokens_.push_back({std::string(line.substr(at, end - at)), here_});
            at = end;
        }
    }

    Place here_;
    std::vector<Token> tokens_;
};

// What is declared, by kind and number.
class Declarations {
public:
    explicit Declarations(const std::vector<Token>& tokens) : tokens_(tokens) {
        for (size_t at = 0; at < tokens.size(); ++at) {
            if (is(at, "layout") && is(at + 1, "(")) readLayout(at);
            if (is(at, "struct") && at + 1 < tokens.size()) structs_.try_emplace(tokens[at + 1].text, tokens[at].place);
            if (is(at, "main") && is(at + 1, "(")) main_ = tokens[at].place;
        }
    }

    std::optional<Place> find(const InterfaceChange& change) const {
        if (const auto found = structs_.find(change.holder); found != structs_.end()) return found->second;
        switch (change.of) {
        case InterfaceChange::Of::Binding: return upTo(bindings_, {change.set, change.index});
        case InterfaceChange::Of::Constant: return upTo(constants_, change.index);
        case InterfaceChange::Of::PushConstants: return push_ ? push_ : main_;
        case InterfaceChange::Of::GroupSize: return group_size_ ? group_size_ : main_;
        case InterfaceChange::Of::Stage: break;
        }
        return main_;
    }

private:
    bool is(size_t at, std::string_view text) const { return at < tokens_.size() && tokens_[at].text == text; }

    template <class Key>
    std::optional<Place> upTo(const std::map<Key, Place>& declared, const Key& key) const {
        const auto after = declared.upper_bound(key);
        return after == declared.begin() ? main_ : std::optional(std::prev(after)->second);
    }

    // "layout ( name = number , name ... )"
    void readLayout(size_t at) {
        const Place& place = tokens_[at].place;
        std::map<std::string, uint32_t> numbers;
        for (at += 2; at < tokens_.size() && !is(at, ")"); ++at) {
            if (is(at, "push_constant")) push_ = place;
            if (is(at + 1, "=") && at + 2 < tokens_.size()) numbers[tokens_[at].text] = numberOf(tokens_[at + 2].text);
        }
        if (const auto binding = numbers.find("binding"); binding != numbers.end())
            bindings_.try_emplace({numbers["set"], binding->second}, place);
        if (const auto id = numbers.find("constant_id"); id != numbers.end()) constants_.try_emplace(id->second, place);
        if (numbers.contains("local_size_x") || numbers.contains("local_size_x_id")) group_size_ = place;
    }

    static uint32_t numberOf(const std::string& text) {
        uint32_t number = 0;
        for (const char c : text)
            if (std::isdigit(static_cast<unsigned char>(c)) != 0) number = 10 * number + static_cast<uint32_t>(c - '0');
        return number;
    }

    const std::vector<Token>& tokens_;
    std::map<std::pair<uint32_t, uint32_t>, Place> bindings_;
    std::map<uint32_t, Place> constants_;
    std::map<std::string, Place> structs_;
    std::optional<Place> push_, group_size_, main_;
};

} // namespace

std::vector<Diagnostic> placeChanges(const std::vector<InterfaceChange>& changes, const KernelSource& source,
                                     const std::vector<std::filesystem::path>& include_folders) {
    const Tokens tokens(preprocessGlsl(source, include_folders), source.file.string());
    const Declarations declarations(tokens.all());
    std::vector<Diagnostic> diagnostics;
    for (const InterfaceChange& change : changes) {
        const Place place = declarations.find(change).value_or(Place{source.file.string(), 1});
        diagnostics.push_back(
            {Severity::Error, place.file, place.line, firstColumn(place.file, place.line),
             "kernel \"" + source.name + "\": " + change.why + "; to change its interface, build the host anew"});
    }
    return diagnostics;
}

} // namespace engine
