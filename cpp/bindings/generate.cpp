// SPDX-License-Identifier: BSD-3-Clause
#include "generate.hpp"

#include "bindings.hpp"

namespace bathyal::python {

void bind_generate(py::module_& module) {
  bind_seabed_model(module);
  bind_pipeline(module);
  bind_solids(module);
  bind_fish_paths(module);
}

}  // namespace bathyal::python
