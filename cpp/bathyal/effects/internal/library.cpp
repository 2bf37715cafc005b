// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/internal/library.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"

namespace bathyal {

std::vector<std::shared_ptr<const Effect>> library_effects() {
  using namespace effects;
  return {joint_harmonic(),   joint_map(),       joint_scale(), joint_coupling(), backlash(),
          joint_compliance(), link_compliance(), payload(),     base_shift(),     base_compliance(),
          tool_slip(),        tool_change(),     thermal(),     drift(),          clock_shift(),
          outliers(),         range_noise(),     quantisation()};
}

}  // namespace bathyal

namespace bathyal::effects {

bool slides(const Arm& arm, int coordinate) {
  const auto leads = [coordinate](const Joint& joint) { return joint.coordinate == coordinate; };
  const auto leader = std::find_if(arm.joints().begin(), arm.joints().end(), leads);
  return leader != arm.joints().end() && leader->type == JointType::kPrismatic;
}

std::string describe_joint(int coordinate, const Arm& arm) {
  const std::string number = std::to_string(coordinate + 1);
  const auto& joints = arm.joints();
  const auto joint = std::find_if(joints.begin(), joints.end(), [&](const Joint& other) {
    return other.type != JointType::kFixed && other.coordinate == coordinate;
  });
  const bool named =
      joint != joints.end() && !joint->name.empty() && joint->name != "joint_" + number;
  return "joint " + number + (named ? " (" + joint->name + ")" : "");
}

std::string unit_of(const Arm& arm, int coordinate) {
  return slides(arm, coordinate) ? "m" : "rad";
}

bool varies(const Eigen::VectorXd& numbers) {
  if (numbers.size() == 0) return false;
  const double high = numbers.maxCoeff(), low = numbers.minCoeff();
  return high - low > 1e-9 * std::max(std::abs(high), std::abs(low));
}

int joint_of(const EffectVariant& variant, const EffectData& data) {
  const auto count = static_cast<int>(data.q.cols());
  if (variant.joint < 0 || variant.joint >= count) {
    throw_argument("joint of " + variant.effect, "one from 0 to " + std::to_string(count - 1),
                   std::to_string(variant.joint));
  }
  return variant.joint;
}

double setting_of(const EffectVariant& variant, const std::string& name) {
  const auto found = variant.settings.find(name);
  if (found == variant.settings.end()) {
    throw_argument("settings of " + variant.effect, name, "none of that name");
  }
  return found->second;
}

int index_of(const EffectVariant& variant, const std::string& name, Index count) {
  const double number = setting_of(variant, name);
  const bool fits =
      number == std::floor(number) && number >= 0.0 && number < static_cast<double>(count);
  if (!fits) {
    throw_argument("setting " + name + " of " + variant.effect,
                   "a whole number from 0 to " + std::to_string(count - 1), to_text(number));
  }
  return static_cast<int>(number);
}

Perturbation move_joint(int coordinate, const Eigen::VectorXd& values) {
  return {PerturbationSite::kJoint, coordinate, values};
}

Perturbation move_frame(int frame, int axis, const Eigen::VectorXd& values) {
  if (axis < 0 || axis >= 6) {
    throw_argument("axis of a frame", "one from 0 to 5", std::to_string(axis));
  }
  RowMatrix all = RowMatrix::Zero(values.size(), 6);
  all.col(axis) = values;
  return {PerturbationSite::kFrame, frame, std::move(all)};
}

std::vector<std::string> frame_axes(const std::string& shift, const std::string& turn, bool turns) {
  std::vector<std::string> names{shift + "_x", shift + "_y", shift + "_z"};
  for (const char* axis : {"_x", "_y", "_z"}) {
    if (turns) names.push_back(turn + axis);
  }
  return names;
}

}  // namespace bathyal::effects
