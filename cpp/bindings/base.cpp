// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/base/simd.hpp"
#include "bindings.hpp"

namespace bathyal::python {

namespace py = pybind11;

void bind_base(py::module_& module) {
  py::register_exception<Error>(module, "Error", PyExc_RuntimeError).attr("__doc__") =
      "A broken file, a solver that failed or a part that is not installed.";

  module.def(
      "simd_level", [] { return std::string(to_text(simd_level())); },
      "The instruction set in use: \"baseline\" (x86-64-v2), \"avx2\" or \"avx512\".");
  module.def(
      "set_simd_level",
      [](const std::string& level) {
        for (const SimdLevel known : available_simd_levels()) {
          if (to_text(known) == level) return set_simd_level(known);
        }
        throw_argument("level", "one of baseline, avx2, avx512 that this machine can run", level);
      },
      py::arg("level"),
      "Choose a lower instruction set, for tests and benchmarks: results are the same bytes.");
}

}  // namespace bathyal::python
