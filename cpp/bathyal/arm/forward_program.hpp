// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/arm/forward_kernel.hpp"

namespace bathyal::arm {

PlainPose plain(const Pose& pose);

/// An arm as the kernels take it; `view` points into it.
struct Program {
  explicit Program(const Arm& arm);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::vector<ForwardStep> steps;
  std::vector<PlainPose> row_from_link;
  ForwardProgram view;
};

}  // namespace bathyal::arm
