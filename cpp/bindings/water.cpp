// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/water/water.hpp"

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

using ProfileOrProfiles =
    py::typing::Optional<py::typing::Union<WaterProfile, py::typing::List<WaterProfile>>>;
using CurrentLike = py::typing::Optional<py::typing::Union<Current, ArrayLike>>;

std::vector<WaterProfile> profiles_argument(const py::object& object) {
  if (object.is_none()) return {};
  if (py::isinstance<WaterProfile>(object)) return {object.cast<WaterProfile>()};
  const auto refuse = [](const py::handle& got) {
    throw_argument("profile",
                   "a Profile, or a list of them (bathyal.Profile(depth, "
                   "temperature=…, salinity=…) makes one of arrays)",
                   std::string(py::str(py::type::handle_of(got).attr("__name__"))));
  };
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object)) refuse(object);
  std::vector<WaterProfile> profiles;
  for (const py::handle& one : object) {
    if (!py::isinstance<WaterProfile>(one)) refuse(one);
    profiles.push_back(one.cast<WaterProfile>());
  }
  return profiles;
}

Current current_argument(const py::object& object) {
  if (object.is_none()) return {};
  if (py::isinstance<Current>(object)) return object.cast<Current>();
  const py::array given = array_argument("current", object, "a Current, or x and y [m/s]");
  if (given.ndim() != 1 || (given.size() != 2 && given.size() != 3)) {
    throw_argument("current", "a Current, or x and y [m/s]",
                   "shape " + std::string(py::str(given.attr("shape"))));
  }
  const Values values = values_argument("current", given);
  if (given.size() == 3 && values.data()[2] != 0.0) {
    throw_argument("current", "a horizontal current, z = 0", to_text(values.data()[2]));
  }
  return {values.data()[0], values.data()[1]};
}

/// What is not measured is computed here, where gsw can be asked and warnings given: the engine
/// then finds every sound speed in place.
void compute_speeds(WaterOptions& options, const SpeedFormula& formula) {
  const auto speeds = [&](const WaterProfile& profile) {
    SpeedRows rows;
    for (std::size_t i = 0; i < profile.depth.size(); ++i) {
      rows.temperature.push_back(profile.temperature[i]);
      rows.salinity.push_back(profile.salinity[i]);
      rows.depth.push_back(profile.depth[i]);
      rows.pressure.push_back(profile.pressure.empty()
                                  ? pressure_from_depth(profile.depth[i], options.latitude)
                                  : profile.pressure[i]);
      rows.latitude.push_back(options.latitude);
      if (profile.longitude)
        rows.longitude.push_back(*profile.longitude * 180.0 / std::numbers::pi);
    }
    return speed_of_rows(formula, rows);
  };
  for (WaterProfile& profile : options.profiles) {
    const bool known = !profile.temperature.empty() && !profile.salinity.empty();
    if (profile.sound_speed.empty() && known) profile.sound_speed = speeds(profile);
  }
  if (!options.sound_speed && options.profiles.empty()) {
    WaterProfile one;
    one.depth = {options.reference_depth};
    one.temperature = {options.temperature};
    one.salinity = {options.salinity};
    options.sound_speed = speeds(one).front();
  }
}

Water make_water(const ProfileOrProfiles& profile, std::optional<double> surface,
                 const OptionalArray& time, double reference_depth, double temperature,
                 double salinity, std::optional<double> sound_speed, const std::string& formula,
                 double ph, std::optional<double> latitude, const CurrentLike& current,
                 const std::optional<Waves>& waves, const std::optional<Tide>& tide) {
  WaterOptions options;
  options.profiles = profiles_argument(profile);
  options.time = column_argument("time", time);
  options.surface = surface;
  options.reference_depth = reference_depth;
  options.temperature = temperature;
  options.salinity = salinity;
  options.sound_speed = sound_speed;
  options.ph = ph;
  if (latitude) {
    options.latitude = latitude_argument(*latitude);
  } else if (!options.profiles.empty() && options.profiles.front().latitude) {
    options.latitude = *options.profiles.front().latitude;
  }
  options.current = current_argument(current);
  if (waves) options.waves = *waves;
  if (tide) options.tide = *tide;
  const SpeedFormula wanted = speed_formula_argument(formula);
  if (wanted.formula) options.formula = *wanted.formula;
  options.check();
  compute_speeds(options, wanted);
  return Water(std::move(options));
}

/// Heights and times of a call: z, or depth below the mean surface.
struct Places {
  Broadcast given;
  double surface = 0.0;
  bool by_depth = false;

  std::size_t size() const { return given.size(); }
  double z(std::size_t i) const { return by_depth ? surface - given.at(0, i) : given.at(0, i); }
  double time(std::size_t i) const { return given.at(1, i); }
};

Places places_argument(const Water& water, const py::object& z, const py::object& time,
                       const py::object& depth, const py::object& frequency = py::none()) {
  if (z.is_none() == depth.is_none()) {
    throw_argument(z.is_none() ? "z" : "depth", "one of z and depth= [m]",
                   z.is_none() ? "neither" : "both");
  }
  Places places;
  places.by_depth = !depth.is_none();
  places.surface = water.surface().value_or(0.0);
  std::vector<std::pair<std::string_view, py::object>> given{
      {places.by_depth ? "depth" : "z", places.by_depth ? depth : z}, {"time", time}};
  if (!frequency.is_none()) given.emplace_back("frequency", frequency);
  places.given = broadcast_arguments(given);
  for (std::size_t i = 0; i < places.size(); ++i) {
    check_finite(given.front().first, places.given.at(0, i));
    check_finite("time", places.given.at(1, i));
  }
  return places;
}

template <class Function>
auto scalar_field(const Function& function) {
  return [function](const Water& water, const OptionalArray& z, const ArrayLike& time,
                    const OptionalArray& depth) -> NumberOrArray {
    const Places places = places_argument(water, z, time, depth);
    std::vector<double> values(places.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = function(water, places.z(i), places.time(i));
    }
    return places.given.result(std::move(values));
  };
}

template <class Function>
auto vector_field(const Function& function) {
  return [function](const Water& water, const ArrayLike& point, const ArrayLike& time) {
    const Rows rows = rows_argument("point", point, 3);
    const Broadcast times = broadcast_arguments({{"time", time}});
    const auto count = static_cast<std::size_t>(rows.table.rows());
    if (times.size() != 1 && times.size() != count) {
      throw_argument("time", "one time, or one a point", std::to_string(times.size()));
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at = rows.table.row(static_cast<Index>(i)).transpose();
      const Vec3 v = function(water, at, times.at(0, times.size() == 1 ? 0 : i));
      values.insert(values.end(), {v.x(), v.y(), v.z()});
    }
    return py::array(to_numpy(std::move(values), rows.single, {3}));
  };
}

py::object absorption_in(const Water& water, const py::object& frequency, const py::object& z,
                         const py::object& time, const py::object& depth,
                         const std::string& formula) {
  const AbsorptionFormula wanted = absorption_formula_argument(formula);
  const Places places = places_argument(water, z, time, depth, frequency);
  std::vector<double> values(places.size());
  std::size_t outside = 0;
  std::string first;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double hertz = places.given.at(2, i);
    values[i] = water.absorption(hertz, places.z(i), places.time(i), wanted);
    const std::string text =
        outside_absorption(wanted, hertz,
                           {.temperature = water.temperature(places.z(i), places.time(i)),
                            .salinity = water.salinity(places.z(i), places.time(i)),
                            .depth = water.depth(places.z(i)),
                            .ph = water.options().ph});
    if (!text.empty() && outside++ == 0) first = text;
  }
  warn_of_range(formula, outside, values.size(), first);
  return places.given.result(std::move(values));
}

std::string water_text(const Water& water) {
  std::string text = "Water(";
  if (water.options().profiles.empty()) {
    text += three_digits(water.options().temperature) + " °C, salinity " +
            three_digits(water.options().salinity);
  } else if (water.options().profiles.size() == 1) {
    text += "profile of " +
            counted(static_cast<long>(water.options().profiles.front().depth.size()), "row") +
            " to " + three_digits(water.options().profiles.front().depth.back()) + " m";
  } else {
    text += counted(static_cast<long>(water.options().profiles.size()), "profile");
  }
  return text + (water.surface() ? ", surface=" + to_text(*water.surface()) : ", no surface") + ")";
}

template <class Class>
void bind_fields(Class& water) {
  const auto field = [&water](const char* name, const auto& function, const char* doc) {
    water.def(name, scalar_field(function), py::arg("z") = py::none(), py::arg("time") = 0.0,
              py::kw_only(), py::arg("depth") = py::none(), doc);
  };
  field(
      "sound_speed", [](const Water& w, double z, double t) { return w.sound_speed(z, t); },
      "[m/s] at heights z of the world, or depths below the mean surface, and times [s].");
  field(
      "temperature", [](const Water& w, double z, double t) { return w.temperature(z, t); },
      "[°C] at heights or depths and times.");
  field(
      "salinity", [](const Water& w, double z, double t) { return w.salinity(z, t); },
      "Practical salinity at heights or depths and times.");
  field(
      "density", [](const Water& w, double z, double t) { return w.density(z, t); },
      "[kg/m³] at heights or depths and times, by EOS-80.");
  field(
      "pressure", [](const Water& w, double z, double /*t*/) { return w.pressure(z); },
      "Above the atmosphere's [dbar] at heights or depths.");
  water
      .def(
          "absorption",
          [](const Water& w, const ArrayLike& frequency, const OptionalArray& z,
             const ArrayLike& time, const OptionalArray& depth,
             const std::string& formula) -> NumberOrArray {
            return absorption_in(w, frequency, z, time, depth, formula);
          },
          py::arg("frequency"), py::arg("z") = py::none(), py::arg("time") = 0.0, py::kw_only(),
          py::arg("depth") = py::none(),
          py::arg("formula") = formula_name(AbsorptionFormula::kFrancoisGarrison),
          "One way [dB/km] of frequencies [Hz] at heights or depths: `bathyal.absorption` of the "
          "water there.")
      .def("current",
           vector_field([](const Water& w, const Vec3& p, double t) { return w.current(p, t); }),
           py::arg("point"), py::arg("time") = 0.0,
           "(N, 3) or (3,) horizontal current [m/s] at points of the world, waves apart.")
      .def("velocity", vector_field([](const Water& w, const Vec3& p, double t) {
             return w.motion(p, t).velocity;
           }),
           py::arg("point"), py::arg("time") = 0.0,
           "(N, 3) or (3,) current and the waves' orbits together [m/s]; 0 above the surface.")
      .def("acceleration", vector_field([](const Water& w, const Vec3& p, double t) {
             return w.motion(p, t).acceleration;
           }),
           py::arg("point"), py::arg("time") = 0.0,
           "(N, 3) or (3,) local acceleration in the waves' orbits [m/s²].");
}

}  // namespace

void bind_water(py::module_& module) {
  const WaterOptions d;
  auto water = py::class_<Water>(module, "Water", kWaterDoc);
  water
      .def(py::init(&make_water), py::arg("profile") = py::none(), py::kw_only(),
           py::arg("surface") = d.surface, py::arg("time") = py::none(),
           py::arg("reference_depth") = d.reference_depth, py::arg("temperature") = d.temperature,
           py::arg("salinity") = d.salinity, py::arg("sound_speed") = d.sound_speed,
           py::arg("formula") = formula_name(d.formula), py::arg("ph") = d.ph,
           py::arg("latitude") = py::none(), py::arg("current") = py::none(),
           py::arg("waves") = py::none(), py::arg("tide") = py::none())
      .def_property_readonly("surface", &Water::surface,
                             "z of the mean sea surface [m]; None: out of reach.")
      .def_property_readonly("reference_depth", &Water::reference_depth,
                             "Depth of the whole water where there is no surface [m].")
      .def_property_readonly(
          "profiles", [](const Water& w) { return w.options().profiles; },
          "Profile of each time, every column filled; empty for uniform water.")
      .def_property_readonly(
          "time", [](const Water& w) { return to_numpy(std::vector<double>(w.options().time)); },
          "(T,) of the profiles [s].")
      .def_property_readonly(
          "ph", [](const Water& w) { return w.options().ph; }, "pH.")
      .def_property_readonly(
          "waves", [](const Water& w) { return w.options().waves; }, "Waves; without any, flat.")
      .def_property_readonly(
          "tide", [](const Water& w) { return w.options().tide; }, "Tide; without any, 0.")
      .def_property_readonly("deepest", &Water::deepest,
                             "Depth to which the profiles reach [m]; infinite for uniform water.")
      .def("covers", &Water::covers, py::arg("depth"),
           "Whether the profiles reach down to a depth [m].")
      .def(
          "depth",
          [](const Water& w, const ArrayLike& z) -> NumberOrArray {
            const Broadcast given = broadcast_arguments({{"z", z}});
            std::vector<double> values(given.size());
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = w.depth(given.at(0, i));
            return given.result(std::move(values));
          },
          py::arg("z"),
          "Below the mean surface [m]; `reference_depth` without a surface. ValueError above it.")
      .def(
          "surface_height",
          [](const Water& w, const ArrayLike& x, const ArrayLike& y,
             const ArrayLike& time) -> NumberOrArray {
            const Broadcast given = broadcast_arguments({{"x", x}, {"y", y}, {"time", time}});
            std::vector<double> values(given.size());
            for (std::size_t i = 0; i < values.size(); ++i) {
              values[i] = w.surface_height(given.at(0, i), given.at(1, i), given.at(2, i));
            }
            return given.result(std::move(values));
          },
          py::arg("x"), py::arg("y"), py::arg("time") = 0.0,
          "z of the sea surface [m]: mean, tide and waves.")
      .def("__repr__", &water_text)
      .def(py::pickle(&water_state, &water_from_state));
  bind_fields(water);
}

}  // namespace bathyal::python
