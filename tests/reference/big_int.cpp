#include "tests/reference/big_int.h"

#include <algorithm>

namespace reference {

BigInt::BigInt(int64_t value) {
    limbs_.fill(value < 0 ? ~0u : 0u);
    limbs_[0] = static_cast<uint32_t>(value);
    limbs_[1] = static_cast<uint32_t>(value >> 32);
}

__extension__ BigInt BigInt::fromWide(__int128 value) {
    const uint64_t words[2] = {static_cast<uint64_t>(value), static_cast<uint64_t>(value >> 64)};
    return fromWords(words, 2);
}

BigInt BigInt::fromWords(const uint64_t* words, size_t count) {
    BigInt result(static_cast<int64_t>(words[count - 1]) < 0 ? -1 : 0);
    for (size_t k = 0; k < 2 * count; ++k)
        result.limbs_[k] = static_cast<uint32_t>(words[k / 2] >> (32 * (k % 2)));
    return result;
}

BigInt BigInt::operator-() const {
    BigInt flipped;
    for (size_t k = 0; k < kLimbs; ++k)
        flipped.limbs_[k] = ~limbs_[k];
    return flipped + BigInt(1);
}

BigInt BigInt::operator+(const BigInt& other) const {
    BigInt sum;
    uint64_t carry = 0;
    for (size_t k = 0; k < kLimbs; ++k) {
        carry += uint64_t{limbs_[k]} + other.limbs_[k];
        sum.limbs_[k] = static_cast<uint32_t>(carry);
        carry >>= 32;
    }
    return sum;
}

// Schoolbook, modulo 2^256.
BigInt BigInt::operator*(const BigInt& other) const {
    BigInt product;
    for (size_t i = 0; i < kLimbs; ++i) {
        uint64_t carry = 0;
        for (size_t j = 0; i + j < kLimbs; ++j) {
            carry += uint64_t{limbs_[i]} * other.limbs_[j] + product.limbs_[i + j];
            product.limbs_[i + j] = static_cast<uint32_t>(carry);
            carry >>= 32;
        }
    }
    return product;
}

int BigInt::sign() const {
    if (limbs_[kLimbs - 1] >> 31 != 0) return -1;
    return std::any_of(limbs_.begin(), limbs_.end(), [](uint32_t limb) { return limb != 0; }) ? 1 : 0;
}

uint64_t BigInt::word(size_t k) const { return limbs_[2 * k] | (uint64_t{limbs_[2 * k + 1]} << 32); }

} // namespace reference
