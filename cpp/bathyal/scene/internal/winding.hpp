// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "bathyal/scene/scene.hpp"

namespace bathyal::scene {

/// What a triangle with these corners, given relative to the query, adds to 4π · winding number:
/// its signed solid angle, positive where the query sees its back (Van Oosterom, Strackee 1983).
/// Exactly 0 for a query in the triangle's plane: on the triangle itself that is the mean of the
/// two sides.
double solid_angle(const std::array<Vec3, 3>& corners);

/// Everything about a lane's triangles that a far query needs (Barill et al. 2018, to first order
/// about the centre), in the hierarchy's frame.
struct Cluster {
  Vec3 centre = Vec3::Zero();                        ///< of the area
  Vec3 area_vector = Vec3::Zero();                   ///< ∫ n dA [m²]
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  ///< ∫ (x − centre) nᵀ dA [m³]
  double area = 0.0;                                 ///< [m²]
  double spread = 0.0;                               ///< ∫ |x − centre|² dA [m⁴]
  double radius = 0.0;                               ///< no less than |x − centre| of any x [m]
};

/// The clusters of a hierarchy's lanes, eight a node. Made at the first query: programs that only
/// cast rays do not pay for them.
class Clusters {
 public:
  /// Any number of threads may call it at once.
  const std::vector<Cluster>& of(const Scene::Hierarchy& hierarchy, int num_threads) const;

  std::size_t bytes() const { return bytes_.load(); }

 private:
  mutable std::once_flag made_;
  mutable std::vector<Cluster> clusters_;
  mutable std::atomic<std::size_t> bytes_{0};
};

}  // namespace bathyal::scene
