// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace bathyal::python {

/// Called when the last function and class of a module is bound, and holds for all of them:
/// - arguments that do not fit a function end in "`name`: expected …, got …" of the first one at
///   fault, TypeError for a wrong type and ValueError for a number out of range, and not in the
///   list of signatures that pybind11 answers with;
/// - memory that runs out in C++ names the function (MemoryError);
/// - an object that was made by `__new__` without `__init__` is refused wherever it is used
///   (TypeError): pybind11 would hand out uninitialised memory.
void guard_calls(pybind11::module_& module);

}  // namespace bathyal::python
