// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "water_parts.hpp"

namespace bathyal::python {

py::tuple water_state(const Water& water) {
  const WaterOptions& o = water.options();
  return py::make_tuple(o.surface, o.reference_depth, o.profiles, o.time, o.temperature, o.salinity,
                        o.sound_speed, formula_name(o.formula), o.ph, o.latitude, o.current,
                        o.waves, o.tide);
}

Water water_from_state(const py::tuple& state) {
  using Maybe = std::optional<double>;
  WaterOptions o;
  o.surface = state[0].cast<Maybe>();
  o.reference_depth = state[1].cast<double>();
  o.profiles = state[2].cast<std::vector<WaterProfile>>();
  o.time = state[3].cast<std::vector<double>>();
  o.temperature = state[4].cast<double>();
  o.salinity = state[5].cast<double>();
  o.sound_speed = state[6].cast<Maybe>();
  o.formula = *speed_formula_argument(state[7].cast<std::string>()).formula;
  o.ph = state[8].cast<double>();
  o.latitude = state[9].cast<double>();
  o.current = state[10].cast<Current>();
  o.waves = state[11].cast<Waves>();
  o.tide = state[12].cast<Tide>();
  o.check();
  return Water(std::move(o));
}

}  // namespace bathyal::python
