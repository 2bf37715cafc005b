// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/two_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bathyal {
namespace {

using Point = PlanGrid::Point;
using Mask = std::vector<std::uint8_t>;

constexpr std::size_t kMinGroup = 5;  // two more than a plane needs, so that its rms says something

/// What conditions 1 and 2 ask: of a seed of a patch, and of a cell that touches one.
struct Thresholds {
  double contrast;  ///< separation over rms; one normal cloud cut in two gives 2.7
  double inside;    ///< share of each group inside the other's hull
};
constexpr Thresholds kSeed{5.0, 1.0 / 3.0};
constexpr Thresholds kGrown{4.0, 0.2};

/// z = a (x − x0) + b (y − y0) + c by least squares.
struct Fit {
  double x0 = 0.0, y0 = 0.0, a = 0.0, b = 0.0, c = 0.0;
  double rms = 0.0;

  double at(const Point& p) const { return a * (p.x - x0) + b * (p.y - y0) + c; }
};

/// Fits the points whose mask equals `group`, or all when the mask is empty. A direction without
/// spread gets no slope: points on one line in plan are level across it.
Fit fit(std::span<const Point> points, const Mask& mask, std::uint8_t group) {
  Fit f;
  double n = 0.0, z0 = 0.0;
  const auto each = [&](const auto& body) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (mask.empty() || mask[i] == group) body(points[i]);
    }
  };
  each([&](const Point& p) { n += 1.0, f.x0 += p.x, f.y0 += p.y, z0 += p.z; });
  if (n == 0.0) return f;
  f.x0 /= n, f.y0 /= n, z0 /= n;
  f.c = z0;
  double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;
  each([&](const Point& p) {
    const double x = p.x - f.x0, y = p.y - f.y0, z = p.z - z0;
    xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z;
  });
  const double determinant = xx * yy - xy * xy;
  if (determinant > 1e-9 * (xx + yy) * (xx + yy)) {
    f.a = (xz * yy - yz * xy) / determinant;
    f.b = (yz * xx - xz * xy) / determinant;
  }
  double sum = 0.0;
  each([&](const Point& p) {
    const double r = p.z - f.at(p);
    sum += r * r;
  });
  f.rms = n > 3.0 ? std::sqrt(sum / (n - 3.0)) : 0.0;
  return f;
}

/// Cuts `heights` at the widest void that leaves kMinGroup values on each side.
Mask cut_at_widest_void(const std::vector<double>& heights) {
  std::vector<double> sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  std::size_t best = kMinGroup;
  for (std::size_t i = kMinGroup; i + kMinGroup <= sorted.size(); ++i) {
    if (sorted[i] - sorted[i - 1] > sorted[best] - sorted[best - 1]) best = i;
  }
  Mask mask(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) mask[i] = heights[i] >= sorted[best];
  return mask;
}

struct Split {
  Mask mask;
  Fit lower, upper;
  double separation = 0.0, middle = 0.0;
  double contrast = 0.0;  ///< separation over the larger rms; 0 when the groups are too small
};

/// From a first guess, fits a plane to each group and gives each point to the nearer plane, until
/// nothing changes or a few rounds have passed.
Split refine(std::span<const Point> points, Mask mask) {
  Split split;
  for (int round = 0; round < 6; ++round) {
    const auto high = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
    if (high < kMinGroup || points.size() - high < kMinGroup) return {};
    split.lower = fit(points, mask, 0);
    split.upper = fit(points, mask, 1);
    Mask next(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      next[i] = std::abs(points[i].z - split.upper.at(points[i])) <
                std::abs(points[i].z - split.lower.at(points[i]));
    }
    const bool settled = next == mask;
    mask = std::move(next);
    if (settled) break;
  }
  const auto high = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
  if (high < kMinGroup || points.size() - high < kMinGroup) return {};
  // Planes that cross inside the neighbourhood are the two sides of a crease, not two sheets.
  double smallest = std::numeric_limits<double>::infinity();
  double sum = 0.0, middle = 0.0;
  for (const Point& p : points) {
    const double gap = split.upper.at(p) - split.lower.at(p);
    smallest = std::min(smallest, gap);
    sum += gap;
    middle += 0.5 * (split.upper.at(p) + split.lower.at(p));
  }
  const auto n = static_cast<double>(points.size());
  split.separation = sum / n;
  split.middle = middle / n;
  const double rms = std::max({split.lower.rms, split.upper.rms, 1e-12 * split.separation});
  split.contrast = smallest > 0.0 ? split.separation / rms : 0.0;
  split.mask = std::move(mask);
  return split;
}

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Counter-clockwise convex hull in plan (Andrew 1979).
std::vector<Point> hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> ring(2 * points.size());
  std::size_t k = 0;
  const auto add = [&](const Point& p, std::size_t base) {
    while (k >= base + 2 && cross(ring[k - 2], ring[k - 1], p) <= 0.0) --k;
    ring[k++] = p;
  };
  for (const Point& p : points) add(p, 0);
  const std::size_t base = k - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], base);
  ring.resize(k - 1);
  return ring;
}

double share_inside(std::span<const Point> points, const Mask& mask, std::uint8_t group) {
  std::vector<Point> others;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mask[i] != group) others.push_back(points[i]);
  }
  const std::vector<Point> ring = hull(std::move(others));
  if (ring.size() < 3) return 0.0;
  double inside = 0.0, count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mask[i] != group) continue;
    count += 1.0;
    bool in = true;
    for (std::size_t j = 0; j < ring.size() && in; ++j) {
      in = cross(ring[j], ring[(j + 1) % ring.size()], points[i]) >= 0.0;
    }
    if (in) inside += 1.0;
  }
  return inside / count;
}

/// The better of the cuts by height and by height about the joint plane; contrast 0 for neither.
Split best_split(std::span<const Point> points, const Fit& joint) {
  std::vector<double> heights(points.size());
  Split best;
  for (const bool level : {true, false}) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      heights[i] = points[i].z - (level ? 0.0 : joint.at(points[i]));
    }
    Split split = refine(points, cut_at_widest_void(heights));
    if (split.contrast > best.contrast) best = std::move(split);
  }
  return best;
}

}  // namespace

double rms_about_sheets(std::span<const Point> points) {
  const Fit joint = fit(points, {}, 0);
  if (points.size() < 2 * kMinGroup) return joint.rms;
  const Split split = best_split(points, joint);
  if (split.contrast == 0.0) return joint.rms;
  return std::max(split.lower.rms, split.upper.rms);
}

TwoSheets split_into_sheets(std::span<const Point> points, double min_separation) {
  TwoSheets result;
  if (points.size() < 2 * kMinGroup) return result;
  const Fit joint = fit(points, {}, 0);
  // Two sheets apart by s, a tenth or more of the points on each, scatter by 0.3 s about one plane.
  if (joint.rms < 0.2 * min_separation) return result;
  Split best = best_split(points, joint);
  if (best.contrast < kGrown.contrast || best.separation < min_separation) return result;
  const double inside =
      std::min(share_inside(points, best.mask, 0), share_inside(points, best.mask, 1));
  if (inside < kGrown.inside) return result;
  result.found = true;
  result.seed = best.contrast >= kSeed.contrast && inside >= kSeed.inside;
  result.separation = best.separation;
  result.middle = best.middle;
  result.upper = std::move(best.mask);
  return result;
}

}  // namespace bathyal
