// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/forward_program.hpp"

#include <cmath>

namespace bathyal::arm {
namespace {

StepKind kind_of(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return StepKind::kRevolute;
    case JointType::kPrismatic:
      return StepKind::kPrismatic;
    case JointType::kFixed:
      break;
  }
  return StepKind::kFixed;
}

ForwardStep step_of(const Joint& joint, int& coordinates) {
  const DhRow& row = joint.row;
  ForwardStep step{};
  step.kind = kind_of(joint.type);
  if (step.kind != StepKind::kFixed) {
    step.coordinate = static_cast<std::size_t>(joint.coordinate);
    step.leads = joint.coordinate == coordinates;
    if (step.leads) ++coordinates;
    step.multiplier = joint.multiplier;
    step.offset = joint.offset;
  }
  step.turned = row.alpha != 0.0;
  step.tilted = row.beta != 0.0;
  step.theta = row.theta;
  step.cos_theta = std::cos(row.theta);
  step.sin_theta = std::sin(row.theta);
  step.d = row.d;
  step.a = row.a;
  step.cos_alpha = std::cos(row.alpha);
  step.sin_alpha = std::sin(row.alpha);
  step.cos_beta = std::cos(row.beta);
  step.sin_beta = std::sin(row.beta);
  return step;
}

}  // namespace

PlainPose plain(const Pose& pose) {
  PlainPose result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.rotation[3 * i + j] = pose.linear()(i, j);
    result.translation[i] = pose.translation()[i];
  }
  return result;
}

Program::Program(const Arm& arm) {
  int coordinates = 0;
  for (const Joint& joint : arm.joints()) steps.push_back(step_of(joint, coordinates));
  for (const Link& link : arm.links()) row_from_link.push_back(plain(link.row_from_link));
  view = {steps.data(),
          steps.size(),
          static_cast<std::size_t>(arm.size()),
          plain(arm.base() * arm.root()),
          plain(arm.flange() * arm.tool()),
          row_from_link.data()};
}

}  // namespace bathyal::arm
