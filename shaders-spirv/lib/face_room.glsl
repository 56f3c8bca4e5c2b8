// How many faces' worth of room a hull takes: of vertices, corners and edges there are so many for each (shared/breaking.h).
uint parts(uint count, uint each) { return (count + each - 1u) / each; }

// `count`: vertices, faces, corners, edges.
uint faceRoom(uvec4 count) {
    return max(max(count.y, parts(count.x, VERTICES_A_FACE)), max(parts(count.z, CORNERS_A_FACE), parts(count.w, EDGES_A_FACE)));
}
