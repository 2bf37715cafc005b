// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "bathyal/workspace/hull_report.hpp"

namespace bathyal {

/// A box of cubes and which of their middles lie inside a hull (Maevskiy, Zanin 2020: the array of
/// inside voxels). Voxel (i, j, k) is number (i · count[1] + j) · count[2] + k; it reaches from
/// origin + size · (i, j, k) to origin + size · (i + 1, j + 1, k + 1).
struct Voxels {
  Vec3 origin = Vec3::Zero();  ///< [m]
  double size = 0.0;           ///< of an edge [m]
  Eigen::Array3i count{0, 0, 0};
  std::shared_ptr<bool[]> inside;  ///< of each voxel

  std::size_t total() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
};

/// The body of a vehicle, in the vehicle's frame: what an arm must stay out of. Any mesh that
/// encloses a volume will do: turned inside out, self-intersecting, in several parts, with holes;
/// inside is that of Scene::contains. Immutable, cheap to copy; any number of threads may query it.
class Hull {
 public:
  /// \throw std::invalid_argument for a mesh that encloses nothing: without triangles, or flat.
  explicit Hull(TriangleMesh mesh, int num_threads = 0);

  const TriangleMesh& mesh() const { return scene_.meshes().front(); }
  const Scene& scene() const { return scene_; }
  bool closed() const;

  /// What is wrong with the mesh. Made at the first call.
  const HullReport& report() const;

  /// The answer of Scene::contains for each point, sooner. Of many points, each is first looked up
  /// in a grid of voxels: where no triangle passes within its voxel it has the voxel's answer;
  /// elsewhere the triangles of the voxel that lie between it and a point of known winding number
  /// are counted, each with its sign. What rounding could change (a point on the surface, to 1e-14
  /// of the hull's size), or a film over a hole, is left to Scene::contains. The grid is made at
  /// the first call with many points.
  /// \throw std::invalid_argument for a point that is not finite, or `inside` of another length.
  void contains(PointView points, std::span<bool> inside, int num_threads = 0) const;

  /// Distance to the surface of each point, below 0 inside [m].
  /// \throw std::invalid_argument for a point that is not finite.
  std::vector<double> signed_distance(PointView points, int num_threads = 0) const;

  /// The hull's bounding box filled with voxels of edge `size` [m], each inside where its middle
  /// is. \throw std::invalid_argument for a size that is not positive, or of more than 2²⁸ voxels.
  Voxels voxels(double size, int num_threads = 0) const;

 private:
  struct State;
  Scene scene_;
  std::shared_ptr<const State> state_;
};

}  // namespace bathyal
