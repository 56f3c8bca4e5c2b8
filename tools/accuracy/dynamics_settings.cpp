#include "tools/accuracy/dynamics_settings.h"

namespace accuracy {
namespace {

using brittle::StepSettings;

constexpr uint32_t kPairs = kPile | kStack;

constexpr DynamicsSetting kSettings[] = {
    {"default", "dt 1/60 s, 4 substeps, 1 iteration, all axes, ccd as the scene has it, recycling",
     "Nothing: it is what scenes have that say nothing else.", kAllScenes, [](StepSettings&) {}},
    {"dt", "1/30 s", "What is fast is seen half as often: contacts are found late, bounces lose height.", kAllScenes,
     [](StepSettings& s) { s.dt = 1.0 / 30; }},
    {"dt", "1/120 s", "Time.", kAllScenes, [](StepSettings& s) { s.dt = 1.0 / 120; }},
    {"dt", "1/240 s", "Time.", kAllScenes & ~kWindow, [](StepSettings& s) { s.dt = 1.0 / 240; }},
    {"substeps", "1", "Stiffness: contacts are four times softer in time, stacks sink and sway.", kAllScenes,
     [](StepSettings& s) { s.substeps = 1; }},
    {"substeps", "2", "Some stiffness of contacts.", kAllScenes & ~kWindow, [](StepSettings& s) { s.substeps = 2; }},
    {"substeps", "8", "Time.", kAllScenes, [](StepSettings& s) { s.substeps = 8; }},
    {"substeps", "16", "Time.", kPairs, [](StepSettings& s) { s.substeps = 16; }},
    {"iterations", "2", "Time.", kContactScenes, [](StepSettings& s) { s.iterations = 2; }},
    {"iterations", "4", "Time.", kPairs, [](StepSettings& s) { s.iterations = 4; }},
    {"recycling", "off", "Points of contact are found anew in every step, and what stands may creep.", kContactScenes | kWindow,
     [](StepSettings& s) { s.recycling = false; }},
    {"axes", "62 fixed", "Corners that meet askew: hulls are parted along the nearest of 62 directions, often too early.",
     kPairs, [](StepSettings& s) { s.fixed_axes = 62; }},
    {"axes", "26 fixed", "Directions of contacts: the nearest of 26, so bodies rest askew or on air.", kContactScenes,
     [](StepSettings& s) { s.fixed_axes = 26; }},
    {"axes", "14 fixed", "Directions of contacts: the nearest of 14.", kPairs, [](StepSettings& s) { s.fixed_axes = 14; }},
    {"axes", "6 fixed", "Directions of contacts: bodies collide as their boxes do.", kPairs,
     [](StepSettings& s) { s.fixed_axes = 6; }},
    {"ccd", "off", "What is fast for its size flies through what it meets aslant or spinning.", kShot | kBounce,
     [](StepSettings& s) { s.ccd = false; }},
    {"ccd", "on", "Time.", kPairs, [](StepSettings& s) { s.ccd = true; }},
    {"sleeping", "on", "The last slow motion: what has come to rest is held there until it is touched.", kPile,
     [](StepSettings& s) { s.sleeping = true; }},
    {"sleeping", "off", "Time.", kStack, [](StepSettings& s) { s.sleeping = false; }},
    {"dt and substeps", "1/30 s, 8", "As many substeps a second as the default, but contacts are found half as often.",
     kContactScenes | kWindow,
     [](StepSettings& s) {
         s.dt = 1.0 / 30;
         s.substeps = 8;
     }},
    {"dt and substeps", "1/120 s, 2", "Time: as many substeps a second, contacts are found twice as often.", kContactScenes,
     [](StepSettings& s) {
         s.dt = 1.0 / 120;
         s.substeps = 2;
     }},
    {"dt and substeps", "1/240 s, 1", "Time: as many substeps a second, contacts are found anew in each.", kContactScenes,
     [](StepSettings& s) {
         s.dt = 1.0 / 240;
         s.substeps = 1;
     }},
    {"substeps and iterations", "1, 4", "Stiffness: as many solves, all of them at the end of the step.", kPairs,
     [](StepSettings& s) {
         s.substeps = 1;
         s.iterations = 4;
     }},
    {"substeps and iterations", "2, 2", "Some stiffness: as many solves, half of the substeps.", kPairs,
     [](StepSettings& s) {
         s.substeps = 2;
         s.iterations = 2;
     }},
    {"recycling and substeps", "off, 8", "Time, and points of contact that are kept.", kPairs,
     [](StepSettings& s) {
         s.recycling = false;
         s.substeps = 8;
     }},
};

} // namespace

std::span<const DynamicsSetting> dynamicsSettings() { return kSettings; }

} // namespace accuracy
