// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/workspace/reach/reach_map.hpp"

namespace bathyal::workspace {

/// How deep in the free part of a reach map a point lies.
class ReachDepth {
 public:
  ReachDepth(const ReachMap& map, int num_threads);

  /// From the point to the nearest voxel that is not free, between middles, less half a voxel [m];
  /// interpolated. 0 outside.
  double at(const Vec3& point) const;

  /// Of the voxel that the point lies in, without interpolation.
  float of_voxel(const Vec3& point) const {
    const Eigen::Array3d at = ((point - origin_) * inverse_).array();
    if (!((at >= 0.0).all() && (at < size_).all())) return 0.0F;
    return depth_[index(static_cast<Index>(at[0]), static_cast<Index>(at[1]),
                        static_cast<Index>(at[2]))];
  }

  bool empty() const { return empty_; }
  const Vec3& low() const { return low_; }  ///< of the box of what is free
  const Vec3& high() const { return high_; }

 private:
  std::size_t index(Index i, Index j, Index k) const {
    return static_cast<std::size_t>((i * count_[1] + j) * count_[2] + k);
  }

  Vec3 origin_, low_, high_;
  double voxel_, inverse_;
  Eigen::Array<Index, 3, 1> count_;
  Eigen::Array3d size_;
  std::vector<float> depth_;
  bool empty_ = true;
};

}  // namespace bathyal::workspace
