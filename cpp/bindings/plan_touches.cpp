// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/touch_planning/plan_touches.hpp"

#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "identify_parts.hpp"
#include "plan_touches_docs.hpp"

namespace bathyal::python {
namespace {

const EnumNames<TouchCriterion>& touch_criterion_names() {
  static const EnumNames<TouchCriterion> names{{"worst_tip", TouchCriterion::kWorstTip},
                                               {"d_optimal", TouchCriterion::kDOptimal},
                                               {"o1", TouchCriterion::kO1}};
  return names;
}

using PairsOfPoints =
    py::typing::Optional<py::typing::Iterable<py::typing::Tuple<py::int_, py::int_>>>;
using MaybeFeasible = py::typing::Optional<py::typing::Callable<py::array(py::array)>>;

// Arguments -------------------------------------------------------------------------------------

RowMatrix workspace_argument(const OptionalArray& workspace, const Arm& arm) {
  if (workspace.is_none()) return {};
  RowMatrix poses = table_argument("workspace", workspace, arm.size());
  if (poses.rows() == 0) throw_argument("workspace", "one pose or more", "none");
  return poses;
}

ForecastOptions forecast_argument(const Arm& arm, const std::string& parametrization,
                                  double nearly_parallel, double noise, double length_prior,
                                  double angle_prior, double tool_prior,
                                  const OptionalArray& workspace, int workspace_poses,
                                  std::uint64_t seed, int num_threads) {
  return {
      .parametrization = enum_argument("parametrization", parametrization, parametrization_names()),
      .nearly_parallel = nearly_parallel,
      .noise = noise,
      .length_prior = length_prior,
      .angle_prior = angle_prior,
      .tool_prior = tool_prior,
      .workspace = workspace_argument(workspace, arm),
      .workspace_poses = workspace_poses,
      .seed = seed,
      .num_threads = num_threads};
}

Eigen::Matrix3Xd points_to_touch(const OptionalArray& points) {
  if (points.is_none()) return Eigen::Matrix3Xd(3, 0);
  const auto table = table_argument("points", points, 3);
  if (table.rows() == 0) throw_argument("points", "one point or more", "none");
  return table.transpose();
}

std::vector<std::pair<int, int>> pairs_argument(const py::object& object) {
  if (object.is_none()) return {};
  const bool dict = py::isinstance<py::dict>(object);
  try {
    if (!dict) return object.cast<std::vector<std::pair<int, int>>>();
  } catch (const py::cast_error&) {
  }
  throw_argument("known_distances", "pairs of numbers of points (the plan says how far apart)",
                 dict ? "a dict" : std::string(py::repr(object)));
}

/// The answers of a Python function, with the interpreter's lock while it runs.
Feasible feasible_argument(const py::object& function) {
  if (function.is_none()) return {};
  if (PyCallable_Check(function.ptr()) == 0) {
    throw_argument("feasible", "a function of (N, n) joint values",
                   std::string(py::str(py::type::of(function).attr("__name__"))));
  }
  return [&function](const RowMatrix& q) {
    const py::gil_scoped_acquire acquire;
    const py::array rows = to_numpy(std::vector<double>(q.data(), q.data() + q.size()), {q.cols()});
    const std::string expected =
        "it to return bool of shape (" + std::to_string(q.rows()) + ",), as many as rows";
    const py::array answers = array_argument("feasible", function(rows), expected);
    if (answers.dtype().kind() != 'b' || answers.ndim() != 1 || answers.shape(0) != q.rows()) {
      throw_argument("feasible", expected,
                     std::string(py::str(answers.dtype())) + " of shape " +
                         std::string(py::str(answers.attr("shape"))));
    }
    return answers.cast<std::vector<bool>>();
  };
}

// Results ---------------------------------------------------------------------------------------

py::array rows_to_numpy(const RowMatrix& table) {
  return to_numpy(std::vector<double>(table.data(), table.data() + table.size()), {table.cols()});
}

void bind_forecast(py::module_& module) {
  py::class_<TouchForecast>(module, "TouchForecast", kTouchForecastDoc)
      .def_property_readonly(
          "workspace", [](const TouchForecast& f) { return rows_to_numpy(f.workspace); },
          "(S, n) poses for which the deviation is predicted.")
      .def_property_readonly(
          "tip_std", [](const TouchForecast& f) { return to_numpy(f.tip_std); },
          "(S,) root of the trace of the tip's covariance there [m].")
      .def_readonly("worst_tip_std", &TouchForecast::worst_tip_std, "[m]")
      .def_readonly("median_tip_std", &TouchForecast::median_tip_std, "[m]")
      .def_readonly("parameters", &TouchForecast::parameters, "As many as ArmFit.parameters.")
      .def_readonly("free", &TouchForecast::free,
                    "Of them, those that base and tool cannot represent.")
      .def_readonly("rank", &TouchForecast::rank, "Of the data by the free ones, without priors.")
      .def_property_readonly(
          "singular_values",
          [](const TouchForecast& f) {
            return to_numpy(
                std::vector<double>(f.singular_values.begin(), f.singular_values.end()));
          },
          "(free,) descending: millimetres at the tip per mm and mrad of a direction.")
      .def_readonly("unseen", &TouchForecast::null_space,
                    "Descriptions of the undetermined directions of the free parameters.")
      .def_readonly("o1", &TouchForecast::o1, "Observability index of Borm and Menq (1989).")
      .def_readonly("log_det", &TouchForecast::log_det,
                    "ln det of the free parameters' information per mm and mrad, with priors.")
      .def("__repr__", [](const TouchForecast& f) {
        return py::str("TouchForecast(worst {:.3g} mm, median {:.3g} mm, rank {} of {})")
            .format(1e3 * f.worst_tip_std, 1e3 * f.median_tip_std, f.rank, f.free);
      });
}

void bind_plan(py::module_& module) {
  py::class_<TouchPlan>(module, "TouchPlan", kTouchPlanDoc)
      .def_readonly("arm", &TouchPlan::arm, "Arm for which the plan is.")
      .def_property_readonly(
          "q", [](const TouchPlan& p) { return rows_to_numpy(p.q); },
          "(N, n) poses, point by point, each near the one before [rad] or [m].")
      .def_property_readonly(
          "point", [](const TouchPlan& p) { return to_numpy(p.point); },
          "(N,) number of the point that each pose touches.")
      .def_property_readonly(
          "points", [](const TouchPlan& p) { return rows_to_numpy(p.points.transpose()); },
          "(k, 3) positions of the points, world [m].")
      .def_readonly("known_distances", &TouchPlan::known_distances,
                    "Pairs of points whose distance is to be measured.")
      .def_property_readonly(
          "criterion", [](const TouchPlan& p) { return std::string(to_text(p.criterion)); },
          "\"worst_tip\", \"d_optimal\" or \"o1\": what was optimised.")
      .def_readonly("value", &TouchPlan::value, "Of the criterion: worst_tip [m], ln det, or O1.")
      .def_readonly("forecast", &TouchPlan::forecast, "TouchForecast of these touches.")
      .def_property_readonly(
          "worst_tip_std", [](const TouchPlan& p) { return p.forecast.worst_tip_std; },
          "Of the forecast [m].")
      .def_property_readonly(
          "median_tip_std", [](const TouchPlan& p) { return p.forecast.median_tip_std; },
          "Of the forecast [m].")
      .def_readonly("candidates", &TouchPlan::candidates, "Number of candidate poses.")
      .def_readonly("warnings", &TouchPlan::warnings, "Sentences.")
      .def("summary", py::overload_cast<const TouchPlan&, bool>(&summarize), py::kw_only(),
           py::arg("warnings") = true, "One paragraph.")
      .def("__str__", [](const TouchPlan& p) { return summarize(p); })
      .def("__len__", [](const TouchPlan& p) { return p.point.size(); })
      .def("__repr__", [](const TouchPlan& p) {
        return py::str("TouchPlan({} touches of {} points, worst {:.3g} mm)")
            .format(p.point.size(), p.points.cols(), 1e3 * p.forecast.worst_tip_std);
      });
}

void bind_functions(py::module_& module) {
  const PlanTouchesOptions defaults;
  const ForecastOptions& forecast = defaults.forecast;
  module.def(
      "forecast_touches",
      [](const Arm& arm, const Touches& touches, const std::string& parametrization,
         double nearly_parallel, double noise, double length_prior, double angle_prior,
         double tool_prior, const OptionalArray& workspace, int workspace_poses, std::uint64_t seed,
         int num_threads) {
        const ForecastOptions options = forecast_argument(
            arm, parametrization, nearly_parallel, noise, length_prior, angle_prior, tool_prior,
            workspace, workspace_poses, seed, num_threads);
        const py::gil_scoped_release release;
        return forecast_touches(arm, touches, options);
      },
      py::arg("arm"), py::arg("touches"), py::kw_only(),
      py::arg("parametrization") = enum_name(forecast.parametrization, parametrization_names()),
      py::arg("nearly_parallel") = forecast.nearly_parallel, py::arg("noise") = forecast.noise,
      py::arg("length_prior") = forecast.length_prior,
      py::arg("angle_prior") = forecast.angle_prior, py::arg("tool_prior") = forecast.tool_prior,
      py::arg("workspace") = py::none(), py::arg("workspace_poses") = forecast.workspace_poses,
      py::arg("seed") = forecast.seed, py::arg("num_threads") = forecast.num_threads,
      kForecastTouchesDoc);
  module.def(
      "plan_touches",
      [](const Arm& arm, int count, const OptionalArray& points, int num_points,
         const PairsOfPoints& known_distances, double distance_std, std::vector<int> known_points,
         double point_std, const MaybeFeasible& feasible, std::optional<double> floor,
         const std::string& criterion, int candidates, int passes,
         const std::string& parametrization, double nearly_parallel, double noise,
         double length_prior, double angle_prior, double tool_prior, const OptionalArray& workspace,
         int workspace_poses, std::uint64_t seed, int num_threads) {
        const PlanTouchesOptions options{
            .criterion = enum_argument("criterion", criterion, touch_criterion_names()),
            .points = points_to_touch(points),
            .num_points = num_points,
            .known_distances = pairs_argument(known_distances),
            .distance_std = distance_std,
            .known_points = std::move(known_points),
            .point_std = point_std,
            .feasible = feasible_argument(feasible),
            .floor = floor,
            .candidates = candidates,
            .passes = passes,
            .forecast = forecast_argument(arm, parametrization, nearly_parallel, noise,
                                          length_prior, angle_prior, tool_prior, workspace,
                                          workspace_poses, seed, num_threads)};
        const py::gil_scoped_release release;
        return plan_touches(arm, count, options);
      },
      py::arg("arm"), py::arg("count"), py::kw_only(), py::arg("points") = py::none(),
      py::arg("num_points") = defaults.num_points, py::arg("known_distances") = py::none(),
      py::arg("distance_std") = defaults.distance_std,
      py::arg("known_points") = defaults.known_points, py::arg("point_std") = defaults.point_std,
      py::arg("feasible") = py::none(), py::arg("floor") = defaults.floor,
      py::arg("criterion") = enum_name(defaults.criterion, touch_criterion_names()),
      py::arg("candidates") = defaults.candidates, py::arg("passes") = defaults.passes,
      py::arg("parametrization") = enum_name(forecast.parametrization, parametrization_names()),
      py::arg("nearly_parallel") = forecast.nearly_parallel, py::arg("noise") = forecast.noise,
      py::arg("length_prior") = forecast.length_prior,
      py::arg("angle_prior") = forecast.angle_prior, py::arg("tool_prior") = forecast.tool_prior,
      py::arg("workspace") = py::none(), py::arg("workspace_poses") = forecast.workspace_poses,
      py::arg("seed") = forecast.seed, py::arg("num_threads") = forecast.num_threads,
      kPlanTouchesDoc);
}

}  // namespace

void bind_plan_touches(py::module_& module) {
  bind_forecast(module);
  bind_plan(module);
  bind_functions(module);
}

}  // namespace bathyal::python
