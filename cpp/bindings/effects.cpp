// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/effect.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "bathyal/base/error.hpp"
#include "effects_docs.hpp"
#include "effects_parts.hpp"
#include "enum_names.hpp"
#include "hooks.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

namespace py = pybind11;

constexpr double kTypicalSize = 1e-3;  ///< of a parameter without a given scale

const EnumNames<UserSite>& site_names() {
  static const EnumNames<UserSite> names{{"joint", UserSite::kJoint},
                                         {"link", UserSite::kLink},
                                         {"base", UserSite::kBase},
                                         {"tool", UserSite::kTool},
                                         {"lengths", UserSite::kLengths}};
  return names;
}

/// Value by name; `otherwise` where the dict does not have it.
template <class Value>
Value value_or_default(const std::map<std::string, Value>& given, const std::string& name,
                       Value otherwise) {
  const auto found = given.find(name);
  return found == given.end() ? std::move(otherwise) : found->second;
}

/// Names of a dict in its own order, with what it says of them.
template <class Value>
std::vector<std::pair<std::string, Value>> items_argument(std::string_view name,
                                                          const py::dict& dict,
                                                          std::string_view expected) {
  std::vector<std::pair<std::string, Value>> items;
  for (const auto& [key, value] : dict) {
    try {
      items.emplace_back(py::cast<std::string>(key), py::cast<Value>(value));
    } catch (const py::cast_error&) {
      throw_argument(name, expected, py::repr(dict).cast<std::string>());
    }
  }
  return items;
}

using JointsToTry =
    py::typing::Optional<py::typing::Union<py::str, py::typing::Iterable<py::int_>>>;

std::shared_ptr<Effect> make_effect(std::string name, py::function function,
                                    const py::dict& parameters, const JointsToTry& joints,
                                    const std::string& site, std::vector<std::string> needs,
                                    std::string words, std::string formula, std::string source,
                                    const std::map<std::string, double>& scales, bool by_difference,
                                    double period, bool extrapolates) {
  UserEffect user;
  user.info.name = std::move(name);
  user.info.description = std::move(words);
  user.info.formula = std::move(formula);
  user.info.source = std::move(source);
  user.info.needs = std::move(needs);
  user.info.by_difference = by_difference;
  user.info.extrapolates = extrapolates;
  if (!(period > 0.0)) throw_argument("period", "a length above 0", to_text(period));
  user.period = period;
  user.site = enum_argument("site", site, site_names());
  for (auto& [parameter, unit] :
       items_argument<std::string>("parameters", parameters, "a dict of name to unit")) {
    const double scale = value_or_default(scales, parameter, kTypicalSize);
    user.info.ranges.push_back({parameter, unit, 0.0, std::numeric_limits<double>::infinity()});
    user.parameters.push_back({std::move(parameter), std::move(unit), scale});
  }
  for (const auto& [parameter, scale] : scales) {
    const bool known = std::any_of(user.parameters.begin(), user.parameters.end(),
                                   [&](const EffectParameter& p) { return p.name == parameter; });
    if (!known) throw_argument("scales", "names of parameters", "\"" + parameter + "\"");
  }
  if (py::isinstance<py::str>(joints)) {
    const auto word = joints.cast<std::string>();
    if (word != "each") throw_argument("joints", "\"each\" or a list", "\"" + word + "\"");
    user.each_joint = true;
  } else if (!joints.is_none()) {
    try {
      user.joints = joints.cast<std::vector<int>>();
    } catch (const py::cast_error&) {
      throw_argument("joints", "\"each\" or a list of whole numbers",
                     py::repr(joints).cast<std::string>());
    }
  }
  return make_python_effect(std::move(user), std::move(function));
}

std::string effect_text(const EffectInfo& info) {
  std::string text = info.name;
  const auto line = [&text](const char* what, const std::string& value) {
    if (!value.empty()) text += "\n  " + std::string(what) + value;
  };
  line("", info.description);
  line("formula: ", info.formula);
  for (const EffectInfo::Range& range : info.ranges) {
    line("", range.parameter + ": " + to_text(range.low) + " to " + to_text(range.high) + " " +
                 range.unit);
  }
  std::string needs;
  for (const std::string& name : info.needs) needs += (needs.empty() ? "" : ", ") + name;
  line("needs: ", needs);
  line("beyond the data: ", info.extrapolates ? "extrapolated where its arguments are known" : "");
  line("source: ", info.source);
  return text;
}

/// The unit that an effect's ranges give for a parameter: "shift_x_2" has that of "shift_x".
std::string unit_of(const EffectInfo& info, const std::string& parameter) {
  std::string unit;
  std::size_t longest = 0;
  for (const EffectInfo::Range& range : info.ranges) {
    if (parameter.starts_with(range.parameter) && range.parameter.size() >= longest) {
      longest = range.parameter.size();
      unit = range.unit;
    }
  }
  return unit;
}

std::shared_ptr<const Effect> effect_argument(const py::object& effect) {
  if (py::isinstance<Effect>(effect)) return effect.cast<std::shared_ptr<Effect>>();
  return hook(Hook::kFindEffect)(effect).cast<std::shared_ptr<Effect>>();
}

FoundEffect make_found(const py::typing::Union<Effect, py::str>& effect, const py::dict& parameters,
                       std::optional<int> joint, std::map<std::string, double> settings,
                       const std::map<std::string, std::string>& units,
                       const std::map<std::string, double>& scales, std::string cause) {
  FoundEffect found;
  found.effect = effect_argument(effect);
  const EffectInfo info = found.effect->info();
  found.variant.effect = info.name;
  found.variant.joint = joint.value_or(-1);
  found.variant.settings = std::move(settings);
  found.variant.alias_group = std::move(cause);
  const auto values = items_argument<double>("parameters", parameters, "a dict of name to number");
  found.values.resize(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = values[i].first;
    found.values[static_cast<Eigen::Index>(i)] = values[i].second;
    found.variant.parameters.push_back({name, value_or_default(units, name, unit_of(info, name)),
                                        value_or_default(scales, name, kTypicalSize)});
  }
  return found;
}

template <class Get>
py::dict by_parameter(const FoundEffect& found, const Get& get) {
  py::dict dict;
  for (std::size_t i = 0; i < found.variant.parameters.size(); ++i) {
    dict[py::str(found.variant.parameters[i].name)] = get(i);
  }
  return dict;
}

std::string effect_repr(const FoundEffect& found) {
  std::string text = "FoundEffect(\"" + found.variant.effect + "\"";
  if (found.variant.joint >= 0) text += ", joint=" + std::to_string(found.variant.joint);
  for (std::size_t i = 0; i < found.variant.parameters.size(); ++i) {
    text += ", " + found.variant.parameters[i].name + "=" +
            to_text(found.values[static_cast<Eigen::Index>(i)]);
  }
  return text + ")";
}

void bind_effect(py::module_& module) {
  py::class_<EffectInfo::Range>(module, "EffectRange", "Plausible sizes of a parameter.")
      .def_readonly("parameter", &EffectInfo::Range::parameter, "Name of the parameter.")
      .def_readonly("unit", &EffectInfo::Range::unit, "Of `low` and `high`.")
      .def_readonly("low", &EffectInfo::Range::low, "Smallest plausible size, in `unit`.")
      .def_readonly("high", &EffectInfo::Range::high, "Largest plausible size, in `unit`.")
      .def("__repr__", [](const EffectInfo::Range& range) {
        return "EffectRange(" + range.parameter + ", " + to_text(range.low) + " to " +
               to_text(range.high) + " " + range.unit + ")";
      });
  py::class_<Effect, std::shared_ptr<Effect>>(module, "Effect", kEffectDoc)
      .def(py::init(&make_effect), py::arg("name"), py::arg("function"), py::kw_only(),
           py::arg("parameters"), py::arg("joints") = py::none(), py::arg("site") = "joint",
           py::arg("needs") = std::vector<std::string>{}, py::arg("words") = "",
           py::arg("formula") = "", py::arg("source") = "",
           py::arg("scales") = std::map<std::string, double>{}, py::arg("by_difference") = false,
           py::arg("period") = std::numeric_limits<double>::infinity(),
           py::arg("extrapolates") = false)
      .def_property_readonly(
          "name", [](const Effect& e) { return e.info().name; }, "As diagnosis names it.")
      .def_property_readonly(
          "words", [](const Effect& e) { return e.info().description; }, "Description.")
      .def_property_readonly(
          "formula", [](const Effect& e) { return e.info().formula; },
          "What it adds, as text for people.")
      .def_property_readonly(
          "source", [](const Effect& e) { return e.info().source; }, "Paper or textbook.")
      .def_property_readonly(
          "needs", [](const Effect& e) { return e.info().needs; },
          "Covariates without which it is not observable.")
      .def_property_readonly(
          "ranges", [](const Effect& e) { return e.info().ranges; },
          "EffectRange of each parameter.")
      .def_property_readonly(
          "by_difference", [](const Effect& e) { return e.info().by_difference; },
          "Whether it depends on how rows differ from their neighbours.")
      .def_property_readonly(
          "extrapolates", [](const Effect& e) { return e.info().extrapolates; }, kExtrapolatesDoc)
      .def("__str__", [](const Effect& e) { return effect_text(e.info()); })
      .def("__repr__", [](const Effect& e) { return "Effect(\"" + e.info().name + "\")"; });
}

void bind_found_effect(py::module_& module) {
  py::class_<FoundEffect>(module, "FoundEffect", kFoundEffectDoc)
      .def(py::init(&make_found), py::arg("effect"), py::arg("parameters"), py::kw_only(),
           py::arg("joint") = py::none(), py::arg("settings") = std::map<std::string, double>{},
           py::arg("units") = std::map<std::string, std::string>{},
           py::arg("scales") = std::map<std::string, double>{}, py::arg("cause") = "")
      .def_property_readonly(
          "name", [](const FoundEffect& f) { return f.variant.effect; }, "Of its effect.")
      .def_property_readonly(
          "effect", [](const FoundEffect& f) { return std::const_pointer_cast<Effect>(f.effect); },
          "The Effect itself.")
      .def_property_readonly(
          "joint",
          [](const FoundEffect& f) -> std::optional<int> {
            if (f.variant.joint < 0) return std::nullopt;
            return f.variant.joint;
          },
          "Counted from 0, or None.")
      .def_property_readonly(
          "settings", [](const FoundEffect& f) { return f.variant.settings; },
          "What distinguishes this variant of the effect from others.")
      .def_property_readonly(
          "parameters",
          [](const FoundEffect& f) {
            return by_parameter(f, [&](std::size_t i) {
              return py::float_(f.values[static_cast<Eigen::Index>(i)]);
            });
          },
          "Name to value.")
      .def_property_readonly(
          "units",
          [](const FoundEffect& f) {
            return by_parameter(
                f, [&](std::size_t i) { return py::str(f.variant.parameters[i].unit); });
          },
          "Name to unit.")
      .def_property_readonly(
          "scales",
          [](const FoundEffect& f) {
            return by_parameter(
                f, [&](std::size_t i) { return py::float_(f.variant.parameters[i].scale); });
          },
          "Name to a typical size.")
      .def_property_readonly(
          "cause", [](const FoundEffect& f) { return f.variant.alias_group; },
          "Effects of one cause are descriptions of the same thing.")
      .def_property_readonly(
          "extrapolates", [](const FoundEffect& f) { return f.effect->extrapolates(f.variant); },
          "Whether it is extrapolated beyond the training data: as its effect, unless it was found "
          "with unknown masses (`joint_compliance` by moments).")
      .def("__repr__", &effect_repr);
}

}  // namespace

void bind_effects(py::module_& module) {
  bind_effect_rows(module);
  bind_effect(module);
  bind_found_effect(module);
  module.def(
      "library_effects",
      [] {
        std::vector<std::shared_ptr<Effect>> effects;
        for (const std::shared_ptr<const Effect>& effect : library_effects()) {
          effects.push_back(std::const_pointer_cast<Effect>(effect));
        }
        return effects;
      },
      "The effects of the library, in a fixed order (bathyal.effects.list).");
}

}  // namespace bathyal::python
