// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/two_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bathyal::terrain {
namespace {

using Point = PlanGrid::Point;
using Mask = std::array<std::uint8_t, kMaxNeighbourhood>;
using HeightArray = std::array<double, kMaxNeighbourhood>;

constexpr std::size_t kMinGroup = 5;  // two more than a plane needs, for an rms
constexpr double kHopeless = 2.0;     // contrast of a first guess beyond refinement

/// Thresholds of conditions 1 and 2: for a seed of a patch, and for a cell that touches one.
struct Thresholds {
  double contrast;  ///< separation over rms; one normal cloud cut in two gives 2.7
  double inside;    ///< share of each group inside the other's hull
};
constexpr Thresholds kSeed{5.0, 1.0 / 3.0};
constexpr Thresholds kGrown{4.0, 0.2};

/// z = a x + b y + c by least squares, about a point of the neighbourhood.
struct Fit {
  double a = 0.0, b = 0.0, c = 0.0;
  double rms = 0.0;

  double at(const Point& p) const { return a * p.x + b * p.y + c; }
};

/// Sums from which a plane is fitted; those of two groups add up to those of both.
struct Moments {
  double n = 0.0, x = 0.0, y = 0.0, z = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0, zz = 0.0;

  void add(const Point& p) {
    n += 1.0, x += p.x, y += p.y, z += p.z;
    xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y;
    xz += p.x * p.z, yz += p.y * p.z, zz += p.z * p.z;
  }

  /// A direction without spread gets no slope: points on one line in plan are level across it.
  Fit fit() const {
    const double mx = x / n, my = y / n, mz = z / n;
    const double sxx = xx - n * mx * mx, sxy = xy - n * mx * my, syy = yy - n * my * my;
    const double sxz = xz - n * mx * mz, syz = yz - n * my * mz, szz = zz - n * mz * mz;
    Fit f;
    const double determinant = sxx * syy - sxy * sxy;
    if (determinant > 1e-9 * (sxx + syy) * (sxx + syy)) {
      f.a = (sxz * syy - syz * sxy) / determinant;
      f.b = (syz * sxx - sxz * sxy) / determinant;
    }
    f.c = mz - f.a * mx - f.b * my;
    const double squares = szz - 2.0 * (f.a * sxz + f.b * syz) + f.a * f.a * sxx +
                           2.0 * f.a * f.b * sxy + f.b * f.b * syy;
    // A remainder of zz that rounding alone explains is no scatter.
    if (n > 3.0 && squares > 1e-14 * zz) f.rms = std::sqrt(squares / (n - 3.0));
    return f;
  }
};

/// The points about the middle one, so that sums of squares keep their digits.
struct LocalPoints {
  std::array<Point, kMaxNeighbourhood> points;
  std::size_t count;

  explicit LocalPoints(std::span<const Point> all) : count(all.size()) {
    const Point& o = all[all.size() / 2];
    for (std::size_t i = 0; i < count; ++i) {
      points[i] = {all[i].x - o.x, all[i].y - o.y, all[i].z - o.z};
    }
  }
  Fit fit() const {
    Moments moments;
    for (std::size_t i = 0; i < count; ++i) moments.add(points[i]);
    return moments.fit();
  }
};

/// Cuts the points at the widest void of their heights over `plane` that leaves kMinGroup of them
/// on each side.
void cut_at_widest_void(const LocalPoints& local, const Fit& plane, Mask& mask) {
  HeightArray sorted;
  for (std::size_t i = 0; i < local.count; ++i) {
    sorted[i] = local.points[i].z - plane.at(local.points[i]);
  }
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(local.count));
  std::size_t best = kMinGroup;
  for (std::size_t i = kMinGroup; i + kMinGroup <= local.count; ++i) {
    if (sorted[i] - sorted[i - 1] > sorted[best] - sorted[best - 1]) best = i;
  }
  for (std::size_t i = 0; i < local.count; ++i) {
    mask[i] = local.points[i].z - plane.at(local.points[i]) >= sorted[best];
  }
}

struct Split {
  Mask mask{};
  double rms = 0.0;  ///< the larger of the two groups'
  double separation = 0.0, middle = 0.0;
  double contrast = 0.0;  ///< separation over rms; 0 when the groups are too small or cross
};

/// Fits both groups of `split.mask`. False when one of them is too small.
bool fit_groups(const LocalPoints& local, Split& split, Fit& lower, Fit& upper) {
  Moments groups[2];
  for (std::size_t i = 0; i < local.count; ++i) groups[split.mask[i]].add(local.points[i]);
  const auto least = static_cast<double>(kMinGroup);
  if (groups[0].n < least || groups[1].n < least) return false;
  lower = groups[0].fit();
  upper = groups[1].fit();
  split.rms = std::max(lower.rms, upper.rms);
  double smallest = std::numeric_limits<double>::infinity();
  split.separation = split.middle = 0.0;
  for (std::size_t i = 0; i < local.count; ++i) {
    const double low = lower.at(local.points[i]), high = upper.at(local.points[i]);
    smallest = std::min(smallest, high - low);
    split.separation += high - low;
    split.middle += 0.5 * (high + low);
  }
  split.separation /= static_cast<double>(local.count);
  split.middle /= static_cast<double>(local.count);
  // Planes that cross inside the neighbourhood are the two sides of a crease, not two sheets.
  const double rms = std::max(split.rms, 1e-12 * split.separation);
  split.contrast = smallest > 0.0 ? split.separation / rms : 0.0;
  return true;
}

/// From the cut in `split.mask`, gives each point to the nearer plane until nothing changes.
void refine_split(const LocalPoints& local, Split& split) {
  Fit lower, upper;
  for (int round = 0; round < 6; ++round) {
    if (!fit_groups(local, split, lower, upper)) {
      split.contrast = 0.0;
      return;
    }
    if (split.separation < kHopeless * split.rms) return;
    bool changed = false;
    for (std::size_t i = 0; i < local.count; ++i) {
      const Point& p = local.points[i];
      const bool high = std::abs(p.z - upper.at(p)) < std::abs(p.z - lower.at(p));
      changed = changed || high != (split.mask[i] != 0);
      split.mask[i] = high;
    }
    if (!changed) return;
  }
  if (!fit_groups(local, split, lower, upper)) split.contrast = 0.0;
}

/// A cut by height, or where that is not clear, by height over the joint plane.
Split best_split(const LocalPoints& local, const Fit& joint) {
  Split level;
  cut_at_widest_void(local, Fit{}, level.mask);
  refine_split(local, level);
  if (level.contrast >= kSeed.contrast) return level;
  Split tilted;
  cut_at_widest_void(local, joint, tilted.mask);
  refine_split(local, tilted);
  return tilted.contrast > level.contrast ? tilted : level;
}

double cross(const Point& o, const Point& a, const Point& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Counter-clockwise convex hull in plan (Andrew 1979) of a sorted run of points.
std::size_t hull(std::span<const Point> points, std::array<Point, 2 * kMaxNeighbourhood>& ring) {
  std::size_t k = 0;
  const auto add = [&](const Point& p, std::size_t base) {
    while (k >= base + 2 && cross(ring[k - 2], ring[k - 1], p) <= 0.0) --k;
    ring[k++] = p;
  };
  for (const Point& p : points) add(p, 0);
  const std::size_t base = k - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], base);
  return k - 1;
}

/// Share of a group that lies inside the convex hull of the other.
double share_inside(const LocalPoints& local, const Mask& mask, std::uint8_t group) {
  std::array<Point, kMaxNeighbourhood> others;
  std::size_t count = 0;
  for (std::size_t i = 0; i < local.count; ++i) {
    if (mask[i] != group) others[count++] = local.points[i];
  }
  std::sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::array<Point, 2 * kMaxNeighbourhood> ring;
  const std::size_t corners = hull({others.data(), count}, ring);
  if (corners < 3) return 0.0;
  double inside = 0.0;
  for (std::size_t i = 0; i < local.count; ++i) {
    if (mask[i] != group) continue;
    bool in = true;
    for (std::size_t j = 0; j < corners && in; ++j) {
      in = cross(ring[j], ring[(j + 1) % corners], local.points[i]) >= 0.0;
    }
    inside += in;
  }
  return inside / static_cast<double>(local.count - count);
}

}  // namespace

double rms_about_sheets(std::span<const Point> points) {
  if (points.size() < 4) return 0.0;
  const LocalPoints local(points);
  const Fit joint = local.fit();
  if (points.size() < 2 * kMinGroup) return joint.rms;
  const Split split = best_split(local, joint);
  return split.contrast > 0.0 ? split.rms : joint.rms;
}

TwoSheets split_into_sheets(std::span<const Point> points, double min_separation) {
  TwoSheets result;
  if (points.size() < 2 * kMinGroup) return result;
  const LocalPoints local(points);
  const Fit joint = local.fit();
  // Two sheets apart by s, a tenth or more of the points on each, scatter by 0.3 s about one plane.
  if (joint.rms < 0.3 * min_separation) return result;
  const Split split = best_split(local, joint);
  if (split.contrast < kGrown.contrast || split.separation < min_separation) return result;
  const double inside =
      std::min(share_inside(local, split.mask, 0), share_inside(local, split.mask, 1));
  if (inside < kGrown.inside) return result;
  result.found = true;
  result.seed = split.contrast >= kSeed.contrast && inside >= kSeed.inside;
  result.separation = split.separation;
  result.middle = split.middle + points[points.size() / 2].z;
  result.upper = split.mask;
  return result;
}

}  // namespace bathyal::terrain
