// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/effects/effect.hpp"

// The weight of an arm and of its payload at each pose. In air: buoyancy is not subtracted.

namespace bathyal {

/// Whether any link beyond the first frame has a mass.
bool masses_known(const Arm& arm);

/// A mass and where it hangs: all that uniform gravity asks of bodies together.
struct Burden {
  double mass = 0.0;           ///< [kg]
  Vec3 moment = Vec3::Zero();  ///< Σ mass · place, in the base frame [kg m]
};

/// A force and its moment [N, N m], in the base frame.
struct GravityLoad {
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
};

class GravityLoads {
 public:
  enum class Bodies { kNone, kArm };

  /// The links of the arm, or none; `payload` (N,) [kg] hangs at the tool centre point. `data` must
  /// outlive it.
  GravityLoads(const EffectData& data, Bodies bodies, Eigen::VectorXd payload);

  /// Of a pose, in the base frame.
  const RowFrames& frames(Index row) const { return frames_[row]; }
  /// Weight of the links from `link` on (link k moves with joint k - 1) and of the payload, and its
  /// moment about `center`.
  GravityLoad beyond(Index row, std::size_t link, const Vec3& center) const;
  /// (N,) torque [N m] (of a sliding joint: force [N]) of gravity along a coordinate.
  Eigen::VectorXd torque(int coordinate) const;
  /// The same of one body that hangs on `link` alone: (mass, moment in the base frame) of a row.
  double torque_of(int coordinate, Index row, std::size_t link, const Burden& body) const;

 private:
  const EffectData& data_;
  std::vector<RowFrames> frames_;
  std::vector<std::vector<Burden>> beyond_;  ///< of each row, from link 0 … links, payload last
};

/// The payload that was recorded, else 0. (N,)
Eigen::VectorXd payload_of(const EffectData& data);

}  // namespace bathyal
