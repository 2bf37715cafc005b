// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/solid.hpp"

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/geometry/mesh_report.hpp"

namespace bathyal {

SolidMoments solid_moments(const TriangleMesh& mesh, std::string_view name) {
  const MeshReport report = mesh_report(mesh);
  if (!report.closed) {
    throw_argument(
        name, "a closed mesh, every edge of two triangles",
        std::to_string(report.boundary_edges + report.nonmanifold_edges) + " other edges");
  }
  const Vec3 middle = 0.5 * (report.low + report.high);
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - middle, b = mesh.corner(t, 1) - middle,
               c = mesh.corner(t, 2) - middle;
    const double part = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    volume += part;
    first += part / 4.0 * sum;
    second += part / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const double size = (report.high - report.low).maxCoeff();
  if (!(std::abs(volume) > 1e-12 * size * size * size)) {
    throw_argument(name, "a mesh that holds a volume", to_text(volume) + " m³");
  }
  SolidMoments moments;
  moments.volume = std::abs(volume);
  const Vec3 off = first / volume;
  moments.centroid = middle + off;
  moments.second = (second - volume * off * off.transpose()) * (volume < 0.0 ? -1.0 : 1.0);
  return moments;
}

}  // namespace bathyal
