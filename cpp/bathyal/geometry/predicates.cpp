// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/predicates.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "bathyal/geometry/internal/big_integer.hpp"

namespace bathyal::exact {
namespace {

using geometry::BigInteger;

__extension__ using Int128 = __int128;

int sign_of(Int128 value) { return (value > 0) - (value < 0); }

// ---- The quick way: differences that are whole multiples of one power of two, as those of survey
// ---- coordinates and grids are, compared as integers.

/// Sets `difference` to a − b and says whether that is exact (Dekker's two-sum).
bool subtract_exactly(double a, double b, double& difference) {
  difference = a - b;
  const double b_virtual = a - difference;
  const double a_virtual = difference + b_virtual;
  return (a - a_virtual) + (b_virtual - b) == 0.0;
}

/// 2^exponent for a normal result.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

/// The values over their largest common power of two; false when they do not fit in 62 bits.
template <std::size_t N>
bool to_integers(const std::array<double, N>& values, std::array<std::int64_t, N>& integers) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  integers.fill(0);
  if (largest == 0.0) return true;
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52U) - 1023;
  if (exponent < -900 || exponent > 900) return false;
  const double up = power_of_two(61 - exponent);
  const double down = power_of_two(exponent - 61);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < N; ++i) {
    integers[i] = static_cast<std::int64_t>(values[i] * up);
    if (static_cast<double>(integers[i]) * down != values[i]) return false;
    bits |= static_cast<std::uint64_t>(integers[i]);
  }
  const int shift = std::countr_zero(bits);
  for (std::int64_t& integer : integers) integer >>= shift;
  return true;
}

template <std::size_t N>
bool fit_in_30_bits(const std::array<std::int64_t, N>& integers) {
  std::uint64_t bits = 0;
  for (const std::int64_t integer : integers) bits |= static_cast<std::uint64_t>(std::abs(integer));
  return bits >> 30U == 0;
}

/// A sum of products of 126-bit numbers, up to four of them, in two's complement.
class Int256 {
 public:
  void add_product(Int128 a, Int128 b) {
    const bool negative = (a < 0) != (b < 0);
    const Unsigned x = a < 0 ? -static_cast<Unsigned>(a) : static_cast<Unsigned>(a);
    const Unsigned y = b < 0 ? -static_cast<Unsigned>(b) : static_cast<Unsigned>(b);
    const Unsigned x0 = low(x), x1 = x >> 64U, y0 = low(y), y1 = y >> 64U;
    const Unsigned p00 = x0 * y0, p01 = x0 * y1, p10 = x1 * y0, p11 = x1 * y1;
    const Unsigned middle = (p00 >> 64U) + low(p01) + low(p10);
    const Unsigned low_half = (middle << 64U) | low(p00);
    const Unsigned high_half = p11 + (p01 >> 64U) + (p10 >> 64U) + (middle >> 64U);
    const Unsigned before = low_;
    if (negative) {
      low_ -= low_half;
      high_ -= high_half + (low_half > before ? 1U : 0U);
    } else {
      low_ += low_half;
      high_ += high_half + (low_ < before ? 1U : 0U);
    }
  }

  int sign() const {
    const auto high = static_cast<Int128>(high_);
    return high != 0 ? sign_of(high) : static_cast<int>(low_ != 0);
  }

 private:
  __extension__ using Unsigned = unsigned __int128;
  static Unsigned low(Unsigned value) { return static_cast<std::uint64_t>(value); }

  Unsigned low_ = 0;
  Unsigned high_ = 0;
};

int incircle_of_integers(const std::array<std::int64_t, 6>& v) {
  const auto lift = [&](int i) { return Int128{v[i]} * v[i] + Int128{v[i + 1]} * v[i + 1]; };
  const auto cross = [&](int i, int j) {
    return Int128{v[i]} * v[j + 1] - Int128{v[j]} * v[i + 1];
  };
  if (fit_in_30_bits(v)) {  // lifts and crosses below 2^61, the sum below 2^124
    return sign_of(lift(0) * cross(2, 4) + lift(2) * cross(4, 0) + lift(4) * cross(0, 2));
  }
  Int256 det;
  det.add_product(lift(0), cross(2, 4));
  det.add_product(lift(2), cross(4, 0));
  det.add_product(lift(4), cross(0, 2));
  return det.sign();
}

// ---- The general way: any finite doubles, as integers of any length.

/// The exponent of the last bit of a double's mantissa.
int last_bit_exponent(double value) {
  const int biased = static_cast<int>((std::bit_cast<std::uint64_t>(value) >> 52U) & 0x7ffU);
  return std::max(biased, 1) - 1075;
}

BigInteger scaled(double value, int unit_exponent) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52U) - 1);
  const bool normal = ((bits >> 52U) & 0x7ffU) != 0;
  const std::uint64_t mantissa = fraction | (static_cast<std::uint64_t>(normal) << 52U);
  if (mantissa == 0) return {};
  return {mantissa, static_cast<unsigned>(last_bit_exponent(value) - unit_exponent), value < 0};
}

/// The last bit's exponent of the coordinate that reaches down furthest; zeros are left out.
template <std::size_t N>
int common_unit(const std::array<Point2, N>& points) {
  int exponent = std::numeric_limits<int>::max();
  for (const Point2& p : points) {
    if (p.x != 0.0) exponent = std::min(exponent, last_bit_exponent(p.x));
    if (p.y != 0.0) exponent = std::min(exponent, last_bit_exponent(p.y));
  }
  return exponent;
}

int general_orient2d(const Point2& a, const Point2& b, const Point2& c) {
  const int unit = common_unit(std::array{a, b, c});
  const BigInteger cx = scaled(c.x, unit), cy = scaled(c.y, unit);
  const BigInteger left = (scaled(a.x, unit) - cx) * (scaled(b.y, unit) - cy);
  const BigInteger right = (scaled(a.y, unit) - cy) * (scaled(b.x, unit) - cx);
  return (left - right).sign();
}

/// The sign of det(a − d, b − d, c − d), of coordinates over one power of two.
int general_orient3d(const std::array<Point3, 4>& points) {
  int unit = std::numeric_limits<int>::max();
  for (const Point3& p : points) {
    for (const double value : {p.x, p.y, p.z}) {
      if (value != 0.0) unit = std::min(unit, last_bit_exponent(value));
    }
  }
  const auto& [a, b, c, d] = points;
  const BigInteger dx = scaled(d.x, unit), dy = scaled(d.y, unit), dz = scaled(d.z, unit);
  const BigInteger ax = scaled(a.x, unit) - dx, ay = scaled(a.y, unit) - dy;
  const BigInteger bx = scaled(b.x, unit) - dx, by = scaled(b.y, unit) - dy;
  const BigInteger cx = scaled(c.x, unit) - dx, cy = scaled(c.y, unit) - dy;
  const BigInteger det = (scaled(a.z, unit) - dz) * (bx * cy - cx * by) +
                         (scaled(b.z, unit) - dz) * (cx * ay - ax * cy) +
                         (scaled(c.z, unit) - dz) * (ax * by - bx * ay);
  return det.sign();
}

int general_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const int unit = common_unit(std::array{a, b, c, d});
  const BigInteger dx = scaled(d.x, unit), dy = scaled(d.y, unit);
  const BigInteger ax = scaled(a.x, unit) - dx, ay = scaled(a.y, unit) - dy;
  const BigInteger bx = scaled(b.x, unit) - dx, by = scaled(b.y, unit) - dy;
  const BigInteger cx = scaled(c.x, unit) - dx, cy = scaled(c.y, unit) - dy;
  const BigInteger det = (ax * ax + ay * ay) * (bx * cy - cx * by) +
                         (bx * bx + by * by) * (cx * ay - ax * cy) +
                         (cx * cx + cy * cy) * (ax * by - bx * ay);
  return det.sign();
}

}  // namespace

int orient2d(const Point2& a, const Point2& b, const Point2& c) {
  std::array<double, 4> d;
  std::array<std::int64_t, 4> v;
  const bool exact = subtract_exactly(a.x, c.x, d[0]) & subtract_exactly(a.y, c.y, d[1]) &
                     subtract_exactly(b.x, c.x, d[2]) & subtract_exactly(b.y, c.y, d[3]);
  if (!exact || !to_integers(d, v)) return general_orient2d(a, b, c);
  return sign_of(Int128{v[0]} * v[3] - Int128{v[1]} * v[2]);
}

int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  // Flat along an axis, as so many faces of drawn hulls are.
  if (a.x == d.x && b.x == d.x && c.x == d.x) return 0;
  if (a.y == d.y && b.y == d.y && c.y == d.y) return 0;
  if (a.z == d.z && b.z == d.z && c.z == d.z) return 0;
  return -general_orient3d({a, b, c, d});
}

int incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  std::array<double, 6> e;
  std::array<std::int64_t, 6> v;
  const bool exact = subtract_exactly(a.x, d.x, e[0]) & subtract_exactly(a.y, d.y, e[1]) &
                     subtract_exactly(b.x, d.x, e[2]) & subtract_exactly(b.y, d.y, e[3]) &
                     subtract_exactly(c.x, d.x, e[4]) & subtract_exactly(c.y, d.y, e[5]);
  if (!exact || !to_integers(e, v)) return general_incircle(a, b, c, d);
  return incircle_of_integers(v);
}

int perturbed_incircle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const int sign = exact::incircle(a, b, c, d);
  if (sign != 0) return sign;
  // Co-circular. The last point is raised the most: d itself leaves the circle; a corner lifts the
  // plane of a, b, c on its own side of the other two corners, and d is inside when it lies there.
  const Point2* last = &a;
  for (const Point2* p : {&b, &c, &d}) {
    if (before(*last, *p)) last = p;
  }
  if (last == &d) return -1;
  if (last == &c) return bathyal::orient2d(a, b, d);
  if (last == &b) return bathyal::orient2d(a, d, c);
  return bathyal::orient2d(d, b, c);
}

}  // namespace bathyal::exact
