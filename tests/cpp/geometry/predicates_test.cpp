// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bathyal/base/random.hpp"
#include "bathyal/geometry/internal/big_integer.hpp"

namespace bathyal {
namespace {

__extension__ using Int128 = __int128;

int sign_of(Int128 value) { return (value > 0) - (value < 0); }

/// A point of whole multiples of some unit, small enough for 128 bits to hold every determinant.
struct Whole {
  std::int64_t x, y;
};

int orient(const Whole& a, const Whole& b, const Whole& c) {
  return sign_of(Int128{a.x - c.x} * (b.y - c.y) - Int128{a.y - c.y} * (b.x - c.x));
}

/// Cofactors along another row than the code under test takes.
int in_circle(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  const auto lift = [](const Whole& p) { return Int128{p.x} * p.x + Int128{p.y} * p.y; };
  const auto det3 = [&](const Whole& p, const Whole& q, const Whole& r) {
    return Int128{p.x} * (q.y * lift(r) - r.y * lift(q)) -
           Int128{p.y} * (q.x * lift(r) - r.x * lift(q)) +
           lift(p) * (Int128{q.x} * r.y - Int128{r.x} * q.y);
  };
  const auto from = [&](const Whole& p) { return Whole{p.x - d.x, p.y - d.y}; };
  return sign_of(det3(from(a), from(b), from(c)));
}

std::int64_t draw(RandomStream& random, std::int64_t span) {
  return static_cast<std::int64_t>(random.next() % static_cast<std::uint64_t>(2 * span + 1)) - span;
}

struct Place {
  double unit, x, y;  ///< point = (x, y) + unit · whole
};

/// Where x, y and unit are chosen so that every coordinate is exact.
constexpr std::array kPlaces{
    Place{1.0, 0.0, 0.0},        Place{0x1.0p-30, 620152.875, 7246504.9375},
    Place{0x1.0p-26, 1e7, -1e7}, Place{0x1.0p200, 0.0, 0.0},
    Place{0x1.0p-200, 0.0, 0.0}, Place{0x1.0p-60, 0.0, 0.0}};

Point2 at(const Place& place, const Whole& p) {
  return {place.x + place.unit * static_cast<double>(p.x),
          place.y + place.unit * static_cast<double>(p.y)};
}

TEST(Predicates, AgreeWithWholeNumbersWhereTiesAreCommon) {
  for (const Place& place : kPlaces) {
    for (const std::int64_t span : {2, 10, 1000, 1000000}) {
      RandomStream random(7, static_cast<std::uint64_t>(span));
      int ties = 0;
      for (int i = 0; i < 20000; ++i) {
        std::array<Whole, 4> w;
        for (Whole& p : w) p = {draw(random, span), draw(random, span)};
        if (i % 4 == 1) w[3] = {w[0].x + w[1].x - w[2].x, w[0].y + w[1].y - w[2].y};
        if (i % 4 == 2) w[2] = {2 * w[1].x - w[0].x, 2 * w[1].y - w[0].y};
        if (i % 4 == 3) w[2] = {w[0].x, w[1].y}, w[3] = {w[1].x, w[0].y};  // a rectangle
        std::array<Point2, 4> p;
        std::transform(w.begin(), w.end(), p.begin(), [&](const Whole& q) { return at(place, q); });
        ASSERT_EQ(orient2d(p[0], p[1], p[2]), orient(w[0], w[1], w[2]));
        ASSERT_EQ(incircle(p[0], p[1], p[2], p[3]), in_circle(w[0], w[1], w[2], w[3]));
        ties += incircle(p[0], p[1], p[2], p[3]) == 0;
      }
      EXPECT_GE(ties, 5000);
    }
  }
}

/// Moving one coordinate of a tie by its last bit decides it, and the sign is known.
TEST(Predicates, SeeTheLastBit) {
  for (const double offset : {0.1, 620152.873, 1e7, -3.3e6}) {
    const Point2 a{offset, offset}, b{offset + 4.0, offset + 4.0};
    const Point2 middle{a.x / 2 + b.x / 2, a.x / 2 + b.x / 2};
    EXPECT_EQ(orient2d(a, {b.x, b.x}, middle), 0);
    EXPECT_EQ(orient2d(a, {b.x, b.x}, {middle.x, std::nextafter(middle.y, INFINITY)}), 1);
    EXPECT_EQ(orient2d(a, {b.x, b.x}, {middle.x, std::nextafter(middle.y, -INFINITY)}), -1);
    const Point2 right{b.x, a.y}, left{a.x, b.y};
    EXPECT_EQ(incircle(a, right, b, left), 0);
    EXPECT_EQ(incircle(a, right, b, {left.x, std::nextafter(left.y, -INFINITY)}), 1);
    EXPECT_EQ(incircle(a, right, b, {left.x, std::nextafter(left.y, INFINITY)}), -1);
  }
}

/// Whole numbers over 128 bits are the truth; one in four lies in the plane of the other three.
TEST(Predicates, Orient3dAgreesWithWholeNumbers) {
  struct Whole3 {
    std::int64_t x, y, z;
  };
  const auto truth = [](const std::array<Whole3, 4>& w) {
    std::array<Int128, 9> m;
    for (std::size_t i = 0; i < 3; ++i) {
      m[3 * i] = w[i].x - w[3].x;
      m[3 * i + 1] = w[i].y - w[3].y;
      m[3 * i + 2] = w[i].z - w[3].z;
    }
    return -sign_of(m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                    m[2] * (m[3] * m[7] - m[4] * m[6]));
  };
  for (const Place& place : kPlaces) {
    for (const std::int64_t span : {2, 1000, 1000000}) {
      RandomStream random(11, static_cast<std::uint64_t>(span));
      int ties = 0;
      for (int i = 0; i < 5000; ++i) {
        std::array<Whole3, 4> w;
        for (Whole3& p : w) p = {draw(random, span), draw(random, span), draw(random, span)};
        if (i % 4 == 1) {
          w[3] = {w[0].x + w[1].x - w[2].x, w[0].y + w[1].y - w[2].y, w[0].z + w[1].z - w[2].z};
        }
        std::array<Point3, 4> p;
        std::transform(w.begin(), w.end(), p.begin(), [&](const Whole3& q) {
          const Point2 xy = at(place, {q.x, q.y});
          return Point3{xy.x, xy.y, place.x + place.unit * static_cast<double>(q.z)};
        });
        ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), truth(w));
        ASSERT_EQ(orient3d(p[1], p[0], p[2], p[3]), -truth(w));
        ASSERT_EQ(orient3d(p[3], p[1], p[2], p[0]), -truth(w));
        ties += truth(w) == 0;
      }
      EXPECT_GE(ties, 1250);
    }
  }
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}, {5, 7, 0.1}), 0);
  const double up = std::nextafter(0.1, 1.0);
  EXPECT_EQ(orient3d({0, 0, 0.1}, {1e6, 0, 0.1}, {0, 1e6, 0.1}, {5, 7, up}), 1);
}

/// Coordinates of very different size need more bits than the quick integers have.
TEST(Predicates, AreExactOverTheWholeRange) {
  const double tiny = 0x1.0p-1074, huge = 1e75;
  EXPECT_EQ(orient2d({0, 0}, {huge, huge}, {tiny, tiny}), 0);
  EXPECT_EQ(orient2d({0, 0}, {huge, huge}, {tiny, 2 * tiny}), 1);
  EXPECT_EQ(orient2d({-huge, -huge}, {huge, huge}, {tiny, 0}), -1);
  EXPECT_EQ(orient2d({0, 0}, {tiny, 0}, {0, tiny}), 1);
  EXPECT_EQ(incircle({-huge, 0}, {0, -huge}, {huge, 0}, {0, huge}), 0);
  EXPECT_EQ(incircle({-huge, 0}, {0, -huge}, {huge, 0}, {tiny, huge}), -1);
  EXPECT_EQ(incircle({-huge, 0}, {0, -huge}, {huge, tiny}, {0, huge}), 1);
  EXPECT_EQ(incircle({0, 0}, {tiny, 0}, {0, tiny}, {tiny, tiny}), 0);
  EXPECT_EQ(incircle({0, 0}, {2 * tiny, 0}, {0, 2 * tiny}, {tiny, tiny}), 1);
  EXPECT_EQ(incircle({1, 0}, {0, 1}, {-1, 0}, {1e-30, -1}), -1);
  EXPECT_EQ(incircle({1, 0}, {0, 1}, {-1, 0}, {0, -1}), 0);
  EXPECT_EQ(incircle({1, 1e-30}, {0, 1}, {-1, 0}, {0, -1}), 1);
}

/// Near-degenerate doubles without a common grid: exchanging points changes the sign and nothing
/// else, which rounding would not respect, and the quick stages agree with plain long integers.
TEST(Predicates, ChangeSignWithTheOrderOfPoints) {
  RandomStream random(3);
  int near = 0;
  for (int i = 0; i < 20000; ++i) {
    std::array<Point2, 4> p;
    for (Point2& q : p) {
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      q = {std::cos(angle), std::sin(angle)};
    }
    const int sign = incircle(p[0], p[1], p[2], p[3]);
    near += std::fabs(exact::Incircle(p[0], p[1], p[2], p[3]).det) < 1e-15;
    EXPECT_EQ(incircle(p[1], p[0], p[2], p[3]), -sign);
    EXPECT_EQ(incircle(p[1], p[2], p[0], p[3]), sign);
    EXPECT_EQ(incircle(p[3], p[1], p[2], p[0]), -sign);
    EXPECT_EQ(incircle(p[2], p[3], p[0], p[1]), sign);
    const Point2 on{(p[0].x + p[1].x) / 2, (p[0].y + p[1].y) / 2};
    const int turn = orient2d(p[0], p[1], on);
    EXPECT_EQ(orient2d(p[1], p[0], on), -turn);
    EXPECT_EQ(orient2d(on, p[0], p[1]), turn);
    EXPECT_EQ(orient2d(p[1], on, p[0]), turn);
  }
  EXPECT_GT(near, 15000);
}

/// Of the two diagonals of a square exactly one is Delaunay, in any order of the arguments.
TEST(Predicates, PerturbedTiesHaveOneAnswer) {
  const std::array<Point2, 4> square{Point2{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int turn = 0; turn < 4; ++turn) {
    const auto corner = [&](int i) { return square[static_cast<std::size_t>((turn + i) % 4)]; };
    const bool flips = in_perturbed_circle(corner(0), corner(1), corner(2), corner(3));
    EXPECT_EQ(flips, in_perturbed_circle(corner(2), corner(3), corner(0), corner(1)));
    EXPECT_NE(flips, in_perturbed_circle(corner(1), corner(2), corner(3), corner(0)));
    EXPECT_EQ(flips, in_perturbed_circle(corner(1), corner(2), corner(0), corner(3)));
  }
  // (1, 1) is the last of the four and lies above: it is in no circle of the others.
  EXPECT_FALSE(in_perturbed_circle({0, 0}, {1, 0}, {0, 1}, {1, 1}));
}

TEST(BigInteger, ComputesWithSignsAndCarries) {
  using geometry::BigInteger;
  const std::uint64_t ones = ~std::uint64_t{0};
  const BigInteger a(ones, 64, false), b(ones, 0, false), one(1, 0, false), minus(1, 0, true);
  const BigInteger power(1, 128, false);
  EXPECT_EQ((a + b + one - power).sign(), 0);  // 2^128 − 1 + 1
  EXPECT_EQ((power - one - a - b).sign(), 0);
  EXPECT_EQ((a + b + minus - power).sign(), -1);
  EXPECT_EQ((b * b - (a - b)).sign(), 0);  // (2^64 − 1)² = 2^128 − 2 · 2^64 + 1
  EXPECT_EQ((minus * minus - one).sign(), 0);
  EXPECT_EQ((minus * one).sign(), -1);
  EXPECT_EQ((BigInteger() * one).sign(), 0);
  EXPECT_EQ((one - one - one).sign(), -1);
}

}  // namespace
}  // namespace bathyal
