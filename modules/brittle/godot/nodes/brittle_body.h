// The node BrittleBody3D: a MeshInstance3D whose mesh is a body of the BrittleWorld3D above it, or, with a MultiMesh, a body
// for each of its instances. It moves as its body does until that breaks; then its world draws the fragments.
#pragma once

#include "modules/brittle/brittle.h"
#include "modules/brittle/godot/interface/class_record.h"

namespace brittle_godot {

class WorldNode;

enum class BodyKind : uint32_t { Moving = 0, Fixed = 1, Collider = 2 };
enum class BodyShape : uint32_t { Mesh = 0, Hull = 1, Box = 2, Ball = 3, Plane = 4 };

struct BodySettings {
    uint32_t kind = 0, shape = 0;
    uint32_t pattern = BRITTLE_PATTERN_IMPACT;
    uint32_t cells = 0; // 0: 1 where the mesh is convex, else kCellsOfOthers
    double density = 0, mass = 0;
    double friction = 0, restitution = 0;
    Vec3 velocity, spin;
    Value material; // a BrittleMaterial, or null: it does not break
    Value copies;   // a MultiMesh, or null
};

class BodyNode final : public Instance {
public:
    static void describe(ClassRecord& record);
    BodyNode();
    ~BodyNode() override;
    void notice(int what) override;

    BodySettings& settings() { return settings_; }
    const BodySettings& settings() const { return settings_; }
    void setCopies(const Value& copies);
    std::string nodeName() const; // for messages
    bool hasCopies() const { return !settings_.copies.isNull(); }
    Value mesh() const;                   // of the copies where there are any
    Value outerMaterial() const;          // what it is drawn with; may be null
    Value cutMaterial() const;            // what faces of cuts are drawn with; may be null
    Transform placeOf(size_t copy) const; // in the world; of copies, those that the MultiMesh has
    size_t copyCount() const;             // 1 without copies. Throws Failure where the MultiMesh tells no places

    // As the world says, while it runs:
    void join(WorldNode* world); // NULL: leave
    void show(size_t copy, const Transform& place);
    void hide(size_t copy);
    void finishMoves(); // of copies: they are all handed over at once
    bool isWhole(size_t copy) const { return copy < is_whole_.size() ? is_whole_[copy] : false; }
    void returnToStart();

private:
    void drawWhole();
    std::vector<float> placesOfCopies() const;
    size_t strideOfCopies() const;

    BodySettings settings_;
    WorldNode* world_ = nullptr;
    std::vector<bool> is_whole_;
    Transform start_;
    Value drawn_; // a MultiMesh of ours, so that the one given stays as it is; its instances:
    std::vector<float> places_, start_places_;
    size_t stride_ = 0;
    Transform to_node_;
    bool have_moved_ = false;
};

} // namespace brittle_godot
