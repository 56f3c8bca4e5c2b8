// The resource BrittleMaterial: a card of numbers in SI units that bodies break by, and what faces of cuts look like.
#pragma once

#include "modules/brittle/brittle.h"
#include "modules/brittle/godot/interface/class_record.h"

namespace brittle_godot {

class MaterialResource final : public Instance {
public:
    static void describe(ClassRecord& record);

    BrittleMaterialDef def = brittleDefaultMaterialDef(); // but for `like`; what is 0 is as in the built-in one
    std::string like = "glass";
    Value cut_material; // a Material of the engine's for faces of cuts, or null: as outside
};

} // namespace brittle_godot
