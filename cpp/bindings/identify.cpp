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
#include "identify_docs.hpp"
#include "identify_parts.hpp"
#include "words.hpp"

namespace bathyal::python {
namespace {

const Words<Criterion>& criterion_words() {
  static const Words<Criterion> words{{"centroid", Criterion::kCentroid},
                                      {"pairs", Criterion::kPairs}};
  return words;
}
const Words<Solver>& solver_words() {
  static const Words<Solver> words{{"levenberg_marquardt", Solver::kLevenbergMarquardt},
                                   {"paper", Solver::kPaper}};
  return words;
}
const Words<Loss>& loss_words() {
  static const Words<Loss> words{
      {"square", Loss::kSquare}, {"huber", Loss::kHuber}, {"cauchy", Loss::kCauchy}};
  return words;
}
const Words<ToolStart>& tool_words() {
  static const Words<ToolStart> words{
      {"auto", ToolStart::kAuto}, {"arm", ToolStart::kArm}, {"estimate", ToolStart::kEstimate}};
  return words;
}
const Words<BaseChoice>& base_words() {
  static const Words<BaseChoice> words{
      {"auto", BaseChoice::kAuto}, {"free", BaseChoice::kFree}, {"fixed", BaseChoice::kFixed}};
  return words;
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
        const Options options{.parametrization = word_argument("parametrization", parametrization,
                                                               parametrization_words()),
                              .nearly_parallel = nearly_parallel,
                              .criterion = word_argument("criterion", criterion, criterion_words()),
                              .pair_weights = pair_weights,
                              .solver = word_argument("solver", solver, solver_words()),
                              .max_iterations = max_iterations,
                              .tool_start = word_argument("tool_start", tool_start, tool_words()),
                              .base = word_argument("base", base, base_words()),
                              .fixed = std::move(fixed),
                              .length_prior = length_prior,
                              .angle_prior = angle_prior,
                              .priors = std::move(priors),
                              .size_prior = size_prior,
                              .noise = noise,
                              .rotation_noise = rotation_noise,
                              .loss = word_argument("loss", loss, loss_words()),
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
      py::arg("parametrization") = word_of(defaults.parametrization, parametrization_words()),
      py::arg("nearly_parallel") = defaults.nearly_parallel,
      py::arg("criterion") = word_of(defaults.criterion, criterion_words()),
      py::arg("pair_weights") = defaults.pair_weights,
      py::arg("solver") = word_of(defaults.solver, solver_words()),
      py::arg("max_iterations") = defaults.max_iterations,
      py::arg("tool_start") = word_of(defaults.tool_start, tool_words()),
      py::arg("base") = word_of(defaults.base, base_words()), py::arg("fixed") = defaults.fixed,
      py::arg("length_prior") = defaults.length_prior,
      py::arg("angle_prior") = defaults.angle_prior, py::arg("priors") = defaults.priors,
      py::arg("size_prior") = defaults.size_prior, py::arg("noise") = defaults.noise,
      py::arg("rotation_noise") = defaults.rotation_noise,
      py::arg("loss") = word_of(defaults.loss, loss_words()),
      py::arg("loss_width") = defaults.loss_width, py::arg("prune_sigma") = defaults.prune_sigma,
      py::arg("num_threads") = defaults.num_threads, kIdentifyArmDoc);
}

}  // namespace

const Words<Parametrization>& parametrization_words() {
  static const Words<Parametrization> words{{"hayati", Parametrization::kHayati},
                                            {"dh", Parametrization::kDh}};
  return words;
}

void bind_identify(py::module_& module) {
  bind_identify_data(module);
  bind_effects(module);
  bind_corrected_arm(module);
  bind_identify_fit(module);
  bind_identify_arm(module);
}

}  // namespace bathyal::python
