// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bathyal/scene/scene.hpp"
#include "bathyal/workspace/internal/welded_mesh.hpp"

namespace bathyal::workspace {

enum class Side : std::uint8_t { kOutside, kInside, kUnknown };

/// A first look at whether points lie inside a mesh: voxels over its bounding box, each with the
/// triangles that pass through it, a reference point near its middle and the winding number there.
/// From the reference to a query of the same voxel the winding number changes by ±1 at each
/// triangle in between, and smoothly by no more than its gradient, which only open edges cause:
/// |∇w| ≤ Σ length / (4π distance²) (the law of Biot and Savart for their solid angle). An answer
/// is given only where rounding and the smooth part cannot change it.
class InsideGrid {
 public:
  InsideGrid(const Scene& scene, const WeldedMesh& mesh, const std::vector<OpenEdge>& open,
             int num_threads);

  Side look(const Vec3& point) const;

 private:
  /// Corners in the grid's frame, and the plane through them: distance = normal · x − offset, of
  /// which `tolerance` may be rounding [m]. The tolerance of one without area is infinite.
  struct Facet {
    Vec3 normal;
    double offset, tolerance;
    std::array<Vec3, 3> corners;
  };
  /// Triangles between two points of the grid's frame, front to back less back to front; `known`
  /// where none is so close to an end or to the line that rounding decides.
  struct Crossings {
    int count = 0;
    bool known = true;
  };

  Side side_of(float winding, std::size_t voxel) const;
  std::size_t voxel(int i, int j, int k) const;
  Vec3 reference(int i, int j, int k) const;
  std::span<const std::int32_t> facets_of(std::size_t voxel) const;
  template <class Skip>
  Crossings crossings(const Vec3& from, const Vec3& to, std::size_t voxel, const Skip& skip) const;

  void make_facets(const WeldedMesh& mesh, int num_threads);
  void fill_lists();
  void find_windings_of_closed(const Scene& scene, int num_threads);
  void find_windings_of_open(const Scene& scene, const WeldedMesh& mesh,
                             const std::vector<OpenEdge>& open, int num_threads);
  void mark_empty_voxels();

  Vec3 low_;     ///< corner of the grid, in the mesh's frame: its frame begins here
  double size_;  ///< of a voxel [m]
  Eigen::Array3i count_;
  double rounding_ = 0.0;        ///< of coordinates [m]
  double edge_tolerance_ = 0.0;  ///< rounding of the triple products of `crossings` [m³]
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> begin_;  ///< first list entry of each voxel, and the end
  std::vector<std::int32_t> list_;    ///< facets by voxel, ascending
  std::vector<Side> side_;            ///< of whole voxels; unknown: look at its facets
  std::vector<float> winding_;        ///< at the reference points
  std::vector<float> change_;         ///< how far it may differ in the voxel; empty: closed
};

}  // namespace bathyal::workspace
