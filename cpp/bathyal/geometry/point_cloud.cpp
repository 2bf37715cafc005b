// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/point_cloud.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {

PointCloud::PointCloud(Points points, Attributes attributes, Datum datum)
    : points_(std::move(points)), attributes_(std::move(attributes)), datum_(std::move(datum)) {
  check_attributes(attributes_, points_.rows());
}

PointCloud PointCloud::snapshot() const {
  return PointCloud(points_.snapshot(), bathyal::snapshot(attributes_), datum_);
}

Vec3 local_origin(PointView points) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (Index i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i);
    if (!p.allFinite()) continue;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (!low.allFinite()) return Vec3::Zero();
  return (0.5 * low + 0.5 * high).array().round();
}

void check_points_finite(std::string_view name, PointView points) {
  for (Index i = 0; i < points.rows(); ++i) {
    if (!points.row(i).allFinite()) {
      throw_argument(name, "finite coordinates",
                     "row " + std::to_string(i) + " = (" + to_text(points(i, 0)) + ", " +
                         to_text(points(i, 1)) + ", " + to_text(points(i, 2)) + ")");
    }
  }
}

void check_attributes(const Attributes& attributes, Index count) {
  for (const auto& [name, values] : attributes) {
    if (values.rows() != count) {
      throw_argument("attributes[\"" + name + "\"]", std::to_string(count) + " values, one a point",
                     std::to_string(values.rows()));
    }
  }
}

Attributes snapshot(const Attributes& attributes) {
  Attributes result;
  for (const auto& [name, values] : attributes) result.emplace(name, values.snapshot());
  return result;
}

}  // namespace bathyal
