// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <kdl/chain.hpp>
#include <kdl/jntarray.hpp>

#include "bathyal/arm/kinematics.hpp"

// An arm as a chain of Orocos KDL: one segment a turning joint. Rows of type fixed, sliding joints,
// Hayati's beta and links are not needed here.

namespace bathyal {

inline KDL::Frame to_kdl(const Pose& pose) {
  const auto& r = pose.linear();
  const auto& t = pose.translation();
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                        r(2, 2)),
          KDL::Vector(t.x(), t.y(), t.z())};
}

/// Its base and root must be the identity: KDL's chain begins with the first joint.
inline KDL::Chain to_kdl(const Arm& arm) {
  KDL::Chain chain;
  for (const Joint& joint : arm.joints()) {
    const DhRow& row = joint.row;
    KDL::Frame behind = KDL::Frame::DH(row.a, row.alpha, row.d, row.theta);
    if (&joint == &arm.joints().back()) behind = behind * to_kdl(arm.flange() * arm.tool());
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), behind));
  }
  return chain;
}

inline KDL::JntArray to_kdl(const double* q, Index size) {
  KDL::JntArray values(static_cast<unsigned>(size));
  std::copy_n(q, size, values.data.data());
  return values;
}

}  // namespace bathyal
