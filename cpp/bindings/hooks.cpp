// SPDX-License-Identifier: BSD-3-Clause
#include "hooks.hpp"

#include <array>
#include <stdexcept>

namespace bathyal::python {
namespace {

namespace py = pybind11;

/// Never freed: the interpreter may be gone before this library is.
py::object& stored(Hook which) {
  static auto* hooks = new std::array<py::object, 5>;
  return (*hooks)[static_cast<std::size_t>(which)];
}

}  // namespace

py::object hook(Hook which) {
  const py::object& found = stored(which);
  if (!found) throw std::logic_error("bathyal._core is used without the package bathyal");
  return found;
}

void bind_hooks(py::module_& module) {
  module.def(
      "find_effect_with", [](const py::function& find) { stored(Hook::kFindEffect) = find; },
      py::arg("find"), "Hand in what finds an effect by its name.");
  module.def(
      "warn_of_support_with", [](const py::function& warn) { stored(Hook::kWarnOfSupport) = warn; },
      py::arg("warn"), "Hand in what warns of a call beyond the support of a corrected arm.");
  module.def(
      "warn_of_range_with", [](const py::function& warn) { stored(Hook::kWarnOfRange) = warn; },
      py::arg("warn"), "Hand in what warns of a formula of the water outside its range.");
  module.def(
      "sound_speed_teos10_with",
      [](const py::function& speed) { stored(Hook::kSoundSpeedTeos10) = speed; }, py::arg("speed"),
      "Hand in the sound speed of TEOS-10.");
  module.def(
      "read_mesh_with", [](const py::function& read) { stored(Hook::kMeshVertices) = read; },
      py::arg("read"), "Hand in what reads the corners of a shape's mesh.");
}

}  // namespace bathyal::python
