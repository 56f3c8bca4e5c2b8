// Whether a cell is too small to be a body. `volume` in cubes of half a grid's edge, `scale` how many of these there are in a meter:
// a power of two, so that every kernel that asks comes to the same answer.
bool isTooSmall(float volume, float scale, float least_volume) { return volume < least_volume * (scale * scale * scale); }
