// A shuffle of all numbers, a bijection: multiplications by odd numbers and shifted sums.
uint mixed(uint h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}
