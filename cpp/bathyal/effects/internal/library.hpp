// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

// The effects of the library and what they share.

namespace bathyal::effects {

// joints.cpp
std::shared_ptr<const Effect> joint_harmonic();
std::shared_ptr<const Effect> joint_map();
std::shared_ptr<const Effect> joint_scale();
std::shared_ptr<const Effect> joint_coupling();
std::shared_ptr<const Effect> backlash();
// gravity.cpp
std::shared_ptr<const Effect> joint_compliance();
std::shared_ptr<const Effect> payload();
// bending.cpp
std::shared_ptr<const Effect> link_compliance();
std::shared_ptr<const Effect> base_compliance();
// sessions.cpp
std::shared_ptr<const Effect> base_shift();
std::shared_ptr<const Effect> tool_slip();
std::shared_ptr<const Effect> tool_change();
// conditions.cpp
std::shared_ptr<const Effect> thermal();
std::shared_ptr<const Effect> drift();
std::shared_ptr<const Effect> clock_shift();
// noise.cpp
std::shared_ptr<const Effect> outliers();
std::shared_ptr<const Effect> range_noise();
std::shared_ptr<const Effect> quantisation();

inline constexpr double kTypicalError = 1e-3;  ///< [m] or [rad]

using Perturbations = std::vector<std::vector<Perturbation>>;

/// Whether the joint that defines a coordinate is prismatic.
bool slides(const Arm& arm, int coordinate);
/// "rad" or "m"
std::string unit_of(const Arm& arm, int coordinate);
/// "joint 3 (elbow)", counted from 1.
std::string describe_joint(int coordinate, const Arm& arm);
/// Whether any two of the numbers differ by more than rounding.
bool varies(const Eigen::VectorXd& numbers);
inline bool moves(const EffectData& data, int coordinate) { return varies(data.q.col(coordinate)); }

// A variant may come from a file: what does not fit the arm is refused.
/// \throw std::invalid_argument for a variant without a joint, or with one that the arm has not
int joint_of(const EffectVariant& variant, const EffectData& data);
/// \throw std::invalid_argument where there is none
double setting_of(const EffectVariant& variant, const std::string& name);
/// A setting that is an index: a whole number from 0 to count - 1.
/// \throw std::invalid_argument for any other, and where there is none
int index_of(const EffectVariant& variant, const std::string& name, Index count);

Perturbation move_joint(int coordinate, const Eigen::VectorXd& values);
/// The `axis`-th of shift x y z, turn x y z of a frame.
Perturbation move_frame(int frame, int axis, const Eigen::VectorXd& values);

/// "shift_x" … "shift_z" and, where turns are wanted, "turn_x" … "turn_z".
std::vector<std::string> frame_axes(const std::string& shift, const std::string& turn, bool turns);

}  // namespace bathyal::effects
