// Boxes on each other as a world steps them, in double precision, plain and slow: the faces of neighbors are found by comparing
// numbers, and everything that is solved is solved by tests/reference/soft_contact.h.
//
// The boxes stand upright when it begins, and of two that touch one face lies within the other, as far as its outline. Contacts
// keep the points that they were found with; that is what the world does as long as bodies hardly move against each other, and
// `hardlyMoved` says whether it still would.
#pragma once

#include "tests/reference/soft_contact.h"

#include <vector>

namespace reference {

struct StackedBox {
    using Face = std::array<Point, 4>; // corners from the center of mass, in the order in which the hull names them
    Face bottom, top;                  // along y
    Point place;                       // of the center of mass
    double mass = 0;                   // 0: it does not move
    Point moments = {0, 0, 0};
    double friction = 0;
    Point velocity = {0, 0, 0}, spin = {0, 0, 0};
};

struct StackSettings {
    Point gravity;
    double dt;
    uint32_t substeps;
    double contact_hertz, contact_damping, push_out, margin;
};

class RigidStack {
public:
    RigidStack(const std::vector<StackedBox>& boxes, const StackSettings& settings);
    void step();
    const std::vector<RigidBody>& bodies() const { return bodies_; }
    const std::vector<SoftContact>& contacts() const { return contacts_; }
    bool hardlyMoved() const;

private:
    void findContacts(const std::vector<StackedBox>& boxes);
    bool share(const SoftContact& c, const SoftContact& d) const; // a body that moves
    size_t lowestColor(const SoftContact& mine) const;
    void colorContacts();
    void letSpeedsLag();
    void solveAll(bool with_push);
    void substep();

    StackSettings settings_;
    SolveSettings solve_;
    std::vector<RigidBody> bodies_, first_;
    bool has_settled_ = false; // contacts have been solved before
    std::vector<double> radii_;
    std::vector<SoftContact> contacts_; // in the order of their bodies
};

} // namespace reference
