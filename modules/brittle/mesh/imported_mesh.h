// The content of a model file: polygons cut into triangles, positions in double.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <span>
#include <string>

namespace brittle {

struct ImportedMesh {
    std::vector<Double3> positions; // as the file has them, also those that no triangle uses
    std::vector<Index3> triangles;
    std::vector<Float3> corner_normals; // three per triangle; zero where the file has none
    std::vector<Float2> corner_uvs;     // three per triangle; zero where the file has none
    std::vector<std::string> notes;     // one sentence for each kind of content that was left out
};

struct PolygonCorner {
    uint32_t position = 0;
    Float3 normal = {0, 0, 0};
    Float2 uv = {0, 0};
};

// Collects the polygons of a file. Polygons with more corners than this are refused: ear clipping takes their square.
constexpr size_t kMaxPolygonCorners = 10'000;

class MeshBuilder {
public:
    void addVertex(const Double3& position) { mesh_.positions.push_back(position); }
    size_t vertexCount() const { return mesh_.positions.size(); }
    size_t triangleCount() const { return mesh_.triangles.size(); }

    // The corners' positions must be there already. Says what is wrong with the polygon, nullptr if nothing is.
    // Corners that repeat the one before are skipped; a polygon with fewer than three others has no area and adds nothing. A
    // bent quad that seems to cross itself is cut along a diagonal: checks of the mesh report the harm, if any.
    const char* addPolygon(std::span<const PolygonCorner> corners);
    // Adds notes on quads that fold and on faces of one or two corners.
    ImportedMesh take();

private:
    void addTriangle(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c);

    ImportedMesh mesh_;
    std::vector<PolygonCorner> corners_; // of the current polygon
    std::vector<Double3> outline_;
    size_t folded_quads_ = 0, small_faces_ = 0;
};

} // namespace brittle
