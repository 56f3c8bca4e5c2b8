#include "tests/reference/rigid_stack.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reference {
namespace {

constexpr double kOutlineSlack = 1e-4; // m
constexpr size_t kNone = std::numeric_limits<size_t>::max();

using Face = StackedBox::Face;

struct Outline {
    double low_x, high_x, low_z, high_z;
    bool holds(const Outline& o) const {
        return o.low_x >= low_x - kOutlineSlack && o.high_x <= high_x + kOutlineSlack && o.low_z >= low_z - kOutlineSlack &&
               o.high_z <= high_z + kOutlineSlack;
    }
};

Face inWorld(const StackedBox& box, Face face) {
    for (Point& corner : face)
        corner = corner + box.place;
    return face;
}

Outline outlineOf(const Face& face) {
    const auto [low_x, high_x] = std::minmax({face[0][0], face[1][0], face[2][0], face[3][0]});
    const auto [low_z, high_z] = std::minmax({face[0][2], face[1][2], face[2][2], face[3][2]});
    return {low_x, high_x, low_z, high_z};
}

// The four corners of where the faces lie over each other: the other's, its last one first, where the leading face holds them;
// else those of the leading face.
std::array<Point, 4> cornersOf(const Face& leading, const Face& other) {
    if (outlineOf(leading).holds(outlineOf(other))) return {other[3], other[0], other[1], other[2]};
    return leading;
}

// The face of a box that does not move leads, else that of the first box.
bool leadsB(const StackedBox& a, const StackedBox& b) { return b.mass == 0 && a.mass != 0; }

SoftPoint pointAt(const Point& at, double height_a, double height_b, const StackedBox& a, const StackedBox& b) {
    SoftPoint p;
    p.anchor_a = p.arm_a = Point{at[0], height_a, at[2]} - a.place;
    p.anchor_b = p.arm_b = Point{at[0], height_b, at[2]} - b.place;
    return p;
}

// Along y; points only where the faces are as near as the margin.
bool findContact(const StackedBox& a, const StackedBox& b, double margin, SoftContact& contact) {
    const bool b_above = b.place[1] > a.place[1];
    const Face of_a = inWorld(a, b_above ? a.top : a.bottom), of_b = inWorld(b, b_above ? b.bottom : b.top);
    const Outline outline_a = outlineOf(of_a), outline_b = outlineOf(of_b);
    if (!outline_a.holds(outline_b) && !outline_b.holds(outline_a)) return false;
    const double height_a = of_a[0][1], height_b = of_b[0][1], up = b_above ? 1 : -1;
    if (up * (height_b - height_a) > margin) return false;
    contact.normal = {0, up, 0};
    contact.tangent = {1, 0, 0};
    contact.friction = std::sqrt(a.friction * b.friction);
    const auto corners = leadsB(a, b) ? cornersOf(of_b, of_a) : cornersOf(of_a, of_b);
    for (size_t k = 0; k < corners.size(); ++k)
        contact.points[k] = pointAt(corners[k], height_a, height_b, a, b);
    return true;
}

RigidBody bodyOf(const StackedBox& box) {
    RigidBody body;
    body.place = box.place;
    body.velocity = box.velocity;
    if (box.mass == 0) return body;
    body.inverse_mass = 1 / box.mass;
    for (size_t axis = 0; axis < 3; ++axis) {
        body.inverse_moments[axis] = 1 / box.moments[axis];
        body.momentum[axis] = box.moments[axis] * box.spin[axis];
    }
    body.spin = box.spin;
    return body;
}

double radiusOf(const StackedBox& box) {
    double radius = 0;
    for (const Face& face : {box.bottom, box.top})
        for (const Point& corner : face)
            radius = std::max(radius, length(corner));
    return radius;
}

// Who is solved first where several contacts want a body: the places in the list, scrambled.
uint32_t bidOf(size_t contact) { return (static_cast<uint32_t>(contact) * 0x9e3779b1u) & 0x7fffffffu; }

} // namespace

RigidStack::RigidStack(const std::vector<StackedBox>& boxes, const StackSettings& settings) : settings_(settings) {
    const double h = settings.dt / settings.substeps, most = 0.125 / h;
    const double hertz = settings.contact_hertz > 0 ? std::min(settings.contact_hertz, most) : most;
    solve_.gravity = settings.gravity;
    solve_.seconds = h;
    solve_.soft = softnessOf(hertz, settings.contact_damping, h);
    solve_.stiff = softnessOf(2 * hertz, settings.contact_damping / 2, h);
    solve_.fastest_push = settings.push_out > 0 ? settings.push_out : 3;
    for (const StackedBox& box : boxes) {
        bodies_.push_back(bodyOf(box));
        radii_.push_back(radiusOf(box));
    }
    first_ = bodies_;
    findContacts(boxes);
    colorContacts();
    letSpeedsLag();
}

// Of what touches nothing, by half a substep.
void RigidStack::letSpeedsLag() {
    for (size_t b = 0; b < bodies_.size(); ++b) {
        const bool touches = std::ranges::any_of(contacts_, [b](const SoftContact& c) { return c.a == b || c.b == b; });
        if (bodies_[b].moves() && !touches) bodies_[b].velocity = bodies_[b].velocity - (0.5 * solve_.seconds) * solve_.gravity;
    }
}

void RigidStack::findContacts(const std::vector<StackedBox>& boxes) {
    for (size_t a = 0; a < boxes.size(); ++a)
        for (size_t b = a + 1; b < boxes.size(); ++b) {
            SoftContact contact;
            contact.a = a;
            contact.b = b;
            contact.color = kNone;
            if (!findContact(boxes[a], boxes[b], settings_.margin, contact)) continue;
            contacts_.push_back(contact);
        }
}

bool RigidStack::share(const SoftContact& c, const SoftContact& d) const {
    const auto has = [&](size_t body) { return bodies_[body].moves() && (d.a == body || d.b == body); };
    return has(c.a) || has(c.b);
}

// The lowest color that no contact has that shares a body with this one.
size_t RigidStack::lowestColor(const SoftContact& mine) const {
    size_t color = 0;
    while (std::ranges::any_of(contacts_, [&](const SoftContact& c) { return c.color == color && share(c, mine); }))
        ++color;
    return color;
}

// In rounds: a contact whose bid is the lowest on both of its bodies takes a color.
void RigidStack::colorContacts() {
    const auto waits = [](const SoftContact& c) { return c.color == kNone; };
    while (std::ranges::any_of(contacts_, waits)) {
        std::vector<size_t> winners;
        for (size_t k = 0; k < contacts_.size(); ++k) {
            bool won = waits(contacts_[k]);
            for (size_t other = 0; other < contacts_.size(); ++other)
                won = won && !(waits(contacts_[other]) && share(contacts_[other], contacts_[k]) && bidOf(other) < bidOf(k));
            if (won) winners.push_back(k);
        }
        for (const size_t k : winners)
            contacts_[k].color = lowestColor(contacts_[k]);
    }
}

void RigidStack::solveAll(bool with_push) {
    size_t colors = 0;
    for (const SoftContact& c : contacts_)
        colors = std::max(colors, c.color + 1);
    for (size_t color = 0; color < colors; ++color)
        for (SoftContact& c : contacts_)
            if (c.color == color) c.solve(bodies_[c.a], bodies_[c.b], solve_, with_push);
}

void RigidStack::substep() {
    for (RigidBody& body : bodies_)
        if (body.moves()) body.velocity = body.velocity + solve_.seconds * solve_.gravity;
    for (const SoftContact& c : contacts_)
        c.applyAgain(bodies_[c.a], bodies_[c.b]);
    solveAll(true);
    for (RigidBody& body : bodies_)
        body.moveFor(solve_.seconds);
    solveAll(false);
    // In the first substep of all, friction needs more sweeps.
    for (int sweep = 0; sweep < 8 && !has_settled_; ++sweep)
        solveAll(false);
    has_settled_ = true;
}

void RigidStack::step() {
    for (RigidBody& body : bodies_)
        body.beginStep();
    for (SoftContact& c : contacts_)
        c.beginStep(bodies_[c.a], bodies_[c.b]);
    for (uint32_t k = 0; k < settings_.substeps; ++k)
        substep();
    for (RigidBody& body : bodies_)
        body.endStep();
}

// By no more than 3 % of the smaller one and 5 cm. Turning of either body counts in full, which asks for more than the world.
bool RigidStack::hardlyMoved() const {
    return std::ranges::all_of(contacts_, [&](const SoftContact& c) {
        const Point way = bodies_[c.b].place - first_[c.b].place - (bodies_[c.a].place - first_[c.a].place);
        const double angle = angleBetween(bodies_[c.a].turn, kNoTurn) + angleBetween(bodies_[c.b].turn, kNoTurn);
        const double smaller = std::min(radii_[c.a], radii_[c.b]), reach = length(first_[c.b].place - first_[c.a].place);
        return length(way) + angle * (smaller + reach) < std::min(0.05, 0.03 * smaller);
    });
}

} // namespace reference
