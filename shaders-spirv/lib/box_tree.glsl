// A tree over boxes that stand in order, with four children to a node and no links: the node of level L that begins with leaf p
// holds the leaves p to p + 2^L - 1, L even. Leaves come first, then the inner nodes, each of which lies in the middle of those
// below it, so that no level needs to know how long the others are. A walk starts somewhere and goes right only, where p > 0;
// then 2^L <= p, and as many places for inner nodes as leaves are enough. The nodes that begin with leaf 0 are made only as far
// as others are made of them.
//
// In a node, w of low is the body that all its pieces belong to or NO_BODY; w of high, in a leaf, is the piece.
// Wants box_capacity, the room for leaves.
uint nodeAt(uint p, uint level) { return level == 0u ? p : box_capacity + 2u * (p >> 2) + ((1u << level) >> 2) - 1u; }

// The largest node that begins with leaf p.
uint levelAt(uint p) { return uint(findLSB(p)) & ~1u; }
