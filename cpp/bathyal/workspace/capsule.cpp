// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/capsule.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

double clamped(double value) { return std::clamp(value, 0.0, 1.0); }

/// Fraction of the segment from `start` along `span` that is nearest to `point`.
double nearest_fraction(const Vec3& point, const Vec3& start, const Vec3& span) {
  const double square = span.squaredNorm();
  return square > 0.0 ? clamped(span.dot(point - start) / square) : 0.0;
}

// Fit -------------------------------------------------------------------------------------------

double volume(const Capsule& capsule) {
  const double length = (capsule.end - capsule.start).norm();
  return std::numbers::pi * capsule.radius * capsule.radius * (length + 4.0 / 3.0 * capsule.radius);
}

/// Centre of a circle that holds all (N, 2) points: a hundred steps of Badoiu and Clarkson (2003)
/// towards the farthest, within 1 % of the smallest; its radius is then measured.
Eigen::Vector2d circle_centre(const Eigen::MatrixX2d& points) {
  Eigen::Vector2d centre = 0.5 * (points.colwise().minCoeff() + points.colwise().maxCoeff());
  for (int step = 1; step <= 100; ++step) {
    Index farthest = 0;
    (points.rowwise() - centre.transpose()).rowwise().squaredNorm().maxCoeff(&farthest);
    centre += (points.row(farthest).transpose() - centre) / (step + 1.0);
  }
  return centre;
}

/// The smallest capsule found whose axis runs along `direction`: a circle round the points seen
/// along it, and ends as near to the middle as half-balls of that radius allow.
Capsule along(const Eigen::MatrixX3d& points, const Vec3& direction) {
  const Vec3 u = direction.unitOrthogonal(), v = direction.cross(u);
  Eigen::MatrixX2d across(points.rows(), 2);
  across << points * u, points * v;
  const Eigen::Vector2d centre = circle_centre(across);
  const Eigen::ArrayXd square =
      (across.rowwise() - centre.transpose()).rowwise().squaredNorm().array();
  const Eigen::ArrayXd height = (points * direction).array();
  // Rounding must not leave the farthest point outside.
  const double radius = std::sqrt(square.maxCoeff()) * (1.0 + 1e-12);
  const Eigen::ArrayXd cap = (radius * radius - square).max(0.0).sqrt();
  double low = (height + cap).minCoeff(), high = (height - cap).maxCoeff();
  if (low > high) low = high = 0.5 * (low + high);
  const Vec3 foot = centre.x() * u + centre.y() * v;
  return {foot + low * direction, foot + high * direction, radius};
}

/// The points that lie farthest out in some 400 directions, spread evenly: enough to choose an
/// axis.
Eigen::MatrixX3d outermost(const Eigen::MatrixX3d& points) {
  constexpr int kDirections = 400;
  if (points.rows() <= kDirections) return points;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  Eigen::MatrixX3d out(kDirections, 3);
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections, r = std::sqrt(1.0 - z * z);
    Index farthest = 0;
    (points * Vec3(r * std::cos(golden * i), r * std::sin(golden * i), z)).maxCoeff(&farthest);
    out.row(i) = points.row(farthest);
  }
  return out;
}

}  // namespace

void Capsule::check(std::string_view name) const {
  const std::string owner(name);
  if (!start.allFinite() || !end.allFinite()) {
    throw_argument(owner + " ends", "finite coordinates [m]", "one that is not");
  }
  if (!(radius >= 0.0) || !std::isfinite(radius)) {
    throw_argument(owner + " radius", "0 or more [m]", to_text(radius));
  }
}

Capsule in_frame(const Capsule& capsule, const Pose& new_from_capsule) {
  return {new_from_capsule * capsule.start, new_from_capsule * capsule.end, capsule.radius};
}

SegmentPair nearest_of_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 a = a1 - a0, b = b1 - b0, between = a0 - b0;
  const auto at = [&](double first, double second) {
    return SegmentPair{(between + first * a - second * b).norm(), first, second};
  };
  // The nearest pair has an end of one of the two, or lies inside both, where the lines are
  // nearest.
  SegmentPair best = at(0.0, nearest_fraction(a0, b0, b));
  const auto take = [&best](const SegmentPair& pair) {
    if (pair.distance < best.distance) best = pair;
  };
  take(at(nearest_fraction(b0, a0, a), 0.0));
  take(at(nearest_fraction(b1, a0, a), 1.0));
  take(at(1.0, nearest_fraction(a1, b0, b)));
  const Vec3 normal = a.cross(b);
  const double square = normal.squaredNorm();
  if (square > 0.0) {
    const double first = -between.cross(b).dot(normal) / square;
    const double second = -between.cross(a).dot(normal) / square;
    if (first > 0.0 && first < 1.0 && second > 0.0 && second < 1.0) take(at(first, second));
  }
  return best;
}

double distance(const Capsule& one, const Capsule& other) {
  return nearest_of_segments(one.start, one.end, other.start, other.end).distance - one.radius -
         other.radius;
}

Capsule fit_capsule(PointView points) {
  if (points.rows() == 0) throw_argument("points", "one or more", "none");
  if (!points.allFinite()) throw_argument("points", "finite coordinates", "one that is not");
  const Eigen::RowVector3d origin = points.colwise().mean();
  const Eigen::MatrixX3d local = points.rowwise() - origin;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(local.transpose() * local);

  const Eigen::MatrixX3d outer = outermost(local);
  Vec3 direction = Vec3::UnitZ();
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& candidate) {
    const double size = volume(along(outer, candidate));
    if (size >= least) return false;
    least = size;
    direction = candidate;
    return true;
  };
  for (int i = 2; i >= 0; --i) consider(axes.eigenvectors().col(i));
  for (double tilt = 0.2; tilt > 1e-3;) {
    const Vec3 u = direction.unitOrthogonal(), v = direction.cross(u), middle = direction;
    bool better = false;
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * std::numbers::pi * k;
      better |=
          consider((middle + tilt * (std::cos(angle) * u + std::sin(angle) * v)).normalized());
    }
    if (!better) tilt *= 0.5;
  }
  Capsule best = along(local, direction);
  best.start += origin.transpose();
  best.end += origin.transpose();
  return best;
}

}  // namespace bathyal
