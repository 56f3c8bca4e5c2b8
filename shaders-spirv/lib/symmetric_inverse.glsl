// The inverse of a symmetric matrix whose eigenvalues are all positive, column by column (Gauss and Jordan); such a matrix needs
// no pivots. GLSL's own works by minors: where columns are nearly alike these are small differences of large products, and what
// comes out of it may be too large by any factor.
mat4 symmetricInverse(mat4 m) {
    mat4 found = mat4(1.0);
    [[unroll]] for (uint k = 0u; k < 4u; k++) {
        float scale = 1.0 / m[k][k];
        m[k] *= scale;
        found[k] *= scale;
        [[unroll]] for (uint j = 0u; j < 4u; j++) {
            float share = j == k ? 0.0 : m[j][k];
            m[j] -= share * m[k];
            found[j] -= share * found[k];
        }
    }
    return found;
}
