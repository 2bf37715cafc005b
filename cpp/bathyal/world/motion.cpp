// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/motion.hpp"

namespace bathyal {

Pose Motion::at(double time) const {
  if (!function_) return trajectory_.at(time);
  const Pose pose = function_(time);
  check_rigid("pose", pose);
  return pose;
}

}  // namespace bathyal
