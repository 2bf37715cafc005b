// SPDX-License-Identifier: BSD-3-Clause
#include "water_parts.hpp"

#include <numbers>

#include "bathyal/base/check.hpp"
#include "bathyal/water/seawater.hpp"
#include "bathyal/water/sound_speed.hpp"
#include "hooks.hpp"

namespace bathyal::python {
namespace {

const EnumNames<SoundSpeedFormula> kSpeedFormulas{
    {"mackenzie", SoundSpeedFormula::kMackenzie},
    {"chen_millero", SoundSpeedFormula::kChenMillero},
    {"del_grosso", SoundSpeedFormula::kDelGrosso},
};

const EnumNames<AbsorptionFormula> kAbsorptionFormulas{
    {"francois_garrison", AbsorptionFormula::kFrancoisGarrison},
    {"ainslie_mccolm", AbsorptionFormula::kAinslieMcColm},
};

std::vector<double> teos10(const SpeedRows& rows) {
  std::vector<double> latitude = rows.latitude;
  for (double& angle : latitude) angle *= 180.0 / std::numbers::pi;
  const py::object longitude = rows.longitude.empty()
                                   ? py::object(py::none())
                                   : to_numpy(std::vector<double>(rows.longitude));
  const py::object speed = hook(Hook::kSoundSpeedTeos10)(
      to_numpy(std::vector<double>(rows.temperature)), to_numpy(std::vector<double>(rows.salinity)),
      to_numpy(std::vector<double>(rows.pressure)), to_numpy(std::move(latitude)), longitude);
  return column_argument("sound_speed", speed);
}

}  // namespace

py::object Broadcast::result(std::vector<double> values) const {
  if (shape.empty()) return py::float_(values.front());
  return to_numpy(std::move(values)).attr("reshape")(shape);
}

Broadcast broadcast_arguments(const std::vector<std::pair<std::string_view, py::object>>& given) {
  py::tuple arrays(given.size());
  std::string names;
  std::string shapes;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const py::array array = array_argument(given[i].first, given[i].second, "real numbers");
    arrays[i] = array;
    names += (names.empty() ? "" : ", ") + std::string(given[i].first);
    shapes += (shapes.empty() ? "" : ", ") + std::string(py::str(array.attr("shape")));
  }
  py::object together;
  try {
    together = py::module_::import("numpy").attr("broadcast_arrays")(*arrays);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw_argument(names, "shapes that broadcast", shapes);
  }
  Broadcast broadcast;
  std::size_t i = 0;
  for (const py::handle& one : together) {
    const auto array = py::reinterpret_borrow<py::array>(one);
    if (i == 0) broadcast.shape.assign(array.shape(), array.shape() + array.ndim());
    broadcast.columns.push_back(values_argument(given[i].first, array.attr("reshape")(-1)));
    ++i;
  }
  return broadcast;
}

SpeedFormula speed_formula_argument(const std::string& name) {
  if (name == "teos10") return {name, std::nullopt};
  for (const auto& [known, formula] : kSpeedFormulas) {
    if (known == name) return {name, formula};
  }
  throw_argument("formula", R"("mackenzie" or "chen_millero" or "del_grosso" or "teos10")",
                 "\"" + name + "\"");
}

std::string formula_name(SoundSpeedFormula formula) { return enum_name(formula, kSpeedFormulas); }

AbsorptionFormula absorption_formula_argument(const std::string& name) {
  return enum_argument("formula", name, kAbsorptionFormulas);
}

std::string formula_name(AbsorptionFormula formula) {
  return enum_name(formula, kAbsorptionFormulas);
}

double scale_factor(const SpeedFormula& formula, const std::optional<std::string>& scale) {
  if (scale && *scale != "ITS-90" && *scale != "IPTS-68") {
    throw_argument("temperature_scale", R"(None, "ITS-90" or "IPTS-68")", "\"" + *scale + "\"");
  }
  if (!scale) return 1.0;
  if (formula.formula) return *scale == "ITS-90" ? ipts68(1.0) : 1.0;
  return *scale == "IPTS-68" ? its90(1.0) : 1.0;
}

double latitude_argument(double degrees) {
  check_range("latitude", degrees, -90.0, 90.0);
  return degrees * std::numbers::pi / 180.0;
}

std::vector<double> speed_of_rows(const SpeedFormula& formula, const SpeedRows& rows) {
  if (!formula.formula) return teos10(rows);
  const std::size_t count = rows.temperature.size();
  std::vector<double> speed(count);
  std::size_t outside = 0;
  std::string first;
  for (std::size_t i = 0; i < count; ++i) {
    const SoundSpeedPlace place{rows.depth[i], rows.pressure[i]};
    speed[i] = sound_speed(*formula.formula, rows.temperature[i], rows.salinity[i], place);
    const std::string text =
        outside_sound_speed(*formula.formula, rows.temperature[i], rows.salinity[i], place);
    if (text.empty()) continue;
    if (outside++ == 0) first = text;
  }
  warn_of_range(formula.name, outside, count, first);
  return speed;
}

void warn_of_range(const std::string& formula, std::size_t outside, std::size_t rows,
                   const std::string& first) {
  if (outside == 0) return;
  std::string text = formula + " extrapolates: " + first;
  if (rows > 1) {
    text += ", and so in " + std::to_string(outside) + " of " + std::to_string(rows) + " rows";
  }
  hook(Hook::kWarnOfRange)(text);
}

SpeedProfile speed_source_argument(const py::object& source, double time) {
  if (py::isinstance<Water>(source)) return source.cast<const Water&>().speed_profile(time);
  if (!py::isinstance<WaterProfile>(source)) {
    throw_argument("water", "a Water or a Profile",
                   std::string(py::str(py::type::handle_of(source).attr("__name__"))));
  }
  WaterOptions options;
  options.surface = 0.0;
  options.profiles = {source.cast<WaterProfile>()};
  return Water(std::move(options)).speed_profile();
}

std::vector<double> column_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

}  // namespace bathyal::python
