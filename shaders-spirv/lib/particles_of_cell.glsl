// How many particles a cell becomes that is too small for a body: one for each part of the largest such cell, and one at least.
uint particlesOfCell(float volume, float scale, float least_volume) {
    float parts = ceil(volume * float(MOST_PARTICLES_OF_A_CELL) / (least_volume * (scale * scale * scale)));
    return clamp(uint(parts), 1u, uint(MOST_PARTICLES_OF_A_CELL));
}
