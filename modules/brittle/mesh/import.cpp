#include "modules/brittle/mesh/import.h"

#include "modules/brittle/mesh/gltf/gltf.h"
#include "modules/brittle/mesh/read_assimp.h"
#include "modules/brittle/mesh/readers.h"

#include <algorithm>
#include <cstring>
#include <fstream>

namespace brittle {
namespace {

constexpr uintmax_t kMaxFileBytes = uintmax_t{4} << 30;

std::string lowerCase(std::string ending) {
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

engine::Result<uintmax_t> fileSize(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        return badInput(error ? "cannot be reached: " + error.message() : "no such file");
    if (!std::filesystem::is_regular_file(path, error)) return badInput("not a file");
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return badInput("cannot be opened: " + error.message());
    if (size == 0) return badInput("the file is empty");
    if (size > kMaxFileBytes) return badInput("larger than 4 GiB");
    return size;
}

engine::Result<std::string> readBytes(const std::filesystem::path& path, uintmax_t size) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) return badInput("cannot be read; check its permissions");
    return bytes;
}

// ---- glTF -----------------------------------------------------------------------------------------------------------------

bool isGltf(const std::string& ending) { return ending == ".glb" || ending == ".gltf"; }

engine::Result<std::string> readWholeFile(const std::filesystem::path& path) {
    const auto size = fileSize(path);
    if (!size) return size.error();
    return readBytes(path, *size);
}

engine::Result<ImportedMesh> readGltfFile(const std::filesystem::path& path) {
    const auto bytes = readWholeFile(path);
    if (!bytes) return bytes.error();
    return readGltf(*bytes, [&](const std::string& name) { return readWholeFile(path.parent_path() / name); });
}

engine::Result<ImportedMesh> readGltfAlone(std::string_view bytes) {
    return readGltf(bytes, [](const std::string&) { return badInput("it is not in memory"); });
}

// Bytes of the files beside a model, of which some may be its buffers.
uintmax_t bytesBeside(const std::filesystem::path& path) {
    constexpr size_t kMostFiles = 10'000;
    std::error_code error;
    uintmax_t bytes = 0;
    size_t count = 0;
    for (std::filesystem::directory_iterator file(path.parent_path().empty() ? "." : path.parent_path(), error), end;
         !error && file != end && count < kMostFiles; file.increment(error), ++count) {
        std::error_code unreadable;
        const uintmax_t size = file->is_regular_file(unreadable) ? file->file_size(unreadable) : 0;
        if (!unreadable) bytes = std::min(bytes + size, kMaxFileBytes);
    }
    return bytes;
}

// ---- the way from the child -----------------------------------------------------------------------------------------------

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    const uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <class T>
bool extract(std::string_view& bytes, std::vector<T>& values) {
    uint64_t count = 0;
    if (bytes.size() < sizeof count) return false;
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes.remove_prefix(sizeof count);
    if (count > bytes.size() / sizeof(T)) return false;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return true;
}

// One line each.
std::vector<char> joined(const std::vector<std::string>& notes) {
    std::vector<char> text;
    for (const std::string& note : notes) {
        const std::string line = oneLine(note);
        text.insert(text.end(), line.begin(), line.end());
        text.push_back('\n');
    }
    return text;
}

std::vector<std::string> parted(const std::vector<char>& text) {
    std::vector<std::string> notes;
    for (auto begin = text.begin(), end = begin; begin != text.end(); begin = end == text.end() ? end : end + 1) {
        end = std::find(begin, text.end(), '\n');
        notes.push_back(oneLine({begin, end}));
    }
    return notes;
}

constexpr char kIsMesh = 'm', kIsError = 'e';

std::string encode(const engine::Result<ImportedMesh>& mesh) {
    if (!mesh) return kIsError + mesh.error().message;
    std::string bytes(1, kIsMesh);
    append(bytes, mesh->positions);
    append(bytes, mesh->triangles);
    append(bytes, mesh->corner_normals);
    append(bytes, mesh->corner_uvs);
    append(bytes, joined(mesh->notes));
    return bytes;
}

// The child may have been out of its mind: its mesh is believed no more than a file.
engine::Result<ImportedMesh> decode(std::string_view bytes) {
    if (bytes.starts_with(kIsError)) return badInput(oneLine(std::string(bytes.substr(1))));
    ImportedMesh mesh;
    std::vector<char> notes;
    const bool has_marker = bytes.starts_with(kIsMesh);
    if (has_marker) bytes.remove_prefix(1);
    const bool is_whole = has_marker && extract(bytes, mesh.positions) && extract(bytes, mesh.triangles) &&
                          extract(bytes, mesh.corner_normals) && extract(bytes, mesh.corner_uvs) && extract(bytes, notes) &&
                          bytes.empty() && mesh.corner_normals.size() == 3 * mesh.triangles.size() &&
                          mesh.corner_uvs.size() == 3 * mesh.triangles.size();
    const bool in_range = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Index3& t) {
        return std::max({t[0], t[1], t[2]}) < mesh.positions.size();
    });
    if (!is_whole || !in_range) return badInput("the reader failed on it; the file is damaged, export it again");
    mesh.notes = parted(notes);
    return mesh;
}

engine::IsolationLimits limitsFor(uintmax_t size) {
    engine::IsolationLimits limits;
    limits.bytes = (uint64_t{1} << 30) + 400 * uint64_t{size};
    return limits;
}

engine::Error failedBy(engine::IsolatedRun::End end, const engine::IsolationLimits& limits) {
    using End = engine::IsolatedRun::End;
    if (end == End::NotBegun) return {engine::ErrorCode::Internal, "no process to be had from the system"};
    if (end == End::OutOfMemory) return badInput("reading it takes too much memory; the file is damaged or too large");
    if (end == End::OutOfTime)
        return badInput("reading it takes longer than " + std::to_string(limits.seconds) + " s; the file is damaged");
    return badInput("the reader failed on it; the file is damaged, export it again");
}

template <class Read>
engine::Result<ImportedMesh> importIsolated(const Read& read, const engine::IsolationLimits& limits) {
    const auto run = engine::runIsolated([&] { return encode(read()); }, limits);
    if (!run.isDone()) return failedBy(run.end, limits);
    return decode(run.answer);
}

using Reader = engine::Result<ImportedMesh> (*)(std::string_view);

// nullptr for endings that are not among them.
Reader ownReader(const std::string& ending) {
    static constexpr std::pair<std::string_view, Reader> kReaders[] = {
        {".obj", readObj}, {".off", readOff}, {".ply", readPly}, {".stl", readStl}};
    for (const auto& [known, reader] : kReaders)
        if (ending == known) return reader;
    return nullptr;
}

engine::Result<void> checkEnding(const std::string& ending) {
    for (const char* known : {".glb", ".gltf", ".fbx", ".dae"})
        if (ending == known) return {};
    if (ownReader(ending)) return {};
    return badInput("a format that is not read; use OBJ, PLY, STL, OFF, GLB, glTF, FBX or DAE");
}

engine::Result<ImportedMesh> importUnnamed(const std::filesystem::path& path) {
    const auto size = fileSize(path);
    if (!size) return size.error();
    const std::string ending = lowerCase(path.extension().string());
    if (auto known = checkEnding(ending); !known) return known.error();
    const Reader reader = ownReader(ending);
    if (isGltf(ending)) {
        const uintmax_t buffers = ending == ".gltf" ? bytesBeside(path) : 0;
        return importIsolated([&] { return readGltfFile(path); }, limitsFor(*size + buffers));
    }
    if (!reader) return importIsolated([&] { return readByAssimp(path, ending); }, limitsFor(*size));
    const auto bytes = readBytes(path, *size);
    if (!bytes) return bytes.error();
    return reader(*bytes);
}

} // namespace

engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending,
                                        const engine::IsolationLimits& limits) {
    const std::string lower = lowerCase(std::string(ending));
    if (auto known = checkEnding(lower); !known) return known.error();
    if (bytes.empty()) return badInput("the file is empty");
    try {
        const Reader reader = ownReader(lower);
        if (reader) return reader(bytes);
        return importIsolated([&] { return isGltf(lower) ? readGltfAlone(bytes) : readByAssimp(bytes, lower); }, limits);
    } catch (const std::exception&) {
        return badInput("cannot be read; too large");
    }
}

engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending) {
    return importMesh(bytes, ending, limitsFor(bytes.size()));
}

engine::Result<ImportedMesh> importMesh(const std::filesystem::path& path) {
    try {
        auto mesh = importUnnamed(path);
        if (!mesh) return engine::Error{mesh.error().code, path.string() + ": " + mesh.error().message};
        return mesh;
    } catch (const std::exception&) { // out of memory, or a name the file system cannot take
        return badInput(path.string() + ": cannot be read; too large, or not a name of a file");
    }
}

} // namespace brittle
