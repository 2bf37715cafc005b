// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/water/ambient_noise.hpp"
#include "bathyal/water/seawater.hpp"
#include "bindings.hpp"
#include "water_formulas_docs.hpp"
#include "water_parts.hpp"

namespace bathyal::python {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLatitude = 45.0;  // of WaterOptions, which holds radians

py::object sound_speed_of(const py::object& temperature, const py::object& salinity,
                          const py::object& depth, const py::object& pressure,
                          const py::object& latitude, const py::object& longitude,
                          const std::string& formula,
                          const std::optional<std::string>& temperature_scale) {
  const SpeedFormula wanted = speed_formula_argument(formula);
  const double scale = scale_factor(wanted, temperature_scale);
  const bool by_depth = !depth.is_none();
  if (by_depth == !pressure.is_none()) {
    throw_argument(by_depth ? "pressure" : "depth", "one of depth= [m] and pressure= [dbar]",
                   by_depth ? "both" : "neither");
  }
  const bool placed = !longitude.is_none();
  const Broadcast given =
      broadcast_arguments({{"temperature", temperature},
                           {"salinity", salinity},
                           {by_depth ? "depth" : "pressure", by_depth ? depth : pressure},
                           {"latitude", latitude},
                           {"longitude", placed ? longitude : py::object(py::float_(0.0))}});
  const std::size_t count = given.size();
  SpeedRows rows;
  for (std::size_t i = 0; i < count; ++i) {
    check_seawater(given.at(0, i), given.at(1, i));
    check_range(by_depth ? "depth" : "pressure", given.at(2, i), -10.0,
                by_depth ? 12000.0 : 13000.0);
    rows.temperature.push_back(scale * given.at(0, i));
    rows.salinity.push_back(given.at(1, i));
    rows.latitude.push_back(latitude_argument(given.at(3, i)));
    if (placed) {
      check_range("longitude", given.at(4, i), -180.0, 360.0);
      rows.longitude.push_back(given.at(4, i));
    }
    const double place = given.at(2, i);
    const bool converts = by_depth != (wanted.formula == SoundSpeedFormula::kMackenzie);
    rows.depth.push_back(by_depth || !converts ? place
                                               : depth_from_pressure(place, rows.latitude.back()));
    rows.pressure.push_back(
        !by_depth || !converts ? place : pressure_from_depth(place, rows.latitude.back()));
  }
  return given.result(speed_of_rows(wanted, rows));
}

py::object absorption_of(const py::object& frequency, const py::object& temperature,
                         const py::object& salinity, const py::object& depth, const py::object& ph,
                         const std::string& formula) {
  const AbsorptionFormula wanted = absorption_formula_argument(formula);
  const Broadcast given = broadcast_arguments({{"frequency", frequency},
                                               {"temperature", temperature},
                                               {"salinity", salinity},
                                               {"depth", depth},
                                               {"ph", ph}});
  std::vector<double> values(given.size());
  std::size_t outside = 0;
  std::string first;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const AbsorptionPlace place{.temperature = given.at(1, i),
                                .salinity = given.at(2, i),
                                .depth = given.at(3, i),
                                .ph = given.at(4, i)};
    check_absorption(given.at(0, i), place);
    values[i] = absorption(wanted, given.at(0, i), place);
    const std::string text = outside_absorption(wanted, given.at(0, i), place);
    if (!text.empty() && outside++ == 0) first = text;
  }
  warn_of_range(formula, outside, values.size(), first);
  return given.result(std::move(values));
}

/// A function of several numbers, each checked, row by row.
template <class Function>
py::object each_row(const Broadcast& given, const Function& function) {
  std::vector<double> values(given.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = function(i);
  return given.result(std::move(values));
}

void bind_places(py::module_& module) {
  module.def(
      "depth_from_pressure",
      [](const ArrayLike& pressure, const ArrayLike& latitude) -> NumberOrArray {
        const Broadcast given =
            broadcast_arguments({{"pressure", pressure}, {"latitude", latitude}});
        return each_row(given, [&](std::size_t i) {
          check_range("pressure", given.at(0, i), -10.0, 13000.0);
          return depth_from_pressure(given.at(0, i), latitude_argument(given.at(1, i)));
        });
      },
      py::arg("pressure"), py::arg("latitude") = kLatitude, kDepthFromPressureDoc);
  module.def(
      "pressure_from_depth",
      [](const ArrayLike& depth, const ArrayLike& latitude) -> NumberOrArray {
        const Broadcast given = broadcast_arguments({{"depth", depth}, {"latitude", latitude}});
        return each_row(given, [&](std::size_t i) {
          check_range("depth", given.at(0, i), -10.0, 12000.0);
          return pressure_from_depth(given.at(0, i), latitude_argument(given.at(1, i)));
        });
      },
      py::arg("depth"), py::arg("latitude") = kLatitude, kPressureFromDepthDoc);
  module.def(
      "seawater_density",
      [](const ArrayLike& temperature, const ArrayLike& salinity,
         const ArrayLike& pressure) -> NumberOrArray {
        const Broadcast given = broadcast_arguments(
            {{"temperature", temperature}, {"salinity", salinity}, {"pressure", pressure}});
        return each_row(given, [&](std::size_t i) {
          check_seawater(given.at(0, i), given.at(1, i));
          check_range("pressure", given.at(2, i), -10.0, 13000.0);
          return seawater_density(given.at(0, i), given.at(1, i), given.at(2, i));
        });
      },
      py::arg("temperature"), py::arg("salinity"), py::arg("pressure"), kSeawaterDensityDoc);
  module.def(
      "practical_salinity",
      [](const ArrayLike& conductivity, const ArrayLike& temperature,
         const ArrayLike& pressure) -> NumberOrArray {
        const Broadcast given = broadcast_arguments(
            {{"conductivity", conductivity}, {"temperature", temperature}, {"pressure", pressure}});
        return each_row(given, [&](std::size_t i) {
          return practical_salinity(given.at(0, i), given.at(1, i), given.at(2, i));
        });
      },
      py::arg("conductivity"), py::arg("temperature"), py::arg("pressure"), kPracticalSalinityDoc);
}

}  // namespace

void bind_water_formulas(py::module_& module) {
  module.def(
      "sound_speed",
      [](const ArrayLike& temperature, const ArrayLike& salinity, const OptionalArray& depth,
         const OptionalArray& pressure, const ArrayLike& latitude, const OptionalArray& longitude,
         const std::string& formula,
         const std::optional<std::string>& temperature_scale) -> NumberOrArray {
        return sound_speed_of(temperature, salinity, depth, pressure, latitude, longitude, formula,
                              temperature_scale);
      },
      py::arg("temperature"), py::arg("salinity"), py::arg("depth") = py::none(), py::kw_only(),
      py::arg("pressure") = py::none(), py::arg("latitude") = kLatitude,
      py::arg("longitude") = py::none(), py::arg("formula") = formula_name(WaterOptions{}.formula),
      py::arg("temperature_scale") = py::none(), kSoundSpeedDoc);
  module.def(
      "absorption",
      [](const ArrayLike& frequency, const ArrayLike& temperature, const ArrayLike& salinity,
         const ArrayLike& depth, const ArrayLike& ph, const std::string& formula) -> NumberOrArray {
        return absorption_of(frequency, temperature, salinity, depth, ph, formula);
      },
      py::arg("frequency"), py::arg("temperature"), py::arg("salinity"), py::arg("depth"),
      py::arg("ph") = AbsorptionPlace{}.ph,
      py::arg("formula") = formula_name(AbsorptionFormula::kFrancoisGarrison), kAbsorptionDoc);
  module.def(
      "ambient_noise",
      [](const ArrayLike& frequency, const ArrayLike& wind_speed,
         const ArrayLike& shipping) -> NumberOrArray {
        const Broadcast given = broadcast_arguments(
            {{"frequency", frequency}, {"wind_speed", wind_speed}, {"shipping", shipping}});
        return each_row(given, [&](std::size_t i) {
          return ambient_noise(given.at(0, i),
                               {.wind_speed = given.at(1, i), .shipping = given.at(2, i)});
        });
      },
      py::arg("frequency"), py::arg("wind_speed") = AmbientNoiseOptions{}.wind_speed,
      py::arg("shipping") = AmbientNoiseOptions{}.shipping, kAmbientNoiseDoc);
  bind_places(module);
}

}  // namespace bathyal::python
