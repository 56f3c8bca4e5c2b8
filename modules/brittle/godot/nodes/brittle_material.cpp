#include "modules/brittle/godot/nodes/brittle_material.h"

#include "modules/brittle/godot/nodes/field_property.h"

namespace brittle_godot {
namespace {

using M = MaterialResource;

} // namespace

void MaterialResource::describe(ClassRecord& r) {
    r.property(
        "like", Type::String, {kHintEnum, "glass,porcelain,concrete,brick,ice,stone"},
        [](Instance& i, const Value& v) { static_cast<M&>(i).like = v.asString(); },
        [](Instance& i) { return Value(std::string_view(static_cast<M&>(i).like)); });
    resourceProperty<M>(r, "cut_material", "Material", [](M& m) -> Value& { return m.cut_material; });
    r.group("Own values, 0: as in the one above");
    numberProperty<M>(r, "density", "0,20000,1,or_greater,suffix:kg/m³", [](M& m) -> double& { return m.def.density; });
    numberProperty<M>(r, "youngs_modulus", "0,1e12,1e6,or_greater,exp,suffix:Pa",
                      [](M& m) -> double& { return m.def.youngs_modulus; });
    numberProperty<M>(r, "poisson_ratio", "0,0.499,0.001", [](M& m) -> double& { return m.def.poisson_ratio; });
    numberProperty<M>(r, "fracture_energy", "0,10000,0.01,or_greater,exp,suffix:J/m²",
                      [](M& m) -> double& { return m.def.fracture_energy; });
    numberProperty<M>(r, "tensile_strength", "0,1e9,1000,or_greater,exp,suffix:Pa",
                      [](M& m) -> double& { return m.def.tensile_strength; });
    numberProperty<M>(r, "weibull_modulus", "0,50,0.1,or_greater", [](M& m) -> double& { return m.def.weibull_modulus; });
    numberProperty<M>(r, "reference_volume", "0,1,0.000001,or_greater,exp,suffix:m³",
                      [](M& m) -> double& { return m.def.reference_volume; });
    numberProperty<M>(r, "eta", "0,1,0.001", [](M& m) -> double& { return m.def.eta; });
    numberProperty<M>(r, "smallest_cell", "0,1,0.0001,or_greater,suffix:m",
                      [](M& m) -> double& { return m.def.smallest_cell; });
}

} // namespace brittle_godot
