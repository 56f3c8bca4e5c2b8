// Whole numbers of 256 bits in two's complement: enough for every predicate (178 bits), and simple enough to be trusted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reference {

class BigInt {
public:
    BigInt(int64_t value = 0); // implicit, so that formulas read as they do on paper
    __extension__ static BigInt fromWide(__int128 value);
    static BigInt fromWords(const uint64_t* words, size_t count); // two's complement, low word first

    BigInt operator-() const;
    BigInt operator+(const BigInt& other) const;
    BigInt operator-(const BigInt& other) const { return *this + -other; }
    BigInt operator*(const BigInt& other) const;
    bool operator==(const BigInt&) const = default;
    bool operator<(const BigInt& other) const { return (*this - other).sign() < 0; }

    int sign() const;
    uint64_t word(size_t k) const; // of 64 bits, k < 4

private:
    static constexpr size_t kLimbs = 8;
    std::array<uint32_t, kLimbs> limbs_{};
};

} // namespace reference
