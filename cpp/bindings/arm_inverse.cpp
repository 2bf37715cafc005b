// SPDX-License-Identifier: BSD-3-Clause

#include "arm_inverse.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "arm_class.hpp"
#include "arm_docs.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal::python {
namespace {

const EnumNames<InverseMethod>& method_names() {
  static const EnumNames<InverseMethod> names{{"damped", InverseMethod::kDampedLeastSquares},
                                              {"pseudo_inverse", InverseMethod::kPseudoInverse},
                                              {"jacobian_inverse", InverseMethod::kPseudoInverse}};
  return names;
}

InverseAnswer inverse_python(const Arm& arm, const ArrayLike& poses, const OptionalArray& start,
                             const InverseOptions& options) {
  const Targets targets = targets_argument(poses, options.task);
  const Rows starts = start.is_none() ? Rows{} : rows_argument("start", start, arm.size());
  InverseAnswer answer;
  answer.single = targets.single;
  const py::gil_scoped_release release;
  answer.result =
      inverse(arm, targets.poses,
              JointView(starts.table.data(), start.is_none() ? 0 : starts.table.rows(), arm.size()),
              options);
  return answer;
}

}  // namespace

const EnumNames<InverseTask>& task_names() {
  static const EnumNames<InverseTask> names{{"pose", InverseTask::kPose},
                                            {"position", InverseTask::kPosition},
                                            {"position_axis", InverseTask::kPositionAxis}};
  return names;
}

Targets targets_argument(const py::object& object, InverseTask task) {
  const std::string shapes = task == InverseTask::kPosition
                                 ? "real numbers of shape (N, 4, 4), (4, 4), (N, 3) or (3,)"
                                 : "real numbers of shape (N, 4, 4) or (4, 4)";
  const py::array array = array_argument("poses", object, shapes);
  const py::ssize_t dims = array.ndim();
  const bool square = dims >= 2 && array.shape(dims - 1) == 4 && array.shape(dims - 2) == 4;
  Targets targets;
  if ((dims == 2 || dims == 3) && square) {
    targets.single = dims == 2;
    const Rows rows = rows_argument("poses", array.attr("reshape")(-1, 16), 16);
    targets.poses.assign(rows.table.data(), rows.table.data() + rows.table.size());
    return targets;
  }
  const bool points =
      task == InverseTask::kPosition && (dims == 1 || dims == 2) && array.shape(dims - 1) == 3;
  if (!points) {
    throw_argument("poses", shapes, "shape " + std::string(py::str(array.attr("shape"))));
  }
  const Rows rows = rows_argument("poses", array, 3);
  targets.single = rows.single;
  targets.poses.reserve(static_cast<std::size_t>(16 * rows.table.rows()));
  for (Index i = 0; i < rows.table.rows(); ++i) {
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose;
    pose.setIdentity();
    pose.col(3).head(3) = rows.table.row(i).transpose();
    targets.poses.insert(targets.poses.end(), pose.data(), pose.data() + 16);
  }
  return targets;
}

void bind_inverse_result(py::module_& module) {
  py::class_<InverseAnswer>(module, "InverseResult",
                            "Joint angles found for poses, and how well; of a single pose each "
                            "array lacks its first dimension.")
      .def_property_readonly("q", &InverseAnswer::q,
                             "(N, n) [rad] or [m], by \"damped\" always within the limits; where "
                             "nothing was reached, the nearest found.")
      .def_property_readonly("status", &InverseAnswer::status,
                             "(N,) \"reached\", \"limit\", \"singular\" or \"out_of_reach\".")
      .def_property_readonly(
          "error", [](const InverseAnswer& r) { return r.numbers(r.result.error); },
          "(N,) left of position and angle together, a radian weighing a fifth of the arm's "
          "length [m].")
      .def_property_readonly(
          "position_error",
          [](const InverseAnswer& r) { return r.numbers(r.result.position_error); },
          "(N,) distance left [m].")
      .def_property_readonly(
          "angle_error", [](const InverseAnswer& r) { return r.numbers(r.result.angle_error); },
          "(N,) angle left [rad]; 0 where the task has none.")
      .def_property_readonly(
          "iterations", [](const InverseAnswer& r) { return r.counts(r.result.iterations); },
          "(N,) over all starts.")
      .def_property_readonly(
          "starts", [](const InverseAnswer& r) { return r.counts(r.result.starts); },
          "(N,) that were tried.")
      .def("__len__", [](const InverseAnswer& r) { return r.result.status.size(); })
      .def("__repr__", [](const InverseAnswer& r) {
        return "InverseResult(" + std::to_string(r.reached()) + " of " +
               std::to_string(r.result.status.size()) + " reached)";
      });
}

void add_inverse(py::class_<Arm>& cls) {
  const InverseOptions defaults;
  cls.def(
      "inverse",
      [](const Arm& arm, const ArrayLike& poses, const OptionalArray& start,
         const std::string& task, const std::string& method, const ArrayLike& axis,
         std::optional<double> position_tolerance, std::optional<double> angle_tolerance,
         int max_iterations, int max_starts, int candidates, std::optional<int> centering_steps,
         int steps, std::uint64_t seed, int num_threads) {
        InverseOptions options;
        options.task = enum_argument("task", task, task_names());
        options.method = enum_argument("method", method, method_names());
        options.axis = vector_argument("axis", axis);
        options.position_tolerance = position_tolerance;
        options.angle_tolerance = angle_tolerance;
        options.max_iterations = max_iterations;
        options.max_starts = max_starts;
        options.candidates = candidates;
        options.centering_steps = centering_steps;
        options.steps = steps;
        options.seed = seed;
        options.num_threads = num_threads;
        return inverse_python(arm, poses, start, options);
      },
      py::arg("poses"), py::arg("start") = py::none(), py::kw_only(),
      py::arg("task") = enum_name(defaults.task, task_names()),
      py::arg("method") = enum_name(defaults.method, method_names()),
      py::arg("axis") = py::make_tuple(defaults.axis.x(), defaults.axis.y(), defaults.axis.z()),
      py::arg("position_tolerance") = defaults.position_tolerance,
      py::arg("angle_tolerance") = defaults.angle_tolerance,
      py::arg("max_iterations") = defaults.max_iterations,
      py::arg("max_starts") = defaults.max_starts, py::arg("candidates") = defaults.candidates,
      py::arg("centering_steps") = defaults.centering_steps, py::arg("steps") = defaults.steps,
      py::arg("seed") = defaults.seed, py::arg("num_threads") = defaults.num_threads, kInverseDoc);
}

}  // namespace bathyal::python
