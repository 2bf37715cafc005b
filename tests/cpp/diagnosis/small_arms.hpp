// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "bathyal/arm/dh.hpp"

// Arms of few joints for the tests of this room.

namespace bathyal::diagnosis {

inline Arm two_joints() {
  DhTable table;
  table.rows = {{0.5, 0.0, 0.1, 0.0}, {0.4, 0.0, 0.0, 0.0}};
  table.types = {JointType::kRevolute, JointType::kRevolute};
  return arm_from_dh(table);
}

inline Arm three_joints() {
  DhTable table;
  table.rows = {
      {0.1, std::numbers::pi / 2.0, 0.3, 0.0}, {0.5, 0.0, 0.0, 0.0}, {0.4, 0.0, 0.0, 0.0}};
  table.types.assign(3, JointType::kRevolute);
  return arm_from_dh(table);
}

}  // namespace bathyal::diagnosis
