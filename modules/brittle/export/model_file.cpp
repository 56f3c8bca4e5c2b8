#include "modules/brittle/export/model_file.h"

#include "modules/brittle/mesh/vector_math.h"

#include <charconv>

namespace brittle {
namespace {

class TextFile {
public:
    TextFile& operator<<(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    template <class Number>
    TextFile& number(Number value) {
        std::array<char, 32> digits;
        bytes_.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
        return *this;
    }
    template <class Numbers>
    TextFile& line(std::string_view head, const Numbers& numbers) {
        bytes_ += head;
        for (const auto& value : numbers)
            (*this << " ").number(value);
        return *this << "\n";
    }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

void addVertices(TextFile& file, const Mesh& mesh, std::string_view head) {
    for (const Float3& position : mesh.positions)
        file.line(head, mesh.center + toDouble(position));
}

void addFaces(TextFile& file, const Mesh& mesh) {
    for (const Index3& t : mesh.triangles)
        file.line("3", t);
}

// Every corner has a normal and texture coordinates of its own.
std::string encodeObj(const Mesh& mesh) {
    TextFile file;
    addVertices(file, mesh, "v");
    for (const Float3& normal : mesh.corner_normals)
        file.line("vn", normal);
    for (const Float2& uv : mesh.corner_uvs)
        file.line("vt", Float2{uv[0], 1 - uv[1]}); // v points up in the file
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        file << "f";
        for (size_t k = 0; k < 3; ++k) {
            const size_t corner = 3 * t + k + 1;
            (file << " ").number(mesh.triangles[t][k] + 1);
            (file << "/").number(corner);
            (file << "/").number(corner);
        }
        file << "\n";
    }
    return file.take();
}

std::string encodeOff(const Mesh& mesh) {
    TextFile file;
    file << "OFF\n";
    file.number(mesh.positions.size()) << " ";
    file.number(mesh.triangles.size()) << " 0\n";
    addVertices(file, mesh, "");
    addFaces(file, mesh);
    return file.take();
}

std::string encodePly(const Mesh& mesh) {
    TextFile file;
    file << "ply\nformat ascii 1.0\nelement vertex ";
    file.number(mesh.positions.size()) << "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
    file.number(mesh.triangles.size()) << "\nproperty list uchar uint vertex_indices\nend_header\n";
    addVertices(file, mesh, "");
    addFaces(file, mesh);
    return file.take();
}

} // namespace

engine::Result<std::string> encodeModel(const Mesh& mesh, std::string_view ending) {
    std::string lower(ending);
    for (char& c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (lower == ".obj") return encodeObj(mesh);
    if (lower == ".off") return encodeOff(mesh);
    if (lower == ".ply") return encodePly(mesh);
    return engine::Error{engine::ErrorCode::BadInput, "models are written as OBJ, OFF or PLY; choose one of these endings"};
}

} // namespace brittle
