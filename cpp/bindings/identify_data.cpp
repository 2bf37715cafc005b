// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "bathyal/base/error.hpp"
#include "identify_docs.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

template <class Value>
using ByLabel = py::typing::Optional<py::typing::Dict<py::int_, Value>>;
using DistancesByPair =
    py::typing::Optional<py::typing::Dict<py::typing::Tuple<py::int_, py::int_>, py::float_>>;

// Arguments -------------------------------------------------------------------------------------

py::array any_rows(std::string_view name, const py::object& object) {
  return array_argument(name, object, "an array of numbers");
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
    const bool whole = value == std::floor(value);
    if (!whole || !(std::abs(value) <= 2147483647.0)) {
      throw_argument(name, whole ? "whole numbers of 32 bits" : "whole numbers",
                     to_text(value) + " at row " + std::to_string(i));
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
      } else if (array.ndim() == 2) {
        out[name] = table_argument("covariates " + name, object, array.shape(1));
      } else {
        throw_argument("covariates " + name, "real numbers of shape (N,) or (N, k)",
                       std::to_string(array.ndim()) + " dimensions");
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
    if (!py::isinstance<py::int_>(label)) {
      throw_argument("known_points", "a dict of label to (x, y, z)",
                     "the label " + std::string(py::repr(label)));
    }
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

Touches make_touches(const OptionalArray& q, const OptionalArray& point, const OptionalArray& q_deg,
                     const DistancesByPair& known_distances, double distance_std,
                     const ByLabel<ArrayLike>& known_points, double point_std,
                     const OptionalCovariates& planes, const OptionalArray& weights,
                     const OptionalArray& tool, const OptionalArray& station,
                     const OptionalCovariates& covariates, const OptionalArray& session,
                     const ByLabel<py::str>& names) {
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

Tracked make_tracked(const OptionalArray& q, const OptionalArray& position,
                     const OptionalArray& pose, const OptionalArray& q_deg,
                     const OptionalArray& weights, const OptionalArray& tool,
                     const OptionalArray& station, const OptionalCovariates& covariates,
                     const OptionalArray& session) {
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

py::dict covariates_to_dict(const Covariates& covariates) {
  py::dict dict;
  for (const auto& [name, values] : covariates) {
    dict[py::str(name)] =
        values.cols() == 1
            ? to_numpy(std::vector<double>(values.data(), values.data() + values.size()))
            : to_numpy(values);
  }
  return dict;
}

// Classes ---------------------------------------------------------------------------------------

template <class Data, class Class>
void bind_common(Class& cls) {
  cls.def_property_readonly(
         "q", [](const Data& d) { return to_numpy(d.q); }, "(N, n) [rad] or [m].")
      .def_property_readonly(
          "weights", [](const Data& d) { return to_numpy(d.weights); },
          "(N,), or (0,) when all are equal.")
      .def_property_readonly(
          "tool", [](const Data& d) { return to_numpy(d.tool); },
          "(N,), or (0,) when there is one.")
      .def_property_readonly(
          "station", [](const Data& d) { return to_numpy(d.station); },
          "(N,), or (0,) when there is one.")
      .def_property_readonly(
          "covariates", [](const Data& d) { return covariates_to_dict(d.covariates); },
          "Name to (N,) or (N, k) array; `session` among them.")
      .def("__len__", [](const Data& d) { return d.q.rows(); });
}

}  // namespace

void bind_identify_data(py::module_& module) {
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
          "point", [](const Touches& t) { return to_numpy(t.point); },
          "(N,) label of the point that each row touched.")
      .def_property_readonly(
          "known_distances",
          [](const Touches& t) {
            py::dict dict;
            for (const KnownDistance& known : t.known_distances) {
              dict[py::make_tuple(known.first, known.second)] = known.distance;
            }
            return dict;
          },
          "{(label, label): distance [m]} between touched points.")
      .def_property_readonly(
          "known_points",
          [](const Touches& t) {
            py::dict dict;
            for (const KnownPoint& known : t.known_points) {
              dict[py::int_(known.label)] = to_numpy(known.position);
            }
            return dict;
          },
          "{label: (3,) position [m]} in the world.")
      .def_property_readonly(
          "planes",
          [](const Touches& t) {
            py::dict dict;
            for (const TouchedPlane& plane : t.planes) {
              dict[py::str(plane.name)] = to_numpy(plane.rows);
            }
            return dict;
          },
          "{name: (K,) rows} of planes touched in many places.")
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
          "position", [](const Tracked& t) { return to_numpy(t.position); },
          "(N, 3) of the tip, world [m].")
      .def_property_readonly(
          "pose",
          [](const Tracked& t) -> py::typing::Optional<py::array> {
            if (t.pose.empty()) return py::none();
            std::vector<double> numbers;
            for (const Pose& pose : t.pose) {
              const RowMatrix matrix = pose.matrix();
              numbers.insert(numbers.end(), matrix.data(), matrix.data() + 16);
            }
            return to_numpy(std::move(numbers), {4, 4});
          },
          "(N, 4, 4) world_from_tool, or None when only positions were measured.")
      .def("__repr__", [](const Tracked& t) {
        return "Tracked(" + std::to_string(t.q.rows()) + " poses, " + std::to_string(t.q.cols()) +
               " joints)";
      });
  bind_common<Tracked>(tracked_class);
}

}  // namespace bathyal::python
