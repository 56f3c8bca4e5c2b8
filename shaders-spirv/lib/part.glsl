// Cavities and joined films are parts of another component's fragment.
bool isPart(uint fate) { return fate == FATE_CAVITY || fate >= FATE_JOINED; }
