// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_arm.hpp"

#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/compensation/corrected_arm.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "identify_docs.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

const EnumNames<Criterion>& criterion_names() {
  static const EnumNames<Criterion> names{{"centroid", Criterion::kCentroid},
                                          {"pairs", Criterion::kPairs}};
  return names;
}
const EnumNames<Solver>& solver_names() {
  static const EnumNames<Solver> names{{"levenberg_marquardt", Solver::kLevenbergMarquardt},
                                       {"paper", Solver::kPaper}};
  return names;
}
const EnumNames<Loss>& loss_names() {
  static const EnumNames<Loss> names{
      {"square", Loss::kSquare}, {"huber", Loss::kHuber}, {"cauchy", Loss::kCauchy}};
  return names;
}
const EnumNames<ToolStart>& tool_names() {
  static const EnumNames<ToolStart> names{
      {"auto", ToolStart::kAuto}, {"arm", ToolStart::kArm}, {"estimate", ToolStart::kEstimate}};
  return names;
}
const EnumNames<BaseChoice>& base_names() {
  static const EnumNames<BaseChoice> names{
      {"auto", BaseChoice::kAuto}, {"free", BaseChoice::kFree}, {"fixed", BaseChoice::kFixed}};
  return names;
}

using AnyArm = std::variant<const Arm*, const CorrectedArm*>;

void bind_identify_arm(py::module_& module) {
  using Options = IdentifyOptions;
  const Options defaults;
  module.def(
      "identify_arm",
      [](const AnyArm& arm, const py::typing::Union<Touches, Tracked>& data,
         const std::string& parametrization, double nearly_parallel, const std::string& criterion,
         bool pair_weights, const std::string& solver, int max_iterations,
         const std::string& tool_start, const std::string& base, std::vector<std::string> fixed,
         std::optional<double> length_prior, std::optional<double> angle_prior,
         std::map<std::string, double> priors, double size_prior, std::optional<double> noise,
         std::optional<double> rotation_noise, const std::string& loss,
         std::optional<double> loss_width, std::optional<double> prune_sigma, int num_threads) {
        const Options options{.parametrization = enum_argument("parametrization", parametrization,
                                                               parametrization_names()),
                              .nearly_parallel = nearly_parallel,
                              .criterion = enum_argument("criterion", criterion, criterion_names()),
                              .pair_weights = pair_weights,
                              .solver = enum_argument("solver", solver, solver_names()),
                              .max_iterations = max_iterations,
                              .tool_start = enum_argument("tool_start", tool_start, tool_names()),
                              .base = enum_argument("base", base, base_names()),
                              .fixed = std::move(fixed),
                              .length_prior = length_prior,
                              .angle_prior = angle_prior,
                              .priors = std::move(priors),
                              .size_prior = size_prior,
                              .noise = noise,
                              .rotation_noise = rotation_noise,
                              .loss = enum_argument("loss", loss, loss_names()),
                              .loss_width = loss_width,
                              .prune_sigma = prune_sigma,
                              .num_threads = num_threads};
        if (std::visit([](const auto* one) { return one == nullptr; }, arm)) {
          throw_argument("arm", "an Arm or a CorrectedArm", "None");
        }
        const auto run = [&](const auto& known) {
          const py::gil_scoped_release release;
          return std::visit([&](const auto* one) { return identify_arm(*one, known, options); },
                            arm);
        };
        if (py::isinstance<Touches>(data)) return run(data.cast<const Touches&>());
        if (py::isinstance<Tracked>(data)) return run(data.cast<const Tracked&>());
        throw_argument("data", "Touches or Tracked",
                       std::string(py::str(py::type::of(data).attr("__name__"))));
      },
      py::arg("arm"), py::arg("data"), py::kw_only(),
      py::arg("parametrization") = enum_name(defaults.parametrization, parametrization_names()),
      py::arg("nearly_parallel") = defaults.nearly_parallel,
      py::arg("criterion") = enum_name(defaults.criterion, criterion_names()),
      py::arg("pair_weights") = defaults.pair_weights,
      py::arg("solver") = enum_name(defaults.solver, solver_names()),
      py::arg("max_iterations") = defaults.max_iterations,
      py::arg("tool_start") = enum_name(defaults.tool_start, tool_names()),
      py::arg("base") = enum_name(defaults.base, base_names()), py::arg("fixed") = defaults.fixed,
      py::arg("length_prior") = defaults.length_prior,
      py::arg("angle_prior") = defaults.angle_prior, py::arg("priors") = defaults.priors,
      py::arg("size_prior") = defaults.size_prior, py::arg("noise") = defaults.noise,
      py::arg("rotation_noise") = defaults.rotation_noise,
      py::arg("loss") = enum_name(defaults.loss, loss_names()),
      py::arg("loss_width") = defaults.loss_width, py::arg("prune_sigma") = defaults.prune_sigma,
      py::arg("num_threads") = defaults.num_threads, kIdentifyArmDoc);
}

}  // namespace

const EnumNames<Parametrization>& parametrization_names() {
  static const EnumNames<Parametrization> names{{"hayati", Parametrization::kHayati},
                                                {"dh", Parametrization::kDh}};
  return names;
}

void bind_identify(py::module_& module) {
  bind_identify_data(module);
  bind_effects(module);
  bind_corrected_arm(module);
  bind_identify_fit(module);
  bind_identify_arm(module);
}

}  // namespace bathyal::python
