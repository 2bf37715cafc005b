// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/from_mesh.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/geometry/mesh_report.hpp"
#include "bathyal/geometry/solid.hpp"

namespace bathyal {
namespace {

constexpr int kMostPartsAlong = 8;

/// Axes of the second moments, each the nearest to the vehicle's of its number.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& second) {
  const double aside = std::abs(second(0, 1)) + std::abs(second(0, 2)) + std::abs(second(1, 2));
  if (aside <= 1e-9 * second.trace()) return Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second);
  std::array<int, 3> order{0, 1, 2}, best = order;
  double closest = -1.0;
  do {
    double along = 0.0;
    for (int i = 0; i < 3; ++i) {
      along += std::abs(solver.eigenvectors()(i, order[static_cast<std::size_t>(i)]));
    }
    if (along > closest) closest = along, best = order;
  } while (std::next_permutation(order.begin(), order.end()));
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    axes.col(i) = solver.eigenvectors().col(best[static_cast<std::size_t>(i)]);
    if (axes(i, i) < 0.0) axes.col(i) *= -1.0;
  }
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  return axes;
}

/// ½ ρ C ∫ 2 width |x|³ dx of the strips along `a` that are `width` wide: of an ellipsoid.
double strip_moment(double a, double width) { return 8.0 / 15.0 * width * std::pow(a, 4); }

void add_drag(VehicleOptions& options, const Vec3& axes, const Vec3& coefficient) {
  const double half_density = 0.5 * options.water_density;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double area = M_PI * axes[j] * axes[k];
    options.terms.push_back({i, i, i, true, -half_density * coefficient[i] * area});
    const double moment = coefficient[k] * strip_moment(axes[j], axes[i]) +
                          coefficient[j] * strip_moment(axes[k], axes[i]);
    options.terms.push_back({3 + i, 3 + i, 3 + i, true, -half_density * moment});
  }
}

/// Balls that fill the hull's box evenly, balanced about the origin.
std::vector<VehiclePart> parts_of(const Vec3& size) {
  const double radius = 0.5 * size.minCoeff();
  std::array<int, 3> count{};
  for (int i = 0; i < 3; ++i) {
    count[static_cast<std::size_t>(i)] = std::clamp(
        static_cast<int>(std::ceil(size[i] / (2.0 * radius) - 1e-9)), 1, kMostPartsAlong);
  }
  const auto place = [&](int axis, int row) {
    const int n = count[static_cast<std::size_t>(axis)];
    return n == 1 ? 0.0 : (size[axis] - 2.0 * radius) * (row / (n - 1.0) - 0.5);
  };
  std::vector<VehiclePart> parts;
  for (int i = 0; i < count[0]; ++i) {
    for (int j = 0; j < count[1]; ++j) {
      for (int k = 0; k < count[2]; ++k) {
        parts.push_back({Vec3(place(0, i), place(1, j), place(2, k)), radius, 1.0});
      }
    }
  }
  return parts;
}

/// Of a body whose axes are askew in the vehicle's.
Mat6 turned(const Mat6& matrix, const Eigen::Matrix3d& axes) {
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = axes;
  const Mat6 result = turn * matrix * turn.transpose();
  return 0.5 * (result + result.transpose());
}

}  // namespace

void FromMeshOptions::check() const {
  if (mass) check_positive("mass", *mass);
  for (int i = 0; i < 3; ++i) check_not_negative("drag_coefficient", drag_coefficient[i]);
  check_not_negative("gravity", gravity);
  check_positive("water_density", water_density);
}

VehicleFromMesh vehicle_from_mesh(const TriangleMesh& mesh, const FromMeshOptions& given) {
  given.check();
  const SolidMoments solid = solid_moments(mesh, "mesh");
  VehicleFromMesh made;
  made.vehicle_from_mesh.translation() = -solid.centroid;
  VehicleOptions& options = made.options;
  options.name = "hull";
  options.gravity = given.gravity;
  options.water_density = given.water_density;
  options.body.volume = solid.volume;
  options.body.mass = given.mass.value_or(given.water_density * solid.volume);
  options.body.center_of_mass =
      given.center_of_mass ? Vec3(*given.center_of_mass - solid.centroid) : Vec3(Vec3::Zero());
  const Eigen::Matrix3d even = options.body.mass / solid.volume *
                               (solid.second.trace() * Eigen::Matrix3d::Identity() - solid.second);
  options.body.inertia = given.inertia.value_or(even);

  const Eigen::Matrix3d axes = principal_axes(solid.second);
  const Vec3 roots = (axes.transpose() * solid.second * axes).diagonal().cwiseMax(0.0).cwiseSqrt();
  const double scale = std::cbrt(solid.volume / (4.0 / 3.0 * M_PI * roots.prod()));
  made.half_axes = scale * roots;
  options.added_mass = turned(ellipsoid_added_mass(made.half_axes, given.water_density), axes);
  add_drag(options, made.half_axes, given.drag_coefficient);
  const MeshReport report = mesh_report(mesh);
  options.parts = parts_of(report.high - report.low);
  return made;
}

}  // namespace bathyal
