// The budgets of a world, by the properties that set them.
#pragma once

#include "modules/brittle/brittle.h"

namespace brittle_godot {

struct BudgetProperty {
    const char* name;
    uint32_t BrittleBudget::*amount;
};

inline constexpr BudgetProperty kBudgets[] = {{"budget_pairs", &BrittleBudget::pairs},
                                              {"budget_contacts", &BrittleBudget::contacts},
                                              {"budget_fragments", &BrittleBudget::fragments},
                                              {"budget_fragment_faces", &BrittleBudget::fragment_faces},
                                              {"budget_fragment_triangles", &BrittleBudget::fragment_triangles},
                                              {"budget_most_fragments", &BrittleBudget::most_fragments},
                                              {"budget_breaking_bodies", &BrittleBudget::breaking_bodies},
                                              {"budget_breaking_sites", &BrittleBudget::breaking_sites},
                                              {"budget_breaking_triangles", &BrittleBudget::breaking_triangles},
                                              {"budget_dust", &BrittleBudget::dust}};

} // namespace brittle_godot
