// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/water/seawater.hpp"
#include "bindings.hpp"
#include "water_docs.hpp"
#include "water_parts.hpp"

namespace bathyal::python {
namespace {

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;

/// (latitude, longitude) [deg].
using Position = std::optional<std::pair<double, double>>;

Position position_of(const WaterProfile& profile) {
  if (!profile.latitude || !profile.longitude) return std::nullopt;
  // To the last digit but two, so that what went in as degrees comes out as it was.
  const auto degrees = [](double angle) {
    return std::round(angle * kDegreesOfRadian * 1e12) / 1e12;
  };
  return std::pair{degrees(*profile.latitude), degrees(*profile.longitude)};
}

WaterProfile make_profile(const ArrayLike& depth, const OptionalArray& temperature,
                          const OptionalArray& salinity, const OptionalArray& sound_speed,
                          const OptionalArray& pressure, const Position& position,
                          std::optional<double> time, std::string instrument, std::string source) {
  WaterProfile profile;
  profile.depth = column_argument("depth", depth);
  profile.temperature = column_argument("temperature", temperature);
  profile.salinity = column_argument("salinity", salinity);
  profile.sound_speed = column_argument("sound_speed", sound_speed);
  profile.pressure = column_argument("pressure", pressure);
  if (position) {
    profile.latitude = latitude_argument(position->first);
    check_range("position", position->second, -180.0, 360.0);
    profile.longitude = position->second / kDegreesOfRadian;
  }
  if (time) check_finite("time", *time);
  profile.time = time;
  profile.instrument = std::move(instrument);
  profile.source = std::move(source);
  if (profile.depth.empty()) throw_argument("depth", "at least one depth", "none");
  profile.check_columns();
  return profile;
}

py::object column(const std::vector<double>& values) {
  if (values.empty()) return py::none();
  return to_numpy(std::vector<double>(values));
}

WaterProfile with_sound_speed(const WaterProfile& profile, const std::string& formula,
                              std::optional<double> latitude,
                              const std::optional<std::string>& temperature_scale) {
  const SpeedFormula wanted = speed_formula_argument(formula);
  const double scale = scale_factor(wanted, temperature_scale);
  if (profile.temperature.empty() || profile.salinity.empty()) {
    throw_argument("self", "a profile with temperature and salinity",
                   profile.temperature.empty() ? "no temperature" : "no salinity");
  }
  const double angle =
      latitude ? latitude_argument(*latitude) : profile.latitude.value_or(WaterOptions{}.latitude);
  SpeedRows rows;
  std::vector<std::size_t> known;  // rows that have what the formula takes
  for (std::size_t i = 0; i < profile.depth.size(); ++i) {
    const double pressure = profile.pressure.empty() ? pressure_from_depth(profile.depth[i], angle)
                                                     : profile.pressure[i];
    if (!std::isfinite(profile.temperature[i] + profile.salinity[i] + profile.depth[i] +
                       pressure)) {
      continue;
    }
    check_seawater(profile.temperature[i], profile.salinity[i]);
    known.push_back(i);
    rows.temperature.push_back(scale * profile.temperature[i]);
    rows.salinity.push_back(profile.salinity[i]);
    rows.depth.push_back(profile.depth[i]);
    rows.pressure.push_back(pressure);
    rows.latitude.push_back(angle);
    if (profile.longitude) rows.longitude.push_back(*profile.longitude * kDegreesOfRadian);
  }
  const std::vector<double> speed = speed_of_rows(wanted, rows);
  WaterProfile result = profile;
  result.sound_speed.assign(profile.depth.size(), std::nan(""));
  for (std::size_t i = 0; i < known.size(); ++i) result.sound_speed[known[i]] = speed[i];
  return result;
}

std::string brief(const WaterProfile& profile) {
  double deepest = -1.0;
  for (const double d : profile.depth) deepest = d > deepest ? d : deepest;
  return counted(static_cast<long>(profile.depth.size()), "row") + ", to " + three_digits(deepest) +
         " m" + (profile.instrument.empty() ? "" : ", " + profile.instrument);
}

}  // namespace

void bind_water_profile(py::module_& module) {
  py::class_<WaterProfile>(module, "Profile", kProfileDoc)
      .def(py::init(&make_profile), py::arg("depth"), py::kw_only(),
           py::arg("temperature") = py::none(), py::arg("salinity") = py::none(),
           py::arg("sound_speed") = py::none(), py::arg("pressure") = py::none(),
           py::arg("position") = py::none(), py::arg("time") = py::none(),
           py::arg("instrument") = "", py::arg("source") = "")
      .def_property_readonly(
          "depth", [](const WaterProfile& p) { return to_numpy(std::vector<double>(p.depth)); },
          "(K,) below the surface [m].")
      .def_property_readonly(
          "temperature",
          [](const WaterProfile& p) -> py::typing::Optional<py::array> {
            return column(p.temperature);
          },
          "(K,) [°C], or None.")
      .def_property_readonly(
          "salinity",
          [](const WaterProfile& p) -> py::typing::Optional<py::array> {
            return column(p.salinity);
          },
          "(K,) practical, or None.")
      .def_property_readonly(
          "sound_speed",
          [](const WaterProfile& p) -> py::typing::Optional<py::array> {
            return column(p.sound_speed);
          },
          "(K,) [m/s], or None.")
      .def_property_readonly(
          "pressure",
          [](const WaterProfile& p) -> py::typing::Optional<py::array> {
            return column(p.pressure);
          },
          "(K,) above the atmosphere's [dbar], or None.")
      .def_property_readonly("position", &position_of, "(latitude, longitude) [deg], or None.")
      .def_readonly("time", &WaterProfile::time, "Since 1970-01-01 UTC [s], or None.")
      .def_readonly("instrument", &WaterProfile::instrument, "As the file names it.")
      .def_readonly("source", &WaterProfile::source, "The file, and what was derived of it.")
      .def(
          "cleaned",
          [](const WaterProfile& p, double step) { return clean_profile(p, {.step = step}); },
          py::kw_only(), py::arg("step") = CleanProfileOptions{}.step, kCleanedDoc)
      .def("with_sound_speed", &with_sound_speed, py::kw_only(),
           py::arg("formula") = formula_name(WaterOptions{}.formula),
           py::arg("latitude") = py::none(), py::arg("temperature_scale") = py::none(),
           kWithSoundSpeedDoc)
      .def("__len__", [](const WaterProfile& p) { return p.depth.size(); })
      .def("__repr__", [](const WaterProfile& p) { return "Profile(" + brief(p) + ")"; })
      .def(py::pickle(
          [](const WaterProfile& p) {
            return py::make_tuple(p.depth, p.temperature, p.salinity, p.sound_speed, p.pressure,
                                  p.latitude, p.longitude, p.time, p.instrument, p.source);
          },
          [](const py::tuple& s) {
            using Numbers = std::vector<double>;
            using Maybe = std::optional<double>;
            WaterProfile p{s[0].cast<Numbers>(),    s[1].cast<Numbers>(), s[2].cast<Numbers>(),
                           s[3].cast<Numbers>(),    s[4].cast<Numbers>(), s[5].cast<Maybe>(),
                           s[6].cast<Maybe>(),      s[7].cast<Maybe>(),   s[8].cast<std::string>(),
                           s[9].cast<std::string>()};
            p.check_columns();
            return p;
          }));
}

}  // namespace bathyal::python
