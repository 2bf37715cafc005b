// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bindings.hpp"
#include "water_docs.hpp"
#include "water_parts.hpp"

namespace bathyal::python {
namespace {

Current make_current(const ArrayLike& depth, const ArrayLike& velocity, const OptionalArray& time) {
  const std::string shapes = "real numbers of shape (K, 2), with time= (T, K, 2)";
  const py::array given = array_argument("velocity", velocity, shapes);
  const py::ssize_t axes = time.is_none() ? 2 : 3;
  if (given.ndim() != axes || given.shape(axes - 1) != 2) {
    throw_argument("velocity", shapes, "shape " + std::string(py::str(given.attr("shape"))));
  }
  std::vector<double> depths = column_argument("depth", depth);
  if (given.shape(axes - 2) != static_cast<py::ssize_t>(depths.size())) {
    throw_argument("velocity", counted(static_cast<long>(depths.size()), "row") + ", one a depth",
                   std::to_string(given.shape(axes - 2)));
  }
  const Rows rows = rows_argument("velocity", given.attr("reshape")(-1, 2), 2);
  std::vector<Eigen::Vector2d> velocities;
  for (Index i = 0; i < rows.table.rows(); ++i) velocities.emplace_back(rows.table.row(i));
  return {std::move(depths), std::move(velocities), column_argument("time", time)};
}

void bind_current(py::module_& module) {
  py::class_<Current>(module, "Current", kCurrentDoc)
      .def(py::init(&make_current), py::arg("depth"), py::arg("velocity"), py::kw_only(),
           py::arg("time") = py::none())
      .def_static(
          "uniform", [](double x, double y) { return Current(x, y); }, py::arg("x"), py::arg("y"),
          "The same everywhere and always: x and y of the world [m/s].")
      .def(
          "at",
          [](const Current& c, const ArrayLike& depth, const ArrayLike& time) {
            const Broadcast given = broadcast_arguments({{"depth", depth}, {"time", time}});
            std::vector<double> values;
            for (std::size_t i = 0; i < given.size(); ++i) {
              const Eigen::Vector2d v = c.at(given.at(0, i), given.at(1, i));
              values.insert(values.end(), {v.x(), v.y()});
            }
            py::list shape = py::cast(given.shape);
            shape.append(2);
            return py::array(to_numpy(std::move(values)).attr("reshape")(shape));
          },
          py::arg("depth"), py::arg("time") = 0.0,
          "(…, 2) velocity [m/s] at depths [m] and times [s], which broadcast.")
      .def("__repr__",
           [](const Current& c) {
             return "Current(" + counted(static_cast<long>(c.depth().size()), "depth") +
                    (c.time().empty()
                         ? ""
                         : ", " + counted(static_cast<long>(c.time().size()), "time")) +
                    ")";
           })
      .def(py::pickle(
          [](const Current& c) {
            py::list velocity;
            for (const Eigen::Vector2d& v : c.velocity()) {
              velocity.append(py::make_tuple(v.x(), v.y()));
            }
            return py::make_tuple(c.depth(), velocity, c.time());
          },
          [](const py::tuple& s) {
            auto depth = s[0].cast<std::vector<double>>();
            if (depth.empty()) return Current();
            std::vector<Eigen::Vector2d> velocity;
            for (const auto& v : s[1].cast<std::vector<std::array<double, 2>>>()) {
              velocity.emplace_back(v[0], v[1]);
            }
            return Current(std::move(depth), std::move(velocity), s[2].cast<std::vector<double>>());
          }));
}

Waves waves_of_components(const ArrayLike& amplitude, const ArrayLike& period,
                          const ArrayLike& direction, const ArrayLike& phase, double depth) {
  const Broadcast given = broadcast_arguments(
      {{"amplitude", amplitude}, {"period", period}, {"direction", direction}, {"phase", phase}});
  std::vector<WaveComponent> components;
  for (std::size_t i = 0; i < given.size(); ++i) {
    Waves one =
        Waves::regular(2.0 * given.at(0, i), given.at(1, i), given.at(2, i), depth, given.at(3, i));
    components.push_back(one.components().front());
  }
  return Waves::of(std::move(components), depth);
}

py::object motion_rows(const Waves& waves, const ArrayLike& point, const ArrayLike& time,
                       bool velocity) {
  const Rows rows = rows_argument("point", point, 3);
  const Broadcast times = broadcast_arguments({{"time", time}});
  const auto count = static_cast<std::size_t>(rows.table.rows());
  if (times.size() != 1 && times.size() != count) {
    throw_argument("time", "one time, or one a point", std::to_string(times.size()));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at = rows.table.row(static_cast<Index>(i)).transpose();
    const Waves::Motion motion = waves.motion(at, times.at(0, times.size() == 1 ? 0 : i));
    const Vec3& v = velocity ? motion.velocity : motion.acceleration;
    values.insert(values.end(), {v.x(), v.y(), v.z()});
  }
  return to_numpy(std::move(values), rows.single, {3});
}

void bind_waves(py::module_& module) {
  const SeaState d;
  py::class_<Waves>(module, "Waves", kWavesDoc)
      .def(py::init([](double height, double period, double peak_enhancement, double direction,
                       double spreading, int components, double depth, std::uint64_t seed) {
             return Waves(SeaState{.height = height,
                                   .period = period,
                                   .peak_enhancement = peak_enhancement,
                                   .direction = direction,
                                   .spreading = spreading,
                                   .components = components,
                                   .depth = depth,
                                   .seed = seed});
           }),
           py::arg("height") = d.height, py::arg("period") = d.period, py::kw_only(),
           py::arg("peak_enhancement") = d.peak_enhancement, py::arg("direction") = d.direction,
           py::arg("spreading") = d.spreading, py::arg("components") = d.components,
           py::arg("depth") = d.depth, py::arg("seed") = d.seed)
      .def_static("regular", &Waves::regular, py::arg("height"), py::arg("period"), py::kw_only(),
                  py::arg("direction") = 0.0, py::arg("depth") = d.depth, py::arg("phase") = 0.0,
                  "One wave, long-crested: height from trough to crest [m], period [s], direction "
                  "it travels to about z from x [rad], depth of the water [m], phase at the origin "
                  "at time 0 [rad].")
      .def_static(
          "of_components", &waves_of_components, py::arg("amplitude"), py::arg("period"),
          py::arg("direction") = 0.0, py::arg("phase") = 0.0, py::kw_only(),
          py::arg("depth") = d.depth,
          "A sum of waves as given: (K,) amplitudes [m], periods [s], directions and phases "
          "[rad], which broadcast.")
      .def(
          "elevation",
          [](const Waves& w, const ArrayLike& x, const ArrayLike& y,
             const ArrayLike& time) -> NumberOrArray {
            const Broadcast given = broadcast_arguments({{"x", x}, {"y", y}, {"time", time}});
            std::vector<double> values(given.size());
            for (std::size_t i = 0; i < values.size(); ++i) {
              values[i] = w.elevation(given.at(0, i), given.at(1, i), given.at(2, i));
            }
            return given.result(std::move(values));
          },
          py::arg("x"), py::arg("y"), py::arg("time"),
          "Of the surface above its mean [m], at places [m] and times [s] that broadcast.")
      .def(
          "velocity",
          [](const Waves& w, const ArrayLike& point, const ArrayLike& time) {
            return py::array(motion_rows(w, point, time, true));
          },
          py::arg("point"), py::arg("time"),
          "(N, 3) or (3,) of the water in its orbits [m/s] at points whose z counts from the mean "
          "surface; 0 in the air. Wheeler's stretching.")
      .def(
          "acceleration",
          [](const Waves& w, const ArrayLike& point, const ArrayLike& time) {
            return py::array(motion_rows(w, point, time, false));
          },
          py::arg("point"), py::arg("time"), "The same of its local acceleration [m/s²].")
      .def_property_readonly(
          "amplitude",
          [](const Waves& w) {
            std::vector<double> values;
            for (const WaveComponent& c : w.components()) values.push_back(c.amplitude);
            return to_numpy(std::move(values));
          },
          "(K,) of each component [m].")
      .def_property_readonly(
          "frequency",
          [](const Waves& w) {
            std::vector<double> values;
            for (const WaveComponent& c : w.components()) values.push_back(c.frequency);
            return to_numpy(std::move(values));
          },
          "(K,) of each component [rad/s].")
      .def_property_readonly(
          "wave_number",
          [](const Waves& w) {
            std::vector<double> values;
            for (const WaveComponent& c : w.components()) {
              values.insert(values.end(), {c.number.x(), c.number.y()});
            }
            return to_numpy(std::move(values), {2});
          },
          "(K, 2) of each component, the way it travels [rad/m].")
      .def_property_readonly("depth", &Waves::depth, "Of the water [m].")
      .def("__repr__",
           [](const Waves& w) {
             double variance = 0.0;
             for (const WaveComponent& c : w.components())
               variance += 0.5 * c.amplitude * c.amplitude;
             return "Waves(" + counted(static_cast<long>(w.components().size()), "component") +
                    ", significant height " + three_digits(4.0 * std::sqrt(variance)) + " m)";
           })
      .def(py::pickle(
          [](const Waves& w) {
            py::list components;
            for (const WaveComponent& c : w.components()) {
              components.append(
                  py::make_tuple(c.amplitude, c.frequency, c.number.x(), c.number.y(), c.phase));
            }
            return py::make_tuple(components, w.depth());
          },
          [](const py::tuple& s) {
            std::vector<WaveComponent> components;
            for (const auto& c : s[0].cast<std::vector<std::array<double, 5>>>()) {
              components.push_back({c[0], c[1], {c[2], c[3]}, c[4]});
            }
            return Waves::of(std::move(components), s[1].cast<double>());
          }));
}

void bind_tide(py::module_& module) {
  py::class_<Tide>(module, "Tide", kTideDoc)
      .def(
          py::init([](const std::vector<std::pair<std::string, std::pair<double, double>>>& parts) {
            std::vector<TideConstituent> constituents;
            for (const auto& [name, values] : parts) {
              constituents.push_back(
                  {.amplitude = values.first, .rate = tide_rate(name), .phase = values.second});
            }
            return Tide(std::move(constituents));
          }),
          py::arg("constituents"))
      .def_static(
          "from_table",
          [](const ArrayLike& time, const ArrayLike& height) {
            return Tide(column_argument("time", time), column_argument("height", height));
          },
          py::arg("time"), py::arg("height"),
          "Of (K,) rising times [s] and heights above the mean [m]: linear between, at the ends as "
          "there.")
      .def(
          "height",
          [](const Tide& t, const ArrayLike& time) -> NumberOrArray {
            const Broadcast given = broadcast_arguments({{"time", time}});
            std::vector<double> values(given.size());
            for (std::size_t i = 0; i < values.size(); ++i) values[i] = t.height(given.at(0, i));
            return given.result(std::move(values));
          },
          py::arg("time"), "Above the mean surface [m] at times [s].")
      .def("__repr__",
           [](const Tide& t) {
             return "Tide(up to " + three_digits(t.highest()) + " m above the mean)";
           })
      .def(py::pickle(
          [](const Tide& t) {
            py::list constituents;
            for (const TideConstituent& c : t.constituents()) {
              constituents.append(py::make_tuple(c.amplitude, c.rate, c.phase));
            }
            return py::make_tuple(constituents, t.table_time(), t.table_height());
          },
          [](const py::tuple& s) {
            auto time = s[1].cast<std::vector<double>>();
            if (!time.empty()) return Tide(std::move(time), s[2].cast<std::vector<double>>());
            std::vector<TideConstituent> constituents;
            for (const auto& c : s[0].cast<std::vector<std::array<double, 3>>>()) {
              constituents.push_back({.amplitude = c[0], .rate = c[1], .phase = c[2]});
            }
            return Tide(std::move(constituents));
          }));
}

}  // namespace

void bind_water_motion(py::module_& module) {
  bind_current(module);
  bind_waves(module);
  bind_tide(module);
}

}  // namespace bathyal::python
