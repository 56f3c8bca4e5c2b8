// A scene as its author describes it: what there is, how it begins, and how it is to be stepped. Plain values; nothing here
// has met a device. SI units, y up.
//
// Every member has a row in scene_keys.cpp: its name in a scene file, its unit, what it may be, and what it means. What a
// member is for is therefore said there and not repeated here.
#pragma once

#include "modules/brittle/fracture/pattern.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brittle {

using Quaternion = std::array<double, 4>; // x, y, z, w; own frame -> world; of any length but 0

enum class ShapeKind : uint8_t { Box, Ball, Hull, Mesh, Plane };
constexpr uint32_t kMaxBallCorners = 34; // whose hull has 64 faces

// Cells in which a body is broken, or will break: each is a piece, and pieces of one body leave no gap between them.
struct CellsDescription {
    uint32_t sites = 0; // 0: one piece, whole
    uint64_t seed = 1;
    Pattern pattern = Pattern::Uniform;
    Double3 at = {0, 0, 0};
    double strength = 1;
    uint32_t directions = 26;
    bool broken = false;
    double inflate = 0;
    bool operator==(const CellsDescription&) const = default;
};

// In a frame of its own, whose origin the body's `place` is about.
struct ShapeDescription {
    ShapeKind kind = ShapeKind::Box;
    Double3 size = {1, 1, 1};
    double radius = 0.5;
    uint32_t corners = 32;
    std::vector<Double3> points;
    std::string file;
    std::shared_ptr<const ImportedMesh> model; // of a mesh, instead of a file: for programs, a scene file has none
    Double3 scale = {1, 1, 1};
    CellsDescription cells;
    bool operator==(const ShapeDescription&) const = default;
};

struct SurfaceDescription {
    double friction = 0.6;
    double restitution = 0;
    bool operator==(const SurfaceDescription&) const = default;
};

// How the fragments of a body lie: about the blow; evenly; in a plate in sectors and rings about the blow; as the paper has
// them.
enum class BreakPattern : uint8_t { Impact, Uniform, Radial, Paper };

struct BodyDescription {
    std::string name;
    ShapeDescription shape;
    Double3 place = {0, 0, 0};
    Quaternion turn = {0, 0, 0, 1};
    Double3 velocity = {0, 0, 0};
    Double3 spin = {0, 0, 0};
    std::optional<double> density; // at most one of these two; none: the material's, without one kUsualDensity
    std::optional<double> mass;
    SurfaceDescription surface;
    std::string material;
    BreakPattern break_pattern = BreakPattern::Impact;
    bool fixed = false; // does not move, until it breaks
    bool operator==(const BodyDescription&) const = default;
};
constexpr double kUsualDensity = 1000; // kg/m3

// A material of the scene's own: like a built-in one (effects/material.h) but for what is said.
struct MaterialDescription {
    std::string name;
    std::string like;
    std::optional<double> density;
    std::optional<double> youngs_modulus;
    std::optional<double> poisson_ratio;
    std::optional<double> fracture_energy;
    std::optional<double> tensile_strength;
    std::optional<double> weibull_modulus;
    std::optional<double> reference_volume;
    std::optional<double> eta;
    std::optional<double> smallest_cell;
    bool operator==(const MaterialDescription&) const = default;
};

// Does not move. A plane bounds all that lies below it: its frame's y axis is the way out.
struct ColliderDescription {
    std::string name;
    ShapeDescription shape = {.kind = ShapeKind::Plane};
    Double3 place = {0, 0, 0};
    Quaternion turn = {0, 0, 0, 1};
    SurfaceDescription surface;
    bool operator==(const ColliderDescription&) const = default;
};

enum class SolverKind : uint8_t { Soft, Hard };
enum class AxisKind : uint8_t { All, Fixed };

struct StepDescription {
    double dt = 1.0 / 60;
    uint32_t steps = 300;
    uint32_t substeps = 4;
    uint32_t most_substeps = 1500;
    uint32_t iterations = 1;
    SolverKind solver = SolverKind::Soft;
    double contact_hertz = 0;
    double contact_damping = 10;
    double push_out = 0;
    double bounce_speed = 0.25;
    double margin = 0;
    bool recycling = true;
    AxisKind axes = AxisKind::All;
    bool operator==(const StepDescription&) const = default;
};

struct BreakingDescription {
    double smallest_piece = 0.002;
    bool operator==(const BreakingDescription&) const = default;
};

struct DustDescription {
    double lifetime = 4;
    bool operator==(const DustDescription&) const = default;
};

struct DebrisDescription {
    double below = 0.05;
    double after = 3;
    double fade = 1;
    bool operator==(const DebrisDescription&) const = default;
};

struct EventsDescription {
    double impact_speed = 0.25;
    bool operator==(const EventsDescription&) const = default;
};

// 0: as many as the scene needs at its beginning, with room to break.
struct BudgetDescription {
    uint32_t bodies = 0;
    uint32_t pieces = 0;
    uint32_t pairs = 0;
    uint32_t contacts = 0;
    uint32_t fragments = 0;
    uint32_t fragment_faces = 0;
    uint32_t fragment_triangles = 0;
    uint32_t most_fragments = 0;
    uint32_t breaking_bodies = 0;
    uint32_t breaking_sites = 0;
    uint32_t breaking_triangles = 0;
    uint32_t dust = 16384;
    bool operator==(const BudgetDescription&) const = default;
};

struct CameraDescription {
    Double3 eye = {6, 4, 8};
    Double3 target = {0, 1, 0};
    Double3 up = {0, 1, 0};
    double field_of_view = 40;
    uint32_t width = 1280;
    uint32_t height = 720;
    bool operator==(const CameraDescription&) const = default;
};

struct SceneDescription {
    std::string name;
    std::string comment;
    Double3 gravity = {0, -9.81, 0};
    std::vector<std::string> effects = {"gravity", "contacts", "friction"};
    double air_density = 1.225;
    double drag_coefficient = 0.47;
    StepDescription step;
    BreakingDescription breaking;
    DustDescription dust;
    DebrisDescription debris;
    EventsDescription events;
    BudgetDescription budgets;
    CameraDescription camera;
    std::vector<MaterialDescription> materials;
    std::vector<BodyDescription> bodies;
    std::vector<ColliderDescription> colliders;
    bool operator==(const SceneDescription&) const = default;
};

// What is there once the world has made it.
struct SceneCounts {
    uint64_t bodies = 0; // a body that is broken from the start counts a body for each of its cells
    uint64_t pieces = 0; // convex ones of these bodies, as many as there are sites
    uint64_t colliders = 0;
};
SceneCounts countsOf(const SceneDescription& scene);

} // namespace brittle
