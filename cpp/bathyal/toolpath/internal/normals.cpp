// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/normals.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "bathyal/base/parallel.hpp"
#include "bathyal/toolpath/internal/sheet_walk.hpp"

namespace bathyal::toolpath {
namespace {

constexpr std::size_t kFewest = 6;  // vertices a fit of three numbers is trusted with
constexpr int kMostTurns = 50;
constexpr double kTurned = 1e-9;  // [rad]

struct Fit {
  Vec3 normal = Vec3::UnitZ();
  double residual = 0.0;     ///< √(Σr² / (n − 3)) [m]
  double slope_trace = 0.0;  ///< tr Cov(g)
};

/// The larger of the measured uncertainty and the residual.
double sigma(const Values* uncertainty, std::int32_t vertex, double residual) {
  if (uncertainty == nullptr) return residual;
  return std::fmax(std::abs(uncertainty->view()(vertex)), residual);
}

/// z = c + g·x over the plane through `centre` with normal `up`.
std::optional<Fit> fit_heights(const TriangleMesh& mesh, const Values* uncertainty,
                               const std::vector<std::int32_t>& vertices, const Vec3& centre,
                               const Vec3& up) {
  if (vertices.size() < kFewest) return std::nullopt;
  const Vec3 e1 = up.unitOrthogonal();
  const Vec3 e2 = up.cross(e1);
  const auto count = static_cast<Index>(vertices.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> x(count, 3);
  Eigen::VectorXd z(count);
  for (Index i = 0; i < count; ++i) {
    const Vec3 d = mesh.vertices().row(vertices[static_cast<std::size_t>(i)]).transpose() - centre;
    x.row(i) << 1.0, e1.dot(d), e2.dot(d);
    z[i] = up.dot(d);
  }
  const double scale = x.rightCols<2>().cwiseAbs().maxCoeff();
  if (!(scale > 0.0)) return std::nullopt;
  x.rightCols<2>() /= scale;
  const Eigen::Matrix3d information = x.transpose() * x;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  if (eigen.eigenvalues()[0] < 1e-6 * eigen.eigenvalues()[2]) return std::nullopt;  // on a line
  const Eigen::Matrix3d inverse = information.inverse();
  const Vec3 solution = inverse * (x.transpose() * z);

  Fit fit;
  fit.residual = std::sqrt((z - x * solution).squaredNorm() / static_cast<double>(count - 3));
  fit.normal = (up - (solution[1] * e1 + solution[2] * e2) / scale).normalized();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (Index i = 0; i < count; ++i) {
    const double s = sigma(uncertainty, vertices[static_cast<std::size_t>(i)], fit.residual);
    scatter += s * s * x.row(i).transpose() * x.row(i);
  }
  const Eigen::Matrix3d covariance = inverse * scatter * inverse;
  fit.slope_trace = (covariance(1, 1) + covariance(2, 2)) / (scale * scale);
  return fit;
}

/// The same over a plane that turns with the fit until it is the fitted one. Over the plane of a
/// steep facet among noisy soundings one fit would stay near that facet: there the noise lies in
/// the places and not in the heights, and flattens the slope.
std::optional<Fit> fit_footprint(const TriangleMesh& mesh, const Values* uncertainty,
                                 const std::vector<std::int32_t>& vertices, const Vec3& centre,
                                 const Vec3& up) {
  std::optional<Fit> fit = fit_heights(mesh, uncertainty, vertices, centre, up);
  for (int turn = 0; fit && turn < kMostTurns; ++turn) {
    const Vec3 before = fit->normal;
    fit = fit_heights(mesh, uncertainty, vertices, centre, before);
    if (fit && (fit->normal - before).norm() < kTurned) break;
  }
  return fit;
}

/// tr Cov(g) of the facet itself: Σ σ_i² (e_i / 2A)².
double facet_slope_trace(const TriangleMesh& mesh, const Values* uncertainty, std::int32_t triangle,
                         double residual) {
  const double twice_area = mesh.area_vector(triangle).norm();
  double trace = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double edge =
        (mesh.corner(triangle, (c + 2) % 3) - mesh.corner(triangle, (c + 1) % 3)).norm();
    const double s = sigma(uncertainty, mesh.triangles()(triangle, c), residual);
    trace += s * s * (edge / twice_area) * (edge / twice_area);
  }
  return trace;
}

void estimate_normal(Piece& piece, const TriangleMesh& mesh, const SheetWalk& walk, double radius) {
  const auto found = mesh.attributes().find("uncertainty");
  const Values* uncertainty = found == mesh.attributes().end() ? nullptr : &found->second;
  const Vec3 middle = 0.5 * (piece.from + piece.to);
  if (radius > 0.0) {
    const auto vertices = walk.vertices_within(piece.triangle, middle, radius);
    if (const auto fit = fit_footprint(mesh, uncertainty, vertices, middle, piece.normal)) {
      piece.normal = fit->normal;
      piece.normal_std = std::atan(std::sqrt(fit->slope_trace));
      return;
    }
  }
  const auto around =
      fit_heights(mesh, nullptr, walk.vertices_around(piece.triangle), middle, piece.normal);
  const double residual = around ? around->residual : std::numeric_limits<double>::quiet_NaN();
  piece.normal_std =
      std::atan(std::sqrt(facet_slope_trace(mesh, uncertainty, piece.triangle, residual)));
}

}  // namespace

void estimate_normals(Route& route, const Surface& surface, double radius, int num_threads) {
  const Scene* scene = std::get_if<Scene>(&surface);
  if (scene == nullptr) return;
  if (radius > 0.0) subdivide(route, radius);
  std::vector<Piece*> pieces;
  for (Run& run : route.runs) {
    for (Piece& piece : run.pieces) pieces.push_back(&piece);
  }
  for (std::int32_t m = 0; m < scene->row_count(); ++m) {
    const auto on_mesh = [m](const Piece* p) { return p->mesh == m; };
    if (std::none_of(pieces.begin(), pieces.end(), on_mesh)) continue;
    const TriangleMesh mesh = scene->mesh_in_world(m);
    const SheetWalk walk(mesh);
    parallel_for(pieces.size(), 256, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        if (on_mesh(pieces[k])) estimate_normal(*pieces[k], mesh, walk, radius);
      }
    });
  }
}

}  // namespace bathyal::toolpath
