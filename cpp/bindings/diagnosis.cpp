// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/diagnosis/diagnose.hpp"

#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <optional>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/compensation/corrected_arm.hpp"
#include "bathyal/selection/decisions.hpp"
#include "bindings.hpp"
#include "diagnosis_docs.hpp"
#include "enum_names.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

namespace py = pybind11;

const EnumNames<Verdict>& verdict_names() {
  static const EnumNames<Verdict> names{{"none", Verdict::kNone},
                                        {"clean", Verdict::kClean},
                                        {"named", Verdict::kNamed},
                                        {"ambiguous", Verdict::kAmbiguous},
                                        {"unknown", Verdict::kUnknown}};
  return names;
}

std::optional<int> joint_or_none(int joint) {
  return joint < 0 ? std::nullopt : std::optional<int>(joint);
}

std::string on_joint(int joint) { return joint < 0 ? "" : ", joint=" + std::to_string(joint); }

const EnumNames<Dependence::Kind>& kind_names() {
  using Kind = Dependence::Kind;
  static const EnumNames<Kind> names{
      {"none", Kind::kNone},       {"position", Kind::kPosition},   {"joints", Kind::kJoints},
      {"time", Kind::kTime},       {"order", Kind::kOrder},         {"approach", Kind::kApproach},
      {"session", Kind::kSession}, {"covariate", Kind::kCovariate}, {"range", Kind::kRange}};
  return names;
}

void bind_structure(py::module_& module) {
  using OptionalText = py::typing::Optional<py::str>;
  py::class_<Structure>(module, "Structure", kStructureDoc)
      .def_property_readonly(
          "kind", [](const Structure& s) { return enum_name(s.dependence.kind, kind_names()); },
          kKindDoc)
      .def_property_readonly(
          "coordinates", [](const Structure& s) { return s.dependence.coordinates; },
          "Of kind \"joints\" (one, two or all) and \"approach\" (one): the joints' coordinates, "
          "from "
          "0.")
      .def_property_readonly(
          "period", [](const Structure& s) { return s.dependence.period; },
          "Of kind \"time\": period of a vibration [s]; None of a drift.")
      .def_property_readonly(
          "covariate",
          [](const Structure& s) -> OptionalText {
            if (s.dependence.covariate.empty()) return py::none();
            return py::str(s.dependence.covariate);
          },
          "Of kind \"covariate\": its name; else None.")
      .def_property_readonly(
          "component", [](const Structure& s) { return s.dependence.component; },
          "Column of a covariate that has several, from 0; else None.")
      .def_property_readonly(
          "joint", [](const Structure& s) { return joint_or_none(s.joint); },
          "Coordinate that is in error, from 0; None where the tip is.")
      .def_property_readonly(
          "against", [](const Structure& s) { return to_text(s.dependence); },
          "The dependence as text, joints counted from 1: \"joints 2 and 3\"; \"\" of kind "
          "\"none\".")
      .def_readonly("words", &Structure::description, "Description of the dependence.")
      .def_readonly("size", &Structure::size, "rms per axis, less noise [m].")
      .def_readonly("share", &Structure::share, "Of the residuals' variance, less noise.")
      .def_readonly("p_value", &Structure::p_value, "Corrected for all tests that were made.")
      .def_property_readonly("is_beyond_noise", &Structure::is_beyond_noise,
                             "Whether `p_value` is at most 0.002.")
      .def("__repr__", [](const Structure& s) {
        const std::string against = to_text(s.dependence);
        return "Structure(" + (against.empty() ? "nothing" : against) + ", " + to_text(s.size) +
               " m)";
      });
}

void bind_diagnosis_parts(py::module_& module) {
  py::class_<Estimate>(module, "Estimate", kEstimateDoc)
      .def_readonly("name", &Estimate::name, "Of the parameter.")
      .def_readonly("value", &Estimate::value, "In `unit`.")
      .def_readonly("unit", &Estimate::unit, "SI; \"\" of a setting, \"1\" of a number.")
      .def_readonly("std", &Estimate::std, "0 of what was counted or chosen, not measured.")
      .def_property_readonly(
          "interval", [](const Estimate& e) { return py::make_tuple(e.low, e.high); },
          "Ends of the 95 % confidence interval, in `unit`.")
      .def("__float__", [](const Estimate& e) { return e.value; })
      .def("__int__", [](const Estimate& e) { return static_cast<long>(e.value); })
      .def("__repr__", [](const Estimate& e) {
        return "Estimate(" + e.name + "=" + to_text(e.value) + " " + e.unit + ", " +
               to_text(e.low) + " to " + to_text(e.high) + ")";
      });
  py::class_<Cause>(module, "Cause", "A cause by name, as lists of alternatives hold it.")
      .def_readonly("name", &Cause::name, "Of the effect.")
      .def_property_readonly(
          "joint", [](const Cause& c) { return joint_or_none(c.joint); },
          "Counted from 0; None of an effect of the whole arm.")
      .def_readonly("words", &Cause::description,
                    "Description, as \"a harmonic of order 2 along joint 3\".")
      .def_readonly("odds", &Cause::odds, "Against the best explanation, 0 to 1.")
      .def("__repr__", [](const Cause& c) { return "Cause(" + c.name + on_joint(c.joint) + ")"; });
  py::class_<NamedEffect>(module, "NamedEffect", kNamedEffectDoc)
      .def_readonly("name", &NamedEffect::name, "Of the effect.")
      .def_property_readonly(
          "joint", [](const NamedEffect& e) { return joint_or_none(e.joint); },
          "Coordinate in error, from 0, or None.")
      .def_readonly("words", &NamedEffect::description,
                    "Description, as \"a harmonic of order 2 along joint 3\".")
      .def_property_readonly(
          "parameters",
          [](const NamedEffect& e) {
            py::dict out;
            for (const Estimate& p : e.parameters) out[py::str(p.name)] = p;
            return out;
          },
          "Estimate of each parameter, by name.")
      .def_readonly("rows", &NamedEffect::rows, "Of outliers: the rows.")
      .def_readonly("size", &NamedEffect::size,
                    "rms contribution given all else that was fitted, per axis [m].")
      .def_readonly(
          "gain", &NamedEffect::gain,
          "Share of the held-out variance above noise that it explains; of effects on the "
          "noise itself: held-out log likelihood.")
      .def_readonly("held_out_before", &NamedEffect::held_out_before, "Without it, 3-D rms [m].")
      .def_readonly("held_out_after", &NamedEffect::held_out_after, "With it, 3-D rms [m].")
      .def_readonly("nested_folds", &NamedEffect::nested_folds,
                    "In how many folds of `held_out.nested` the same was found in this joint.")
      .def_readonly("p_value", &NamedEffect::p_value,
                    "Of its F test given the others, corrected for multiplicity.")
      .def_readonly("rivals", &NamedEffect::alternatives, "Cause: the best alternatives to it.")
      .def("__repr__",
           [](const NamedEffect& e) { return "NamedEffect(" + e.name + on_joint(e.joint) + ")"; });
  module.attr("BEYOND_NOISE") = selection::Decisions::kBeyondNoise;
  bind_structure(module);
}

void bind_held_out(py::module_& module) {
  py::class_<HeldOut::Part>(module, "HeldOutPart", "One group, session or touched point.")
      .def_readonly("name", &HeldOut::Part::name,
                    "\"group east\", \"session 2\", \"point 0\", \"all\".")
      .def_readonly("rows", &HeldOut::Part::rows, "How many rows it has.")
      .def_readonly("rms_before", &HeldOut::Part::rms_before, "3-D [m].")
      .def_readonly("rms_after", &HeldOut::Part::rms_after, "3-D [m].");
  py::class_<HeldOut::Nested>(
      module, "HeldOutNested",
      "Prediction errors of rows that had no part in the choice of causes either (nested "
      "cross-validation).")
      .def_readonly("folds", &HeldOut::Nested::folds,
                    "Number of folds, each held out of a whole "
                    "diagnosis.")
      .def_readonly("rms_after", &HeldOut::Nested::rms, "3-D, of the rows that `after` has [m].")
      .def_property_readonly(
          "after", [](const HeldOut::Nested& h) { return to_numpy(h.after); },
          "(N,) [m]; nan: an outlier, or a tool or station that only its fold has.")
      .def_property_readonly(
          "verdicts",
          [](const HeldOut::Nested& h) {
            std::vector<std::string> names;
            for (const Verdict verdict : h.verdicts)
              names.push_back(enum_name(verdict, verdict_names()));
            return names;
          },
          "list of str: the verdict of each of these diagnoses.");
  py::class_<HeldOut>(module, "HeldOut", "Prediction errors of held-out rows.")
      .def_readonly("how", &HeldOut::how, "What one fold is.")
      .def_readonly("blocks", &HeldOut::blocks, "Number of folds.")
      .def_readonly("rms_before", &HeldOut::rms_before, "Geometry alone, 3-D [m].")
      .def_readonly("rms_after", &HeldOut::rms_after, "With the effects, 3-D [m].")
      .def_readonly("noise", &HeldOut::noise, "Floor, 3-D [m].")
      .def_readonly("p_value", &HeldOut::p_value, "Of the gain, by sign flips of the folds.")
      .def_property_readonly(
          "nested",
          [](const HeldOut& h) -> py::typing::Optional<HeldOut::Nested> {
            return h.nested.folds > 0 ? py::cast(h.nested) : py::none();
          },
          "HeldOutNested: the causes chosen anew without each fold; None unless asked for.")
      .def_readonly("parts", &HeldOut::parts,
                    "HeldOutPart: errors by group, session or touched point.")
      .def_property_readonly(
          "before", [](const HeldOut& h) { return to_numpy(h.before); },
          "(N,) geometry alone [m]; NaN of outliers.")
      .def_property_readonly(
          "after", [](const HeldOut& h) { return to_numpy(h.after); }, "(N,) [m].");
}

void bind_result(py::module_& module) {
  py::class_<Diagnosis>(module, "Diagnosis", py::dynamic_attr(), kDiagnosisDoc)
      .def_property_readonly(
          "data",  // the caller's own object
          [](const py::object& self) -> py::typing::Union<Touches, Tracked> {
            return self.attr("_data");
          },
          "Touches or Tracked: the data.")
      .def_property_readonly(
          "verdict", [](const Diagnosis& d) { return enum_name(d.verdict, verdict_names()); },
          "\"clean\", \"named\", \"ambiguous\", \"unknown\", or \"none\" where nothing can be held "
          "out.")
      .def_readonly("effects", &Diagnosis::effects,
                    "NamedEffect, largest first; partial when the verdict is unknown.")
      .def_readonly(
          "ambiguous", &Diagnosis::ambiguous,
          "Cause: what these data cannot distinguish; the four most likely in the place of "
          "an effect, itself included. Its `rivals` may be more.")
      .def_property_readonly(
          "next_poses",
          [](const Diagnosis& d) {
            const bool none = d.next_poses.rows() == 0;  // of whatever width
            return to_numpy(none ? RowMatrix(0, d.arm.size()) : RowMatrix(d.next_poses));
          },
          "(m, n) poses that would distinguish them [rad or m].")
      .def_readonly(
          "shown", &Diagnosis::lack_of_fit_before,
          "Structure in the residuals of geometry alone, most significant first: all that is "
          "beyond noise; where nothing is, the most significant.")
      .def_readonly("leftover", &Diagnosis::unexplained,
                    "Structure that the effects do not explain; its size is 0 when there is none.")
      .def_readonly("held_out", &Diagnosis::held_out, "HeldOut: the cross-validation.")
      .def_readonly("gain", &Diagnosis::gain, "(r0² - r1²) / (r0² - noise²) of held-out rms.")
      .def_readonly("fit", &Diagnosis::fit, "ArmFit: geometry alone.")
      .def_property_readonly(
          "model", [](const Diagnosis& d) { return CorrectedArm(d.arm, d.found, d.support); },
          "CorrectedArm: geometry and effects, with the support of the data.")
      .def_readonly("noise", &Diagnosis::noise, "Standard deviation per axis [m].")
      .def_readonly("noise_source", &Diagnosis::noise_source, "What the noise was estimated from.")
      .def_readonly(
          "noise_is_measured", &Diagnosis::noise_is_measured,
          "Whether repeats of poses give the noise; otherwise it is what the model itself "
          "leaves.")
      .def_readonly("detectable", &Diagnosis::detectable,
                    "Smallest size of an effect that is found, per axis [m].")
      .def_property_readonly(
          "residuals_before",
          [](const Diagnosis& d) { return to_numpy(RowMatrix(d.residuals_before.transpose())); },
          "(N, 3) tip less measured (of touches: less their mean), geometry alone [m].")
      .def_property_readonly(
          "residuals_after",
          [](const Diagnosis& d) { return to_numpy(RowMatrix(d.residuals_after.transpose())); },
          "(N, 3) the same with the effects [m].")
      .def_readonly("warnings", &Diagnosis::warnings, "Sentences.")
      .def("__repr__", [](const Diagnosis& d) {
        std::string text = "Diagnosis(" + enum_name(d.verdict, verdict_names());
        for (const NamedEffect& e : d.effects) {
          text += ", " + e.name + (e.joint < 0 ? "" : "[" + std::to_string(e.joint) + "]");
        }
        return text + ")";
      });
}

std::string type_of(const py::handle& object) {
  return py::str(py::type::of(object).attr("__name__")).cast<std::string>();
}

std::vector<std::shared_ptr<const Effect>> effects_argument(const py::object& effects) {
  const char* expected = "a list of effects, as bathyal.effects.list()";
  if (effects.is_none()) return library_effects();
  if (py::isinstance<py::str>(effects) || !py::isinstance<py::iterable>(effects)) {
    throw_argument("effects", expected, type_of(effects));
  }
  std::vector<std::shared_ptr<const Effect>> out;
  for (const py::handle effect : effects) {
    if (!py::isinstance<Effect>(effect)) {
      throw_argument("effects", expected, py::repr(effect).cast<std::string>() + " in it");
    }
    out.push_back(effect.cast<std::shared_ptr<Effect>>());
  }
  return out;
}

const Arm& arm_argument(const py::object& arm) {
  if (py::isinstance<Arm>(arm)) return arm.cast<const Arm&>();
  throw_argument("arm", "an Arm; of a corrected one its rigid part, `.arm`", type_of(arm));
}

/// Labels of rows as text: 1 and 1.0 are one label.
std::vector<std::string> groups_argument(const py::object& groups) {
  if (groups.is_none()) return {};
  const char* expected = "whole numbers or text of shape (N,)";
  const py::array labels = array_argument("groups", groups, expected);
  if (labels.ndim() != 1 || labels.size() == 0) {
    throw_argument("groups", expected,
                   "shape " + py::str(labels.attr("shape")).cast<std::string>());
  }
  std::vector<std::string> out;
  for (const py::handle item : labels.attr("tolist")()) {
    auto label = py::reinterpret_borrow<py::object>(item);
    if (py::isinstance<py::float_>(label) && label.attr("is_integer")().cast<bool>())
      label = py::int_(label);
    if (!py::isinstance<py::str>(label) && !py::isinstance<py::int_>(label))
      throw_argument("groups", expected, py::repr(label).cast<std::string>() + " in it");
    out.push_back(py::str(label).cast<std::string>());
  }
  return out;
}

using MaybeProgress = py::typing::Optional<py::typing::Callable<void(py::float_, py::str)>>;

void bind_diagnose(py::module_& module) {
  const DiagnoseOptions defaults;
  module.def(
      "diagnose",
      [](const py::typing::Union<Arm>& given, const py::typing::Union<Touches, Tracked>& data,
         const py::typing::Optional<py::typing::Iterable<Effect>>& effects,
         const std::string& parametrization, std::vector<std::string> fixed,
         std::optional<double> length_prior, int blocks, const OptionalArray& groups, int nested,
         double rival_odds, double leftover, int num_next_poses, const MaybeProgress& progress,
         int num_threads) {
        const Arm& arm = arm_argument(given);
        const DiagnoseOptions options{
            .parametrization =
                enum_argument("parametrization", parametrization, parametrization_names()),
            .fixed = std::move(fixed),
            .length_prior = length_prior,
            .blocks = blocks,
            .rival_odds = rival_odds,
            .leftover = leftover,
            .groups = groups_argument(groups),
            .nested = nested,
            .num_next_poses = num_next_poses,
            .num_threads = num_threads};
        const auto asked = effects_argument(effects);
        if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) {
          throw_argument("progress", "a function of (share done, what comes next)",
                         type_of(progress));
        }
        const DiagnosisProgress report_progress = [&](double done, const std::string& stage) {
          const py::gil_scoped_acquire acquire;
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          if (!progress.is_none()) progress(done, stage);
        };
        const auto run = [&](const auto& known) -> py::typing::Union<Diagnosis> {
          const auto find = [&] {
            const py::gil_scoped_release release;
            return diagnose(arm, known, options, asked, report_progress);
          };
          py::object found = py::cast(find());
          found.attr("_data") = data;
          return found;
        };
        if (py::isinstance<Touches>(data)) return run(data.cast<const Touches&>());
        if (py::isinstance<Tracked>(data)) return run(data.cast<const Tracked&>());
        throw_argument("data", "Touches or Tracked", type_of(data));
      },
      py::arg("arm"), py::arg("data"), py::kw_only(), py::arg("effects") = py::none(),
      py::arg("parametrization") = enum_name(defaults.parametrization, parametrization_names()),
      py::arg("fixed") = defaults.fixed, py::arg("length_prior") = defaults.length_prior,
      py::arg("blocks") = defaults.blocks, py::arg("groups") = py::none(),
      py::arg("nested") = defaults.nested, py::arg("rival_odds") = defaults.rival_odds,
      py::arg("leftover") = defaults.leftover, py::arg("num_next_poses") = defaults.num_next_poses,
      py::arg("progress") = py::none(), py::arg("num_threads") = defaults.num_threads,
      kDiagnoseDoc);
}

}  // namespace

void bind_diagnosis(py::module_& module) {
  bind_diagnosis_parts(module);
  bind_held_out(module);
  bind_result(module);
  bind_diagnose(module);
}

}  // namespace bathyal::python
