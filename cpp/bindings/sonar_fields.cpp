// SPDX-License-Identifier: BSD-3-Clause
#include "sonar_fields.hpp"

#include <pybind11/stl.h>

#include <string_view>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "enum_names.hpp"

namespace bathyal::python {
namespace {

std::string shown(const py::object& object) { return py::repr(object).cast<std::string>(); }

double number_of(std::string_view name, const py::object& object) {
  if (PyBool_Check(object.ptr()) == 0) {
    const double value = PyFloat_AsDouble(object.ptr());
    if (PyErr_Occurred() == nullptr) return value;
    PyErr_Clear();
  }
  throw_argument(name, "a number", shown(object));
}

int count_of(std::string_view name, const py::object& object) {
  if (PyBool_Check(object.ptr()) == 0 && PyIndex_Check(object.ptr()) != 0) {
    const py::ssize_t value = PyNumber_AsSsize_t(object.ptr(), PyExc_OverflowError);
    if (PyErr_Occurred() == nullptr && value == static_cast<int>(value)) {
      return static_cast<int>(value);
    }
    PyErr_Clear();
  }
  throw_argument(name, "a whole number within 32 bits", shown(object));
}

bool flag_of(std::string_view name, const py::object& object) {
  if (PyBool_Check(object.ptr()) != 0) return object.cast<bool>();
  throw_argument(name, "True or False", shown(object));
}

/// A property whose type is that of what `get` returns.
template <class Get>
std::function<void(py::class_<Sonar>&, const char*)> property(const char* name, Get get) {
  return [name, get](py::class_<Sonar>& cls, const char* doc) {
    cls.def_property_readonly(
        name, [get](const Sonar& s) { return get(s.options()); }, doc);
  };
}

SonarField number(const char* name, double SonarOptions::*member) {
  return {name, [member](const SonarOptions& o) { return py::float_(o.*member); },
          [name, member](SonarOptions& o, const py::object& v) { o.*member = number_of(name, v); },
          property(name, [member](const SonarOptions& o) { return o.*member; })};
}

SonarField number_or_none(const char* name, std::optional<double> SonarOptions::*member) {
  return {name, [member](const SonarOptions& o) -> py::object { return py::cast(o.*member); },
          [name, member](SonarOptions& o, const py::object& v) {
            o.*member = v.is_none() ? std::nullopt : std::optional<double>(number_of(name, v));
          },
          property(name, [member](const SonarOptions& o) { return o.*member; })};
}

SonarField count(const char* name, int SonarOptions::*member) {
  return {name, [member](const SonarOptions& o) { return py::int_(o.*member); },
          [name, member](SonarOptions& o, const py::object& v) { o.*member = count_of(name, v); },
          property(name, [member](const SonarOptions& o) { return o.*member; })};
}

SonarField flag(const char* name, bool SonarOptions::*member) {
  return {name, [member](const SonarOptions& o) { return py::bool_(o.*member); },
          [name, member](SonarOptions& o, const py::object& v) { o.*member = flag_of(name, v); },
          property(name, [member](const SonarOptions& o) { return o.*member; })};
}

/// A choice by name; of a switch, None and False are its first value, True is its second.
template <class Enum>
SonarField choice(const char* name, Enum SonarOptions::*member, EnumNames<Enum> names,
                  bool is_switch) {
  const auto get = [member, names, is_switch](const SonarOptions& o) -> py::object {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].second != o.*member) continue;
      if (is_switch && i == 0) return py::none();
      return py::str(names[i].first);
    }
    return py::none();
  };
  const auto set = [name, member, names, is_switch](SonarOptions& o, const py::object& v) {
    if (is_switch && (v.is_none() || v.is(py::bool_(false)))) {
      o.*member = names[0].second;
    } else if (is_switch && v.is(py::bool_(true))) {
      o.*member = names[1].second;
    } else if (py::isinstance<py::str>(v)) {
      o.*member = enum_argument(name, v.cast<std::string>(), names);
    } else {
      throw_argument(name, is_switch ? "None or a name" : "a name", shown(v));
    }
  };
  const auto typed = [get](const SonarOptions& o) { return py::typing::Optional<py::str>(get(o)); };
  return {name, get, set, property(name, typed)};
}

SonarField text(const char* name, std::string SonarOptions::*member) {
  return {name, [member](const SonarOptions& o) { return py::str(o.*member); },
          [name, member](SonarOptions& o, const py::object& v) {
            if (!py::isinstance<py::str>(v)) throw_argument(name, "text", shown(v));
            o.*member = v.cast<std::string>();
          },
          property(name, [member](const SonarOptions& o) { return o.*member; })};
}

SonarField pose(const char* name, Pose SonarOptions::*member) {
  return {
      name, [member](const SonarOptions& o) { return py::object(to_numpy(o.*member)); },
      [name, member](SonarOptions& o, const py::object& v) { o.*member = pose_argument(name, v); },
      property(name, [member](const SonarOptions& o) { return to_numpy(o.*member); })};
}

/// None, or a formula by its name; True is the first.
SonarField absorption() {
  using Formula = std::optional<AbsorptionFormula>;
  static const EnumNames<Formula> names{{"none", std::nullopt},
                                        {"francois_garrison", AbsorptionFormula::kFrancoisGarrison},
                                        {"ainslie_mccolm", AbsorptionFormula::kAinslieMcColm}};
  return choice<Formula>("absorption", &SonarOptions::absorption, names, true);
}

std::vector<SonarField> make_fields() {
  using O = SonarOptions;
  return {
      choice<SonarKind>("kind", &O::kind,
                        {{"echo_sounder", SonarKind::kEchoSounder},
                         {"side_scan", SonarKind::kSideScan},
                         {"multibeam", SonarKind::kMultibeam},
                         {"imaging", SonarKind::kImaging},
                         {"scanning", SonarKind::kScanning}},
                        false),
      text("name", &O::name),
      number("frequency", &O::frequency),
      number("pulse_length", &O::pulse_length),
      number("bandwidth", &O::bandwidth),
      number("source_level", &O::source_level),
      number("ping_rate", &O::ping_rate),
      number("range", &O::range),
      count("samples", &O::samples),
      count("beams", &O::beams),
      number("sector", &O::sector),
      number("beam_width", &O::beam_width),
      number("fan_width", &O::fan_width),
      number("fan_span", &O::fan_span),
      number("tilt", &O::tilt),
      number("axis_tilt", &O::axis_tilt),
      number("head_start", &O::head_start),
      number("head_step", &O::head_step),
      pose("vehicle_from_sonar", &O::vehicle_from_sonar),
      choice<RayModel>("rays", &O::rays,
                       {{"angles", RayModel::kAngles}, {"camera", RayModel::kCamera}}, false),
      count("rays_across_beam", &O::rays_across_beam),
      count("rays_along_fan", &O::rays_along_fan),
      flag("spreading", &O::spreading),
      absorption(),
      choice<BackscatterModel>(
          "backscatter", &O::backscatter,
          {{"lambert", BackscatterModel::kLambert}, {"material", BackscatterModel::kMaterial}},
          false),
      choice<BeamPattern>("beam_pattern", &O::beam_pattern,
                          {{"none", BeamPattern::kNone},
                           {"uniform", BeamPattern::kUniform},
                           {"hann", BeamPattern::kHann},
                           {"taylor", BeamPattern::kTaylor},
                           {"gaussian", BeamPattern::kGaussian}},
                          true),
      flag("pixel_solid_angle", &O::pixel_solid_angle),
      flag("refraction", &O::refraction),
      count("multiples", &O::multiples),
      number("wind_speed", &O::wind_speed),
      flag("motion", &O::motion),
      flag("side_lobes", &O::side_lobes),
      flag("layover", &O::layover),
      choice<PulseModel>("pulse", &O::pulse,
                         {{"none", PulseModel::kNone},
                          {"rectangle", PulseModel::kRectangle},
                          {"chirp", PulseModel::kChirp}},
                         true),
      choice<SpeckleModel>("speckle", &O::speckle,
                           {{"none", SpeckleModel::kNone},
                            {"rayleigh", SpeckleModel::kRayleigh},
                            {"k", SpeckleModel::kK}},
                           true),
      number("speckle_shape", &O::speckle_shape),
      flag("noise", &O::noise),
      number_or_none("noise_level", &O::noise_level),
      flag("tvg", &O::tvg),
      number("tvg_spreading", &O::tvg_spreading),
      number("tvg_absorption", &O::tvg_absorption),
      number("tvg_offset", &O::tvg_offset),
      number("dropout_rate", &O::dropout_rate),
      number("beam_dropout_rate", &O::beam_dropout_rate),
      count("bits", &O::bits),
      number("full_scale", &O::full_scale),
  };
}

}  // namespace

const std::vector<SonarField>& sonar_fields() {
  static const std::vector<SonarField> fields = make_fields();
  return fields;
}

const SonarField& sonar_field(const std::string& name) {
  std::string known;
  for (const SonarField& field : sonar_fields()) {
    if (field.name == name) return field;
    known.append(known.empty() ? "" : ", ").append(field.name);
  }
  throw_argument(name, known.insert(0, "a field of a sonar: "), "none of them");
}

SonarValues sonar_to_dict(const SonarOptions& options) {
  SonarValues values;
  for (const SonarField& field : sonar_fields()) values[field.name.c_str()] = field.get(options);
  return values;
}

SonarOptions replaced(SonarOptions options, const py::dict& fields) {
  for (const auto& [key, value] : fields) {
    sonar_field(py::cast<std::string>(key)).set(options, py::reinterpret_borrow<py::object>(value));
  }
  options.check();
  return options;
}

}  // namespace bathyal::python
