// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "bathyal/effects/effect.hpp"

// Bindings of effects, and effects defined in Python.

namespace bathyal::python {

/// Where an effect of a user acts.
enum class UserSite { kJoint, kLink, kBase, kTool, kLengths };

/// The description of a user-defined effect.
struct UserEffect {
  EffectInfo info;
  std::vector<EffectParameter> parameters;
  UserSite site = UserSite::kJoint;
  bool each_joint = false;
  bool acts_by_joint() const { return site == UserSite::kJoint || site == UserSite::kLink; }
  std::vector<int> joints;  ///< of kJoint and kLink, unless it is each of them
  double period = std::numeric_limits<double>::infinity();
};

/// An effect whose numbers come from a Python function. It takes the GIL for each call, and reports
/// errors of the function with the name of the effect.
/// \throw std::invalid_argument for an invalid description.
std::shared_ptr<Effect> make_python_effect(UserEffect description, pybind11::function function);

/// The argument of the function; to be bound before the class Effect.
void bind_effect_rows(pybind11::module_& module);

}  // namespace bathyal::python
