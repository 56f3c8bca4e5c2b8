#include "engine/reload/checking_process.h"

#include <chrono>
#include <cstring>
#include <exception>
#include <stdexcept>

namespace engine {
namespace {

constexpr IsolationLimits kLimits = {.seconds = 30, .bytes = uint64_t{2} << 30};

// What the two processes, which are the same program, tell each other: numbers as they lie in memory, all else behind its
// length.
class Writer {
public:
    template <class Number>
    void number(Number value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void text(std::string_view text) {
        number(text.size());
        bytes_ += text;
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Reader {
public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    template <class Number>
    Number number() {
        Number value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() { return std::string(take(number<size_t>())); }

private:
    std::string_view take(size_t size) {
        if (size > rest_.size()) throw std::length_error("an answer that ends early");
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    std::string_view rest_;
};

struct Request {
    KernelSource source;
    const shaders::Module* host = nullptr; // where it lay when the process was forked
    std::vector<std::filesystem::path> include_folders;
};

std::string encode(const Request& request) {
    Writer writer;
    writer.text(request.source.name);
    writer.text(request.source.file.native());
    writer.number(request.source.defines.size());
    for (const std::string& define : request.source.defines)
        writer.text(define);
    writer.number(request.host);
    writer.number(request.include_folders.size());
    for (const auto& folder : request.include_folders)
        writer.text(folder.native());
    return writer.take();
}

Request decodeRequest(std::string_view bytes) {
    Reader reader(bytes);
    Request request;
    request.source.name = reader.text();
    request.source.file = reader.text();
    for (auto left = reader.number<size_t>(); left > 0; --left)
        request.source.defines.push_back(reader.text());
    request.host = reader.number<const shaders::Module*>();
    for (auto left = reader.number<size_t>(); left > 0; --left)
        request.include_folders.emplace_back(reader.text());
    return request;
}

std::string encode(const CheckedKernel& checked) {
    Writer writer;
    writer.number(checked.good() ? checked.words->size() : 0);
    if (checked.good())
        for (const uint32_t word : *checked.words)
            writer.number(word);
    writer.number(checked.diagnostics.size());
    for (const Diagnostic& d : checked.diagnostics) {
        writer.number(d.severity);
        writer.number(d.line);
        writer.number(d.column);
        writer.text(d.file);
        writer.text(d.message);
    }
    writer.number(checked.files.size());
    for (const auto& file : checked.files)
        writer.text(file.native());
    return writer.take();
}

CheckedKernel decodeChecked(std::string_view bytes) {
    Reader reader(bytes);
    CheckedKernel checked;
    std::vector<uint32_t> words(reader.number<size_t>());
    for (uint32_t& word : words)
        word = reader.number<uint32_t>();
    if (!words.empty()) checked.words = std::make_shared<const std::vector<uint32_t>>(std::move(words));
    checked.diagnostics.resize(reader.number<size_t>());
    for (Diagnostic& d : checked.diagnostics) {
        d.severity = reader.number<Severity>();
        d.line = reader.number<uint32_t>();
        d.column = reader.number<uint32_t>();
        d.file = reader.text();
        d.message = reader.text();
    }
    for (auto left = reader.number<size_t>(); left > 0; --left)
        checked.files.insert(reader.text());
    return checked;
}

std::string reasonOf(IsolatedRun::End end) {
    using End = IsolatedRun::End;
    switch (end) {
    case End::OutOfTime:
        return "takes longer than " + std::to_string(kLimits.seconds) + " s to compile; is there a macro that doubles itself?";
    case End::OutOfMemory:
        return "takes more than " + std::to_string(kLimits.bytes >> 30) +
               " GiB of memory to compile; is there a macro that doubles itself?";
    case End::NotBegun: return "the system has no process to be had to compile it in; try again";
    default: return "the compiler dies of it; is there an expression of many thousand terms or brackets?";
    }
}

// In which of its files the reason lies is not known, nor which they are.
CheckedKernel refusalOf(const KernelSource& source, std::string reason) {
    CheckedKernel refused;
    refused.diagnostics = {{Severity::Error, source.file.string(), 0, 0, std::move(reason)}};
    refused.files = {source.file.lexically_normal()};
    refused.knows_files = false;
    return refused;
}

// A process that a source has spoiled may answer anything.
CheckedKernel believed(const KernelSource& source, std::string_view answer) {
    try {
        return decodeChecked(answer);
    } catch (const std::exception&) {
        return refusalOf(source, reasonOf(IsolatedRun::End::Died));
    }
}

} // namespace

CheckingProcess::CheckingProcess(const StorageLimits& limits)
    : process_(
          [limits](std::string_view bytes) {
              const Request request = decodeRequest(bytes);
              return encode(checkKernel(request.source, request.host, request.include_folders, limits));
          },
          kLimits) {}

CheckedKernel CheckingProcess::check(const KernelSource& source, const shaders::Module* host,
                                     const std::vector<std::filesystem::path>& include_folders,
                                     const std::function<bool()>& is_unwanted) {
    prepareCompiler();
    const auto start = std::chrono::steady_clock::now();
    const IsolatedRun run = process_.run(encode({source, host, include_folders}), is_unwanted);
    CheckedKernel checked = run.isDone() ? believed(source, run.answer) : refusalOf(source, reasonOf(run.end));
    checked.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return checked;
}

} // namespace engine
