// Sixteen buffers, as many as a device has to have.
#version 450
layout(local_size_x = 1) in;
#define WORD(slot) layout(set = 0, binding = slot, std430) readonly buffer Word##slot { uint word##slot; }
WORD(0);
WORD(1);
WORD(2);
WORD(3);
WORD(4);
WORD(5);
WORD(6);
WORD(7);
WORD(8);
WORD(9);
WORD(10);
WORD(11);
WORD(12);
WORD(13);
WORD(14);
layout(set = 0, binding = 15, std430) writeonly buffer Sum { uint sum; };

void main() {
    sum = word0 + word1 + word2 + word3 + word4 + word5 + word6 + word7 + word8 + word9 + word10 + word11 + word12 + word13 + word14;
}
