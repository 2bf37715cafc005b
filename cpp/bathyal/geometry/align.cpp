// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/align.hpp"

#include <Eigen/SVD>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {
namespace {

constexpr double kOnALine = 1e-9;  // spread across over spread along

Eigen::RowVector3d centroid(PointView points) {
  const Eigen::RowVector3d origin = points.row(0);
  return origin + (points.rowwise() - origin).colwise().mean();
}

void check_spread(std::string_view name, const PointMatrix& centred) {
  const Vec3 spread =
      Eigen::JacobiSVD<Eigen::Matrix3d>(centred.transpose() * centred).singularValues().cwiseSqrt();
  if (!(spread[1] > kOnALine * spread[0])) {
    throw_argument(name, "points that are not all on one line",
                   std::to_string(centred.rows()) + " that are");
  }
}

}  // namespace

Pose align(PointView from, PointView onto, std::string_view from_name, std::string_view onto_name) {
  if (from.rows() != onto.rows()) {
    throw_argument(
        onto_name,
        "as many rows as `" + std::string(from_name) + "` (" + std::to_string(from.rows()) + ")",
        std::to_string(onto.rows()));
  }
  if (from.rows() < 3) throw_argument(from_name, "three rows or more", std::to_string(from.rows()));
  check_points_finite(from_name, from);
  check_points_finite(onto_name, onto);
  const Eigen::RowVector3d from_centre = centroid(from), onto_centre = centroid(onto);
  const PointMatrix a = from.rowwise() - from_centre, b = onto.rowwise() - onto_centre;
  check_spread(from_name, a);
  check_spread(onto_name, b);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(b.transpose() * a,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  Pose onto_from_from = Pose::Identity();
  onto_from_from.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  onto_from_from.translation() =
      onto_centre.transpose() - onto_from_from.linear() * from_centre.transpose();
  return onto_from_from;
}

}  // namespace bathyal
