// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace bathyal::geometry {

/// A signed integer of up to 8 704 bits without the heap, for the predicates' last resort: the
/// difference of any two finite doubles, over the smallest of them, has at most 2 100 bits, and the
/// in-circle test is of degree four in it.
class BigInteger {
 public:
  BigInteger() = default;

  /// ±mantissa · 2^shift, mantissa not 0.
  BigInteger(std::uint64_t mantissa, unsigned shift, bool negative) : negative_(negative) {
    const unsigned limb = shift / 64, bit = shift % 64;
    for (; size_ < static_cast<int>(limb); ++size_) limbs_[size_] = 0;
    limbs_[size_++] = mantissa << bit;
    if (bit != 0) limbs_[size_++] = mantissa >> (64 - bit);
    trim();
  }

  BigInteger(const BigInteger& other) : size_(other.size_), negative_(other.negative_) {
    for (int i = 0; i < size_; ++i) limbs_[i] = other.limbs_[i];
  }
  BigInteger& operator=(const BigInteger&) = delete;

  int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    return sum(a, b, b.negative_);
  }

  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) {
    return sum(a, b, !b.negative_);
  }

  friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    BigInteger product;
    product.size_ = a.size_ + b.size_;
    product.negative_ = a.negative_ != b.negative_;
    for (int i = 0; i < product.size_; ++i) product.limbs_[i] = 0;
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        const Wide term = Wide{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j] + carry;
        product.limbs_[i + j] = static_cast<std::uint64_t>(term);
        carry = static_cast<std::uint64_t>(term >> 64U);
      }
      product.limbs_[i + b.size_] = carry;
    }
    product.trim();
    return product;
  }

 private:
  __extension__ using Wide = unsigned __int128;

  static BigInteger sum(const BigInteger& a, const BigInteger& b, bool b_negative) {
    BigInteger result;
    if (a.negative_ == b_negative) {
      result.negative_ = b_negative;
      result.set_sum(a, b);
    } else if (smaller(a, b)) {
      result.negative_ = b_negative;
      result.set_difference(b, a);
    } else {
      result.negative_ = a.negative_;
      result.set_difference(a, b);
    }
    return result;
  }

  /// |a| < |b|
  static bool smaller(const BigInteger& a, const BigInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_;
    for (int i = a.size_ - 1; i >= 0; --i) {
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i];
    }
    return false;
  }

  void set_sum(const BigInteger& a, const BigInteger& b) {
    const int longest = a.size_ > b.size_ ? a.size_ : b.size_;
    std::uint64_t carry = 0;
    for (int i = 0; i < longest; ++i) {
      const Wide term = Wide{a.limb(i)} + b.limb(i) + carry;
      limbs_[i] = static_cast<std::uint64_t>(term);
      carry = static_cast<std::uint64_t>(term >> 64U);
    }
    limbs_[longest] = carry;
    size_ = longest + 1;
    trim();
  }

  /// |a| − |b| for |a| ≥ |b|
  void set_difference(const BigInteger& a, const BigInteger& b) {
    std::uint64_t borrow = 0;
    for (int i = 0; i < a.size_; ++i) {
      const Wide term = Wide{a.limbs_[i]} - b.limb(i) - borrow;
      limbs_[i] = static_cast<std::uint64_t>(term);
      borrow = static_cast<std::uint64_t>(term >> 64U) & 1U;
    }
    size_ = a.size_;
    trim();
  }

  std::uint64_t limb(int i) const { return i < size_ ? limbs_[i] : 0; }

  void trim() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }

  int size_ = 0;                          ///< limbs in use, the highest of them not 0
  bool negative_ = false;                 ///< without meaning for 0
  std::array<std::uint64_t, 136> limbs_;  ///< lowest first; set only below size_
};

}  // namespace bathyal::geometry
