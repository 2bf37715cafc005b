// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/internal/route.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/world/generate/internal/mesh_builder.hpp"

namespace bathyal::generate {
namespace {

constexpr std::size_t kSamples = 64;  // between two points of a route

void check_route(const std::vector<Vec3>& points) {
  if (points.size() < 2 || points.size() > 100000) {
    throw_argument("route", "2 to 100000 points", std::to_string(points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i].cwiseAbs().maxCoeff() <= 1e7)) {
      throw_argument("route", "finite numbers, 10⁷ m at most",
                     "others in row " + std::to_string(i));
    }
    if (i > 0 && !((points[i] - points[i - 1]).norm() > 1e-6)) {
      throw_argument(
          "route", "neighbouring points apart",
          "rows " + std::to_string(i - 1) + " and " + std::to_string(i) + " at one place");
    }
  }
}

Vec3 blend_points(const Vec3& a, const Vec3& b, double ta, double tb, double t) {
  return ((tb - t) * a + (t - ta) * b) / (tb - ta);
}

/// What lies before the end `a` of a route that goes on to b, then c: c in the mirror half-way
/// between a and b, which keeps straight lines and circles. Of two points alone c is b.
Vec3 mirror(const Vec3& c, const Vec3& a, const Vec3& b) {
  const Vec3 axis = (b - a).normalized();
  const Vec3 image = c - 2.0 * axis.dot(c - 0.5 * (a + b)) * axis;
  return (image - a).norm() > 1e-9 ? image : Vec3(2.0 * a - b);
}

/// Unit directions: at an end that of its segment, between two segments their mean.
std::vector<Vec3> curve_tangents(const std::vector<Vec3>& center) {
  std::vector<Vec3> ahead;
  for (std::size_t i = 0; i + 1 < center.size(); ++i) {
    ahead.push_back((center[i + 1] - center[i]).normalized());
  }
  std::vector<Vec3> tangent{ahead.front()};
  for (std::size_t i = 1; i < ahead.size(); ++i) {
    tangent.push_back((ahead[i - 1] + ahead[i]).normalized());
  }
  tangent.push_back(ahead.back());
  return tangent;
}

void check_bends(const std::vector<Vec3>& center, const std::vector<double>& radius) {
  for (std::size_t i = 1; i + 1 < center.size(); ++i) {
    const Vec3 before = center[i] - center[i - 1];
    const Vec3 after = center[i + 1] - center[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    const double bend = 0.25 * (before.norm() + after.norm()) / std::tan(0.5 * turn);
    if (bend > radius[i]) continue;
    throw_argument("route", "bends wider than the radius, " + to_text(radius[i]) + " m",
                   "one of " + to_text(bend) + " m near (" + to_text(center[i].x()) + ", " +
                       to_text(center[i].y()) + ")");
  }
}

}  // namespace

RouteCurve::RouteCurve(std::vector<Vec3> points) {
  check_route(points);
  const std::size_t last_row = points.size() - 1;
  const std::size_t second = std::min<std::size_t>(2, last_row);
  points_.push_back(mirror(points[second], points[0], points[1]));
  points_.insert(points_.end(), points.begin(), points.end());
  points_.push_back(mirror(points[last_row - second], points[last_row], points[last_row - 1]));
  along_.push_back(0.0);
  const std::size_t count = kSamples * (points.size() - 1);
  Vec3 last = points[0];
  for (std::size_t i = 1; i <= count; ++i) {
    const Vec3 next = evaluate(static_cast<double>(i) / static_cast<double>(kSamples));
    along_.push_back(along_.back() + (next - last).norm());
    last = next;
  }
}

/// Barry and Goldman's pyramid over the four points around.
Vec3 RouteCurve::evaluate(double parameter) const {
  const auto last = static_cast<double>(points_.size() - 4);
  const auto segment = static_cast<std::size_t>(std::clamp(std::floor(parameter), 0.0, last));
  const Vec3* p = points_.data() + segment;
  double t[4] = {0.0, 0.0, 0.0, 0.0};
  for (int k = 1; k < 4; ++k) t[k] = t[k - 1] + std::sqrt((p[k] - p[k - 1]).norm());
  const double at = t[1] + (parameter - static_cast<double>(segment)) * (t[2] - t[1]);
  const Vec3 a = blend_points(p[0], p[1], t[0], t[1], at);
  const Vec3 b = blend_points(p[1], p[2], t[1], t[2], at);
  const Vec3 c = blend_points(p[2], p[3], t[2], t[3], at);
  return blend_points(blend_points(a, b, t[0], t[2], at), blend_points(b, c, t[1], t[3], at), t[1],
                      t[2], at);
}

Vec3 RouteCurve::at(double along) const {
  const auto above = std::upper_bound(along_.begin(), along_.end() - 1, along);
  const auto row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - along_.begin(), 1));
  const double share = (along - along_[row - 1]) / (along_[row] - along_[row - 1]);
  return evaluate((static_cast<double>(row - 1) + share) / static_cast<double>(kSamples));
}

std::vector<double> RouteCurve::knots() const {
  std::vector<double> knots;
  for (std::size_t i = 0; i < along_.size(); i += kSamples) knots.push_back(along_[i]);
  return knots;
}

double between(const std::vector<double>& knots, const std::vector<double>& values, double at) {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, at);
  const auto row = static_cast<std::size_t>(above - knots.begin());
  const double share = (at - knots[row - 1]) / (knots[row] - knots[row - 1]);
  return values[row - 1] + std::clamp(share, 0.0, 1.0) * (values[row] - values[row - 1]);
}

std::vector<Ring> tube_rings(const std::vector<Vec3>& center, const std::vector<double>& radius,
                             int sides) {
  check_bends(center, radius);
  const std::vector<Vec3> tangent = curve_tangents(center);
  const bool upright = std::abs(tangent[0].z()) < 0.9;
  const Vec3 start = upright ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  Vec3 u = (start - tangent[0].dot(start) * tangent[0]).normalized();
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < center.size(); ++i) {
    rings.push_back(ellipse(center[i], u, tangent[i].cross(u), radius[i], radius[i], sides));
    if (i + 1 == center.size()) break;
    const Vec3 step = center[i + 1] - center[i];
    const Vec3 mirrored_u = u - 2.0 / step.squaredNorm() * step.dot(u) * step;
    const Vec3 mirrored_t = tangent[i] - 2.0 / step.squaredNorm() * step.dot(tangent[i]) * step;
    const Vec3 off = tangent[i + 1] - mirrored_t;
    u = mirrored_u - 2.0 / off.squaredNorm() * off.dot(mirrored_u) * off;
    u = (u - tangent[i + 1].dot(u) * tangent[i + 1]).normalized();
  }
  return rings;
}

}  // namespace bathyal::generate
