#include "tests/reference/model_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace reference {
namespace {

void addPolygon(Triangles& triangles, const std::vector<Point>& vertices, const std::vector<size_t>& corners) {
    for (size_t k = 1; k + 1 < corners.size(); ++k)
        triangles.push_back({vertices.at(corners[0]), vertices.at(corners[k]), vertices.at(corners[k + 1])});
}

Triangles readObj(std::istream& file) {
    Triangles triangles;
    std::vector<Point> vertices;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Point p;
            words >> p[0] >> p[1] >> p[2];
            vertices.push_back(p);
        } else if (kind == "f") {
            std::vector<size_t> corners;
            for (std::string corner; words >> corner;) {
                const long index = std::stol(corner); // stops at the slash
                corners.push_back(static_cast<size_t>(index > 0 ? index - 1 : static_cast<long>(vertices.size()) + index));
            }
            addPolygon(triangles, vertices, corners);
        }
    }
    return triangles;
}

Triangles readOff(std::istream& file) {
    std::string text;
    for (std::string line; std::getline(file, line);)
        text += line.substr(0, line.find('#')) + "\n";
    std::istringstream words(text);
    std::string magic;
    size_t vertex_count = 0, face_count = 0, edge_count = 0;
    words >> magic >> vertex_count >> face_count >> edge_count;
    if (magic != "OFF") throw std::runtime_error("not an OFF file");
    std::vector<Point> vertices(vertex_count);
    for (Point& p : vertices)
        words >> p[0] >> p[1] >> p[2];
    Triangles triangles;
    for (size_t f = 0; f < face_count; ++f) {
        size_t count = 0;
        words >> count;
        std::vector<size_t> corners(count);
        for (size_t& corner : corners)
            words >> corner;
        addPolygon(triangles, vertices, corners);
        words.ignore(1000, '\n'); // a color may follow
    }
    if (words.fail()) throw std::runtime_error("the OFF file ends early");
    return triangles;
}

Triangles readBinaryStl(const std::string& bytes, uint32_t count) {
    Triangles triangles(count);
    for (size_t t = 0; t < count; ++t) {
        float numbers[12]; // a normal and three corners
        std::memcpy(numbers, bytes.data() + 84 + 50 * t, sizeof numbers);
        for (size_t k = 0; k < 9; ++k)
            triangles[t][k / 3][k % 3] = static_cast<double>(numbers[3 + k]);
    }
    return triangles;
}

Triangles readTextStl(const std::string& bytes) {
    std::istringstream words(bytes);
    Triangles triangles;
    size_t corner = 0;
    for (std::string word; words >> word;) {
        if (word != "vertex") continue;
        if (corner % 3 == 0) triangles.emplace_back();
        Point& p = triangles.back()[corner++ % 3];
        words >> p[0] >> p[1] >> p[2];
    }
    return triangles;
}

Triangles readStl(std::istream& file) {
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    uint32_t count = 0;
    if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
    return bytes.size() == 84 + size_t{50} * count ? readBinaryStl(bytes, count) : readTextStl(bytes);
}

} // namespace

Triangles readModel(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot open " + path);
    std::string ending = path.substr(path.rfind('.') + 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == "obj") return readObj(file);
    if (ending == "off") return readOff(file);
    if (ending == "stl") return readStl(file);
    throw std::runtime_error("no reader for " + path);
}

} // namespace reference
