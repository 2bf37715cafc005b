// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace bathyal::python {

/// Functions of the package that the engine calls. The package hands them in when it is imported:
/// the engine itself imports nothing of it.
enum class Hook {
  kFindEffect,        ///< name → Effect: of the library, or registered
  kWarnOfSupport,     ///< (model, q, covariates, uses): a call beyond what the data covered
  kWarnOfRange,       ///< (text): a formula of the water outside its range
  kSoundSpeedTeos10,  ///< (T, S, pressure, latitude, longitude) → (N,) [m/s], of gsw
  kMeshVertices,  ///< Shape → (N, 3) corners of its mesh along its scale, None if it cannot be read
};

/// \throw std::logic_error where none was handed in
pybind11::object hook(Hook which);

/// find_effect_with and the others: how they are handed in.
void bind_hooks(pybind11::module_& module);

}  // namespace bathyal::python
