// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <numbers>
#include <optional>
#include <string>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/identify/identify_arm.hpp"
#include "bathyal/identify/summary.hpp"
#include "bindings.hpp"
#include "identify_docs.hpp"
#include "words.hpp"

namespace bathyal::python {
namespace {

// Words -----------------------------------------------------------------------------------------

const Words<Parametrization>& parametrization_words() {
  static const Words<Parametrization> words{{"hayati", Parametrization::kHayati},
                                            {"dh", Parametrization::kDh}};
  return words;
}
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

// Arguments -------------------------------------------------------------------------------------

py::array any_rows(std::string_view name, const py::object& object) {
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw_argument(name, "an array of numbers",
                   std::string(py::str(py::type::of(object).attr("__name__"))));
  }
  return array;
}

RowMatrix joints_argument(const py::object& q, const py::object& q_deg) {
  if (q.is_none() == q_deg.is_none()) {
    throw_argument("q", "joint values, either as `q` [rad] or as `q_deg` [deg]",
                   q.is_none() ? "neither" : "both");
  }
  const bool degrees = q.is_none();
  const char* name = degrees ? "q_deg" : "q";
  const py::array array = any_rows(name, degrees ? q_deg : q);
  if (array.ndim() != 2) {
    throw_argument(name, "real numbers of shape (N, n)",
                   std::to_string(array.ndim()) + " dimensions");
  }
  RowMatrix table = table_argument(name, array, array.shape(1));
  if (degrees) table *= std::numbers::pi / 180.0;
  return table;
}

std::vector<int> numbers_argument(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  std::vector<int> numbers;
  for (Index i = 0; i < values.rows(); ++i) {
    const double value = values.data()[i];
    if (!(std::abs(value) <= 2147483647.0) || value != std::floor(value)) {
      throw_argument(name, "whole numbers", to_text(value) + " at row " + std::to_string(i));
    }
    numbers.push_back(static_cast<int>(value));
  }
  return numbers;
}

std::vector<double> weights_argument(const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument("weights", object);
  return {values.data(), values.data() + values.rows()};
}

Covariates covariates_argument(const py::object& covariates, const py::object& session) {
  Covariates out;
  if (!covariates.is_none()) {
    if (!py::isinstance<py::dict>(covariates)) {
      throw_argument("covariates", "a dict of name to array",
                     std::string(py::str(py::type::of(covariates).attr("__name__"))));
    }
    for (const auto& [key, value] : covariates.cast<py::dict>()) {
      const std::string name = py::str(key);
      const auto object = py::reinterpret_borrow<py::object>(value);
      const py::array array = any_rows("covariates " + name, object);
      if (array.ndim() == 1) {
        const Values values = values_argument("covariates " + name, object);
        out[name] = values.view();
      } else {
        out[name] =
            table_argument("covariates " + name, object, array.ndim() == 2 ? array.shape(1) : 1);
      }
    }
  }
  if (!session.is_none()) {
    if (out.contains("session")) {
      throw_argument("session", "the sessions once", "both `session` and a covariate session");
    }
    const std::vector<int> numbers = numbers_argument("session", session);
    out["session"] =
        Eigen::Map<const Eigen::VectorXi>(numbers.data(), static_cast<Index>(numbers.size()))
            .cast<double>();
  }
  return out;
}

std::vector<KnownDistance> distances_argument(const py::object& object) {
  std::vector<KnownDistance> out;
  if (object.is_none()) return out;
  try {
    for (const auto& [pair, distance] : object.cast<std::map<std::pair<int, int>, double>>()) {
      out.push_back({pair.first, pair.second, distance});
    }
  } catch (const py::cast_error&) {
    throw_argument("known_distances", "a dict of (label, label) to metres",
                   std::string(py::repr(object)));
  }
  return out;
}

std::vector<KnownPoint> points_known(const py::object& object) {
  std::vector<KnownPoint> out;
  if (object.is_none()) return out;
  if (!py::isinstance<py::dict>(object)) {
    throw_argument("known_points", "a dict of label to (x, y, z)",
                   std::string(py::str(py::type::of(object).attr("__name__"))));
  }
  for (const auto& [label, position] : object.cast<py::dict>()) {
    out.push_back({label.cast<int>(),
                   vector_argument("known_points", py::reinterpret_borrow<py::object>(position))});
  }
  return out;
}

std::vector<TouchedPlane> planes_argument(const py::object& object) {
  std::vector<TouchedPlane> out;
  if (object.is_none()) return out;
  if (!py::isinstance<py::dict>(object)) {
    throw_argument("planes", "a dict of name to rows",
                   std::string(py::str(py::type::of(object).attr("__name__"))));
  }
  for (const auto& [name, rows] : object.cast<py::dict>()) {
    out.push_back(
        {py::str(name), numbers_argument("planes", py::reinterpret_borrow<py::object>(rows))});
  }
  return out;
}

std::map<int, std::string> names_argument(const py::object& object) {
  if (object.is_none()) return {};
  try {
    return object.cast<std::map<int, std::string>>();
  } catch (const py::cast_error&) {
    throw_argument("names", "a dict of label to text", std::string(py::repr(object)));
  }
}

Touches make_touches(const py::object& q, const py::object& point, const py::object& q_deg,
                     const py::object& known_distances, double distance_std,
                     const py::object& known_points, double point_std, const py::object& planes,
                     const py::object& weights, const py::object& tool, const py::object& station,
                     const py::object& covariates, const py::object& session,
                     const py::object& names) {
  Touches touches;
  touches.q = joints_argument(q, q_deg);
  touches.point = numbers_argument("point", point);
  touches.known_distances = distances_argument(known_distances);
  touches.distance_std = distance_std;
  touches.known_points = points_known(known_points);
  touches.point_std = point_std;
  touches.planes = planes_argument(planes);
  touches.weights = weights_argument(weights);
  touches.tool = numbers_argument("tool", tool);
  touches.station = numbers_argument("station", station);
  touches.covariates = covariates_argument(covariates, session);
  touches.names = names_argument(names);
  touches.check();
  return touches;
}

Tracked make_tracked(const py::object& q, const py::object& position, const py::object& pose,
                     const py::object& q_deg, const py::object& weights, const py::object& tool,
                     const py::object& station, const py::object& covariates,
                     const py::object& session) {
  Tracked tracked;
  tracked.q = joints_argument(q, q_deg);
  if (position.is_none() == pose.is_none()) {
    throw_argument("position", "what was measured, either as `position` or as `pose`",
                   position.is_none() ? "neither" : "both");
  }
  if (!position.is_none()) {
    tracked.position = points_argument("position", position).view();
  } else {
    const py::array array = any_rows("pose", pose);
    if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
      throw_argument("pose", "shape (N, 4, 4)", std::to_string(array.ndim()) + " dimensions");
    }
    tracked.position.resize(array.shape(0), 3);
    for (py::ssize_t i = 0; i < array.shape(0); ++i) {
      tracked.pose.push_back(pose_argument("pose", array[py::int_(i)]));
      tracked.position.row(i) = tracked.pose.back().translation().transpose();
    }
  }
  tracked.weights = weights_argument(weights);
  tracked.tool = numbers_argument("tool", tool);
  tracked.station = numbers_argument("station", station);
  tracked.covariates = covariates_argument(covariates, session);
  tracked.check();
  return tracked;
}

// Results ---------------------------------------------------------------------------------------

py::array to_numpy(const Eigen::VectorXd& values) {
  return python::to_numpy(std::vector<double>(values.begin(), values.end()));
}

py::array table_to_numpy(const RowMatrix& table) {
  return python::to_numpy(std::vector<double>(table.data(), table.data() + table.size()),
                          {table.cols()});
}

/// (k, 3) from one point a column.
py::array columns_to_numpy(const Eigen::Matrix3Xd& points) {
  return table_to_numpy(points.transpose());
}

py::list poses_to_list(const std::vector<Pose>& poses) {
  py::list list;
  for (const Pose& pose : poses) list.append(python::to_numpy(pose));
  return list;
}

py::dict covariates_to_dict(const Covariates& covariates) {
  py::dict dict;
  for (const auto& [name, values] : covariates) {
    dict[py::str(name)] =
        values.cols() == 1
            ? python::to_numpy(std::vector<double>(values.data(), values.data() + values.size()))
            : table_to_numpy(values);
  }
  return dict;
}

// Classes ---------------------------------------------------------------------------------------

template <class Data, class Class>
void bind_common(Class& cls) {
  cls.def_property_readonly(
         "q", [](const Data& d) { return table_to_numpy(d.q); }, "(N, n) [rad] or [m].")
      .def_property_readonly(
          "weights", [](const Data& d) { return python::to_numpy(d.weights); },
          "(N,), or (0,) when all are equal.")
      .def_property_readonly(
          "tool", [](const Data& d) { return python::to_numpy(d.tool); },
          "(N,), or (0,) when there is one.")
      .def_property_readonly(
          "station", [](const Data& d) { return python::to_numpy(d.station); },
          "(N,), or (0,) when there is one.")
      .def_property_readonly(
          "covariates", [](const Data& d) { return covariates_to_dict(d.covariates); },
          "Name to (N,) or (N, k) array; `session` among them.")
      .def("__len__", [](const Data& d) { return d.q.rows(); });
}

void bind_data(py::module_& module) {
  const Touches touches;
  py::class_<Touches> touches_class(module, "Touches", kTouchesDoc);
  touches_class
      .def(py::init(&make_touches), py::arg("q") = py::none(), py::arg("point") = py::none(),
           py::kw_only(), py::arg("q_deg") = py::none(), py::arg("known_distances") = py::none(),
           py::arg("distance_std") = touches.distance_std, py::arg("known_points") = py::none(),
           py::arg("point_std") = touches.point_std, py::arg("planes") = py::none(),
           py::arg("weights") = py::none(), py::arg("tool") = py::none(),
           py::arg("station") = py::none(), py::arg("covariates") = py::none(),
           py::arg("session") = py::none(), py::arg("names") = py::none())
      .def_property_readonly(
          "point", [](const Touches& t) { return python::to_numpy(t.point); },
          "(N,) label of the point that each row touched.")
      .def_property_readonly("known_distances",
                             [](const Touches& t) {
                               py::dict dict;
                               for (const KnownDistance& known : t.known_distances) {
                                 dict[py::make_tuple(known.first, known.second)] = known.distance;
                               }
                               return dict;
                             })
      .def_property_readonly("known_points",
                             [](const Touches& t) {
                               py::dict dict;
                               for (const KnownPoint& known : t.known_points) {
                                 dict[py::int_(known.label)] = python::to_numpy(known.position);
                               }
                               return dict;
                             })
      .def_property_readonly("planes",
                             [](const Touches& t) {
                               py::dict dict;
                               for (const TouchedPlane& plane : t.planes) {
                                 dict[py::str(plane.name)] = python::to_numpy(plane.rows);
                               }
                               return dict;
                             })
      .def_readonly("names", &Touches::names, "{label: name}, of the labels that have one.")
      .def_readonly("distance_std", &Touches::distance_std, "[m]")
      .def_readonly("point_std", &Touches::point_std, "[m]")
      .def("__repr__", [](const Touches& t) {
        return "Touches(" + std::to_string(t.q.rows()) + " poses, " + std::to_string(t.q.cols()) +
               " joints)";
      });
  bind_common<Touches>(touches_class);

  py::class_<Tracked> tracked_class(module, "Tracked", kTrackedDoc);
  tracked_class
      .def(py::init(&make_tracked), py::arg("q") = py::none(), py::arg("position") = py::none(),
           py::kw_only(), py::arg("pose") = py::none(), py::arg("q_deg") = py::none(),
           py::arg("weights") = py::none(), py::arg("tool") = py::none(),
           py::arg("station") = py::none(), py::arg("covariates") = py::none(),
           py::arg("session") = py::none())
      .def_property_readonly(
          "position", [](const Tracked& t) { return table_to_numpy(t.position); },
          "(N, 3) of the tip, world [m].")
      .def_property_readonly(
          "pose",
          [](const Tracked& t) -> py::object {
            if (t.pose.empty()) return py::none();
            std::vector<double> numbers;
            for (const Pose& pose : t.pose) {
              const RowMatrix matrix = pose.matrix();
              numbers.insert(numbers.end(), matrix.data(), matrix.data() + 16);
            }
            return python::to_numpy(std::move(numbers), {4, 4});
          },
          "(N, 4, 4) world_from_tool, or None when only positions were measured.")
      .def("__repr__", [](const Tracked& t) {
        return "Tracked(" + std::to_string(t.q.rows()) + " poses, " + std::to_string(t.q.cols()) +
               " joints)";
      });
  bind_common<Tracked>(tracked_class);
}

void bind_parts(py::module_& module) {
  py::class_<Trade>(module, "Trade", "A parameter that moves along, unseen, with another one.")
      .def_readonly("name", &Trade::name)
      .def_readonly("words", &Trade::words)
      .def_readonly("factor", &Trade::factor,
                    "How far it goes per unit of the other one, each in its own unit.")
      .def("__repr__",
           [](const Trade& t) { return "Trade(" + t.name + ", " + to_text(t.factor) + ")"; });
  py::class_<FitParameter>(module, "FitParameter", kFitParameterDoc)
      .def_readonly("name", &FitParameter::name)
      .def_readonly("words", &FitParameter::words)
      .def_readonly("unit", &FitParameter::unit)
      .def_readonly("group", &FitParameter::group)
      .def_readonly("nominal", &FitParameter::nominal)
      .def_readonly("value", &FitParameter::value)
      .def_readonly("std", &FitParameter::std)
      .def_property_readonly("status",
                             [](const FitParameter& p) { return std::string(to_text(p.status)); })
      .def_readonly("trades", &FitParameter::trades)
      .def("__repr__", [](const FitParameter& p) {
        return "FitParameter(" + p.name + "=" + to_text(p.value) + ", std=" + to_text(p.std) +
               ", " + std::string(to_text(p.status)) + ")";
      });
  py::class_<Outlier>(module, "Outlier", "A row that lies far from where the others want it.")
      .def_readonly("row", &Outlier::row)
      .def_readonly("point", &Outlier::label, "Label of its point; -1 where there is none.")
      .def_readonly("distance", &Outlier::distance, "From where it should be [m].")
      .def_readonly("fits", &Outlier::fits,
                    "Label of the point where it would fit, or None: labels look swapped.")
      .def("__repr__", [](const Outlier& o) {
        return "Outlier(row=" + std::to_string(o.row) + ", point=" + std::to_string(o.label) +
               ", distance=" + to_text(o.distance) +
               (o.fits ? ", fits=" + std::to_string(*o.fits) : "") + ")";
      });
}

void bind_fit(py::module_& module) {
  py::class_<ArmFit>(module, "ArmFit", kArmFitDoc)
      .def_readonly("arm", &ArmFit::arm, "Arm: identified, its base and tool set.")
      .def_property_readonly(
          "bases", [](const ArmFit& f) { return poses_to_list(f.bases); },
          "(4, 4) world_from_base of each station.")
      .def_property_readonly(
          "tools", [](const ArmFit& f) { return poses_to_list(f.tools); },
          "(4, 4) flange_from_tool of each tool.")
      .def_readonly("parameters", &ArmFit::parameters, "FitParameter of each unknown.")
      .def_property_readonly(
          "std",
          [](const ArmFit& f) {
            std::vector<double> std;
            for (const FitParameter& p : f.parameters) std.push_back(p.std);
            return python::to_numpy(std::move(std));
          },
          "(P,) of each parameter: 0 when held, inf when nothing tells it.")
      .def_property_readonly(
          "covariance", [](const ArmFit& f) { return table_to_numpy(f.covariance); },
          "(P, P) in the parameters' units; what nothing tells counts 0.")
      .def_readonly("rms_before", &ArmFit::rms_before,
                    "Nominal rows with the best start of tool and base: √mean‖e‖² [m].")
      .def_readonly("rms_after", &ArmFit::rms_after, "√mean‖e‖² [m].")
      .def_readonly("rms_after_scaled", &ArmFit::rms_after_scaled,
                    "rms_after times told by found lengths: had the arm kept its size [m].")
      .def_property_readonly(
          "point_rms_before", [](const ArmFit& f) { return python::to_numpy(f.point_rms_before); },
          "(n,) of each point, or station when tracked [m].")
      .def_property_readonly(
          "point_rms_after", [](const ArmFit& f) { return python::to_numpy(f.point_rms_after); },
          "(n,) [m]")
      .def_readonly("rotation_rms_before", &ArmFit::rotation_rms_before, "[rad]")
      .def_readonly("rotation_rms_after", &ArmFit::rotation_rms_after, "[rad]")
      .def_readonly("pairs_before", &ArmFit::pairs_before,
                    "J of Yukhimets, Gubankov (2023), eq 7 [m²].")
      .def_readonly("pairs_after", &ArmFit::pairs_after, "[m²]")
      .def_property_readonly(
          "history", [](const ArmFit& f) { return python::to_numpy(f.history); },
          "Sum of squares of the criterion at the start and after each step [m²].")
      .def_readonly("iterations", &ArmFit::iterations, "Steps that were accepted.")
      .def_readonly("converged", &ArmFit::converged)
      .def_readonly("rank", &ArmFit::rank, "Of the data, by all parameters, without priors.")
      .def_property_readonly(
          "singular_values", [](const ArmFit& f) { return to_numpy(f.singular_values); },
          "(P,) falling: millimetres at the tip per mm and mrad of a direction.")
      .def_readonly("unseen", &ArmFit::unseen, "The directions that the data do not see, in words.")
      .def_readonly("noise", &ArmFit::noise, "Standard deviation per axis, found or told [m].")
      .def_readonly("rotation_noise", &ArmFit::rotation_noise, "[rad]")
      .def_readonly("degrees_of_freedom", &ArmFit::degrees_of_freedom)
      .def_readonly("scale_source", &ArmFit::scale_source, "What the arm's size rests on.")
      .def_readonly("scale", &ArmFit::scale, "Lengths found by nominal lengths.")
      .def_readonly("scale_std", &ArmFit::scale_std)
      .def_readonly("point_labels", &ArmFit::point_labels)
      .def_property_readonly(
          "points", [](const ArmFit& f) { return columns_to_numpy(f.points); },
          "(n, 3) touched points as found, world [m].")
      .def_property_readonly(
          "distances",
          [](const ArmFit& f) {
            py::dict dict;
            for (const FoundDistance& d : f.distances) {
              dict[py::make_tuple(d.first, d.second)] = d.found;
            }
            return dict;
          },
          "Known distances as found: {(label, label): m}.")
      .def_property_readonly(
          "residuals", [](const ArmFit& f) { return columns_to_numpy(f.residuals); },
          "(N, 3) tip minus centroid, or minus the measured place, world [m].")
      .def_property_readonly(
          "residuals_before", [](const ArmFit& f) { return columns_to_numpy(f.residuals_before); },
          "(N, 3) the same of what `rms_before` tells [m].")
      .def_readonly("outliers", &ArmFit::outliers)
      .def_readonly("structure_p", &ArmFit::structure_p,
                    "Probability of residuals that depend on the joints so much by chance.")
      .def_readonly("warnings", &ArmFit::warnings, "Sentences; empty when all is well.")
      .def(
          "tip_covariance",
          [](const ArmFit& f, const py::object& q, int num_threads) {
            const Rows rows = rows_argument("q", q, f.arm.size());
            std::vector<double> numbers;
            for (const Eigen::Matrix3d& c : tip_covariance(f, rows.table, num_threads)) {
              numbers.insert(numbers.end(), c.data(), c.data() + 9);  // symmetric
            }
            return python::to_numpy(std::move(numbers), rows.single, {3, 3});
          },
          py::arg("q"), py::kw_only(), py::arg("num_threads") = 0, kTipCovarianceDoc)
      .def(
          "tip_std",
          [](const ArmFit& f, const py::object& q, int num_threads) -> py::object {
            const Rows rows = rows_argument("q", q, f.arm.size());
            std::vector<double> numbers;
            for (const Eigen::Matrix3d& c : tip_covariance(f, rows.table, num_threads)) {
              numbers.push_back(std::sqrt(c.trace()));
            }
            if (rows.single) return py::float_(numbers.front());
            return python::to_numpy(std::move(numbers));
          },
          py::arg("q"), py::kw_only(), py::arg("num_threads") = 0, kTipStdDoc)
      .def("summary", &summarize, "One paragraph in plain words.")
      .def("__str__", &summarize)
      .def("__repr__", [](const ArmFit& f) {
        return "ArmFit(rms_before=" + to_text(f.rms_before) +
               ", rms_after=" + to_text(f.rms_after) + ", rank=" + std::to_string(f.rank) + " of " +
               std::to_string(f.parameters.size()) + ")";
      });
}

void bind_function(py::module_& module) {
  using Options = IdentifyOptions;
  const Options defaults;
  module.def(
      "identify_arm",
      [](const Arm& arm, const py::object& data, const std::string& parametrization,
         double nearly_parallel, const std::string& criterion, bool pair_weights,
         const std::string& solver, int max_iterations, const std::string& tool_start,
         const std::string& base, std::vector<std::string> fixed,
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
        const auto run = [&](const auto& known) {
          const py::gil_scoped_release release;
          return identify_arm(arm, known, options);
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

void bind_identify(py::module_& module) {
  bind_data(module);
  bind_parts(module);
  bind_fit(module);
  bind_function(module);
}

}  // namespace bathyal::python
