// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal::toolpath {
namespace {

double signed_area(const PolygonCorners& corners) {
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlanPoint& a = corners[i];
    const PlanPoint& b = corners[(i + 1) % corners.size()];
    area += 0.5 * cross2(a - corners[0], b - corners[0]);
  }
  return area;
}

/// Whether two closed segments meet.
bool meet(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c, const PlanPoint& d) {
  const auto side = [](const PlanPoint& p, const PlanPoint& q, const PlanPoint& r) {
    const double s = cross2(q - p, r - p);
    return s > 0.0 ? 1 : s < 0.0 ? -1 : 0;
  };
  const auto within = [](const PlanPoint& p, const PlanPoint& q, const PlanPoint& r) {
    return (r - p).dot(r - q) <= 0.0;
  };
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) ||
         (cda == 0 && within(c, d, a)) || (cdb == 0 && within(c, d, b));
}

void check_simple(const PolygonCorners& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (j == i + 1 || (i == 0 && j == n - 1)) continue;  // they share a corner
      if (meet(corners[i], corners[(i + 1) % n], corners[j], corners[(j + 1) % n])) {
        throw_argument("polygon", "edges that do not meet each other",
                       "edges " + std::to_string(i) + " and " + std::to_string(j) + " that do");
      }
    }
  }
}

/// Stretches of the line y = `y` inside the polygon, rising. A corner on the line belongs to the
/// side above, so that every edge is met once.
std::vector<Interval> inside(const PolygonCorners& corners, double y) {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlanPoint& a = corners[i];
    const PlanPoint& b = corners[(i + 1) % corners.size()];
    if ((a.y() >= y) == (b.y() >= y)) continue;
    cuts.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) intervals.push_back({cuts[k], cuts[k + 1]});
  return intervals;
}

/// Where the line y = `y` is nearer than `margin` to the edge a–b: an interval, since all points so
/// near to a segment form a convex set, the union of two discs and the strip between them.
std::optional<Interval> too_near(const PlanPoint& a, const PlanPoint& b, double y, double margin) {
  std::optional<Interval> near;
  const auto add = [&](double low, double high) {
    if (!(low < high)) return;
    near =
        near ? Interval{std::min(near->low, low), std::max(near->high, high)} : Interval{low, high};
  };
  for (const PlanPoint& end : {a, b}) {
    const double squared = margin * margin - (y - end.y()) * (y - end.y());
    if (squared > 0.0) add(end.x() - std::sqrt(squared), end.x() + std::sqrt(squared));
  }
  // The strip: |normal · (p − a)| < margin and 0 < along · (p − a) < length, each a range of x.
  const double length = (b - a).norm();
  const PlanPoint along = (b - a) / length;
  Interval strip{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto clip = [&](double slope, double offset, double low, double high) {
    if (slope == 0.0) {
      if (!(offset > low && offset < high)) strip.high = strip.low;
      return;
    }
    const double p = (low - offset) / slope, q = (high - offset) / slope;
    strip.low = std::max(strip.low, std::min(p, q));
    strip.high = std::min(strip.high, std::max(p, q));
  };
  const PlanPoint normal(-along.y(), along.x());
  const PlanPoint at_zero(-a.x(), y - a.y());  // the line's point with x = 0, seen from a
  clip(normal.x(), normal.dot(at_zero), -margin, margin);
  clip(along.x(), along.dot(at_zero), 0.0, length);
  add(strip.low, strip.high);
  return near;
}

/// `intervals` without `hole`.
std::vector<Interval> without(const std::vector<Interval>& intervals, const Interval& hole) {
  std::vector<Interval> rest;
  for (const Interval& i : intervals) {
    if (hole.high <= i.low || hole.low >= i.high) {
      rest.push_back(i);
      continue;
    }
    if (hole.low > i.low) rest.push_back({i.low, hole.low});
    if (hole.high < i.high) rest.push_back({hole.high, i.high});
  }
  return rest;
}

}  // namespace

PolygonCorners corners_along(const Polygon& polygon, const PlanPoint& origin, double direction) {
  const Eigen::Rotation2Dd turn(-direction);
  PolygonCorners corners;
  for (Index i = 0; i < polygon.rows(); ++i) {
    if (!polygon.row(i).allFinite()) {
      throw_argument("polygon", "finite corners", "corner " + std::to_string(i) + " that is not");
    }
    const PlanPoint corner = turn * (polygon.row(i).transpose() - origin);
    if (corners.empty() || corner != corners.back()) corners.push_back(corner);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) {
    throw_argument("polygon", "at least three corners apart", std::to_string(corners.size()));
  }
  double size = 0.0;
  for (const PlanPoint& corner : corners) size = std::max(size, (corner - corners[0]).norm());
  if (!(std::abs(signed_area(corners)) > 1e-12 * size * size)) {
    throw_argument("polygon", "an area above 0", to_text(std::abs(signed_area(corners))));
  }
  check_simple(corners);
  return corners;
}

std::vector<Interval> stretches(const PolygonCorners& corners, double y, double margin) {
  std::vector<Interval> intervals = inside(corners, y);
  if (margin > 0.0) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto hole = too_near(corners[i], corners[(i + 1) % corners.size()], y, margin);
      if (hole) intervals = without(intervals, *hole);
    }
  }
  return intervals;
}

}  // namespace bathyal::toolpath
