// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

// Effects at the border: what Python sees of them, and those that Python brings.

namespace bathyal::python {

/// Where an effect of a user acts.
enum class UserSite { kJoint, kBase, kTool, kLengths };

/// What a user tells of an effect of their own.
struct UserEffect {
  EffectInfo info;
  std::vector<EffectParameter> parameters;
  UserSite site = UserSite::kJoint;
  bool each_joint = false;
  std::vector<int> joints;  ///< of kJoint, unless it is each of them
  double period = std::numeric_limits<double>::infinity();
};

/// An effect whose numbers come from a Python function. It takes the GIL for each call, and tells
/// whatever goes wrong in there by the effect's name.
/// \throw std::invalid_argument for what is told amiss.
std::shared_ptr<Effect> make_python_effect(UserEffect told, pybind11::function function);

/// What the function is given; before the class Effect.
void bind_effect_rows(pybind11::module_& module);

}  // namespace bathyal::python
