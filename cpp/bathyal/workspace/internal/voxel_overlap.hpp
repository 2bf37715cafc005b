// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::workspace {

/// Voxels of edge `size` from the origin of their frame.
struct VoxelFrame {
  double size;  ///< [m]
  Eigen::Array3i count;

  int layer(double x, int axis) const {
    return static_cast<int>(std::clamp(std::floor(x / size), 0.0, count[axis] - 1.0));
  }
};

/// Voxels are enlarged by this part of their size, which covers rounding and thin triangles.
inline constexpr double kVoxelPad = 1e-3;

/// A triangle lower than this part of its longest edge is taken as that edge.
inline constexpr double kThin = 1e-6;

namespace overlap {

using Corners = std::array<Vec3, 3>;

/// Voxels along the longest edge of a triangle without area.
template <class Visit>
void visit_edge(const VoxelFrame& frame, const Corners& corners, const Visit& visit) {
  std::array<std::pair<double, int>, 3> edges;
  for (int c = 0; c < 3; ++c) {
    const auto at = static_cast<std::size_t>(c);
    edges[at] = {(corners[(at + 1) % 3] - corners[at]).squaredNorm(), c};
  }
  const auto from = static_cast<std::size_t>(std::max_element(edges.begin(), edges.end())->second);
  const Vec3 a = corners[from], along = corners[(from + 1) % 3] - a;
  Index w = 0;
  along.cwiseAbs().maxCoeff(&w);
  const int axis = static_cast<int>(w), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double pad = kVoxelPad * frame.size;
  const auto [low, high] = std::minmax({a[w], a[w] + along[w]});
  Eigen::Array3i at;
  for (at[axis] = frame.layer(low - pad, axis); at[axis] <= frame.layer(high + pad, axis);
       ++at[axis]) {
    const auto share = [&](double x) {
      return along[w] == 0.0 ? 0.0 : std::clamp((x - a[w]) / along[w], 0.0, 1.0);
    };
    const Vec3 p = a + share(at[axis] * frame.size - pad) * along;
    const Vec3 q = a + share((at[axis] + 1) * frame.size + pad) * along;
    const auto [u_low, u_high] = std::minmax(p[u], q[u]);
    const auto [v_low, v_high] = std::minmax(p[v], q[v]);
    for (at[u] = frame.layer(u_low - pad, u); at[u] <= frame.layer(u_high + pad, u); ++at[u]) {
      for (at[v] = frame.layer(v_low - pad, v); at[v] <= frame.layer(v_high + pad, v); ++at[v]) {
        visit(at[0], at[1], at[2]);
      }
    }
  }
}

/// The sides of a triangle's shadow on the u, v plane, each as outwards · (u, v) ≤ offset.
struct Shadow {
  Shadow(const Corners& corners, int u, int v) {
    const auto cross = [&](const Vec3& p, const Vec3& q) { return p[u] * q[v] - p[v] * q[u]; };
    const double turn = cross(corners[1] - corners[0], corners[2] - corners[0]) < 0.0 ? -1.0 : 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 edge = turn * (corners[(c + 1) % 3] - corners[c]);
      out_u[c] = edge[v];
      out_v[c] = -edge[u];
      offset[c] = edge[v] * corners[c][u] - edge[u] * corners[c][v];
    }
  }

  /// Whether a square of half edge `half` may meet it.
  bool meets(double u, double v, double half) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const double nearest =
          out_u[c] * u + out_v[c] * v - half * (std::abs(out_u[c]) + std::abs(out_v[c]));
      if (nearest > offset[c]) return false;
    }
    return true;
  }

  std::array<double, 3> out_u, out_v, offset;
};

}  // namespace overlap

/// Calls visit(i, j, k) once for each voxel that the triangle meets, and for few others: its shadow
/// along the main axis of its normal is walked column by column, each over the heights that the
/// plane has in it. `normal`: of unit length; zero for a triangle lower than kThin.
template <class Visit>
void for_each_voxel(const VoxelFrame& frame, const std::array<Vec3, 3>& corners, const Vec3& normal,
                    const Visit& visit) {
  if (normal.isZero(0.0)) return overlap::visit_edge(frame, corners, visit);
  Index w = 0;
  normal.cwiseAbs().maxCoeff(&w);
  const int axis = static_cast<int>(w), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 pad = Vec3::Constant(kVoxelPad * frame.size);
  const Vec3 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) - pad;
  const Vec3 high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) + pad;
  const overlap::Shadow shadow(corners, u, v);
  const double half = frame.size / 2.0 + pad[0];
  const double slope_u = normal[u] / normal[w], slope_v = normal[v] / normal[w];
  const double height = normal.dot(corners[0]) / normal[w];
  const double rise = (std::abs(slope_u) + std::abs(slope_v)) * half + pad[0];
  Eigen::Array3i at;
  for (at[u] = frame.layer(low[u], u); at[u] <= frame.layer(high[u], u); ++at[u]) {
    for (at[v] = frame.layer(low[v], v); at[v] <= frame.layer(high[v], v); ++at[v]) {
      const double mid_u = (at[u] + 0.5) * frame.size, mid_v = (at[v] + 0.5) * frame.size;
      if (!shadow.meets(mid_u, mid_v, half)) continue;
      const double middle = height - slope_u * mid_u - slope_v * mid_v;
      const int first = frame.layer(std::max(low[w], middle - rise), axis);
      const int last = frame.layer(std::min(high[w], middle + rise), axis);
      for (at[axis] = first; at[axis] <= last; ++at[axis]) visit(at[0], at[1], at[2]);
    }
  }
}

}  // namespace bathyal::workspace
