// Whether a body is of an island that one workgroup steps on its own (solve_islands). A blow may leave a body of such an island
// without a contact to solve: then it is not.
//
// Wants `islands` and `island_contacts`, as color_contacts leaves them, `adjacency_start`, and lib/effect.glsl's contacts declared.
bool hasContacts(uint body) { return kContacts != 0u && adjacency_start[body] < adjacency_start[body + 1u]; }

bool isApart(uint body) { return hasContacts(body) && island_contacts[islands[body]] != NO_INDEX; }
