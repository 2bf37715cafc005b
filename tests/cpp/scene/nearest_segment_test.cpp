// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bathyal/scene/internal/nearest.hpp"
#include "bathyal/scene/internal/segment_triangle.hpp"
#include "bathyal/scene/scene.hpp"
#include "meshes.hpp"

namespace bathyal {
namespace {

using Triangle = std::array<Vec3, 3>;
using scene::closest_to_segment;
using scene::segment_meets;

constexpr double kInf = std::numeric_limits<double>::infinity();

PointView view(const PointMatrix& points) { return {points.data(), points.rows(), 3}; }

Vec3 random_point(std::mt19937& random, const Vec3& low, const Vec3& high) {
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = std::uniform_real_distribution<double>(low[axis], high[axis])(random);
  }
  return point;
}

/// Segments of up to `length` along each axis.
struct Segments {
  PointMatrix start, end;

  Segments(Index count, const Vec3& low, const Vec3& high, double length, unsigned seed)
      : start(count, 3), end(count, 3) {
    std::mt19937 random(seed);
    const Vec3 half = Vec3::Constant(length);
    for (Index i = 0; i < count; ++i) {
      start.row(i) = random_point(random, low, high);
      end.row(i) = Vec3(start.row(i)) + random_point(random, -half, half);
    }
  }

  std::vector<NearestToSegment> nearest(const Scene& scene, int num_threads = 0) const {
    return scene.nearest_segments(view(start), view(end), {}, num_threads);
  }
};

/// The distance from a point of the segment to the triangle is convex along it: its least value by
/// narrowing the interval down.
double searched_distance(const Triangle& t, const Vec3& start, const Vec3& end) {
  const auto at = [&](double s) {
    return std::sqrt(scene::closest_point(t, start + s * (end - start)).squared_distance);
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (at(a) <= at(b))
      high = b;
    else
      low = a;
  }
  return std::min({at(low), at(0.0), at(1.0)});
}

TEST(ClosestToSegment, IsTheLeastAlongTheSegment) {
  std::mt19937 random(1);
  const Vec3 one = Vec3::Ones();
  int meeting = 0;
  for (int i = 0; i < 4000; ++i) {
    Triangle t;
    for (Vec3& corner : t) corner = random_point(random, -one, one);
    if (i % 8 == 0) t[2] = t[0] + 0.4 * (t[1] - t[0]);          // a segment
    if (i % 16 == 1) t[1] = t[2] = t[0];                        // a point
    if (i % 8 == 2) t[2] = t[0] + 1e-9 * (t[1] - t[0] + t[2]);  // a needle
    if (i % 8 == 3) t[2] = 0.5 * (t[0] + t[1]) + 1e-10 * t[2];  // a cap
    Vec3 p = 1.5 * random_point(random, -one, one), q = 1.5 * random_point(random, -one, one);
    if (i % 5 == 1) q = p + t[1] - t[0];             // parallel to an edge
    if (i % 5 == 2) q = p + t[1] - t[0] + 1e-8 * q;  // nearly so
    if (i % 5 == 3) q = p + 1e-6 * q;                // short
    const scene::SegmentApproach found = closest_to_segment(t, p, q);
    const double distance = std::sqrt(found.squared_distance);
    ASSERT_NEAR(distance, searched_distance(t, p, q), 4e-15) << i;
    const Vec3 rebuilt = t[0] + found.u * (t[1] - t[0]) + found.v * (t[2] - t[0]);
    ASSERT_NEAR((rebuilt - found.point).norm(), 0.0, 1e-14) << i;
    ASSERT_NEAR((p + found.fraction * (q - p) - found.on_segment).norm(), 0.0, 1e-15);
    ASSERT_NEAR((found.point - found.on_segment).norm(), distance, 1e-15);
    ASSERT_TRUE(found.u >= 0.0 && found.v >= 0.0 && found.u + found.v <= 1.0 + 1e-15);
    ASSERT_TRUE(found.fraction >= 0.0 && found.fraction <= 1.0);
    ASSERT_EQ(distance == 0.0, segment_meets(t, p, q));
    meeting += distance == 0.0;
  }
  EXPECT_GT(meeting, 50);
}

TEST(ClosestToSegment, HasTheSameDistanceReversed) {
  std::mt19937 random(2);
  const Vec3 one = Vec3::Ones();
  for (int i = 0; i < 500; ++i) {
    Triangle t;
    for (Vec3& corner : t) corner = random_point(random, -one, one);
    const Vec3 p = 2.0 * random_point(random, -one, one), q = 2.0 * random_point(random, -one, one);
    const scene::SegmentApproach there = closest_to_segment(t, p, q);
    const scene::SegmentApproach back = closest_to_segment({t[2], t[0], t[1]}, q, p);
    EXPECT_NEAR(std::sqrt(there.squared_distance), std::sqrt(back.squared_distance), 4e-15);
    EXPECT_NEAR(there.fraction, 1.0 - back.fraction, 1e-12);
  }
}

// Where a segment only touches, rounding would give some 10⁻¹⁷, and at survey coordinates 10⁻¹⁰.
TEST(ClosestToSegment, IsExactlyZeroWhereTheSegmentTouches) {
  for (const Vec3& offset :
       {Vec3(0, 0, 0), Vec3(620152.25, 7246504.5, -52.125), Vec3(1e7, -1e7, 1e7)}) {
    const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      return Triangle{offset + a, offset + b, offset + c};
    };
    const auto expect = [&](const Triangle& t, const Vec3& p, const Vec3& q, bool meets) {
      const scene::SegmentApproach found = closest_to_segment(t, offset + p, offset + q);
      EXPECT_EQ(found.squared_distance == 0.0, meets) << offset.x() << ": " << p << " " << q;
      if (meets) {
        EXPECT_EQ(found.point, found.on_segment);
      }
    };
    const Triangle slope = triangle({0, 0, 0}, {3, 0, 1}, {0, 3, 1});  // z = (x + y) / 3
    expect(slope, {1, 1, 5}, {1, 1, -5}, true);                        // through it
    expect(slope, {1.5, 0.75, 0.75}, {2, 7, 9}, true);                 // an end on it
    expect(slope, {0, 0, 0}, {-1, -4, 2}, true);                       // an end on a corner
    expect(slope, {-1, 0, 3}, {1, 0, -3}, true);                       // through a corner
    expect(slope, {1.5, 1.5, 3}, {1.5, 1.5, -3}, true);                // through an edge
    expect(slope, {0.75, 0, 0.25}, {1.5, 1.5, 1}, true);               // in its plane, inside
    expect(slope, {-3, 0.75, -0.75}, {6, 0.75, 2.25}, true);           // in its plane, across it
    expect(slope, {-3, -3, -2}, {6, -3, 1}, false);                    // in its plane, next to it
    expect(slope, {-3, 3, 0}, {3, -3, 0}, true);                       // in its plane, at a corner
    expect(slope, {-3, 0, -1}, {6, 0, 2}, true);                       // along an edge
    expect(slope, {3, 0, 1}, {6, 0, 2}, true);                         // goes on where an edge ends
    expect(slope, {1, 1, 0.75}, {2, 2, 5}, false);                     // starts above
    const double above = std::nextafter(offset.z() + 0.75, kInf) - offset.z();
    expect(slope, {1.5, 0.75, above}, {2, 7, 9}, false);  // by the last digit
    const Triangle line = triangle({0, 0, 0}, {4, 4, 4}, {1, 1, 1});
    expect(line, {3, 1, 5}, {3, 5, 1}, true);
    expect(line, {3, 1, 5}, {3, 5, 1.5}, false);
    expect(line, {2, 2, 2}, {2, 2, 9}, true);
    expect(line, {-4, -4, -4}, {8, 8, 8}, true);
    expect(line, {5, 5, 5}, {8, 8, 8}, false);
    const Triangle point = triangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
    expect(point, {0, 0, 3}, {2, 4, 3}, true);
    expect(point, {0, 0, 3}, {2, 4, 3.5}, false);
    expect(point, {2, 4, 3}, {4, 8, 3}, false);
  }
}

// A segment through an edge or corner of a closed mesh goes through one of the triangles there.
TEST(ClosestToSegment, NothingSlipsThroughAClosedMesh) {
  std::mt19937 random(3);
  for (const Vec3& centre : {Vec3(0.1, 0.2, 0.3), Vec3(512345.3, 7212345.7, -52.1)}) {
    const TriangleMesh mesh = test::sphere(2, 1.0, centre);
    const Scene scene({mesh});
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const double s = std::uniform_real_distribution<double>(0.0, 1.0)(random);
      const Vec3 edge = mesh.corner(t, 0) + s * (mesh.corner(t, 1) - mesh.corner(t, 0));
      for (const Vec3& through : {edge, Vec3(mesh.corner(t, 0))}) {
        const Vec3 out = through + (through - centre);
        EXPECT_EQ(scene.nearest_segment(centre, out).distance, 0.0);
        EXPECT_EQ(scene.nearest_segment(out, centre).distance, 0.0);
        EXPECT_GT(scene.nearest_segment(out, out + (out - centre)).distance, 0.4);
      }
    }
  }
}

TEST(NearestSegment, OverAFlatFloor) {
  const TriangleMesh floor =
      test::mesh_of({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Scene scene({floor});
  const NearestToSegment slanted = scene.nearest_segment({1, 2, 5}, {4, 2.5, 3});
  EXPECT_DOUBLE_EQ(slanted.distance, 3.0);
  EXPECT_EQ(slanted.fraction, 1.0);
  EXPECT_EQ(slanted.segment_point, Vec3(4, 2.5, 3));
  EXPECT_LT((slanted.point - Vec3(4, 2.5, 0)).norm(), 1e-14);
  EXPECT_EQ(slanted.triangle, 0);
  const NearestToSegment through = scene.nearest_segment({1, 2, 1}, {1, 2, -3});
  EXPECT_EQ(through.distance, 0.0);
  EXPECT_DOUBLE_EQ(through.fraction, 0.25);
  EXPECT_EQ(through.point, Vec3(1, 2, 0));
  EXPECT_EQ(through.segment_point, through.point);
  EXPECT_EQ(through.triangle, 1);
  const NearestToSegment past = scene.nearest_segment({12, -40, 4}, {12, 40, 4});  // past its side
  EXPECT_DOUBLE_EQ(past.distance, 5.0);
  EXPECT_DOUBLE_EQ(past.point.x(), 9.0);
  EXPECT_DOUBLE_EQ(past.segment_point.y(), past.point.y());
}

/// Whether the answers are those of every triangle in turn, to the last bit.
void expect_exact(const Scene& scene, const Segments& segments) {
  const auto found = segments.nearest(scene);
  for (Index i = 0; i < segments.start.rows(); ++i) {
    const Vec3 p = segments.start.row(i), q = segments.end.row(i);
    double best = kInf;
    std::pair<std::int32_t, std::int32_t> who;
    for (std::int32_t m = 0; m < static_cast<std::int32_t>(scene.meshes().size()); ++m) {
      const TriangleMesh& each = scene.meshes()[static_cast<std::size_t>(m)];
      for (std::int32_t t = 0; t < each.triangle_count(); ++t) {
        const double d =
            closest_to_segment({each.corner(t, 0), each.corner(t, 1), each.corner(t, 2)}, p, q)
                .squared_distance;
        if (d < best) {
          best = d;
          who = {m, t};
        }
      }
    }
    const NearestToSegment& one = found[static_cast<std::size_t>(i)];
    ASSERT_EQ(one.distance, std::sqrt(best)) << p.transpose() << " to " << q.transpose();
    ASSERT_EQ(std::pair(one.mesh, one.triangle), who) << p.transpose() << " to " << q.transpose();
  }
}

TEST(NearestSegment, SameAsEveryTriangleInTurn) {
  for (const Vec3& offset :
       {Vec3(0, 0, 0), Vec3(512345.25, 7212345.5, -52.0), Vec3(1e7, 1e7, 1e7)}) {
    const Scene scene({test::one_triangle(offset + Vec3(0, 0, 60)), test::seabed(40, 30, offset)});
    for (const double length : {0.0, 0.3, 3.0, 60.0}) {
      expect_exact(
          scene, Segments(100, offset + Vec3(-20, -20, -20), offset + Vec3(60, 50, 40), length, 3));
    }
  }
}

// What the floats of the sieve cannot hold must not rule anything out.
TEST(NearestSegment, SameAsEveryTriangleFromFarAwayAndAtEveryScale) {
  const TriangleMesh seabed = test::seabed(20, 15);
  for (const double far : {1e3, 1e6, 1e9, 1e12, 1e18, 1e20, 4e24}) {
    for (const double length : {1.0, far}) {
      const Vec3 low = Vec3::Constant(-far);
      expect_exact(Scene({seabed}), Segments(40, low, -low, length, 5));
    }
  }
  for (const double scale : {1e-30, 1e-18, 1e-9, 1e-3, 1e6, 1e10}) {
    const Scene scene(
        {TriangleMesh(PointMatrix(scale * seabed.vertices()), seabed.shared_triangles())});
    expect_exact(scene,
                 Segments(40, scale * Vec3(-5, -5, -5), scale * Vec3(25, 20, 5), 4 * scale, 6));
  }
}

TEST(NearestSegment, NeedlesAndTrianglesWithoutArea) {
  std::mt19937 random(7);
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random_point(random, {0, 0, 0}, {9, 9, 9});
    const Vec3 b = a + random_point(random, {-2, -2, -2}, {2, 2, 2});
    vertices.insert(vertices.end(), {a, b, i % 3 == 0 ? a : Vec3(0.7 * a + 0.3 * b)});
    if (i % 3 == 1) vertices.back() += 1e-9 * Vec3(b - a).cross(Vec3::UnitX());
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  expect_exact(Scene({test::mesh_of(vertices, triangles)}),
               Segments(200, {-2, -2, -2}, {11, 11, 11}, 3.0, 8));
}

TEST(NearestSegment, TiesGiveTheLowestTriangle) {
  const TriangleMesh mesh = test::seabed(20, 20, {512345.0, 7212345.0, 0.0});
  const Scene scene({mesh, mesh});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {  // a segment that ends at a corner
    const Vec3 corner = mesh.vertices().row(v);
    const NearestToSegment found = scene.nearest_segment(corner + Vec3(0, 0, 3), corner);
    EXPECT_EQ(found.distance, 0.0);
    EXPECT_EQ(found.point, corner);
    EXPECT_EQ(found.fraction, 1.0);
    EXPECT_EQ(found.mesh, 0);
    std::int32_t lowest = 0;
    while (!(mesh.triangles().row(lowest).array() == static_cast<std::int32_t>(v)).any()) ++lowest;
    EXPECT_EQ(found.triangle, lowest);
  }
}

TEST(NearestSegment, OfNoLengthIsNearestToThePoint) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(512345.25, 7212345.5, -52.0)}) {
    const Scene scene({test::seabed(30, 30, offset)});
    const Segments points(500, offset + Vec3(-5, -5, -5), offset + Vec3(35, 35, 9), 0.0, 9);
    const auto to_segments = points.nearest(scene);
    const auto to_points = scene.nearest(view(points.start));
    for (std::size_t i = 0; i < to_points.size(); ++i) {
      EXPECT_EQ(to_segments[i].distance, to_points[i].distance);
      EXPECT_EQ(to_segments[i].triangle, to_points[i].triangle);
      EXPECT_EQ(to_segments[i].point, to_points[i].point);
      EXPECT_EQ(to_segments[i].u, to_points[i].u);
      EXPECT_EQ(to_segments[i].segment_point, Vec3(points.start.row(static_cast<Index>(i))));
      EXPECT_EQ(to_segments[i].fraction, 0.0);
    }
  }
}

TEST(NearestSegment, NothingIsFoundBeyondWithin) {
  const Scene scene({test::seabed(30, 30)});
  const Segments segments(300, {-5, -5, -5}, {35, 35, 12}, 2.0, 10);
  int near = 0;
  for (Index i = 0; i < 300; ++i) {
    const Vec3 p = segments.start.row(i), q = segments.end.row(i);
    const NearestToSegment any = scene.nearest_segment(p, q);
    const NearestToSegment at_most = scene.nearest_segment(p, q, {any.distance});
    EXPECT_EQ(at_most.distance, any.distance);
    EXPECT_EQ(at_most.triangle, any.triangle);
    const NearestToSegment close = scene.nearest_segment(p, q, {2.0});
    EXPECT_EQ(close.triangle, any.distance <= 2.0 ? any.triangle : -1);
    EXPECT_EQ(close.distance, any.distance <= 2.0 ? any.distance : kInf);
    near += close.triangle >= 0;
    if (any.distance == 0.0) continue;
    const NearestToSegment none = scene.nearest_segment(p, q, {std::nextafter(any.distance, 0.0)});
    EXPECT_EQ(none.distance, kInf);
    EXPECT_EQ(none.mesh, -1);
    EXPECT_EQ(none.triangle, -1);
    EXPECT_TRUE(std::isnan(none.fraction) && std::isnan(none.point.x()) &&
                std::isnan(none.segment_point.x()));
  }
  EXPECT_TRUE(near > 50 && near < 250);
}

TEST(NearestSegment, SurveyCoordinatesKeepTheDistance) {
  const Vec3 offset(9512345.0, 7212345.0, -52.0);
  const Scene here({test::seabed(30, 30)}), there({test::seabed(30, 30, offset)});
  const Segments segments(300, {-5, -5, -5}, {35, 35, 12}, 2.0, 11);
  for (Index i = 0; i < 300; ++i) {
    const Vec3 p = segments.start.row(i), q = segments.end.row(i);
    EXPECT_NEAR(there.nearest_segment(p + offset, q + offset).distance,
                here.nearest_segment(p, q).distance, 1e-8);
  }
}

TEST(NearestSegment, EmptySceneAnswersInfinity) {
  const NearestToSegment found = Scene({TriangleMesh()}).nearest_segment({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(found.distance, kInf);
  EXPECT_EQ(found.triangle, -1);
}

TEST(NearestSegment, OneThreadEqualsEightAndOneStartServesAll) {
  const Scene scene({test::seabed(50, 50)});
  Segments segments(2000, {-10, -10, -10}, {60, 60, 10}, 4.0, 12);
  const auto one = segments.nearest(scene, 1), eight = segments.nearest(scene, 8);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].distance, eight[i].distance);
    EXPECT_EQ(one[i].triangle, eight[i].triangle);
    EXPECT_EQ(one[i].point, eight[i].point);
    EXPECT_EQ(one[i].fraction, eight[i].fraction);
  }
  const PointMatrix first = segments.start.row(0);
  const auto fan = scene.nearest_segments(view(first), view(segments.end));
  EXPECT_EQ(fan[7].distance,
            scene.nearest_segment(Vec3(first.row(0)), Vec3(segments.end.row(7))).distance);
}

TEST(NearestSegment, Refusals) {
  const Scene scene({test::box({1, 1, 1})});
  const Vec3 zero = Vec3::Zero();
  EXPECT_THROW(scene.nearest_segment(zero, {0.0, std::nan(""), 0.0}), std::invalid_argument);
  EXPECT_THROW(scene.nearest_segment({0.0, kInf, 0.0}, zero), std::invalid_argument);
  EXPECT_THROW(scene.nearest_segment({0.0, 2e25, 0.0}, zero), std::invalid_argument);
  EXPECT_THROW(scene.nearest_segment(zero, zero, {-1.0}), std::invalid_argument);
  EXPECT_THROW(scene.nearest_segment(zero, zero, {std::nan("")}), std::invalid_argument);
  const PointMatrix two = PointMatrix::Zero(2, 3), three = PointMatrix::Zero(3, 3);
  EXPECT_THROW(scene.nearest_segments(view(two), view(three)), std::invalid_argument);
  PointMatrix bad = three;
  bad(1, 2) = 1e26;
  try {
    scene.nearest_segments(view(bad), view(three));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "`start`: expected coordinates up to 1e25 m, got row 1 = (0, 0, 1e+26)");
  }
}

}  // namespace
}  // namespace bathyal
