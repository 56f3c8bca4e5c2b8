// Motion that should go on as it is, or end as mechanics says: over seams, in elastic impacts, in arches, against walls.
#include "modules/brittle/scene/library/long_motions.h"

#include "modules/brittle/scene/library/scene_parts.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace brittle::library {
namespace {

constexpr SurfaceDescription kSmooth = {.friction = 0};
constexpr SurfaceDescription kElastic = {.friction = 0, .restitution = 1};

enum class Floor : uint8_t { Tiles, Steps, Cells, Triangles, Sheet, Plane };

struct Slide {
    Floor floor;
    double speed; // m/s
    double tile;  // m, the edge of one; the cube that slides has 0.4 of it
    double seconds;
    bool is_wedge = false; // what slides, in place of a cube
};
constexpr std::array<Slide, kSliders> kSlides = {{{Floor::Tiles, 0.1, 1, 4},
                                                  {Floor::Tiles, 5, 1, 2},
                                                  {Floor::Tiles, 50, 1, 2},
                                                  {Floor::Tiles, 0.5, 0.01, 1},
                                                  {Floor::Steps, 5, 1, 2},
                                                  {Floor::Cells, 1, 1, 1.5},
                                                  {Floor::Triangles, 5, 1, 2},
                                                  {Floor::Sheet, 1, 1, 4},
                                                  {Floor::Sheet, 5, 1, 2},
                                                  {Floor::Plane, 5, 1, 2},
                                                  {Floor::Tiles, 5, 1, 2, true},
                                                  {Floor::Tiles, 1, 1, 4}}};

// Boxes side by side, their tops level, or off by a millionth of the cube that slides.
void addTiles(SceneDescription& scene, const Slide& slide) {
    const double last = slide.speed * slide.seconds + 2 * slide.tile;
    const double rise = slide.floor == Floor::Steps ? 1e-6 * 0.4 * slide.tile : 0;
    for (int k = -2; k * slide.tile < last; ++k) {
        ColliderDescription& tile = scene.colliders.emplace_back();
        tile.shape.kind = ShapeKind::Box;
        tile.shape.size = {slide.tile, slide.tile / 2, 2 * slide.tile};
        tile.place = {(k + 0.5) * slide.tile, (k % 2 == 0 ? 1 : -1) * rise - slide.tile / 4, 0};
        tile.surface = kSmooth;
    }
}

// A level rectangle, cut along x into `strips` strips of two triangles each.
void addTriangles(SceneDescription& scene, const Slide& slide, uint32_t strips) {
    const double first = -2 * slide.tile, length = slide.speed * slide.seconds + 4 * slide.tile;
    auto model = std::make_shared<ImportedMesh>();
    for (uint32_t k = 0; k <= strips; ++k)
        for (const double z : {-slide.tile, slide.tile})
            model->positions.push_back({first + length * k / strips, 0, z});
    for (uint32_t k = 0; k < strips; ++k) {
        const uint32_t corner = 2 * k;
        model->triangles.push_back({corner, corner + 1, corner + 2});
        model->triangles.push_back({corner + 1, corner + 3, corner + 2});
    }
    model->corner_normals.resize(3 * model->triangles.size());
    model->corner_uvs.resize(3 * model->triangles.size());
    ColliderDescription& floor = scene.colliders.emplace_back();
    floor.shape.kind = ShapeKind::Mesh;
    floor.shape.model = std::move(model);
    floor.surface = kSmooth;
}

// A heavy block of 60 cells, four tiles long.
void addBlockOfCells(SceneDescription& scene, const Slide& slide) {
    const double edge = slide.tile;
    scene.colliders.push_back(plane({0, -edge / 2, 0}, {0, 0, 0, 1}, kSmooth));
    BodyDescription& block = addBox(scene, {4 * edge, edge / 2, 2 * edge}, {1.5 * edge, -edge / 4, 0});
    block.shape.cells.sites = 60;
    block.mass = 1e6;
    block.surface = kSmooth;
}

void addFloor(SceneDescription& scene, const Slide& slide) {
    switch (slide.floor) {
    case Floor::Tiles:
    case Floor::Steps: return addTiles(scene, slide);
    case Floor::Cells: return addBlockOfCells(scene, slide);
    case Floor::Triangles: return addTriangles(scene, slide, 28);
    case Floor::Sheet: return addTriangles(scene, slide, 1);
    case Floor::Plane: return addGround(scene, kSmooth);
    }
}

// Its front is an edge on the floor.
void addWedge(SceneDescription& scene, double edge, double x) {
    std::vector<Double3> points;
    for (const double z : {-edge / 2, edge / 2})
        for (const Double3& corner : {Double3{-edge, 0, z}, Double3{edge, 0, z}, Double3{-edge, edge, z}})
            points.push_back(corner);
    addHull(scene, std::move(points), {x, 0, 0.1 * edge});
}

SceneDescription elasticScene(const std::string& comment, double stage, double seconds) {
    SceneDescription scene = newScene(comment, stage);
    scene.gravity = {0, -9.81, 0};
    scene.effects = {"gravity", "contacts", "restitution"};
    scene.step.steps = static_cast<uint32_t>(60 * seconds);
    return scene;
}

} // namespace

SceneDescription spinningRods(uint32_t count) {
    SceneDescription scene = weightlessScene("Rods of 2 m spin at 60 rad/s, a radian a step, each past a post of 2 cm.\n"
                                             "Passes: each hits its post when it first comes by.",
                                             40);
    scene.effects = {"contacts", "friction", "ccd"};
    scene.step.steps = 6;
    for (uint32_t k = 0; k < count; ++k) {
        const double place = 3.0 * k;
        ColliderDescription& post = scene.colliders.emplace_back();
        post.shape.kind = ShapeKind::Box;
        post.shape.size = {0.02, 0.02, 1};
        post.place = {0.8, place, 0};
        BodyDescription& rod = addBox(scene, {2, 0.05, 0.05}, {0, place, 0});
        rod.turn = turnAbout({0, 0, 1}, 0.1 + 3.0 * k / count);
        rod.spin = {0, 0, 60};
    }
    return scene;
}

SceneDescription slider(uint32_t number) {
    const Slide& slide = kSlides.at(std::min(number, kSliders - 1));
    SceneDescription scene = newScene("A cube or a wedge slides without friction over the seams of a floor.\n"
                                      "Passes: it keeps its speed to 0.1 %, and its height to 2 % of its size.",
                                      8 * slide.tile);
    scene.gravity = {0, -9.81, 0};
    scene.step.steps = static_cast<uint32_t>(60 * slide.seconds);
    const double edge = 0.4 * slide.tile;
    const double x = -0.25 * slide.tile - edge / 2;
    if (slide.is_wedge)
        addWedge(scene, edge, x);
    else
        addBox(scene, {edge, edge, edge}, {x, edge / 2, 0.1 * edge});
    scene.bodies[0].velocity = {slide.speed, 0, 0};
    scene.bodies[0].surface = kSmooth;
    addFloor(scene, slide);
    return scene;
}

SceneDescription elasticDrop(uint32_t meters) {
    SceneDescription scene = elasticScene("A cube with restitution 1 falls " + std::to_string(meters) +
                                              " m onto its face, and bounces for 20 s.\nPasses: every top is within 2 %.",
                                          meters, 20);
    addGround(scene, kElastic);
    addBox(scene, {1, 1, 1}, {0, 0.5 + meters, 0}).surface = kElastic;
    return scene;
}

SceneDescription elasticTilted(uint32_t count) {
    SceneDescription scene = elasticScene("Cubes with restitution 1 fall 2.5 m onto a corner or an edge.\n"
                                          "Passes: none has gained 0.1 % of its energy or lost 2 % after 1.2 s.",
                                          30, 1.2);
    addGround(scene, kElastic);
    Dice dice(37);
    for (uint32_t k = 0; k < count; ++k) {
        BodyDescription& cube = addBox(scene, {1, 1, 1}, {4.0 * (k % 10), 3, 4.0 * (k / 10)});
        cube.turn = dice.turn();
        cube.surface = kElastic;
    }
    return scene;
}

SceneDescription elasticTumbling(uint32_t meters) {
    SceneDescription scene = elasticScene("A cube with restitution 1 falls " + std::to_string(meters) +
                                              " m onto a corner, and bounces for 20 s.\n"
                                              "Passes: it has not gained 0.1 % of its energy or lost 2 %.",
                                          meters, 20);
    addGround(scene, kElastic);
    BodyDescription& cube = addBox(scene, {1, 1, 1}, {0, 1.0 + meters, 0});
    cube.turn = turnAbout({0.8, 0, 0.6}, 0.5);
    cube.surface = kElastic;
    return scene;
}

SceneDescription cradle(uint32_t gap_millimeters) {
    SceneDescription scene =
        elasticScene("A cube at 5 m/s hits five in a row, with restitution 1 and " + std::to_string(gap_millimeters) +
                         " mm between them.\nPasses: the last one leaves at 5 m/s, the others stand still.",
                     8, 2);
    scene.effects = {"contacts", "restitution"};
    for (int k = 0; k < 6; ++k) {
        const double gap = 1e-3 * gap_millimeters;
        addBox(scene, {1, 1, 1}, {k == 0 ? -2.0 : k * (1 + gap), 0, 0}).surface = kElastic;
    }
    scene.bodies[0].velocity = {5, 0, 0};
    return scene;
}

namespace {

SceneDescription archFor(uint32_t stones, uint32_t seconds) {
    constexpr double kInner = 2, kOuter = 2.8, kHalfDepth = 0.4;
    SceneDescription scene =
        newScene("A round arch of " + std::to_string(stones) + " stones stands by friction for " + std::to_string(seconds) +
                     " s.\nPasses: no stone has moved by more than "
                     "10 mm (of 21: 25), and none is faster than 1 mm/s.",
                 6);
    scene.gravity = {0, -9.81, 0};
    scene.step.steps = 60 * seconds;
    addGround(scene, {.friction = 0.8});
    for (uint32_t k = 0; k < stones; ++k) {
        std::vector<Double3> corners;
        for (const double radius : {kInner, kOuter})
            for (const uint32_t end : {k, k + 1})
                for (const double depth : {-kHalfDepth, kHalfDepth}) {
                    const double angle = std::numbers::pi * (1 - static_cast<double>(end) / stones);
                    corners.push_back({radius * std::cos(angle), std::max(0.0, radius * std::sin(angle)), depth});
                }
        BodyDescription& stone = addHull(scene, std::move(corners), {0, 0, 0});
        stone.surface.friction = 0.8;
        stone.density = 2200;
    }
    return scene;
}

} // namespace

SceneDescription arch(uint32_t stones) { return archFor(stones, 20); }

SceneDescription longArch(uint32_t stones) { return archFor(stones, 60); }

SceneDescription compoundsAtWall(uint32_t speed) {
    SceneDescription scene =
        weightlessScene("A cube, a cube of 8 cells and a rod of 6 fly into a wall of 1 cm at " + std::to_string(speed) +
                            " m/s, with friction.\nPasses: each stops where it touches, aside and turning at no more than a "
                            "thousandth of its speed.",
                        6);
    scene.step.steps = 60;
    const double way = 0.31 * speed / 10 + 0.11;
    ColliderDescription& wall = scene.colliders.emplace_back();
    wall.shape.kind = ShapeKind::Box;
    wall.shape.size = {4, 4, 0.01};
    addBox(scene, {0.2, 0.2, 0.2}, {-1, 0, way});
    addBox(scene, {0.2, 0.2, 0.2}, {0, 0, way}).shape.cells.sites = 8;
    addBox(scene, {0.02, 0.6, 0.02}, {1, 0, way}).shape.cells.sites = 6;
    for (BodyDescription& body : scene.bodies)
        body.velocity = {0, 0, -static_cast<double>(speed)};
    return scene;
}

SceneDescription steepSlope(uint32_t percent) {
    constexpr double kFriction = 0.5;
    SceneDescription scene = newScene("A block lies for 10 minutes on a slope of " + std::to_string(percent) +
                                          " % of that at which friction gives way.\nPasses: it moves by 1 mm at most.",
                                      4);
    const double angle = std::atan(kFriction * percent / 100);
    scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
    scene.step.steps = 36'000;
    addGround(scene, {.friction = kFriction});
    addBox(scene, {1, 0.5, 1}, {0, 0.25, 0}).surface.friction = kFriction;
    return scene;
}

} // namespace brittle::library
