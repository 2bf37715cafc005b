// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"
#include "bindings.hpp"

namespace bathyal::python {

void bind_toolpath(py::module_& /*module*/) {}

}  // namespace bathyal::python
